#ifndef STRIDE_COMPILER_PLOT_COMPARE_HPP
#define STRIDE_COMPILER_PLOT_COMPARE_HPP
// Whether a trace is what it should be.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stc::plot {

/// Where a column is not as expected.
struct ColumnDifference {
  std::string name;
  std::string time;     ///< of the first row that differs, as the trace has it [s]
  std::string expected; ///< there
  std::string actual;
  size_t rows = 0;      ///< how many differ
  double most = 0;      ///< the greatest difference of numbers; 0: there is none
  std::string mostTime; ///< its row [s]
};

/// What two traces do not have in common.
struct TraceDifference {
  std::string reason; ///< why no more rows could be compared; empty: all were
  size_t rows = 0;    ///< that were compared
  std::vector<ColumnDifference> columns;

  [[nodiscard]] bool none() const { return reason.empty() && columns.empty(); }
};

/// Compares row by row and column by column; columns may stand in another order. Values are alike
/// when their texts are, or when they are numbers no further apart than `tolerance`.
[[nodiscard]] TraceDifference compareTraces(std::string_view expected, std::string_view actual,
                                            double tolerance);

/// That as lines for people, the first of them without a margin.
[[nodiscard]] std::string describe(const TraceDifference &difference);

/// The header and the rows at multiples of `everyNs`; 0: all of them.
[[nodiscard]] std::string rowsAt(std::string_view trace, int64_t everyNs);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_COMPARE_HPP
