#ifndef STRIDE_COMPILER_SEMANTICS_CALLS_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_CALLS_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Gives the arguments to the parameters; reports what does not fit and what is missing.
void bindArguments(Context &c, ast::CallExpr *expr, PouSymbol *pou);
/// A call of a function with EN or ENO: it becomes one of Builtin::Enabled. Null: it is none, as a
/// POU may have parameters of these names itself.
const Type *checkEnabledCall(Context &c, ast::CallExpr *expr, bool asStatement);
/// The method that a callee of the form `instance.m` names, or null; `base` becomes the type of
/// `instance` when that has been checked.
PouSymbol *methodOf(Context &c, ast::Expr *callee, const Type *&base);
/// Checks a call of that method and gives the type of its result.
const Type *checkMethodCall(Context &c, ast::CallExpr *expr, PouSymbol *method);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CALLS_INTERNAL_HPP
