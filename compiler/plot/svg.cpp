#include "compiler/plot/plot.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace stc::plot {

namespace {

constexpr double kWidth = 960;
constexpr double kLeft = 84;      // before the plot area, at least
constexpr double kLeftMost = 300; // … and at most
constexpr double kRight = 24;
constexpr double kTop = 14;
constexpr double kTitle = 30;     // for the title
constexpr double kHead = 26;      // legend above each panel
constexpr double kLegendRow = 17; // each further row of it
constexpr double kPanel = 170;    // plot area of a panel
constexpr double kLane = 22;      // plot area of a BOOL
constexpr double kGap = 12;
constexpr double kFoot = 52;       // time axis
constexpr double kMarkRow = 15;    // texts of marks
constexpr double kLetter = 6.4;    // mean width of a letter of a lane's name
constexpr size_t kMostGuides = 40; // more than that hide the curves

// Distinct also for colour-blind readers (Okabe and Ito).
constexpr std::array<std::string_view, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#b8860b", "#56b4e9", "#555555"};

double heightOf(const Panel &panel) {
  return panel.lanes ? kLane * static_cast<double>(panel.series.size()) : kPanel;
}

struct Range {
  double low = 0;
  double high = 1;
};

// A coordinate: hundredths of a pixel are enough.
std::string px(double value) {
  std::string text = fmt::format("{:.2f}", value);
  while (text.ends_with('0'))
    text.pop_back();
  if (text.ends_with('.'))
    text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string tickLabel(double value, const Ticks &ticks) {
  const double size = std::fabs(value);
  if (size >= 1e6 || ticks.decimals > 5)
    return fmt::format("{:g}", value);
  std::string text = fmt::format("{:.{}f}", value, ticks.decimals);
  if (text.starts_with('-'))
    text.replace(0, 1, "\xE2\x88\x92"); // a minus sign, not a hyphen
  return text;
}

Range rangeOf(const std::vector<const Series *> &series) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series *each : series)
    for (const double value : each->values)
      if (std::isfinite(value)) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
  if (range.low > range.high)
    return {0, 1};
  double margin = 0.06 * (range.high - range.low);
  if (!(margin > 1e-12 * std::max(std::fabs(range.low), std::fabs(range.high))))
    margin = std::max(0.5, 0.05 * std::fabs(range.low)); // a constant
  return {range.low - margin, range.high + margin};
}

// The names of the lanes; without the program's where all are of one program and some lie within
// its blocks: `First.Execute`, `Go`.
std::vector<std::string> laneNames(const std::vector<const Series *> &lanes) {
  std::vector<std::string> names;
  std::string_view program;
  bool common = lanes.size() > 1;
  bool inside = false;
  for (const Series *lane : lanes) {
    const std::string_view name = lane->name;
    const std::string_view first = name.substr(0, name.find('.'));
    if (names.empty())
      program = first;
    common = common && first == program && first.size() < name.size();
    inside = inside || std::count(name.begin(), name.end(), '.') > 1;
    names.emplace_back(name);
  }
  if (common && inside)
    for (std::string &name : names)
      name.erase(0, program.size() + 1);
  return names;
}

class Drawing {
public:
  explicit Drawing(const Trace &trace) : trace_(trace), panels_(arrange(trace)) {
    times_ = {trace.time.front(), trace.time.back()};
    if (!(times_.high > times_.low))
      times_.high = times_.low + 1;
    timeTicks_ = niceTicks(times_.low, times_.high, 10);
    for (const Panel &panel : panels_)
      if (panel.lanes)
        for (const std::string &name : laneNames(panel.series))
          left_ = std::max(left_, 20 + kLetter * static_cast<double>(name.size()));
    left_ = std::min(left_, kLeftMost);
  }

