#include "runtime/numeric/csy/trajectory_corners.hpp"

#include "runtime/iec/math.h"

namespace stride::csy {

using exact::fabs;
using exact::isPositive;
using numeric::cross;
using numeric::dot;
using numeric::kZero;
using numeric::norm;

namespace {

constexpr double kPi = 3.141592653589793;
/// Coordinates are REAL: a turn below this is none. [rad]
constexpr double kLeastTurn = 1e-6;
constexpr double kRounding = 1e-6; ///< of REAL numbers, relative

/// In the plane, a quarter turn counter-clockwise.
Vector3 quarterTurn(const Vector3 &v) noexcept { return {-v.y, v.x, 0.0}; }

Stretch arcFrom(const Vector3 &from, const Vector3 &centre, double sweep) noexcept {
  const Vector3 radial = from - centre;
  return {path::arcShape(centre, radial, quarterTurn(radial), 0.0, sweep, kZero),
          norm(radial) * fabs(sweep)};
}

} // namespace

Stretch polynomialBlend(const Corner &corner, double form, bool quintic) noexcept {
  const Vector3 from = corner.at - corner.before * corner.first;
  const Vector3 to = corner.at + corner.after * corner.second;
  const double length = corner.first + corner.second;
  const Vector3 leaving = corner.before * (form * length);
  const Vector3 arriving = corner.after * (form * length);
  if (quintic)
    return {path::quinticShape({from, leaving, kZero, kZero}, {to, arriving, kZero, kZero}),
            length};
  const Vector3 way = to - from;
  const Vector3 coefficients[6] = {
      from,  leaving, way * 3.0 - leaving * 2.0 - arriving, leaving + arriving - way * 2.0,
      kZero, kZero};
  return {path::polynomialShape(coefficients), length};
}

PathError arcBlend(const Corner &corner, bool longWay, Stretch &stretch) noexcept {
  const double turn =
      ::stride::atan2(cross(corner.before, corner.after).z, dot(corner.before, corner.after));
  if (fabs(turn) > kPi - kLeastTurn)
    return PathError::ArcOfHalfTurn;
  if (fabs(turn) < kLeastTurn)
    return PathError::ArcOfNoTurn;
  const double side = exact::signOf(turn);
  const double radius = corner.first * (1.0 + dot(corner.before, corner.after)) /
                        fabs(cross(corner.before, corner.after).z);
  const Vector3 from = corner.at - corner.before * corner.first;
  const Vector3 centre = from + quarterTurn(corner.before) * (side * radius);
  stretch = arcFrom(from, centre, longWay ? turn - side * 2.0 * kPi : turn);
  return PathError::None;
}

PathError arcByRadius(const Vector3 &from, const Vector3 &to, double radius, bool clockwise,
                      Stretch &stretch) noexcept {
  const Vector3 way = to - from;
  const double half = 0.5 * norm(way);
  if (!isPositive(half))
    return PathError::NoCircle;
  if (radius == 0.0)
    return PathError::RadiusZero;
  if (!exact::isfinite(radius) || !(radius >= half * (1.0 - kRounding)))
    return PathError::RadiusTooSmall;
  const double height =
      radius > half ? exact::sqrt((radius - half) * (radius + half)) : 0.0; // of the centre
  const double side = clockwise ? -1.0 : 1.0;
  const Vector3 centre = from + way * 0.5 + quarterTurn(way) * (side * height / (2.0 * half));
  stretch = arcFrom(from, centre, side * 2.0 * ::stride::atan2(half, height));
  return PathError::None;
}

PathError arcByCentre(const Vector3 &from, const Vector3 &to, const Vector3 &centre, bool clockwise,
                      Stretch &stretch) noexcept {
  const Vector3 way = to - from;
  const double distance = norm(way);
  const double side = clockwise ? -1.0 : 1.0;
  if (distance == 0.0) {
    if (!isPositive(norm(from - centre)))
      return exact::isfinite(norm(from - centre)) ? PathError::NoCircle : PathError::CentreOff;
    stretch = arcFrom(from, centre, side * 2.0 * kPi);
    return PathError::None;
  }
  const Vector3 across = quarterTurn(way) * (1.0 / distance);
  const Vector3 middle = from + way * 0.5;
  const Vector3 exactCentre = middle + across * dot(centre - middle, across);
  const double radius = norm(from - exactCentre);
  if (!exact::isfinite(radius) || !(norm(centre - exactCentre) <= 0.5 * radius))
    return PathError::CentreOff;
  const Vector3 first = from - exactCentre;
  const Vector3 last = to - exactCentre;
  const double turn = ::stride::atan2(cross(first, last).z, dot(first, last));
  const double forward = turn * side; // in the direction of the arc
  stretch = arcFrom(from, exactCentre, side * (forward > 0.0 ? forward : forward + 2.0 * kPi));
  return PathError::None;
}

} // namespace stride::csy
