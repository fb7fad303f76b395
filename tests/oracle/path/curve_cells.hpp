// Cells of a curve that is given by its derivatives: what limits of axes leave for the motion along
// it. The curve may be of any origin; it is only looked at in many places.
#ifndef STRIDE_TESTS_ORACLE_PATH_CURVE_CELLS_HPP
#define STRIDE_TESTS_ORACLE_PATH_CURVE_CELLS_HPP

#include "tests/oracle/path/path_chain.hpp"
#include "tests/oracle/path/time_optimum.hpp"

#include <functional>
#include <span>
#include <vector>

namespace stride::oracle {

/// A curve at a way from its start: derivatives of the axes over the arc length.
struct CurvePoint {
  Place tangent;
  Place curvature; ///< [1/u]
  double feed;     ///< The velocity that the program wants there; infinite: any. [u/s]
};
using Curve = std::function<CurvePoint(double way)>;

/// Infinite: none.
struct CurveLimits {
  double velocity;         ///< Along the path. [u/s]
  double acceleration;     ///< Along the path. [u/s^2]
  Place axisVelocity;      ///< [u/s]
  Place axisAcceleration;  ///< [u/s^2]
  double curveShare = 0.9; ///< The part of an axis's acceleration that curvature may take.

  CurveLimits();
};

/// A cell between each two knots, with the strictest limits of `samples` places inside of it: the
/// sum over tangential and curvature parts counts the worst axis of each.
std::vector<Cell> cellsOf(const Curve &curve, std::span<const double> knots,
                          const CurveLimits &limits, int samples = 5);

/// Ways from 0 to `length` that follow each other after about `step` seconds of a motion with
/// limited acceleration; they grow and shrink by no more than a third. `places` evenly spaced
/// places are looked at to find out how fast that is. [u], [s] in
std::vector<double> timeKnots(const Curve &curve, double length, const CurveLimits &limits,
                              double step, size_t places);

/// A time that no motion over the cells can be below: without curvature, and over the whole length
/// with the widest of all limits. [s]
double lowerBound(std::span<const Cell> cells, double jerk);

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_CURVE_CELLS_HPP
