#ifndef STRIDE_COMPILER_SEMANTICS_EXPRESSIONS_INTERNAL_HPP
#define STRIDE_COMPILER_SEMANTICS_EXPRESSIONS_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// The type that remembers what the operand was before widening.
[[nodiscard]] const Type *unwidened(const ast::Expr *e);
/// The kinds of expressions; see check().
const Type *checkLiteral(Context &c, ast::Literal *expr);
const Type *checkName(Context &c, ast::NameExpr *expr, const Type *expected);
const Type *checkMember(Context &c, ast::MemberExpr *expr);
const Type *checkBit(Context &c, ast::MemberExpr *expr);
const Type *checkIndex(Context &c, ast::IndexExpr *expr);
const Type *checkDeref(Context &c, ast::DerefExpr *expr);
const Type *checkEnumLiteral(Context &c, ast::EnumLiteralExpr *expr);
/// The type of a symbol used as a value by that expression and name.
const Type *useSymbol(Context &c, ast::Expr *expr, Symbol *symbol, const ast::Name &name);
/// The bit number that a constant gives (`w.cBit`), or nothing.
bool bitByName(Context &c, ast::MemberExpr *expr);
const Type *checkUnary(Context &c, ast::UnaryExpr *expr, const Type *expected);
const Type *checkBinary(Context &c, ast::BinaryExpr *expr, const Type *expected);
const Type *checkArithmetic(Context &c, ast::BinaryExpr *expr);
const Type *checkComparison(Context &c, ast::BinaryExpr *expr);
const Type *checkPower(Context &c, ast::BinaryExpr *expr);
/// Reports operands that the operator does not take.
const Type *operatorError(Context &c, ast::BinaryExpr *expr);
/// The common type of two operands of number type (constants take the other's type when they
/// fit), or null.
const Type *commonOf(ast::Expr *a, ast::Expr *b);
/// Sums and differences with addresses, in bytes.
const Type *checkPointerArithmetic(Context &c, ast::BinaryExpr *expr);
/// Gives the operands of a comparison with a pointer their common type; false: not comparable.
bool comparePointers(ast::BinaryExpr *expr);
/// Conversions between pointers and with integers, with their warnings; false: not one of them.
bool coercePointer(Context &c, ast::Expr *expr, const Type *type, std::string_view what);
/// The property that the expression names, or null.
PropertySymbol *propertyOf(const ast::Expr *expr);
/// The code belongs to the block, or to one that extends it.
[[nodiscard]] bool insideOf(Context &c, const PouSymbol *owner);
void reportPrivate(Context &c, const ast::MemberExpr *expr, const VarSymbol *member);
/// The type of a property that is read, or written when it is the target of an assignment.
const Type *useProperty(Context &c, ast::Expr *expr, PropertySymbol *property,
                        const ast::Name &name);
/// Converts to an interface; true when nothing more is to do.
bool coerceToInterface(Context &c, ast::Expr *expr, const Type *type);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_EXPRESSIONS_INTERNAL_HPP
