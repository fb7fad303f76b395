#include "compiler/codegen/expressions/special_operators.hpp"

#include "compiler/codegen/places/own_checks.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// What the operand is: its type after its conversion.
const Type *convertedType(const Expr *e) {
  return underlying(e->target != nullptr ? e->target : e->type);
}

/// Pointers with numbers of bytes, distances between pointers.
void emitPointerArithmetic(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  const bool leftPoints = underlying(e->left->type)->kind == TypeKind::Pointer;
  const bool both = leftPoints && underlying(e->right->type)->kind == TypeKind::Pointer;
  cx.out << (both                     ? "::stride::distance("
             : e->op == BinaryOp::Add ? "::stride::advance("
                                      : "::stride::retreat(");
  (leftPoints ? left : right)();
  cx.out << ", ";
  (leftPoints ? right : left)();
  cx.out << ')';
}

void emitWide(EmitContext &cx, Part value) {
  cx.out << "static_cast<::stride::LINT>(";
  value();
  cx.out << ')';
}

/// A duration times a number, or divided by it.
void emitScaledDuration(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  const Type *result = underlying(e->type);
  const bool multiplies = e->op == BinaryOp::Multiply;
  if (isReal(convertedType(e->left)) || isReal(convertedType(e->right))) {
    cx.out << "::stride::convert<" << cx.type(result) << ">(static_cast<::stride::LREAL>(";
    left();
    cx.out << (multiplies ? ") * static_cast<::stride::LREAL>("
                          : ") / static_cast<::stride::LREAL>(");
    right();
    cx.out << "))";
    return;
  }
  cx.out << "static_cast<" << cx.type(result) << ">(";
  if (multiplies) {
    emitWide(cx, left);
    cx.out << " * ";
    emitWide(cx, right);
  } else {
    cx.out << "::stride::divide<::stride::LINT>(" << cx.ctx() << ", ";
    left();
    cx.out << ", ";
    emitWide(cx, right);
    cx.out << ", ";
    cx.position(e->opSpan);
    cx.out << ')';
  }
  cx.out << ')';
}

/// What the type counts, in nanoseconds.
int64_t unitOf(const Type *t) {
  switch (t->kind) {
  case TypeKind::Time:
  case TypeKind::Tod:
    return 1000000;
  case TypeKind::Date:
  case TypeKind::Dt:
    return 1000000000;
  default:
    return 1;
  }
}

bool isTimeOfDay(const Type *t) { return t->kind == TypeKind::Tod || t->kind == TypeKind::Ltod; }

/// A time of day and a duration.
void emitTurnedClock(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  cx.out << "::stride::turnClock<::stride::Kind::"
         << Names::elementary(convertedType(e->left)->kind)
         << ", ::stride::Kind::" << Names::elementary(convertedType(e->right)->kind) << ", "
         << (e->op == BinaryOp::Add ? "1" : "-1") << ">(";
  left();
  cx.out << ", ";
  right();
  cx.out << ')';
}

/// Points in time and durations: both are brought to the finer unit, the result to its own.
void emitTimeSum(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  const int64_t leftUnit = unitOf(convertedType(e->left));
  const int64_t rightUnit = unitOf(convertedType(e->right));
  const Type *result = underlying(e->type);
  const int64_t fine = std::min(leftUnit, rightUnit);
  const auto scaled = [&](int64_t unit, Part value) {
    emitWide(cx, value);
    if (unit != fine)
      cx.out << " * " << unit / fine;
  };
  // Before 1970 as well, what does not fit into the unit is rounded down.
  const bool coarse = unitOf(result) > fine;
  cx.out << "static_cast<" << cx.type(result) << (coarse ? ">(::stride::floorDivide(" : ">((");
  scaled(leftUnit, left);
  cx.out << (e->op == BinaryOp::Add ? " + " : " - ");
  scaled(rightUnit, right);
  if (coarse)
    cx.out << ", " << unitOf(result) / fine;
  cx.out << ')';
  if (unitOf(result) < fine)
    cx.out << " * " << fine / unitOf(result);
  cx.out << ')';
}

/// `::stride::pow(left, right)`
void emitCall(EmitContext &cx, std::string_view function, Part left, Part right) {
  cx.out << function << '(';
  left();
  cx.out << ", ";
  right();
  cx.out << ')';
}

/// Integers that are divided by what may be zero.
void emitCheckedDivision(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  cx.out << (e->op == BinaryOp::Divide ? "::stride::divide<" : "::stride::modulo<")
         << cx.type(underlying(e->operandType)) << ">(" << cx.ctx() << ", ";
  left();
  cx.out << ", ";
  const bool own = openDivisorCheck(cx, e);
  right();
  cx.out << (own ? "))" : "") << ", ";
  cx.position(e->opSpan);
  cx.out << ')';
}

} // namespace

void emitSpecial(EmitContext &cx, const BinaryExpr *e, Part left, Part right) {
  const auto points = [](const Expr *x) { return underlying(x->type)->kind == TypeKind::Pointer; };
  if (e->operandType != nullptr) {
    if (isString(e->operandType))
      emitCall(cx, "::stride::compare", left, right);
    else if (e->op == BinaryOp::Power)
      emitCall(cx, "::stride::pow", left, right);
    else
      emitCheckedDivision(cx, e, left, right);
  } else if (points(e->left) || points(e->right)) {
    emitPointerArithmetic(cx, e, left, right);
  } else if (isTimeOfDay(underlying(e->type))) {
    emitTurnedClock(cx, e, left, right);
  } else if (isTimeOrDate(convertedType(e->left)) && isTimeOrDate(convertedType(e->right))) {
    emitTimeSum(cx, e, left, right);
  } else {
    emitScaledDuration(cx, e, left, right);
  }
}

} // namespace stc::codegen
