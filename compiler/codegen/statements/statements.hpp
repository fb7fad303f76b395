#ifndef STRIDE_COMPILER_CODEGEN_STATEMENTS_STATEMENTS_HPP
#define STRIDE_COMPILER_CODEGEN_STATEMENTS_STATEMENTS_HPP
// Statements.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

void emitBlock(EmitContext &cx, ast::Block block);
void emitStatement(EmitContext &cx, const ast::Stmt *s);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_STATEMENTS_STATEMENTS_HPP
