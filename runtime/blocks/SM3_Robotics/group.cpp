#include "runtime/blocks/SM3_Robotics/group.hpp"

#include "runtime/axis/axis_cycle.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/blocks/SM3_Robotics/overrides.hpp"
#include "runtime/blocks/SM3_Robotics/planning.hpp"
#include "runtime/blocks/SM3_Robotics/requests.hpp"
#include "runtime/blocks/SM3_Robotics/tolerance.hpp"

#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using axis::AxisRef;
using group::Obstacle;

static_assert(sizeof(GroupState) <= sizeof(GroupRef::aState));

AxisRef &axisAt(const GroupRef &group, int32_t i) noexcept { return *group.apAxis.v[i]; }

void takeAxes(GroupRef &group) noexcept {
  if (group.bOwns != 0)
    return;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    AxisRef &axis = axisAt(group, i);
    axis.stQueue.uiCount = 0;
    group.aulOwner.v[i] = axis::takeAxis(axis);
    stateOf(group).zero[i] = axis.fOffsetPosition;
    axis.nAxisState = axis::state::kSynchronized;
    // The group begins to move in the next cycle.
    axis::writeSetPoint(axis, {axis.fSetPosition, 0.0, 0.0});
  }
  group.bOwns = 1;
}

/// Movements that can be continued after the error say the error, too.
void failAll(GroupState &state, int16_t reason) noexcept {
  const group::GroupMotion &motion = state.motion;
  for (int64_t k = motion.first; k < motion.next; ++k)
    fail(state, motion.movement[static_cast<uint64_t>(k) % group::kMovements].id, reason);
  for (int64_t k = state.abortedRequest; k < state.abortedEnd; ++k)
    fail(state, requestAt(state, k).id, reason);
}

/// All movements are over, and the axes stop. `failed`: the movement that is the reason; 0: none.
void failGroup(GroupRef &group, int16_t reason, uint64_t failed) noexcept {
  GroupState &state = stateOf(group);
  const bool stopped = state.motion.abandoned;
  abortAll(state, true);
  if (!stopped && state.resumable + 1 >= group.ulServed && !group::isCarried(state.motion))
    failAll(state, reason);
  forgetSystems(state);
  if (failed != 0)
    fail(state, failed, reason);
  endTriggers(state);
  for (int32_t i = 0; i < group.uiAxes; ++i)
    if (axis::isPowered(axisAt(group, i)))
      axis::enterErrorStop(axisAt(group, i), reason);
  group.bOwns = 0;
  group.eState = decl::SMC_AXIS_GROUP_STATE__GroupErrorStop;
  group.eError = static_cast<error::SMC_ERROR>(reason);
}

/// Why the group cannot go on, or 0.
int16_t problemOf(const GroupRef &group) noexcept {
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const AxisRef &axis = axisAt(group, i);
    if (axis.nAxisState == axis::state::kErrorStop)
      return error::SMC_ERROR__SMC_AXIS_GROUP_AXIS_ERROR;
    if (group.bOwns == 0)
      continue;
    if (!axis::isPowered(axis))
      return error::SMC_ERROR__SMC_AXIS_GROUP_AXIS_NOT_FOLLOWING;
    // Set positions of before a shift (MC_SetPosition) would be others for the drive.
    if (!axis::ownsAxis(axis, group.aulOwner.v[i]) ||
        axis.fOffsetPosition != stateOf(group).zero[i])
      return error::SMC_ERROR__SMC_AXIS_GROUP_INTERRUPTED_BY_SINGLE_AXIS;
  }
  return 0;
}

int16_t errorOf(Obstacle obstacle) noexcept {
  switch (obstacle) {
  case Obstacle::None:
    break;
  case Obstacle::Unreachable:
    return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  case Obstacle::AxisLimit:
    return error::SMC_ERROR__SMC_TRAFO_AXIS_LIMITS_EXCEEDED;
  case Obstacle::Singular:
    return error::SMC_ERROR__SMC_AXIS_GROUP_SINGULAR_PATH;
  case Obstacle::TooFast:
    return error::SMC_ERROR__SMC_AXIS_GROUP_TRACKING_TOO_FAST;
  }
  return 0;
}

/// Whether what comes next needs the group to be at rest.
bool isToStop(const GroupRef &group, const GroupState &state) noexcept {
  return group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping || demandsRest(state) ||
         state.interrupting;
}

void writeAxes(GroupRef &group) noexcept {
  const group::GroupMotion &motion = stateOf(group).motion;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const int32_t k = placeOf(group, i);
    axis::writeSetPoint(axisAt(group, i),
                        {motion.axes[k], motion.velocity[k], motion.acceleration[k]});
  }
}

