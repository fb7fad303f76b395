// ASSERT_TRUE … FAIL: the assertions of unit tests.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

namespace stc::sema {

using namespace ast;

/// The two values of a comparison become values of one type; the message is not among them.
static bool compareAsserted(Context &c, CallExpr *expr) {
  const std::span<Argument> all = expr->arguments;
  expr->arguments = all.first(2);
  const Type *common = commonOfArguments(c, expr, 0);
  expr->arguments = all;
  expr->common = nullptr;
  return !isError(common);
}

const Type *checkAssertion(Context &c, CallExpr *expr) {
  const Type *boolean = elementaryType(TypeKind::Boolean);
  const Type *bad = elementaryType(TypeKind::Error);
  const size_t values = assertedValues(expr->builtin);
  if (expr->arguments.size() > values && kindOf(expr, values)->kind != TypeKind::String)
    return argumentError(c, expr, values, "a STRING");
  if (values == 1) {
    coerce(c, valueOf(expr, 0), boolean, "the condition of an assertion");
    return boolean;
  }
  for (size_t i = 0; i < values; ++i) {
    const Type *kind = kindOf(expr, i);
    if (values == 3) {
      if (!isNumber(kind))
        return argumentError(c, expr, i, "a number");
      setTarget(valueOf(expr, i), elementaryType(TypeKind::Lreal));
    } else if (!isNumber(kind) && !isElementary(kind) && kind->kind != TypeKind::Enumeration) {
      return argumentError(c, expr, i, "a value of an elementary type or an enumeration");
    }
  }
  return values == 2 && !compareAsserted(c, expr) ? bad : boolean;
}

} // namespace stc::sema
