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

/// How far the axis has gone in a cycle: the shorter way round, if it is modulo. [u]
double travelOf(const Carrier &carrier, double position) noexcept {
  const double travel = position - carrier.fAxis;
  const AxisRef &axis = *carrier.pAxis;
  const double period = axis.fPositionPeriod;
  if (axis.iMovementType != 0 || !(period > 0.0))
    return travel;
  return travel - period * exact::floor(travel / period + 0.5);
}

void look(Carrier &carrier, double cycle) noexcept {
  const AxisRef &axis = *carrier.pAxis;
  const double position = positionOf(carrier);
  carrier.fWay += travelOf(carrier, position);
  carrier.fAxis = position;
  if (carrier.bActual == 0) {
    carrier.fVelocity = axis.fSetVelocity;
    carrier.fAcceleration = axis.fSetAcceleration;
    return;
  }
  const double velocity = axis.fActVelocity;
  carrier.fAcceleration = (velocity - carrier.fVelocity) / cycle;
  carrier.fVelocity = velocity;
}

group::MovingSystem movingSystem(const Carrier &carrier, const Frame<double> &world) {
  return {group::poseOf(world * frameOf(carrier.stOrigin)),
          group::poseOf(frameOf(carrier.stObject)),
          carrier.bTable != 0 ? group::CarrierKind::Table : group::CarrierKind::Belt};
}

} // namespace

int32_t carrierOf(const GroupRef &group, int16_t system) noexcept {
  const int32_t index = settableSystem(system);
  return index > 0 && carrierAt(group, index).pAxis != nullptr ? index : 0;
}

void lookAtCarriers(GroupRef &group) noexcept {
  for (int32_t i = 1; i <= kCarriers; ++i)
    if (Carrier &carrier = carrierAt(group, i); carrier.pAxis != nullptr)
      look(carrier, group.apAxis.v[0]->fTaskCycle);
}

motion::State stateOfCarrier(const GroupRef &group, int32_t carrier) noexcept {
  const Carrier &on = carrierAt(group, carrier);
  return {on.fWay, on.fVelocity, on.fAcceleration};
}

group::MovingSystem systemOn(const GroupRef &group, int32_t carrier) {
  Frame<double> world;
  (void)systemInMachine(group, decl::SMC_COORD_SYSTEM__WCS, world);
  return movingSystem(carrierAt(group, carrier), world);
}

Frame<double> systemInWorld(const GroupRef &group, int32_t carrier) {
  const Carrier &on = carrierAt(group, carrier);
  const group::MovingSystem system =
      movingSystem(on, kinematics::unturned(kinematics::Vector<double>(0.0, 0.0, 0.0)));
  return group::valueOf(group::systemAt(system, group::Series(on.fWay)));
}

int16_t setCarrier(GroupRef &group, int16_t system, const Carrier &on) {
  const int32_t index = settableSystem(system);
  if (index <= 0)
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  if (group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled || on.pAxis == nullptr)
    return error::SMC_ERROR__SMC_AXIS_GROUP_WRONG_STATE;
  if (isInUse(group, system))
    return error::SMC_ERROR__SMC_AXIS_GROUP_PCS_STILL_IN_USE;
  for (int32_t i = 0; i < group.uiAxes; ++i)
    if (group.apAxis.v[i] == on.pAxis) // it would follow itself
      return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
  Carrier &carrier = carrierAt(group, index);
  carrier = on;
  carrier.fAxis = positionOf(on);
  carrier.fVelocity = on.bActual != 0 ? on.pAxis->fActVelocity : on.pAxis->fSetVelocity;
  return 0;
}

bool isInUse(const GroupRef &group, int16_t system) noexcept {
  const int32_t carrier = carrierOf(group, system);
  if (carrier == 0 || group.eState == decl::SMC_AXIS_GROUP_STATE__GroupDisabled)
    return false;
  const GroupState &state = stateOf(group);
  if (state.rides == carrier || (state.leaves == carrier && !group::isStill(state.motion.left)))
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
  return carrierOf(group, request.system);
}

void changeSystem(GroupRef &group, const GroupArm &arm, int32_t carrier, const Request &request) {
  GroupState &state = stateOf(group);
  if (state.rides == carrier)
    return;
  state.leaves = state.rides;
  state.rides = carrier;
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
  else if (state.rides == 0 && !systemInMachine(group, request.system, system))
    return error::SMC_ERROR__SMC_AXIS_GROUP_INVALID_COORDINATE_SYSTEM;
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
