// Motion with limited velocity, acceleration and jerk: the parabolic ramp type, whose velocity
// consists of parabolas and straight lines.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_HPP

#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion {

/// Limits of a motion, all greater than zero. `acceleration` holds while the magnitude of the
/// velocity rises, `deceleration` while it falls.
struct JerkLimits {
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
  double jerk;         ///< [u/s^3]
};

/// Plans the motion from `start` (velocity and acceleration of any size and sign) to `target`,
/// where it arrives with `endVelocity` and without acceleration. The profile ends exactly there,
/// bit for bit. An end velocity above the limit exceeds it only in the final run-up.
///
/// It is the fastest one, where the state at the start can keep the limits. What is beyond a limit
/// there returns to it with the jerk (an acceleration) or the deceleration (a velocity).
PlanError planParabolic(Profile &profile, const State &start, double target, double endVelocity,
                        const JerkLimits &limits) noexcept;

/// Plans the change from `start` to the constant `velocity` without acceleration, which the profile
/// has from its end on. `limits.velocity` does not matter.
PlanError planParabolicVelocity(Profile &profile, const State &start, double velocity,
                                const JerkLimits &limits) noexcept;

/// Plans the stop from `start` with `deceleration` [u/s^2] and `jerk` [u/s^3].
PlanError planParabolicStop(Profile &profile, const State &start, double deceleration,
                            double jerk) noexcept;

/// See reachableEndVelocity; the arguments are valid.
double reachableByParabola(const State &start, double target, double wanted,
                           const JerkLimits &limits) noexcept;

} // namespace stride::motion

#endif
