#include "runtime/numeric/cam/approach.hpp"

#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

/// A quartic on [0, 1] by its Bernstein coefficients.
struct Bernstein {
  double c[5];
};

/// Whether it is below `floor` anywhere. Halves the interval (de Casteljau) until the coefficients
/// tell: all of them above, or one that is a value of the quartic below.
bool fallsBelow(const Bernstein &whole, double floor) noexcept {
  constexpr int kDepth = 24;
  Bernstein parts[kDepth + 1];
  int depth[kDepth + 1];
  int count = 0;
  parts[count] = whole;
  depth[count++] = 0;
  while (count > 0) {
    const Bernstein part = parts[--count];
    const int level = depth[count];
    if (part.c[0] < floor || part.c[4] < floor)
      return true;
    if (!(part.c[1] < floor || part.c[2] < floor || part.c[3] < floor) || level == kDepth)
      continue;
    Bernstein left = part;
    Bernstein right = part;
    for (int i = 1; i < 5; ++i)
      for (int k = 4; k >= i; --k)
        left.c[k] = 0.5 * (left.c[k - 1] + left.c[k]);
    for (int i = 1; i < 5; ++i)
      for (int k = 0; k <= 4 - i; ++k)
        right.c[k] = 0.5 * (right.c[k] + right.c[k + 1]);
    parts[count] = right;
    depth[count++] = level + 1;
    parts[count] = left;
    depth[count++] = level + 1;
  }
  return false;
}

} // namespace

bool placeOver(const numeric::MotionState &slave, double x, double velocity, double acceleration,
               Node &place) noexcept {
  place = {x, slave.position, 0.0, 0.0};
  if (slave.velocity == 0.0 && slave.acceleration == 0.0)
    return true;
  place.v = slave.velocity / velocity;
  place.a = (slave.acceleration - place.v * acceleration) / (velocity * velocity);
  return exact::isfinite(place.v) && exact::isfinite(place.a);
}

numeric::MotionState motionOver(const Point &place, double velocity, double acceleration) noexcept {
  return {place.y, place.v * velocity, place.a * (velocity * velocity) + place.v * acceleration};
}

double evenWay(const Approach &approach) noexcept {
  const double h = approach.end.x - approach.begin.x;
  return (0.5 * (approach.begin.v + approach.end.v) +
          0.075 * (approach.begin.a - approach.end.a) * h) *
         h;
}

bool reverses(const Approach &approach) noexcept {
  const Node &begin = approach.begin;
  const Node &end = approach.end;
  const double h = end.x - begin.x;
  const double v0 = begin.v * h;
  const double v1 = end.v * h;
  const double a0 = begin.a * h * h;
  const double a1 = end.a * h * h;
  const double way = end.y - begin.y;
  const double side = exact::signOf(v1 != 0.0 ? v1 : way);
  // The derivative of the quintic as a Bernstein polynomial: its ends and their slopes are known,
  // and the mean of its coefficients is the way.
  const double c1 = v0 + 0.25 * a0;
  const double c3 = v1 - 0.25 * a1;
  const double c2 = 5.0 * way - v0 - c1 - c3 - v1;
  const Bernstein slope{{side * v0, side * c1, side * c2, side * c3, side * v1}};
  double size = 0.0;
  for (const double c : slope.c)
    size = exact::larger(size, exact::fabs(c));
  return fallsBelow(slope, -1e-12 * size);
}

} // namespace stride::cam
