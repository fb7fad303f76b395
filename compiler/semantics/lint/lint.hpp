#ifndef STRIDE_COMPILER_SEMANTICS_LINT_LINT_HPP
#define STRIDE_COMPILER_SEMANTICS_LINT_LINT_HPP
// What is allowed but probably not meant: looked for in programs without errors, after checking.

#include "compiler/semantics/program.hpp"

namespace stc::lint {

/// Looks through all POUs of the library (or the project).
void run(Program &program, Library &library);

} // namespace stc::lint

#endif // STRIDE_COMPILER_SEMANTICS_LINT_LINT_HPP
