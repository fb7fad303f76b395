#include "runtime/axis/axis_cycle.hpp"

#include "runtime/axis/increments.hpp"
#include "runtime/axis/plan_axis.hpp"
#include "runtime/axis/shift_position.hpp"

namespace stride::axis {
namespace {

bool isMotion(int16_t axisState) noexcept {
  return axisState == state::kDiscrete || axisState == state::kContinuous ||
         axisState == state::kSynchronized || axisState == state::kHoming;
}

/// How an axis brakes that nobody moves any more.
enum class Braking : uint8_t {
  Gentle, ///< As its ramp type says: with limited jerk.
  Hard,   ///< With the whole deceleration at once, in the shortest way.
};

/// The jerk of the command in progress, or the axis's own. [u/s^3]
double brakingJerk(const AxisRef &axis) noexcept {
  const auto &plan = axis.stPlanner;
  const bool commanded = plan.fDeceleration > 0.0 && exact::isPositive(plan.stCommand.fJerk);
  return commanded ? plan.stCommand.fJerk : axis.fJerk;
}

/// Plans the way to rest under the axis's ramp type. False: there is no jerk that it could keep.
bool planGently(AxisRef &axis, double deceleration) noexcept {
  const auto ramp = static_cast<motion::RampType>(axis.eRampType);
  if (ramp == motion::RampType::Trapezoid)
    return false;
  numeric::MotionState start = setState(axis);
  // What was faster than any limit, as after a jump of set values, is not taken away slowly.
  if (!(exact::fabs(start.acceleration) <= deceleration * (1.0 + 1e-9)))
    start.acceleration = 0.0;
  motion::Profile profile;
  if (motion::planStop(profile, start,
                       {ramp, deceleration, deceleration, deceleration, brakingJerk(axis)}) !=
      motion::PlanError::None)
    return false;
  auto &plan = axis.stPlanner;
  motion::loadPlan(plan, profile, axis.fTaskCycle);
  plan.fTarget = shownPosition(axis, plan.fEnd);
  return true;
}

/// Plans the way to rest from the present set values. Without a deceleration, or without a
/// velocity, the axis stands at once.
void planBraking(AxisRef &axis, double deceleration, Braking braking) noexcept {
  auto &plan = axis.stPlanner;
  plan.bActive = 0;
  const double velocity = axis.fSetVelocity;
  if (!(deceleration > 0.0) || velocity == 0.0 || !exact::isfinite(velocity)) {
    writeMotion(axis, 0.0, 0.0);
    return;
  }
  if (braking == Braking::Hard || !planGently(axis, deceleration)) {
    const double duration = exact::fabs(velocity) / deceleration;
    const double target = axis.fSetPosition + 0.5 * velocity * duration;
    beginPlan(plan, axis.fTaskCycle, duration, target, 0.0);
    plan.fTarget = shownPosition(axis, target);
    appendSegment(plan, 0.0, duration, {target, 0.0, velocity > 0.0 ? -deceleration : deceleration},
                  0.0, 0.0);
  }
  plan.fDeceleration = deceleration;
}

/// The larger one of the axis's own deceleration and that of the command in progress; 0 for none.
double brakingDeceleration(const AxisRef &axis) noexcept {
  const double own = exact::isPositive(axis.fSWMaxDeceleration) ? axis.fSWMaxDeceleration : 0.0;
  const double commanded = axis.stPlanner.fDeceleration;
  return exact::isPositive(commanded) ? exact::larger(own, commanded) : own;
}

double positiveOr0(double value) noexcept { return exact::isPositive(value) ? value : 0.0; }

/// What an error stop brakes with: at least what SMC_SetSoftwareLimits has set. [u/s^2]
double errorDeceleration(const AxisRef &axis) noexcept {
  const double least =
      exact::larger(brakingDeceleration(axis), positiveOr0(axis.fSWLimitDeceleration));
  if (!exact::isPositive(axis.fSWLimitDistance))
    return least;
  const double velocity = axis.fSetVelocity;
  return exact::larger(least, positiveOr0(0.5 * velocity * (velocity / axis.fSWLimitDistance)));
}

/// Whether what moves the axis is a velocity and nothing else, so that it goes on while only
/// velocities are regulated.
bool movesByVelocity(const AxisRef &axis) noexcept {
  const bool byPlan = axis.nAxisState == state::kContinuous ||
                      axis.nAxisState == state::kDiscrete || axis.nAxisState == state::kStopping ||
                      axis.nAxisState == state::kErrorStop;
  return byPlan && axis.stPlanner.bActive != 0 && axis.stPlanner.bToGoal == 0 &&
         axis.stSuperimposed.ulOwner == 0;
}

/// Nobody moves the axis any more; the state is left to the caller.
void takeAway(AxisRef &axis, int16_t reason) noexcept {
  if (axis.iOwner != 0)
    axis.stPlanner.wStopReason = static_cast<uint16_t>(reason);
  releaseAxis(axis);
  axis.stQueue.uiCount = 0;
  endSuperimposed(axis);
}

void superviseOwner(AxisRef &axis) noexcept {
  // Whoever moves an axis does it in every cycle.
  if (axis.stSuperimposed.ulOwner != 0 && axis.stSuperimposed.bMovedInThisCycle == 0) {
    enterErrorStop(axis, error::kNotCalled);
  } else if (axis.bMovedInThisCycle == 0) {
    // An owner that has failed said why.
    const auto reason = static_cast<int16_t>(axis.stPlanner.wStopReason);
    if (axis.iOwner != 0 && isMotion(axis.nAxisState))
      enterErrorStop(axis, reason != error::kNone ? reason : error::kNotCalled);
    else if (axis.nAxisState == state::kStopping && axis.stPlanner.bActive != 0)
      enterErrorStop(axis, error::kStopBlocks);
  }
}

/// An error stop that reaches a limit has no way left for its ramp.
void brakeHard(AxisRef &axis) noexcept {
  const auto &plan = axis.stPlanner;
  if (plan.bActive != 0 && exact::fabs(axis.fSetAcceleration) < plan.fDeceleration * (1.0 - 1e-9))
    planBraking(axis, plan.fDeceleration, Braking::Hard);
}

/// Which way the axis goes in this cycle; 0 for none.
double headingOf(const AxisRef &axis) noexcept {
  if (regulated(axis) == Regulated::Force)
    return axis.fActVelocity; // a torque takes it there
  if (axis.bMovedInThisCycle != 0)
    return axis.fSetPosition - axis.fSavePosition;
  return axis.fSetVelocity; // what nobody owns is moved on later
}

void superviseLimits(AxisRef &axis) noexcept {
  if (!isAtLimit(axis))
    return;
  const bool above = axis.fSetPosition > axis.fSWLimitPositive;
  const bool below = axis.fSetPosition < axis.fSWLimitNegative;
  const double heading = headingOf(axis);
  const bool outward =
      axis.bSWEndSwitchActive != 0 && ((above && heading > 0.0) || (below && heading < 0.0));
  const bool watched = axis.bHWLimitEnable != 0 && axis.bHWLimitIgnored == 0;
  if (axis.nAxisState == state::kErrorStop) {
    if (outward || (watched && ((axis.bLimitSwitchPositive != 0 && heading > 0.0) ||
                                (axis.bLimitSwitchNegative != 0 && heading < 0.0))))
      brakeHard(axis);
    return;
  }
  if (watched && (axis.bLimitSwitchPositive != 0 || axis.bLimitSwitchNegative != 0))
    enterErrorStop(axis, error::kHwLimits);
  // Before homing is over the software limits mean nothing.
  else if (outward && axis.nAxisState != state::kHoming)
    enterErrorStop(axis, error::kSwLimits);
}

/// What nobody owns and moves is on its way to rest.
void brakeOn(AxisRef &axis) noexcept {
  const bool stops = axis.nAxisState == state::kErrorStop;
  const bool brakes = axis.nAxisState == state::kDiscrete && axis.iOwner == 0;
  if (!stops && !brakes)
    return;
  if (axis.stPlanner.bActive != 0 && axis.bMovedInThisCycle == 0)
    (void)stepPlan(axis);
  if (brakes && axis.stPlanner.bActive == 0)
    axis.nAxisState = state::kStandstill;
}

} // namespace

void haltAt(AxisRef &axis) noexcept {
  writeMotion(axis, 0.0, 0.0);
  axis.stPlanner.bActive = 0;
}

void leaveUnpowered(AxisRef &axis) noexcept {
  takeAway(axis, error::kNotPowered);
  haltAt(axis);
  followActual(axis);
  if (axis.nAxisState != state::kErrorStop)
    axis.nAxisState = state::kPowerOff;
}

void enterErrorStop(AxisRef &axis, int16_t reason) noexcept {
  axis.iOwner = 0;
  axis.stQueue.uiCount = 0;
  endSuperimposed(axis);
  axis.nAxisState = state::kErrorStop;
  axis.wFBErrorID = static_cast<uint16_t>(reason);
  if (axis.stPlanner.wStopReason != static_cast<uint16_t>(reason)) // else its owner has noted it
    listError(axis, reason);
  axis.stPlanner.wStopReason = static_cast<uint16_t>(reason);
  // Within a given way there is no room for a jerk.
  const bool hard = reason == error::kHwLimits || reason == error::kSwLimits ||
                    exact::isPositive(axis.fSWLimitDistance);
  planBraking(axis, errorDeceleration(axis), hard ? Braking::Hard : Braking::Gentle);
}

void acknowledge(AxisRef &axis) noexcept {
  if (axis.nAxisState != state::kErrorStop || axis.bErrorAckn == 0 || axis.bCommunication == 0 ||
      axis.bError != 0 || axis.fSetVelocity != 0.0)
    return;
  axis.bErrorAckn = 0;
  axis.wFBErrorID = 0;
  axis.stPlanner.wStopReason = 0;
  axis.nAxisState = state::kPowerOff;
}

void changeRegulated(AxisRef &axis, Regulated before) noexcept {
  const Regulated now = regulated(axis);
  if (now == before || axis.nAxisState == state::kPowerOff)
    return;
  const bool byForce = now == Regulated::Force || before == Regulated::Force;
  if (!byForce && movesByVelocity(axis)) {
    if (now == Regulated::Velocity)
      axis.stQueue.uiCount = 0; // what waits leads to a place
    return;
  }
  const bool holds = axis.nAxisState == state::kStopping && axis.stPlanner.bActive == 0;
  if (axis.nAxisState != state::kErrorStop && !holds) {
    takeAway(axis, error::kWrongMode);
    axis.nAxisState = state::kStandstill;
  }
  if (now == Regulated::Force) {
    haltAt(axis);
    return;
  }
  if (before == Regulated::Force)
    writeMotion(axis, axis.fActVelocity, 0.0);
  const double deceleration = brakingDeceleration(axis);
  if (exact::fabs(axis.fSetVelocity) <= deceleration * axis.fTaskCycle)
    haltAt(axis);
  else
    planBraking(axis, deceleration, Braking::Gentle);
  if (axis.stPlanner.bActive != 0 && axis.nAxisState == state::kStandstill)
    axis.nAxisState = state::kDiscrete;
}

void brakeWithDrive(AxisRef &axis) noexcept {
  followActual(axis);
  if (axis.nAxisState == state::kStandstill) {
    writeMotion(axis, 0.0, 0.0);
    return;
  }
  writeMotion(axis, axis.fActVelocity, 0.0);
  auto &plan = axis.stPlanner;
  const double deceleration = brakingDeceleration(axis);
  if (exact::fabs(axis.fSetVelocity) > 2.0 * deceleration * axis.fTaskCycle) {
    planBraking(axis, deceleration, Braking::Gentle);
    if (plan.bActive != 0)
      return;
  }
  // It is over one cycle after the drive says that it is at rest.
  writeMotion(axis, 0.0, 0.0);
  beginPlan(plan, axis.fTaskCycle, 2.0 * axis.fTaskCycle, axis.fSetPosition, 0.0);
  appendSegment(plan, 0.0, 0.0, setState(axis), 0.0, 0.0);
}

void superviseThoroughly(AxisRef &axis) noexcept {
  if (!isPowered(axis)) {
    leaveUnpowered(axis);
    return;
  }
  superviseOwner(axis);
  if (axis.iMovementType != 0)
    superviseLimits(axis);
  brakeOn(axis);
  if (axis.nAxisState != state::kErrorStop)
    return;
  axis.fSetTorque = 0.0; // no set position brakes a drive that regulates a torque
  axis.fSetCurrent = 0.0;
}

double wayOfLag(const AxisRef &axis, double velocity) noexcept {
  return positiveOr0(axis.fSetActTimeLagCycles) * axis.fTaskCycle * velocity;
}

double settleOnActual(AxisRef &axis) noexcept {
  const double way = wayOfCycle(axis) + wayOfLag(axis, axis.fSetVelocity);
  const double position = shownPosition(axis, axis.fSavePosition + way);
  if (axis.stPlanner.bActive != 0)
    shiftPlan(axis, position - axis.fSetPosition);
  axis.fSetPosition = position;
  return way;
}

} // namespace stride::axis
