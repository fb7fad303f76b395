#ifndef STRIDE_COMPILER_PLOT_XY_PLOT_HPP
#define STRIDE_COMPILER_PLOT_XY_PLOT_HPP
// Columns of a trace against each other: the paths that axes drive together.

#include "compiler/plot/plot.hpp"

namespace stc::plot {

/// A curve: two columns of a trace.
struct XyCurve {
  const Series *across = nullptr;
  const Series *upwards = nullptr;
};

/// What is drawn of a trace, which must outlive it.
struct XyPicture {
  std::vector<XyCurve> curves;   ///< One at least.
  const Series *color = nullptr; ///< Its values colour the curves; null: each has its own colour.
};

/// How places become pixels. Both axes have the same scale, unless their units differ.
struct XyFrame {
  double left, top, width, height; ///< Of the area. [px]
  double lowX, lowY;               ///< What is seen at its left, and at its bottom.
  double scaleX, scaleY;           ///< Pixels per unit.

  [[nodiscard]] double x(double value) const { return left + (value - lowX) * scaleX; }
  [[nodiscard]] double y(double value) const { return top + height - (value - lowY) * scaleY; }
};
[[nodiscard]] XyFrame frameOf(const Trace &trace, const XyPicture &picture);

/// The curves as an SVG picture, each with a ring where it begins. Rows whose values are no numbers
/// are gaps.
[[nodiscard]] std::string drawXySvg(const Trace &trace, const XyPicture &picture);

/// The same as an HTML page that needs nothing else, with a cursor that shows the nearest row and a
/// zoom.
[[nodiscard]] std::string drawXyPage(const Trace &trace, const XyPicture &picture);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_XY_PLOT_HPP
