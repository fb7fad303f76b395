#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void bindArguments(Context &c, ast::CallExpr *expr, PouSymbol *pou);
/// The method that a callee of the form `instance.m` names, or null; `base` becomes the type of
/// `instance` when that has been checked.
PouSymbol *methodOf(Context &c, ast::Expr *callee, const Type *&base);
const Type *checkMethodCall(Context &c, ast::CallExpr *expr, PouSymbol *method);

} // namespace stc::sema