void drive(const Ctx &ctx, GroupRef &group, const GroupArm &arm) {
  GroupState &state = stateOf(group);
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping || demandsStandstill(group))
    group::brake(state.motion, arm.arm);
  const double cycle = axisAt(group, 0).fTaskCycle;
  const int32_t milliseconds = millisecondsOf(cycle);
  double forecast = 0.0; // see SMC_TuneCPKernel
  __atomic_load(&group.fForecast, &forecast, __ATOMIC_RELAXED);
  const group::GroupCommand command{cycle,
                                    overrideOf(group),
                                    isToStop(group, state),
                                    state.deceleration,
                                    kSteps * milliseconds,
                                    kSamples * milliseconds,
                                    allowanceOf(group),
                                    forecast,
                                    stopsAtOnce(group, state),
                                    state.rides != 0 ? stateOfCarrier(group, state.rides)
                                                     : motion::State{},
                                    state.jerk,
                                    state.accelerationPart,
                                    state.jerkPart};
  planGroup(group, arm, command);
  state.forecast = group::plannedTime(state.motion);
  state.rest = {exact::kInfinity, 0};
  if (forecast > 0.0)
    state.rest = group::nextRest(state.motion);
  updateTriggers(ctx, state, cycle);
  goOnGroup(group, arm, command);
  const double by = finishCycle(group, arm, command);
  shiftTriggers(state, by);
  state.uncapped -= by;
  if (state.motion.obstacle != Obstacle::None) {
    failGroup(group, errorOf(state.motion.obstacle), failedMovement(state));
    return;
  }
  if (const int16_t wrong = lookAtLag(group, arm); wrong != 0) {
    failGroup(group, wrong, 0);
    return;
  }
  writeAxes(group);
}

/// At rest with nothing left to do.
void settle(GroupRef &group) noexcept {
  GroupState &state = stateOf(group);
  if (!rests(group) || state.firstRequest < state.nextRequest || state.interrupting)
    return;
  if (state.motion.first < state.motion.next && !state.motion.abandoned)
    return;
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping)
    return;
  endTriggers(state);
  forgetSystems(state);
  if (!state.motion.abandoned)
    clearMotion(state);
  endMoving(group);
}

} // namespace

void endMoving(GroupRef &group) noexcept {
  for (int32_t i = 0; i < group.uiAxes && group.bOwns != 0; ++i) {
    AxisRef &axis = axisAt(group, i);
    if (!axis::ownsAxis(axis, group.aulOwner.v[i]))
      continue;
    axis::writeMotion(axis, 0.0, 0.0);
    axis::releaseAxis(axis);
    axis.nAxisState = axis::state::kStandstill;
  }
  group.bOwns = 0;
  group.eState = decl::SMC_AXIS_GROUP_STATE__GroupStandby;
}

GroupState &stateOf(GroupRef &group) noexcept {
  return *reinterpret_cast<GroupState *>(&group.aState);
}
const GroupState &stateOf(const GroupRef &group) noexcept {
  return *reinterpret_cast<const GroupState *>(&group.aState);
}

bool takesMovements(const GroupRef &group) noexcept {
  return group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStandby ||
         group.eState == decl::SMC_AXIS_GROUP_STATE__GroupMoving;
}

bool rests(const GroupRef &group) noexcept {
  // What an error has left of a motion is not gone over.
  return group.bOwns == 0 || standsStill(stateOf(group));
}

void beginMoving(GroupRef &group) noexcept {
  if (group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStandby)
    return;
  double axes[kAxes] = {};
  for (int32_t i = 0; i < group.uiAxes; ++i)
    axes[placeOf(group, i)] = axisAt(group, i).fSetPosition;
  GroupState &state = stateOf(group);
  group::reset(state.motion, axes);
  state.abortedEnd = state.abortedRequest;
  state.tool = toolOf(group);
  state.uncapped = 0.0;
  takeAxes(group);
  group.eState = decl::SMC_AXIS_GROUP_STATE__GroupMoving;
}

void serve(Ctx &ctx, GroupRef &group) {
  const uint64_t now = ctx.cycle + 1;
  dropUnused(stateOf(group).triggers, now);
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled)
    countJoints(ctx, group);
  if (group.ulServed == now || group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled ||
      group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop)
    return;
  group.ulServed = now;
  if (const int16_t problem = problemOf(group); problem != 0) {
    failGroup(group, problem, 0);
    return;
  }
  lookAtCarriers(ctx, group);
  GroupArm arm(ctx, group);
  takeRequests(group, arm);
  if (group.bOwns != 0)
    drive(ctx, group, arm);
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupErrorStop)
    return;
  takeRequests(group, arm);
  if (group.bOwns != 0)
    settle(group);
}

int16_t whyNotReady(const GroupRef &group) noexcept {
  if (!takesMovements(group) || stateOf(group).interrupting)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const AxisRef &axis = axisAt(group, i);
    if (!axis::isPowered(axis))
      return error::SMC_ERROR__SMC_AXIS_GROUP_AXIS_NOT_FOLLOWING;
    if (group.bOwns == 0 && axis.nAxisState != axis::state::kStandstill)
      return error::SMC_ERROR__SMC_AXIS_GROUP_INTERRUPTED_BY_SINGLE_AXIS;
  }
  return 0;
}

