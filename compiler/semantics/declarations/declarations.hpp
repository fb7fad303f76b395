#pragma once
// Variables and POUs as they are declared, initial values.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void declare(Context &c, PouSymbol *pou);
void declare(Context &c, GlobalsSymbol *globals);
const Type *typeOf(Context &c, VarSymbol *variable);
void checkInitOf(Context &c, VarSymbol *variable);
ast::Expr *checkInit(Context &c, ast::Expr *init, const Type *type);
/// The field or variable of that name in a value of the type, which is declared; null: none.
VarSymbol *findMember(Context &c, const Type *type, Ident id);

} // namespace stc::sema
