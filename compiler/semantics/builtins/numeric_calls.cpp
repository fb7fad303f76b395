// Numeric functions of one or two arguments, selection, shifts.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

namespace stc::sema {

using namespace ast;

const Type *settledKindOf(const CallExpr *expr, size_t index) {
  Expr *value = valueOf(expr, index);
  return isUntyped(value->type) ? settle(value) : underlying(value->type);
}

static bool isIntegerOrUntyped(const Type *type) {
  return isInteger(type) || type->kind == TypeKind::AnyInteger;
}

const Type *checkAbs(Context &c, CallExpr *expr) {
  const Type *kind = kindOf(expr, 0);
  if (!isNumber(kind) && kind->kind != TypeKind::Ltime)
    return argumentError(c, expr, 0, "a number");
  const Type *type = settledKindOf(expr, 0);
  setTarget(valueOf(expr, 0), type);
  expr->common = valueOf(expr, 0)->common;
  return type;
}

const Type *checkRealFunction(Context &c, CallExpr *expr) {
  const Type *kind = kindOf(expr, 0);
  if (!isNumber(kind))
    return argumentError(c, expr, 0, "a number");
  const Type *result = kind->kind == TypeKind::Real ? kind : elementaryType(TypeKind::Lreal);
  if (isUntyped(kind)) // `r := SQRT(2.0)` is silent, as `r := 2.0` is
    expr->common = elementaryType(TypeKind::Real);
  setTarget(valueOf(expr, 0), result);
  return result;
}

const Type *checkPowerFunction(Context &c, CallExpr *expr) {
  for (size_t i = 0; i < 2; ++i) {
    if (!isNumber(kindOf(expr, i)))
      return argumentError(c, expr, i, "a number");
  }
  const Type *first = kindOf(expr, 0);
  const Type *second = kindOf(expr, 1);
  const bool real =
      first->kind == TypeKind::Real && (second->kind == TypeKind::Real || isUntyped(second));
  const Type *result = elementaryType(real ? TypeKind::Real : TypeKind::Lreal);
  if (isUntyped(first) && isUntyped(second))
    expr->common = elementaryType(TypeKind::Real);
  setTarget(valueOf(expr, 0), result);
  setTarget(valueOf(expr, 1), result);
  return result;
}

const Type *checkTrunc(Context &c, CallExpr *expr) {
  const Library *here = c.scope.module->library;
  const bool truncIsInt = here->isUser ? c.program.settings.truncIsInt : here->truncIsInt;
  const Type *result = elementaryType(truncIsInt ? TypeKind::Int : TypeKind::Dint);
  const Type *kind = kindOf(expr, 0);
  if (!isNumber(kind))
    return argumentError(c, expr, 0, "a number");
  if (isIntegerOrUntyped(kind)) { // stays what it is
    if (bitWidth(kind) < bitWidth(result))
      expr->common = kind;
    setTarget(valueOf(expr, 0), elementaryType(TypeKind::Lreal));
  } else {
    settledKindOf(expr, 0);
  }
  return result;
}

const Type *checkExtreme(Context &c, CallExpr *expr) {
  for (size_t i = 0; i < expr->arguments.size(); ++i) {
    if (!isElementary(kindOf(expr, i)))
      return argumentError(c, expr, i, "a value that can be compared");
  }
  return commonOfArguments(c, expr, 0);
}

const Type *checkSel(Context &c, CallExpr *expr) {
  coerce(c, valueOf(expr, 0), elementaryType(TypeKind::Boolean), "the selector of SEL");
  return commonOfArguments(c, expr, 1);
}

const Type *checkMux(Context &c, CallExpr *expr) {
  if (!isIntegerOrUntyped(kindOf(expr, 0)))
    return argumentError(c, expr, 0, "an integer");
  settledKindOf(expr, 0);
  return commonOfArguments(c, expr, 1);
}

const Type *checkMove(Context &, CallExpr *expr) {
  Expr *value = valueOf(expr, 0);
  expr->common = value->common;
  return isUntyped(value->type) ? settle(value) : value->type;
}

const Type *checkShift(Context &c, CallExpr *expr) {
  if (!isIntegerOrUntyped(kindOf(expr, 0)))
    return argumentError(c, expr, 0, "a bit string or an integer");
  if (!isIntegerOrUntyped(kindOf(expr, 1)))
    return argumentError(c, expr, 1, "an integer");
  Expr *pattern = valueOf(expr, 0);
  const Type *type = settledKindOf(expr, 0);
  expr->common = pattern->common;
  if (pattern->type->kind == TypeKind::AnyInteger) // a pattern, not a number
    type =
        elementaryType(pattern->constant->integer < 0 || pattern->constant->integer > 0xFFFFFFFFLL
                           ? TypeKind::Lword
                           : TypeKind::Dword);
  pattern->target = nullptr;
  setTarget(pattern, type);
  settledKindOf(expr, 1);
  return type;
}

} // namespace stc::sema
