#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void bindExternal(Context &c, PouSymbol *pou, ast::VarDecl *decl);

} // namespace stc::sema
