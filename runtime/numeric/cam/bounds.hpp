// How far, how fast and how hard a slave moves along a cam.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_BOUNDS_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_BOUNDS_HPP

#include "runtime/numeric/cam/curve.hpp"

#include <stdint.h>

namespace stride::cam {

/// From the least to the greatest value; empty at first.
struct Range {
  double low = __builtin_huge_val();
  double high = -__builtin_huge_val();

  void include(double value) noexcept {
    if (value < low)
      low = value;
    if (value > high)
      high = value;
  }
};

/// What the slave may come to.
struct Bounds {
  Range position;     ///< [slave u]
  Range velocity;     ///< [slave u/s]
  Range acceleration; ///< [slave u/s^2]
};

/// How the master may move: in either direction. Finite, not negative.
struct MasterLimits {
  double velocity = 1.0;     ///< Greatest magnitude. [master u/s]
  double acceleration = 0.0; ///< Greatest magnitude. [master u/s^2]
};

/// Widens `bounds` by piece `piece` of the curve, ends included. The slave's velocity is y' v and
/// its acceleration y'' v^2 + y' a, for every place x of the piece and all |v| and |a| up to the
/// limits. The bounds are reached, apart from rounding (a few units in the last place of the
/// greatest summand), and nothing goes beyond them by more than that. Where the velocity jumps
/// between two pieces the acceleration of the jump, which would be infinite, does not count. The
/// curve must be one that checkCurve finds good.
void includePiece(const Curve &curve, uint32_t piece, bool periodic, const MasterLimits &limits,
                  Bounds &bounds) noexcept;

/// The bounds of all of the curve, in a time that grows with its size. A cubic table that is not
/// `open` is taken with and without a look around the corner: good for periodic use and for other.
Bounds boundsOf(const Curve &curve, const MasterLimits &limits) noexcept;

/// As boundsOf, but only for the pieces [first, first + count) of a curve.
void includePieces(const Curve &curve, uint32_t first, uint32_t count, const MasterLimits &limits,
                   Bounds &bounds) noexcept;

/// The bounds when the slave's positions are multiplied by `factor`, which may be negative.
Bounds scaledBounds(const Bounds &bounds, double factor) noexcept;

} // namespace stride::cam

#endif
