#pragma once
// Statements.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

void checkBody(Context &c, PouSymbol *pou);

} // namespace stc::sema
