// Courses through points in time: what MC_PositionProfile, MC_VelocityProfile and
// MC_AccelerationProfile follow. Closed forms, no allocation.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_TIME_PROFILE_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_TIME_PROFILE_HPP

#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion {

/// A point of a course: `step` [s] after the one before (or the start), with the value.
struct TimePoint {
  double step;
  double value; ///< Position [u], velocity [u/s] or acceleration [u/s^2].
};

/// One piece of a course: constant jerk from `start` [s] on, where the state is `origin`.
struct TimePiece {
  double start;
  State origin;
  double jerk; ///< [u/s^3]
};

/// A course as a value.
struct TimeProfile {
  static constexpr int32_t kMaxPoints = 100;
  static constexpr int32_t kMaxPieces = 2 * kMaxPoints;

  TimePiece pieces[kMaxPieces];
  int32_t count;
  double duration; ///< [s]
  State end;       ///< The state at `duration`; its acceleration is that before the end.

  /// The state at time `t`; beyond the end on with the end velocity.
  [[nodiscard]] State at(double t) const noexcept;
};

/// Through positions, twice continuously differentiable: cubic pieces from point to point, the
/// first of them in two, so that the course goes on from position, velocity and acceleration of
/// `start`. The last piece has no jerk. `count` is 1 to kMaxPoints, every step greater than 0.
PlanError planPositions(TimeProfile &profile, const State &start, const TimePoint *points,
                        int32_t count) noexcept;

/// Through velocities, the velocity continuously differentiable: two parabolas from point to point.
/// After the first point the velocity never leaves the range between two points. It starts with
/// the acceleration of `start`; the position is the integral.
PlanError planVelocities(TimeProfile &profile, const State &start, const TimePoint *points,
                         int32_t count) noexcept;

/// Through accelerations, which are continuous: straight lines, the first from the acceleration of
/// `start`. Velocity and position are integrals.
PlanError planAccelerations(TimeProfile &profile, const State &start, const TimePoint *points,
                            int32_t count) noexcept;

} // namespace stride::motion

#endif
