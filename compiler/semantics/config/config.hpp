#pragma once
// Addresses, and what CONFIGURATION, VAR_CONFIG and VAR_ACCESS say.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

const Type *checkDirect(Context &c, ast::DirectExpr *expr);
/// Gives a variable with an AT clause its location.
void placeVariable(Context &c, VarSymbol *variable);
void reportInputWritten(Context &c, const ast::Expr *expr, const Location &at);
const Type *checkBitAddress(Context &c, ast::CallExpr *expr);
/// Reports RETAIN and PERSISTENT where there is nothing to keep.
void checkRetain(Context &c, const VarSymbol *variable);
void finishImage(Context &c);
/// Notes the variables with {attribute 'consistent'}, and reports it where it does nothing.
void checkConsistent(Context &c, const ast::Decl *decl);
void checkConsistent(Context &c, std::span<ast::VarDecl *const> variables);
void checkConfigured(Context &c, Module &module);
bool isProgramInstance(const VarSymbol *variable);
/// `Main.x` where all instances of the program have other names.
void reportTemplate(Context &c, const ast::Name &name, const PouSymbol *program);
/// The instances of programs that a CONFIGURATION makes.
void resolveInstances(Context &c, Module &module);

} // namespace stc::sema
