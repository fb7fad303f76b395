#ifndef STRIDE_COMPILER_CODEGEN_EXPRESSIONS_OPERATORS_HPP
#define STRIDE_COMPILER_CODEGEN_EXPRESSIONS_OPERATORS_HPP
// Operators, their parentheses and the order in which their operands are evaluated.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

void emitUnary(EmitContext &cx, const ast::UnaryExpr *e);
void emitBinary(EmitContext &cx, const ast::BinaryExpr *e);
/// What is written for the expression: `+x` is x, pairs of one operator cancel (NOT NOT x).
[[nodiscard]] const ast::Expr *shown(const ast::Expr *e);
/// C++ converts the operand to `type` by itself; `other` is the second operand or null.
[[nodiscard]] bool isImplicitOperand(const ast::Expr *e, const Type *type, const ast::Expr *other,
                                     bool compared);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_EXPRESSIONS_OPERATORS_HPP
