#ifndef STRIDE_COMPILER_SEMANTICS_ATTRIBUTES_HPP
#define STRIDE_COMPILER_SEMANTICS_ATTRIBUTES_HPP
// `{attribute 'name' := 'value'}` where one is looked for.

#include "compiler/semantics/reporter.hpp"
#include "compiler/syntax/ast.hpp"

#include <string_view>

namespace stc {

[[nodiscard]] bool hasAttribute(const ast::Attributes &attributes, std::string_view name);

/// The alignment in bytes that {attribute 'pack_mode'} gives; `otherwise` where there is none or a
/// wrong one, which is reported.
unsigned packMode(Reporter &reporter, const ast::Attributes &attributes, unsigned otherwise);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_ATTRIBUTES_HPP
