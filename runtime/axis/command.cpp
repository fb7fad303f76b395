#include "runtime/axis/command.hpp"

#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/present_state.hpp"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/modulo.hpp"

namespace stride::motion {
namespace {

namespace error = axis::error;
namespace buffer = ::st::SM_DriveBasic;

/// The numbers with which the blocks of a kind refuse their inputs.
struct Refusals {
  int16_t values;
  int16_t direction;
};

Refusals refusalsOf(int16_t eKind) noexcept {
  switch (eKind) {
  case kind::kRelative:
    return {error::kMoveRelativeValues, error::kMoveRelativeDirection};
  case kind::kAdditive:
    return {error::kMoveAdditiveValues, error::kMoveAdditiveDirection};
  case kind::kVelocity:
    return {error::kMoveVelocityValues, error::kMoveVelocityDirection};
  case kind::kContinuousAbsolute:
    return {error::kContinuousAbsoluteValues, error::kContinuousAbsoluteDirection};
  case kind::kContinuousRelative:
    return {error::kContinuousRelativeValues, error::kContinuousRelativeDirection};
  case kind::kHalt:
  case kind::kStop:
    return {error::kStopValues, error::kStopValues};
  default:
    return {error::kMoveAbsoluteValues, error::kMoveAbsoluteDirection};
  }
}

/// Whether the command brings the axis to rest wherever that is.
bool isBraking(const Command &command) noexcept {
  return command.eKind == kind::kHalt || command.eKind == kind::kStop;
}

/// Limits and ramp type of the command on this axis; overrides, as far as they count for it.
Dynamics dynamicsOf(const AxisRef &ref, const Command &command) noexcept {
  const BlockLimits limits{command.fVelocity, command.fAcceleration, command.fDeceleration,
                           command.fJerk};
  return command.eKind == kind::kStop ? plainDynamics(ref, limits) : dynamicsOf(ref, limits);
}

Direction lastMotion(const AxisRef &ref, const State &start) noexcept {
  const double moving = start.velocity != 0.0 ? start.velocity : ref.nDirection;
  return moving < 0.0 ? Direction::Negative : Direction::Positive;
}

bool areUsable(const Command &command) noexcept {
  if (!exact::isPositive(command.fDeceleration) || !exact::isfinite(command.fJerk) ||
      command.fJerk < 0.0)
    return false;
  if (isBraking(command))
    return true;
  if (!exact::isPositive(command.fAcceleration) || !exact::isfinite(command.fPosition))
    return false;
  if (command.eKind == kind::kVelocity)
    return exact::isfinite(command.fVelocity) && command.fVelocity >= 0.0;
  return exact::isPositive(command.fVelocity) && exact::isfinite(command.fEndVelocity) &&
         command.fEndVelocity >= 0.0 && command.fEndVelocity <= command.fVelocity;
}

bool isContinuous(const Command &command) noexcept {
  return command.eKind == kind::kContinuousAbsolute || command.eKind == kind::kContinuousRelative;
}

/// Whether the command leads to a place.
bool hasGoal(const Command &command) noexcept {
  return command.eKind != kind::kVelocity && !isBraking(command);
}

/// An SMC_ERROR if the command asks for what its kind does not know.
int16_t checkInputs(const AxisRef &ref, const Command &command) noexcept {
  const Refusals refused = refusalsOf(command.eKind);
  if (!areUsable(command))
    return refused.values;
  const auto direction = static_cast<Direction>(command.eDirection);
  const bool oneWay = direction == Direction::Negative || direction == Direction::Positive ||
                      direction == Direction::Current;
  switch (command.eKind) {
  case kind::kAbsolute:
    if (axis::isRotary(ref) && !oneWay && direction != Direction::Shortest &&
        direction != Direction::Fastest)
      return refused.direction;
    break;
  case kind::kVelocity:
    if (!oneWay)
      return refused.direction;
    break;
  case kind::kContinuousAbsolute:
    if (axis::isRotary(ref) && direction == Direction::Fastest)
      return error::kContinuousAbsoluteFastest;
    if (axis::isRotary(ref) && !oneWay && direction != Direction::Shortest)
      return refused.direction;
    [[fallthrough]];
  case kind::kContinuousRelative:
    if (command.eEndDirection != static_cast<int16_t>(Direction::Negative) &&
        command.eEndDirection != static_cast<int16_t>(Direction::Positive) &&
        command.eEndDirection != static_cast<int16_t>(Direction::Current))
      return refused.direction;
    break;
  default:
    break;
  }
  return error::kNone;
}

/// The velocity that the command asks for at its end; its directions are known (settleDirections).
double endVelocityOf(const AxisRef &ref, const Command &command) noexcept {
  const double speed = command.eKind == kind::kVelocity ? command.fVelocity : command.fEndVelocity;
  const int16_t direction =
      command.eKind == kind::kVelocity ? command.eDirection : command.eEndDirection;
  return ref.fVelocityFactor * (direction < 0 ? -speed : speed);
}

/// Makes `current` a sign, seen from the state in which the command begins.
void settleDirections(const AxisRef &ref, Command &command, const State &start) noexcept {
  constexpr auto kCurrent = static_cast<int16_t>(Direction::Current);
  const auto now = static_cast<int16_t>(lastMotion(ref, start));
  if (command.eKind == kind::kVelocity && command.eDirection == kCurrent)
    command.eDirection = now;
  if (isContinuous(command) && command.eEndDirection == kCurrent)
    command.eEndDirection = now;
}

/// Where a command leads from `start`, on the scale of start.position; false if it cannot be said.
/// `commanded` is where the axis was sent before.
bool goalOf(const AxisRef &ref, const Command &command, const State &start, double commanded,
            double &goal) noexcept {
  switch (command.eKind) {
  case kind::kRelative:
  case kind::kContinuousRelative:
    goal = start.position + command.fPosition;
    return true;
  case kind::kAdditive:
    goal = commanded + command.fPosition;
    return true;
  case kind::kAbsolute:
  case kind::kContinuousAbsolute:
    goal = command.fPosition;
    if (!axis::isRotary(ref))
      return true;
    return resolveModulo({start, numeric::wrapPosition(command.fPosition, ref.fPositionPeriod),
                          isContinuous(command) ? endVelocityOf(ref, command) : 0.0,
                          ref.fPositionPeriod, static_cast<Direction>(command.eDirection),
                          lastMotion(ref, start), dynamicsOf(ref, command)},
                         goal);
  default:
    return false;
  }
}

/// Where an additive command counts from, seen from `start`, the present state: the target of the
/// discrete motion in progress, else the place where the axis is. Other commands do not ask.
double commandedPosition(const AxisRef &ref, const Command &command, const State &start) noexcept {
  if (command.eKind != kind::kAdditive || ref.nAxisState != axis::state::kDiscrete ||
      ref.stPlanner.bActive == 0 || ref.stPlanner.bToGoal == 0)
    return start.position;
  auto plan = ref.stPlanner;
  return start.position + (plan.fGoal - axis::planState(plan, axis::planTime(plan)).position);
}

/// With which velocity the motion in progress passes its goal when `next` is to be blended with it;
/// 0 for a stop there.
double blendVelocity(const AxisRef &ref, const Command &now, const State &start, double goal,
                     Command next) noexcept {
  if (next.eBufferMode <= buffer::MC_BUFFER_MODE__Buffered || isBraking(next))
    return 0.0;
  const Dynamics dynamics = dynamicsOf(ref, now);
  Dynamics later = dynamicsOf(ref, next);
  double wanted = 0.0;
  switch (next.eBufferMode) {
  case buffer::MC_BUFFER_MODE__BlendingLow:
    wanted = exact::smaller(dynamics.velocity, later.velocity);
    break;
  case buffer::MC_BUFFER_MODE__BlendingPrevious:
    wanted = dynamics.velocity;
    break;
  case buffer::MC_BUFFER_MODE__BlendingNext:
    wanted = later.velocity;
    break;
  default:
    wanted = exact::larger(dynamics.velocity, later.velocity);
    break;
  }
  const double side =
      goal != start.position ? exact::signOf(goal - start.position) : exact::signOf(start.velocity);
  const State joint{goal, side * wanted, 0.0};
  settleDirections(ref, next, joint);
  if (!hasGoal(next)) {
    if (next.eDirection != side)
      return 0.0;
  } else {
    double nextGoal = 0.0;
    State place = joint;
    place.position = axis::shownPosition(ref, goal);
    if (!goalOf(ref, next, place, place.position, nextGoal))
      return 0.0;
    const double way = side * (nextGoal - place.position);
    if (!(way > 0.0))
      return 0.0;
    // What is passed too fast could not stop at the next target. Seen backwards, this is a start.
    later.acceleration = dynamicsOf(ref, next).deceleration;
    later.deceleration = dynamicsOf(ref, next).acceleration;
    if (!isContinuous(next))
      wanted = reachableEndVelocity({0.0, 0.0, 0.0}, way, wanted, later);
  }
  return reachableEndVelocity(start, goal, side * wanted, dynamics);
}

/// A motion that has been planned but not begun.
struct Course {
  Profile profile;
  double goal;   ///< On the scale of the profile.
  double target; ///< As it was commanded: within the period on a rotary axis.
};

/// Whether an override of 0 keeps the axis from carrying the command out.
bool isHeld(const AxisRef &ref, const Command &command) noexcept {
  return !isBraking(command) && !(ref.fVelocityFactor > 0.0);
}

/// Plans a command whose directions are known (settleDirections) from `start` to `course.goal`.
/// `next` waits to follow it, or is null.
PlanError planTowards(Course &course, const AxisRef &ref, const Command &command,
                      const State &start, const Command *next) noexcept {
  const Dynamics dynamics = dynamicsOf(ref, command);
  if (isBraking(command) || isHeld(ref, command))
    return planStop(course.profile, start, dynamics);
  if (command.eKind == kind::kVelocity)
    return planVelocity(course.profile, start, endVelocityOf(ref, command), dynamics);
  double endVelocity = 0.0;
  if (isContinuous(command))
    endVelocity = endVelocityOf(ref, command);
  else if (next != nullptr)
    endVelocity = blendVelocity(ref, command, start, course.goal, *next);
  if (command.bAdaptEndVelocity != 0)
    endVelocity = reachableEndVelocity(start, course.goal, endVelocity, dynamics);
  return planMove(course.profile, start, course.goal, endVelocity, dynamics);
}

/// Plans the command from `start`, where nothing has been planned yet.
PlanError planCourse(Course &course, const AxisRef &ref, const Command &command, const State &start,
                     double commanded, const Command *next) noexcept {
  if (hasGoal(command) && !goalOf(ref, command, start, commanded, course.goal))
    return PlanError::InvalidState;
  const PlanError problem = planTowards(course, ref, command, start, next);
  if (!hasGoal(command))
    course.goal = course.profile.end.position;
  const bool absolute =
      command.eKind == kind::kAbsolute || command.eKind == kind::kContinuousAbsolute;
  if (problem == PlanError::None)
    course.target = axis::shownPosition(ref, absolute ? command.fPosition : course.goal);
  return problem;
}

/// Makes a planned motion the axis's, from the state it has been planned from.
void follow(AxisRef &ref, const Course &course, const Command &command) noexcept {
  auto &plan = ref.stPlanner;
  loadPlan(plan, course.profile, ref.fTaskCycle);
  plan.stCommand = command;
  plan.bToGoal = hasGoal(command);
  plan.bHeld = isHeld(ref, command);
  plan.fGoal = course.goal;
  plan.fTarget = course.target;
  plan.fDeceleration = command.fDeceleration;
  ref.fAimPosition = plan.fTarget;
}

/// As follow, of a command that begins now.
void begin(AxisRef &ref, const Course &course, const Command &command) noexcept {
  axis::giveAxis(ref, command.ulOwner);
  follow(ref, course, command);
  const bool endless = command.eKind == kind::kVelocity || isContinuous(command);
  ref.nAxisState = endless ? axis::state::kContinuous : axis::state::kDiscrete;
}

/// The command that waits next, or null.
const Command *nextOf(const AxisRef &ref) noexcept {
  return ref.stQueue.uiCount > 0 ? &ref.stQueue.aCommand.v[0] : nullptr;
}

void removeAt(AxisRef &ref, uint16_t index) noexcept {
  auto &queue = ref.stQueue;
  --queue.uiCount;
  for (uint16_t i = index; i < queue.uiCount; ++i)
    queue.aCommand.v[i] = queue.aCommand.v[i + 1];
}

/// Plans the motion in progress anew from where it is, for other overrides or another next command.
void planAnew(AxisRef &ref) noexcept {
  auto &plan = ref.stPlanner;
  if (plan.bActive == 0 || isBraking(plan.stCommand))
    return;
  const State start = axis::planState(plan, axis::planTime(plan));
  const Command command = plan.stCommand;
  Course course;
  course.goal = plan.fGoal;
  course.target = plan.fTarget;
  if (planTowards(course, ref, command, start, nextOf(ref)) != PlanError::None)
    return;
  if (!hasGoal(command)) {
    course.goal = course.profile.end.position;
    course.target = axis::shownPosition(ref, course.goal);
  }
  follow(ref, course, command);
}

/// Whether the command that waits next is that of a block which moves the axis by itself.
bool isFollowerNext(const AxisRef &ref) noexcept {
  const Command *next = nextOf(ref);
  return next != nullptr && next->eKind == kind::kSynchronized;
}

/// The next command follows the motion that ends in `start`, `late` seconds before this cycle's
/// set values. False if it cannot be planned.
bool handOver(AxisRef &ref, const State &start, double late) noexcept {
  Command next = ref.stQueue.aCommand.v[0];
  removeAt(ref, 0);
  if (next.eKind == kind::kSynchronized) {
    axis::giveAxis(ref, next.ulOwner);
    ref.nAxisState = axis::state::kSynchronized;
    return true;
  }
  settleDirections(ref, next, start);
  Course course;
  if (planCourse(course, ref, next, start, start.position, nextOf(ref)) != PlanError::None)
    return false;
  begin(ref, course, next);
  ref.stPlanner.fShift = late - ref.stPlanner.fCycle;
  (void)axis::stepPlan(ref);
  return true;
}

/// Plans the way to the goal anew, because another command follows it now.
void blendAnew(AxisRef &ref) noexcept {
  if (ref.iOwner != 0 && ref.stPlanner.bToGoal != 0 && ref.stPlanner.bReached == 0)
    planAnew(ref);
}

/// Where the motion in progress ends, or has ended, `late` seconds before this cycle's set values;
/// as the axis shows it.
State endOf(const AxisRef &ref, double late) noexcept {
  const auto &plan = ref.stPlanner;
  const State added = axis::addedState(ref, late < plan.fCycle ? plan.fCycle - late : 0.0);
  return {axis::shownPosition(ref, plan.fTarget + added.position),
          plan.fEndVelocity + added.velocity, added.acceleration};
}

/// Plans a command that begins in `start`, whatever waits; its directions become signs. An
/// SMC_ERROR.
int16_t planFresh(Course &course, const AxisRef &ref, Command &command,
                  const State &start) noexcept {
  if (const int16_t problem = checkInputs(ref, command); problem != error::kNone)
    return problem;
  settleDirections(ref, command, start);
  if (planCourse(course, ref, command, start, commandedPosition(ref, command, start), nullptr) !=
      PlanError::None)
    return refusalsOf(command.eKind).values;
  return error::kNone;
}

} // namespace

int16_t checkCommand(const AxisRef &axis, const Command &command) noexcept {
  Command settled = command;
  Course course;
  return planFresh(course, axis, settled, axis::presentState(axis));
}

int16_t beginCommand(AxisRef &axis, const Command &command) noexcept {
  const State start = axis::presentState(axis);
  Command settled = command;
  Course course;
  if (const int16_t problem = planFresh(course, axis, settled, start); problem != error::kNone)
    return problem;
  axis.stQueue.uiCount = 0;
  begin(axis, course, settled);
  if (axis.bMovedInThisCycle != 0)
    axis::writeSetPoint(axis, start);
  return error::kNone;
}

bool queueCommand(AxisRef &axis, const Command &command) noexcept {
  auto &queue = axis.stQueue;
  if (queue.uiCount >= decltype(queue.aCommand)::kSize)
    return false;
  queue.aCommand.v[queue.uiCount++] = command;
  if (queue.uiCount == 1)
    blendAnew(axis);
  return true;
}

void withdrawCommand(AxisRef &axis, uint64_t owner) noexcept {
  auto &queue = axis.stQueue;
  for (uint16_t i = 0; i < queue.uiCount; ++i) {
    if (queue.aCommand.v[i].ulOwner != owner)
      continue;
    removeAt(axis, i);
    if (i == 0)
      blendAnew(axis);
    return;
  }
}

bool isQueued(const AxisRef &axis, uint64_t owner) noexcept {
  for (uint16_t i = 0; i < axis.stQueue.uiCount; ++i)
    if (axis.stQueue.aCommand.v[i].ulOwner == owner)
      return true;
  return false;
}

bool beginQueued(AxisRef &axis, uint64_t owner) noexcept {
  return axis.stQueue.uiCount > 0 && axis.stQueue.aCommand.v[0].ulOwner == owner &&
         handOver(axis, axis::setState(axis), axis.fTaskCycle);
}

bool giveToNext(AxisRef &axis) noexcept {
  while (axis.stQueue.uiCount > 0)
    if (handOver(axis, axis::presentState(axis), 0.0))
      return true;
  return false;
}

void beginCoasting(AxisRef &axis, uint64_t owner) noexcept {
  const State start = axis::presentState(axis);
  axis.stQueue.uiCount = 0;
  axis::giveAxis(axis, owner);
  auto &plan = axis.stPlanner;
  axis::beginPlan(plan, axis.fTaskCycle, 0.0, start.position, start.velocity);
  plan.bReached = 1;
  plan.fTarget = start.position;
  plan.fDeceleration = 0.0; // an error stop brakes with fSWMaxDeceleration
  plan.stCommand = {};
  plan.stCommand.eKind = kind::kVelocity;
  plan.stCommand.fVelocity = exact::fabs(start.velocity);
  plan.stCommand.eDirection = static_cast<int16_t>(lastMotion(axis, start));
  axis.fAimPosition = start.position;
  axis.nAxisState = axis::state::kContinuous;
  if (axis.bMovedInThisCycle != 0)
    axis::writeSetPoint(axis, start);
}

bool advance(AxisRef &axis) noexcept {
  auto &plan = axis.stPlanner;
  if (axis.bMovedInThisCycle != 0 || plan.bActive == 0)
    return false;
  const bool onItsWay = plan.bReached != 0 && plan.bHeld == 0 && axis.stQueue.uiCount > 0;
  const bool follower = isFollowerNext(axis); // does not move the axis before its next call
  if (onItsWay && !follower && handOver(axis, axis::setState(axis), plan.fCycle))
    return true; // it was on its way without an end
  if (!axis::stepPlan(axis) && !(onItsWay && follower))
    return false;
  if (isContinuous(plan.stCommand)) {
    // From here on only the velocity is left of the command.
    plan.bToGoal = 0;
    plan.stCommand.eKind = kind::kVelocity;
    plan.stCommand.eDirection = plan.stCommand.eEndDirection;
    plan.stCommand.fVelocity = plan.stCommand.fEndVelocity;
  }
  if (axis.stQueue.uiCount == 0)
    return false;
  const double late = exact::larger(axis::planTime(plan) - plan.fDuration, 0.0);
  return handOver(axis, endOf(axis, late), late);
}

void applyOverrides(AxisRef &axis) noexcept { planAnew(axis); }

} // namespace stride::motion
