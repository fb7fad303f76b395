#include "runtime/blocks/SM3_Robotics/requests.hpp"

#include "runtime/blocks/SM3_Robotics/overrides.hpp"

#include "runtime/axis/axis_ref.hpp"
#include "runtime/blocks/SM3_Robotics/carriers.hpp"
#include "runtime/blocks/SM3_Robotics/tool_led.hpp"
#include "runtime/numeric/group/kept_path.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/MC_TRANSITION_MODE.h"
#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"
#include "st/SM3_Robotics/SMC_GROUP_ADDITIONAL_MODE.h"
#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace buffer = ::st::SM_DriveBasic;
namespace error = ::st::SM_Error;
using group::GroupMotion;
using kinematics::Frame;
using kinematics::Outcome;

bool isFactor(double factor) noexcept { return factor > 0.0 && factor <= 1.0; }

bool leadsTool(const Request &request) noexcept {
  if (request.kind == RequestKind::Jog)
    return request.system != decl::SMC_COORD_SYSTEM__ACS;
  return request.kind == RequestKind::Linear || request.kind == RequestKind::Circular;
}

/// What is wrong with the inputs of a movement: an SMC_ERROR.
int16_t wrongInput(const Request &request) noexcept {
  if (request.kind == RequestKind::Halt)
    return wrongHalt(request);
  const group::Order &order = request.order;
  if (request.bufferMode < buffer::MC_BUFFER_MODE__Aborting ||
      request.bufferMode > buffer::MC_BUFFER_MODE__BlendingHigh)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_BUFFER_MODE;
  if (!isFactor(order.velocityFactor) || !isFactor(order.accelerationFactor) ||
      !isFactor(order.jerkFactor) || !isFactor(request.torqueFactor))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_FACTOR;
  if (request.orientationMode < decl::SMC_ORIENTATION_MODE__GreatCircle ||
      request.orientationMode > decl::SMC_ORIENTATION_MODE__Axis)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  const group::PathLimits &path = order.path;
  if (leadsTool(request) &&
      (!exact::isPositive(path.velocity) || !exact::isPositive(path.acceleration) ||
       !exact::isPositive(path.deceleration) || !exact::isPositive(path.jerk)))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_DYNAMICS;
  if (request.transitionMode < decl::MC_TRANSITION_MODE__TMNone ||
      request.transitionMode > decl::MC_TRANSITION_MODE__TMCornerDistance)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_TRANSITION;
  if (order.transition != group::Transition::None && !exact::isPositive(order.transitionValue))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_TRANSITION;
  for (const double position : request.position)
    if (!exact::isfinite(position))
      return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  if (request.moreMode < decl::SMC_GROUP_ADDITIONAL_MODE__Stay ||
      request.moreMode > decl::SMC_GROUP_ADDITIONAL_MODE__Relative)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  if (request.moreMode != decl::SMC_GROUP_ADDITIONAL_MODE__Stay)
    for (const double position : request.more)
      if (!exact::isfinite(position))
        return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  if (request.kind == RequestKind::Circular)
    return wrongCircle(request);
  return request.kind == RequestKind::Jog ? wrongJog(request) : int16_t{0};
}

