#ifndef STRIDE_COMPILER_SEMANTICS_PROGRAM_OWN_CHECKS_HPP
#define STRIDE_COMPILER_SEMANTICS_PROGRAM_OWN_CHECKS_HPP
// Functions of the project that replace run-time checks.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Notes the project's CheckBounds, CheckDivInt … and reports those with other parameters.
void findImplicitChecks(Context &c, Module &module);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_PROGRAM_OWN_CHECKS_HPP
