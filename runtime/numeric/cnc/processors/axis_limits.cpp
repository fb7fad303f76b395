#include "runtime/numeric/cnc/processors/axis_limits.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/path/bend.hpp"

namespace stride::cnc {
namespace {

using exact::larger;
using exact::smaller;

/// Of 10 u^3 - 15 u^4 + 6 u^5, the S profile: the greatest slope and second derivative.
constexpr double kSteepest = 1.875;
constexpr double kSharpest = 5.773502691896258;

/// How an axis goes along with the way.
struct Course {
  double slope; ///< At most. [u/u]
  double bend;  ///< Its second derivative over the way, at most. [1/u]
};

/// Of A, B or C by slopes: the cubic's slope is steepest at an end or where its bend is 0.
Course bentCourse(const PathObject &object, int32_t axis, double length) noexcept {
  const double even = (object.end.coordinate[axis] - object.start.coordinate[axis]) / length;
  const double a = object.startSlope[axis - kAxisA];
  const double b = object.endSlope[axis - kAxisA];
  Course course{larger(exact::fabs(a), exact::fabs(b)),
                larger(exact::fabs(6.0 * even - 4.0 * a - 2.0 * b),
                       exact::fabs(6.0 * even - 2.0 * a - 4.0 * b)) /
                    length};
  const double u = (2.0 * a + b - 3.0 * even) / (3.0 * (a + b - 2.0 * even));
  if (u > 0.0 && u < 1.0)
    course.slope =
        larger(course.slope, exact::fabs(even + path::bentBy(a - even, b - even, u, length).d1));
  return course;
}

Course courseOf(const PathObject &object, int32_t axis, double length) noexcept {
  const double step =
      exact::fabs(object.end.coordinate[axis] - object.start.coordinate[axis]) / length;
  const int32_t angle = axis - kAxisA;
  if (angle >= 0 && angle < 3 && (object.slopes >> static_cast<unsigned>(angle) & 1U) != 0)
    return bentCourse(object, axis, length);
  const bool profile = (object.start.sProfile >> static_cast<unsigned>(axis) & 1U) != 0;
  return profile ? Course{step * kSteepest, step * kSharpest / length} : Course{step, 0.0};
}

void limitBy(const Course &course, const AxisLimits &limits, PathObject &object) noexcept {
  if (!(course.slope > 0.0))
    return;
  const double velocity = static_cast<double>(limits.velocity);
  const double acceleration = static_cast<double>(limits.acceleration);
  const double deceleration = static_cast<double>(limits.deceleration);
  // With a bend, half of the acceleration is for that.
  const double share = course.bend > 0.0 ? 0.5 : 1.0;
  if (velocity > 0.0)
    object.velocity = smaller(object.velocity, velocity / course.slope);
  if (acceleration > 0.0)
    object.acceleration = smaller(object.acceleration, share * acceleration / course.slope);
  if (deceleration > 0.0)
    object.deceleration = smaller(object.deceleration, share * deceleration / course.slope);
  if (!(course.bend > 0.0))
    return;
  const double both[] = {acceleration, deceleration};
  for (const double most : both)
    if (most > 0.0)
      object.velocity = smaller(object.velocity, exact::sqrt(share * most / course.bend));
}

} // namespace

void limitByAxes(PathObject &object) noexcept {
  ObjectShape shape{};
  if (!isMotion(object) || shapeOf(object, shape) != ShapeError::None || !(shape.length > 0.0))
    return;
  const unsigned axes = object.start.axes | object.end.axes;
  for (int32_t axis = kAxisZ; axis <= kAxisW; ++axis) {
    const bool counts =
        axis == kAxisZ ? object.planar != 0 : (axes >> static_cast<unsigned>(axis) & 1U) != 0;
    if (counts)
      limitBy(courseOf(object, axis, shape.length), object.limits[axis - kAxisZ], object);
  }
  object.velocityEnd = smaller(object.velocityEnd, object.velocity);
}

Step next(LimitByAxes & /*limit*/, const Source &source, Output &output) noexcept {
  PathObject *object = put(output, source.object);
  if (object == nullptr)
    return Step::Again;
  limitByAxes(*object);
  return Step::Took;
}

} // namespace stride::cnc
