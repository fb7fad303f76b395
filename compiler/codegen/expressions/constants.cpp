#include "compiler/codegen/expressions/constants.hpp"

#include "compiler/codegen/expressions/conversions.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace stc::codegen {

using namespace ast;

namespace {

/// Zero counts as "no address".
void emitAddressConstant(EmitContext &cx, const Constant &constant) {
  if (constant.number == 0)
    cx.out << "nullptr";
  else
    cx.out << "reinterpret_cast<" << cx.type(constant.type) << ">("
           << static_cast<uint64_t>(constant.number) << "ULL)";
}

void emitReal(EmitContext &cx, double value, const Type *type) {
  const bool single = underlying(type)->kind == TypeKind::Real;
  if (std::isnan(value)) {
    cx.out << (single ? "__builtin_nanf(\"\")" : "__builtin_nan(\"\")");
    return;
  }
  if (std::isinf(value)) {
    cx.out << (value < 0 ? "-" : "") << (single ? "__builtin_inff()" : "__builtin_inf()");
    return;
  }
  char digits[40];
  const auto end =
      single ? std::to_chars(digits, digits + sizeof digits, static_cast<float>(value)).ptr
             : std::to_chars(digits, digits + sizeof digits, value).ptr;
  const std::string_view text(digits, static_cast<size_t>(end - digits));
  cx.out << text;
  if (text.find_first_of(".e") == std::string_view::npos)
    cx.out << ".0";
  if (single)
    cx.out << 'F';
}

/// The next code point of UTF-8 text; wrong bytes stand for themselves.
uint32_t nextCodePoint(std::string_view text, size_t &at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const uint32_t first = byte(at++);
  const unsigned extra = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
  if (extra == 0 || at + extra > text.size())
    return first;
  uint32_t point = first & (0x3FU >> extra);
  for (unsigned i = 0; i < extra; ++i)
    point = point << 6U | (byte(at++) & 0x3FU);
  return point;
}

/// Number of places the constant takes in a string of its kind.
uint32_t stringLength(std::string_view text, bool wide) {
  uint32_t length = 0;
  for (size_t at = 0; at < text.size();)
    length += nextCodePoint(text, at) > 0xFFFF && wide ? 2 : 1;
  return length;
}

/// The last `count` hexadecimal digits of it.
std::string hexDigits(uint32_t value, size_t count) {
  std::string digits(count, '0');
  for (size_t i = count; i-- > 0; value >>= 4U)
    digits[i] = "0123456789abcdef"[value & 15U];
  return digits;
}

void emitCharacter(EmitContext &cx, uint32_t c, bool wide) {
  if (c == '"' || c == '\\') {
    cx.out << '\\' << static_cast<char>(c);
  } else if (c >= 0x20 && c < 0x7F) {
    cx.out << static_cast<char>(c);
  } else if (c < 0x100) { // three octal digits, whatever follows
    cx.out << '\\' << static_cast<char>('0' + (c >> 6U)) << static_cast<char>('0' + (c >> 3U & 7U))
           << static_cast<char>('0' + (c & 7U));
  } else if (wide && c >= 0xD800 && c < 0xE000) { // half a pair: as a number, which ends here
    cx.out << "\\x" << hexDigits(c, 4) << "\" u\"";
  } else if (wide) {
    const bool pair = c > 0xFFFF;
    cx.out << (pair ? "\\U" : "\\u") << hexDigits(c, pair ? 8 : 4);
  } else {
    cx.out << '?';
  }
}

void emitExactString(EmitContext &cx, const ConstValue &constant, const Type *type) {
  const auto *string = typeAs<StringType>(type);
  const bool wide = type->kind == TypeKind::Wstring;
  const bool same = stringLength(constant.text, wide) == string->length;
  if (!same)
    cx.out << "::stride::resize<" << string->length << ">(";
  cx.out << "::stride::lit(";
  emitQuoted(cx, constant, wide);
  cx.out << (same ? ")" : "))");
}

/// What a constant may be named by: an enumerator is written by its name.
const Symbol *constantSymbol(const Expr *e) {
  switch (e->kind) {
  case ExprKind::Name:
    return as<NameExpr>(e)->symbol;
  case ExprKind::Member:
    return as<MemberExpr>(e)->symbol;
  case ExprKind::EnumLiteral:
    return as<EnumLiteralExpr>(e)->symbol;
  default:
    return nullptr;
  }
}

double realValue(const ConstValue &constant, const Type *from, const Type *to) {
  double value = constant.real;
  if (constant.kind == ConstKind::Integer)
    value = isUnsigned64(underlying(from))
                ? static_cast<double>(static_cast<uint64_t>(constant.integer))
                : static_cast<double>(constant.integer);
  const float single = static_cast<float>(value);
  return to->kind == TypeKind::Real && std::isfinite(single) ? double{single} : value;
}

Constant converted(const ConstValue &constant, const Type *from, const Type *to,
                   const Symbol *symbol) {
  using enum Constant::Kind;
  if (constant.kind == ConstKind::String) // a character
    return {Number, underlying(to), firstUnit(constant.text, from->kind == TypeKind::Wstring)};
  const Type *t = underlying(to);
  if (t->kind == TypeKind::Pointer || t->kind == TypeKind::Interface)
    return {Address, t, constant.integer};
  if (isReal(t) || t->kind == TypeKind::AnyReal)
    return {Real, t, 0, std::bit_cast<uint64_t>(realValue(constant, from, t))};
  if (symbol != nullptr && symbol->kind == SymbolKind::Enumerator && (isInteger(t) || from == to)) {
    const auto *e = static_cast<const EnumeratorSymbol *>(symbol);
    if (e->type == from)
      return {Enumerator, t, 0, 0, e};
  }
  int64_t value = constant.integer;
  if (from != to) {
    if (const auto v = convertConstant(constant, from, to))
      value = v->integer;
  }
  return {Number, t, value};
}

} // namespace

