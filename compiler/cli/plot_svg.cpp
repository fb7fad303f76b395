#include "compiler/cli/plot.hpp"
#include "compiler/doc/html.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace stc::cli {

namespace {

constexpr double kWidth = 960;
constexpr double kLeft = 84;
constexpr double kRight = 24;
constexpr double kTop = 14;
constexpr double kHead = 26;   // legend above each panel
constexpr double kPanel = 170; // plot area of a panel
constexpr double kLane = 36;   // plot area of a BOOL
constexpr double kGap = 12;
constexpr double kFoot = 52; // time axis

// Distinct also for colour-blind readers (Okabe and Ito).
constexpr std::array<std::string_view, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#b8860b", "#56b4e9", "#555555"};

struct Panel {
  Quantity quantity;
  std::vector<const Series *> series;
  bool lanes = false;
  [[nodiscard]] double height() const {
    return lanes ? kLane * static_cast<double>(series.size()) : kPanel;
  }
};

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

std::vector<Panel> arrange(const Trace &trace) {
  std::vector<Panel> panels;
  Panel lanes;
  lanes.lanes = true;
  for (const Series &series : trace.series) {
    if (series.isBool) {
      lanes.series.push_back(&series);
      continue;
    }
    const Quantity quantity = quantityOf(series.name);
    const auto same = std::find_if(panels.begin(), panels.end(),
                                   [&](const Panel &panel) { return panel.quantity == quantity; });
    if (same != panels.end())
      same->series.push_back(&series);
    else
      panels.push_back({quantity, {&series}, false});
  }
  if (!lanes.series.empty())
    panels.push_back(std::move(lanes));
  return panels;
}

class Drawing {
public:
  explicit Drawing(const Trace &trace) : trace_(trace), panels_(arrange(trace)) {
    times_ = {trace.time.front(), trace.time.back()};
    if (!(times_.high > times_.low))
      times_.high = times_.low + 1;
    timeTicks_ = niceTicks(times_.low, times_.high, 10);
  }

  std::string draw() {
    double height = kTop + kFoot;
    for (const Panel &panel : panels_)
      height += panel.height() + (panel.lanes ? 0 : kHead) + kGap;
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" "
        "font-size=\"12\" fill=\"#374151\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        px(kWidth), px(height));
    double top = kTop;
    for (const Panel &panel : panels_) {
      if (panel.lanes) {
        drawLanes(panel, top);
        top += panel.height() + kGap;
      } else {
        drawPanel(panel, top + kHead);
        top += kHead + panel.height() + kGap;
      }
    }
    drawTimeAxis(top - kGap);
    svg_ += "</svg>\n";
    return std::move(svg_);
  }

private:
  double x(double time) const {
    return kLeft + (time - times_.low) / (times_.high - times_.low) * (kWidth - kLeft - kRight);
  }

  void line(double x1, double y1, double x2, double y2, std::string_view color) {
    svg_ += fmt::format("<path d=\"M{} {}L{} {}\" stroke=\"{}\"/>\n", px(x1), px(y1), px(x2),
                        px(y2), color);
  }

  void text(double x, double y, std::string_view anchor, std::string_view content,
            std::string_view more = {}) {
    svg_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", px(x), px(y),
                        anchor, more, doc::escaped(content));
  }

