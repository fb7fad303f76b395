#ifndef STRIDE_COMPILER_CODEGEN_INITIAL_INITIALIZER_TABLES_HPP
#define STRIDE_COMPILER_CODEGEN_INITIAL_INITIALIZER_TABLES_HPP
// Many initial values that are alike, as tables and loops: g++ takes long for long functions.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// A long list of constants, of structures or arrays of constants, or of addresses of global
/// variables, from tables; false: it is none of that.
[[nodiscard]] bool initFromTable(EmitContext &cx, std::string_view target, const ArrayType *type,
                                 const ast::AggregateExpr *init);
/// Brings the first of these fields of `owner` (a C++ type), which follow each other in it, to
/// their defaults if enough of them are alike; gives how many it has dealt with, perhaps 0.
[[nodiscard]] size_t initRun(EmitContext &cx, std::span<const VarSymbol *const> variables,
                             std::string_view owner);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_INITIAL_INITIALIZER_TABLES_HPP
