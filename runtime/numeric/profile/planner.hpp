// The one interface to all planners: what motion blocks use.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PLANNER_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PLANNER_HPP

#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion {

/// The shape of velocity ramps; the values are those of SMC_RAMPTYPE.
enum class RampType : int8_t {
  Trapezoid = 0,      ///< Constant acceleration in each ramp; jumps of it are allowed.
  Sigmoid = 1,        ///< sin^2 in the trapezoid's time: the acceleration peaks at pi/2 its limit.
  Parabolic = 2,      ///< Limited jerk.
  SigmoidLimited = 3, ///< sin^2, slow enough for the limits of acceleration and jerk.
};

/// The ramp type and the limits of a motion, all greater than zero. `acceleration` holds while the
/// magnitude of the velocity rises, `deceleration` while it falls. Trapezoid does without `jerk`;
/// Sigmoid uses it only to take away an acceleration that the axis has at the start.
struct Dynamics {
  RampType ramp;
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
  double jerk;         ///< [u/s^3]
};

/// Plans the motion from `start` (of any velocity and acceleration) to `target`, where it arrives
/// with `endVelocity` and without acceleration: exactly, bit for bit. A target that cannot be
/// reached so is overshot, and reached by coming back. What is beyond a limit at the start returns
/// to it steadily. An end velocity above the limit exceeds it only in the final run-up. Trapezoid
/// ignores the acceleration of the start.
PlanError planMove(Profile &profile, const State &start, double target, double endVelocity,
                   const Dynamics &dynamics) noexcept;

/// Plans the change to the constant `velocity`, which the profile has from its end on.
/// `dynamics.velocity` does not matter.
PlanError planVelocity(Profile &profile, const State &start, double velocity,
                       const Dynamics &dynamics) noexcept;

/// Plans the stop. Only the deceleration and the jerk matter.
PlanError planStop(Profile &profile, const State &start, const Dynamics &dynamics) noexcept;

/// For blending: the velocity nearest to `wanted`, of its sign and at most its magnitude, with
/// which planMove can pass `target` without a reversal that it could do without. 0 if `wanted`
/// points away from the motion to the target, or an argument is not valid.
double reachableEndVelocity(const State &start, double target, double wanted,
                            const Dynamics &dynamics) noexcept;

} // namespace stride::motion

#endif
