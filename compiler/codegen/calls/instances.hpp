#ifndef STRIDE_COMPILER_CODEGEN_CALLS_INSTANCES_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_INSTANCES_HPP
// Instances as a whole: copies of them, and INI, which gives them their initial values once more.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// It is, or holds, a block with a VAR_IN_OUT.
[[nodiscard]] bool holdsInOut(const Type *type);
/// The blocks that extend `base` at any depth and can have instances.
[[nodiscard]] std::vector<const PouSymbol *> derivedBlocks(const Program &program,
                                                           const PouSymbol *base);
/// A structure, block or array as a value. A copy has the type id of what it is, not of what it was
/// taken from, and none of its bindings.
void emitCopy(EmitContext &cx, const ast::Expr *e, const Type *type);
/// INI
void emitReinitialise(EmitContext &cx, const ast::CallExpr *e);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_INSTANCES_HPP
