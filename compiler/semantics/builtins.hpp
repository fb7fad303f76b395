#pragma once
// Functions that the compiler implements itself (overloaded or operator-like, so that no ST
// declaration can say them).

#include "compiler/semantics/types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace stc {
namespace ast {

/// What codegen must emit. In a CallExpr to a builtin all arguments are positional, complete, and
/// carry their conversion in Expr::target; the result has Expr::type.
enum class Builtin : std::uint16_t {
  // numeric, one argument: ABS on any number, the others on LREAL or REAL
  abs,
  sqrt,
  ln,
  log,
  exp,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2, ///< (y, x)
  expt,  ///< (base, exponent): LREAL result unless REAL
  trunc, ///< real → DINT or, as TRUNC_Y, another integer; cut
  // selection; all value arguments are converted to the result type
  min,
  max,   ///< two or more arguments of one type
  limit, ///< (lower, x, upper)
  sel,   ///< (BOOL, if FALSE, if TRUE): both are evaluated
  mux,   ///< (index, value0, value1 …)
  move,
  // operators as functions: two arguments or, where `+` and the like can be repeated, more; all but
  // comparisons of more than two become `move` of the operator on the arguments
  add,
  subtract,
  multiply,
  divide,
  greater,
  greaterEqual,
  equal,
  lessEqual,
  less,
  notEqual,
  multiplyTime, ///< (TIME, number)
  multiplyLtime,
  divideTime,
  divideLtime,
  logicalAnd, ///< AND(a, b …), in front of a parenthesis where an operand is expected
  logicalOr,
  logicalXor,
  modulo,
  // bit strings: (value, count); the result has the value's type
  shl,
  shr,
  rol,
  ror,
  fromBcd,      ///< bit string of decimal digits → the call's type
  toBcd,        ///< unsigned integer → the call's type, a bit string of decimal digits
  isValidBcd,   ///< bit string → BOOL
  isValid,      ///< real → BOOL: neither NaN nor infinite
  bigEndian,    ///< the bytes in the opposite order
  littleEndian, ///< the argument: that is the order that all targets have
  // strings: on STRING(n) of any n; result type carries the length
  len,
  left,
  right,
  mid,
  concat,
  insert,
  deleteS,
  replace,
  find,
  convert, ///< X_TO_Y, TO_Y: from Expr::type of the argument (target is null) to the call's type
  ltime,   ///< LTIME(): the cycle's start as LTIME
  time,    ///< TIME(): the cycle's start as TIME
  adr,     ///< ADR(x): pointer to the argument's type
  bitadr,  ///< BITADR(x): the place of a located variable, always constant
  sizeofT, ///< SIZEOF(x), XSIZEOF(x): always a constant
  queryInterface, ///< __QUERYINTERFACE(instance or interface, interface variable)
  queryPointer,   ///< __QUERYPOINTER(instance or interface, pointer variable)
  newT,           ///< __NEW(type), __NEW(type, count): Expr::type of the first argument is the type
  deleteT,        ///< __DELETE(pointer): the pointer is 0 afterwards
  ini,            ///< INI(instance, BOOL): initial values once more; FALSE keeps retained variables
  indexOf,        ///< INDEXOF(pou): the POU's number, a constant
  isValidRef,     ///< __ISVALIDREF(r): the argument is a REFERENCE
  lowerBound,
  upperBound, ///< (array, dimension): a constant unless the array is ARRAY[*]
  // unit tests: all give BOOL, whether the demand is met; a message may follow
  assertTrue,  ///< (condition)
  assertFalse, ///< (condition)
  assertEq,    ///< (actual, expected)
  assertNe,
  assertGt,
  assertGe,
  assertLt,
  assertLe,
  assertNear, ///< (actual, expected, tolerance): LREAL
  failTest,   ///< () with a message that must be there
};

/// ASSERT_TRUE … FAIL
constexpr bool isAssertion(Builtin function) { return function >= Builtin::assertTrue; }

/// How many values stand in front of an assertion's message.
constexpr std::size_t assertedValues(Builtin function) {
  using enum Builtin;
  return function == failTest                                ? 0
         : function == assertTrue || function == assertFalse ? 1
         : function == assertNear                            ? 3
                                                             : 2;
}

} // namespace ast

/// All builtins with their lower-case names. Conversions (`INT_TO_REAL`, `TO_INT`) are not in this
/// table.
[[nodiscard]] const std::vector<std::pair<std::string_view, ast::Builtin>> &builtins();

/// The position of a formal parameter (`MN` of LIMIT is 0), or nothing. Both the standard's names
/// and those of V2.3's string functions (STR, SIZE, POS …) are known; `lowerName` is in lower case.
[[nodiscard]] std::optional<std::size_t> formalPosition(ast::Builtin function,
                                                        std::string_view lowerName);

/// The parts of a conversion's name.
struct ConversionName {
  const Type *from = nullptr; ///< null for `TO_Y`
  const Type *to = nullptr;
  ast::Builtin function = ast::Builtin::convert; ///< convert, trunc, fromBcd or toBcd
};
/// `X_TO_Y` / `TO_Y` with elementary type names (STRING is STRING(80)), or edition 3's
/// `X_TRUNC_Y`, `X_BCD_TO_Y`, `X_TO_BCD_Y` and their forms without X; or nothing.
[[nodiscard]] std::optional<ConversionName> findConversion(Ident name);

} // namespace stc