  std::string draw() {
    double height = top() + kFoot + marksHeight();
    for (const Panel &panel : panels_)
      height += headOf(panel) + heightOf(panel) + kGap;
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" "
        "font-size=\"12\" fill=\"#374151\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        px(kWidth), px(height));
    if (!trace_.title.empty())
      text(kWidth / 2, kTop + 14, "middle", trace_.title, " font-size=\"16\" font-weight=\"600\"");
    drawGuides(height - kFoot - kGap - marksHeight());
    double top = this->top();
    for (const Panel &panel : panels_) {
      if (panel.lanes) {
        drawLanes(panel, top);
        top += heightOf(panel) + kGap;
      } else {
        drawPanel(panel, top + headOf(panel));
        top += headOf(panel) + heightOf(panel) + kGap;
      }
    }
    drawMarks(top - kGap);
    drawTimeAxis(top - kGap + marksHeight());
    svg_ += "</svg>\n";
    return std::move(svg_);
  }

private:
  /// Where the panels begin.
  double top() const { return kTop + (trace_.title.empty() ? 0 : kTitle); }
  double x(double time) const {
    return left_ + (time - times_.low) / (times_.high - times_.low) * (kWidth - left_ - kRight);
  }

  // Dashed lines through all panels where a BOOL changes: what happened to the curves then.
  void drawGuides(double bottom) {
    std::set<double> changes;
    for (const Panel &panel : panels_)
      if (panel.lanes)
        for (const Series *series : panel.series)
          for (size_t i = 1; series->isBool && i < series->values.size(); ++i)
            if (series->values[i] != series->values[i - 1])
              changes.insert(std::round(x(trace_.time[i])));
    if (panels_.size() < 2 || changes.size() > kMostGuides)
      return;
    for (const double at : changes)
      svg_ += fmt::format("<path d=\"M{0} {1}V{2}\" stroke=\"#9ca3af\" stroke-width=\"0.8\" "
                          "stroke-dasharray=\"3 3\"/>\n",
                          px(at), px(top()), px(bottom));
  }

  // Texts that would overlap stand in rows below each other.
  std::vector<std::pair<double, int>> markPlaces() const {
    std::vector<std::pair<double, int>> places;
    std::vector<double> ends; // of the rows
    for (const Mark &mark : trace_.marks) {
      const double width = kLetter * static_cast<double>(mark.text.size()) + 8;
      const double at = std::clamp(x(mark.at) - width / 2, left_ - 30, kWidth - width);
      size_t row = 0;
      while (row < ends.size() && ends[row] > at)
        ++row;
      if (row == ends.size())
        ends.push_back(0);
      ends[row] = at + width;
      places.emplace_back(at + width / 2, static_cast<int>(row));
    }
    return places;
  }

  double marksHeight() const {
    int rows = 0;
    for (const auto &[at, row] : markPlaces())
      rows = std::max(rows, row + 1);
    return rows == 0 ? 0 : kMarkRow * rows + 6;
  }

  // Dashed lines through all panels, their texts below.
  void drawMarks(double bottom) {
    const std::vector<std::pair<double, int>> places = markPlaces();
    for (size_t i = 0; i < places.size(); ++i) {
      const double row = bottom + 13 + kMarkRow * places[i].second;
      svg_ += fmt::format("<path d=\"M{0} {1}V{2}\" stroke=\"#d55e00\" stroke-width=\"0.9\" "
                          "stroke-dasharray=\"4 3\"/>\n",
                          px(x(trace_.marks[i].at)), px(top() + kHead), px(row - 10));
      text(places[i].first, row, "middle", trace_.marks[i].text,
           " font-size=\"11\" fill=\"#d55e00\"");
    }
  }

  // Where the entries of a panel's legend begin, and in which row: as many in a row as there is
  // room for.
  std::vector<std::pair<double, int>> legendOf(const Panel &panel) const {
    std::vector<std::pair<double, int>> places;
    double at = left_;
    int row = 0;
    for (const Series *series : panel.series) {
      const double width = 24 + 6.6 * static_cast<double>(series->name.size());
      if (at > left_ && at + width > kWidth - kRight) {
        at = left_;
        ++row;
      }
      places.emplace_back(at, row);
      at += width + 22;
    }
    return places;
  }