/// The axes where a movement ends that is given by the tool. An SMC_ERROR.
int16_t axesOfTool(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends) {
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  const kinematics::KinematicsRef &kinematics = arm.arm.kinematics;
  Frame<double> begin;
  if (const Outcome outcome = kinematics.forward(ends.from, begin); outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  const Frame<double> target = targetFrame(request, request.position, begin);
  kinematics::Configuration configuration = kinematics.configurationOf(ends.from);
  if (request.kind == RequestKind::Direct && group.bConfiguration != 0)
    __builtin_memcpy(&configuration, &group.stConfiguration, sizeof configuration);
  return axesFor(arm.arm, target, configuration, ends.from, ends.to);
}

/// Where a movement ends that is no arc. An SMC_ERROR.
int16_t findEnd(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends) {
  if (request.system != decl::SMC_COORD_SYSTEM__ACS) {
    if (const int16_t wrong = axesOfTool(group, arm, request, ends); wrong != 0)
      return wrong;
  } else {
    for (int32_t k = 0; k < arm.arm.joints; ++k)
      ends.to[k] = (request.relative ? ends.from[k] : 0.0) + request.position[k];
  }
  return 0;
}

/// Whether axes may be where a movement ends: `count` of them from number `first` on.
bool areWithinLimits(const GroupArm &arm, const Ends &ends, int32_t first, int32_t count) noexcept {
  for (int32_t k = first; k < first + count; ++k)
    if (ends.to[k] < arm.arm.limits[k].low || ends.to[k] > arm.arm.limits[k].high)
      return false;
  return true;
}

/// Where the axes end that go along. Rotary ones take the shortest way to a position.
void findMoreEnds(const GroupRef &group, const Request &request, Ends &ends) noexcept {
  for (int32_t i = group.uiJoints; i < group.uiAxes; ++i) {
    const int32_t k = placeOf(group, i);
    const axis::AxisRef &axis = *group.apAxis.v[i];
    const double value = request.more[k - kArmAxes];
    if (request.moreMode == decl::SMC_GROUP_ADDITIONAL_MODE__Relative)
      ends.to[k] = ends.from[k] + value;
    if (request.moreMode != decl::SMC_GROUP_ADDITIONAL_MODE__Absolute)
      continue;
    ends.to[k] = value;
    if (axis::isRotary(axis)) {
      const double way = value - ends.from[k];
      const double period = axis.fPositionPeriod;
      ends.to[k] = ends.from[k] + way - period * exact::floor(way / period + 0.5);
    }
  }
}

group::MoreAxes moreAxesOf(const Ends &ends) noexcept {
  group::MoreAxes more;
  for (int32_t k = 0; k < kMoreAxes; ++k) {
    more.from[k] = ends.from[kArmAxes + k];
    more.to[k] = ends.to[kArmAxes + k];
  }
  return more;
}

int16_t linearLeg(const GroupArm &arm, const Request &request, Ends &ends, group::Leg &leg) {
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  Frame<double> from;
  Frame<double> to;
  (void)arm.arm.kinematics.forward(ends.from, from);
  if (arm.arm.kinematics.forward(ends.to, to) != Outcome::Done)
    return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  leg = group::lineLeg(group::poseOf(from), group::poseOf(to), moreAxesOf(ends));
  constexpr int32_t kParts = 12;
  const bool byPose = request.system != decl::SMC_COORD_SYSTEM__ACS;
  return givesToolAxes(request) ? settleWithToolAxes(arm.arm, leg, kParts, byPose, ends)
                                : settleLine(arm.arm, leg, kParts, ends);
}

/// The leg of a request from ends.from on; where it ends goes into ends.to. An SMC_ERROR.
int16_t legOf(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends,
              group::Leg &leg) {
  if (request.kind == RequestKind::Circular)
    return circularLeg(arm, request, ends, leg);
  if (request.kind == RequestKind::Jog)
    return jogLeg(group, arm, request, ends, leg);
  if (const int16_t wrong = findEnd(group, arm, request, ends); wrong != 0)
    return wrong;
  if (request.kind == RequestKind::Linear)
    return linearLeg(arm, request, ends, leg);
  double perTime[kAxes];
  for (int32_t k = 0; k < kAxes; ++k)
    perTime[k] = arm.arm.limits[k].velocity * request.order.velocityFactor *
                 request.order.shares.velocity[k];
  leg = group::axesLeg(ends.from, ends.to, perTime, speedOf(stateOf(group).motion, request.order));
  return 0;
}

/// Makes a movement of a request; the group is at its end, or at rest. An SMC_ERROR.
int16_t append(GroupRef &group, const GroupArm &arm, const Request &request) {
  GroupState &state = stateOf(group);
  const bool first = state.motion.first == state.motion.next;
  Ends ends;
  for (int32_t k = 0; k < kAxes; ++k)
    ends.from[k] = ends.to[k] = first ? state.motion.axes[k] : state.end[k];
  findMoreEnds(group, request, ends);
  const bool carried = group::isCarried(state.motion) && canRide(request);
  if (leadsTool(request) && arm.outcome == Outcome::Done && (first || !carried))
    if (const int16_t wrong = whyNotFrom(arm.arm, ends.from); wrong != 0)
      return wrong;
  group::Leg leg;
  if (const int16_t wrong = carried ? carriedLeg(group, arm, request, moreAxesOf(ends), leg)
                                    : legOf(group, arm, request, ends, leg);
      wrong != 0)
    return wrong;
  if (!areWithinLimits(arm, ends, kArmAxes, arm.arm.more) ||
      (!carried && !areWithinLimits(arm, ends, 0, arm.arm.joints)))
    return error::SMC_ERROR__SMC_TRAFO_AXIS_LIMITS_EXCEEDED;
  group::Order order = request.order;
  if (carried)
    order.configuration = arm.arm.kinematics.configurationOf(state.motion.axes);
  else if (group::leadsTool(leg))
    order.configuration = configurationFor(arm.arm, leg, ends.from);
  group::append(state.motion, request.id, leg, order);
  state.tolerance = request.tolerance;
  locateTriggers(state, arm.arm, request.id, leg);
  for (int32_t k = 0; k < kAxes; ++k)
    state.end[k] = ends.to[k];
  state.lastAccepted = request.id;
  return 0;
}

/// Likewise, and the movement fails if there is an error.
int16_t appendOrFail(GroupRef &group, const GroupArm &arm, const Request &request) {
  const int16_t wrong = append(group, arm, request);
  if (wrong != 0)
    fail(stateOf(group), request.id, wrong);
  return wrong;
}

/// What has been aborted cannot be continued.
void forget(GroupState &state) noexcept {
  endTriggers(state);
  clearMotion(state);
  state.abortedEnd = state.abortedRequest;
}

/// Whether a request can come after the movements that the group has without rest and a new tool.
/// Those that cannot be in a moving system wait for rest: before that it is not known where the
/// axes are at the end of a path that is in such a system, or comes out of one.
bool canFollow(const GroupState &state, const Request &request) noexcept {
  return group::hasRoom(state.motion) && isSame(state.tool, request.tool) &&
         (canRide(request) || !group::isCarried(state.motion));
}

/// The group goes on with another tool, whose point is elsewhere.
void changeTool(GroupState &state, GroupArm &arm, const Tool &tool) {
  if (isSame(state.tool, tool))
    return;
  state.motion.tool = group::poseOf(group::frameOf(state.motion.tool) *
                                    kinematics::inverted(frameOf(state.tool)) * frameOf(tool));
  state.tool = tool;
  arm.setTool(state.tool);
}

/// The group is at rest for a request that needs that: what was before is over. An SMC_ERROR.
int16_t begin(GroupRef &group, GroupArm &arm, const Request &request) {
  GroupState &state = stateOf(group);
  if (request.kind == RequestKind::Halt) { // what it has stopped may still be kept
    const bool carried = group::isCarried(state.motion);
    changeSystem(group, arm, 0, request);
    if ((request.forgets || carried) && group.bOwns != 0)
      forget(state);
    group::setOutcome(state.motion, request.id, group::Outcome::Done);
    return 0;
  }
  const bool owned = group.bOwns != 0;
  if (owned) {
    endTriggers(state);
    clearMotion(state);
  }
  beginMoving(group);
  changeTool(state, arm, request.tool);
  changeSystem(group, arm, carrierOf(group, request), request);
  const int16_t wrong = appendOrFail(group, arm, request);
  if (wrong != 0 && !owned) {
    forgetSystems(state);
    endMoving(group);
  }
  return wrong;
}

void abortWaiting(GroupState &state) noexcept {
  for (; state.firstRequest < state.nextRequest; ++state.firstRequest)
    group::setOutcome(state.motion, requestAt(state, state.firstRequest).id,
                      group::Outcome::Aborted);
}

/// Whether there are no movements that the next one would come after.
bool isFresh(const GroupState &state) noexcept {
  return state.motion.first == state.motion.next || state.motion.abandoned;
}

/// Whether the movements before have come to rest as the next request needs it. One system at a
/// time can be left; halts and axes need all to be at rest.
bool canBegin(const GroupRef &group, bool elsewhere) noexcept {
  const GroupState &state = stateOf(group);
  if (demandsStandstill(group))
    return standsStill(state);
  return group::isAtRest(state.motion) && !(elsewhere && !group::isStill(state.motion.left));
}

} // namespace

