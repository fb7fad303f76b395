#ifndef STRIDE_COMPILER_PLOT_PATH_VIEWS_HPP
#define STRIDE_COMPILER_PLOT_PATH_VIEWS_HPP
// A path in space as a picture.

#include "compiler/plot/plot.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace stc::plot {

/// Where a motion is at some time.
struct PathPlace {
  std::array<double, 3> at; ///< X, Y, Z [u]
  double velocity;          ///< Along the path. [u/s]
};

/// The path from three sides and from a corner, coloured by velocity, and below that a trace of the
/// motion, as SVG. There must be a place and a row at least.
[[nodiscard]] std::string drawPath(const std::vector<PathPlace> &places, const Trace &trace,
                                   std::string_view title);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_PATH_VIEWS_HPP
