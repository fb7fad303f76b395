// Jerk-limited motions whose velocity changes its sign where acceleration and deceleration differ:
// private to the planner.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_TURN_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_TURN_HPP

#include "runtime/numeric/profile/parabolic_route.hpp"

namespace stride::motion::parabolic {

/// The fastest change to a velocity without acceleration, through standstill where it lies between.
/// `rates` are those of positive velocities; of negative ones they are the other way round. In
/// scaled units.
struct TurningChange {
  Phase lead[3];       ///< To standstill, which the axis passes; durations of 0 if it does not.
  VelocityChange rest; ///< From there, else all of the change.
  double acceleration = 0.0; ///< At standstill.
  bool turns = false;        ///< Whether there is a `lead`.

  TurningChange() noexcept {} // `lead` is assigned where it is used
  TurningChange(double velocity, double from, double to, const Rates &rates) noexcept {
    set(velocity, from, to, rates);
  }

  /// Becomes the change from `velocity`, with the acceleration `from`, to the velocity `to`.
  void set(double velocity, double from, double to, const Rates &rates) noexcept;

  /// The way from the beginning to the end, where the velocity is `to`.
  [[nodiscard]] double distance(double velocity, double from, double to) const noexcept;

  [[nodiscard]] double duration() const noexcept {
    const double passing = turns ? lead[0].duration + lead[1].duration + lead[2].duration : 0.0;
    return passing + rest.duration();
  }

  /// The greatest acceleration towards the end velocity before standstill, or, without a lead, of
  /// all of the change.
  [[nodiscard]] double peak() const noexcept {
    return exact::fabs(turns ? lead[0].acceleration : rest.phases[0].acceleration);
  }

private:
  void change(double sign, double velocity, double from, double to, const Rates &rates) noexcept;
};

/// A way through standstill: a change, and a part of a phase, first.
using TurningRoute = RouteOf<TurningChange, 7>;

/// What is known of where the direct change to the end velocity ends.
enum class Direct : uint8_t {
  Unknown,
  Behind, ///< Beyond the target, by more than rounding.
};

/// Finds the fastest way; `rates` of the task are those of positive velocities, and `top` is the
/// greatest magnitude of the velocity, above 0.
void findTurningRoute(TurningRoute &route, const Task &task, Direct direct) noexcept;

} // namespace stride::motion::parabolic

#endif
