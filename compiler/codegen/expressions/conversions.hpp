#ifndef STRIDE_COMPILER_CODEGEN_EXPRESSIONS_CONVERSIONS_HPP
#define STRIDE_COMPILER_CODEGEN_EXPRESSIONS_CONVERSIONS_HPP
// Conversions around code that something else writes.

#include "compiler/codegen/context/context.hpp"
#include "compiler/codegen/cpp/part.hpp"

namespace stc::codegen {

/// How a value of `from` becomes one of `to`; `value` writes it.
void emitConverted(EmitContext &cx, const Type *from, const Type *to, Span span, Part value);
/// The expression's own value, converted.
void emitConvertedExpr(EmitContext &cx, const ast::Expr *e, const Type *from, const Type *to);
/// The same of C++ that stands for a value, as it is stored.
void emitConvertedText(EmitContext &cx, std::string_view code, const Type *from, const Type *to,
                       Span span);
/// C++ makes it by itself where a value is stored.
[[nodiscard]] bool isImplicitStore(const EmitContext &cx, const Type *from, const Type *to);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_EXPRESSIONS_CONVERSIONS_HPP
