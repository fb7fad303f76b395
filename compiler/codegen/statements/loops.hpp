#ifndef STRIDE_COMPILER_CODEGEN_STATEMENTS_LOOPS_HPP
#define STRIDE_COMPILER_CODEGEN_STATEMENTS_LOOPS_HPP
// Loops.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// FOR, WHILE, REPEAT; the variables that only the outermost loop can reach are kept in C++ locals
/// meanwhile.
void emitLoop(EmitContext &cx, const ast::Stmt *s);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_STATEMENTS_LOOPS_HPP
