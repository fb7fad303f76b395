#ifndef STRIDE_COMPILER_SEMANTICS_ATTRIBUTES_HPP
#define STRIDE_COMPILER_SEMANTICS_ATTRIBUTES_HPP
// Attributes whose value is checked where it is looked for.

#include "compiler/semantics/reporter.hpp"
#include "compiler/syntax/attributes.hpp"

namespace stc {

/// The alignment in bytes that {attribute 'pack_mode'} gives; `otherwise` where there is none or a
/// wrong one, which is reported.
unsigned packMode(Reporter &reporter, const ast::Attributes &attributes, unsigned otherwise);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_ATTRIBUTES_HPP
