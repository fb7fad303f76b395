#include "tests/support/csv_compare.hpp"
#include "tests/support/text.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

namespace stride::test {

namespace {

constexpr int kMostDifferences = 20;

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> result;
  for (;;) {
    const size_t comma = line.find(',');
    result.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos)
      return result;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

bool equalCells(std::string_view expected, std::string_view actual, double tolerance) {
  if (expected == actual)
    return true;
  const std::optional<double> a = number(expected);
  const std::optional<double> b = number(actual);
  return tolerance >= 0 && a && b && std::abs(*a - *b) <= tolerance;
}

} // namespace

std::string sampleRows(std::string_view csv, size_t every) {
  std::string result;
  size_t row = 0;
  for (const std::string &line : splitLines(csv)) {
    if (row == 0 || (row - 1) % every == 0)
      result += line + '\n';
    ++row;
  }
  return result;
}

std::string compareCsv(std::string_view expected, std::string_view actual,
                       const CsvTolerance &tolerance) {
  const std::vector<std::string> a = splitLines(expected);
  const std::vector<std::string> b = splitLines(actual);
  if (a.empty() || b.empty())
    return a.size() == b.size() ? "" : "one of the traces is empty\n";
  if (a[0] != b[0])
    return "- " + a[0] + "\n+ " + b[0] + "\n";

  std::string report;
  if (a.size() != b.size())
    report += "expected " + std::to_string(a.size() - 1) + " rows, got " +
              std::to_string(b.size() - 1) + '\n';
  const std::vector<std::string_view> header = cells(a[0]);
  int differences = 0;
  for (size_t row = 1; row < a.size() && row < b.size(); ++row) {
    const std::vector<std::string_view> x = cells(a[row]);
    const std::vector<std::string_view> y = cells(b[row]);
    const std::string where = "line " + std::to_string(row + 1) + " (" + std::string(x[0]) + ")";
    if (x.size() != header.size() || y.size() != header.size()) {
      report += where + ": not as many cells as the header has\n";
      return report;
    }
    for (size_t column = 0; column < x.size(); ++column) {
      const auto named = tolerance.absolute.find(std::string(header[column]));
      const double allowed =
          named == tolerance.absolute.end() ? tolerance.otherwise : named->second;
      if (equalCells(x[column], y[column], allowed))
        continue;
      if (++differences > kMostDifferences)
        return report + "...\n";
      report += where + ", " + std::string(header[column]) + ": expected " +
                std::string(x[column]) + ", got " + std::string(y[column]) + '\n';
    }
  }
  return report;
}

} // namespace stride::test
