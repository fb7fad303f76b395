#ifndef STRIDE_COMPILER_CODEGEN_CALLS_POOL_OBJECTS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_POOL_OBJECTS_HPP
// Objects in the pool: __NEW and __DELETE.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// Memory of the pool, with the defaults of its type.
void emitNew(EmitContext &cx, const ast::CallExpr *e);
/// The pointer is followed once, and 0 afterwards.
void emitDelete(EmitContext &cx, const ast::CallExpr *e);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_POOL_OBJECTS_HPP
