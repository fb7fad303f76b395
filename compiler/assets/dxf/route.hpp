#ifndef STRIDE_COMPILER_ASSETS_DXF_ROUTE_HPP
#define STRIDE_COMPILER_ASSETS_DXF_ROUTE_HPP
// In which order contours are driven, and where they begin.

#include "compiler/assets/dxf/contours.hpp"

namespace stc::dxf {

/// Where a contour can begin.
struct Beginning {
  size_t piece = 0;
  double part = 0; ///< Of the piece: 0, or where it is halved.
  Point from;      ///< Where the tool has to be before.
  Point to;        ///< Where it is afterwards.
};

/// A contour as it can be driven: closed ones from any of several places, open ones from each end.
struct Stop {
  std::vector<Beginning> beginnings; ///< Of open ones two: forwards, backwards.
  bool closed = false;
  int32_t within = -1; ///< The contour that has to come later; -1: none.
};

/// One contour of a route.
struct Visit {
  size_t contour = 0;
  size_t beginning = 0;
};

/// An order of all contours with a short way between them, always the same one: the next contour is
/// the nearest, then parts of the route are turned round as long as that makes it shorter, and
/// closed contours begin where it is shortest. Never longer than the order of the list.
[[nodiscard]] std::vector<Visit> routeOf(const std::vector<Stop> &stops, Point start);

/// The way between contours. [u]
[[nodiscard]] double travelOf(const std::vector<Stop> &stops, const std::vector<Visit> &route,
                              Point start);

/// The order of the list, but for what lies within others; each from its first beginning.
[[nodiscard]] std::vector<Visit> drawnRoute(const std::vector<Stop> &stops);

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_ROUTE_HPP