  void drawFrame(double top, double height) {
    for (const double tick : timeTicks_.values)
      line(x(tick), top, x(tick), top + height, "#e5e7eb");
    svg_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#9ca3af\"/>\n",
        px(kLeft), px(top), px(kWidth - kLeft - kRight), px(height));
  }

  void drawPanel(const Panel &panel, double top) {
    const Range range = rangeOf(panel.series);
    const Ticks ticks = niceTicks(range.low, range.high, 5);
    const auto y = [&](double value) {
      return top + kPanel * (range.high - value) / (range.high - range.low);
    };
    for (const double tick : ticks.values) {
      line(kLeft, y(tick), kWidth - kRight, y(tick), "#e5e7eb");
      text(kLeft - 8, y(tick) + 4, "end", tickLabel(tick, ticks));
    }
    drawFrame(top, kPanel);
    const std::string label =
        panel.quantity.unit.empty()
            ? panel.quantity.title
            : fmt::format("{} [{}]", panel.quantity.title, panel.quantity.unit);
    const double middle = top + kPanel / 2;
    text(20, middle, "middle", label,
         fmt::format(" transform=\"rotate(-90 20 {})\" font-weight=\"600\"", px(middle)));
    drawLegend(panel, top - 9);
    std::size_t color = 0;
    for (const Series *series : panel.series)
      drawCurve(*series, y, kColors[color++ % kColors.size()]);
  }

  void drawLegend(const Panel &panel, double y) {
    double at = kLeft;
    std::size_t color = 0;
    for (const Series *series : panel.series) {
      svg_ += fmt::format("<path d=\"M{} {}h18\" stroke=\"{}\" stroke-width=\"2.5\"/>\n", px(at),
                          px(y - 4), kColors[color++ % kColors.size()]);
      text(at + 24, y, "start", series->name);
      at += 24 + 6.6 * static_cast<double>(series->name.size()) + 22;
    }
  }

  // Many samples share a pixel column: of each column the first, lowest, highest and last one are
  // drawn, in their order.
  template <class Y> void drawCurve(const Series &series, const Y &y, std::string_view color) {
    std::string path;
    bool pen = false;
    double lastX = std::numeric_limits<double>::quiet_NaN();
    double lastY = lastX;
    const auto point = [&](std::size_t i) {
      const double px1 = std::round(x(trace_.time[i]) * 100) / 100;
      const double py1 = std::round(y(series.values[i]) * 100) / 100;
      if (pen && px1 == lastX && py1 == lastY)
        return;
      path += fmt::format("{}{} {}", pen ? "L" : "M", px(px1), px(py1));
      pen = true;
      lastX = px1;
      lastY = py1;
    };
    std::size_t i = 0;
    const std::size_t size = trace_.time.size();
    while (i < size) {
      if (!std::isfinite(series.values[i])) {
        pen = false; // a gap
        ++i;
        continue;
      }
      const double column = std::floor(x(trace_.time[i]));
      std::size_t end = i;
      std::size_t low = i;
      std::size_t high = i;
      while (end < size && std::isfinite(series.values[end]) &&
             std::floor(x(trace_.time[end])) == column) {
        if (series.values[end] < series.values[low])
          low = end;
        if (series.values[end] > series.values[high])
          high = end;
        ++end;
      }
      std::array<std::size_t, 4> chosen = {i, low, high, end - 1};
      std::sort(chosen.begin(), chosen.end());
      for (std::size_t k = 0; k < chosen.size(); ++k)
        if (k == 0 || chosen[k] != chosen[k - 1])
          point(chosen[k]);
      i = end;
    }
    svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" "
                        "stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n",
                        path, color);
  }

  void drawLanes(const Panel &panel, double top) {
    drawFrame(top, panel.height());
    std::size_t color = 0;
    for (const Series *series : panel.series) {
      const double low = top + kLane - 5;
      const double high = top + 18;
      std::string path = fmt::format("M{} {}", px(x(trace_.time.front())),
                                     px(series->values.front() != 0 ? high : low));
      for (std::size_t i = 1; i < series->values.size(); ++i)
        if (series->values[i] != series->values[i - 1])
          path +=
              fmt::format("H{}V{}", px(x(trace_.time[i])), px(series->values[i] != 0 ? high : low));
      path += fmt::format("H{}", px(x(trace_.time.back())));
      svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n",
                          path, kColors[color++ % kColors.size()]);
      text(kLeft + 6, top + 13, "start", series->name, " font-size=\"11\"");
      text(kLeft - 8, high + 5, "end", "1", " font-size=\"9\"");
      text(kLeft - 8, low + 3, "end", "0", " font-size=\"9\"");
      top += kLane;
    }
  }

  void drawTimeAxis(double top) {
    for (const double tick : timeTicks_.values)
      text(x(tick), top + 17, "middle", tickLabel(tick, timeTicks_));
    text((kLeft + kWidth - kRight) / 2, top + 37, "middle", "Time [s]", " font-weight=\"600\"");
  }

  const Trace &trace_;
  std::vector<Panel> panels_;
  Range times_;
  Ticks timeTicks_;
  std::string svg_;
};

} // namespace

std::string drawSvg(const Trace &trace) { return Drawing(trace).draw(); }

} // namespace stc::cli
