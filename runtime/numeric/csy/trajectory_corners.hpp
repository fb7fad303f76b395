// Shapes of the segments of a path: blends and arcs. Part of trajectory.hpp, which is for
// everybody.
#ifndef STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_CORNERS_HPP
#define STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_CORNERS_HPP

#include "runtime/numeric/csy/trajectory.hpp"

namespace stride::csy {

/// A corner of two lines.
struct Corner {
  Vector3 at;
  Vector3 before; ///< direction of the line that ends there, of length 1
  Vector3 after;  ///< direction of the one that begins there
  double first;   ///< length taken from the line before [mm]
  double second;  ///< and from the one after [mm]
};

/// A shape, and how far the master goes on it.
struct Stretch {
  path::Shape shape;
  double length; ///< [mm]
};

/// Blends of type 1 (cubic) and 2 (quintic). `form`: KF / 100.
Stretch polynomialBlend(const Corner &corner, double form, bool quintic) noexcept;

/// A blend of type 10, with corner.first on both lines. `longWay`: around the rest of the circle.
/// Errors: ArcOfHalfTurn, ArcOfNoTurn.
PathError arcBlend(const Corner &corner, bool longWay, Stretch &stretch) noexcept;

/// Type 11: the arc below half a turn. Errors: NoCircle, RadiusZero, RadiusTooSmall.
PathError arcByRadius(const Vector3 &from, const Vector3 &to, double radius, bool clockwise,
                      Stretch &stretch) noexcept;

/// Type 12: from equal points a whole circle. The centre is moved to where it is as far from both.
/// Errors: NoCircle, CentreOff.
PathError arcByCentre(const Vector3 &from, const Vector3 &to, const Vector3 &centre, bool clockwise,
                      Stretch &stretch) noexcept;

} // namespace stride::csy

#endif // STRIDE_RUNTIME_NUMERIC_CSY_TRAJECTORY_CORNERS_HPP