namespace {

/// Takes a request that is in order, or notes that it has been refused: movements that are
/// commanded later in the cycle to follow it would begin elsewhere than planned, and are aborted.
int16_t admit(const Ctx &ctx, GroupRef &group, Request &request) {
  GroupState &state = stateOf(group);
  const uint64_t now = ctx.cycle + 1;
  const int16_t refusal = enqueue(group, request);
  if (refusal != 0) {
    if (request.kind != RequestKind::Halt)
      state.refused = now;
  } else if (aborts(request)) {
    state.refused = 0;
  } else if (state.refused == now) {
    --state.nextRequest;
    group::setOutcome(state.motion, request.id, group::Outcome::Aborted);
  }
  return refusal;
}

} // namespace

int16_t ask(Ctx &ctx, GroupRef &group, Request &request) {
  int16_t refusal = whyNotReady(group);
  if (refusal == 0)
    refusal = admit(ctx, group, request);
  const bool hasPlaces = request.kind != RequestKind::Halt;
  bindTriggers(group, ctx.cycle + 1, request.id,
               hasPlaces ? refusal : error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER);
  if (refusal != 0)
    return refusal;
  GroupArm arm(ctx, group);
  takeRequests(group, arm);
  GroupState &state = stateOf(group);
  if (group::outcomeOf(state.motion, request.id) != group::Outcome::Failed)
    return 0;
  state.refused = ctx.cycle + 1;
  return state.error[request.id % group::kOutcomes];
}

int16_t beginStop(Ctx &ctx, GroupRef &group, const Request &stop, uint64_t &holder) {
  bindTriggers(group, ctx.cycle + 1, 0, error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER);
  if (!takesMovements(group) && group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStopping)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  if (const int16_t wrong = wrongHalt(stop); wrong != 0)
    return wrong;
  GroupState &state = stateOf(group);
  abortAll(state, true);
  setBraking(state, stop);
  if (group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStopping) {
    ++state.stop;
    state.stops = 0;
  }
  if (holder != state.stop)
    ++state.stops;
  holder = state.stop;
  group.eState = decl::SMC_AXIS_GROUP_STATE__GroupStopping;
  return 0;
}

void endStop(GroupRef &group) {
  if (group.eState != decl::SMC_AXIS_GROUP_STATE__GroupStopping)
    return;
  if (--stateOf(group).stops > 0)
    return;
  endTriggers(stateOf(group));
  forgetSystems(stateOf(group));
  endMoving(group); // what it has aborted may still be kept
}

int16_t enable(Ctx &ctx, GroupRef &group) {
  if (group.eState != decl::SMC_AXIS_GROUP_STATE__GroupDisabled)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  for (int32_t i = 0; i < group.uiAxes; ++i) {
    const AxisRef &axis = axisAt(group, i);
    if (!exact::isPositive(axis.fSWMaxVelocity) || !exact::isPositive(axis.fSWMaxAcceleration) ||
        !exact::isPositive(axis.fSWMaxDeceleration) || !exact::isPositive(axis.fSWMaxJerk) ||
        !exact::isPositive(axis.fTaskCycle))
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_AXIS_LIMITS;
  }
  group.uiJoints = group.uiAxes < kArmAxes ? group.uiAxes : static_cast<UINT>(kArmAxes);
  if (group.itfKinematics != nullptr) {
    const kinematics::KinematicsOf kinematics(ctx, group.itfKinematics);
    if (kinematics.check() != kinematics::Outcome::Done)
      return kinematics::errorOf(kinematics.check());
    if (const int16_t wrong = whyNotAside(group, kinematics); wrong != 0)
      return wrong;
    if (const GroupArm arm(ctx, group); arm.outcome != kinematics::Outcome::Done)
      return kinematics::errorOf(arm.outcome); // the tool of stride.toml does not fit
    group.uiJoints = static_cast<UINT>(kinematics.ref().joints());
  }
  if (group.uiAxes == 0 || group.uiAxes < group.uiJoints ||
      group.uiAxes - group.uiJoints > kMoreAxes)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_NUMBER_OF_AXES;
  const uint64_t lastId = stateOf(group).motion.lastId; // what has been kept says its ids
  const int64_t epoch = stateOf(group).motion.epoch;    // and what another task plans this
  const uint64_t stop = stateOf(group).stop;            // old blocks of MC_GroupStop hold nothing
  const uint64_t lastTrigger =
      stateOf(group).triggers.lastId; // who reads an old one gets no new one
  stateOf(group) = GroupState{};
  stateOf(group).triggers.lastId = stateOf(group).triggers.settledId = lastTrigger;
  stateOf(group).motion.lastId = lastId;
  stateOf(group).stop = stop;
  stateOf(group).motion.epoch = epoch + 1;
  for (auto &carrier : group.astCarrier.v)
    carrier = {};
  group.eState = decl::SMC_AXIS_GROUP_STATE__GroupStandby;
  return 0;
}

} // namespace stride::robotics
