// Arithmetic of numbers, times and dates.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

namespace stc::sema {

using namespace ast;

static const Type *checkTimeArithmetic(Context &c, BinaryExpr *expr);

const Type *unwidened(const Expr *e) {
  // What is LREAL stays LREAL; its `common` only keeps an assignment to REAL silent.
  return e->common != nullptr && !isReal(e->type) ? e->common : underlying(e->type);
}

/// Gives untyped constants the type of the other side where they fit.
const Type *commonOf(Expr *a, Expr *b) {
  const auto typeOfOperand = [](Expr *e, const Expr *other) -> const Type * {
    if (e->type->kind == TypeKind::AnyReal)
      return isReal(underlying(other->type)) ? underlying(other->type)
                                             : elementaryType(TypeKind::Lreal);
    if (e->type->kind == TypeKind::AnyInteger) {
      const Type *o = unwidened(other);
      if (other->type->kind == TypeKind::AnyReal)
        return elementaryType(TypeKind::Lreal);
      if ((isInteger(o) || isReal(o)) && constantFits(*e->constant, e->type, o))
        return o;
      return smallestInteger(e->constant->integer);
    }
    return unwidened(e);
  };
  return commonNumber(typeOfOperand(a, b), typeOfOperand(b, a));
}

/// In which type the operands are calculated with, where at least one of them has a type of its
/// own; null: there is none, which is reported.
static const Type *typeOfOperation(Context &c, BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const Type *common = commonOf(expr->left, expr->right);
  if (common == nullptr) {
    auto &d = c.report(Code::SignedWithUlint, expr->opSpan,
                       "no integer type holds both " + typeName(expr->left->type) + " and " +
                           typeName(expr->right->type),
                       "signed and 64-bit unsigned values cannot be mixed");
    d.label(expr->left->span, typeName(expr->left->type));
    d.label(expr->right->span, typeName(expr->right->type));
    d.help("convert one of them: `" + typeName(l) + "_TO_" + typeName(r) + "(…)`");
    return nullptr;
  }
  const auto narrow = [](const Expr *e) {
    return isUntyped(e->type) || (e->common != nullptr && e->common->kind == TypeKind::Real);
  };
  const bool constants =
      common->kind == TypeKind::Lreal && narrow(expr->left) && narrow(expr->right);
  expr->common = constants ? elementaryType(TypeKind::Real) : common;
  const Type *operation = widened(common);
  // An operand that had been widened already keeps its width (a*b + c).
  for (const Expr *e : {expr->left, expr->right}) {
    if (isInteger(operation) && isInteger(underlying(e->type)) && !isUntyped(e->type)) {
      if (const Type *both = commonNumber(operation, underlying(e->type)))
        operation = both;
    }
  }
  return operation;
}

/// Whether the operator is defined for the operands; reports when it is not.
static bool canDivide(Context &c, const BinaryExpr *expr) {
  const bool real = isReal(expr->operandType) || expr->operandType->kind == TypeKind::AnyReal;
  if (expr->op == BinaryOp::Modulo && real) {
    auto &d = c.report(Code::OperatorNotDefined, expr->opSpan,
                       "`MOD` is not defined for REAL and LREAL", "integers only");
    d.help("for a real remainder use SMC_fmod(x, m) of SM_DriveBasic");
    return false;
  }
  const ConstValue *divisor = expr->right->constant;
  if ((expr->op == BinaryOp::Divide || expr->op == BinaryOp::Modulo) && divisor != nullptr &&
      divisor->kind == ConstKind::Integer && divisor->integer == 0 && !real) {
    c.report(Code::DivisionByZero, expr->right->span, "division by zero", "this is always 0");
    return false;
  }
  return true;
}

const Type *checkArithmetic(Context &c, BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  if (refuseStrict(c, expr->left) || refuseStrict(c, expr->right))
    return elementaryType(TypeKind::Error);
  if (isTimeOrDate(l) || isTimeOrDate(r))
    return checkTimeArithmetic(c, expr);
  if (l->kind == TypeKind::Pointer || r->kind == TypeKind::Pointer)
    return checkPointerArithmetic(c, expr);
  if (!isNumber(l) || !isNumber(r))
    return operatorError(c, expr);
  if (l->kind == TypeKind::AnyInteger && r->kind == TypeKind::AnyInteger) {
    expr->operandType = l;
  } else if (isUntyped(l) && isUntyped(r)) {
    expr->operandType = elementaryType(TypeKind::AnyReal);
  } else {
    const Type *operation = typeOfOperation(c, expr);
    if (operation == nullptr)
      return elementaryType(TypeKind::Error);
    expr->operandType = operation;
  }
  if (!canDivide(c, expr))
    return elementaryType(TypeKind::Error);
  if (!isUntyped(expr->operandType)) {
    setTarget(expr->left, expr->operandType);
    setTarget(expr->right, expr->operandType);
  }
  return expr->operandType;
}

static const Type *checkTimeArithmetic(Context &c, BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const bool sum = expr->op == BinaryOp::Add;
  const bool difference = expr->op == BinaryOp::Subtract;
  using enum TypeKind;
  // Durations with durations.
  if (isDuration(l) && isDuration(r)) {
    if (!sum && !difference && expr->op != BinaryOp::Modulo)
      return operatorError(c, expr);
    expr->operandType = elementaryType(l->kind == Ltime || r->kind == Ltime ? Ltime : Time);
    setTarget(expr->left, expr->operandType);
    setTarget(expr->right, expr->operandType);
    return expr->operandType;
  }
  // A duration times or divided by a number.
  if ((isDuration(l) && isNumber(r) &&
       (expr->op == BinaryOp::Multiply || expr->op == BinaryOp::Divide)) ||
      (isNumber(l) && isDuration(r) && expr->op == BinaryOp::Multiply)) {
    Expr *number = isDuration(l) ? expr->right : expr->left;
    if (isUntyped(number->type))
      settle(number);
    if (number->constant != nullptr && expr->op == BinaryOp::Divide &&
        number->constant->kind == ConstKind::Integer && number->constant->integer == 0) {
      c.report(Code::DivisionByZero, number->span, "division by zero", "this is always 0");
      return elementaryType(Error);
    }
    return isDuration(l) ? l : r; // operandType stays null: the operands have different types
  }
  // Points in time plus or minus a duration; differences of points in time.
  const bool pointLeft = isTimeOrDate(l) && !isDuration(l);
  const bool pointRight = isTimeOrDate(r) && !isDuration(r);
  if (pointLeft && isDuration(r) && l->kind != Date && l->kind != Ldate && (sum || difference))
    return l;
  if (pointLeft && pointRight && l == r && difference)
    return elementaryType(l->kind == Date || l->kind == Tod || l->kind == Dt ? Time : Ltime);
  return operatorError(c, expr);
}

const Type *checkPower(Context &c, BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  if (!isNumber(l) || !isNumber(r))
    return operatorError(c, expr);
  expr->operandType = elementaryType(
      l->kind == TypeKind::Real && (r->kind == TypeKind::Real || isUntyped(r)) ? TypeKind::Real
                                                                               : TypeKind::Lreal);
  if (isUntyped(l) && isUntyped(r)) // `r := 2.0 ** 0.5` is silent, as `r := 2.0` is
    expr->common = elementaryType(TypeKind::Real);
  setTarget(expr->left, expr->operandType);
  setTarget(expr->right, expr->operandType);
  return expr->operandType;
}

} // namespace stc::sema
