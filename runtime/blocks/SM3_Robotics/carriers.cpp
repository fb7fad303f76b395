#include "runtime/blocks/SM3_Robotics/carriers.hpp"

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "st/SM3_Robotics/SMC_COORD_SYSTEM.h"

namespace stride::robotics {
namespace {

namespace decl = ::st::SM3_Robotics;
namespace error = ::st::SM_Error;
using axis::AxisRef;
using kinematics::Frame;
using Carrier = decl::SMC_GROUP_CARRIER;

Carrier &carrierAt(GroupRef &group, int32_t carrier) noexcept {
  return group.astCarrier.v[carrier - 1];
}
const Carrier &carrierAt(const GroupRef &group, int32_t carrier) noexcept {
  return group.astCarrier.v[carrier - 1];
}

double positionOf(const Carrier &carrier) noexcept {
  return carrier.bActual != 0 ? carrier.pAxis->fActPosition : carrier.pAxis->fSetPosition;
}

/// How far the axis has gone in a cycle, in which it goes about as far as `expected`: of whole
/// turns nothing else is known. A shift of its zero point (MC_SetPosition) is no motion. [u]
double travelOf(const Carrier &carrier, double position, double expected) noexcept {
  const AxisRef &axis = *carrier.pAxis;
  const double travel = position - carrier.fAxis - (axis.fOffsetPosition - carrier.fOffset);
  const double period = axis.fPositionPeriod;
  if (axis.iMovementType != 0 || !(period > 0.0))
    return travel;
  return travel - period * exact::floor((travel - expected) / period + 0.5);
}

void look(Carrier &carrier, double cycle) noexcept {
  const AxisRef &axis = *carrier.pAxis;
  const double position = positionOf(carrier);
  const double velocity = carrier.bActual != 0 ? axis.fActVelocity : axis.fSetVelocity;
  carrier.fWay += travelOf(carrier, position, 0.5 * (carrier.fVelocity + velocity) * cycle);
  carrier.fAxis = position;
  carrier.fOffset = axis.fOffsetPosition;
  if (carrier.bActual == 0) {
    carrier.fVelocity = velocity;
    carrier.fAcceleration = axis.fSetAcceleration;
    return;
  }
  carrier.fAcceleration = (velocity - carrier.fVelocity) / cycle;
  carrier.fVelocity = velocity;
}

group::MovingSystem &masterAt(GroupRef &group, int32_t carrier) noexcept {
  return stateOf(group).master[carrier - 1];
}
const group::MovingSystem &masterAt(const GroupRef &group, int32_t carrier) noexcept {
  return stateOf(group).master[carrier - 1];
}

numeric::Vector3 turned(const Frame<double> &frame, const numeric::Vector3 &v) noexcept {
  return group::plain(frame.turn * group::vectorOf(v));
}

/// The same system in another frame.
group::MovingSystem systemFrom(const Frame<double> &frame, const group::MovingSystem &system) {
  group::MovingSystem moved = system;
  moved.origin = group::poseOf(frame * group::frameOf(system.origin));
  moved.tool.velocity = turned(frame, system.tool.velocity);
  moved.tool.acceleration = turned(frame, system.tool.acceleration);
  moved.tool.spin = turned(frame, system.tool.spin);
  moved.tool.spinChange = turned(frame, system.tool.spinChange);
  return moved;
}

/// The system on a carrier in a frame in which the world is at `world`.
group::MovingSystem movingSystem(const GroupRef &group, int32_t index, const Frame<double> &world) {
  const Carrier &carrier = carrierAt(group, index);
  if (carrier.pMaster != nullptr)
    return systemFrom(world, masterAt(group, index));
  return {group::poseOf(world * frameOf(carrier.stOrigin)),
          group::poseOf(frameOf(carrier.stObject)),
          carrier.bTable != 0 ? group::CarrierKind::Table : group::CarrierKind::Belt,
          {}};
}

/// The tool of a group in the world as a series in time, from the set values of its axes.
kinematics::Outcome toolInWorld(const GroupRef &group, const group::Arm &arm,
                                Frame<group::Series> &tool) {
  group::Series axes[kAxes] = {};
  for (int32_t i = 0; i < arm.joints; ++i) {
    const AxisRef &axis = *group.apAxis.v[i];
    axes[i] = group::inTime({axis.fSetPosition, axis.fSetVelocity, axis.fSetAcceleration});
  }
  const kinematics::Outcome outcome = arm.kinematics.forward(axes, tool);
  tool = group::seriesOf(frameOf(group.astSystem.v[0])) * tool;
  return outcome;
}

/// Where the master's tool is in this cycle. An SMC_ERROR: where it was is where it stays.
int16_t lookAtMaster(Ctx &ctx, GroupRef &group, int32_t index) {
  const Carrier &carrier = carrierAt(group, index);
  GroupRef &master = *carrier.pMaster;
  serve(ctx, master);
  group::MovingSystem &system = masterAt(group, index);
  system.tool = {carrier.fWay, {}, {}, {}, {}};
  if (master.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  const GroupArm arm(ctx, master);
  if (arm.outcome != kinematics::Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  Frame<group::Series> tool;
  if (const kinematics::Outcome outcome = toolInWorld(master, arm.arm, tool);
      outcome != kinematics::Outcome::Done)
    return kinematics::errorOf(outcome);
  system.kind = group::CarrierKind::Tool;
  system.object = group::poseOf(frameOf(carrier.stObject));
  system.tool = group::motionOf(tool, carrier.fWay, system.origin);
  return 0;
}

/// Whether a group is followed by another one, at whatever remove.
bool isFollowedBy(const GroupRef &group, const GroupRef &other, int32_t depth) noexcept {
  constexpr int32_t kMostDepth = 16;
  if (&group == &other || depth == kMostDepth)
    return true;
  for (const Carrier &carrier : other.astCarrier.v)
    if (carrier.pMaster != nullptr && isFollowedBy(group, *carrier.pMaster, depth + 1))
      return true;
  return false;
}

/// Whether PCS_1 or PCS_2 cannot be put on a carrier now: an SMC_ERROR.
int16_t whyNotSet(const GroupRef &group, int16_t system) noexcept {
  if (settableSystem(system) <= 0)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  return isInUse(group, system) ? error::SMC_ERROR__SMC_AXIS_GROUP_PCS_STILL_IN_USE : int16_t{0};
}

} // namespace

int32_t carrierOf(const GroupRef &group, int16_t system) noexcept {
  const int32_t index = settableSystem(system);
  if (index <= 0)
    return 0;
  const Carrier &carrier = carrierAt(group, index);
  return carrier.pAxis != nullptr || carrier.pMaster != nullptr ? index : 0;
}

int16_t systemNumber(int32_t carrier) noexcept {
  return carrier == 1 ? decl::SMC_COORD_SYSTEM__PCS_1 : decl::SMC_COORD_SYSTEM__PCS_2;
}

void lookAtCarriers(Ctx &ctx, GroupRef &group) {
  const double cycle = group.apAxis.v[0]->fTaskCycle;
  for (int32_t i = 1; i <= kCarriers; ++i) {
    Carrier &carrier = carrierAt(group, i);
    if (carrier.pAxis != nullptr)
      look(carrier, cycle);
    if (carrier.pMaster == nullptr)
      continue;
    carrier.fWay += cycle; // of a tool the time counts
    (void)lookAtMaster(ctx, group, i);
    GroupState &state = stateOf(group);
    if (state.rides == i && state.motion.ride.follows)
      state.motion.ride.system = systemOn(group, i);
  }
}

motion::State stateOfCarrier(const GroupRef &group, int32_t carrier) noexcept {
  const Carrier &on = carrierAt(group, carrier);
  return {on.fWay, on.fVelocity, on.fAcceleration};
}

group::MovingSystem systemOn(const GroupRef &group, int32_t carrier) {
  Frame<double> world;
  (void)systemInMachine(group, decl::SMC_COORD_SYSTEM__WCS, world);
  return movingSystem(group, carrier, world);
}

Frame<double> systemInWorld(const GroupRef &group, int32_t carrier) {
  const group::MovingSystem system =
      movingSystem(group, carrier, kinematics::unturned(kinematics::Vector<double>(0.0, 0.0, 0.0)));
  return group::valueOf(group::systemAt(system, group::Series(carrierAt(group, carrier).fWay)));
}

int16_t setCarrier(GroupRef &group, int16_t system, const Carrier &on) {
  if (const int16_t wrong = whyNotSet(group, system); wrong != 0)
    return wrong;
  if (on.pAxis == nullptr)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  if (!isFinite(on.stOrigin) || !isFinite(on.stObject))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  for (int32_t i = 0; i < group.uiAxes; ++i)
    if (group.apAxis.v[i] == on.pAxis) // it would follow itself
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  Carrier &carrier = carrierAt(group, settableSystem(system));
  carrier = on;
  carrier.fAxis = positionOf(on);
  carrier.fOffset = on.pAxis->fOffsetPosition;
  carrier.fVelocity = on.bActual != 0 ? on.pAxis->fActVelocity : on.pAxis->fSetVelocity;
  return 0;
}

int16_t setMaster(Ctx &ctx, GroupRef &group, int16_t system, GroupRef *master,
                  const decl::MC_COORD_REF &onTool) {
  if (const int16_t wrong = whyNotSet(group, system); wrong != 0)
    return wrong;
  if (master == nullptr)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  if (!isFinite(onTool))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_PARAMETER;
  if (isFollowedBy(group, *master, 0))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  const int32_t index = settableSystem(system);
  Carrier &carrier = carrierAt(group, index);
  carrier = {};
  carrier.pMaster = master;
  carrier.stObject = onTool;
  carrier.fVelocity = 1.0; // of time
  const int16_t wrong = lookAtMaster(ctx, group, index);
  if (wrong != 0)
    carrier = {};
  return wrong;
}

bool isInUse(const GroupRef &group, int16_t system) noexcept {
  const int32_t carrier = carrierOf(group, system);
  if (carrier == 0 || group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled)
    return false;
  const GroupState &state = stateOf(group);
  if (state.suspendedIn == carrier || state.rides == carrier ||
      (state.leaves == carrier && !group::isStill(state.motion.left)))
    return true;
  for (int64_t k = state.firstRequest; k < state.nextRequest; ++k)
    if (carrierOf(group, requestAt(state, k)) == carrier)
      return true;
  return false;
}

int32_t carrierOf(const GroupRef &group, const Request &request) noexcept {
  if (!canRide(request))
    return 0;
  if (request.system == decl::SMC_COORD_SYSTEM__TCS)
    return stateOf(group).rides;
  return carrierOf(group, request.system) == request.carrier ? request.carrier : 0;
}

void changeSystem(GroupRef &group, const GroupArm &arm, int32_t carrier, const Request &request) {
  GroupState &state = stateOf(group);
  if (state.rides == carrier)
    return;
  state.referenced = state.lastAccepted;
  state.leaves = state.rides;
  state.rides = carrier;
  state.hasReached = false;
  if (carrier == 0) {
    group::alight(state.motion, arm.arm);
    return;
  }
  const group::MovingSystem system = systemOn(group, carrier);
  const motion::State now = stateOfCarrier(group, carrier);
  group::board(state.motion, arm.arm, system, now,
               group::boardingDynamics(state.motion, arm.arm, system, now, request.order.path));
}

int16_t carriedLeg(GroupRef &group, const GroupArm &arm, const Request &request,
                   const group::MoreAxes &more, group::Leg &leg) {
  if (arm.outcome != kinematics::Outcome::Done)
    return kinematics::errorOf(arm.outcome);
  GroupState &state = stateOf(group);
  const bool first = state.motion.first == state.motion.next;
  const group::Pose begin = first ? group::poseInPath(state.motion, arm.arm) : state.endPose;
  const Frame<double> from = group::frameOf(begin);
  Frame<double> system = kinematics::unturned(kinematics::Vector<double>(0.0, 0.0, 0.0));
  if (request.system == decl::SMC_COORD_SYSTEM__TCS)
    system = from;
  else if (state.rides == 0)
    system = group::frameOf(request.frame);
  const group::Pose end = group::poseOf(targetIn(system, request, request.position, from));
  if (request.kind == RequestKind::Circular) {
    const Frame<double> aux = targetIn(system, request, request.aux, from);
    if (const int16_t wrong = arcLeg(request, begin, group::plain(aux.place), end, more, leg);
        wrong != 0)
      return wrong;
  } else {
    leg = group::lineLeg(begin, end, more);
  }
  state.endPose = end;
  return 0;
}

} // namespace stride::robotics
