#ifndef STRIDE_COMPILER_CODEGEN_CALLS_ASSERTIONS_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_ASSERTIONS_HPP
// ASSERT_TRUE, ASSERT_EQ and the others of unit tests: runtime/iec/assert.h. Internal to
// compiler/codegen.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/types.hpp"
#include "compiler/syntax/ast.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::codegen {

/// What an assertion compares: BOOL of ASSERT_TRUE, LREAL of ASSERT_NEAR, null of FAIL.
[[nodiscard]] const Type *assertedType(const ast::CallExpr *call);

/// The C++ of the call, from the C++ of its context, its arguments (texts of any length, all others
/// converted) and its place (file, line, column). `demand` is how two values must relate, or what
/// one must be: `true`, `false`.
[[nodiscard]] std::string assertionText(const ast::CallExpr *call, std::string_view demand,
                                        const std::string &context,
                                        const std::vector<std::string> &arguments,
                                        const std::string &position);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_ASSERTIONS_HPP
