#ifndef STRIDE_COMPILER_SEMANTICS_CONFIG_CONFIG_HPP
#define STRIDE_COMPILER_SEMANTICS_CONFIG_CONFIG_HPP
// Addresses, and what CONFIGURATION, VAR_CONFIG and VAR_ACCESS say.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// `%IX0.0` as an expression.
const Type *checkDirect(Context &c, ast::DirectExpr *expr);
/// Gives a variable with an AT clause its location.
void placeVariable(Context &c, VarSymbol *variable);
/// Warns of a place in the inputs that is written.
void reportInputWritten(Context &c, const ast::Expr *expr, const Location &at);
/// BITADR
const Type *checkBitAddress(Context &c, ast::CallExpr *expr);
/// Reports RETAIN and PERSISTENT where there is nothing to keep.
void checkRetain(Context &c, const VarSymbol *variable);
/// Makes the types of the areas, when all addresses are known.
void finishImage(Context &c);
/// Notes the variables with {attribute 'consistent'}, and reports it where it does nothing.
void checkConsistent(Context &c, const ast::Decl *decl);
/// A value of the type holds variables declared `AT %I*`: VAR_CONFIG says where they lie, so that
/// it must live as long as the program.
bool hasSlots(Context &c, const Type *type);
/// VAR_CONFIG and VAR_ACCESS, and variables `AT %I*` that have no place.
void checkConfigured(Context &c, Module &module);
/// A CONFIGURATION has made the variable for an instance of a program.
bool isProgramInstance(const VarSymbol *variable);
/// `Main.x` where all instances of the program have other names.
void reportTemplate(Context &c, const ast::Name &name, const PouSymbol *program);
/// The instances of programs that a CONFIGURATION makes.
void resolveInstances(Context &c, Module &module);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CONFIG_CONFIG_HPP
