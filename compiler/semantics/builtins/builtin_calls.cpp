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
enum class BuiltinTakes : uint8_t {
  Values,
  OpenArrays, ///< also an ARRAY[*] as a whole
  Unchecked,  ///< its check looks at them itself: they may be types
};

constexpr size_t kAny = SIZE_MAX;
constexpr size_t kOwn = SIZE_MAX; ///< as the least number: its check counts

struct BuiltinRow {
  Builtin function;
  const Type *(*check)(Context &c, CallExpr *expr); ///< null: not called by a name of its own
  size_t least = kOwn;                              ///< number of arguments
  size_t most = kOwn;
  BuiltinTakes takes = BuiltinTakes::Values;
};

constexpr auto kRows = [] {
  using enum Builtin;
  return std::to_array<BuiltinRow>({
      {Abs, checkAbs, 1, 1},
      {Sqrt, checkRealFunction, 1, 1},
      {Ln, checkRealFunction, 1, 1},
      {Log, checkRealFunction, 1, 1},
      {Exp, checkRealFunction, 1, 1},
      {Sin, checkRealFunction, 1, 1},
      {Cos, checkRealFunction, 1, 1},
      {Tan, checkRealFunction, 1, 1},
      {Asin, checkRealFunction, 1, 1},
      {Acos, checkRealFunction, 1, 1},
      {Atan, checkRealFunction, 1, 1},
      {Atan2, checkPowerFunction, 2, 2},
      {Expt, checkPowerFunction, 2, 2},
      {Trunc, checkTrunc, 1, 1},
      {Min, checkExtreme, 2, kAny},
      {Max, checkExtreme, 2, kAny},
      {Limit, checkExtreme, 3, 3},
      {Sel, checkSel, 3, 3},
      {Mux, checkMux, 2, kAny},
      {Move, checkMove, 1, 1},
      {Add, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Subtract, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Multiply, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Divide, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Greater, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {GreaterEqual, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Equal, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {LessEqual, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Less, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {NotEqual, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {MultiplyTime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {MultiplyLtime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {DivideTime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {DivideLtime, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {LogicalAnd, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {LogicalOr, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {LogicalXor, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Modulo, checkOperatorCall, kOwn, kOwn, BuiltinTakes::Unchecked},
      {Shl, checkShift, 2, 2},
      {Shr, checkShift, 2, 2},
      {Rol, checkShift, 2, 2},
      {Ror, checkShift, 2, 2},
      {FromBcd, nullptr},
      {ToBcd, nullptr},
      {IsValidBcd, checkPatternCall},
      {IsValid, checkPatternCall},
      {BigEndian, checkPatternCall},
      {LittleEndian, checkPatternCall},
      {Len, checkStringBuiltin},
      {Left, checkStringBuiltin},
      {Right, checkStringBuiltin},
      {Mid, checkStringBuiltin},
      {Concat, checkStringBuiltin},
      {Insert, checkStringBuiltin},
      {Delete, checkStringBuiltin},
      {Replace, checkStringBuiltin},
      {Find, checkStringBuiltin},
      {Convert, nullptr},
      {Ltime, checkClock, 0, 0},
      {Time, checkClock, 0, 0},
      {Adr, checkAdr, 1, 1, BuiltinTakes::OpenArrays},
      {Bitadr, checkBitAddress},
      {Sizeof, checkSizeof, kOwn, kOwn, BuiltinTakes::Unchecked},
      {QueryInterface, checkQuery},
      {QueryPointer, checkQuery},
      {NewObject, checkNew, kOwn, kOwn, BuiltinTakes::Unchecked},
      {DeleteObject, checkDelete},
      {Ini, checkIni},
      {IndexOf, checkIndexOf, kOwn, kOwn, BuiltinTakes::Unchecked},
      {IsValidRef, checkIsValidRef},
      {LowerBound, checkBound, kOwn, kOwn, BuiltinTakes::OpenArrays},
      {UpperBound, checkBound, kOwn, kOwn, BuiltinTakes::OpenArrays},
      {AssertTrue, checkAssertion},
      {AssertFalse, checkAssertion},
      {AssertEq, checkAssertion},
      {AssertNe, checkAssertion},
      {AssertGt, checkAssertion},
      {AssertGe, checkAssertion},
      {AssertLt, checkAssertion},
      {AssertLe, checkAssertion},
      {AssertNear, checkAssertion},
      {FailTest, checkAssertion},
  });
}();

/// Each function has its row, in the order of the enumeration.
constexpr bool isComplete() {
  for (size_t i = 0; i < kRows.size(); ++i)
    if (static_cast<size_t>(kRows[i].function) != i)
      return false;
  return kRows.size() == static_cast<size_t>(Builtin::FailTest) + 1;
}
static_assert(isComplete());

} // namespace

const Type *checkBuiltin(Context &c, CallExpr *expr, const Type *expected) {
  const Type *bad = elementaryType(TypeKind::Error);
  const BuiltinRow &row = kRows[static_cast<size_t>(expr->builtin)];
  bool failed = !placeArguments(c, expr);
  if (row.takes != BuiltinTakes::Unchecked) {
    for (const Argument &a : expr->arguments) {
      if (a.value != nullptr && isError(check(c, a.value, expected)))
        failed = true;
    }
  }
  if (failed || row.check == nullptr)
    return bad;
  if (row.takes == BuiltinTakes::Values &&
      std::any_of(expr->arguments.begin(), expr->arguments.end(),
                  [&](const Argument &a) { return refuseOpenArray(c, a.value, "use"); }))
    return bad;
  if (row.least != kOwn && !requireCount(c, expr, row.least, row.most))
    return bad;
  return row.check(c, expr);
}

} // namespace stc::sema
