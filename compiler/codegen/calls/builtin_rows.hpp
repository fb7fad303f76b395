#ifndef STRIDE_COMPILER_CODEGEN_CALLS_BUILTIN_ROWS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_BUILTIN_ROWS_HPP
// How each built-in function is written: the column EMIT of builtins.def.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// A call whose arguments may have been taken before.
struct BuiltinCall {
  const ast::CallExpr *expr;
  std::span<const std::string> names; ///< what stands for the arguments; empty: nothing does

  [[nodiscard]] size_t count() const { return expr->arguments.size(); }
  [[nodiscard]] const ast::Expr *value(size_t i) const { return expr->arguments[i].value; }
  /// Its type after the conversion to what the function wants.
  [[nodiscard]] const Type *type(size_t i) const {
    return value(i)->target != nullptr ? value(i)->target : value(i)->type;
  }
};

struct BuiltinEmission {
  /// Null: the checker replaces the function by others, or by a constant.
  void (*emit)(EmitContext &cx, const BuiltinCall &call, std::string_view argument) = nullptr;
  std::string_view argument = {}; ///< mostly the name of the runtime's function
};
[[nodiscard]] const BuiltinEmission &builtinEmission(ast::Builtin function);

/// An argument's value, or what stands for it.
void emitBuiltinArgument(EmitContext &cx, const BuiltinCall &call, size_t i);
/// The same where the runtime takes texts of any length.
void emitTextArgument(EmitContext &cx, const BuiltinCall &call, size_t i);
/// The functions on texts: `name<length>(a, b …)`
void emitTextFunction(EmitContext &cx, const BuiltinCall &call, std::string_view name);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_BUILTIN_ROWS_HPP
