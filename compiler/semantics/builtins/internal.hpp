#ifndef STRIDE_COMPILER_SEMANTICS_BUILTINS_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_BUILTINS_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/type_table.hpp"

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
/// The argument of TRUNC_Y, BCD_TO_Y, TO_BCD_Y; false when it has been reported.
bool checkSpecialArgument(Context &c, ast::CallExpr *expr);
/// Converts the arguments from that one on to their common type and gives it.
const Type *commonOfArguments(Context &c, ast::CallExpr *expr, size_t first);
/// The type that an expression names (`INT`, `Lib.Block`), or null when it is not a type's name.
const Type *namedType(Context &c, ast::Expr *expr);

// -------------------------------------------------------------------------------------------------
// The checks that the rows of builtins.def name. But for operands, types and names, which a check
// looks at itself, the arguments are as many as the row says, have types, and are no ARRAY[*] where
// the row takes none.

/// ABS, SQRT … ATAN, ATAN2 and EXPT, TRUNC, IS_VALID
const Type *checkAbs(Context &c, ast::CallExpr *expr);
const Type *checkRealFunction(Context &c, ast::CallExpr *expr);
const Type *checkPowerFunction(Context &c, ast::CallExpr *expr);
const Type *checkTrunc(Context &c, ast::CallExpr *expr);
const Type *checkIsValid(Context &c, ast::CallExpr *expr);
/// MIN, MAX, LIMIT; SEL; MUX; MOVE
const Type *checkExtreme(Context &c, ast::CallExpr *expr);
const Type *checkSel(Context &c, ast::CallExpr *expr);
const Type *checkMux(Context &c, ast::CallExpr *expr);
const Type *checkMove(Context &c, ast::CallExpr *expr);

/// The operator that a function stands for.
struct OperatorFunction {
  ast::BinaryOp op;
  TypeKind duration = TypeKind::None; ///< of the first argument, where only that is allowed
  bool isWord = false;                ///< its name is the operator, too
};
const Type *checkOperatorFunction(Context &c, ast::CallExpr *expr,
                                  const OperatorFunction &function);
/// ADD, GT …
template <ast::BinaryOp op> const Type *checkOperator(Context &c, ast::CallExpr *expr) {
  return checkOperatorFunction(c, expr, {op});
}
/// AND, OR, XOR, MOD
template <ast::BinaryOp op> const Type *checkOperatorWord(Context &c, ast::CallExpr *expr) {
  return checkOperatorFunction(c, expr, {op, TypeKind::None, true});
}
/// MUL_TIME, DIV_LTIME …
template <ast::BinaryOp op, TypeKind duration>
const Type *checkDuration(Context &c, ast::CallExpr *expr) {
  return checkOperatorFunction(c, expr, {op, duration});
}

/// SHL, SHR, ROL, ROR; IS_VALID_BCD; TO_BIG_ENDIAN …
const Type *checkShift(Context &c, ast::CallExpr *expr);
const Type *checkIsValidBcd(Context &c, ast::CallExpr *expr);
const Type *checkByteOrder(Context &c, ast::CallExpr *expr);

/// Texts of one kind are the first `texts` arguments, numbers of characters all others; the result
/// has room for all the texts.
const Type *checkTexts(Context &c, ast::CallExpr *expr, size_t texts);
/// The same, but the result is a number of characters of the first text.
const Type *checkTextsForNumber(Context &c, ast::CallExpr *expr, size_t texts);
/// LEFT, RIGHT, MID, DELETE; INSERT, REPLACE
template <size_t texts> const Type *checkTextFunction(Context &c, ast::CallExpr *expr) {
  return checkTexts(c, expr, texts);
}
/// LEN, FIND
template <size_t texts> const Type *checkTextNumber(Context &c, ast::CallExpr *expr) {
  return checkTextsForNumber(c, expr, texts);
}
const Type *checkConcat(Context &c, ast::CallExpr *expr);

/// TIME(), LTIME()
template <TypeKind kind> const Type *checkClock(Context &, ast::CallExpr *) {
  return elementaryType(kind);
}
const Type *checkAdr(Context &c, ast::CallExpr *expr);
/// SIZEOF, INDEXOF
const Type *checkSizeof(Context &c, ast::CallExpr *expr);
const Type *checkIndexOf(Context &c, ast::CallExpr *expr);
/// __POUNAME, __POSITION
const Type *checkPouName(Context &c, ast::CallExpr *expr);
const Type *checkPosition(Context &c, ast::CallExpr *expr);
/// LOWER_BOUND and UPPER_BOUND
const Type *checkBoundOf(Context &c, ast::CallExpr *expr, int64_t ArrayType::*bound);
template <int64_t ArrayType::*bound> const Type *checkBound(Context &c, ast::CallExpr *expr) {
  return checkBoundOf(c, expr, bound);
}
/// __NEW, __DELETE, INI
const Type *checkNew(Context &c, ast::CallExpr *expr);
const Type *checkDelete(Context &c, ast::CallExpr *expr);
const Type *checkAtomicAdd(Context &c, ast::CallExpr *expr);
const Type *checkIni(Context &c, ast::CallExpr *expr);
/// __ISVALIDREF
const Type *checkIsValidRef(Context &c, ast::CallExpr *expr);
/// __QUERYINTERFACE, __QUERYPOINTER: what the second argument is
const Type *checkQueryFor(Context &c, ast::CallExpr *expr, TypeKind wanted);
template <TypeKind wanted> const Type *checkQuery(Context &c, ast::CallExpr *expr) {
  return checkQueryFor(c, expr, wanted);
}
/// ASSERT_TRUE … FAIL
const Type *checkAssertion(Context &c, ast::CallExpr *expr);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_BUILTINS_INTERNAL_HPP
