#include "compiler/plot/csv.hpp"
#include "compiler/plot/plot.hpp"
#include "compiler/source/identifier.hpp"
#include "runtime/common/quantity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fnmatch.h>

namespace stc::plot {

namespace {

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

/// The outputs and inputs of blocks that are BOOL without saying so.
bool isUsualBool(std::string_view variable) {
  static constexpr std::string_view kNames[] = {"done",        "busy",    "active",
                                                "error",       "execute", "enable",
                                                "status",      "valid",   "commandaborted",
                                                "q",           "q1",      "qu",
                                                "qd",          "in",      "clk",
                                                "set",         "reset",   "commandaccepted",
                                                "invelocity",  "ingear",  "insync",
                                                "endofprofile"};
  const size_t dot = variable.rfind('.');
  const std::string name =
      lowerCase(dot == std::string_view::npos ? variable : variable.substr(dot + 1));
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

} // namespace

std::optional<Trace> readTrace(std::string_view csv, TraceError &error) {
  std::string_view rest = withoutByteOrderMark(csv);
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
    // A number may be 0 all the time; what changes between 0 and 1 alone is a BOOL.
    const bool changes = std::any_of(series.values.begin(), series.values.end(),
                                     [&](double value) { return value != series.values[0]; });
    series.isBool = binary && (words[i] || namedLikeBool(series.name) || isUsualBool(series.name) ||
                               (changes && quantityOf(series.name).unit.empty()));
  }
  return trace;
}

Quantity quantityOf(std::string_view variable) {
  if (const stride::common::QuantityRule *rule = stride::common::findQuantity(variable))
    return {std::string(rule->title), std::string(rule->unit)};
  return {std::string(variable), ""};
}

std::string labelOf(const Quantity &quantity) {
  if (quantity.unit.empty())
    return quantity.title;
  return fmt::format("{}{}[{}]", quantity.title, quantity.title.empty() ? "" : " ", quantity.unit);
}

std::string stateName(const Series &series, double value) {
  const auto found = series.states.find(static_cast<int64_t>(value));
  return found != series.states.end() ? found->second : fmt::format("{}", value);
}

void describeColumns(Trace &trace,
                     const std::function<std::optional<ColumnType>(const std::string &)> &typeOf,
                     const std::function<std::string(const std::string &)> &technicalUnitOf) {
  for (Series &series : trace.series) {
    if (const std::optional<ColumnType> type = typeOf(series.name)) {
      series.isBool = type->kind == ColumnType::Kind::Bool;
      series.states = type->states;
    }
    Quantity quantity = quantityOf(series.name);
    quantity.unit = stride::common::inUnit(quantity.unit, technicalUnitOf(series.name));
    series.quantity = std::move(quantity);
  }
}

bool cut(Trace &trace, double from, double to) {
  const auto keep = [&](std::vector<double> &values) {
    size_t kept = 0;
    for (size_t i = 0; i < trace.time.size(); ++i)
      if (trace.time[i] >= from && trace.time[i] <= to)
        values[kept++] = values[i];
    values.resize(kept);
  };
  for (Series &series : trace.series)
    keep(series.values);
  std::vector<double> time = trace.time;
  keep(time);
  trace.time = std::move(time);
  std::erase_if(trace.marks, [&](const Mark &mark) { return mark.at < from || mark.at > to; });
  return !trace.time.empty();
}

namespace {

/// The panels that are chosen: what is in a panel of numbers is one of numbers.
std::vector<Panel> chosenPanels(const Trace &trace) {
  std::vector<Panel> panels;
  for (const PanelChoice &choice : trace.panels) {
    Panel panel;
    for (const std::string &pattern : choice.columns)
      for (const Series &series : trace.series)
        if (::fnmatch(pattern.c_str(), series.name.c_str(), 0) == 0 &&
            std::find(panel.series.begin(), panel.series.end(), &series) == panel.series.end())
          panel.series.push_back(&series);
    if (panel.series.empty())
      continue;
    panel.lanes = std::all_of(panel.series.begin(), panel.series.end(),
                              [](const Series *series) { return series->isLane(); });
    panel.quantity = panel.series[0]->quantity.value_or(quantityOf(panel.series[0]->name));
    for (const Series *series : panel.series)
      if (series->quantity.value_or(quantityOf(series->name)).unit != panel.quantity.unit)
        panel.quantity = {"", ""};
    if (!choice.title.empty())
      panel.quantity.title = choice.title;
    panels.push_back(std::move(panel));
  }
  return panels;
}

} // namespace

std::vector<Panel> arrange(const Trace &trace) {
  if (!trace.panels.empty())
    return chosenPanels(trace);
  std::vector<Panel> panels;
  for (const Series &series : trace.series) {
    const Quantity quantity = series.isLane()   ? Quantity{}
                              : series.quantity ? *series.quantity
                                                : quantityOf(series.name);
    const auto same = std::find_if(panels.begin(), panels.end(), [&](const Panel &panel) {
      return panel.lanes == series.isLane() && panel.quantity == quantity;
    });
    if (same != panels.end())
      same->series.push_back(&series);
    else
      panels.push_back({quantity, {&series}, series.isLane()});
  }
  return panels;
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
