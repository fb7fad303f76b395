// Cells between two stops. Private to the oracle.
#ifndef STRIDE_TESTS_ORACLE_PATH_CELL_PARTS_HPP
#define STRIDE_TESTS_ORACLE_PATH_CELL_PARTS_HPP

#include "tests/oracle/path/time_optimum.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace stride::oracle {

struct CellPart {
  size_t first, count;
};

/// Runs of cells whose ceiling is not 0.
std::vector<CellPart> partsBetweenStops(std::span<const Cell> cells);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_CELL_PARTS_HPP
