#include "runtime/numeric/cnc/velocity_check.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

/// Direction of the motion at one end of an object, in all axes that its length counts.
struct Heading {
  Measure measure;
  double along[kAxes]; ///< Of length 1.
};

double normOf(const double (&v)[kAxes]) noexcept {
  double sum = 0.0;
  for (const double component : v)
    if (component != 0.0)
      sum = numeric::norm({sum, component, 0.0});
  return sum;
}

/// Directions of objects that do not move in space.
void headOtherwise(const PathObject &object, const ObjectShape &shape, Heading &heading) noexcept {
  const bool outOfPlane = shape.measure == Measure::Normal;
  const unsigned axes = object.start.axes | object.end.axes;
  for (unsigned i = 0; i < kAxes; ++i) {
    const bool counts = outOfPlane ? i <= kAxisZ : i > kAxisZ && (axes >> i & 1U) != 0;
    if (counts)
      heading.along[i] = (object.end.coordinate[i] - object.start.coordinate[i]) / shape.length;
  }
}

Heading headingOf(const PathObject &object, bool atEnd) noexcept {
  Heading heading{Measure::Nothing, {}};
  ObjectShape shape{};
  if (outlineOf(object, shape) != ShapeError::None || !(shape.length > 0.0))
    return heading;
  heading.measure = shape.measure;
  if (shape.shape.length > 0.0) {
    const Vector3 tangent = atEnd ? tangentAtEnd(shape) : tangentAtStart(shape);
    heading.along[kAxisX] = tangent.x;
    heading.along[kAxisY] = tangent.y;
    heading.along[kAxisZ] = tangent.z;
  } else {
    headOtherwise(object, shape, heading);
  }
  return heading;
}

/// Whether the path stops there whatever its directions are.
bool isStop(const PathObject &object) noexcept {
  return !isMotion(object) || object.moveType == MoveType::Positioning;
}

/// How far an axis moves per length of the path, at one end of the object.
double slopeOf(const PathObject &object, unsigned axis, double length, bool atEnd) noexcept {
  const bool isAngle = axis >= kAxisA && axis <= kAxisC;
  const unsigned angle = axis - kAxisA;
  if (isAngle && (object.slopes >> angle & 1U) != 0)
    return atEnd ? object.endSlope[angle] : object.startSlope[angle];
  if ((object.start.sProfile >> axis & 1U) != 0)
    return 0.0;
  return (object.end.coordinate[axis] - object.start.coordinate[axis]) / length;
}

/// The greatest jump of an axis's slope.
double slopeJump(const PathObject &before, const PathObject &after) noexcept {
  ObjectShape first{};
  ObjectShape second{};
  if (shapeOf(before, first) != ShapeError::None || shapeOf(after, second) != ShapeError::None)
    return exact::kInfinity;
  const unsigned axes = before.start.axes | before.end.axes | after.start.axes | after.end.axes;
  double most = 0.0;
  for (unsigned axis = kAxisA; axis < kAxes; ++axis)
    if ((axes >> axis & 1U) != 0)
      most = exact::larger(most, exact::fabs(slopeOf(before, axis, first.length, true) -
                                             slopeOf(after, axis, second.length, false)));
  return most;
}

bool isUsable(const PathObject &object) noexcept {
  return !isMotion(object) ||
         (exact::isPositive(object.velocity) && exact::isPositive(object.acceleration) &&
          exact::isPositive(object.deceleration));
}

} // namespace

double cornerAngle(const PathObject &before, const PathObject &after) noexcept {
  const Heading a = headingOf(before, true);
  const Heading b = headingOf(after, false);
  if (a.measure == Measure::Nothing || a.measure != b.measure)
    return exact::kInfinity;
  double sum[kAxes];
  double difference[kAxes];
  for (int i = 0; i < kAxes; ++i) {
    sum[i] = a.along[i] + b.along[i];
    difference[i] = a.along[i] - b.along[i];
  }
  return 2.0 * ::stride::atan2(normOf(difference), normOf(sum));
}

double cornerVelocity(const PathObject &before, const PathObject &after,
                      const CornerRules &rules) noexcept {
  if (isStop(before) || isStop(after))
    return 0.0;
  const double angle = rules.angle > kLeastAngle ? rules.angle : kLeastAngle;
  const double corner = cornerAngle(before, after);
  if (!(corner <= angle) || corner == exact::kInfinity)
    return 0.0;
  double velocity = exact::smaller(before.velocity, after.velocity);
  if (rules.axisJump >= 0.0) {
    const double jump = slopeJump(before, after);
    if (jump * velocity > rules.axisJump)
      velocity = rules.axisJump / jump;
  }
  return velocity;
}

VelocityError checkVelocities(Queue *queue, uint32_t &checked, const CornerRules &rules) noexcept {
  if (checkQueue(queue) != QueueError::None)
    return VelocityError::NoQueue;
  const uint32_t position = __atomic_load_n(&queue->writePosition, __ATOMIC_ACQUIRE);
  // From the end back: another task may be removing objects at the front.
  for (uint32_t n = appendedSince(queue, checked); n-- > 0;) {
    PathObject *object = objectFromEnd(queue, n);
    if (object == nullptr)
      continue;
    if (!isUsable(*object))
      return VelocityError::NotPositive;
    if (isStop(*object) || !(object->velocityEnd > 0.0))
      object->velocityEnd = 0.0;
    PathObject *before = objectFromEnd(queue, n + 1);
    if (before == nullptr)
      continue;
    const double velocity = cornerVelocity(*before, *object, rules);
    before->velocityEnd = exact::smaller(before->velocityEnd, velocity);
  }
  PathObject *last = objectFromEnd(queue, 0);
  if (queue->endOfList != 0 && last != nullptr)
    last->velocityEnd = 0.0;
  checked = position;
  tellChecked(queue, position);
  return VelocityError::None;
}

} // namespace stride::cnc
