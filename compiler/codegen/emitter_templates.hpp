#pragma once
// Templates of Emitter: conversions and operators around code that a callable writes.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/locations.hpp"

namespace stc::codegen {

template <class Inner>
void Emitter::converted(const Type *from, const Type *to, Span span, Inner &&inner) {
  if (from == to) {
    inner();
    return;
  }
  const Type *f = underlying(from);
  const Type *t = underlying(to);
  const auto wrap = [&](std::string_view function, std::string_view argument) {
    w_ << function << '<' << argument << ">(";
    inner();
    w_ << ')';
  };
  if (to->kind == TypeKind::subrange && checks()) {
    const auto *range = typeAs<SubrangeType>(to);
    const auto *own = from->kind == TypeKind::subrange ? typeAs<SubrangeType>(from) : nullptr;
    if (own == nullptr || own->low < range->low || own->high > range->high) {
      if (f != t)
        w_ << "static_cast<" << type(t) << ">(";
      w_ << "::stride::subrange<" << range->low << ", " << range->high << ">(" << ctx() << ", ";
      const bool own = openRangeCheck(range);
      inner();
      if (own)
        w_ << ", " << range->low << ", " << range->high << ')';
      w_ << ", ";
      position(span);
      w_ << (f != t ? "))" : ")");
      return;
    }
  }
  if (f == t || (f->kind == TypeKind::interface && t->kind == TypeKind::interface)) {
    inner();
    return;
  }
  if (t->kind == TypeKind::array) { // the same elements between other bounds
    wrap("::stride::reshape", type(t));
    return;
  }
  const bool pointerFrom = f->kind == TypeKind::pointer;
  const bool pointerTo = t->kind == TypeKind::pointer;
  if (pointerFrom || pointerTo) {
    if (pointerFrom && !pointerTo)
      w_ << "static_cast<" << type(t) << ">(reinterpret_cast<::stride::UXINT>(";
    else
      w_ << "reinterpret_cast<" << type(t)
         << (pointerFrom         ? ">("
             : bitWidth(f) == 32 ? ">(static_cast<::stride::UDINT>(" // an address kept in a DINT
                                 : ">(static_cast<::stride::UXINT>(");
    inner();
    w_ << (pointerFrom && pointerTo ? ")" : "))");
    return;
  }
  const bool wideTo = t->kind == TypeKind::wstring;
  if (isString(t) && isCharacter(f)) {
    const std::string length = std::to_string(typeAs<StringType>(t)->length);
    const bool cut = f->kind == TypeKind::wcharT && !wideTo;
    w_ << "::stride::" << (wideTo ? "wideCharacterText<" : "characterText<") << length << ">("
       << (cut ? "::stride::narrowCharacter(" : "");
    inner();
    w_ << (cut ? "))" : ")");
    return;
  }
  if (isString(f) && isCharacter(t)) {
    const bool cut = f->kind == TypeKind::wstring && t->kind == TypeKind::charT;
    w_ << (cut ? "::stride::narrowCharacter(" : "") << "::stride::firstCharacter(";
    inner();
    w_ << (cut ? "))" : ")");
    return;
  }
  if (f->kind == TypeKind::wcharT && t->kind == TypeKind::charT) {
    w_ << "::stride::narrowCharacter(";
    inner();
    w_ << ')';
    return;
  }
  if (t->kind == TypeKind::string && from->kind == TypeKind::enumeration &&
      typeAs<EnumType>(from)->named) {
    includes_.complete(from);
    const std::string value = temporary("value");
    w_ << "[&] { const " << type(from) << ' ' << value << " = ";
    inner();
    w_ << "; return ::stride::enumeratorText<" << typeAs<StringType>(t)->length << ">("
       << c_.names.qualified(typeAs<EnumType>(from)->symbol) << "__name__(" << value << "), "
       << value << "); }()";
    return;
  }
  if (isString(t)) {
    const std::string length = std::to_string(typeAs<StringType>(t)->length);
    if (isString(f))
      wrap(f->kind == t->kind ? "::stride::resize"
           : wideTo           ? "::stride::widen"
                              : "::stride::narrow",
           length);
    else
      wrap(wideTo ? "::stride::toWstring" : "::stride::toString",
           "::stride::Kind::" + std::string(Names::elementary(f->kind)) + ", " + length);
    return;
  }
  if (isString(f)) {
    wrap("::stride::fromString", "::stride::Kind::" + std::string(Names::elementary(t->kind)));
    return;
  }
  const auto plainNumber = [](const Type *x) { return isInteger(x) || isReal(x); };
  if (plainNumber(f) && plainNumber(t)) {
    if (isReal(f) && !isReal(t))
      wrap("::stride::convert", type(t));
    else
      wrap("static_cast", type(t));
    return;
  }
  wrap("::stride::convert", "::stride::Kind::" + std::string(Names::elementary(t->kind)) +
                                ", ::stride::Kind::" + std::string(Names::elementary(f->kind)));
}

/// Operators that are not C++ operators; `left` and `right` write the operands, already of the
/// operator's type.
template <class Left, class Right>
void Emitter::special(const ast::BinaryExpr *e, Left &&left, Right &&right) {
  using enum ast::BinaryOp;
  if (e->operandType == nullptr) {
    if (underlying(e->left->type)->kind == TypeKind::pointer ||
        underlying(e->right->type)->kind == TypeKind::pointer)
      pointerArithmetic(e, left, right);
    else
      timeArithmetic(e, left, right);
    return;
  }
  if (isString(e->operandType)) {
    w_ << "::stride::compare(";
    left();
    w_ << ", ";
    right();
    w_ << ')';
    return; // the caller writes the comparison with 0
  }
  if (e->op == power) {
    w_ << "::stride::pow(";
    left();
    w_ << ", ";
    right();
    w_ << ')';
    return;
  }
  w_ << (e->op == divide ? "::stride::divide<" : "::stride::modulo<")
     << type(underlying(e->operandType)) << ">(" << ctx() << ", ";
  left();
  w_ << ", ";
  const bool own = openDivisorCheck(e);
  right();
  w_ << (own ? "))" : "");
  w_ << ", ";
  position(e->opSpan);
  w_ << ')';
}

/// Pointers with numbers of bytes, distances between pointers.
template <class Left, class Right>
void Emitter::pointerArithmetic(const ast::BinaryExpr *e, Left &&left, Right &&right) {
  const bool leftPoints = underlying(e->left->type)->kind == TypeKind::pointer;
  const bool both = leftPoints && underlying(e->right->type)->kind == TypeKind::pointer;
  w_ << (both                          ? "::stride::distance("
         : e->op == ast::BinaryOp::add ? "::stride::advance("
                                       : "::stride::retreat(");
  if (leftPoints)
    left();
  else
    right();
  w_ << ", ";
  if (leftPoints)
    right();
  else
    left();
  w_ << ')';
}

/// Durations with numbers, points in time with durations.
template <class Left, class Right>
void Emitter::timeArithmetic(const ast::BinaryExpr *e, Left &&left, Right &&right) {
  using enum ast::BinaryOp;
  const auto own = [](const ast::Expr *x) {
    return underlying(x->target != nullptr ? x->target : x->type);
  };
  const Type *l = own(e->left);
  const Type *r = own(e->right);
  const Type *result = underlying(e->type);
  const auto unit = [](const Type *t) -> std::int64_t { // nanoseconds
    switch (t->kind) {
    case TypeKind::time:
    case TypeKind::tod:
      return 1000000;
    case TypeKind::date:
    case TypeKind::dt:
      return 1000000000;
    default:
      return 1;
    }
  };
  const auto wide = [&](auto &&inner) {
    w_ << "static_cast<::stride::LINT>(";
    inner();
    w_ << ')';
  };
  if (!isTimeOrDate(l) || !isTimeOrDate(r)) { // duration and number
    if (isReal(l) || isReal(r)) {
      w_ << "::stride::convert<" << type(result) << ">(static_cast<::stride::LREAL>(";
      left();
      w_ << (e->op == multiply ? ") * static_cast<::stride::LREAL>("
                               : ") / static_cast<::stride::LREAL>(");
      right();
      w_ << "))";
      return;
    }
    w_ << "static_cast<" << type(result) << ">(";
    if (e->op == multiply) {
      wide(left);
      w_ << " * ";
      wide(right);
    } else {
      w_ << "::stride::divide<::stride::LINT>(" << ctx() << ", ";
      left();
      w_ << ", ";
      wide(right);
      w_ << ", ";
      position(e->opSpan);
      w_ << ')';
    }
    w_ << ')';
    return;
  }
  // Both are brought to the finer unit, the result to its own.
  const std::int64_t fine = std::min(unit(l), unit(r));
  const auto scaled = [&](const Type *t, auto &&inner) {
    wide(inner);
    if (unit(t) != fine)
      w_ << " * " << unit(t) / fine;
  };
  // Before 1970 as well, what does not fit into the unit is rounded down.
  const bool coarse = unit(result) > fine;
  w_ << "static_cast<" << type(result) << (coarse ? ">(::stride::floorDivide(" : ">((");
  scaled(l, left);
  w_ << (e->op == add ? " + " : " - ");
  scaled(r, right);
  if (coarse)
    w_ << ", " << unit(result) / fine;
  w_ << ')';
  if (unit(result) < fine)
    w_ << " * " << fine / unit(result);
  w_ << ')';
}

template <class Slot> void Emitter::located(const Location &at, const Type *type, Slot &&slot) {
  const std::string_view base = area(at.area);
  includes_.complete(type);
  const bool aligned = at.isSlot || at.byte % alignmentOf(type) == 0;
  w_ << (aligned ? "::stride::at<" : "::stride::unaligned<") << c_.names.type(type) << ">(" << base
     << ", ";
  if (at.isSlot)
    slot();
  else
    w_ << at.byte;
  w_ << (aligned ? ")" : ").v");
}

template <class Value> void Emitter::bitStore(const ast::Expr *e, Value &&value) {
  if (isBitField(e)) {
    place(e);
    w_ << " = ";
    value();
    w_ << ';';
    return;
  }
  w_ << "::stride::set";
  bitAccess(e, true);
  w_ << ", ";
  value();
  w_ << ");";
}

} // namespace stc::codegen
