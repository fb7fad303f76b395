// Motions of limited jerk that arrive at a given time, for axes that shall arrive together.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_ARRIVAL_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_ARRIVAL_HPP

#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion {

/// Limits of signed velocities and accelerations, as they are for an axis that may turn on its way.
struct ArrivalLimits {
  double highest; ///< Greatest velocity, > 0. [u/s]
  double lowest;  ///< Least velocity, < 0. [u/s]
  double rising;  ///< Greatest acceleration, > 0. [u/s^2]
  double falling; ///< Least acceleration without its sign, > 0. [u/s^2]
  double jerk;    ///< > 0 [u/s^3]
};

/// The times at which an axis can arrive: from `shortest` on, but not within the blocked intervals
/// (at their ends it can). All of them lie after `shortest`, in this order. [s]
struct ArrivalTimes {
  struct Interval {
    double from;
    double to;
  };
  double shortest;
  Interval blocked[2];
  int32_t blockedCount;
};

/// Finds when an axis that begins in `start` can be at `target` with `endVelocity` and without
/// acceleration. InvalidState also if the limits cannot be kept from the start, or at the end.
///
/// The motions that take a time T reach an interval of places, because the limits are convex: from
/// those that are pushed down first and get least far to those that are pushed up first and get
/// farthest. A time is blocked where the target is outside; as an axis that turns gets less far for
/// a while if it is pushed on, there is one such interval at each side. See L. Berscheid, T.
/// Kröger: Jerk-limited real-time trajectory generation with arbitrary target states, 2021.
PlanError findArrivalTimes(ArrivalTimes &times, const State &start, double target,
                           double endVelocity, const ArrivalLimits &limits) noexcept;

/// The least time, at which all of these axes can arrive. [s]
double commonArrival(const ArrivalTimes *axes, int32_t count) noexcept;

/// Plans the motion that arrives after `duration` [s], there bit for bit. Errors as
/// findArrivalTimes, and Blocked if there is none of that duration. Of all motions this is the mean
/// of those that get farthest and least far in that time, weighted such that it hits the target.
PlanError planArrival(Profile &profile, const State &start, double target, double endVelocity,
                      const ArrivalLimits &limits, double duration) noexcept;

} // namespace stride::motion

#endif
