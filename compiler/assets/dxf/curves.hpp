#ifndef STRIDE_COMPILER_ASSETS_DXF_CURVES_HPP
#define STRIDE_COMPILER_ASSETS_DXF_CURVES_HPP
// B-splines as pieces that G-code has.

#include "compiler/assets/dxf/pieces.hpp"

#include <cstddef>
#include <vector>

namespace stc::dxf {

/// A B-spline, rational if it has weights. Its curve is over knots[degree] to knots[n], where n is
/// how many control points there are.
struct Spline {
  int degree = 3;              ///< 1 to kMostDegree
  std::vector<double> knots;   ///< n + degree + 1, not falling
  std::vector<double> weights; ///< none, or n, positive
  std::vector<Point> control;
};
inline constexpr int kMostDegree = 11;

/// Appends the pieces of a spline that is as the comments say: lines and parabolas where it
/// consists of such, exactly; else arcs that follow each other without a bend, and lines. No place
/// of either curve is further than the tolerance from the other one. [u] Returns false if that
/// takes more than `most` pieces.
[[nodiscard]] bool appendSpline(const Spline &spline, double tolerance, size_t most,
                                std::vector<Piece> &pieces);

} // namespace stc::dxf

#endif // STRIDE_COMPILER_ASSETS_DXF_CURVES_HPP
