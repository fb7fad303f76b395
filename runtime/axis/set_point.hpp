// The axis's planned motion and how its set values are produced from it.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_SET_POINT_HPP
#define STRIDE_RUNTIME_AXIS_SET_POINT_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/modulo_wrap.hpp"
#include "runtime/numeric/motion_state.hpp"

namespace stride::axis {

using PlannerState = ::st::SM_DriveBasic::SMC_PLANNER_STATE;

/// Writes velocity and acceleration and what follows from them, except the position.
inline void writeMotion(AxisRef &axis, double velocity, double acceleration) noexcept {
  axis.fSetVelocity = velocity + 0.0; // never -0
  axis.fSetAcceleration = acceleration + 0.0;
  const double power = velocity * acceleration;
  axis.fSetDeceleration = power < 0.0 ? exact::fabs(acceleration) : 0.0;
  // Without branches, which axes that move differently would let the processor guess wrong.
  const bool stands = exact::isZero(velocity);
  const bool steady = exact::isZero(acceleration);
  axis.bConstantVelocity = static_cast<uint8_t>(!stands & steady);
  axis.bAccelerating = static_cast<uint8_t>((power > 0.0) | (stands & !steady));
  axis.bDecelerating = power < 0.0;
  const int direction = static_cast<int>(velocity > 0.0) - static_cast<int>(velocity < 0.0);
  axis.nDirection = direction != 0 ? static_cast<int16_t>(direction) : axis.nDirection;
}
static_assert(::st::SM_DriveBasic::MC_Direction__positive == 1 &&
              ::st::SM_DriveBasic::MC_Direction__negative == -1);

/// `position` as the axis shows it: within the period on a rotary axis.
inline double shownPosition(const AxisRef &axis, double position) noexcept {
  return isRotary(axis) ? numeric::wrapPosition(position, axis.fPositionPeriod) : position;
}

/// Writes this cycle's set values; the position may be any number of turns. What a superimposed
/// motion has added comes on top.
inline void writeSetPoint(AxisRef &axis, const numeric::MotionState &state) noexcept {
  const auto &added = axis.stSuperimposed;
  axis.fSetPosition = shownPosition(axis, state.position + added.fPosition);
  writeMotion(axis, state.velocity + added.fVelocity, state.acceleration + added.fAcceleration);
  axis.bMovedInThisCycle = 1;
}

/// The present set values. [u] within the period on a rotary axis.
inline numeric::MotionState setState(const AxisRef &axis) noexcept {
  return {axis.fSetPosition, axis.fSetVelocity, axis.fSetAcceleration};
}

/// Ends a superimposed motion; what it has added is not added any more.
inline void endSuperimposed(AxisRef &axis) noexcept { axis.stSuperimposed = {}; }

/// Starts an empty plan with the cycle time `cycle` [s]; segments are appended by the caller. They
/// last `duration` [s] and end at `end` with `endVelocity`.
inline void beginPlan(PlannerState &plan, double cycle, double duration, double end,
                      double endVelocity) noexcept {
  plan.bActive = 1;
  plan.bReached = 0;
  plan.bHeld = 0;
  plan.bToGoal = 0;
  plan.uiSegmentCount = 0;
  plan.uiSegment = 0;
  plan.ulCycle = 0;
  plan.fCycle = cycle;
  plan.fShift = 0.0;
  plan.fDuration = duration;
  plan.fEnd = end;
  plan.fGoal = end;
  plan.fTarget = end;
  plan.fEndVelocity = endVelocity;
}

/// Appends a segment to the plan; see SMC_PROFILE_SEGMENT.
inline void appendSegment(PlannerState &plan, double start, double reference,
                          const numeric::MotionState &origin, double jerk,
                          double frequency) noexcept {
  auto &segment = plan.aSegment.v[plan.uiSegmentCount++];
  segment.fStart = start;
  segment.fReference = reference;
  segment.fPosition = origin.position;
  segment.fVelocity = origin.velocity;
  segment.fAcceleration = origin.acceleration;
  segment.fJerk = jerk;
  segment.fFrequency = frequency;
}

/// The time into the plan at a cycle of it. [s]
inline double planTime(const PlannerState &plan, uint64_t cycle) noexcept {
  // Signed: there is no instruction for the other conversion.
  return plan.fShift + static_cast<double>(static_cast<int64_t>(cycle)) * plan.fCycle;
}

/// The time into the plan at its present cycle. [s]
inline double planTime(const PlannerState &plan) noexcept { return planTime(plan, plan.ulCycle); }

/// Whether the plan is at its end at time `t`. A move that ends with a cycle must not need one more
/// because of the last digit of a product.
inline bool isPlanOver(const PlannerState &plan, double t) noexcept {
  return !(t + 1e-9 * plan.fCycle < plan.fDuration);
}

/// The state at time `t` before the end, which must not go back from call to call.
inline numeric::MotionState pieceState(PlannerState &plan, double t) noexcept {
  const auto *segment = &plan.aSegment.v[plan.uiSegment];
  for (; plan.uiSegment + 1 < plan.uiSegmentCount && t >= segment[1].fStart; ++segment)
    ++plan.uiSegment;
  const numeric::MotionState origin{segment->fPosition, segment->fVelocity, segment->fAcceleration};
  return numeric::evaluatePiece(origin, segment->fJerk, segment->fFrequency,
                                t - segment->fReference);
}

/// The state at time `t` at or after the end: on with the end velocity.
inline numeric::MotionState stateAfterEnd(const PlannerState &plan, double t) noexcept {
  if (plan.fEndVelocity == 0.0)
    return {plan.fEnd, 0.0, 0.0};
  return {plan.fEnd + plan.fEndVelocity * (t - plan.fDuration), plan.fEndVelocity, 0.0};
}

/// The state at time `t`, which must not go back from call to call. The position is on the scale of
/// the segments.
inline numeric::MotionState planState(PlannerState &plan, double t) noexcept {
  return isPlanOver(plan, t) ? stateAfterEnd(plan, t) : pieceState(plan, t);
}

/// stepPlan at time `t` at or after the end. A function of its own, so that what is done in every
/// cycle can be part of its callers.
[[gnu::noinline]] inline bool stepBeyondEnd(AxisRef &axis, double t) noexcept {
  auto &plan = axis.stPlanner;
  numeric::MotionState state = stateAfterEnd(plan, t);
  if (plan.fEndVelocity == 0.0 && plan.bHeld == 0) {
    state.position = plan.fTarget;
    plan.bActive = 0;
  }
  writeSetPoint(axis, state);
  if (plan.bReached != 0 || plan.bHeld != 0)
    return false;
  plan.bReached = 1;
  return true;
}

/// Moves the axis's plan on by one cycle and writes the set values. Returns true in the cycle in
/// which the end is reached: without an end velocity the plan is over then, and the position is the
/// target, bit for bit; with one, the axis goes on.
inline bool stepPlan(AxisRef &axis) noexcept {
  auto &plan = axis.stPlanner;
  ++plan.ulCycle;
  const double t = planTime(plan);
  if (isPlanOver(plan, t))
    return stepBeyondEnd(axis, t);
  writeSetPoint(axis, pieceState(plan, t));
  return false;
}

} // namespace stride::axis

#endif
