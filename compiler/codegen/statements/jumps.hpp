#ifndef STRIDE_COMPILER_CODEGEN_STATEMENTS_JUMPS_HPP
#define STRIDE_COMPILER_CODEGEN_STATEMENTS_JUMPS_HPP
// JMP, labels, __TRY.
//
// __TRY is a C++ try, but what __CATCH and __FINALLY hold is written after it: there may be jumps
// in them, and a fault of the memory guard must not leave a C++ handler open. `leave__N` says how
// the statements were left: 0 at their end, 1 with an exception, from 2 on with RETURN, EXIT,
// CONTINUE or JMP, which happens after __FINALLY.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

void emitJump(EmitContext &cx, const ast::JumpStmt *s);
void emitLabel(EmitContext &cx, const ast::LabelStmt *s);
void emitTry(EmitContext &cx, const ast::TryStmt *s);
/// A statement that leaves the innermost __TRY with __FINALLY goes there first; false: it does
/// not leave one.
[[nodiscard]] bool leaveTry(EmitContext &cx, const ast::Stmt *s);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_STATEMENTS_JUMPS_HPP
