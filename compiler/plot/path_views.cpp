#include "compiler/plot/path_views.hpp"

#include "compiler/plot/color_scale.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc::plot {

namespace {

constexpr double kPageWidth = 960;
constexpr double kPageHead = 40;    // title
constexpr double kView = 470;       // width of a view with its margins
constexpr double kTall = 350;       // its height
constexpr double kViewMargin = 54;  // left of and below its frame
constexpr double kViewEdge = 12;    // right of and above it
constexpr double kScaleHeight = 56; // the scale of colours, below the views
constexpr double kSlight = 0.25;    // pixels that nobody sees

struct Point {
  double x, y;
};

/// A side from which the path is seen.
struct Side {
  std::string_view title, right, up;
  Point (*see)(const std::array<double, 3> &);
};

constexpr double kCosine = 0.86602540378443865; // of 30 degrees

const std::array<Side, 4> kSides = {
    {{"XY", "X [u]", "Y [u]",
      [](const std::array<double, 3> &p) {
        return Point{p[0], p[1]};
      }},
     {"XZ", "X [u]", "Z [u]",
      [](const std::array<double, 3> &p) {
        return Point{p[0], p[2]};
      }},
     {"YZ", "Y [u]", "Z [u]",
      [](const std::array<double, 3> &p) {
        return Point{p[1], p[2]};
      }},
     {"isometric", "", "", [](const std::array<double, 3> &p) {
        return Point{(p[0] - p[1]) * kCosine, p[2] + (p[0] + p[1]) * 0.5};
      }}}};

/// Frame of a view, and how its places become pixels: the same scale both ways.
struct Frame {
  double left, top, width, height;
  Point low, high; ///< What is seen. [u]
  double scale;    ///< Pixels per u.

  [[nodiscard]] double x(double value) const { return left + (value - low.x) * scale; }
  [[nodiscard]] double y(double value) const { return top + height - (value - low.y) * scale; }
};

Frame frameOf(const std::vector<PathPlace> &places, const Side &side, double left, double top) {
  Frame frame{left + kViewMargin,
              top + kViewEdge + 14,
              kView - kViewMargin - kViewEdge,
              kTall - kViewMargin - kViewEdge - 14,
              {},
              {},
              1};
  Point low = side.see(places.front().at);
  Point high = low;
  for (const PathPlace &place : places) {
    const Point p = side.see(place.at);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double perPixel =
      1.08 * std::max((high.x - low.x) / frame.width, (high.y - low.y) / frame.height);
  frame.scale = perPixel > 0 ? 1 / perPixel : 1;
  const Point middle = {(low.x + high.x) / 2, (low.y + high.y) / 2};
  const Point half = {frame.width / frame.scale / 2, frame.height / frame.scale / 2};
  frame.low = {middle.x - half.x, middle.y - half.y};
  frame.high = {middle.x + half.x, middle.y + half.y};
  return frame;
}

class Views {
public:
  explicit Views(const std::vector<PathPlace> &places) : places_(&places) {
    for (const PathPlace &place : places)
      fastest_ = std::max(fastest_, place.velocity);
  }

  std::string draw() {
    for (size_t i = 0; i < kSides.size(); ++i)
      view(kSides[i], i % 2 == 0 ? 0 : kPageWidth / 2, i < 2 ? kPageHead : kPageHead + kTall);
    legend(kPageHead + 2 * kTall);
    return std::move(svg_);
  }

private:
  void text(double x, double y, std::string_view anchor, std::string_view what,
            std::string_view more = "") {
    svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                        anchor, more, stride::common::escapedMarkup(what));
  }

  [[nodiscard]] size_t classOf(double velocity) const {
    return colorClass(fastest_ > 0 ? velocity / fastest_ : 0);
  }

  void view(const Side &side, double left, double top) {
    const Frame frame = frameOf(*places_, side, left, top);
    text(frame.left, frame.top - 6, "start", side.title, " font-weight=\"600\"");
    svg_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                        "fill=\"none\" stroke=\"#d1d5db\"/>\n",
                        frame.left, frame.top, frame.width, frame.height);
    if (!side.right.empty())
      axes(side, frame);
    path(side, frame);
  }

