// Calls of functions that the compiler implements itself: a row says who checks one.

#include "compiler/semantics/builtins/builtin_calls.hpp"

#include "compiler/semantics/builtins/internal.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>
#include <array>

namespace stc::sema {

using namespace ast;

namespace {

/// What the arguments of a built-in function may be, before its own check.
enum class BuiltinTakes : std::uint8_t {
  values,
  openArrays, ///< also an ARRAY[*] as a whole
  unchecked,  ///< its check looks at them itself: they may be types
};

constexpr std::size_t kAny = SIZE_MAX;
constexpr std::size_t kOwn = SIZE_MAX; ///< as the least number: its check counts

struct BuiltinRow {
  Builtin function;
  const Type *(*check)(Context &c, CallExpr *expr); ///< null: not called by a name of its own
  std::size_t least = kOwn;                         ///< number of arguments
  std::size_t most = kOwn;
  BuiltinTakes takes = BuiltinTakes::values;
};

constexpr auto kRows = [] {
  using enum Builtin;
  return std::to_array<BuiltinRow>({
      {abs, checkAbs, 1, 1},
      {sqrt, checkRealFunction, 1, 1},
      {ln, checkRealFunction, 1, 1},
      {log, checkRealFunction, 1, 1},
      {exp, checkRealFunction, 1, 1},
      {sin, checkRealFunction, 1, 1},
      {cos, checkRealFunction, 1, 1},
      {tan, checkRealFunction, 1, 1},
      {asin, checkRealFunction, 1, 1},
      {acos, checkRealFunction, 1, 1},
      {atan, checkRealFunction, 1, 1},
      {atan2, checkPowerFunction, 2, 2},
      {expt, checkPowerFunction, 2, 2},
      {trunc, checkTrunc, 1, 1},
      {min, checkExtreme, 2, kAny},
      {max, checkExtreme, 2, kAny},
      {limit, checkExtreme, 3, 3},
      {sel, checkSel, 3, 3},
      {mux, checkMux, 2, kAny},
      {move, checkMove, 1, 1},
      {add, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {subtract, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {multiply, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {divide, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {greater, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {greaterEqual, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {equal, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {lessEqual, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {less, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {notEqual, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {multiplyTime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {multiplyLtime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {divideTime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {divideLtime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {logicalAnd, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {logicalOr, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {logicalXor, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {modulo, checkOperatorCall, kOwn, kOwn, BuiltinTakes::unchecked},
      {shl, checkShift, 2, 2},
      {shr, checkShift, 2, 2},
      {rol, checkShift, 2, 2},
      {ror, checkShift, 2, 2},
      {fromBcd, nullptr},
      {toBcd, nullptr},
      {isValidBcd, checkPatternCall},
      {isValid, checkPatternCall},
      {bigEndian, checkPatternCall},
      {littleEndian, checkPatternCall},
      {len, checkStringBuiltin},
      {left, checkStringBuiltin},
      {right, checkStringBuiltin},
      {mid, checkStringBuiltin},
      {concat, checkStringBuiltin},
      {insert, checkStringBuiltin},
      {deleteS, checkStringBuiltin},
      {replace, checkStringBuiltin},
      {find, checkStringBuiltin},
      {convert, nullptr},
      {ltime, checkClock, 0, 0},
      {time, checkClock, 0, 0},
      {adr, checkAdr, 1, 1, BuiltinTakes::openArrays},
      {bitadr, checkBitAddress},
      {sizeofT, checkSizeof, kOwn, kOwn, BuiltinTakes::unchecked},
      {queryInterface, checkQuery},
      {queryPointer, checkQuery},
      {newT, checkNew, kOwn, kOwn, BuiltinTakes::unchecked},
      {deleteT, checkDelete},
      {ini, checkIni},
      {indexOf, checkIndexOf, kOwn, kOwn, BuiltinTakes::unchecked},
      {isValidRef, checkIsValidRef},
      {lowerBound, checkBound, kOwn, kOwn, BuiltinTakes::openArrays},
      {upperBound, checkBound, kOwn, kOwn, BuiltinTakes::openArrays},
      {assertTrue, checkAssertion},
      {assertFalse, checkAssertion},
      {assertEq, checkAssertion},
      {assertNe, checkAssertion},
      {assertGt, checkAssertion},
      {assertGe, checkAssertion},
      {assertLt, checkAssertion},
      {assertLe, checkAssertion},
      {assertNear, checkAssertion},
      {failTest, checkAssertion},
  });
}();

/// Each function has its row, in the order of the enumeration.
constexpr bool isComplete() {
  for (std::size_t i = 0; i < kRows.size(); ++i)
    if (static_cast<std::size_t>(kRows[i].function) != i)
      return false;
  return kRows.size() == static_cast<std::size_t>(Builtin::failTest) + 1;
}
static_assert(isComplete());

} // namespace

const Type *checkBuiltin(Context &c, CallExpr *expr, const Type *expected) {
  const Type *bad = elementaryType(TypeKind::error);
  const BuiltinRow &row = kRows[static_cast<std::size_t>(expr->builtin)];
  bool failed = !placeArguments(c, expr);
  if (row.takes != BuiltinTakes::unchecked) {
    for (const Argument &a : expr->arguments) {
      if (a.value != nullptr && isError(check(c, a.value, expected)))
        failed = true;
    }
  }
  if (failed || row.check == nullptr)
    return bad;
  if (row.takes == BuiltinTakes::values &&
      std::any_of(expr->arguments.begin(), expr->arguments.end(),
                  [&](const Argument &a) { return refuseOpenArray(c, a.value, "use"); }))
    return bad;
  if (row.least != kOwn && !requireCount(c, expr, row.least, row.most))
    return bad;
  return row.check(c, expr);
}

} // namespace stc::sema
