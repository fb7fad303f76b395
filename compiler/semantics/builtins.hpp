#ifndef STRIDE_COMPILER_SEMANTICS_BUILTINS_HPP
#define STRIDE_COMPILER_SEMANTICS_BUILTINS_HPP
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
enum class Builtin : uint16_t {
  // numeric, one argument: ABS on any number, the others on LREAL or REAL
  Abs,
  Sqrt,
  Ln,
  Log,
  Exp,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Atan2, ///< (y, x)
  Expt,  ///< (base, exponent): LREAL result unless REAL
  Trunc, ///< real → DINT or, as TRUNC_Y, another integer; cut
  // selection; all value arguments are converted to the result type
  Min,
  Max,   ///< two or more arguments of one type
  Limit, ///< (lower, x, upper)
  Sel,   ///< (BOOL, if FALSE, if TRUE): both are evaluated
  Mux,   ///< (index, value0, value1 …)
  Move,
  // operators as functions: two arguments or, where `+` and the like can be repeated, more; all but
  // comparisons of more than two become `move` of the operator on the arguments
  Add,
  Subtract,
  Multiply,
  Divide,
  Greater,
  GreaterEqual,
  Equal,
  LessEqual,
  Less,
  NotEqual,
  MultiplyTime, ///< (TIME, number)
  MultiplyLtime,
  DivideTime,
  DivideLtime,
  LogicalAnd, ///< AND(a, b …), in front of a parenthesis where an operand is expected
  LogicalOr,
  LogicalXor,
  Modulo,
  // bit strings: (value, count); the result has the value's type
  Shl,
  Shr,
  Rol,
  Ror,
  FromBcd,      ///< bit string of decimal digits → the call's type
  ToBcd,        ///< unsigned integer → the call's type, a bit string of decimal digits
  IsValidBcd,   ///< bit string → BOOL
  IsValid,      ///< real → BOOL: neither NaN nor infinite
  BigEndian,    ///< the bytes in the opposite order
  LittleEndian, ///< the argument: that is the order that all targets have
  // strings: on STRING(n) of any n; result type carries the length
  Len,
  Left,
  Right,
  Mid,
  Concat,
  Insert,
  Delete,
  Replace,
  Find,
  Convert, ///< X_TO_Y, TO_Y: from Expr::type of the argument (target is null) to the call's type
  Ltime,   ///< LTIME(): the cycle's start as LTIME
  Time,    ///< TIME(): the cycle's start as TIME
  Adr,     ///< ADR(x): pointer to the argument's type
  Bitadr,  ///< BITADR(x): the place of a located variable, always constant
  Sizeof,  ///< SIZEOF(x), XSIZEOF(x): always a constant
  QueryInterface, ///< __QUERYINTERFACE(instance or interface, interface variable)
  QueryPointer,   ///< __QUERYPOINTER(instance or interface, pointer variable)
  NewObject,      ///< __NEW(type), __NEW(type, count): Expr::type of the first argument is the type
  DeleteObject,   ///< __DELETE(pointer): the pointer is 0 afterwards
  Ini,            ///< INI(instance, BOOL): initial values once more; FALSE keeps retained variables
  IndexOf,        ///< INDEXOF(pou): the POU's number, a constant
  IsValidRef,     ///< __ISVALIDREF(r): the argument is a REFERENCE
  LowerBound,
  UpperBound, ///< (array, dimension): a constant unless the array is ARRAY[*]
  // unit tests: all give BOOL, whether the demand is met; a message may follow
  AssertTrue,  ///< (condition)
  AssertFalse, ///< (condition)
  AssertEq,    ///< (actual, expected)
  AssertNe,
  AssertGt,
  AssertGe,
  AssertLt,
  AssertLe,
  AssertNear, ///< (actual, expected, tolerance): LREAL
  FailTest,   ///< () with a message that must be there
};

/// ASSERT_TRUE … FAIL
constexpr bool isAssertion(Builtin function) { return function >= Builtin::AssertTrue; }

/// How many values stand in front of an assertion's message.
constexpr size_t assertedValues(Builtin function) {
  using enum Builtin;
  return function == FailTest                                ? 0
         : function == AssertTrue || function == AssertFalse ? 1
         : function == AssertNear                            ? 3
                                                             : 2;
}

} // namespace ast

/// All builtins with their lower-case names. Conversions (`INT_TO_REAL`, `TO_INT`) are not in this
/// table.
[[nodiscard]] const std::vector<std::pair<std::string_view, ast::Builtin>> &builtins();

/// The position of a formal parameter (`MN` of LIMIT is 0), or nothing. Both the standard's names
/// and those of V2.3's string functions (STR, SIZE, POS …) are known; `lowerName` is in lower case.
[[nodiscard]] std::optional<size_t> formalPosition(ast::Builtin function,
                                                   std::string_view lowerName);

/// The parts of a conversion's name.
struct ConversionName {
  const Type *from = nullptr; ///< null for `TO_Y`
  const Type *to = nullptr;
  ast::Builtin function = ast::Builtin::Convert; ///< convert, trunc, fromBcd or toBcd
};
/// `X_TO_Y` / `TO_Y` with elementary type names (STRING is STRING(80)), or edition 3's
/// `X_TRUNC_Y`, `X_BCD_TO_Y`, `X_TO_BCD_Y` and their forms without X; or nothing.
[[nodiscard]] std::optional<ConversionName> findConversion(Ident name);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_BUILTINS_HPP
