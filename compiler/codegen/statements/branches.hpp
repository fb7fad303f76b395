#ifndef STRIDE_COMPILER_CODEGEN_STATEMENTS_BRANCHES_HPP
#define STRIDE_COMPILER_CODEGEN_STATEMENTS_BRANCHES_HPP
// IF and CASE.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

void emitIf(EmitContext &cx, const ast::IfStmt *s);
void emitCase(EmitContext &cx, const ast::CaseStmt *s);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_STATEMENTS_BRANCHES_HPP
