// Objects of a path read as the manual describes their parameters, without the code that is tested.
#ifndef STRIDE_TESTS_UNIT_CNC_PROCESSORS_SAMPLED_PATH_HPP
#define STRIDE_TESTS_UNIT_CNC_PROCESSORS_SAMPLED_PATH_HPP

#include "runtime/numeric/cnc/path_object.hpp"

#include <array>
#include <cmath>

namespace stride::cnc::test {

using Point = std::array<double, 3>;

inline Point operator+(const Point &a, const Point &b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point &a, const Point &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(const Point &a, double f) { return {a[0] * f, a[1] * f, a[2] * f}; }
inline double inner(const Point &a, const Point &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double sizeOf(const Point &a) { return std::sqrt(inner(a, a)); }
inline Point outer(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point point(const Vector3 &v) { return {v.x, v.y, v.z}; }
inline Point startOf(const PathObject &o) {
  return {o.start.coordinate[0], o.start.coordinate[1], o.start.coordinate[2]};
}
inline Point endOf(const PathObject &o) {
  return {o.end.coordinate[0], o.end.coordinate[1], o.end.coordinate[2]};
}

/// The place where a part of the parameter has been gone over, by the parameters.
inline Point placeAt(const PathObject &o, double part) {
  const Point x = point(o.planeX);
  const Point y = point(o.planeY);
  const Point n = point(o.normal);
  const double height = inner(startOf(o), n) * (1 - part) + inner(endOf(o), n) * part;
  const auto inPlane = [&](double u, double v) { return x * u + y * v + n * height; };
  const auto number = [&](int i) { return i < 8 ? o.shape[i] : o.moreShape[i - 8]; };
  const double from = o.parameterRange[0];
  const double range = o.parameterRange[1];
  const bool clockwise =
      o.moveType == MoveType::Clockwise || o.moveType == MoveType::EllipseClockwise;
  const double angle = (from + (clockwise ? -part : part) * std::abs(range)) * M_PI / 180;
  const double t = from == 0 && range == 0 ? part : from + (range - from) * part;
  switch (o.moveType) {
  case MoveType::Clockwise:
  case MoveType::Counterclockwise:
    return inPlane(o.shape[0] + o.shape[2] * std::cos(angle),
                   o.shape[1] + o.shape[2] * std::sin(angle));
  case MoveType::EllipseClockwise:
  case MoveType::EllipseCounterclockwise: {
    const double c = o.shape[4] * std::cos(angle);
    const double s = o.shape[5] * std::sin(angle);
    return inPlane(o.shape[0] + o.shape[2] * c - o.shape[3] * s,
                   o.shape[1] + o.shape[3] * c + o.shape[2] * s);
  }
  case MoveType::Spline: {
    const auto cubic = [&](int i) {
      return o.shape[i] + t * (o.shape[i + 1] + t * (o.shape[i + 2] + t * o.shape[i + 3]));
    };
    return inPlane(cubic(0), cubic(4));
  }
  case MoveType::Spline3d: {
    Point p{};
    for (size_t axis = 0; axis < 3; ++axis)
      for (int k = 5; k >= 0; --k)
        p[axis] = p[axis] * t + number(static_cast<int>(axis) * 6 + k);
    return p;
  }
  default:
    return startOf(o) * (1 - part) + endOf(o) * part;
  }
}

/// Direction of the motion, of length 1.
inline Point tangentAt(const PathObject &o, double part) {
  const double h = part == 0 || part == 1 ? 1e-5 : 1e-4;
  Point d{};
  if (part == 0)
    d = placeAt(o, h) * 4 - placeAt(o, 2 * h) - placeAt(o, 0) * 3;
  else if (part == 1)
    d = placeAt(o, 1) * 3 - placeAt(o, 1 - h) * 4 + placeAt(o, 1 - 2 * h);
  else
    d = placeAt(o, part + h) - placeAt(o, part - h);
  return d * (1 / sizeOf(d));
}

/// The vector of curvature, by the circle through three places.
inline Point curvatureAt(const PathObject &o, double part, double h = 1e-3) {
  const Point a = placeAt(o, part - h);
  const Point b = placeAt(o, part);
  const Point c = placeAt(o, part + h);
  const Point ab = b - a;
  const Point bc = c - b;
  const Point ac = c - a;
  const Point up = outer(ab, bc);
  const Point toCentre = outer(up, ac);
  const double size = sizeOf(toCentre);
  const double k = 2 * sizeOf(up) / (sizeOf(ab) * sizeOf(bc) * sizeOf(ac));
  return size > 0 ? toCentre * (k / size) : Point{};
}

/// The length, by chords.
inline double lengthOf(const PathObject &o, int chords = 20000) {
  double sum = 0;
  Point before = placeAt(o, 0);
  for (int i = 1; i <= chords; ++i) {
    const Point now = placeAt(o, static_cast<double>(i) / chords);
    sum += sizeOf(now - before);
    before = now;
  }
  return sum;
}

// ---- objects

inline PathObject object(MoveType type, const Point &from, const Point &to) {
  PathObject o{};
  o.moveType = type;
  o.planeX = {1, 0, 0};
  o.planeY = {0, 1, 0};
  o.normal = {0, 0, 1};
  o.start.axes = o.end.axes = 7;
  for (size_t i = 0; i < 3; ++i) {
    o.start.coordinate[i] = from[i];
    o.end.coordinate[i] = to[i];
  }
  o.velocity = o.velocityEnd = 20;
  o.acceleration = 100;
  o.deceleration = 300;
  o.length = sizeOf(to - from);
  return o;
}

inline PathObject line(const Point &from, const Point &to) {
  return object(MoveType::Line, from, to);
}

/// In the plane of X and Y, from an angle over a sweep (positive: from X to Y). [degrees]
inline PathObject arc(const Point &centre, double radius, double from, double sweep) {
  const auto at = [&](double degrees) {
    return centre + Point{radius * std::cos(degrees * M_PI / 180),
                          radius * std::sin(degrees * M_PI / 180), 0};
  };
  PathObject o = object(sweep < 0 ? MoveType::Clockwise : MoveType::Counterclockwise, at(from),
                        at(from + sweep));
  o.shape[0] = centre[0];
  o.shape[1] = centre[1];
  o.shape[2] = radius;
  o.shape[3] = centre[2];
  o.parameterRange[0] = from;
  o.parameterRange[1] = -sweep;
  o.length = radius * std::abs(sweep) * M_PI / 180;
  return o;
}

} // namespace stride::cnc::test

#endif // STRIDE_TESTS_UNIT_CNC_PROCESSORS_SAMPLED_PATH_HPP
