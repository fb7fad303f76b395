#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void checkBlock(Context &c, ast::Block block);
void checkCase(Context &c, ast::CaseStmt *stmt);
/// Binds each JMP of a body to its label.
void checkJumps(Context &c, ast::Block body);
void checkTry(Context &c, ast::TryStmt *stmt);

} // namespace stc::sema