  void axes(const Side &side, const Frame &frame) {
    const auto label = [](double value, const Ticks &ticks) {
      return fmt::format("{:.{}f}", value == 0 ? 0.0 : value, std::min(ticks.decimals, 9));
    };
    const Ticks across = niceTicks(frame.low.x, frame.high.x, 6);
    const double foot = frame.top + frame.height;
    for (const double value : across.values)
      text(frame.x(value), foot + 16, "middle", label(value, across));
    const Ticks upwards = niceTicks(frame.low.y, frame.high.y, 5);
    for (const double value : upwards.values)
      text(frame.left - 6, frame.y(value) + 4, "end", label(value, upwards));
    text(frame.left + frame.width / 2, foot + 34, "middle", side.right);
    const double x = frame.left - kViewMargin + 10;
    const double y = frame.top + frame.height / 2;
    text(x, y, "middle", side.up, fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y));
  }

  /// Runs of one colour; places that nobody could tell from the one before are left out.
  void path(const Side &side, const Frame &frame) {
    svg_ += "<g fill=\"none\" stroke-width=\"1.4\" stroke-linecap=\"round\" "
            "stroke-linejoin=\"round\">\n";
    const auto seen = [&](const PathPlace &place) {
      const Point p = side.see(place.at);
      return Point{frame.x(p.x), frame.y(p.y)};
    };
    Point last = seen(places_->front());
    size_t color = classOf(places_->front().velocity);
    std::string points = fmt::format("{:.2f},{:.2f}", last.x, last.y);
    const auto finish = [&] {
      svg_ += fmt::format("<polyline stroke=\"{}\" points=\"{}\"/>\n", colorOf(color), points);
    };
    for (const PathPlace &place : *places_) {
      const Point here = seen(place);
      if (std::hypot(here.x - last.x, here.y - last.y) < kSlight)
        continue;
      points += fmt::format(" {:.2f},{:.2f}", here.x, here.y);
      last = here;
      if (const size_t next = classOf(place.velocity); next != color) {
        finish();
        color = next;
        points = fmt::format("{:.2f},{:.2f}", here.x, here.y);
      }
    }
    finish();
    svg_ += "</g>\n";
  }

  void legend(double top) {
    const double left = kPageWidth / 2 - 200;
    const double step = 400.0 / kColorCount;
    for (size_t i = 0; i < kColorCount; ++i)
      svg_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" "
                          "fill=\"{}\"/>\n",
                          left + step * static_cast<double>(i), top, step + 0.3, colorOf(i));
    text(left, top + 26, "start", "0");
    text(left + 200, top + 26, "middle", "Velocity [u/s]");
    text(left + 400, top + 26, "end", fmt::format("{:.4g}", fastest_));
  }

  const std::vector<PathPlace> *places_;
  double fastest_ = 0;
  std::string svg_;
};

/// The height that a picture says it has.
double pictureHeight(std::string_view svg) {
  constexpr std::string_view kWord = "height=\"";
  const size_t at = svg.find(kWord);
  return at == std::string_view::npos ? 0
                                      : std::stod(std::string(svg.substr(at + kWord.size(), 12)));
}

} // namespace

std::string drawPath(const std::vector<PathPlace> &places, const Trace &trace,
                     std::string_view title) {
  const double top = kPageHead + 2 * kTall + kScaleHeight;
  std::string curves = drawSvg(trace);
  curves.insert(curves.find("<svg ") + 5, fmt::format("y=\"{:.0f}\" ", top));
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\" "
      "fill=\"#374151\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      kPageWidth, top + pictureHeight(curves));
  svg += fmt::format("<text x=\"{}\" y=\"26\" text-anchor=\"middle\" font-size=\"16\" "
                     "font-weight=\"600\">{}</text>\n",
                     kPageWidth / 2, stride::common::escapedMarkup(title));
  return svg + Views(places).draw() + curves + "</svg>\n";
}

} // namespace stc::plot
