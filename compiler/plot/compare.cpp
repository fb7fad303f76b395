#include "compiler/plot/compare.hpp"

#include "compiler/plot/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace stc::plot {

namespace {

constexpr size_t kMostColumns = 10; // that are described

using Cells = std::vector<std::string_view>;

/// Exact for all integers of 64 bits.
std::optional<long double> numberOf(std::string_view text) {
  long double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// Seconds with up to nine decimals, as traces have them.
std::optional<int64_t> nanosecondsOf(std::string_view text) {
  const size_t point = text.find('.');
  std::string digits(text.substr(0, point));
  const std::string_view decimals =
      point == std::string_view::npos ? std::string_view() : text.substr(point + 1);
  if (decimals.size() > 9)
    return std::nullopt;
  digits += decimals;
  digits.append(9 - decimals.size(), '0');
  int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    return std::nullopt;
  return value;
}

bool sameTime(std::string_view a, std::string_view b) {
  const std::optional<int64_t> time = nanosecondsOf(a);
  return a == b || (time && time == nanosecondsOf(b));
}

/// A row after the header; false: there is none.
bool nextRow(std::string_view &rest, Cells &row) {
  while (!rest.empty()) {
    const std::string_view line = nextLine(rest);
    if (cellText(line).empty())
      continue;
    row = cells(line);
    return true;
  }
  return false;
}

std::string listed(const Cells &names) {
  std::string text;
  for (size_t i = 0; i < names.size() && i < kMostColumns; ++i)
    text += fmt::format("{}`{}`", i == 0 ? "" : ", ", names[i]);
  return names.size() > kMostColumns ? text + ", …" : text;
}

class Comparison {
public:
  Comparison(std::string_view expected, std::string_view actual, double tolerance)
      : expected_(withoutByteOrderMark(expected)), actual_(actual), tolerance_(tolerance) {}

  TraceDifference run() {
    if (matchColumns())
      compareRows();
    std::erase_if(result_.columns, [](const ColumnDifference &column) { return column.rows == 0; });
    return std::move(result_);
  }

private:
  /// Finds the columns of the one in the other; false: they have not the same.
  bool matchColumns() {
    names_ = cells(nextLine(expected_));
    const Cells others = cells(nextLine(actual_));
    columns_ = others.size();
    Cells lacking;
    Cells unexpected = others;
    for (const std::string_view name : names_) {
      const auto found = std::find(others.begin(), others.end(), name);
      places_.push_back(static_cast<size_t>(found - others.begin()));
      if (found == others.end())
        lacking.push_back(name);
      std::erase(unexpected, name);
      result_.columns.push_back({std::string(name), {}, {}, {}, 0, 0, {}});
    }
    if (names_.empty() || names_[0] != "t")
      result_.reason = "what is expected is no trace: its first line must begin with `t`";
    else if (!lacking.empty())
      result_.reason = fmt::format("the trace does not have {}", listed(lacking));
    else if (!unexpected.empty())
      result_.reason = fmt::format("{} of the trace is not expected", listed(unexpected));
    return result_.reason.empty();
  }

  void compareRows() {
    Cells expected;
    Cells actual;
    std::string last = "the beginning";
    for (;; ++result_.rows) {
      const bool isExpected = nextRow(expected_, expected);
      const bool isThere = nextRow(actual_, actual);
      if (!isExpected && !isThere)
        return;
      if (!isThere)
        result_.reason =
            fmt::format("the trace ends after {}, a row at {} s is expected", last, expected[0]);
      else if (!isExpected)
        result_.reason =
            fmt::format("the trace has a row at {} s, none is expected after {}", actual[0], last);
      else if (expected.size() != names_.size())
        result_.reason = fmt::format("what is expected has a row of {} values after {} instead of "
                                     "{}",
                                     expected.size(), last, names_.size());
      else if (actual.size() != columns_)
        result_.reason = fmt::format("the trace has a row of {} values after {} instead of {}",
                                     actual.size(), last, columns_);
      else if (!sameTime(expected[0], actual[0]))
        result_.reason = fmt::format("the trace has a row at {} s, where one at {} s is expected",
                                     actual[0], expected[0]);
      if (!result_.reason.empty())
        return;
      for (size_t i = 1; i < names_.size(); ++i)
        compareCells(result_.columns[i], actual[0], expected[i], actual[places_[i]]);
      last = fmt::format("{} s", actual[0]);
    }
  }

  void compareCells(ColumnDifference &column, std::string_view time, std::string_view expected,
                    std::string_view actual) const {
    if (expected == actual)
      return;
    const std::optional<long double> wanted = numberOf(expected);
    const std::optional<long double> found = numberOf(actual);
    const bool areNumbers = wanted && found;
    const auto distance = areNumbers ? static_cast<double>(std::abs(*wanted - *found)) : 0.0;
    if (areNumbers && distance <= tolerance_)
      return;
    if (column.rows++ == 0) {
      column.time = time;
      column.expected = expected;
      column.actual = actual;
    }
    if (distance > column.most) {
      column.most = distance;
      column.mostTime = time;
    }
  }

  std::string_view expected_;
  std::string_view actual_;
  double tolerance_;
  Cells names_;                ///< of what is expected
  std::vector<size_t> places_; ///< of these columns in the trace
  size_t columns_ = 0;         ///< of the trace
  TraceDifference result_;
};

} // namespace

TraceDifference compareTraces(std::string_view expected, std::string_view actual,
                              double tolerance) {
  return Comparison(expected, actual, tolerance).run();
}

std::string describe(const TraceDifference &difference) {
  std::string text;
  const auto line = [&text](const std::string &one) { text += (text.empty() ? "" : "\n") + one; };
  size_t shown = 0;
  for (const ColumnDifference &column : difference.columns) {
    if (++shown > kMostColumns)
      break;
    std::string one = fmt::format("`{}` at {} s: expected {}, is {}", column.name, column.time,
                                  column.expected.empty() ? "nothing" : column.expected,
                                  column.actual.empty() ? "nothing" : column.actual);
    if (column.rows > 1)
      one += fmt::format("; {} of {} rows differ", column.rows, difference.rows);
    if (column.rows > 1 && column.most > 0)
      one += fmt::format(", by {:.6g} at most (at {} s)", column.most, column.mostTime);
    line(one);
  }
  if (const size_t all = difference.columns.size(); all > kMostColumns)
    line(fmt::format("… and {} more column{}", all - kMostColumns,
                     all - kMostColumns == 1 ? "" : "s"));
  if (!difference.reason.empty())
    line(difference.reason);
  return text;
}

std::string rowsAt(std::string_view trace, int64_t everyNs) {
  if (everyNs <= 0)
    return std::string(trace);
  std::string kept;
  bool isHeader = true;
  for (std::string_view rest = trace; !rest.empty(); isHeader = false) {
    const std::string_view line = nextLine(rest);
    const std::optional<int64_t> time = nanosecondsOf(line.substr(0, line.find(',')));
    if (isHeader || (time && *time % everyNs == 0))
      kept.append(line).push_back('\n');
  }
  return kept;
}

} // namespace stc::plot
