#include "runtime/numeric/cnc/limit_check.hpp"

#include "runtime/numeric/cnc/interpolator_objects.hpp"

namespace stride::cnc {
namespace {

/// The axes in which a place is not in the box.
unsigned outside(const PlaceLimits &box, const double (&at)[kAxes]) noexcept {
  unsigned axes = 0;
  for (int32_t axis = 0; axis < kAxes; ++axis) {
    const unsigned bit = 1U << static_cast<unsigned>(axis);
    const bool inside =
        at[axis] >= box.least->coordinate[axis] && at[axis] <= box.most->coordinate[axis];
    if ((box.axes & bit) != 0 && !inside)
      axes |= bit;
  }
  return axes;
}

/// How many places between its ends are looked at.
int32_t placesOn(const PlaceLimits &box, const path::Segment &segment) noexcept {
  const bool straight = segment.isStill || segment.shape.kind == path::ShapeKind::Line;
  if (straight && segment.profile == 0 && segment.bent == 0)
    return 0;
  const double distance = box.distance > 0.0 ? box.distance : kBoxDistance;
  const int32_t most =
      box.mostPlaces < 0 || box.mostPlaces > kMostBoxPlaces ? kMostBoxPlaces : box.mostPlaces;
  const double wanted = segment.length / distance;
  const int32_t places = wanted < most ? static_cast<int32_t>(wanted) : most;
  const int32_t least = box.fewest < most ? box.fewest : most;
  return places > least ? places : least;
}

unsigned outsideBetween(const PlaceLimits &box, const PathObject &object,
                        const path::Segment &segment) noexcept {
  const int32_t places = placesOn(box, segment);
  unsigned axes = 0;
  for (int32_t i = 1; i <= places; ++i) {
    const path::PathPoint point = path::pointAt(segment, segment.length * i / (places + 1));
    double at[kAxes];
    for (int32_t axis = 0; axis < kAxes; ++axis) {
      const bool goes =
          axis < path::kSpace ||
          (static_cast<unsigned>(segment.along) >> static_cast<unsigned>(axis) & 1U) != 0;
      at[axis] = goes ? point.at[axis] : object.start.coordinate[axis];
    }
    axes |= outside(box, at);
  }
  return axes;
}

} // namespace

BoxError checkBox(const Queue *queue, uint32_t &checked, const PlaceLimits &box,
                  BoxFinding &finding) noexcept {
  if (checkQueue(queue) != QueueError::None)
    return BoxError::NoQueue;
  const uint32_t position = __atomic_load_n(&queue->writePosition, __ATOMIC_ACQUIRE);
  // From the end back: another task may be removing objects at the front.
  for (uint32_t n = appendedSince(queue, checked); n-- > 0;) {
    const PathObject *found = objectFromEnd(queue, n);
    if (found == nullptr || isFunction(*found))
      continue;
    const PathObject &object = *found;
    unsigned axes = outside(box, object.end.coordinate);
    if (!isJump(object)) {
      path::Segment segment;
      ObjectShape shape{};
      if (outlineOf(object, shape) != ShapeError::None ||
          describeSegment(object, segment) != ShapeError::None)
        return BoxError::Object;
      axes |= outside(box, object.start.coordinate);
      if (segment.length > 0.0)
        axes |= outsideBetween(box, object, segment);
    }
    if (axes != 0 && finding.axes == 0)
      finding.line = object.sourceLine;
    finding.axes = static_cast<uint16_t>(finding.axes | axes);
  }
  checked = position;
  return BoxError::None;
}

} // namespace stride::cnc
