#ifndef STRIDE_COMPILER_SEMANTICS_ALIGNMENT_HPP
#define STRIDE_COMPILER_SEMANTICS_ALIGNMENT_HPP
// Where values may lie: alignments of types and of places, as the generated code has them. Sizes
// and offsets: storage.hpp.

#include "compiler/semantics/symbols.hpp"

namespace stc {

/// In bytes. Of function blocks, whose hidden members only Storage knows, an upper bound.
[[nodiscard]] unsigned alignmentOf(const Type *type);

/// The alignment that the members of a structure or block are limited to; 0: none.
[[nodiscard]] unsigned packOf(const Type *type);

/// What the place of a variable is certainly a multiple of. Smaller than the alignment of its type
/// for members of packed structures and for variables at odd addresses.
[[nodiscard]] unsigned placeAlignment(const ast::Expr *place);

/// A reference to the place would be to a misaligned object.
[[nodiscard]] bool isMisaligned(const ast::Expr *place);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_ALIGNMENT_HPP
