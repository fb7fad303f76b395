#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_INNER_SUMS_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_INNER_SUMS_HPP
// Loops whose rounds are independent but for variables that each round sets anew: the rows of a
// product of matrices. C++ computes several rounds at once if it need not keep such a variable.

#include "compiler/codegen/analysis/analysis.hpp"

#include <vector>

namespace stc::codegen {

/// Those of `locals` (kept in C++ locals while the loop runs) that are reals, that each round of
/// the loop sets before it reads them, and that a FOR loop in it changes. Empty where the rounds
/// have anything else to do with each other, may leave the cycle, or are more than kMostRounds. The
/// range of the loop's own variable is known to `analysis` (enterLoop).
[[nodiscard]] std::vector<const VarSymbol *>
innerSums(Analysis &analysis, const ast::ForStmt *loop,
          const std::vector<const VarSymbol *> &locals);

/// So many values are kept on the stack.
inline constexpr int64_t kMostRounds = 512;

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_INNER_SUMS_HPP
