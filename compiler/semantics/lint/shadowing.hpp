#ifndef STRIDE_COMPILER_SEMANTICS_LINT_SHADOWING_HPP
#define STRIDE_COMPILER_SEMANTICS_LINT_SHADOWING_HPP
// Names that hide other names.

#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

/// Variables that hide others of the project, or functions of libraries.
void checkShadowing(Context &c, Module &module);
/// POUs and types of the project that have the name of a library's.
void checkHiddenLibrary(Context &c, Module &module);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_LINT_SHADOWING_HPP
