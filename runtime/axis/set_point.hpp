// The axis's planned motion and how its set values are produced from it.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_SET_POINT_HPP
#define STRIDE_RUNTIME_AXIS_SET_POINT_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/axis/exact_math.hpp"
#include "runtime/axis/modulo_wrap.hpp"
#include "runtime/axis/motion_state.hpp"

namespace stride::axis {

/// Writes velocity and acceleration and what follows from them, except the position.
inline void writeMotion(AxisRef &axis, double velocity, double acceleration) noexcept {
  axis.fSetVelocity = velocity + 0.0; // never -0
  axis.fSetAcceleration = acceleration + 0.0;
  const double power = velocity * acceleration;
  axis.fSetDeceleration = power < 0.0 ? exact::fabs(acceleration) : 0.0;
  axis.bConstantVelocity = velocity != 0.0 && acceleration == 0.0;
  axis.bAccelerating = power > 0.0 || (velocity == 0.0 && acceleration != 0.0);
  axis.bDecelerating = power < 0.0;
  if (velocity > 0.0)
    axis.nDirection = ::st::SM_DriveBasic::MC_Direction__positive;
  else if (velocity < 0.0)
    axis.nDirection = ::st::SM_DriveBasic::MC_Direction__negative;
}

/// Writes this cycle's set values; the position may be any number of turns.
inline void writeSetPoint(AxisRef &axis, const MotionState &state) noexcept {
  axis.fSetPosition =
      isRotary(axis) ? wrapPosition(state.position, axis.fPositionPeriod) : state.position;
  writeMotion(axis, state.velocity, state.acceleration);
  axis.bMovedInThisCycle = 1;
}

/// Starts an empty plan with the axis's cycle time; segments are appended by the caller.
inline void beginPlan(AxisRef &axis, double duration, double target, double deceleration) noexcept {
  auto &plan = axis.stPlanner;
  plan.bActive = 1;
  plan.uiSegmentCount = 0;
  plan.uiSegment = 0;
  plan.ulCycle = 0;
  plan.fCycle = axis.fTaskCycle;
  plan.fDuration = duration;
  plan.fTarget = isRotary(axis) ? wrapPosition(target, axis.fPositionPeriod) : target;
  plan.fEndVelocity = 0.0;
  plan.fDeceleration = deceleration;
}

/// Appends a segment to the plan.
inline void appendSegment(AxisRef &axis, double start, double reference, const MotionState &origin,
                          double jerk) noexcept {
  auto &plan = axis.stPlanner;
  auto &segment = plan.aSegment.v[plan.uiSegmentCount++];
  segment.fStart = start;
  segment.fReference = reference;
  segment.fPosition = origin.position;
  segment.fVelocity = origin.velocity;
  segment.fAcceleration = origin.acceleration;
  segment.fJerk = jerk;
}

/// Moves the plan on by one cycle and writes the set values. Returns true when the end is reached:
/// then the plan is over and the position is the target, bit for bit.
inline bool stepPlan(AxisRef &axis) noexcept {
  auto &plan = axis.stPlanner;
  ++plan.ulCycle;
  const double t = static_cast<double>(plan.ulCycle) * plan.fCycle;
  // A move that ends with a cycle must not need one more because of the last digit of a product.
  const double slack = 1e-9 * plan.fCycle;
  if (!(t + slack < plan.fDuration)) {
    axis.fSetPosition = plan.fTarget;
    writeMotion(axis, 0.0, 0.0);
    axis.bMovedInThisCycle = 1;
    plan.bActive = 0;
    return true;
  }
  while (plan.uiSegment + 1 < plan.uiSegmentCount &&
         t >= plan.aSegment.v[plan.uiSegment + 1].fStart)
    ++plan.uiSegment;
  const auto &segment = plan.aSegment.v[plan.uiSegment];
  const MotionState origin{segment.fPosition, segment.fVelocity, segment.fAcceleration};
  writeSetPoint(axis, evaluateCubic(origin, segment.fJerk, t - segment.fReference));
  return false;
}

} // namespace stride::axis

#endif
