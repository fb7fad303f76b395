#pragma once
// Names that hide other names.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void checkShadowing(Context &c, Module &module);
void checkHiddenLibrary(Context &c, Module &module);

} // namespace stc::sema
