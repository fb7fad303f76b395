#ifndef STRIDE_COMPILER_CODEGEN_EXPRESSIONS_SPECIAL_OPERATORS_HPP
#define STRIDE_COMPILER_CODEGEN_EXPRESSIONS_SPECIAL_OPERATORS_HPP
// Operators that are not C++ operators.

#include "compiler/codegen/context/context.hpp"
#include "compiler/codegen/cpp/part.hpp"

namespace stc::codegen {

/// `left` and `right` write the operands, already of the operator's type. Of texts it is what is
/// compared with 0.
void emitSpecial(EmitContext &cx, const ast::BinaryExpr *e, Part left, Part right);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_EXPRESSIONS_SPECIAL_OPERATORS_HPP