  // What stands above the plot area.
  double headOf(const Panel &panel) const {
    return panel.lanes ? 0 : kHead + kLegendRow * legendOf(panel).back().second;
  }

  void line(double x1, double y1, double x2, double y2, std::string_view color) {
    svg_ += fmt::format("<path d=\"M{} {}L{} {}\" stroke=\"{}\"/>\n", px(x1), px(y1), px(x2),
                        px(y2), color);
  }

  void text(double x, double y, std::string_view anchor, std::string_view content,
            std::string_view more = {}) {
    svg_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", px(x), px(y),
                        anchor, more, stride::common::escapedMarkup(content));
  }

  void drawFrame(double top, double height) {
    for (const double tick : timeTicks_.values)
      line(x(tick), top, x(tick), top + height, "#e5e7eb");
    svg_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#9ca3af\"/>\n",
        px(left_), px(top), px(kWidth - left_ - kRight), px(height));
  }

  void drawPanel(const Panel &panel, double top) {
    const Range range = rangeOf(panel.series);
    const Ticks ticks = niceTicks(range.low, range.high, 5);
    const auto y = [&](double value) {
      return top + kPanel * (range.high - value) / (range.high - range.low);
    };
    for (const double tick : ticks.values) {
      line(left_, y(tick), kWidth - kRight, y(tick), "#e5e7eb");
      text(left_ - 8, y(tick) + 4, "end", tickLabel(tick, ticks));
    }
    drawFrame(top, kPanel);
    const std::string label = labelOf(panel.quantity);
    const double middle = top + kPanel / 2;
    text(left_ - 64, middle, "middle", label,
         fmt::format(" transform=\"rotate(-90 {} {})\" font-weight=\"600\"", px(left_ - 64),
                     px(middle)));
    drawLegend(panel, top - 9);
    size_t color = 0;
    for (const Series *series : panel.series)
      drawCurve(*series, y, kColors[color++ % kColors.size()]);
  }

  // The last row stands at `y`.
  void drawLegend(const Panel &panel, double y) {
    const std::vector<std::pair<double, int>> places = legendOf(panel);
    for (size_t i = 0; i < places.size(); ++i) {
      const double at = places[i].first;
      const double row = y - kLegendRow * (places.back().second - places[i].second);
      svg_ += fmt::format("<path d=\"M{} {}h18\" stroke=\"{}\" stroke-width=\"2.5\"/>\n", px(at),
                          px(row - 4), kColors[i % kColors.size()]);
      text(at + 24, row, "start", panel.series[i]->name);
    }
  }

  // Many samples share a pixel column: of each column the first, lowest, highest and last one are
  // drawn, in their order.
  template <class Y> void drawCurve(const Series &series, const Y &y, std::string_view color) {
    std::string path;
    bool pen = false;
    double lastX = std::numeric_limits<double>::quiet_NaN();
    double lastY = lastX;
    const auto point = [&](size_t i) {
      const double px1 = std::round(x(trace_.time[i]) * 100) / 100;
      const double py1 = std::round(y(series.values[i]) * 100) / 100;
      if (pen && px1 == lastX && py1 == lastY)
        return;
      path += fmt::format("{}{} {}", pen ? "L" : "M", px(px1), px(py1));
      pen = true;
      lastX = px1;
      lastY = py1;
    };
    size_t i = 0;
    const size_t size = trace_.time.size();
    while (i < size) {
      if (!std::isfinite(series.values[i])) {
        pen = false; // a gap
        ++i;
        continue;
      }
      const double column = std::floor(x(trace_.time[i]));
      size_t end = i;
      size_t low = i;
      size_t high = i;
      while (end < size && std::isfinite(series.values[end]) &&
             std::floor(x(trace_.time[end])) == column) {
        if (series.values[end] < series.values[low])
          low = end;
        if (series.values[end] > series.values[high])
          high = end;
        ++end;
      }
      std::array<size_t, 4> chosen = {i, low, high, end - 1};
      std::sort(chosen.begin(), chosen.end());
      for (size_t k = 0; k < chosen.size(); ++k)
        if (k == 0 || chosen[k] != chosen[k - 1])
          point(chosen[k]);
      i = end;
    }
    svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" "
                        "stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n",
                        path, color);
  }

  void drawLanes(const Panel &panel, double top) {
    const std::vector<std::string> names = laneNames(panel.series);
    drawFrame(top, heightOf(panel));
    for (size_t k = 0; k < panel.series.size(); ++k, top += kLane) {
      const Series &series = *panel.series[k];
      const double low = top + kLane - 4;
      const double high = top + 5;
      if (k > 0)
        line(left_, top, kWidth - kRight, top, "#e5e7eb");
      if (!series.states.empty()) {
        text(left_ - 8, low - 2, "end", names[k], " font-size=\"11\"");
        drawStates(series, high, low, kColors[k % kColors.size()]);
        continue;
      }
      bool up = series.values.front() != 0;
      std::string path;
      for (size_t i = 1; i < series.values.size(); ++i)
        if ((series.values[i] != 0) != up) {
          up = !up;
          path += fmt::format("H{}V{}", px(x(trace_.time[i])), px(up ? high : low));
        }
      path += "H" + px(x(trace_.time.back()));
      const std::string begin = px(x(trace_.time.front()));
      const std::string first = px(series.values.front() != 0 ? high : low);
      const std::string_view color = kColors[k % kColors.size()];
      // Filled down to the base line, it shows how long the value was TRUE.
      svg_ += fmt::format("<path d=\"M{0} {1}V{2}{3}V{1}\" fill=\"{4}\" fill-opacity=\"0.15\"/>\n"
                          "<path d=\"M{0} {2}{3}\" fill=\"none\" stroke=\"{4}\" "
                          "stroke-width=\"1.6\"/>\n",
                          begin, px(low), first, path, color);
      text(left_ - 8, low - 2, "end", names[k], " font-size=\"11\"");
    }
  }

  // A band that is as long as the state lasts, with its name where there is room.
  void drawStates(const Series &series, double high, double low, std::string_view color) {
    for (size_t i = 0; i < series.values.size();) {
      size_t end = i + 1;
      while (end < series.values.size() && series.values[end] == series.values[i])
        ++end;
      const double from = x(trace_.time[i]);
      const double to = x(trace_.time[std::min(end, trace_.time.size() - 1)]);
      const std::string name = stateName(series, series.values[i]);
      svg_ += fmt::format("<path d=\"M{0} {1}H{2}V{3}H{0}Z\" fill=\"{4}\" fill-opacity=\"0.12\" "
                          "stroke=\"{4}\" stroke-width=\"0.9\"/>\n",
                          px(from), px(high), px(to), px(low), color);
      if (to - from > kLetter * static_cast<double>(name.size()) + 4)
        text((from + to) / 2, low - 4, "middle", name, " font-size=\"10\"");
      i = end;
    }
  }

  void drawTimeAxis(double top) {
    for (const double tick : timeTicks_.values)
      text(x(tick), top + 17, "middle", tickLabel(tick, timeTicks_));
    text((left_ + kWidth - kRight) / 2, top + 37, "middle", trace_.axis, " font-weight=\"600\"");
  }

  double left_ = kLeft; ///< where the plot area begins
  const Trace &trace_;
  std::vector<Panel> panels_;
  Range times_;
  Ticks timeTicks_;
  std::string svg_;
};

} // namespace

std::string drawSvg(const Trace &trace) { return Drawing(trace).draw(); }

} // namespace stc::plot