bool aborts(const Request &request) noexcept {
  return request.bufferMode == buffer::MC_BUFFER_MODE__Aborting;
}

int16_t wrongHalt(const Request &halt) noexcept {
  const group::Order &order = halt.order;
  if (!isFactor(order.accelerationFactor) || !isFactor(order.jerkFactor) ||
      !isFactor(halt.torqueFactor))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_FACTOR;
  return halt.deceleration >= 0.0 && halt.jerk >= 0.0
             ? int16_t{0}
             : error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_DYNAMICS;
}

void setBraking(GroupState &state, const Request &request) noexcept {
  state.deceleration = request.deceleration;
  state.jerk = request.jerk;
  state.accelerationPart = state.jerkPart = 1.0;
  if (request.kind != RequestKind::Halt)
    return;
  // Strips know limits with the factors of their movements.
  const GroupMotion &motion = state.motion;
  for (int64_t k = motion.first; k < motion.next; ++k) {
    const group::Order &order = motion.movement[static_cast<uint64_t>(k) % group::kMovements].order;
    const group::Order &halt = request.order;
    if (order.dwell > 0.0)
      continue;
    state.accelerationPart =
        exact::smaller(state.accelerationPart, halt.accelerationFactor / order.accelerationFactor);
    state.jerkPart = exact::smaller(state.jerkPart, halt.jerkFactor / order.jerkFactor);
  }
}

