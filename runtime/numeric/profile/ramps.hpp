// Motion made of ramps between constant velocities: the ramp types trapezoid and sigmoid.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_RAMPS_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_RAMPS_HPP

#include "runtime/numeric/profile/planner.hpp"

namespace stride::motion {

/// planMove for the ramp types Trapezoid, Sigmoid and SigmoidLimited: first the acceleration of the
/// start is taken away with the jerk (not for Trapezoid), then the fastest motion that consists of
/// a ramp (two through standstill), a constant velocity and another ramp.
PlanError planRampMove(Profile &profile, const State &start, double target, double endVelocity,
                       const Dynamics &dynamics) noexcept;

/// planVelocity for these ramp types.
PlanError planRampVelocity(Profile &profile, const State &start, double velocity,
                           const Dynamics &dynamics) noexcept;

/// reachableEndVelocity for these ramp types; the arguments are valid.
double reachableByRamp(const State &start, double target, double wanted,
                       const Dynamics &dynamics) noexcept;

} // namespace stride::motion

#endif
