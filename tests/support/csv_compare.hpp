// Comparing traces: CSV with one header row, numbers within a tolerance per column.
#ifndef STRIDE_TESTS_SUPPORT_CSV_COMPARE_HPP
#define STRIDE_TESTS_SUPPORT_CSV_COMPARE_HPP

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace stride::test {

/// How two traces are compared.
struct CsvTolerance {
  std::map<std::string, double> absolute; ///< by column name; other columns must be equal as text
  double otherwise = -1;                  ///< absolute tolerance of unnamed columns; < 0: as text
};

/// The header and every `every`-th row after it (the first row included).
std::string sampleRows(std::string_view csv, size_t every);

/// What differs, a line for each of the first differences; empty when nothing does.
std::string compareCsv(std::string_view expected, std::string_view actual,
                       const CsvTolerance &tolerance);

} // namespace stride::test

#endif // STRIDE_TESTS_SUPPORT_CSV_COMPARE_HPP
