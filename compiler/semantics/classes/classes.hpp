#pragma once
// Blocks as classes.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Looks up base and interfaces and makes symbols of the members; declares nothing.
void link(Context &c, PouSymbol *pou);
void declareMembers(Context &c, PouSymbol *pou, std::vector<VarSymbol *> &variables);
/// Whether members fit each other, the base and the interfaces.
void checkClass(Context &c, PouSymbol *pou);
ast::Access memberAccess(const PouSymbol *method);
void checkConstruct(Context &c, VarSymbol *variable);
void checkAfterInit(Context &c, PouSymbol *method);

} // namespace stc::sema
