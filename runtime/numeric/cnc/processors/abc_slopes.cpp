#include "runtime/numeric/cnc/processors/abc_slopes.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

namespace stride::cnc {
namespace {

constexpr int32_t kAngles = 3; ///< A, B and C.

bool follows(const PathObject &object, int32_t angle) noexcept {
  return (static_cast<unsigned>(object.end.axes) >> static_cast<unsigned>(kAxisA + angle) & 1U) !=
         0;
}

/// The length that the motion counts; 0 if it has none.
double lengthOf(const PathObject &object) noexcept {
  ObjectShape shape{};
  return shapeOf(object, shape) == ShapeError::None ? shape.length : 0.0;
}

double slopeAtStop(const AbcSlopes &slopes, const PathObject &object, double length,
                   int32_t angle) noexcept {
  const int32_t axis = kAxisA + angle;
  return slopes.linearAtStops && length > 0.0
             ? (object.end.coordinate[axis] - object.start.coordinate[axis]) / length
             : 0.0;
}

/// Lets the object go by slopes, and begin at a stop.
void begin(const AbcSlopes &slopes, double length, PathObject &object) noexcept {
  object.slopes = 0;
  for (int32_t i = 0; i < kAngles; ++i) {
    if (follows(object, i))
      object.slopes |= static_cast<uint8_t>(1U << static_cast<unsigned>(i));
    object.startSlope[i] = slopeAtStop(slopes, object, length, i);
  }
}

/// Where the path goes on from one object to the other; `length` is that of both.
void join(PathObject &before, PathObject &after, double length) noexcept {
  for (int32_t i = 0; i < kAngles; ++i) {
    const int32_t axis = kAxisA + i;
    // An axis that does not move yet, or no longer, stands still there.
    const bool both = follows(before, i) && follows(after, i) && length > 0.0;
    const double way = after.end.coordinate[axis] - before.start.coordinate[axis];
    before.endSlope[i] = after.startSlope[i] = both ? way / length : 0.0;
  }
}

/// Puts out what is held; nothing follows it without a stop.
void release(AbcSlopes &slopes, Output &output) noexcept {
  if (!slopes.holds)
    return;
  for (int32_t i = 0; i < kAngles; ++i)
    slopes.held.endSlope[i] = slopeAtStop(slopes, slopes.held, slopes.length, i);
  (void)put(output, slopes.held);
  slopes.holds = false;
}

} // namespace

Step next(AbcSlopes &slopes, const Source &source, Output &output) noexcept {
  if (!exact::isfinite(slopes.angle) || !(slopes.angle >= 0.0)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  if (!isMotion(source.object)) {
    release(slopes, output);
    (void)put(output, source.object);
    return Step::Took;
  }
  PathObject object = source.object;
  const double length = lengthOf(object);
  begin(slopes, length, object);
  if (slopes.holds && cornerVelocity(slopes.held, object, {slopes.angle, -1.0}) > 0.0) {
    join(slopes.held, object, slopes.length + length);
    (void)put(output, slopes.held);
  } else {
    release(slopes, output);
  }
  slopes.held = object;
  slopes.length = length;
  slopes.holds = true;
  return Step::Took;
}

Step finish(AbcSlopes &slopes, Ending /*ending*/, Output &output) noexcept {
  release(slopes, output);
  return Step::Took;
}

} // namespace stride::cnc
