#ifndef STRIDE_COMPILER_SEMANTICS_CLASSES_CLASSES_HPP
#define STRIDE_COMPILER_SEMANTICS_CLASSES_CLASSES_HPP
// Blocks as classes.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Looks up base and interfaces and makes symbols of the members; declares nothing.
void link(Context &c, PouSymbol *pou);
/// Declares methods and properties; what lives in instances (VAR_INST) is added to `variables`.
void declareMembers(Context &c, PouSymbol *pou, std::vector<VarSymbol *> &variables);
/// Whether members fit each other, the base and the interfaces.
void checkClass(Context &c, PouSymbol *pou);
/// Who may use a method; an accessor has what its property says unless it says something itself.
ast::Access memberAccess(const PouSymbol *method);
/// Whether a variable's arguments are what FB_Init of its block takes.
void checkConstruct(Context &c, VarSymbol *variable);
/// Gives an instance's arguments to the inputs of its block's FB_Init, or reports at `span` what
/// does not fit.
void bindConstruct(Context &c, std::span<ast::Argument> arguments, PouSymbol *pou, Span span);
/// Reports a method with {attribute 'call_after_init'} that needs inputs.
void checkAfterInit(Context &c, PouSymbol *method);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CLASSES_CLASSES_HPP
