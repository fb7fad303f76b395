// How a jerk-limited motion turns around where the rates of both directions differ: private to the
// planner.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_TURN_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_TURN_HPP

#include "runtime/numeric/profile/parabolic_route.hpp"

namespace stride::motion::parabolic {

/// The soonest turn from velocities below 0 to standstill, with an acceleration there that goes on
/// into positive velocities, in scaled units: at every velocity the acceleration is the greatest
/// one that there can be.
struct Turn {
  Phase phases[3];     ///< Where a duration is 0, there is none.
  double way;          ///< From the start to where the axis stands.
  double acceleration; ///< There.

  /// From a velocity that is negative, or that the acceleration `from` makes negative. While it is,
  /// `rates.falling` holds, then `rates.rising`; and no velocity above `top` follows from the turn.
  Turn(double velocity, double from, const Rates &rates, double top) noexcept;
};

} // namespace stride::motion::parabolic

#endif
