#include "compiler/plot/plot.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace stc::plot {

namespace {

std::string_view nextLine(std::string_view &rest) {
  const size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  if (line.ends_with('\r'))
    line.remove_suffix(1);
  return line;
}

std::string_view cellText(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

// Splits at commas outside brackets and quotes: `a[1,2]` is one cell.
std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> result;
  size_t begin = 0;
  int depth = 0;
  bool quoted = false;
  for (size_t i = 0; i <= line.size(); ++i) {
    if (i == line.size() || (line[i] == ',' && depth == 0 && !quoted)) {
      result.push_back(cellText(line.substr(begin, i - begin)));
      begin = i + 1;
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == '[') {
      ++depth;
    } else if (line[i] == ']' && depth > 0) {
      --depth;
    }
  }
  return result;
}

struct Cell {
  double value = 0;
  bool isBool = false;
};

std::optional<Cell> parseCell(std::string_view text) {
  if (equalIgnoringCase(text, "TRUE"))
    return Cell{1, true};
  if (equalIgnoringCase(text, "FALSE"))
    return Cell{0, true};
  Cell cell;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), cell.value);
  if (error == std::errc::result_out_of_range)
    return Cell{};
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return cell;
}

// `bBusy`, `InVelocity`, MC_ReadStatus's `ConstantVelocity`, whatever else the name says.
bool namedLikeBool(std::string_view variable) {
  const size_t dot = variable.rfind('.');
  const std::string_view name = dot == std::string_view::npos ? variable : variable.substr(dot + 1);
  const auto beginsWith = [&](std::string_view word) {
    return name.size() > word.size() && name.starts_with(word) && name[word.size()] >= 'A' &&
           name[word.size()] <= 'Z';
  };
  return beginsWith("b") || beginsWith("In") || beginsWith("Constant");
}

struct Rule {
  std::string_view part; ///< of the lower-case member name
  std::string_view title;
  std::string_view unit;
};
// In this order: `fSWMaxVelocity`, `fSetAcceleration`, `fSWLimitPositive` …
constexpr Rule kRules[] = {
    {"jerk", "Jerk", "u/s³"},
    {"deceleration", "Acceleration", "u/s²"},
    {"acceleration", "Acceleration", "u/s²"},
    {"velocity", "Velocity", "u/s"},
    {"position", "Position", "u"},
    {"distance", "Distance", "u"},
    {"swlimit", "Position", "u"},
    {"torque", "Torque", "Nm"},
    {"current", "Current", "A"},
    {"taskcycle", "Time", "s"},
};

} // namespace

std::optional<Trace> readTrace(std::string_view csv, TraceError &error) {
  std::string_view rest = csv;
  if (rest.starts_with("\xEF\xBB\xBF"))
    rest.remove_prefix(3);
  const std::vector<std::string_view> header = cells(nextLine(rest));
  if (header.empty() || header[0] != "t") {
    error = {1, "the first line must name the columns and begin with `t`"};
    return std::nullopt;
  }
  if (header.size() < 2) {
    error = {1, "there is no variable besides `t`"};
    return std::nullopt;
  }
  Trace trace;
  for (size_t i = 1; i < header.size(); ++i)
    trace.series.push_back({std::string(header[i]), {}, false});
  std::vector<bool> words(trace.series.size(), false);
  for (size_t number = 2; !rest.empty(); ++number) {
    const std::string_view line = nextLine(rest);
    if (cellText(line).empty())
      continue;
    const std::vector<std::string_view> row = cells(line);
    if (row.size() != header.size()) {
      error = {number, fmt::format("expected {} values, found {}", header.size(), row.size())};
      return std::nullopt;
    }
    for (size_t i = 0; i < row.size(); ++i) {
      const std::optional<Cell> cell = parseCell(row[i]);
      if (!cell) {
        error = {number, fmt::format("`{}` in column `{}` is not a number", row[i], header[i])};
        return std::nullopt;
      }
      if (i == 0)
        trace.time.push_back(cell->value);
      else
        trace.series[i - 1].values.push_back(cell->value);
      if (i > 0 && cell->isBool)
        words[i - 1] = true;
    }
  }
  if (trace.time.empty()) {
    error = {0, "there are no rows"};
    return std::nullopt;
  }
  for (size_t i = 0; i < trace.series.size(); ++i) {
    Series &series = trace.series[i];
    const bool binary = std::all_of(series.values.begin(), series.values.end(),
                                    [](double value) { return value == 0 || value == 1; });
    series.isBool =
        binary && (words[i] || namedLikeBool(series.name) || quantityOf(series.name).unit.empty());
  }
  return trace;
}

Quantity quantityOf(std::string_view variable) {
  const size_t dot = variable.rfind('.');
  const std::string_view name = dot == std::string_view::npos ? variable : variable.substr(dot + 1);
  const std::string lower = lowerCase(name);
  for (const Rule &rule : kRules)
    if (lower.find(rule.part) != std::string::npos)
      return {std::string(rule.title), std::string(rule.unit)};
  return {std::string(variable), ""};
}

Ticks niceTicks(double low, double high, int count) {
  Ticks ticks;
  const double raw = (high - low) / std::max(1, count);
  if (!(raw > 0) || !std::isfinite(raw))
    return ticks;
  const double magnitude = std::pow(10.0, std::floor(std::log10(raw)));
  const double fraction = raw / magnitude;
  const double step = magnitude * (fraction <= 1.0   ? 1.0
                                   : fraction <= 2.0 ? 2.0
                                   : fraction <= 5.0 ? 5.0
                                                     : 10.0);
  ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; i < 100; ++i) {
    const double value = (first + i) * step;
    if (value > high + step * 1e-9)
      break;
    ticks.values.push_back(value == 0 ? 0 : value); // no -0
  }
  return ticks;
}

} // namespace stc::plot
