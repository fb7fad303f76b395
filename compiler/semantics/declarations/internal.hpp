#ifndef STRIDE_COMPILER_SEMANTICS_DECLARATIONS_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_DECLARATIONS_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Makes a VAR_EXTERNAL stand for its global variable.
void bindExternal(Context &c, PouSymbol *pou, ast::VarDecl *decl);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_DECLARATIONS_INTERNAL_HPP
