#include "runtime/blocks/SM3_Robotics/requests.hpp"

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/SMC_AXIS_GROUP_STATE.h"
#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"
#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace buffer = ::st::SM_DriveBasic;
namespace error = ::st::SM_Error;
using group::GroupMotion;
using kinematics::Frame;
using kinematics::Outcome;

Request &requestAt(GroupState &state, int64_t number) noexcept {
  return state.request[static_cast<uint64_t>(number) % kRequests];
}
const Request &requestAt(const GroupState &state, int64_t number) noexcept {
  return state.request[static_cast<uint64_t>(number) % kRequests];
}

bool aborts(const Request &request) noexcept {
  return request.bufferMode == buffer::MC_BUFFER_MODE__Aborting;
}

bool isFactor(double factor) noexcept { return factor > 0.0 && factor <= 1.0; }

/// What is wrong with the inputs of a movement: an SMC_ERROR.
int16_t wrongInput(const Request &request) noexcept {
  if (request.kind == RequestKind::Halt)
    return request.deceleration >= 0.0 ? int16_t{0}
                                       : error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_DYNAMICS;
  const group::Order &order = request.order;
  if (request.bufferMode < buffer::MC_BUFFER_MODE__Aborting ||
      request.bufferMode > buffer::MC_BUFFER_MODE__BlendingHigh)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_BUFFER_MODE;
  if (!isFactor(order.velocityFactor) || !isFactor(order.accelerationFactor) ||
      !isFactor(order.jerkFactor))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_FACTOR;
  const group::PathLimits &path = order.path;
  if (request.kind == RequestKind::Linear &&
      (!exact::isPositive(path.velocity) || !exact::isPositive(path.acceleration) ||
       !exact::isPositive(path.deceleration) || !exact::isPositive(path.jerk)))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_DYNAMICS;
  if (order.transition != group::Transition::None && !exact::isPositive(order.transitionValue))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_TRANSITION;
  for (const double position : request.position)
    if (!exact::isfinite(position))
      return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  return 0;
}

/// The pose that a request means, from the pose where it begins. An SMC_ERROR.
int16_t targetFrame(const GroupRef &group, const Request &request, const Frame<double> &begin,
                    Frame<double> &target) {
  const bool inTool = request.system == decl::SMC_COORD_SYSTEM__TCS;
  Frame<double> system = begin;
  if (!inTool && !systemInMachine(group, request.system, system))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  const Frame<double> given = frameOf(request.position);
  target = system * given;
  if (request.relative && !inTool) {
    target.place = begin.place + system.turn * given.place;
    target.turn = system.turn * given.turn * system.turn.transpose() * begin.turn;
  }
  return 0;
}

/// From where a movement goes to where: axes at both ends.
struct Ends {
  double from[kAxes];
  double to[kAxes];
};

