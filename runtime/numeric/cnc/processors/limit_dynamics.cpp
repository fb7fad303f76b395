#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"

#include "runtime/numeric/cnc/interpolator_objects.hpp"

namespace stride::cnc {
namespace {

using exact::larger;
using exact::smaller;

/// Of an axis's acceleration, what bends of the path may take; the rest is for changes of velocity.
constexpr double kBendShare = 0.5;
/// Parts of an object that is neither straight nor an arc, at most, so that a call is never long.
/// They are as long as the object is even: a curve may bend sharply at a place of its own.
constexpr int32_t kMostParts = 256;
/// Of what these have left over.
constexpr int32_t kParts = 32;

/// What the axes' limits make of a whole object.
struct Bounds {
  double ceiling = exact::kInfinity; ///< Of the square of the velocity. [u^2/s^2]
  double along = 0.0;                ///< Acceleration that one of the path means, over the limit.
  double across = 0.0;               ///< Likewise, of the square of the velocity.
};

void add(Bounds &bounds, const path::Strip &strip) noexcept {
  bounds.along = larger(bounds.along, strip.along);
  bounds.across = larger(bounds.across, strip.across);
  bounds.ceiling = smaller(bounds.ceiling, strip.ceiling);
}

Bounds boundsOf(const path::Segment &segment, const path::AxesLimits &limits) noexcept {
  Bounds bounds;
  path::Strip strip{};
  const bool isArc = !segment.isStill && segment.shape.kind == path::ShapeKind::Arc;
  if (isArc && segment.profile == 0 && segment.bent == 0) {
    path::limitArc(segment, limits, strip);
    return {strip.ceiling, strip.along, strip.across};
  }
  double from = 0.0;
  for (int32_t i = 0; i < kMostParts && from < segment.length; ++i) {
    const double to = path::limitStrip(segment, limits, from, strip);
    add(bounds, strip);
    if (!(to > from))
      break;
    from = to;
  }
  const double part = (segment.length - from) / kParts;
  for (int32_t i = 0; i < kParts && part > 0.0; ++i) {
    path::limitBetween(segment, limits, from + part * i, from + part * (i + 1), strip);
    add(bounds, strip);
  }
  return bounds;
}

void limitBy(const Bounds &bounds, PathObject &object) noexcept {
  double ceiling = bounds.ceiling;
  if (bounds.across > 0.0)
    ceiling = smaller(ceiling, kBendShare / bounds.across);
  if (ceiling < exact::kInfinity)
    object.velocity = smaller(object.velocity, exact::sqrt(ceiling));
  if (bounds.along > 0.0) {
    const double left = 1.0 - bounds.across * object.velocity * object.velocity;
    object.acceleration = smaller(object.acceleration, left / bounds.along);
    object.deceleration = smaller(object.deceleration, left / bounds.along);
  }
  object.velocityEnd = smaller(object.velocityEnd, object.velocity);
}

bool isLimit(double value) noexcept { return exact::isfinite(value) && value >= 0.0; }

} // namespace

Step next(LimitDynamics &limit, const Source &source, Output &output) noexcept {
  if (!isLimit(limit.velocity) || !isLimit(limit.acceleration)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  path::AxesLimits limits{};
  for (int32_t axis = 0; axis < kAxes; ++axis)
    if ((static_cast<unsigned>(limit.axes) >> static_cast<unsigned>(axis) & 1U) != 0) {
      limits.velocity[axis] = limit.velocity;
      limits.acceleration[axis] = limit.acceleration;
    }
  PathObject *object = put(output, source.object);
  path::Segment segment;
  ObjectShape shape{};
  if (object != nullptr && isMotion(*object) && outlineOf(*object, shape) == ShapeError::None &&
      describeSegment(*object, segment) == ShapeError::None && segment.length > 0.0)
    limitBy(boundsOf(segment, limits), *object);
  return object != nullptr ? Step::Took : Step::Again;
}

} // namespace stride::cnc
