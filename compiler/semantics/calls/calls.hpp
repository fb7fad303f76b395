#ifndef STRIDE_COMPILER_SEMANTICS_CALLS_CALLS_HPP
#define STRIDE_COMPILER_SEMANTICS_CALLS_CALLS_HPP
// Calls.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Checks a call and gives the type of its result. `asStatement`: no value is needed.
const Type *checkCall(Context &c, ast::CallExpr *expr, bool asStatement);
/// A REFERENCE TO input refers to a variable of exactly its type.
void checkReference(Context &c, ast::Expr *value, const Type *wanted);
/// A variable of type `type` may stand where one of `wanted` is referred to.
bool refersTo(const Type *type, const Type *wanted);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_CALLS_CALLS_HPP
