// X_TO_Y, TO_Y, TRUNC_Y and the conversions of BCD.

#include "compiler/semantics/builtins/builtin_calls.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/builtins/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"

namespace stc::sema {

using namespace ast;

std::string calleeName(const CallExpr *expr) {
  return std::string(expr->callee->kind == ExprKind::Name ? as<NameExpr>(expr->callee)->name.text
                                                          : "this function");
}

const Type *checkConversionCall(Context &c, CallExpr *expr, const ConversionName &conversion) {
  expr->resolved = Callee::Builtin;
  expr->builtin = conversion.function;
  const Type *bad = elementaryType(TypeKind::Error);
  for (Argument &a : expr->arguments) {
    if (a.value != nullptr)
      check(c, a.value, conversion.from);
  }
  if (!placeArguments(c, expr) || !requireCount(c, expr) || expr->arguments[0].value == nullptr)
    return bad;
  Expr *value = expr->arguments[0].value;
  const Type *type = value->type;
  if (isError(type))
    return bad;
  if (conversion.from == nullptr && conversion.function != Builtin::Convert &&
      !checkSpecialArgument(c, expr))
    return bad;
  if (type->kind == TypeKind::Pointer && conversion.from == nullptr) // the address as a number
    setTarget(value, elementaryType(TypeKind::Ulint));
  else if (!isElementary(type) && type->kind != TypeKind::Pointer)
    return argumentError(
        c, expr, 0, conversion.from != nullptr ? typeName(conversion.from) : "an elementary type");
  if (conversion.from != nullptr) {
    // `DINT_TO_INT(i)` takes what converts to DINT silently.
    if (isString(conversion.from) && isString(type)) {
      if (conversion.from->kind != type->kind)
        return argumentError(c, expr, 0, typeName(conversion.from));
    } else if (type->kind == TypeKind::Enumeration && isInteger(conversion.from)) {
      setTarget(value, conversion.from);
    } else {
      coerce(c, value, conversion.from, "argument of `" + calleeName(expr) + "`");
      if (value->target == nullptr && value->type != conversion.from)
        return bad;
    }
  } else if (isUntyped(type) && value->target == nullptr) {
    settle(value);
  }
  if (conversion.function != Builtin::Convert) {
    foldCall(c, expr, conversion.to);
    return conversion.to;
  }
  const Type *from = value->target != nullptr ? value->target : value->type;
  if (value->constant != nullptr) {
    const auto own = convertConstant(*value->constant, value->type, from);
    const auto result = own ? foldConversion(*own, from, conversion.to, c.arena) : std::nullopt;
    if (result)
      expr->constant = c.makeConstant(*result);
  }
  return conversion.to;
}

} // namespace stc::sema
