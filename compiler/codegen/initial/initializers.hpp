#ifndef STRIDE_COMPILER_CODEGEN_INITIAL_INITIALIZERS_HPP
#define STRIDE_COMPILER_CODEGEN_INITIAL_INITIALIZERS_HPP
// Initial values. Memory is zero before, so that only what differs from zero is written.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// A line of initial values.
template <class... Parts> void initLine(EmitContext &cx, const Parts &...parts) {
  cx.begin(cx.modes.init.span);
  (cx.out << ... << parts);
  cx.end();
}

/// `head` ends with an opening brace.
template <class Head, class Body> void initLoop(EmitContext &cx, Head &&head, Body &&body) {
  cx.begin(cx.modes.init.span);
  head();
  cx.end();
  cx.open();
  body();
  cx.close();
  initLine(cx, '}');
}

/// Brings zeroed memory to the variable's default; `target` is a C++ lvalue.
void initVariable(EmitContext &cx, std::string_view target, const VarSymbol *variable);
/// Brings it to the type's default.
void initDefault(EmitContext &cx, std::string_view target, const Type *type);
/// The same with the defaults of aliases that array elements are declared with.
void initWritten(EmitContext &cx, std::string_view target, const Type *type,
                 const Written &written);
void initValue(EmitContext &cx, std::string_view target, const Type *type, const ast::Expr *init);
/// A list of values as a value.
void emitAggregateValue(EmitContext &cx, const Type *type, const ast::Expr *init);

/// Gives a local variable its default: `T x = 5;` or `T x{};` and what follows.
/// Without an initial value of its own it counts as standing at `start`, where the body begins.
void declareLocal(EmitContext &cx, const VarSymbol *variable, Span start);
/// The place of an input on the data stack, which begins with what was passed; nothing for
/// others.
void declareInput(EmitContext &cx, const VarSymbol *input, Span start);
/// `T name{}; `: a temporary of zeroed memory.
void declareTemporary(EmitContext &cx, const Type *type, std::string_view name, bool onDataStack);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_INITIAL_INITIALIZERS_HPP
