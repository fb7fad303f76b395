#ifndef STRIDE_COMPILER_SEMANTICS_CONVERSIONS_HPP
#define STRIDE_COMPILER_SEMANTICS_CONVERSIONS_HPP
// Which type converts to which without being asked (dialect table: "implicit conversion").

#include "compiler/semantics/constant.hpp"
#include "compiler/semantics/types.hpp"

namespace stc {

enum class Conversion : uint8_t {
  Identity,
  Free,      ///< every value survives
  Lossy,     ///< allowed with a warning
  Narrowing, ///< an error that names the `X_TO_Y` to write
  Forbidden, ///< no such conversion
};

/// How a value of `from` (not a constant) becomes a value of `to`.
[[nodiscard]] Conversion classify(const Type *from, const Type *to);

/// Arrays of the same elements and sizes, whatever their bounds.
[[nodiscard]] bool sameShape(const Type *a, const Type *b);

/// Whether a constant of elementary type fits into `to`, so that it converts silently.
[[nodiscard]] bool constantFits(const ConstValue &value, const Type *from, const Type *to);

/// The smallest integer type of at least 8 bits that holds the value: SINT, USINT, INT … for an
/// untyped constant.
[[nodiscard]] const Type *smallestInteger(int64_t value);

/// The type that holds all values of both number types before widening; null when there is none
/// (LINT with ULINT). Constants without type have been given one before.
[[nodiscard]] const Type *commonNumber(const Type *a, const Type *b);

/// Arithmetic is done on at least 32 bits: integers under 32 bits become DINT, bit strings DWORD.
[[nodiscard]] const Type *widened(const Type *t);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_CONVERSIONS_HPP
