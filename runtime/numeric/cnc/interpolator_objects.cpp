#include "runtime/numeric/cnc/interpolator_objects.hpp"

#include "runtime/numeric/cnc/object_reverse.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

using exact::smaller;

// SMC_ERROR
constexpr int16_t kVelocityZero = 1001;
constexpr int16_t kNoStopAtEnd = 1002;
constexpr int16_t kPathExceeded = 1007;
constexpr int16_t kVelAccDecZero = 1008;

/// Parts of objects that are made known to the motion in a call, for each second of the cycle.
constexpr double kPartsPerSecond = 64e3;
constexpr int32_t kLeastParts = 16; ///< However short the cycle is.

/// What comes after the object that is made known.
enum class Successor : uint8_t {
  Path, ///< The path goes on.
  Rest, ///< It rests here.
  Wait, ///< It waits here, for a function or for a cycle.
};

Successor successorOf(const Interpolator &interpolator, const Command &command,
                      const PathObject &object) noexcept {
  PathObject room;
  const PathObject *next = ahead(interpolator, command, interpolator.known + 1, room);
  if (next != nullptr && waitsAt(*next))
    return interpolator.backwards ? Successor::Rest : Successor::Wait;
  if (next != nullptr && !(next->length > 0.0))
    return Successor::Wait;
  if (next == nullptr || !(object.velocityEnd > 0.0))
    return Successor::Rest;
  return Successor::Path;
}

/// Whether an object can be driven; else the path ends with an error.
bool isDrivable(Interpolator &interpolator, const PathObject &object) noexcept {
  const bool moves = exact::isPositive(object.velocity);
  if (moves && exact::isPositive(object.acceleration) && exact::isPositive(object.deceleration))
    return true;
  fail(interpolator, moves ? kVelAccDecZero : kVelocityZero);
  return false;
}

/// How fast the kink between the present object and the one after it can be passed: the square of
/// that velocity.
double kinkBefore(Interpolator &interpolator, const Command &command,
                  const PathObject &next) noexcept {
  if (!command.limitKinks || command.law != path::LawKind::Jerk)
    return exact::kInfinity;
  path::Segment after;
  if (!segmentOf(interpolator, next, after))
    return exact::kInfinity;
  const path::Segment &before = interpolator.next;
  const double acceleration = smaller(next.acceleration, next.deceleration);
  return path::kinkCeiling(path::pointAt(before, before.length), path::pointAt(after, 0.0),
                           command.limits, acceleration, command.cycle);
}

/// Begins with the next object that moves. False: there is none now.
bool takeNext(Interpolator &interpolator, const Command &command) noexcept {
  PathObject room;
  const bool open = isOpen(interpolator, command);
  const int64_t count = checkedAhead(interpolator, command);
  while (interpolator.known < count) {
    if (interpolator.known + 1 == count && (open || count < countAhead(interpolator, command)))
      return false; // its end is still open
    const PathObject &object = *ahead(interpolator, command, interpolator.known, room);
    const bool waits = waitsAt(object);
    if (!waits && !isDrivable(interpolator, object))
      return false;
    if (!waits && segmentOf(interpolator, object, interpolator.next)) {
      interpolator.nextBegin = interpolator.nextEnd;
      interpolator.nextEnd = interpolator.nextBegin + interpolator.next.length;
      interpolator.nextWay = 0.0;
      interpolator.hasNext = true;
      return true;
    }
    if (interpolator.phase == Phase::Failed)
      return false;
    ++interpolator.known;
  }
  return false;
}

/// Makes a part of the present object known. False: there is no room.
bool extendByPart(Interpolator &interpolator, const Command &command) noexcept {
  PathObject room;
  const PathObject &object = *ahead(interpolator, command, interpolator.known, room);
  const path::Segment &segment = interpolator.next;
  path::Strip strip{};
  const double to = path::limitStrip(segment, command.limits, interpolator.nextWay, strip);
  strip.feed = smaller(object.velocity, dryRunVelocity(command));
  strip.endFeed = strip.feed;
  strip.endCeiling = exact::kInfinity;
  strip.acceleration = object.acceleration;
  strip.deceleration = object.deceleration;
  if (to < segment.length) {
    strip.end = interpolator.nextBegin + to;
    if (!path::extend(interpolator.motion, strip))
      return false;
    interpolator.nextWay = to;
    return true;
  }
  const Successor successor = successorOf(interpolator, command, object);
  strip.end = interpolator.nextEnd;
  strip.endFeed = smaller(object.velocityEnd, strip.feed);
  strip.stop = successor != Successor::Path;
  strip.gate = successor == Successor::Wait;
  if (!strip.stop) {
    PathObject other;
    strip.endCeiling = kinkBefore(interpolator, command,
                                  *ahead(interpolator, command, interpolator.known + 1, other));
  }
  if (!path::extend(interpolator.motion, strip))
    return false;
  if (strip.stop && object.velocityEnd > 0.0 &&
      interpolator.known + 1 == countAhead(interpolator, command))
    interpolator.warning = kNoStopAtEnd;
  interpolator.hasNext = false;
  ++interpolator.known;
  return true;
}

} // namespace

