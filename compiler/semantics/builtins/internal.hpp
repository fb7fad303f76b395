#pragma once
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

[[nodiscard]] std::string calleeName(const ast::CallExpr *expr);
/// The text that an argument is: edition 3 takes a CHAR where a text is put into another.
[[nodiscard]] const Type *textOf(const ast::Argument &a);
/// Puts named arguments of a standard function at their positions; false when something was
/// reported.
bool placeArguments(Context &c, ast::CallExpr *expr);
const Type *checkStringBuiltin(Context &c, ast::CallExpr *expr);
/// ADD, GT, MUL_TIME …: the operator with its rules.
const Type *checkOperatorCall(Context &c, ast::CallExpr *expr);
/// IS_VALID, IS_VALID_BCD, TO_BIG_ENDIAN …
const Type *checkPatternCall(Context &c, ast::CallExpr *expr);
/// The argument of TRUNC_Y, BCD_TO_Y, TO_BCD_Y; false when it has been reported.
bool checkSpecialArgument(Context &c, ast::CallExpr *expr);
const Type *commonOfArguments(Context &c, ast::CallExpr *expr, std::size_t first);
const Type *checkNew(Context &c, ast::CallExpr *expr);
const Type *checkDelete(Context &c, ast::CallExpr *expr);
const Type *checkIni(Context &c, ast::CallExpr *expr);
const Type *checkSizeof(Context &c, ast::CallExpr *expr);
const Type *checkIndexOf(Context &c, ast::CallExpr *expr);
const Type *checkBound(Context &c, ast::CallExpr *expr);
/// The type that an expression names (`INT`, `Lib.Block`), or null when it is not a type's name.
const Type *namedType(Context &c, ast::Expr *expr);
const Type *checkQuery(Context &c, ast::CallExpr *expr);
const Type *checkIsValidRef(Context &c, ast::CallExpr *expr);

} // namespace stc::sema
