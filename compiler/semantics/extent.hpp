#pragma once
// Sizes and alignments of types, as the generated code has them.

#include "compiler/semantics/symbols.hpp"

#include <cstdint>

namespace stc {

struct Extent {
  std::uint64_t size = 0;  ///< bytes
  std::uint32_t align = 1; ///< bytes
};

/// Of elementary types, arrays, structures and pointers. Function blocks hold members that only the
/// code generator knows: their size is 0, their alignment an upper bound.
[[nodiscard]] Extent extentOf(const Type *type);

/// The alignment that the members of a structure or block are limited to; 0: none.
[[nodiscard]] unsigned packOf(const Type *type);

/// What the place of a variable is certainly a multiple of. Smaller than the alignment of its type
/// for members of packed structures and for variables at odd addresses.
[[nodiscard]] unsigned placeAlignment(const ast::Expr *place);

/// A reference to the place would be to a misaligned object.
[[nodiscard]] bool isMisaligned(const ast::Expr *place);

} // namespace stc
