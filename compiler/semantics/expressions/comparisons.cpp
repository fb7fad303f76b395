// Comparisons.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

const Type *checkComparison(Context &c, BinaryExpr *expr) {
  Expr *left = expr->left;
  Expr *right = expr->right;
  const Type *boolean = elementaryType(TypeKind::boolean);
  // An enumerator found without its type may belong to the other side's type.
  if (left->type->kind == TypeKind::enumeration && right->type->kind == TypeKind::enumeration &&
      left->type != right->type && left->kind == ExprKind::name && left->constant != nullptr)
    check(c, left, right->type);
  const Type *l = left->type;
  const Type *r = right->type;
  const bool equality = expr->op == BinaryOp::equal || expr->op == BinaryOp::notEqual;
  if (l->kind == TypeKind::enumeration && r->kind == TypeKind::enumeration && l != r)
    return operatorError(c, expr);
  if (l != r && (refuseStrict(c, left) || refuseStrict(c, right)))
    return elementaryType(TypeKind::error);
  const Type *ul = underlying(l);
  const Type *ur = underlying(r);
  if (isNumber(ul) && isNumber(ur)) {
    if (isUntyped(ul) && isUntyped(ur)) {
      expr->operandType = ul->kind == TypeKind::anyInteger && ur->kind == TypeKind::anyInteger
                              ? ul
                              : elementaryType(TypeKind::anyReal);
      return boolean;
    }
    const Type *common = commonOf(left, right);
    if (common == nullptr) {
      auto &d = c.report(Code::signedWithUlint, expr->opSpan,
                         "no integer type holds both " + typeName(l) + " and " + typeName(r),
                         "signed and 64-bit unsigned values cannot be compared");
      d.label(left->span, typeName(l));
      d.label(right->span, typeName(r));
      d.help("convert one of them: `" + typeName(ul) + "_TO_" + typeName(ur) + "(…)`");
      return elementaryType(TypeKind::error);
    }
    const Type *operation = widened(common);
    for (const Type *t : {ul, ur}) {
      if (isInteger(operation) && isInteger(t)) {
        if (const Type *both = commonNumber(operation, t))
          operation = both;
      }
    }
    expr->operandType = operation;
  } else if (ul->kind == TypeKind::boolean && ur->kind == TypeKind::boolean) {
    expr->operandType = ul;
  } else if (ul->kind == TypeKind::boolean || ur->kind == TypeKind::boolean) {
    // `b = 1`: 0 and 1 are BOOL literals too.
    Expr *other = ul->kind == TypeKind::boolean ? right : left;
    if (other->constant == nullptr || !constantFits(*other->constant, other->type, boolean))
      return operatorError(c, expr);
    expr->operandType = boolean;
  } else if (isCharacter(ul) || isCharacter(ur)) {
    Expr *other = isCharacter(ul) ? right : left;
    expr->operandType = isCharacter(ul) ? ul : ur;
    if (ul != ur && (other->constant == nullptr ||
                     !constantFits(*other->constant, other->type, expr->operandType)))
      return operatorError(c, expr);
  } else if (isString(ul) && ul->kind == ur->kind) {
    const auto length = std::max(typeAs<StringType>(ul)->length, typeAs<StringType>(ur)->length);
    expr->operandType = c.types.string(ul->kind == TypeKind::wstring, length);
    return boolean; // the runtime compares strings of any two lengths: no conversion
  } else if (isTimeOrDate(ul) && isTimeOrDate(ur)) {
    if (ul == ur)
      expr->operandType = ul;
    else if (classify(ul, ur) == Conversion::free)
      expr->operandType = ur;
    else if (classify(ur, ul) == Conversion::free)
      expr->operandType = ul;
    else
      return operatorError(c, expr);
  } else if (equality && (ul->kind == TypeKind::interface || ur->kind == TypeKind::interface)) {
    // Interfaces are equal when they stand for the same instance, whatever their types are.
    expr->operandType = ul->kind == TypeKind::interface ? ul : ur;
    Expr *other = ul->kind == TypeKind::interface ? right : left;
    if (other->type->kind == TypeKind::interface)
      return boolean;
    if (!coerceToInterface(c, other, expr->operandType) || other->target == nullptr)
      return elementaryType(TypeKind::error);
    return boolean;
  } else if ((ul->kind == TypeKind::pointer || ur->kind == TypeKind::pointer) &&
             comparePointers(expr)) {
    return boolean;
  } else {
    return operatorError(c, expr);
  }
  setTarget(left, expr->operandType);
  setTarget(right, expr->operandType);
  return boolean;
}

} // namespace stc::sema
