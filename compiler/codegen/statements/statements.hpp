#pragma once
// Statements.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

void emitBlock(EmitContext &cx, ast::Block block);
void emitStatement(EmitContext &cx, const ast::Stmt *s);

} // namespace stc::codegen
