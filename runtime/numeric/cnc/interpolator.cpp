#include "runtime/numeric/cnc/interpolator.hpp"

#include "runtime/numeric/cnc/interpolator_objects.hpp"
#include "runtime/numeric/cnc/switch_points.hpp"

namespace stride::cnc {
namespace {

using exact::larger;
using exact::smaller;

// SMC_ERROR
constexpr int16_t kDataUnderrun = 1003;
constexpr int16_t kNoCheckVelocities = 1006;
constexpr int16_t kPathExceeded = 1007;
constexpr int16_t kNoQueue = 1501;

/// What of a cycle may be left of a dwell when it is over: a sum of cycles is rounded.
constexpr double kRounding = 1e-3;

void removeFirst(Interpolator &interpolator, const Command &command) noexcept {
  if (command.twoWays)
    interpolator.first += interpolator.backwards ? -1 : 1;
  else
    removeAt(command.queue, 0);
  if (interpolator.known > 0)
    --interpolator.known;
  if (interpolator.shifted > 0)
    --interpolator.shifted;
  interpolator.hasHere = false;
  interpolator.passed = 0;
  interpolator.begun = false;
}

/// Passes the switch points of the first object up to a part of its length, the nearest first. On
/// the way back they do nothing.
void passSwitches(Interpolator &interpolator, const PathObject &object, double part) noexcept {
  if (interpolator.backwards)
    return;
  while (const int16_t number = passSwitch(object, part, interpolator.passed)) {
    interpolator.progress.lastSwitch = number;
    setSwitch(interpolator.switches, number);
  }
}

/// An object at the front of the queue that has no way. True: it is done.
bool finishesHere(Interpolator &interpolator, const Command &command,
                  const PathObject &object) noexcept {
  const bool first = !interpolator.begun;
  interpolator.begun = true;
  if (interpolator.backwards && waitsAt(object))
    return true;
  if (isJump(object)) {
    interpolator.position = object.end;
    return true;
  }
  if (!isFunction(object)) { // a place twice: it rests there for a cycle
    interpolator.position = object.end;
    return !first;
  }
  const int16_t number = object.switchId[0];
  if (number == kSynchronise) {
    interpolator.synchronises = true;
    return true;
  }
  if (number == kDwell) {
    interpolator.dwell = first ? object.parameterRange[0] : interpolator.dwell - command.cycle;
    return !(interpolator.dwell > kRounding * command.cycle);
  }
  interpolator.progress.function = static_cast<uint16_t>(number);
  if (first || !command.acknowledge)
    return false;
  interpolator.progress.function = 0;
  return true;
}

/// Looks at the front of the queue, where the motion is at rest or passes from one object to the
/// next. True: it moves on, along `here`.
bool arrive(Interpolator &interpolator, const Command &command) noexcept {
  while (!interpolator.hasHere) {
    PathObject room;
    const PathObject *object = ahead(interpolator, command, 0, room);
    if (object == nullptr)
      return false;
    const bool moves = !waitsAt(*object);
    if (moves && segmentOf(interpolator, *object, interpolator.here)) {
      interpolator.hasHere = true;
      interpolator.synchronises = false;
      interpolator.motion.gate = false;
      return true;
    }
    if (interpolator.phase == Phase::Failed)
      return false;
    if (!finishesHere(interpolator, command, *object)) {
      interpolator.progress.source = object->sourceLine;
      return false;
    }
    removeFirst(interpolator, command);
  }
  return true;
}

void put(Interpolator &interpolator, const PathObject &object, double way) noexcept {
  const path::PathPoint point = path::pointAt(interpolator.here, way);
  Position &position = interpolator.position;
  position.frame = object.end.frame;
  position.axes = object.end.axes;
  position.sProfile = object.start.sProfile;
  for (int32_t k = 0; k < kAxes; ++k)
    if ((position.axes >> static_cast<unsigned>(k) & 1U) != 0)
      position.coordinate[k] = point.at[k];
  interpolator.progress.tangent =
      interpolator.here.isStill ? numeric::kZero : Vector3{point.d1[0], point.d1[1], point.d1[2]};
}

/// The end of the n-th object from the present one on, where it begins at a way: to the bit what
/// the motion has been told, for else it would rest before the end or after it for ever. Where ways
/// have been made smaller since then, a sum of them would be rounded otherwise than it was. [u]
double endOf(const Interpolator &interpolator, int64_t n, double begin, double length) noexcept {
  const double shift = n < interpolator.shifted ? interpolator.shift : 0.0;
  return begin + shift + length - shift;
}

/// Goes from object to object up to where the motion is.
void settle(Interpolator &interpolator, const Command &command, double way) noexcept {
  while (interpolator.hasHere) {
    PathObject room;
    const PathObject &object = *ahead(interpolator, command, 0, room);
    const double length = interpolator.here.length;
    const double end = endOf(interpolator, 0, interpolator.hereBegin, length);
    const double along = way - interpolator.hereBegin;
    Progress &progress = interpolator.progress;
    progress.source = object.sourceLine;
    progress.objectLength = length;
    progress.objectWay = smaller(along, length);
    if (way < end) {
      passSwitches(interpolator, object, along / length);
      put(interpolator, object, progress.objectWay);
      return;
    }
    passSwitches(interpolator, object, exact::kInfinity);
    put(interpolator, object, length);
    interpolator.position = object.end;
    interpolator.hereBegin = end;
    removeFirst(interpolator, command);
    if (!arrive(interpolator, command))
      return;
  }
}

/// The end of the object up to which a single step goes: the first one where the motion can still
/// come to rest.
double stepEnd(Interpolator &interpolator, const Command &command) noexcept {
  const double least = path::stoppingWay(interpolator.motion);
  double end = endOf(interpolator, 0, interpolator.hereBegin, interpolator.here.length);
  for (int64_t i = 1; end < least && i < interpolator.known; ++i) {
    PathObject room;
    const PathObject &object = *ahead(interpolator, command, i, room);
    path::Segment segment;
    if (waitsAt(object) || !segmentOf(interpolator, object, segment))
      break;
    end = endOf(interpolator, i, end, segment.length);
  }
  return end;
}

void limitStep(Interpolator &interpolator, const Command &command) noexcept {
  double &limit = interpolator.motion.wish.limit;
  if (command.waitAtNextStop && limit <= interpolator.motion.way)
    return; // it rests after a step
  if (!command.singleStep || !interpolator.hasHere)
    limit = exact::kInfinity;
  else if (limit == exact::kInfinity || limit <= interpolator.motion.way ||
           interpolator.motion.refused)
    limit = stepEnd(interpolator, command);
}

void wish(Interpolator &interpolator, const Command &command) noexcept {
  path::Wish &wish = interpolator.motion.wish;
  const double override = interpolator.backwards ? -command.override : command.override;
  const bool moves = override > kLeastOverride;
  wish.stop = command.slowStop || command.quickStop || command.emergencyStop || !moves;
  wish.settings = {command.law, command.jerk, command.share, false};
  wish.braking.deceleration = command.quickStop ? larger(command.quickDeceleration, 0.0) : 0.0;
  if (moves)
    wish.override = dryRunVelocity(command) < exact::kInfinity ? smaller(override, 1.0) : override;
  limitStep(interpolator, command);
}

bool begins(Interpolator &interpolator, const Command &command) noexcept {
  if (__atomic_load_n(&command.queue->endOfList, __ATOMIC_ACQUIRE) == 0 && !isFull(command.queue) &&
      !isSyncing(command.queue))
    return false;
  if (__atomic_load_n(&command.queue->generator, __ATOMIC_ACQUIRE) < kByCheckVelocities) {
    fail(interpolator, kNoCheckVelocities);
    return false;
  }
  const PathObject *object = objectAt(command.queue, 0);
  if (object != nullptr && !isJump(*object))
    interpolator.position = object->start;
  interpolator.phase = Phase::Moving;
  return true;
}

/// The switch points of an object that lie before a part of its length, as bits.
uint8_t switchesBefore(const PathObject &object, double part) noexcept {
  unsigned bits = 0;
  for (int32_t i = 0; i <= kMostSwitches; ++i)
    if (object.switchPosition[i] < part)
      bits |= 1U << static_cast<unsigned>(i);
  return static_cast<uint8_t>(bits);
}

/// Turns round where the motion is, at rest.
void turn(Interpolator &interpolator, const Command &command) noexcept {
  path::Motion &motion = interpolator.motion;
  const path::MotionSettings settings = motion.planned.settings;
  const double left =
      interpolator.hasHere
          ? endOf(interpolator, 0, interpolator.hereBegin, interpolator.here.length) - motion.way
          : 0.0;
  path::reset(motion, settings);
  interpolator.backwards = !interpolator.backwards;
  if (!interpolator.hasHere)
    interpolator.first += interpolator.backwards ? -1 : 1;
  interpolator.known = 0;
  interpolator.shifted = 0;
  interpolator.hasNext = false;
  interpolator.passed = 0;
  interpolator.begun = false;
  interpolator.nextEnd = 0.0;
  interpolator.hereBegin = 0.0;
  if (!interpolator.hasHere)
    return;
  PathObject room;
  const PathObject *object = ahead(interpolator, command, 0, room);
  interpolator.hasHere = object != nullptr && segmentOf(interpolator, *object, interpolator.here);
  interpolator.next = interpolator.here;
  interpolator.hasNext = interpolator.hasHere && left < interpolator.here.length;
  interpolator.nextWay = left;
  interpolator.nextBegin = -left;
  interpolator.nextEnd = interpolator.here.length - left;
  interpolator.hereBegin = -left;
  if (interpolator.hasHere)
    interpolator.passed = switchesBefore(*object, left / interpolator.here.length);
  if (interpolator.hasHere && !interpolator.hasNext) { // it is behind already
    removeFirst(interpolator, command);
    interpolator.hereBegin = interpolator.nextEnd = 0.0;
  }
}

void turnIfWanted(Interpolator &interpolator, const Command &command) noexcept {
  const bool back = command.override < -kLeastOverride;
  const bool forth = command.override > kLeastOverride;
  const bool turns = interpolator.backwards ? forth : back;
  if (command.twoWays && turns && path::isAtRest(interpolator.motion))
    turn(interpolator, command);
}

/// Whether the objects that are known are still there: somebody else may have emptied the queue.
bool hasKnown(const Interpolator &interpolator, const Command &command) noexcept {
  const int64_t needed = interpolator.known + (interpolator.hasNext ? 1 : 0);
  const int64_t least = interpolator.hasHere ? 1 : 0;
  const bool inside = interpolator.first < countOf(command.queue);
  const int64_t present = interpolator.backwards && !inside ? 0 : countAhead(interpolator, command);
  return present >= needed && present >= least;
}

void drive(Interpolator &interpolator, const Command &command) noexcept {
  path::Motion &motion = interpolator.motion;
  turnIfWanted(interpolator, command);
  const bool moves = interpolator.hasHere || arrive(interpolator, command);
  wish(interpolator, command);
  makeKnown(interpolator, command);
  if (interpolator.phase == Phase::Failed)
    return;
  if (command.emergencyStop)
    path::freeze(motion);
  const double before = motion.way;
  path::think(motion, command.budget);
  Progress &progress = interpolator.progress;
  progress.motion = {before, 0.0, 0.0, 0.0};
  if (moves) {
    progress.motion = path::move(motion, command.cycle, !command.waitAtNextStop);
    settle(interpolator, command, motion.way);
  }
  progress.length = motion.way - before;
}

/// Makes ways smaller when they have become large: not again before all objects that were known the
/// last time have been passed, so that one shift holds for all that endOf() asks of.
void rebase(Interpolator &interpolator) noexcept {
  if (interpolator.shifted > 0)
    return;
  const double by = path::rebase(interpolator.motion);
  interpolator.hereBegin -= by;
  interpolator.nextBegin -= by;
  interpolator.nextEnd -= by;
  interpolator.shift = by;
  interpolator.shifted = by > 0.0 ? interpolator.known + (interpolator.hasNext ? 1 : 0) : 0;
}

} // namespace

void start(Interpolator &interpolator, const Command &command) noexcept {
  const Position position = interpolator.position; // of the path before, until this one begins
  interpolator = Interpolator{};
  interpolator.position = position;
  path::reset(interpolator.motion, {command.law, command.jerk, command.share, false});
  interpolator.progress.source = -1;
}

void cycle(Interpolator &interpolator, const Command &command) noexcept {
  Progress &progress = interpolator.progress;
  progress = Progress{};
  progress.source = -1;
  progress.position = interpolator.position;
  if (interpolator.phase == Phase::Finished || interpolator.phase == Phase::Failed)
    return;
  if (checkQueue(command.queue) != QueueError::None) {
    fail(interpolator, kNoQueue);
    return;
  }
  if (interpolator.phase == Phase::Filling && !begins(interpolator, command))
    return;
  if (!hasKnown(interpolator, command)) {
    fail(interpolator, kPathExceeded);
    return;
  }
  drive(interpolator, command);
  rebase(interpolator);
  progress.position = interpolator.position;
  if (!(progress.length > 0.0))
    progress.tangent = numeric::kZero;
  progress.waits = !(progress.motion.velocity > 0.0);
  const bool open = isOpen(interpolator, command);
  const bool empty = countAhead(interpolator, command) <= 0;
  progress.atEnd = empty && !open;
  if (progress.atEnd && !command.twoWays)
    interpolator.phase = Phase::Finished;
  const bool dry = empty && open && !interpolator.synchronises;
  interpolator.warning = dry ? kDataUnderrun : interpolator.warning;
}

const PathObject *presentObject(const Interpolator &interpolator, const Command &command) noexcept {
  if (interpolator.phase != Phase::Moving || interpolator.first < 0)
    return nullptr;
  return objectAt(command.queue, static_cast<uint32_t>(interpolator.first));
}

} // namespace stride::cnc
