#include "runtime/axis/forecast.hpp"

#include "runtime/axis/command.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/iec/math.h"

namespace stride::motion {
namespace {

constexpr double kSlack = 1e-9; ///< Of a cycle: so much earlier or later is the same time.

/// Whether only blocks know what the axis does next.
bool isForeign(const axis::AxisRef &axis) noexcept {
  if (axis.stPlanner.bActive == 0 && axis.stQueue.uiCount > 0)
    return true; // the block of the next command begins it at its next call
  switch (axis.nAxisState) {
  case axis::state::kSynchronized:
  case axis::state::kHoming:
    return true;
  case axis::state::kDiscrete:
  case axis::state::kContinuous:
    return axis.stPlanner.bActive == 0;
  default:
    return axis.stPlanner.bActive == 0 && axis.fSetVelocity != 0.0;
  }
}

/// The nearest of the positions that a rotary axis shows as `shown`.
double nearest(const axis::AxisRef &axis, double shown, double position) noexcept {
  if (!axis::isRotary(axis))
    return shown;
  const double period = axis.fPositionPeriod;
  return shown + period * exact::floor((position - shown) / period + 0.5);
}

/// Between two states, `part` of the time `length` on: the cubic that has both.
State between(const State &from, const State &to, double length, double part) noexcept {
  const double way = to.position - from.position;
  const double t = part * length;
  const double a = (3.0 * way / length - 2.0 * from.velocity - to.velocity) / length;
  const double b = (from.velocity + to.velocity - 2.0 * way / length) / (length * length);
  return {from.position + t * (from.velocity + t * (a + t * b)),
          from.velocity + t * (2.0 * a + 3.0 * b * t), 2.0 * a + 6.0 * b * t};
}

} // namespace

Forecast::Forecast(const axis::AxisRef &axis) noexcept
    : axis_(axis), start_{axis.fSavePosition, axis.fSaveVelocity, axis.fSaveAcceleration},
      planned_(axis.stSuperimposed.ulOwner == 0 && !isForeign(axis)),
      atRest_(axis.stPlanner.bActive == 0), moved_(axis.bMovedInThisCycle != 0),
      base_(moved_ ? axis.fTaskCycle : 0.0), shift_(0.0) {
  axis_.stPlanner.uiSegment = 0; // it may be asked for times before the present one
  if (axis_.stPlanner.bActive == 0)
    return;
  auto plan = axis_.stPlanner;
  const double place =
      axis::planState(plan, axis::planTime(plan)).position + axis_.stSuperimposed.fPosition;
  if (axis::isRotary(axis_))
    shift_ = nearest(axis_, axis_.fSetPosition, start_.position) - place;
}

/// Whether, before `t`, the command that waits next follows the motion in progress; it does so
/// then.
bool Forecast::followOn(double t) noexcept {
  auto &plan = axis_.stPlanner;
  if (axis_.stQueue.uiCount == 0 || plan.bActive == 0 || plan.bHeld != 0)
    return false;
  const double now = axis::planTime(plan);
  if (!axis::isPlanOver(plan, now + (t - base_)) && plan.bReached == 0)
    return false;
  // On to the cycle before the one in which it happens, and one step further.
  const double left = (plan.fDuration - now) / plan.fCycle;
  const double cycles = left > 1.0 ? exact::ceil(left - kSlack) - 1.0 : 0.0;
  if (base_ + (cycles + 1.0) * plan.fCycle > t + plan.fCycle)
    return false;
  const State end = axis::planState(plan, now + (left > 0.0 ? left * plan.fCycle : 0.0));
  const double place = end.position + axis_.stSuperimposed.fPosition + shift_;
  if (cycles > 0.0) {
    plan.ulCycle += static_cast<uint64_t>(cycles) - 1;
    (void)axis::stepPlan(axis_); // a command may ask for the direction of the last motion
  }
  axis_.bMovedInThisCycle = 0;
  const double cycle = plan.fCycle;
  base_ += (cycles + 1.0) * cycle;
  if (!advance(axis_))
    return false;
  if (isForeign(axis_)) { // a block that computes its set values by itself
    planned_ = false;
    return false;
  }
  // The new plan starts where the old one ended.
  auto begun = plan;
  begun.uiSegment = 0;
  shift_ = axis::isRotary(axis_) ? place - axis::planState(begun, 0.0).position : 0.0;
  plan.uiSegment = 0;
  return true;
}

State Forecast::planned(double t, double &jerk) noexcept {
  auto &plan = axis_.stPlanner;
  const auto &added = axis_.stSuperimposed;
  const double time = axis::planTime(plan) + (t - base_);
  State state = axis::planState(plan, time);
  const bool over = axis::isPlanOver(plan, time);
  jerk = 0.0;
  if (!over && plan.uiSegmentCount > 0) {
    const auto &segment = plan.aSegment.v[plan.uiSegment];
    jerk = segment.fJerk;
    if (segment.fFrequency > 0.0)
      jerk *= ::stride::cos(segment.fFrequency * (time - segment.fReference));
  }
  state.position += added.fPosition + shift_;
  state.velocity += added.fVelocity;
  state.acceleration += added.fAcceleration;
  return state;
}

bool Forecast::at(double t, State &state, double &jerk) noexcept {
  const double cycle = axis_.fTaskCycle;
  jerk = 0.0;
  if (t <= 0.0) {
    state = start_;
    return true;
  }
  if (moved_ && t <= cycle * (1.0 + kSlack)) {
    // How the plan was before this cycle is not known any more if another one has begun in it.
    const auto &plan = axis_.stPlanner;
    const bool within = planned_ && plan.bActive != 0 && axis::planTime(plan) >= cycle - t;
    if (!within || t >= cycle * (1.0 - kSlack)) {
      const State now{nearest(axis_, axis_.fSetPosition, start_.position), axis_.fSetVelocity,
                      axis_.fSetAcceleration};
      state = t >= cycle * (1.0 - kSlack) ? now : between(start_, now, cycle, t / cycle);
      if (within)
        (void)this->planned(t, jerk);
      return true;
    }
    state = this->planned(t, jerk);
    return true;
  }
  if (!planned_)
    return false;
  if (atRest_) {
    state = {nearest(axis_, axis_.fSetPosition, start_.position), 0.0, 0.0};
    return true;
  }
  while (followOn(t)) {
  }
  if (!planned_)
    return false;
  // A command that was over in the cycle in which it began: when the next one begins, depends on
  // which block is called first.
  if (axis_.stPlanner.bActive == 0 && axis_.stQueue.uiCount > 0) {
    planned_ = false;
    return false;
  }
  state = this->planned(t, jerk);
  return true;
}

} // namespace stride::motion
