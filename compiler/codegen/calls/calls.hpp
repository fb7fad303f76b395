#ifndef STRIDE_COMPILER_CODEGEN_CALLS_CALLS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_CALLS_HPP
// Calls of functions, function blocks and programs.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// A function or method; a value, or (`asStatement`) a statement.
void emitFunctionCall(EmitContext &cx, const ast::CallExpr *e, bool asStatement);
/// A function block or program.
void emitInstanceCall(EmitContext &cx, const ast::CallExpr *e, Span span);
/// The value of an input that the call leaves out.
void emitDefaultArgument(EmitContext &cx, const VarSymbol *parameter);
/// `target = source;` from an output of type `sourceType` to the variable after `=>`.
void emitOutputTo(EmitContext &cx, const ast::Expr *target, std::string_view source,
                  const Type *sourceType, Span span);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_CALLS_HPP
