#ifndef STRIDE_COMPILER_CODEGEN_CALLS_BUILTIN_CALLS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_BUILTIN_CALLS_HPP
// Functions that the compiler implements itself.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

void emitBuiltin(EmitContext &cx, const ast::CallExpr *e);
/// `target := CONCAT(…)` without a copy in between; false for other values.
[[nodiscard]] bool emitStringInto(EmitContext &cx, std::string_view target, const ast::Expr *value);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_BUILTIN_CALLS_HPP
