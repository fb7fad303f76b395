#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_NUMERIC_LOOPS_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_NUMERIC_LOOPS_HPP
// Which code is worth what the C++ compiler can do for loops that compute with arrays of reals.

#include "compiler/syntax/ast.hpp"

namespace stc::codegen {

/// A loop within a loop has a sum, difference, product or quotient of REAL or LREAL with an element
/// of an array in it.
[[nodiscard]] bool hasNumericLoop(ast::Block body);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_NUMERIC_LOOPS_HPP