/// The axes where a movement ends that is given by the tool. An SMC_ERROR.
int16_t axesOfTool(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends) {
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  const kinematics::KinematicsRef &kinematics = arm.arm.kinematics;
  Frame<double> begin;
  if (const Outcome outcome = kinematics.forward(ends.from, begin); outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  Frame<double> target;
  if (const int16_t wrong = targetFrame(group, request, begin, target); wrong != 0)
    return wrong;
  kinematics::Configuration configuration = kinematics.configurationOf(ends.from);
  if (request.kind == RequestKind::Direct && group.bConfiguration != 0)
    __builtin_memcpy(&configuration, &group.stConfiguration, sizeof configuration);
  const Outcome outcome = kinematics.inverse(target, configuration, ends.from, ends.to);
  if (outcome != Outcome::Done)
    return kinematics::errorOf(outcome);
  // What the kinematics cannot choose of a pose it does not look at; of its place it must reach
  // all.
  constexpr double kNear = 1e-6;
  Frame<double> reached;
  (void)kinematics.forward(ends.to, reached);
  const double far = (reached.place - target.place).norm();
  return far <= kNear * kinematics.reach() ? int16_t{0}
                                           : error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
}

/// Where a movement ends. An SMC_ERROR.
int16_t findEnd(const GroupRef &group, const GroupArm &arm, const Request &request, Ends &ends) {
  for (int32_t k = 0; k < kAxes; ++k)
    ends.to[k] = ends.from[k];
  if (request.system != decl::SMC_COORD_SYSTEM__ACS) {
    if (const int16_t wrong = axesOfTool(group, arm, request, ends); wrong != 0)
      return wrong;
  } else {
    for (int32_t k = 0; k < arm.arm.joints; ++k)
      ends.to[k] = (request.relative ? ends.from[k] : 0.0) + request.position[k];
  }
  for (int32_t k = 0; k < arm.arm.joints; ++k)
    if (ends.to[k] < arm.arm.limits[k].low || ends.to[k] > arm.arm.limits[k].high)
      return error::SMC_ERROR__SMC_TRAFO_AXIS_LIMITS_EXCEEDED;
  return 0;
}

int16_t linearLeg(const GroupArm &arm, const Ends &ends, group::Leg &leg) {
  if (arm.outcome != Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  Frame<double> from;
  Frame<double> to;
  (void)arm.arm.kinematics.forward(ends.from, from);
  if (arm.arm.kinematics.forward(ends.to, to) != Outcome::Done)
    return error::SMC_ERROR__SMC_TRAFO_OUT_OF_WORKSPACE;
  group::MoreAxes more;
  for (int32_t k = 0; k < kMoreAxes; ++k) {
    more.from[k] = ends.from[kArmAxes + k];
    more.to[k] = ends.to[kArmAxes + k];
  }
  leg = group::lineLeg(group::poseOf(from), group::poseOf(to), more);
  return 0;
}

/// How long ways of axes are beside ways of the tool: the velocity that a second's way is taken
/// for.
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

/// Makes a movement of a request; the group is at its end, or at rest. An SMC_ERROR.
int16_t append(GroupRef &group, const GroupArm &arm, const Request &request) {
  GroupState &state = stateOf(group);
  const bool first = state.motion.first == state.motion.next;
  Ends ends;
  for (int32_t k = 0; k < kAxes; ++k)
    ends.from[k] = first ? state.motion.axes[k] : state.end[k];
  if (const int16_t wrong = findEnd(group, arm, request, ends); wrong != 0)
    return wrong;
  group::Order order = request.order;
  group::Leg leg;
  if (request.kind == RequestKind::Linear) {
    if (const int16_t wrong = linearLeg(arm, ends, leg); wrong != 0)
      return wrong;
    order.configuration = arm.arm.kinematics.configurationOf(ends.from);
  } else {
    double perTime[kAxes];
    for (int32_t k = 0; k < kAxes; ++k)
      perTime[k] = arm.arm.limits[k].velocity * order.velocityFactor;
    leg = group::axesLeg(ends.from, ends.to, perTime, speedOf(state.motion, order));
  }
  group::append(state.motion, request.id, leg, order);
  locateTriggers(state, arm.arm, request.id, leg);
  for (int32_t k = 0; k < kAxes; ++k)
    state.end[k] = ends.to[k];
  state.lastAccepted = request.id;
  return 0;
}

/// The group is at rest for a request that needs that: what was before is over.
void begin(GroupRef &group, const GroupArm &arm, const Request &request) {
  GroupState &state = stateOf(group);
  if (group.bOwns != 0) {
    endTriggers(state);
    group::clear(state.motion);
  }
  if (request.kind == RequestKind::Halt) {
    group::setOutcome(state.motion, request.id, group::Outcome::Done);
    return;
  }
  beginMoving(group);
  if (const int16_t wrong = append(group, arm, request); wrong != 0)
    fail(state, request.id, wrong);
}

} // namespace

int16_t enqueue(GroupRef &group, Request &request) noexcept {
  GroupState &state = stateOf(group);
  if (const int16_t wrong = wrongInput(request); wrong != 0)
    return wrong;
  if (aborts(request)) {
    abortRequests(state);
    group::abandon(state.motion);
    state.deceleration = request.deceleration;
  }
  if (state.nextRequest - state.firstRequest == kRequests)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  request.id = group::drawId(state.motion);
  requestAt(state, state.nextRequest) = request;
  ++state.nextRequest;
  return 0;
}

void takeRequests(GroupRef &group, const GroupArm &arm) {
  GroupState &state = stateOf(group);
  while (state.firstRequest < state.nextRequest) {
    const Request &request = requestAt(state, state.firstRequest);
    const bool fresh = state.motion.first == state.motion.next || state.motion.abandoned;
    if (aborts(request) || fresh) {
      if (group.bOwns != 0 && !group::isAtRest(state.motion))
        return;
      begin(group, arm, request);
    } else {
      if (!group::hasRoom(state.motion))
        return;
      if (const int16_t wrong = append(group, arm, request); wrong != 0)
        fail(state, request.id, wrong);
    }
    ++state.firstRequest;
  }
}

void abortRequests(GroupState &state) noexcept {
  for (; state.firstRequest < state.nextRequest; ++state.firstRequest)
    group::setOutcome(state.motion, requestAt(state, state.firstRequest).id,
                      group::Outcome::Aborted);
}

void fail(GroupState &state, uint64_t id, int16_t error) noexcept {
  group::setOutcome(state.motion, id, group::Outcome::Failed);
  state.error[id % group::kOutcomes] = error;
}

bool demandsRest(const GroupState &state) noexcept {
  return state.motion.abandoned ||
         (state.firstRequest < state.nextRequest && aborts(requestAt(state, state.firstRequest)));
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
