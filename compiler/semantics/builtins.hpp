#ifndef STRIDE_COMPILER_SEMANTICS_BUILTINS_HPP
#define STRIDE_COMPILER_SEMANTICS_BUILTINS_HPP
// Functions that the compiler implements itself (overloaded or operator-like, so that no ST
// declaration can say them). All that is known of one is its row in builtins.def.

#include "compiler/semantics/types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace stc {
namespace ast {

struct Expr;

/// What codegen must emit. In a CallExpr to a builtin all arguments are positional, complete, and
/// carry their conversion in Expr::target; the result has Expr::type.
enum class Builtin : uint16_t {
#define STC_BUILTIN(enumerator, ...) enumerator,
#include "compiler/semantics/builtins.def"
};

} // namespace ast

/// What the arguments of a built-in function are, and what becomes of them.
enum class BuiltinTakes : uint8_t {
  Values,    ///< they are read
  Operands,  ///< the same; they are checked as operands of an operator
  TypeOf,    ///< a type or what has one: it is not evaluated
  Name,      ///< of a type or POU: it is not evaluated
  Bounds,    ///< those of an array, which may be an ARRAY[*], and the number of a dimension
  Reference, ///< the reference itself, not what it refers to
  Location,  ///< the place of a variable with an address
  Address,   ///< the address of the first, which may be an ARRAY[*]
  Instance,  ///< the first is given its initial values
  Query,     ///< the second refers to the first afterwards
  Pointer,   ///< to an object that is deleted; it is 0 afterwards
  Enabled,   ///< EN, a call of a function that happens only then, and where ENO goes
};

/// What checker, lints and code generation ask of a built-in function.
struct BuiltinRow {
  /// What a call does besides giving a value of its arguments.
  enum Effect : unsigned {
    kReads = 1,   ///< depends on more than its arguments
    kRaises = 2,  ///< may raise an exception, whatever its arguments are
    kCalls = 4,   ///< may change variables
    kSelects = 8, ///< evaluates one of its arguments after the first only, which that one selects
    kShiftsOut = 16, ///< loses bits: a count of the width or more leaves none
    kSaturates = 32, ///< what its type does not hold becomes the nearest that it holds
  };
  struct Arguments {
    BuiltinTakes what;
    size_t least; ///< how many; SIZE_MAX: without limit
    size_t most;
    std::string_view formals; ///< see builtins.def
  };

  std::string_view name; ///< in capitals; empty: conversions, whose names follow a pattern
  Arguments takes;
  unsigned does; ///< of Effect

  /// The arguments are evaluated, and nothing else becomes of them.
  [[nodiscard]] constexpr bool readsValues() const {
    return takes.what == BuiltinTakes::Values || takes.what == BuiltinTakes::Operands;
  }
  /// A call does nothing but give a value of the values that its arguments have.
  [[nodiscard]] constexpr bool onlyComputes() const {
    return readsValues() && (does & kCalls) == 0;
  }
};
[[nodiscard]] const BuiltinRow &builtinRow(ast::Builtin function);

/// How many values stand before the message of ASSERT_TRUE … FAIL.
[[nodiscard]] inline size_t assertedValues(ast::Builtin assertion) {
  return builtinRow(assertion).takes.most - 1;
}

struct BuiltinName {
  std::string_view name; ///< in capitals
  ast::Builtin function;
};
/// All names of built-in functions, each once. Conversions (`INT_TO_REAL`, `TO_INT`) are not among
/// them.
[[nodiscard]] std::span<const BuiltinName> builtinNames();

/// The position of a formal parameter (`MN` of LIMIT is 0), or nothing. Both the standard's names
/// and those of V2.3's string functions (STR, SIZE, POS …) are known; `lowerName` is in lower case.
[[nodiscard]] std::optional<size_t> formalPosition(ast::Builtin function,
                                                   std::string_view lowerName);

/// `x` of `ADR(x)`; null: the value is no such call.
[[nodiscard]] ast::Expr *addressed(const ast::Expr *value);

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
