#pragma once
// Calls of functions that the compiler implements itself.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

const Type *checkBuiltin(Context &c, ast::CallExpr *expr, const Type *expected);
const Type *checkConversionCall(Context &c, ast::CallExpr *expr, const ConversionName &conversion);
bool requireCount(Context &c, ast::CallExpr *expr, std::size_t least, std::size_t most);
const Type *argumentError(Context &c, ast::CallExpr *expr, std::size_t index,
                          std::string_view wanted);
/// Gives a call whose arguments are all constants its value.
void foldCall(Context &c, ast::CallExpr *expr, const Type *result);

} // namespace stc::sema
