// B-splines of degree 5 over the corners of a polygon, piece by piece: clamped, so that they begin
// and end at its ends in the direction of its sides. Free of the C++ standard library: linked into
// every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_BSPLINE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_BSPLINE_HPP

#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

inline constexpr int32_t kSplineDegree = 5;
inline constexpr int32_t kSplineCorners = kSplineDegree + 1;   ///< That make one piece.
inline constexpr int32_t kSplineSpans = 2 * kSplineDegree - 1; ///< Whose knots make one piece.

/// One piece of a B-spline: what it depends on.
struct SplineWindow {
  double corner[kSplineCorners][kAxes]; ///< Of the polygon.
  /// How far the knots are apart: of the four pieces before, of this one and of the four pieces
  /// after; 0 where there is none.
  double span[kSplineSpans];
};

/// The same piece as Bezier's points: it begins at the first one and ends at the last one.
void bezierOf(const SplineWindow &window, double (&points)[kSplineCorners][kAxes]) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_BSPLINE_HPP
