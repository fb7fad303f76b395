#include "runtime/numeric/cnc/processors/bspline.hpp"

namespace stride::cnc {
namespace {

/// The axes that move between the corners; others stay where they are.
int32_t movingAxes(const SplineWindow &window, int32_t (&axes)[kAxes]) noexcept {
  int32_t count = 0;
  for (int32_t k = 0; k < kAxes; ++k) {
    bool moves = false;
    for (int32_t i = 1; i < kSplineCorners; ++i)
      moves = moves || window.corner[i][k] != window.corner[0][k];
    if (moves)
      axes[count++] = k;
  }
  return count;
}

/// The polar form of the piece at five arguments, of which `late` are its end and the others its
/// beginning: Bezier's point number `late`. `knot` are the ten knots around the piece, which lies
/// between knot[4] and knot[5].
void polarForm(const SplineWindow &window, const double (&knot)[2 * kSplineDegree], int32_t late,
               const int32_t (&axes)[kAxes], int32_t count, double (&point)[kAxes]) noexcept {
  double d[kSplineCorners][kAxes];
  __builtin_memcpy(d, window.corner, sizeof d);
  for (int32_t r = 1; r <= kSplineDegree; ++r) {
    const double at = r <= late ? knot[kSplineDegree] : knot[kSplineDegree - 1];
    for (int32_t i = kSplineDegree; i >= r; --i) {
      const double from = knot[i - 1];
      const double to = knot[i + kSplineDegree - r];
      const double part = (at - from) / (to - from);
      for (int32_t n = 0; n < count; ++n) {
        const int32_t k = axes[n];
        d[i][k] = d[i - 1][k] + (d[i][k] - d[i - 1][k]) * part;
      }
    }
  }
  __builtin_memcpy(point, d[kSplineDegree], sizeof point);
}

} // namespace

void bezierOf(const SplineWindow &window, double (&points)[kSplineCorners][kAxes]) noexcept {
  double knot[2 * kSplineDegree];
  knot[0] = 0.0;
  for (int32_t i = 0; i < kSplineSpans; ++i)
    knot[i + 1] = knot[i] + window.span[i];
  int32_t axes[kAxes];
  const int32_t count = movingAxes(window, axes);
  for (int32_t late = 0; late <= kSplineDegree; ++late)
    polarForm(window, knot, late, axes, count, points[late]);
}

} // namespace stride::cnc
