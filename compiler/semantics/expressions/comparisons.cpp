// Comparisons.

#include "compiler/semantics/expressions/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static const Type *compareNumbers(Context &c, BinaryExpr *expr) {
  const Type *l = expr->left->type;
  const Type *r = expr->right->type;
  const Type *ul = underlying(l);
  const Type *ur = underlying(r);
  const Type *boolean = elementaryType(TypeKind::Boolean);
  if (isUntyped(ul) && isUntyped(ur)) {
    expr->operandType = ul->kind == TypeKind::AnyInteger && ur->kind == TypeKind::AnyInteger
                            ? ul
                            : elementaryType(TypeKind::AnyReal);
    return boolean;
  }
  const Type *operation = commonOf(expr->left, expr->right);
  if (operation == nullptr) {
    auto &d = c.report(Code::SignedWithUlint, expr->opSpan,
                       "no integer type holds both " + typeName(l) + " and " + typeName(r),
                       "signed and 64-bit unsigned values cannot be compared");
    d.label(expr->left->span, typeName(l));
    d.label(expr->right->span, typeName(r));
    d.help("convert one of them: `" + typeName(ul) + "_TO_" + typeName(ur) + "(…)`");
    return elementaryType(TypeKind::Error);
  }
  operation = widened(operation);
  for (const Type *t : {ul, ur}) {
    if (isInteger(operation) && isInteger(t)) {
      if (const Type *both = commonNumber(operation, t))
        operation = both;
    }
  }
  expr->operandType = operation;
  setTarget(expr->left, operation);
  setTarget(expr->right, operation);
  return boolean;
}

/// The type in which values that are no numbers are compared; null: they cannot be.
static const Type *comparedAs(const BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const Type *r = underlying(expr->right->type);
  const auto fits = [](const Expr *constant, const Type *type) {
    return constant->constant != nullptr && constantFits(*constant->constant, constant->type, type);
  };
  if (l->kind == TypeKind::Boolean && r->kind == TypeKind::Boolean)
    return l;
  if (l->kind == TypeKind::Boolean || r->kind == TypeKind::Boolean) {
    // `b = 1`: 0 and 1 are BOOL literals too.
    const Type *boolean = elementaryType(TypeKind::Boolean);
    return fits(l->kind == TypeKind::Boolean ? expr->right : expr->left, boolean) ? boolean
                                                                                  : nullptr;
  }
  if (isCharacter(l) || isCharacter(r)) {
    const Type *type = isCharacter(l) ? l : r;
    return l == r || fits(isCharacter(l) ? expr->right : expr->left, type) ? type : nullptr;
  }
  if (!isTimeOrDate(l) || !isTimeOrDate(r))
    return nullptr;
  if (l == r)
    return l;
  if (classify(l, r) == Conversion::Free)
    return r;
  return classify(r, l) == Conversion::Free ? l : nullptr;
}

/// Interfaces are equal when they stand for the same instance, whatever their types are.
static const Type *compareInterfaces(Context &c, BinaryExpr *expr) {
  const Type *l = underlying(expr->left->type);
  const bool isLeft = l->kind == TypeKind::Interface;
  expr->operandType = isLeft ? l : underlying(expr->right->type);
  Expr *other = isLeft ? expr->right : expr->left;
  if (other->type->kind != TypeKind::Interface &&
      (!coerceToInterface(c, other, expr->operandType) || other->target == nullptr))
    return elementaryType(TypeKind::Error);
  return elementaryType(TypeKind::Boolean);
}

static bool isIntegerOrConstant(const Type *type) {
  return isInteger(type) || type->kind == TypeKind::AnyInteger;
}

const Type *checkComparison(Context &c, BinaryExpr *expr) {
  Expr *left = expr->left;
  Expr *right = expr->right;
  const Type *boolean = elementaryType(TypeKind::Boolean);
  // An enumerator found without its type may belong to the other side's type.
  if (left->type->kind == TypeKind::Enumeration && right->type->kind == TypeKind::Enumeration &&
      left->type != right->type && left->kind == ExprKind::Name && left->constant != nullptr)
    check(c, left, right->type);
  const Type *l = left->type;
  const Type *r = right->type;
  if (l->kind == TypeKind::Enumeration && r->kind == TypeKind::Enumeration && l != r)
    return operatorError(c, expr);
  const Type *ul = underlying(l);
  const Type *ur = underlying(r);
  const bool areIntegers = isIntegerOrConstant(ul) && isIntegerOrConstant(ur);
  if (l != r && !areIntegers && (refuseStrict(c, left) || refuseStrict(c, right)))
    return elementaryType(TypeKind::Error);
  if (isNumber(ul) && isNumber(ur))
    return compareNumbers(c, expr);
  if (isString(ul) && ul->kind == ur->kind) {
    const auto length = std::max(typeAs<StringType>(ul)->length, typeAs<StringType>(ur)->length);
    expr->operandType = c.types.string(ul->kind == TypeKind::Wstring, length);
    return boolean; // the runtime compares strings of any two lengths: no conversion
  }
  if (const Type *type = comparedAs(expr)) {
    expr->operandType = type;
    setTarget(left, type);
    setTarget(right, type);
    return boolean;
  }
  const bool equality = expr->op == BinaryOp::Equal || expr->op == BinaryOp::NotEqual;
  if (equality && (ul->kind == TypeKind::Interface || ur->kind == TypeKind::Interface) &&
      ul->kind != TypeKind::Boolean && ur->kind != TypeKind::Boolean && !isCharacter(ul) &&
      !isCharacter(ur))
    return compareInterfaces(c, expr);
  if ((ul->kind == TypeKind::Pointer || ur->kind == TypeKind::Pointer) && comparePointers(expr))
    return boolean;
  return operatorError(c, expr);
}

} // namespace stc::sema
