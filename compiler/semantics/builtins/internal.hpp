#ifndef STRIDE_COMPILER_SEMANTICS_BUILTINS_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_BUILTINS_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// The value of an argument. All of them are there and by position, see placeArguments().
[[nodiscard]] inline ast::Expr *valueOf(const ast::CallExpr *expr, size_t index) {
  return expr->arguments[index].value;
}
/// Its type, without a range or the name of an enumeration.
[[nodiscard]] inline const Type *kindOf(const ast::CallExpr *expr, size_t index) {
  return underlying(valueOf(expr, index)->type);
}
/// The same; a constant gets a type of its own.
const Type *settledKindOf(const ast::CallExpr *expr, size_t index);

/// The function as it is called.
[[nodiscard]] std::string calleeName(const ast::CallExpr *expr);
/// The text that an argument is: edition 3 takes a CHAR where a text is put into another.
[[nodiscard]] const Type *textOf(const ast::Argument &a);
/// Puts named arguments of a standard function at their positions; false when something was
/// reported.
bool placeArguments(Context &c, ast::CallExpr *expr);
/// LEN, LEFT … FIND
const Type *checkStringBuiltin(Context &c, ast::CallExpr *expr);
/// ADD, GT, MUL_TIME …: the operator with its rules.
const Type *checkOperatorCall(Context &c, ast::CallExpr *expr);
/// IS_VALID, IS_VALID_BCD, TO_BIG_ENDIAN …
const Type *checkPatternCall(Context &c, ast::CallExpr *expr);
/// The argument of TRUNC_Y, BCD_TO_Y, TO_BCD_Y; false when it has been reported.
bool checkSpecialArgument(Context &c, ast::CallExpr *expr);
/// Converts the arguments from that one on to their common type and gives it.
const Type *commonOfArguments(Context &c, ast::CallExpr *expr, size_t first);
/// ABS, SQRT … ATAN, ATAN2 and EXPT, TRUNC.
const Type *checkAbs(Context &c, ast::CallExpr *expr);
const Type *checkRealFunction(Context &c, ast::CallExpr *expr);
const Type *checkPowerFunction(Context &c, ast::CallExpr *expr);
const Type *checkTrunc(Context &c, ast::CallExpr *expr);
/// SHL, SHR, ROL, ROR
const Type *checkShift(Context &c, ast::CallExpr *expr);
/// MIN, MAX, LIMIT; SEL; MUX; MOVE
const Type *checkExtreme(Context &c, ast::CallExpr *expr);
const Type *checkSel(Context &c, ast::CallExpr *expr);
const Type *checkMux(Context &c, ast::CallExpr *expr);
const Type *checkMove(Context &c, ast::CallExpr *expr);
/// TIME(), LTIME()
const Type *checkClock(Context &c, ast::CallExpr *expr);
const Type *checkAdr(Context &c, ast::CallExpr *expr);
/// ASSERT_TRUE … FAIL
const Type *checkAssertion(Context &c, ast::CallExpr *expr);
/// __NEW, __DELETE, INI
const Type *checkNew(Context &c, ast::CallExpr *expr);
const Type *checkDelete(Context &c, ast::CallExpr *expr);
const Type *checkIni(Context &c, ast::CallExpr *expr);
/// SIZEOF, INDEXOF, LOWER_BOUND and UPPER_BOUND
const Type *checkSizeof(Context &c, ast::CallExpr *expr);
const Type *checkIndexOf(Context &c, ast::CallExpr *expr);
const Type *checkBound(Context &c, ast::CallExpr *expr);
/// The type that an expression names (`INT`, `Lib.Block`), or null when it is not a type's name.
const Type *namedType(Context &c, ast::Expr *expr);
/// __QUERYINTERFACE and __QUERYPOINTER, __ISVALIDREF
const Type *checkQuery(Context &c, ast::CallExpr *expr);
const Type *checkIsValidRef(Context &c, ast::CallExpr *expr);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_BUILTINS_INTERNAL_HPP
