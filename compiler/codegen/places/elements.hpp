#ifndef STRIDE_COMPILER_CODEGEN_PLACES_ELEMENTS_HPP
#define STRIDE_COMPILER_CODEGEN_PLACES_ELEMENTS_HPP
// Elements of arrays, characters of strings, what lies beside the target of a pointer.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// With `slotOnly` a reference among the elements is not followed.
void emitIndex(EmitContext &cx, const ast::IndexExpr *e, bool slotOnly);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_PLACES_ELEMENTS_HPP
