#include "runtime/numeric/cnc/x_interpolator.hpp"

#include "runtime/numeric/cnc/interpolator_objects.hpp"
#include "runtime/numeric/cnc/switch_points.hpp"

namespace stride::cnc {
namespace {

using numeric::norm;

constexpr int kTrials = 120; ///< For the way at an X.

void fail(XFollower &follower, XError error) noexcept {
  follower.phase = XPhase::Failed;
  follower.error = error;
}

/// Passes the switch points up to a part of the object's length, the nearest first.
void passSwitches(XFollower &follower, const PathObject &object, double part) noexcept {
  while (const int16_t number = passSwitch(object, part, follower.passed)) {
    follower.lastSwitch = number;
    setSwitch(follower.switches, number);
  }
}

/// Puts the path to a way of the first object.
void put(XFollower &follower, const PathObject &object, double way) noexcept {
  const path::PathPoint point = path::pointAt(follower.here, way);
  Position &position = follower.position;
  position.frame = object.end.frame;
  position.axes = object.end.axes;
  position.sProfile = object.start.sProfile;
  for (int32_t k = 0; k < kAxes; ++k)
    position.coordinate[k] = (position.axes >> static_cast<unsigned>(k) & 1U) != 0
                                 ? point.at[k]
                                 : object.end.coordinate[k];
  follower.length += exact::fabs(way - follower.way);
  follower.way = way;
  const Vector3 direction{point.d1[kAxisX], point.d1[kAxisY], point.d1[kAxisZ]};
  const double size = norm(direction);
  follower.tangent = size > 0.0 ? direction * (1.0 / size) : numeric::kZero;
  follower.source = object.sourceLine;
}

/// Begins with the first object that moves. False: there is none, or an error.
bool begin(XFollower &follower, Queue *queue, bool forward) noexcept {
  // Somebody else may have emptied the queue.
  follower.begun = follower.begun && objectAt(queue, 0) != nullptr;
  while (!follower.begun) {
    const PathObject *object = objectAt(queue, 0);
    if (object == nullptr)
      return false;
    if (!waitsAt(*object)) {
      if (describeSegment(*object, follower.here) != ShapeError::None) {
        fail(follower, XError::Shape);
        return false;
      }
      if (follower.here.length > 0.0) {
        const double step = object->end.coordinate[kAxisX] - object->start.coordinate[kAxisX];
        if (!(forward ? step > 0.0 : step < 0.0)) {
          fail(follower, XError::NoIntersection);
          return false;
        }
        follower.begun = true;
        follower.way = 0.0;
        follower.passed = 0;
        return true;
      }
    }
    (void)removeAt(queue, 0);
  }
  return true;
}

/// The way where the object's X is `x`, between two ways where it is on either side: Newton's
/// steps, halves where these leave the range or do not become half as long each time. In a bend
/// they would go to and fro on both sides of the place.
double wayAt(const path::Segment &segment, double x, bool forward) noexcept {
  double low = 0.0;
  double high = segment.length;
  double way = 0.5 * high;
  double step = high;
  for (int trial = 0; trial < kTrials; ++trial) {
    const path::PathPoint point = path::pointAt(segment, way);
    const double off = point.at[kAxisX] - x;
    if (off == 0.0)
      return way;
    ((off > 0.0) == forward ? high : low) = way;
    const double next = way - off / point.d1[kAxisX];
    const double before = way;
    const bool closes = next > low && next < high && exact::fabs(next - before) < 0.5 * step;
    way = closes ? next : 0.5 * (low + high);
    if (way == before)
      break;
    step = exact::fabs(way - before);
  }
  return way;
}

} // namespace

void startFollowing(XFollower &follower) noexcept {
  __builtin_memset(&follower, 0, sizeof follower);
  follower.source = -1;
  follower.phase = XPhase::Waiting;
}

void follow(XFollower &follower, Queue *queue, double x, bool forward) noexcept {
  if (follower.phase == XPhase::Done || follower.phase == XPhase::Failed)
    return;
  follower.length = 0.0;
  follower.lastSwitch = 0;
  if (checkQueue(queue) != QueueError::None || !exact::isfinite(x)) {
    fail(follower, exact::isfinite(x) ? XError::NoQueue : XError::NoIntersection);
    return;
  }
  const double sign = forward ? 1.0 : -1.0;
  for (;;) {
    // Before the objects are looked at: the last one comes before it.
    const bool complete = __atomic_load_n(&queue->endOfList, __ATOMIC_ACQUIRE) != 0;
    if (!begin(follower, queue, forward)) {
      if (follower.phase != XPhase::Failed)
        follower.phase = complete ? XPhase::Done : XPhase::Waiting;
      return;
    }
    const PathObject &object = *objectAt(queue, 0);
    const double ahead = sign * (x - object.start.coordinate[kAxisX]);
    if (!(ahead > 0.0)) {
      put(follower, object, 0.0);
      follower.phase = ahead < 0.0 ? XPhase::Waiting : XPhase::Following;
      return;
    }
    if (sign * (x - object.end.coordinate[kAxisX]) < 0.0) {
      const double way = wayAt(follower.here, x, forward);
      passSwitches(follower, object, way / follower.here.length);
      put(follower, object, way);
      follower.phase = XPhase::Following;
      if (!(sign * path::pointAt(follower.here, way).d1[kAxisX] > 0.0))
        fail(follower, XError::NoIntersection);
      return;
    }
    passSwitches(follower, object, exact::kInfinity);
    put(follower, object, follower.here.length);
    follower.position = object.end;
    follower.begun = false;
    (void)removeAt(queue, 0);
  }
}

} // namespace stride::cnc
