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
  trunc, ///< real → DINT, cut
  // selection; all value arguments are converted to the result type
  min,
  max,   ///< two or more arguments of one type
  limit, ///< (lower, x, upper)
  sel,   ///< (BOOL, if FALSE, if TRUE): both are evaluated
  mux,   ///< (index, value0, value1 …)
  move,
  // bit strings: (value, count); the result has the value's type
  shl,
  shr,
  rol,
  ror,
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
};

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
};
/// `X_TO_Y` / `TO_Y` with elementary type names (STRING is STRING(80)), or nothing.
[[nodiscard]] std::optional<ConversionName> findConversion(Ident name);

} // namespace stc
