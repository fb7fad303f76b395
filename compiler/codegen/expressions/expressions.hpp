#ifndef STRIDE_COMPILER_CODEGEN_EXPRESSIONS_EXPRESSIONS_HPP
#define STRIDE_COMPILER_CODEGEN_EXPRESSIONS_EXPRESSIONS_HPP
// Values: expressions in their own type, converted, and as operands.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// The value in the expression's own type.
void emitRaw(EmitContext &cx, const ast::Expr *e);
/// The value converted to Expr::target, to be stored in (or passed as) that type.
void emitValue(EmitContext &cx, const ast::Expr *e);
void emitValueAs(EmitContext &cx, const ast::Expr *e, const Type *type);
/// The value as an operand of arithmetic on `type`; `other` is the second operand or null.
void emitOperand(EmitContext &cx, const ast::Expr *e, const Type *type, const ast::Expr *other,
                 bool comparison);
/// A string of whatever length, for the runtime's string functions.
void emitText(EmitContext &cx, const ast::Expr *e);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_EXPRESSIONS_EXPRESSIONS_HPP
