// Random objects of CNC paths, and where the parameters of SMC_GEOINFO lead, written down again.
#ifndef STRIDE_TESTS_PROPERTY_RANDOM_OBJECTS_HPP
#define STRIDE_TESTS_PROPERTY_RANDOM_OBJECTS_HPP

#include "runtime/numeric/cnc/path_object.hpp"

#include "tests/support/random.hpp"

#include <array>
#include <cmath>

namespace stride::test {

using namespace stride::cnc;

using Place = std::array<double, 3>;

inline double distance(const Place &a, const Place &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
inline Place placeAt(const Position &p) {
  return {p.coordinate[kAxisX], p.coordinate[kAxisY], p.coordinate[kAxisZ]};
}
inline void put(Position &position, const Place &place) {
  for (size_t i = 0; i < 3; ++i)
    position.coordinate[i] = place[i];
}

/// One of the planes that G17, G18, G19 choose, or any other.
inline void choosePlane(Random &random, PathObject &object) {
  object.planeX = {1, 0, 0};
  object.planeY = {0, 1, 0};
  object.normal = {0, 0, 1};
  const int plane = random.below(4);
  if (plane == 1) { // ZX
    object.planeX = {0, 0, 1};
    object.planeY = {1, 0, 0};
    object.normal = {0, 1, 0};
  } else if (plane == 2) { // YZ
    object.planeX = {0, 1, 0};
    object.planeY = {0, 0, 1};
    object.normal = {1, 0, 0};
  } else if (plane == 3) {
    const double a = random.uniform(-3, 3);
    const double b = random.uniform(-3, 3);
    object.planeX = {std::cos(a), std::sin(a), 0};
    object.planeY = {-std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), std::sin(b)};
    object.normal = {std::sin(a) * std::sin(b), -std::cos(a) * std::sin(b), std::cos(b)};
  }
}

inline Place inSpace(const PathObject &o, double x, double y, double n) {
  return {x * o.planeX.x + y * o.planeY.x + n * o.normal.x,
          x * o.planeX.y + y * o.planeY.y + n * o.normal.y,
          x * o.planeX.z + y * o.planeY.z + n * o.normal.z};
}

/// Where the parameters lead, `part` of the way along, in the plane of the start or rising from it
/// to that of the end.
inline Place described(const PathObject &o, double part, double low, double high) {
  const double n = low + (high - low) * part;
  const double t1 = o.parameterRange[0];
  const double t2 = o.parameterRange[1];
  if (o.moveType == MoveType::Spline) {
    const double t = t1 + (t2 - t1) * part;
    return inSpace(o, o.shape[0] + o.shape[1] * t + o.shape[2] * t * t + o.shape[3] * t * t * t,
                   o.shape[4] + o.shape[5] * t + o.shape[6] * t * t + o.shape[7] * t * t * t, n);
  }
  const bool clockwise =
      o.moveType == MoveType::Clockwise || o.moveType == MoveType::EllipseClockwise;
  const double phi = (t1 + (clockwise ? -1 : 1) * std::fabs(t2) * part) / 180 * M_PI;
  if (o.moveType == MoveType::Clockwise || o.moveType == MoveType::Counterclockwise)
    return inSpace(o, o.shape[0] + o.shape[2] * std::cos(phi),
                   o.shape[1] + o.shape[2] * std::sin(phi), n);
  const double u = o.shape[4] * std::cos(phi);
  const double v = o.shape[5] * std::sin(phi);
  return inSpace(o, o.shape[0] + o.shape[2] * u - o.shape[3] * v,
                 o.shape[1] + o.shape[3] * u + o.shape[2] * v, n);
}

struct Problem {
  PathObject object;
  double size; ///< Of the curve.
  double low;  ///< Of the start, out of the plane.
  double high; ///< Of the end.
};

inline Problem randomCurve(Random &random) {
  Problem p{};
  PathObject &o = p.object;
  choosePlane(random, o);
  constexpr MoveType kTypes[] = {MoveType::Clockwise, MoveType::Counterclockwise,
                                 MoveType::EllipseClockwise, MoveType::EllipseCounterclockwise,
                                 MoveType::Spline};
  o.moveType = kTypes[random.below(5)];
  p.size = random.magnitude(-2, 3);
  for (int i = 0; i < 8; ++i)
    o.shape[i] = p.size * random.uniform(-3, 3);
  o.parameterRange[0] = random.chance(0.2) ? 90.0 * random.below(4) : random.uniform(-400, 400);
  o.parameterRange[1] =
      random.sign() * (random.chance(0.2) ? 90.0 * (1 + random.below(4)) : random.uniform(1, 700));
  if (o.moveType == MoveType::Spline) {
    o.parameterRange[0] = random.uniform(-1, 1);
    o.parameterRange[1] = o.parameterRange[0] + random.uniform(0.2, 2);
    o.shape[1] += 40 * p.size; // does not stand still
  } else if (o.moveType == MoveType::EllipseClockwise ||
             o.moveType == MoveType::EllipseCounterclockwise) {
    const double direction = random.uniform(0, 360);
    o.shape[2] = std::cos(direction / 180 * M_PI);
    o.shape[3] = std::sin(direction / 180 * M_PI);
    o.shape[4] = p.size;
    o.shape[5] = p.size * random.uniform(0.1, 3);
    o.shape[6] = direction;
    o.shape[7] = o.shape[5] / o.shape[4];
  } else {
    o.shape[2] = p.size;
  }
  p.low = random.chance(0.3) ? 0 : p.size * random.uniform(-2, 2);
  p.high = random.chance(0.5) ? p.low : p.size * random.uniform(-2, 2);
  put(o.start, described(o, 0, p.low, p.high));
  put(o.end, described(o, 1, p.low, p.high));
  return p;
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_RANDOM_OBJECTS_HPP
