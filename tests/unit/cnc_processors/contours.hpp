// Contours for tests of path processors, and what is measured of paths, written without the code
// that is tested.
#ifndef STRIDE_TESTS_UNIT_CNC_PROCESSORS_CONTOURS_HPP
#define STRIDE_TESTS_UNIT_CNC_PROCESSORS_CONTOURS_HPP

#include "runtime/numeric/cnc/path_object.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace stride::cnc::contours {

struct Point {
  double x, y;
};

inline Point startOf(const PathObject &o) {
  return {o.start.coordinate[kAxisX], o.start.coordinate[kAxisY]};
}
inline Point endOf(const PathObject &o) {
  return {o.end.coordinate[kAxisX], o.end.coordinate[kAxisY]};
}
inline double gapOf(const Point &a, const Point &b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Writes a path object by object.
struct Drawing {
  std::vector<PathObject> path;
  Point here{0, 0};
  double radius = 0;

  PathObject &add(MoveType type, Point to) {
    PathObject o{};
    o.number = static_cast<int32_t>(path.size());
    o.sourceLine = 10 * o.number;
    o.moveType = type;
    o.start.axes = o.end.axes = 7;
    o.start.coordinate[kAxisX] = here.x;
    o.start.coordinate[kAxisY] = here.y;
    o.end.coordinate[kAxisX] = to.x;
    o.end.coordinate[kAxisY] = to.y;
    o.planeX = {1, 0, 0};
    o.planeY = {0, 1, 0};
    o.normal = {0, 0, 1};
    o.velocity = 50;
    o.acceleration = o.deceleration = 500;
    o.toolRadius = radius;
    o.length = gapOf(here, to);
    here = to;
    path.push_back(o);
    return path.back();
  }
  PathObject &line(double x, double y) { return add(MoveType::Line, {x, y}); }
  PathObject &rapid(double x, double y) { return add(MoveType::Positioning, {x, y}); }
  /// Around a centre, by an angle [degrees] that is positive counterclockwise.
  PathObject &arc(Point centre, double turn) {
    const double r = gapOf(here, centre);
    const double begin = std::atan2(here.y - centre.y, here.x - centre.x);
    const double end = begin + turn * M_PI / 180;
    const bool isWhole = std::fabs(turn) == 360;
    const Point to =
        isWhole ? here : Point{centre.x + r * std::cos(end), centre.y + r * std::sin(end)};
    PathObject &o = add(turn > 0 ? MoveType::Counterclockwise : MoveType::Clockwise, to);
    o.shape[0] = centre.x;
    o.shape[1] = centre.y;
    o.shape[2] = r;
    o.parameterRange[0] = begin * 180 / M_PI;
    o.parameterRange[1] = -turn;
    o.length = r * std::fabs(turn) * M_PI / 180;
    return o;
  }
  /// A cubic with these derivatives at its ends.
  PathObject &spline(Point to, Point begin, Point end) {
    const Point from = here;
    PathObject &o = add(MoveType::Spline, to);
    const double a[2] = {from.x, from.y};
    const double b[2] = {to.x, to.y};
    const double p[2] = {begin.x, begin.y};
    const double q[2] = {end.x, end.y};
    for (size_t k = 0; k < 2; ++k) {
      double *c = o.shape + 4 * k;
      c[0] = a[k];
      c[1] = p[k];
      c[2] = 3 * (b[k] - a[k]) - 2 * p[k] - q[k];
      c[3] = p[k] + q[k] - 2 * (b[k] - a[k]);
    }
    return o;
  }
  /// A quarter or more of an ellipse, main axis along X.
  PathObject &ellipse(Point centre, double a, double b, double begin, double turn) {
    const double u = begin * M_PI / 180;
    const double v = (begin + turn) * M_PI / 180;
    here = {centre.x + a * std::cos(u), centre.y + b * std::sin(u)};
    PathObject &o = add(turn > 0 ? MoveType::EllipseCounterclockwise : MoveType::EllipseClockwise,
                        {centre.x + a * std::cos(v), centre.y + b * std::sin(v)});
    o.shape[0] = centre.x;
    o.shape[1] = centre.y;
    o.shape[2] = 1;
    o.shape[4] = a;
    o.shape[5] = b;
    o.shape[7] = b / a;
    o.parameterRange[0] = begin;
    o.parameterRange[1] = -turn;
    return o;
  }
};

/// A place of an object by what its parameters say, 0 <= t <= 1.
inline Point placeOfObject(const PathObject &o, double t) {
  const double range = std::fabs(o.parameterRange[1]);
  switch (o.moveType) {
  case MoveType::Clockwise:
  case MoveType::Counterclockwise: {
    const double sign = o.moveType == MoveType::Clockwise ? -1 : 1;
    const double phi = (o.parameterRange[0] + sign * range * t) * M_PI / 180;
    return {o.shape[0] + o.shape[2] * std::cos(phi), o.shape[1] + o.shape[2] * std::sin(phi)};
  }
  case MoveType::EllipseClockwise:
  case MoveType::EllipseCounterclockwise: {
    const double sign = o.moveType == MoveType::EllipseClockwise ? -1 : 1;
    const double phi = (o.parameterRange[0] + sign * range * t) * M_PI / 180;
    const double u = o.shape[4] * std::cos(phi);
    const double v = o.shape[5] * std::sin(phi);
    return {o.shape[0] + o.shape[2] * u - o.shape[3] * v,
            o.shape[1] + o.shape[3] * u + o.shape[2] * v};
  }
  case MoveType::Spline: {
    const bool isUnit = o.parameterRange[0] == 0 && o.parameterRange[1] == 0;
    const double s =
        isUnit ? t : o.parameterRange[0] + (o.parameterRange[1] - o.parameterRange[0]) * t;
    const double *c = o.shape;
    return {c[0] + s * (c[1] + s * (c[2] + s * c[3])), c[4] + s * (c[5] + s * (c[6] + s * c[7]))};
  }
  default: {
    const Point a = startOf(o);
    const Point b = endOf(o);
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
  }
  }
}

inline bool moves(const PathObject &o) {
  return o.moveType != MoveType::Function && o.moveType != MoveType::Jump;
}

/// Places along a path; lines by their ends only, if `step` is 0.
inline std::vector<Point> sampled(const std::vector<PathObject> &path, int steps) {
  std::vector<Point> points;
  for (const PathObject &o : path) {
    if (!moves(o))
      continue;
    const bool isLine = o.moveType == MoveType::Line || o.moveType == MoveType::Positioning;
    const int parts = isLine ? 1 : steps;
    if (points.empty())
      points.push_back(startOf(o));
    for (int i = 1; i <= parts; ++i)
      points.push_back(placeOfObject(o, static_cast<double>(i) / parts));
  }
  return points;
}

inline double distanceToSegment(const Point &p, const Point &a, const Point &b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double t =
      square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

inline double distanceTo(const Point &p, const std::vector<Point> &line) {
  double least = 1e300;
  for (size_t i = 1; i < line.size(); ++i)
    least = std::min(least, distanceToSegment(p, line[i - 1], line[i]));
  return least;
}

/// Pairs of pieces of a polyline that cross, neighbours left out: each with each.
inline int crossingsIn(const std::vector<Point> &line) {
  const auto side = [](const Point &a, const Point &b, const Point &p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  int count = 0;
  for (size_t i = 1; i < line.size(); ++i)
    for (size_t k = i + 2; k < line.size(); ++k) {
      const Point &a = line[i - 1];
      const Point &b = line[i];
      const Point &c = line[k - 1];
      const Point &d = line[k];
      if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
          std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
        continue;
      const double tiny = 1e-9 * (1 + gapOf(a, b)) * (1 + gapOf(c, d));
      const double p = side(a, b, c);
      const double q = side(a, b, d);
      const double r = side(c, d, a);
      const double s = side(c, d, b);
      const bool apart =
          std::fabs(p) > tiny && std::fabs(q) > tiny && std::fabs(r) > tiny && std::fabs(s) > tiny;
      if (apart && (p > 0) != (q > 0) && (r > 0) != (s > 0))
        ++count;
    }
  return count;
}

inline double areaOf(const std::vector<Point> &line) {
  double sum = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    const Point &a = line[i];
    const Point &b = line[(i + 1) % line.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

/// The greatest gap between an end and the next start.
inline double greatestGap(const std::vector<PathObject> &path) {
  double most = 0;
  for (size_t i = 1; i < path.size(); ++i)
    if (path[i].moveType != MoveType::Jump)
      most = std::max(most, gapOf(endOf(path[i - 1]), startOf(path[i])));
  return most;
}

/// How far the ends of objects are from what their parameters say.
inline double greatestMisfit(const std::vector<PathObject> &path) {
  double most = 0;
  for (const PathObject &o : path)
    if (moves(o))
      most = std::max(
          {most, gapOf(startOf(o), placeOfObject(o, 0)), gapOf(endOf(o), placeOfObject(o, 1))});
  return most;
}

} // namespace stride::cnc::contours

#endif // STRIDE_TESTS_UNIT_CNC_PROCESSORS_CONTOURS_HPP
