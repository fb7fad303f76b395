#ifndef STRIDE_COMPILER_SEMANTICS_STATEMENTS_STATEMENTS_HPP
#define STRIDE_COMPILER_SEMANTICS_STATEMENTS_STATEMENTS_HPP
// Statements.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Checks initial values and the body of a POU and its methods, once.
void checkBody(Context &c, PouSymbol *pou);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_STATEMENTS_STATEMENTS_HPP
