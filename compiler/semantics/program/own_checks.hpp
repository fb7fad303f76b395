#pragma once
// Functions of the project that replace run-time checks.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void findImplicitChecks(Context &c, Module &module);

} // namespace stc::sema