void fail(Interpolator &interpolator, int16_t error) noexcept {
  path::freeze(interpolator.motion);
  interpolator.error = error;
  interpolator.phase = Phase::Failed;
}

ShapeError describeSegment(const PathObject &object, path::Segment &segment) noexcept {
  ObjectShape shape;
  const ShapeError error = shapeOf(object, shape);
  if (error != ShapeError::None && error != ShapeError::Ends)
    return error;
  path::Companion companions[path::kCoordinates]{};
  for (int32_t k = 0; k < kAxes; ++k) {
    const unsigned bit = 1U << static_cast<unsigned>(k);
    path::Companion &companion = companions[k];
    const bool leaves = k == kAxisZ && (object.planar || (object.start.sProfile & bit) != 0);
    companion.follows = (object.end.axes & bit) != 0 && (k > kAxisZ || leaves);
    companion.sProfile = (object.start.sProfile & bit) != 0;
    companion.start = object.start.coordinate[k];
    companion.end = object.end.coordinate[k];
  }
  for (int32_t i = 0; i < path::kBent; ++i) {
    path::Companion &companion = companions[kAxisA + i];
    companion.slopes = (object.slopes >> static_cast<unsigned>(i) & 1U) != 0;
    companion.startSlope = object.startSlope[i];
    companion.endSlope = object.endSlope[i];
    const bool finite =
        exact::isfinite(companion.startSlope) && exact::isfinite(companion.endSlope);
    if (companion.follows && companion.slopes && !finite)
      return ShapeError::NotFinite;
  }
  segment = path::makeSegment(shape.shape, companions);
  return ShapeError::None;
}

bool segmentOf(Interpolator &interpolator, const PathObject &object,
               path::Segment &segment) noexcept {
  if (describeSegment(object, segment) != ShapeError::None) {
    fail(interpolator, kPathExceeded);
    return false;
  }
  return segment.length > 0.0;
}

const PathObject *ahead(const Interpolator &interpolator, const Command &command, int64_t n,
                        PathObject &room) noexcept {
  const int64_t index = interpolator.first + (interpolator.backwards ? -n : n);
  if (index < 0)
    return nullptr;
  const PathObject *object = objectAt(command.queue, static_cast<uint32_t>(index));
  if (object == nullptr || !interpolator.backwards)
    return object;
  const PathObject *before =
      index > 0 ? objectAt(command.queue, static_cast<uint32_t>(index - 1)) : nullptr;
  const bool goesOn = before != nullptr && !waitsAt(*before);
  room = reversed(*object, goesOn ? before->velocityEnd : 0.0);
  return &room;
}

int64_t countAhead(const Interpolator &interpolator, const Command &command) noexcept {
  return interpolator.backwards ? interpolator.first + 1
                                : countOf(command.queue) - interpolator.first;
}

int64_t checkedAhead(const Interpolator &interpolator, const Command &command) noexcept {
  // What is checked is counted last: if objects come meanwhile, they are not counted.
  const int64_t count = countAhead(interpolator, command);
  return interpolator.backwards ? count : count - uncheckedOf(command.queue);
}

bool isOpen(const Interpolator &interpolator, const Command &command) noexcept {
  return !interpolator.backwards &&
         __atomic_load_n(&command.queue->endOfList, __ATOMIC_ACQUIRE) == 0;
}

double dryRunVelocity(const Command &command) noexcept {
  const double velocity = command.queue->dryRunVelocity;
  if (velocity > 0.0)
    return velocity;
  return exact::kInfinity;
}

void makeKnown(Interpolator &interpolator, const Command &command) noexcept {
  constexpr double kLongest = 10.0; // [s]
  const auto most = static_cast<int32_t>(kPartsPerSecond * smaller(command.cycle, kLongest));
  for (int32_t part = 0; part < most || part < kLeastParts; ++part) {
    if (path::roomIn(interpolator.motion.course) == 0) // what a part is limited to takes its time
      return;
    if (!interpolator.hasNext && !takeNext(interpolator, command))
      return;
    if (!extendByPart(interpolator, command))
      return;
  }
}

} // namespace stride::cnc
