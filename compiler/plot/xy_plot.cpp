#include "compiler/plot/xy_plot.hpp"

#include "compiler/plot/color_scale.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace stc::plot {

namespace {

constexpr double kPicture = 960; // width
constexpr double kMargin = 84;   // left of the area
constexpr double kEdge = 24;     // right of it
constexpr double kHighest = 760; // the area
constexpr double kLowest = 160;  // the area
constexpr double kTitleRow = 36; // above all
constexpr double kCurveRow = 20; // a curve each
constexpr double kFootRows = 50; // ticks and name of the axis
constexpr double kScaleRow = 44; // the scale of colours
constexpr double kUnseen = 0.25; // pixels that nobody sees

// Distinct also for colour-blind readers (Okabe and Ito).
constexpr std::array<std::string_view, 7> kCurveColors = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#555555"};

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// With room at both ends; a constant gets some.
  [[nodiscard]] Extent widened() const {
    if (low > high)
      return {0, 1};
    const double size = std::max(std::abs(low), std::abs(high));
    const double room =
        high - low > 1e-12 * size ? 0.04 * (high - low) : std::max(0.5, 0.05 * size);
    return {low - room, high + room};
  }
};

Quantity quantityOfSeries(const Series &series) {
  return series.quantity.value_or(quantityOf(series.name));
}

bool isPlace(const XyCurve &curve, size_t row) {
  return std::isfinite(curve.across->values[row]) && std::isfinite(curve.upwards->values[row]);
}

/// The name of an axis: what all its columns have in common.
std::string axisLabel(const XyPicture &picture, const Series *XyCurve::*side) {
  Quantity common = quantityOfSeries(*(picture.curves.front().*side));
  if (picture.curves.size() == 1)
    return labelOf({(picture.curves.front().*side)->name, common.unit});
  for (const XyCurve &curve : picture.curves) {
    const Quantity quantity = quantityOfSeries(*(curve.*side));
    if (quantity.title != common.title)
      common.title.clear();
    if (quantity.unit != common.unit)
      common.unit.clear();
  }
  return labelOf(common);
}

std::string tickText(double value, const Ticks &ticks) {
  return fmt::format("{:.{}f}", value == 0 ? 0.0 : value, std::min(ticks.decimals, 9));
}

class XyDrawing {
public:
  XyDrawing(const Trace &trace, const XyPicture &picture)
      : trace_(&trace), picture_(&picture), frame_(frameOf(trace, picture)) {
    if (picture.color != nullptr)
      for (const double value : picture.color->values)
        if (std::isfinite(value))
          colors_.add(value);
    if (colors_.low > colors_.high)
      colors_ = {0, 1};
  }

  std::string draw() {
    const double foot = frame_.top + frame_.height;
    const double height = foot + kFootRows + (picture_->color != nullptr ? kScaleRow : 0);
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Helvetica, Arial, 'Liberation Sans', "
        "sans-serif\" font-size=\"12\" fill=\"#374151\">\n"
        "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
        kPicture, height);
    if (!trace_->title.empty())
      text(kPicture / 2, 26, "middle", trace_->title, " font-size=\"16\" font-weight=\"600\"");
    grid();
    legend();
    for (size_t i = 0; i < picture_->curves.size(); ++i)
      curve(picture_->curves[i], kCurveColors[i % kCurveColors.size()]);
    if (picture_->color != nullptr)
      scale(foot + kFootRows);
    return svg_ + "</svg>\n";
  }

