#include "compiler/codegen/expressions/conversions.hpp"

#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/own_checks.hpp"
#include "compiler/semantics/conversions.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// `before` and what `value` writes and `after`.
void emitBetween(EmitContext &cx, std::string_view before, Part value, std::string_view after) {
  cx.out << before;
  value();
  cx.out << after;
}

/// `function<argument>(value)`
void emitTemplate(EmitContext &cx, std::string_view function, std::string_view argument,
                  Part value) {
  cx.out << function << '<' << argument << ">(";
  value();
  cx.out << ')';
}

/// Values of `from` may lie outside of the subrange `to`.
bool checksRange(const EmitContext &cx, const Type *from, const Type *to) {
  if (to->kind != TypeKind::Subrange || !cx.checks())
    return false;
  const auto *range = typeAs<SubrangeType>(to);
  const auto *own = from->kind == TypeKind::Subrange ? typeAs<SubrangeType>(from) : nullptr;
  return own == nullptr || own->low < range->low || own->high > range->high;
}

void emitInRange(EmitContext &cx, const Type *from, const SubrangeType *to, Span span, Part value) {
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (f != t)
    cx.out << "static_cast<" << cx.type(t) << ">(";
  cx.out << "::stride::subrange<" << to->low << ", " << to->high << ">(" << cx.ctx() << ", ";
  const bool own = openRangeCheck(cx, to);
  value();
  if (own)
    cx.out << ", " << to->low << ", " << to->high << ')';
  cx.out << ", ";
  cx.position(span);
  cx.out << (f != t ? "))" : ")");
}

/// Pointers, and the numbers that hold their addresses.
void emitPointerConversion(EmitContext &cx, const Type *f, const Type *t, Part value) {
  const bool from = f->kind == TypeKind::Pointer;
  const bool to = t->kind == TypeKind::Pointer;
  cx.out << (to ? "reinterpret_cast<" : "static_cast<") << cx.type(t);
  if (!to)
    emitBetween(cx, ">(reinterpret_cast<::stride::UXINT>(", value, "))");
  else if (from)
    emitBetween(cx, ">(", value, ")");
  else if (bitWidth(f) == 32) // an address kept in a DINT
    emitBetween(cx, ">(static_cast<::stride::UDINT>(", value, "))");
  else
    emitBetween(cx, ">(static_cast<::stride::UXINT>(", value, "))");
}

std::string kindName(const Type *t) {
  return "::stride::Kind::" + std::string(Names::elementary(t->kind));
}

/// A character to a text.
void emitCharacterText(EmitContext &cx, const Type *f, const StringType *t, Part value) {
  const bool wide = t->kind == TypeKind::Wstring;
  const bool cut = f->kind == TypeKind::Wchar && !wide;
  cx.out << "::stride::" << (wide ? "wideCharacterText<" : "characterText<") << t->length << ">(";
  emitBetween(cx, cut ? "::stride::narrowCharacter(" : "", value, cut ? "))" : ")");
}

/// The first character of a text.
void emitFirstCharacter(EmitContext &cx, const Type *f, const Type *t, Part value) {
  const bool cut = f->kind == TypeKind::Wstring && t->kind == TypeKind::Char;
  cx.out << (cut ? "::stride::narrowCharacter(" : "");
  emitBetween(cx, "::stride::firstCharacter(", value, cut ? "))" : ")");
}

/// The name of an enumerator, or its number.
void emitEnumeratorText(EmitContext &cx, const EnumType *from, const StringType *t, Part value) {
  cx.includes.complete(from);
  const std::string name = cx.temporary("value");
  cx.out << "[&] { const " << cx.type(from) << ' ' << name << " = ";
  value();
  cx.out << "; return ::stride::enumeratorText<" << t->length << ">("
         << cx.run.names.qualified(from->symbol) << "__name__(" << name << "), " << name
         << "); }()";
}

/// Anything else to a text.
void emitTextOf(EmitContext &cx, const Type *f, const StringType *t, Part value) {
  const bool wide = t->kind == TypeKind::Wstring;
  const std::string length = std::to_string(t->length);
  if (!isString(f))
    emitTemplate(cx, wide ? "::stride::toWstring" : "::stride::toString",
                 kindName(f) + ", " + length, value);
  else if (f->kind == t->kind)
    emitTemplate(cx, "::stride::resize", length, value);
  else
    emitTemplate(cx, wide ? "::stride::widen" : "::stride::narrow", length, value);
}

/// Texts and characters, on one side at least.
void emitTextConversion(EmitContext &cx, const Type *from, const Type *f, const Type *t,
                        Part value) {
  if (isString(t) && isCharacter(f))
    emitCharacterText(cx, f, typeAs<StringType>(t), value);
  else if (isString(f) && isCharacter(t))
    emitFirstCharacter(cx, f, t, value);
  else if (t->kind == TypeKind::String && from->kind == TypeKind::Enumeration &&
           typeAs<EnumType>(from)->named)
    emitEnumeratorText(cx, typeAs<EnumType>(from), typeAs<StringType>(t), value);
  else if (isString(t))
    emitTextOf(cx, f, typeAs<StringType>(t), value);
  else
    emitTemplate(cx, "::stride::fromString", kindName(t), value);
}

bool isPlainNumber(const Type *t) { return isInteger(t) || isReal(t); }

bool isInterface(const Type *t) { return t->kind == TypeKind::Interface; }

} // namespace

void emitConverted(EmitContext &cx, const Type *from, const Type *to, Span span, Part value) {
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (from != to && checksRange(cx, from, to))
    emitInRange(cx, from, typeAs<SubrangeType>(to), span, value);
  else if (f == t || (isInterface(f) && isInterface(t)))
    value();
  else if (t->kind == TypeKind::Array) // the same elements between other bounds
    emitTemplate(cx, "::stride::reshape", cx.type(t), value);
  else if (f->kind == TypeKind::Pointer || t->kind == TypeKind::Pointer)
    emitPointerConversion(cx, f, t, value);
  else if (f->kind == TypeKind::Wchar && t->kind == TypeKind::Char)
    emitBetween(cx, "::stride::narrowCharacter(", value, ")");
  else if (isString(f) || isString(t))
    emitTextConversion(cx, from, f, t, value);
  else if (isPlainNumber(f) && isPlainNumber(t))
    emitTemplate(cx, isReal(f) && !isReal(t) ? "::stride::convert" : "static_cast", cx.type(t),
                 value);
  else
    emitTemplate(cx, "::stride::convert", kindName(t) + ", " + kindName(f), value);
}

bool isImplicitStore(const EmitContext &cx, const Type *from, const Type *to) {
  if (from == to)
    return true;
  if (to->kind == TypeKind::Subrange && cx.checks())
    return false;
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  if (f == t || (isInterface(f) && isInterface(t)))
    return true;
  if (isInteger(f) && (isInteger(t) || isReal(t)))
    return classify(f, t) == Conversion::Free;
  return f->kind == TypeKind::Real && t->kind == TypeKind::Lreal;
}

void emitConvertedText(EmitContext &cx, std::string_view code, const Type *from, const Type *to,
                       Span span) {
  if (isImplicitStore(cx, from, to))
    cx.out << code;
  else
    emitConverted(cx, from, to, span, [&] { cx.out << code; });
}

void emitConvertedExpr(EmitContext &cx, const Expr *e, const Type *from, const Type *to) {
  emitConverted(cx, from, to, e->span, [&] { emitRaw(cx, e); });
}

} // namespace stc::codegen
