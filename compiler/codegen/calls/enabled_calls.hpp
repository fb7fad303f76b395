#ifndef STRIDE_COMPILER_CODEGEN_CALLS_ENABLED_CALLS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_ENABLED_CALLS_HPP
// Calls of functions with EN and ENO.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// The call happens where EN is TRUE; elsewhere its value is 0 (FALSE, an empty text, a structure
/// of these), and its arguments are not evaluated. ENO becomes what EN is. Without a result it is a
/// statement.
void emitEnabledCall(EmitContext &cx, const ast::CallExpr *e);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_ENABLED_CALLS_HPP
