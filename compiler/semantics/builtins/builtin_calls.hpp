#ifndef STRIDE_COMPILER_SEMANTICS_BUILTINS_BUILTIN_CALLS_HPP
#define STRIDE_COMPILER_SEMANTICS_BUILTINS_BUILTIN_CALLS_HPP
// Calls of functions that the compiler implements itself.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Checks the call of a built-in function (`expr->builtin`) and gives the type of its result.
const Type *checkBuiltin(Context &c, ast::CallExpr *expr, const Type *expected);
/// The same of X_TO_Y and its like.
const Type *checkConversionCall(Context &c, ast::CallExpr *expr, const ConversionName &conversion);
/// Reports another number of arguments than the function takes; false then.
bool requireCount(Context &c, ast::CallExpr *expr);
/// Reports an argument that is not what is wanted; gives the error type.
const Type *argumentError(Context &c, ast::CallExpr *expr, size_t index, std::string_view wanted);
/// Gives a call whose arguments are all constants its value.
void foldCall(Context &c, ast::CallExpr *expr, const Type *result);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_BUILTINS_BUILTIN_CALLS_HPP
