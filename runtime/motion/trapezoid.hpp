// Time-optimal motion with limited velocity and acceleration: the trapezoid ramp type.
#ifndef STRIDE_RUNTIME_MOTION_TRAPEZOID_HPP
#define STRIDE_RUNTIME_MOTION_TRAPEZOID_HPP

#include "runtime/motion/profile.hpp"

namespace stride::motion {

/// Limits of a motion, all greater than zero. `acceleration` holds while the magnitude of the
/// velocity rises, `deceleration` while it falls.
struct TrapezoidLimits {
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
};

/// Plans the fastest motion from `position` and `velocity` (of any size and sign) to rest at
/// `target`. A velocity above the limit falls to it with the deceleration; a target that cannot be
/// reached without overshoot is reached by stopping first and then coming back. The profile ends
/// exactly at `target`, bit for bit, with velocity 0.
PlanError planTrapezoid(Profile &profile, double position, double velocity, double target,
                        const TrapezoidLimits &limits) noexcept;

/// Plans the stop from `position` and `velocity` with `deceleration` [u/s^2].
PlanError planStop(Profile &profile, double position, double velocity,
                   double deceleration) noexcept;

} // namespace stride::motion

#endif
