// Between the numeric core and an axis: its limits, and how it takes a profile.
#ifndef STRIDE_RUNTIME_AXIS_PLAN_AXIS_HPP
#define STRIDE_RUNTIME_AXIS_PLAN_AXIS_HPP

#include "runtime/axis/set_point.hpp"
#include "runtime/numeric/profile/planner.hpp"

namespace stride::motion {

/// The limits that a block has read from its inputs.
struct BlockLimits {
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
  double jerk;         ///< 0 stands for the axis's own. [u/s^3]
};

/// The limits under the axis's ramp type, without its overrides.
inline Dynamics plainDynamics(const axis::AxisRef &axis, const BlockLimits &limits) noexcept {
  return {static_cast<RampType>(axis.eRampType), limits.velocity, limits.acceleration,
          limits.deceleration, limits.jerk > 0.0 ? limits.jerk : axis.fJerk};
}

/// The limits under the axis's ramp type and overrides (MC_SetOverride).
inline Dynamics dynamicsOf(const axis::AxisRef &axis, const BlockLimits &limits) noexcept {
  Dynamics dynamics = plainDynamics(axis, limits);
  dynamics.velocity *= axis.fVelocityFactor;
  dynamics.acceleration *= axis.fAccelerationFactor;
  dynamics.deceleration *= axis.fAccelerationFactor;
  dynamics.jerk *= axis.fJerkFactor;
  return dynamics;
}

/// Puts a profile into a plan that is followed with the cycle time `cycle`. [s] It begins at the
/// set values that the axis has when this is called; the first step leads one cycle on.
inline void loadPlan(axis::PlannerState &plan, const Profile &profile, double cycle) noexcept {
  axis::beginPlan(plan, cycle, profile.duration, profile.end.position, profile.end.velocity);
  static_assert(Profile::kMaxSegments == decltype(plan.aSegment)::kSize);
  for (int32_t i = 0; i < profile.count; ++i) {
    const Segment &segment = profile.segments[i];
    axis::appendSegment(plan, segment.start, segment.reference, segment.origin, segment.jerk,
                        segment.frequency);
  }
}

} // namespace stride::motion

#endif