double speedOf(const GroupMotion &motion, const group::Order &order) noexcept {
  if (motion.first < motion.next) {
    const group::Movement &last =
        motion.movement[static_cast<uint64_t>(motion.next - 1) % group::kMovements];
    if (group::leadsTool(last.leg))
      return last.order.path.velocity;
  }
  constexpr double kAny = 100.0;
  return exact::isPositive(order.path.velocity) ? order.path.velocity : kAny;
}

Frame<double> targetIn(const Frame<double> &system, const Request &request,
                       const double (&coordinates)[kArmAxes], const Frame<double> &begin) {
  const Frame<double> given = frameOf(coordinates);
  Frame<double> target = system * given;
  if (request.relative && request.system != decl::SMC_COORD_SYSTEM__TCS) {
    target.place = begin.place + system.turn * given.place;
    target.turn = system.turn * given.turn * system.turn.transpose() * begin.turn;
  }
  return target;
}

int16_t noteSystem(const GroupRef &group, Request &request) noexcept {
  request.carrier = carrierOf(group, request.system);
  if (request.system == decl::SMC_COORD_SYSTEM__ACS ||
      request.system == decl::SMC_COORD_SYSTEM__TCS)
    return 0;
  Frame<double> frame;
  if (!systemInMachine(group, request.system, frame))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  request.frame = group::poseOf(frame);
  return 0;
}

Frame<double> targetFrame(const Request &request, const double (&coordinates)[kArmAxes],
                          const Frame<double> &begin) {
  const bool inTool = request.system == decl::SMC_COORD_SYSTEM__TCS;
  return targetIn(inTool ? begin : group::frameOf(request.frame), request, coordinates, begin);
}