private:
  void text(double x, double y, std::string_view anchor, std::string_view what,
            std::string_view more = "") {
    svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                        anchor, more, stride::common::escapedMarkup(what));
  }

  void line(double x1, double y1, double x2, double y2) {
    svg_ += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#e5e7eb\"/>\n", x1, y1,
                        x2, y2);
  }

  void grid() {
    const double right = frame_.left + frame_.width;
    const double foot = frame_.top + frame_.height;
    const auto count = [](double pixels) {
      return std::clamp(static_cast<int>(pixels / 80), 2, 10);
    };
    const Ticks across =
        niceTicks(frame_.lowX, frame_.lowX + frame_.width / frame_.scaleX, count(frame_.width));
    for (const double tick : across.values) {
      line(frame_.x(tick), frame_.top, frame_.x(tick), foot);
      text(frame_.x(tick), foot + 17, "middle", tickText(tick, across));
    }
    const Ticks upwards =
        niceTicks(frame_.lowY, frame_.lowY + frame_.height / frame_.scaleY, count(frame_.height));
    for (const double tick : upwards.values) {
      line(frame_.left, frame_.y(tick), right, frame_.y(tick));
      text(frame_.left - 8, frame_.y(tick) + 4, "end", tickText(tick, upwards));
    }
    svg_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                        "fill=\"none\" stroke=\"#9ca3af\"/>\n",
                        frame_.left, frame_.top, frame_.width, frame_.height);
    text((frame_.left + right) / 2, foot + 38, "middle", axisLabel(*picture_, &XyCurve::across),
         " font-weight=\"600\"");
    const double middle = (frame_.top + foot) / 2;
    text(frame_.left - 62, middle, "middle", axisLabel(*picture_, &XyCurve::upwards),
         fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\" font-weight=\"600\"",
                     frame_.left - 62, middle));
  }

  /// A row for each of several curves.
  void legend() {
    if (picture_->curves.size() < 2)
      return;
    double row = frame_.top - kCurveRow * static_cast<double>(picture_->curves.size()) + 8;
    for (size_t i = 0; i < picture_->curves.size(); ++i, row += kCurveRow) {
      const XyCurve &curve = picture_->curves[i];
      svg_ += fmt::format(
          "<path d=\"M{:.1f} {:.1f}h18\" stroke=\"{}\" stroke-width=\"2.5\"/>\n", frame_.left,
          row - 4, picture_->color != nullptr ? "#9ca3af" : kCurveColors[i % kCurveColors.size()]);
      text(frame_.left + 24, row, "start", curve.across->name + ", " + curve.upwards->name);
    }
  }

  [[nodiscard]] std::string colorAt(size_t row, std::string_view own) const {
    if (picture_->color == nullptr)
      return std::string(own);
    const double value = picture_->color->values[row];
    if (!std::isfinite(value))
      return "#9ca3af";
    return colorOf(
        colorClass((value - colors_.low) / std::max(colors_.high - colors_.low, 1e-300)));
  }

  /// Runs of one colour; places that nobody could tell from the one before are left out.
  void curve(const XyCurve &curve, std::string_view own) {
    std::string points;
    std::string color;
    double lastX = 0;
    double lastY = 0;
    bool begun = false;
    const auto finish = [&] {
      if (!points.empty())
        svg_ += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" "
                            "stroke-linecap=\"round\" stroke-linejoin=\"round\" points=\"{}\"/>\n",
                            color, points);
      points.clear();
    };
    for (size_t row = 0; row < trace_->time.size(); ++row) {
      if (!isPlace(curve, row)) {
        finish();
        continue;
      }
      const double x = frame_.x(curve.across->values[row]);
      const double y = frame_.y(curve.upwards->values[row]);
      if (!points.empty() && std::hypot(x - lastX, y - lastY) < kUnseen)
        continue;
      const std::string place = fmt::format("{:.2f},{:.2f}", x, y);
      if (!begun)
        svg_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\" fill=\"none\" "
                            "stroke=\"#374151\"/>\n",
                            x, y);
      begun = true;
      const std::string next = colorAt(row, own);
      points += (points.empty() ? "" : " ") + place;
      if (next != color) {
        const bool more = points.size() > place.size();
        if (more)
          finish();
        points = place;
        color = next;
      }
      lastX = x;
      lastY = y;
    }
    finish();
  }

  void scale(double top) {
    const double left = kPicture / 2 - 200;
    const double step = 400.0 / kColorCount;
    for (size_t i = 0; i < kColorCount; ++i)
      svg_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" "
                          "fill=\"{}\"/>\n",
                          left + step * static_cast<double>(i), top, step + 0.3, colorOf(i));
    text(left, top + 26, "start", fmt::format("{:.4g}", colors_.low));
    const Quantity quantity = quantityOfSeries(*picture_->color);
    text(left + 200, top + 26, "middle", labelOf({picture_->color->name, quantity.unit}));
    text(left + 400, top + 26, "end", fmt::format("{:.4g}", colors_.high));
  }

  const Trace *trace_;
  const XyPicture *picture_;
  XyFrame frame_;
  Extent colors_;
  std::string svg_;
};

} // namespace

XyFrame frameOf(const Trace &trace, const XyPicture &picture) {
  Extent across;
  Extent upwards;
  bool same = true;
  for (const XyCurve &curve : picture.curves) {
    same = same && quantityOfSeries(*curve.across).unit == quantityOfSeries(*curve.upwards).unit;
    for (size_t row = 0; row < trace.time.size(); ++row)
      if (isPlace(curve, row)) {
        across.add(curve.across->values[row]);
        upwards.add(curve.upwards->values[row]);
      }
  }
  across = across.widened();
  upwards = upwards.widened();
  const double x = across.high - across.low;
  const double y = upwards.high - upwards.low;
  XyFrame frame{kMargin, 16, kPicture - kMargin - kEdge, 0, across.low, upwards.low, 0, 0};
  frame.top += trace.title.empty() ? 0 : kTitleRow - 8;
  if (picture.curves.size() > 1)
    frame.top += kCurveRow * static_cast<double>(picture.curves.size());
  frame.height = std::clamp(same ? frame.width * y / x : 0.6 * frame.width, kLowest, kHighest);
  frame.scaleX = frame.width / x;
  frame.scaleY = frame.height / y;
  if (!same)
    return frame;
  // The same scale both ways, what is seen in the middle.
  frame.scaleX = frame.scaleY = std::min(frame.scaleX, frame.scaleY);
  frame.lowX = (across.low + across.high - frame.width / frame.scaleX) / 2;
  frame.lowY = (upwards.low + upwards.high - frame.height / frame.scaleY) / 2;
  return frame;
}

std::string drawXySvg(const Trace &trace, const XyPicture &picture) {
  return XyDrawing(trace, picture).draw();
}

} // namespace stc::plot
