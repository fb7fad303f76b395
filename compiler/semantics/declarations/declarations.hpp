#pragma once
// Variables and POUs as they are declared, initial values.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void declare(Context &c, PouSymbol *pou);
void declare(Context &c, GlobalsSymbol *globals);
const Type *typeOf(Context &c, VarSymbol *variable);
VarSymbol *makeVariable(Context &c, ast::VarDecl *decl, Module &module, PouSymbol *owner);
void checkInitOf(Context &c, VarSymbol *variable);
ast::Expr *checkInit(Context &c, ast::Expr *init, const Type *type);

} // namespace stc::sema
