#ifndef STRIDE_COMPILER_SEMANTICS_FOLD_BUILTINS_HPP
#define STRIDE_COMPILER_SEMANTICS_FOLD_BUILTINS_HPP
// Standard functions of constants, computed by the functions that the generated code calls, so that
// both give the same bits.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/constant.hpp"
#include "compiler/source/arena.hpp"

#include <optional>
#include <span>

namespace stc {

/// A constant argument: its value, already of the type `type`.
struct ConstArgument {
  ConstValue value;
  const Type *type = nullptr;
};

/// The value of a call with constant arguments; its result has the type `result`. Nothing for
/// functions that only the run time knows, and where the call raises an exception.
[[nodiscard]] std::optional<ConstValue> foldBuiltin(ast::Builtin function,
                                                    std::span<const ConstArgument> arguments,
                                                    const Type *result, Arena &arena);

/// X_TO_Y of a constant, texts, times and dates included.
[[nodiscard]] std::optional<ConstValue> foldConversion(const ConstValue &value, const Type *from,
                                                       const Type *to, Arena &arena);

/// Below 0, 0 or above 0, as two texts compare at run time.
[[nodiscard]] int compareTexts(std::string_view a, std::string_view b, bool wide);

/// The first of them; 0 of an empty text.
[[nodiscard]] uint16_t firstUnit(std::string_view text, bool wide);
/// Number of places a text takes: characters of Latin-1, or units of UTF-16.
[[nodiscard]] size_t textLength(std::string_view text, bool wide);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_FOLD_BUILTINS_HPP
