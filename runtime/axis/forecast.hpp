// What an axis is going to do, as far as that is planned.
#ifndef STRIDE_RUNTIME_AXIS_FORECAST_HPP
#define STRIDE_RUNTIME_AXIS_FORECAST_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion {

/// A copy of an axis that runs ahead of it. Times count from the start of the present cycle. [s]
class Forecast {
public:
  explicit Forecast(const axis::AxisRef &axis) noexcept;

  /// The set values at time `t` >= 0, which must not lie before that of an earlier call. Positions
  /// are continuous, of a rotary axis too: they go on from the present set position. False if they
  /// are not known: then nothing later is known either.
  bool at(double t, State &state, double &jerk) noexcept;

private:
  bool followOn(double t) noexcept;
  State planned(double t, double &jerk) noexcept;

  axis::AxisRef axis_;
  State start_;  ///< At the start of the cycle.
  bool planned_; ///< What comes is known …
  bool atRest_;  ///< … to be nothing.
  bool moved_;   ///< The axis has got its set values of this cycle.
  double base_;  ///< Time that belongs to the plan's present cycle.
  double shift_; ///< From the plan's positions to those that `at` returns.
};

} // namespace stride::motion

#endif
