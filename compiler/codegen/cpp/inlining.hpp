#ifndef STRIDE_COMPILER_CODEGEN_CPP_INLINING_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_INLINING_HPP
// Small functions and blocks are given to their callers as a second header, so that the C++
// compiler can inline them across translation units.

#include "compiler/semantics/symbols.hpp"

namespace stc::codegen {

/// The body is small enough to be worth it. Known from the syntax alone, so that a project and the
/// library that it uses agree.
[[nodiscard]] bool isInlinable(const PouSymbol *pou);
/// The body belongs beside its callers. Where a call is not made often, it must be tiny.
[[nodiscard]] bool isWorthInlining(const PouSymbol *pou, bool often);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_INLINING_HPP
