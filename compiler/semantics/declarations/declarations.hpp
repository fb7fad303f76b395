#ifndef STRIDE_COMPILER_SEMANTICS_DECLARATIONS_DECLARATIONS_HPP
#define STRIDE_COMPILER_SEMANTICS_DECLARATIONS_DECLARATIONS_HPP
// Variables and POUs as they are declared, initial values.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Makes symbols with types of the variables, members and the result, those of the bases included.
/// Does it once.
void declare(Context &c, PouSymbol *pou);
/// The same of a list of global variables.
void declare(Context &c, GlobalsSymbol *globals);
/// The type of a variable, resolved when it is asked for first; reports circles.
const Type *typeOf(Context &c, VarSymbol *variable);
/// Checks the initial value, once; a CONSTANT has its value then.
void checkInitOf(Context &c, VarSymbol *variable);
/// Checks an initial value for the type and gives it back in the form that code generation takes.
ast::Expr *checkInit(Context &c, ast::Expr *init, const Type *type);
/// The field or variable of that name in a value of the type, which is declared; null: none.
VarSymbol *findMember(Context &c, const Type *type, Ident id);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_DECLARATIONS_DECLARATIONS_HPP
