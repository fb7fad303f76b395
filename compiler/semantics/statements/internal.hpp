#ifndef STRIDE_COMPILER_SEMANTICS_STATEMENTS_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_STATEMENTS_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// The statements of a block, one after the other.
void checkBlock(Context &c, ast::Block block);
/// CASE: labels are constants, each value has one branch.
void checkCase(Context &c, ast::CaseStmt *stmt);
/// Binds each JMP of a body to its label.
void checkJumps(Context &c, ast::Block body);
/// __TRY: its variable is one that an exception fits.
void checkTry(Context &c, ast::TryStmt *stmt);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_STATEMENTS_INTERNAL_HPP