Constant constantOf(const Expr *e, const Type *to) {
  return converted(*e->constant, e->type, to, constantSymbol(e));
}

void emitConstant(EmitContext &cx, const Constant &constant) {
  switch (constant.kind) {
  case Constant::Kind::Number:
    emitNumber(cx, constant.number, constant.type);
    return;
  case Constant::Kind::Real:
    emitReal(cx, std::bit_cast<double>(constant.real), constant.type);
    return;
  case Constant::Kind::Address:
    emitAddressConstant(cx, constant);
    return;
  case Constant::Kind::Enumerator: {
    const EnumType *type = constant.enumerator->type;
    cx.includes.complete(type);
    cx.out << cx.run.names.qualified(type->symbol) << "__" << constant.enumerator->name.text;
    return;
  }
  }
}

void emitLiteral(EmitContext &cx, const ConstValue &constant, const Type *from, const Type *to,
                 const Symbol *symbol) {
  if (isString(to) && constant.kind == ConstKind::Integer) // a CHAR constant
    emitConverted(cx, from, to, {}, [&] { emitNumber(cx, constant.integer, from); });
  else if (constant.kind == ConstKind::String && !isCharacter(to))
    emitExactString(cx, constant, isString(to) ? to : from);
  else
    emitConstant(cx, converted(constant, from, to, symbol));
}

void emitLiteral(EmitContext &cx, const Expr *e, const Type *to) {
  emitLiteral(cx, *e->constant, e->type, to, constantSymbol(e));
}

void emitNumber(EmitContext &cx, int64_t value, const Type *type) {
  const Type *t = underlying(type);
  switch (t->kind) {
  case TypeKind::Boolean:
    cx.out << (value != 0 ? "true" : "false");
    return;
  case TypeKind::Ulint:
  case TypeKind::Lword:
    cx.out << static_cast<uint64_t>(value) << "ULL";
    return;
  case TypeKind::Udint:
  case TypeKind::Dword:
  case TypeKind::Time:
  case TypeKind::Date:
  case TypeKind::Tod:
  case TypeKind::Dt:
    cx.out << static_cast<uint32_t>(value) << 'U';
    return;
  default:
    break;
  }
  const bool wide = bitWidth(t) == 64 && t->kind != TypeKind::AnyInteger;
  const bool large =
      value > std::numeric_limits<int32_t>::max() || value < std::numeric_limits<int32_t>::min();
  const std::string_view suffix = wide || large ? "LL" : "";
  // The smallest value has no literal of its own: its digits alone are too large for the type.
  if (value == std::numeric_limits<int64_t>::min() ||
      (value == std::numeric_limits<int32_t>::min() && !wide))
    cx.out << '(' << value + 1 << suffix << " - 1)";
  else
    cx.out << value << suffix;
}

void emitQuoted(EmitContext &cx, const ConstValue &constant, bool wide) {
  cx.out << (wide ? "u\"" : "\"");
  for (size_t at = 0; at < constant.text.size();)
    emitCharacter(cx, nextCodePoint(constant.text, at), wide);
  cx.out << '"';
}

} // namespace stc::codegen
