// Calls of functions that the compiler implements itself: the rows of builtins.def say who checks
// one.

#include "compiler/semantics/builtins/builtin_calls.hpp"

#include "compiler/semantics/builtins/internal.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>
#include <iterator>

namespace stc::sema {

using namespace ast;

namespace {

using Check = const Type *(*)(Context &c, CallExpr *expr);

/// By the number of the function; null: it is not called by a name of its own.
constexpr Check kChecks[] = {
#define STC_BUILTIN(enumerator, name, signature, takes, check, ...) Check check,
#include "compiler/semantics/builtins.def"
};

/// Whether CHECK(…) holds something: GCC compares no address at compile time under its sanitizers.
struct Given {
  constexpr Given() = default;
  constexpr Given(Check /*check*/) : value(true) {}
  bool value = false;
};
constexpr bool kHasCheck[] = {
#define STC_BUILTIN(enumerator, name, signature, takes, check, ...) Given check.value,
#include "compiler/semantics/builtins.def"
};
constexpr bool kHasName[] = {
#define STC_BUILTIN(enumerator, name, ...) !std::string_view(name).empty(),
#include "compiler/semantics/builtins.def"
};
static_assert(std::equal(std::begin(kHasCheck), std::end(kHasCheck), std::begin(kHasName)),
              "what has a name in builtins.def needs a CHECK, and nothing else does");

/// The arguments may be types, or are checked otherwise than others: by the function's own check.
bool areOwnMatter(BuiltinTakes takes) {
  return takes == BuiltinTakes::Operands || takes == BuiltinTakes::TypeOf ||
         takes == BuiltinTakes::Name;
}

/// ARRAY[*] as a whole is something that the function takes.
bool takesOpenArrays(BuiltinTakes takes) {
  return takes == BuiltinTakes::Bounds || takes == BuiltinTakes::Address;
}

} // namespace

const Type *checkBuiltin(Context &c, CallExpr *expr, const Type *expected) {
  const Type *bad = elementaryType(TypeKind::Error);
  const BuiltinTakes takes = builtinRow(expr->builtin).takes.what;
  const Check checkCall = kChecks[static_cast<size_t>(expr->builtin)];
  const bool placed = placeArguments(c, expr);
  if (areOwnMatter(takes))
    return placed ? checkCall(c, expr) : bad;
  bool failed = !placed;
  for (const Argument &a : expr->arguments) {
    if (a.value != nullptr && isError(check(c, a.value, expected)))
      failed = true;
  }
  if (failed)
    return bad;
  if (!takesOpenArrays(takes) &&
      std::any_of(expr->arguments.begin(), expr->arguments.end(),
                  [&](const Argument &a) { return refuseOpenArray(c, a.value, "use"); }))
    return bad;
  return requireCount(c, expr) ? checkCall(c, expr) : bad;
}

} // namespace stc::sema
