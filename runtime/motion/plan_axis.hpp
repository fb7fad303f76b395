// Brings a profile into an axis: from the numeric core to AXIS_REF.
#ifndef STRIDE_RUNTIME_MOTION_PLAN_AXIS_HPP
#define STRIDE_RUNTIME_MOTION_PLAN_AXIS_HPP

#include "runtime/axis/set_point.hpp"
#include "runtime/motion/profile.hpp"

namespace stride::motion {

/// Makes `profile` the axis's motion. It starts at the axis's present set values: from the cycle's
/// start if nobody has moved the axis in this cycle, else from this cycle's set values, which then
/// stay. `target` is the commanded position, within the period on a rotary axis.
inline void beginProfile(axis::AxisRef &axis, const Profile &profile, double target,
                         double deceleration) noexcept {
  static_assert(Profile::kMaxSegments ==
                decltype(axis.stPlanner.aSegment)::kSize); // SMC_PLANNER_STATE.aSegment
  axis::beginPlan(axis, profile.duration, target, deceleration);
  for (int32_t i = 0; i < profile.count; ++i) {
    const Segment &segment = profile.segments[i];
    axis::appendSegment(axis, segment.start, segment.reference, segment.origin, segment.jerk);
  }
  axis.fAimPosition = axis.stPlanner.fTarget;
}

} // namespace stride::motion

#endif
