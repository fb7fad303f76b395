#include "runtime/numeric/group/group_motion.hpp"

#include "runtime/numeric/group/carried.hpp"
#include "runtime/numeric/group/path_making.hpp"

namespace stride::group {
namespace {

using exact::smaller;

/// The jerk of the law: strips say what is allowed.
constexpr path::MotionSettings kSettings{path::LawKind::Jerk, 1e30, 1.0, true};

/// By how much an axis may exceed its velocity because of a system that changes its own.
constexpr double kTooFast = 1.1;

/// What becomes of a movement while it is driven.
void note(GroupMotion &group, const Movement &movement, Outcome outcome) noexcept {
  if (!group.abandoned)
    setOutcome(group, movement.id, outcome);
}

bool dwells(const Movement &movement) noexcept { return movement.order.dwell > 0.0; }

/// Of a movement of long ago: what is over is forgotten for what is not, the oldest first.
void setOldOutcome(GroupMotion &group, uint64_t id, Outcome outcome) noexcept {
  OldOutcome *place = nullptr;
  for (OldOutcome &old : group.old) {
    if (old.id == id) {
      old.outcome = outcome;
      return;
    }
    if (!goesOn(old.outcome) && (place == nullptr || old.id < place->id))
      place = &old;
  }
  if (place != nullptr && goesOn(outcome))
    *place = {id, outcome};
}

/// Whether the motion has come to where a movement begins.
bool hasBegun(const GroupMotion &group, int64_t number) noexcept {
  return number <= group.looked && group.motion.way >= movementAt(group, number).begin;
}

/// The movement that is driven has been gone through.
void leave(GroupMotion &group) noexcept {
  note(group, movementAt(group, group.first), Outcome::Done);
  ++group.first;
}

/// Begins and ends movements up to where the motion is. `arrives`: it comes to rest, so that one
/// that ends there has not ended yet.
void settle(GroupMotion &group, bool arrives) noexcept {
  while (group.first < group.next && hasBegun(group, group.first)) {
    Movement &movement = movementAt(group, group.first);
    note(group, movement, Outcome::Active);
    if (dwells(movement)) {
      if (!group.dwelling) {
        group.dwelling = true;
        group.dwell = movement.order.dwell;
      }
      return;
    }
    const double way = group.motion.way;
    if (!movement.endKnown || way < movement.end || (way == movement.end && arrives))
      return;
    leave(group);
  }
}

/// Lets time pass in a wait. What is left of it after that. [s]
double passDwell(GroupMotion &group, const GroupCommand &command) noexcept {
  if (!group.dwelling)
    return command.cycle;
  if (command.stop)
    return 0.0;
  if (group.dwell > command.cycle) {
    group.dwell -= command.cycle;
    return 0.0;
  }
  group.dwelling = false;
  group.motion.gate = false;
  leave(group);
  return command.cycle - group.dwell;
}

/// Where along the path the motion is, as a series of what `way` is one of.
void placeOf(const Movement &movement, const Series &way, PathPlace &place) noexcept {
  if (way.c[0] < legBegin(movement)) {
    placeAt(movement.corner, way - Series(movement.begin), place);
    return;
  }
  Series along = way - Series(legBegin(movement));
  along.c[0] = smaller(movement.entry + along.c[0], movement.leg.length);
  placeAt(movement.leg, along, place);
}

/// The axes go on along the path, or with the system that it is in: `place` is a series over the
/// way, or, if that is carried, in time.
void putAxes(GroupMotion &group, const Arm &ordered, PathPlace &place,
             const path::WayState &state) noexcept {
  const bool carried = isCarried(group) && place.byTool;
  if (carried) {
    group.tool = poseOf(valueOf(place.tool));
    place.tool = pathSystem(group) * place.tool;
  }
  Series axes[kAxes];
  const Obstacle obstacle = axesAt(ordered, place, group.axes, axes);
  if (obstacle != Obstacle::None && obstacle != Obstacle::Singular) {
    group.obstacle = obstacle;
    return;
  }
  const double v = carried ? 1.0 : state.velocity;
  const double a = carried ? 0.0 : state.acceleration;
  const bool rests = !(v > 0.0) && a == 0.0;
  for (int32_t k = 0; k < kArmAxes + ordered.more; ++k) {
    if (k >= ordered.joints && k < kArmAxes)
      continue;
    group.axes[k] = withoutRounding(ordered.limits[k], axes[k].c[0]);
    group.velocity[k] = rests ? 0.0 : axes[k].c[1] * v;
    group.acceleration[k] = rests ? 0.0 : axes[k].c[1] * a + 2.0 * axes[k].c[2] * v * v;
    if (carried && exact::fabs(group.velocity[k]) > kTooFast * ordered.limits[k].velocity)
      group.obstacle = Obstacle::TooFast;
  }
}

/// The group stays on its path, and goes with the system that it is in.
void putStill(GroupMotion &group, const Arm &arm) noexcept {
  for (int32_t k = 0; k < kAxes; ++k)
    group.velocity[k] = group.acceleration[k] = 0.0;
  if (!isCarried(group))
    return;
  PathPlace place;
  place.byTool = true;
  place.alsoTurns = false;
  place.tool = seriesOf(frameOf(group.tool));
  for (int32_t k = kArmAxes; k < kAxes; ++k)
    place.axes[k] = Series(group.axes[k]);
  Arm standing{arm.kinematics, arm.joints, arm.more, arm.limits,
               arm.kinematics.configurationOf(group.axes)};
  putAxes(group, standing, place, {});
}

bool isStill(const Movement &movement) noexcept {
  return !(movement.leg.length > 0.0) || dwells(movement);
}

/// `from`: the movement in which the group was before this cycle.
void put(GroupMotion &group, const Arm &arm, const path::WayState &state, int64_t from) noexcept {
  // A movement that has just ended still says where the group is.
  const bool ended =
      group.first > 0 && (group.first == group.next || !hasBegun(group, group.first) ||
                          dwells(movementAt(group, group.first)));
  int64_t number = ended ? group.first - 1 : group.first;
  while (number > from && isStill(movementAt(group, number)))
    --number; // those that go nowhere have ended with it, and do not say where that is
  const Movement &movement = movementAt(group, number);
  if (isStill(movement)) {
    putStill(group, arm);
    return;
  }
  Series way = growing(group.motion.way, 1.0);
  if (isCarried(group))
    way = inTime({group.motion.way, state.velocity, state.acceleration});
  PathPlace place;
  placeOf(movement, way, place);
  const Arm ordered{arm.kinematics, arm.joints, arm.more, arm.limits, movement.order.configuration};
  putAxes(group, ordered, place, state);
}

void wish(GroupMotion &group, const GroupCommand &command) noexcept {
  path::Wish &wish = group.motion.wish;
  wish.stop = command.stop || !(command.override > 0.0);
  wish.braking = brakingOf(command);
  group.motion.keep = command.keep;
  group.motion.atOnce = command.atOnce;
  if (command.override > 0.0)
    wish.override = command.override;
}

void moveBy(GroupMotion &group, const Arm &arm, double time) noexcept {
  if (!(time > 0.0)) {
    if (isCarried(group))
      putStill(group, arm);
    return;
  }
  const int64_t from = group.first;
  const path::WayState state = path::move(group.motion, time, true);
  settle(group, state.velocity > 0.0 && state.acceleration < 0.0);
  put(group, arm, state, from);
}
} // namespace

void reset(GroupMotion &group, const double (&axes)[kAxes]) noexcept {
  const uint64_t lastId = group.lastId;
  const int64_t epoch = group.epoch;
  uint8_t outcomes[kOutcomes];
  OldOutcome old[kOldOutcomes];
  __builtin_memcpy(outcomes, group.outcome, sizeof outcomes);
  __builtin_memcpy(old, group.old, sizeof old);
  const Ride ride = group.ride;
  const Ride left = isStill(group.left) ? Ride{} : group.left;
  const Pose tool = group.tool;
  group = GroupMotion{};
  group.ride = ride;
  group.left = left;
  group.tool = tool;
  group.lastId = lastId;
  group.epoch = epoch + 1;
  __builtin_memcpy(group.outcome, outcomes, sizeof outcomes);
  __builtin_memcpy(group.old, old, sizeof old);
  path::reset(group.motion, kSettings);
  for (int32_t k = 0; k < kAxes; ++k)
    group.axes[k] = axes[k];
}

void setOutcome(GroupMotion &group, uint64_t id, Outcome outcome) noexcept {
  if (group.lastId - id < kOutcomes)
    group.outcome[id % kOutcomes] = static_cast<uint8_t>(outcome);
  else
    setOldOutcome(group, id, outcome);
}

uint64_t drawId(GroupMotion &group) noexcept {
  const uint64_t oldest = group.lastId - kOutcomes + 1; // its place is taken
  const Outcome before = group.lastId >= kOutcomes ? outcomeOf(group, oldest) : Outcome::Unknown;
  if (goesOn(before))
    setOldOutcome(group, oldest, before);
  ++group.lastId;
  setOutcome(group, group.lastId, Outcome::Waiting);
  return group.lastId;
}

void append(GroupMotion &group, uint64_t id, const Leg &leg, const Order &order) noexcept {
  Movement &movement = movementAt(group, group.next);
  movement = {};
  movement.id = id;
  movement.leg = leg;
  movement.order = order;
  movement.exit = leg.length;
  setOutcome(group, id, Outcome::Queued);
  if (group.looked == group.next) { // nothing else is being looked at
    movement.begin = path::endOf(group.motion.course);
    group.lookedWay = 0.0;
    group.lookedStep = exact::kInfinity;
    if (group.first == group.next) {
      movement.begin = group.motion.way;
      for (int32_t k = 0; k < kAxes; ++k)
        group.lookedReference[k] = group.axes[k];
    }
  }
  ++group.next;
}

Outcome outcomeOf(const GroupMotion &group, uint64_t id) noexcept {
  if (id == 0 || id > group.lastId)
    return Outcome::Unknown;
  if (group.lastId - id >= kOutcomes) {
    for (const OldOutcome &old : group.old)
      if (old.id == id)
        return old.outcome;
    return Outcome::Unknown;
  }
  return static_cast<Outcome>(group.outcome[id % kOutcomes]);
}

const Movement *activeOf(const GroupMotion &group) noexcept {
  const bool begun = group.first < group.next && hasBegun(group, group.first);
  return begun ? &movementAt(group, group.first) : nullptr;
}

bool isAtRest(const GroupMotion &group) noexcept {
  return path::isAtRest(group.motion) || group.motion.resting || group.motion.gate;
}

double positionInMovement(const GroupMotion &group, uint64_t &id) noexcept {
  const Movement *const movement = activeOf(group);
  id = movement != nullptr ? movement->id : 0;
  if (movement == nullptr || !(movement->leg.length > 0.0))
    return 0.0;
  const double length = movement->leg.length;
  const double way = group.motion.way - movement->begin;
  const double half = 0.5 * movement->corner.length;
  if (way >= movement->corner.length)
    return smaller((movement->entry + (way - movement->corner.length)) / length, 1.0);
  if (way >= half)
    return (way / half - 1.0) * movement->entry / length;
  const Movement &before = movementAt(group, group.first - 1);
  id = before.id;
  return (before.exit + way / half * (before.leg.length - before.exit)) / before.leg.length;
}

void prepare(GroupMotion &group, const GroupCommand &command) noexcept {
  settle(group, !isAtRest(group));
  wish(group, command);
}

void plan(GroupMotion &group, const Arm &arm, const GroupCommand &command) noexcept {
  prepare(group, command);
  group.awaits = false; // an online change may have brought the planning here
  makeKnown(group, arm, command.allowance, command.samples);
  (void)path::think(group.motion, command.steps);
}

bool holds(const GroupMotion &group) noexcept {
  const path::Motion &motion = group.motion;
  const path::Law &law = motion.law;
  return motion.keep > 0.0 && !path::isAtRest(motion) && !group.dwelling && motion.since == 0.0 &&
         motion.cycles == 0 && (group.awaits || motion.session != path::Session::None) &&
         !(path::stateAt(law.piece[static_cast<uint64_t>(law.first) % path::kPieces], 0.0)
               .velocity > 0.0) &&
         motion.promise < motion.keep;
}

void goOn(GroupMotion &group, const Arm &arm, const GroupCommand &command) noexcept {
  goOn(group.ride, command.carrier, command.cycle);
  goOn(group.left, {}, command.cycle);
  if (!holds(group))
    moveBy(group, arm, passDwell(group, command));
  else if (isCarried(group))
    putStill(group, arm);
}

void cycle(GroupMotion &group, const Arm &arm, const GroupCommand &command) noexcept {
  plan(group, arm, command);
  goOn(group, arm, command);
  (void)rebase(group);
}

double rebase(GroupMotion &group) noexcept {
  const double by = path::rebase(group.motion);
  for (int64_t k = group.first > 0 ? group.first - 1 : 0; k < group.next && by > 0.0; ++k) {
    movementAt(group, k).begin -= by;
    movementAt(group, k).end -= by;
  }
  return by;
}

void abandon(GroupMotion &group) noexcept {
  if (group.abandoned)
    return;
  for (int64_t k = group.first; k < group.next; ++k)
    setOutcome(group, movementAt(group, k).id, Outcome::Aborted);
  group.abandoned = true;
}

void clear(GroupMotion &group) noexcept {
  abandon(group);
  double axes[kAxes];
  double velocity[kAxes];
  double acceleration[kAxes];
  __builtin_memcpy(axes, group.axes, sizeof axes);
  __builtin_memcpy(velocity, group.velocity, sizeof velocity);
  __builtin_memcpy(acceleration, group.acceleration, sizeof acceleration);
  reset(group, axes);
  if (!isCarried(group))
    return;
  __builtin_memcpy(group.velocity, velocity, sizeof velocity);
  __builtin_memcpy(group.acceleration, acceleration, sizeof acceleration);
}

} // namespace stride::group