int16_t enqueue(GroupRef &group, Request &request) noexcept {
  GroupState &state = stateOf(group);
  if (const int16_t wrong = wrongInput(request); wrong != 0)
    return wrong;
  if (const int16_t wrong = noteSystem(group, request); wrong != 0)
    return wrong;
  const bool inMovingTool = request.system == decl::SMC_COORD_SYSTEM__TCS && state.rides != 0;
  if (givesToolAxes(request) && (request.carrier != 0 || inMovingTool))
    return error::SMC_ERROR__SMC_CP_NO_AXIS_ORIENTATION_WITH_TRACKING;
  if (request.kind != RequestKind::Halt && !canRide(request) &&
      carrierOf(group, request.system) != 0)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  if (aborts(request)) {
    abortAll(state, false);
    setBraking(state, request);
  }
  if (state.nextRequest - state.firstRequest == kRequests)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  request.id = group::drawId(state.motion);
  request.cycle = group.ulServed;
  request.tool = toolOf(group);
  request.tolerance = group.stTolerance;
  request.order.shares = sharesOf(group);
  request.order.isShared = true;
  requestAt(state, state.nextRequest) = request;
  ++state.nextRequest;
  return 0;
}

void takeRequests(GroupRef &group, GroupArm &arm) {
  GroupState &state = stateOf(group);
  while (!state.interrupting && state.firstRequest < state.nextRequest) {
    const Request &request = requestAt(state, state.firstRequest);
    const bool fresh = isFresh(state);
    const bool elsewhere = carrierOf(group, request) != state.rides;
    if (elsewhere && !fresh && !aborts(request))
      return; // after what is before has ended
    const bool begins = aborts(request) || fresh;
    if (begins ? group.bOwns != 0 && !canBegin(group, elsewhere) : !canFollow(state, request))
      return;
    const int16_t wrong = begins ? begin(group, arm, request) : appendOrFail(group, arm, request);
    ++state.firstRequest;
    if (wrong != 0)
      abortWaiting(state); // they would begin elsewhere than planned
  }
}

void abortAll(GroupState &state, bool all) noexcept {
  if (all) {
    group::abortInterrupted(state.motion);
    state.suspendedIn = 0;
  }
  if (!state.motion.abandoned) { // else it has been told already what can be continued
    state.abortedRequest = state.firstRequest;
    state.abortedEnd = state.nextRequest;
  }
  state.interrupting = false;
  group::abandon(state.motion);
  abortWaiting(state);
}

void forgetSystems(GroupState &state) noexcept {
  if (!group::isCarried(state.motion))
    return;
  forget(state);
  group::leaveSystems(state.motion);
  state.rides = state.leaves = 0;
}

void fail(GroupState &state, uint64_t id, int16_t error) noexcept {
  group::setOutcome(state.motion, id, group::Outcome::Failed);
  state.error[id % group::kOutcomes] = error;
}

bool demandsRest(const GroupState &state) noexcept {
  return state.motion.abandoned ||
         (state.firstRequest < state.nextRequest && aborts(requestAt(state, state.firstRequest)));
}

bool demandsStandstill(const GroupRef &group) noexcept {
  const GroupState &state = stateOf(group);
  if (state.firstRequest == state.nextRequest)
    return false;
  const Request &request = requestAt(state, state.firstRequest);
  return !canRide(request) && (aborts(request) || isFresh(state));
}

bool stopsAtOnce(const GroupRef &group, const GroupState &state) noexcept {
  return group.eState == decl::SMC_AXIS_GROUP_STATE__GroupStopping ||
         (state.firstRequest < state.nextRequest &&
          requestAt(state, state.firstRequest).kind == RequestKind::Halt);
}

uint64_t failedMovement(const GroupState &state) noexcept {
  const GroupMotion &motion = state.motion;
  return motion.looked < motion.next
             ? motion.movement[static_cast<uint64_t>(motion.looked) % group::kMovements].id
             : 0;
}

} // namespace stride::robotics
