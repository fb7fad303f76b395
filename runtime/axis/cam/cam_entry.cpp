#include "runtime/axis/cam/cam_entry.hpp"

#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/present_state.hpp"
#include "runtime/numeric/cam/approach.hpp"
#include "runtime/numeric/profile/modulo.hpp"

#include "st/SM_PLCopen/MC_StartMode.h"

namespace stride::motion {
namespace {

namespace mode = ::st::SM_PLCopen;
namespace number = ::st::SM_Error;

static_assert(sizeof(cam::Node) == sizeof(CamState{}.stBegin));

bool isRamp(int16_t startMode) noexcept {
  return startMode >= mode::MC_StartMode__ramp_in && startMode <= mode::MC_StartMode__ramp_in_neg;
}

Dynamics rampDynamics(const axis::AxisRef &slave, const CamCommand &command) noexcept {
  return plainDynamics(
      slave, {command.fVelocity, command.fAcceleration, command.fDeceleration, command.fJerk});
}

cam::Node nodeOf(const decltype(CamState::stBegin) &node) noexcept {
  return {node.dX, node.dY, node.dV, node.dA};
}

void setNode(decltype(CamState::stBegin) &out, const cam::Node &node) noexcept {
  out.dX = node.x;
  out.dY = node.y;
  out.dV = node.v;
  out.dA = node.a;
}

/// At which whole turn from the cam the compensating motion of a rotary slave ends. Without a
/// direction it is the one nearest to where the motion in progress can come to rest.
bool findTurn(const axis::AxisRef &slave, int16_t startMode, const State &distance,
              const Dynamics &dynamics, double &turn) noexcept {
  const double period = slave.fPositionPeriod;
  if (startMode == mode::MC_StartMode__ramp_in) {
    Profile stop;
    if (planStop(stop, distance, dynamics) != PlanError::None)
      return false;
    turn = period * exact::floor(stop.end.position / period + 0.5);
    return true;
  }
  const Direction direction =
      startMode == mode::MC_StartMode__ramp_in_pos ? Direction::Positive : Direction::Negative;
  return resolveModulo({distance, 0.0, 0.0, period, direction, Direction::Positive, dynamics},
                       turn);
}

/// The compensating motion leads the slave's distance from the cam to zero, on a rotary slave to a
/// whole number of turns.
int16_t planRamp(CamState &state, const axis::AxisRef &slave, const CamTarget &target) noexcept {
  const Dynamics dynamics = rampDynamics(slave, state.stCommand);
  const numeric::MotionState now = onwards(slave);
  State distance{now.position - target.state.position, now.velocity - target.state.velocity,
                 now.acceleration - target.state.acceleration};
  if (axis::isRotary(slave)) {
    distance.position = numeric::wrapPosition(distance.position, slave.fPositionPeriod);
    double goal = 0.0;
    if (!findTurn(slave, state.stCommand.eStartMode, distance, dynamics, goal))
      return number::SMC_ERROR__SMC_CI_RAMPIN_NEEDS_VELACC_VALUES;
    distance.position -= goal; // so that it ends at 0
  }
  Profile profile;
  if (planMove(profile, distance, 0.0, 0.0, dynamics) != PlanError::None)
    return number::SMC_ERROR__SMC_CI_RAMPIN_NEEDS_VELACC_VALUES;
  loadPlan(state.stRamp, profile, slave.fTaskCycle);
  state.byPhase = static_cast<uint8_t>(CamPhase::Compensating);
  return axis::error::kNone;
}

/// The compensating motion in this cycle; over time, its first state is that of the start.
numeric::MotionState compensation(CamState &state) noexcept {
  auto &plan = state.stRamp;
  const double t = axis::planTime(plan);
  ++plan.ulCycle;
  if (!axis::isPlanOver(plan, t))
    return axis::pieceState(plan, t);
  state.byPhase = static_cast<uint8_t>(CamPhase::OnCam);
  return {0.0, 0.0, 0.0};
}

/// By how much the slave's zero point has been shifted since the cam began. [u]
double shiftOf(const CamState &state, const axis::AxisRef &slave) noexcept {
  return slave.fOffsetPosition - state.stFollow.fFirstOffset;
}

/// The master's place over whole periods. [master u]
double unrolled(const CamState &state, const cam::Curve &curve, const CamTarget &target) noexcept {
  return target.place.position +
         static_cast<double>(target.place.period - state.liFirstPeriod) * (curve.end - curve.start);
}

/// Which place of the master is the next one where the slave can be on the cam, when it moves to
/// `side`.
bool findSync(CamState &state, const cam::Curve &curve, double x, double side) noexcept {
  double sync = state.stCommand.fSyncPosition;
  if (state.stCommand.stCam.Periodic != 0) {
    const double length = curve.end - curve.start;
    const double ahead = numeric::wrapPosition(side * (sync - x), length);
    sync = x + side * (ahead > 0.0 ? ahead : length);
  }
  state.fSync = sync;
  return side * (sync - x) > 0.0;
}

/// The place on the cam where the slave shall be, and its course there from where it is.
bool beginApproach(CamState &state, const cam::Curve &curve, const axis::AxisRef &slave,
                   const CamTarget &target, double x) noexcept {
  cam::Approach approach{};
  if (!cam::placeOver(onwards(slave), x, target.velocity, target.acceleration, approach.begin))
    return false;
  const bool periodic = state.stCommand.stCam.Periodic != 0;
  const cam::Place place =
      periodic ? cam::placeOf({state.fSync, 0.0}, curve.start, curve.end - curve.start)
               : cam::Place{0, state.fSync};
  uint32_t index = 0;
  const cam::Point point = cam::evaluateCurve(curve, place.position, periodic, index);
  const double scaling = state.stCommand.fSlaveScaling;
  approach.end = {state.fSync,
                  slavePosition(state, slave, place.period,
                                place.period != 0 ? cam::riseOf(curve) * scaling : 0.0,
                                point.y * scaling),
                  point.v * scaling, point.a * scaling};
  if (axis::isRotary(slave)) {
    // The turn in which the slave has least to make up.
    const double even = approach.begin.y + cam::evenWay(approach);
    const double period = slave.fPositionPeriod;
    approach.end.y += period * exact::floor((even - approach.end.y) / period + 0.5);
  }
  const double shift = shiftOf(state, slave);
  approach.begin.y -= shift;
  approach.end.y -= shift;
  setNode(state.stBegin, approach.begin);
  setNode(state.stEnd, approach.end);
  state.byPhase = static_cast<uint8_t>(CamPhase::Approaching);
  return true;
}

/// Waits until the master moves and is near enough, then approaches.
int16_t stepWaiting(CamState &state, const cam::Curve &curve, const axis::AxisRef &slave,
                    const CamTarget &target) noexcept {
  const double x = unrolled(state, curve, target);
  if (target.velocity == 0.0)
    return axis::error::kNone;
  const auto side = static_cast<int8_t>(target.velocity < 0.0 ? -1 : 1);
  if (state.siDirection != side) {
    if (!findSync(state, curve, x, side))
      return number::SMC_ERROR__SMC_CI_MASTER_OUT_OF_SCALE;
    state.siDirection = side;
  }
  const double distance = state.stCommand.fStartDistance;
  if (!(distance > 0.0) || side * (state.fSync - x) <= distance)
    (void)beginApproach(state, curve, slave, target, x);
  return axis::error::kNone;
}

} // namespace

numeric::MotionState onwards(const axis::AxisRef &slave) noexcept {
  numeric::MotionState state = axis::presentState(slave);
  if (slave.bMovedInThisCycle == 0)
    state.position += state.velocity * slave.fTaskCycle;
  return state;
}

int16_t startCam(CamState &state, cam::Curve &curve, const axis::AxisRef &slave,
                 axis::AxisRef &master, CamTarget &target, const CamJoint *joint) noexcept {
  const CamCommand &command = state.stCommand;
  if (const int16_t error = openCam(command.stCam, curve); error != axis::error::kNone)
    return error;
  if (const int16_t error = checkCamInputs(command); error != axis::error::kNone)
    return error;
  const MasterMotion motion = beginMaster(state.stMaster, master);
  state.stFollow.fFirstOffset = slave.fOffsetPosition;
  const bool relative =
      command.eStartMode == mode::MC_StartMode__relative || command.stCam.SlaveAbsolute == 0;
  const double position = cam::toDouble(motion.position);
  const CamStart start = joint != nullptr
                             ? CamStart{position - joint->beyond, joint->slave, relative}
                             : CamStart{position, onwards(slave).position, relative};
  if (const int16_t error = enterCam(state, curve, start, motion); error != axis::error::kNone)
    return error;
  return evaluateCam(state, curve, motion, slave, target) ? axis::error::kNone
                                                          : axis::error::kOutOfRange;
}

int16_t checkEntry(const axis::AxisRef &slave, const CamCommand &command) noexcept {
  if (command.eStartMode < mode::MC_StartMode__absolute ||
      command.eStartMode > mode::MC_StartMode__ramp_in_dist ||
      !exact::isfinite(command.fHysteresis) || command.fHysteresis < 0.0)
    return number::SMC_ERROR__SMC_INVALID_PARAMETER;
  if (command.eStartMode == mode::MC_StartMode__ramp_in_dist)
    return exact::isfinite(command.fStartDistance) && exact::isfinite(command.fSyncPosition)
               ? int16_t{axis::error::kNone}
               : int16_t{number::SMC_ERROR__SMC_INVALID_PARAMETER};
  if (!isRamp(command.eStartMode))
    return axis::error::kNone;
  Profile profile;
  const bool good =
      planMove(profile, {1.0, 0.0, 0.0}, 0.0, 0.0, rampDynamics(slave, command)) == PlanError::None;
  return good ? int16_t{axis::error::kNone}
              : int16_t{number::SMC_ERROR__SMC_CI_RAMPIN_NEEDS_VELACC_VALUES};
}

int16_t beginEntry(CamState &state, const cam::Curve &curve, const axis::AxisRef &slave,
                   const CamTarget &target) noexcept {
  state.byPhase = static_cast<uint8_t>(CamPhase::OnCam);
  state.fRamp = 0.0;
  if (isRamp(state.stCommand.eStartMode))
    return planRamp(state, slave, target);
  if (state.stCommand.eStartMode != mode::MC_StartMode__ramp_in_dist)
    return axis::error::kNone;
  state.byPhase = static_cast<uint8_t>(CamPhase::Waiting);
  state.siDirection = 0;
  return stepWaiting(state, curve, slave, target);
}

int16_t stepEntry(CamState &state, const cam::Curve &curve, const axis::AxisRef &slave,
                  const CamTarget &target, numeric::MotionState &set) noexcept {
  if (phaseOf(state) == CamPhase::Waiting)
    if (const int16_t problem = stepWaiting(state, curve, slave, target);
        problem != axis::error::kNone)
      return problem;
  set = target.state;
  switch (phaseOf(state)) {
  case CamPhase::OnCam:
    break;
  case CamPhase::Compensating: {
    const numeric::MotionState added = compensation(state);
    set.position += added.position;
    set.velocity += added.velocity;
    set.acceleration += added.acceleration;
    state.fRamp = added.position;
    break;
  }
  case CamPhase::Waiting:
    set = onwards(slave);
    set.acceleration = 0.0;
    break;
  case CamPhase::Approaching: {
    const double x = unrolled(state, curve, target);
    const double side = state.siDirection;
    if (side * (x - state.stEnd.dX) >= 0.0) {
      state.byPhase = static_cast<uint8_t>(CamPhase::OnCam);
      break;
    }
    if (side * (x - state.stBegin.dX) < 0.0)
      return number::SMC_ERROR__SMC_GIP_MASTER_DIRECTION_CHANGE;
    set = cam::motionOver(cam::evaluateQuintic(nodeOf(state.stBegin), nodeOf(state.stEnd), x),
                          target.velocity, target.acceleration);
    set.position += shiftOf(state, slave);
    break;
  }
  }
  return axis::error::kNone;
}

} // namespace stride::motion
