// How long a jerk-limited motion is pushed on: private to the planner.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_PUSH_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_PUSH_HPP

#include "runtime/numeric/profile/parabolic_route.hpp"

namespace stride::motion::parabolic {

/// A push with the jerk, from the acceleration of a task's start.
struct Push {
  double rate = 0.0; ///< The acceleration at which it ends; negative: the axis still slows down.
  double hold = 0.0; ///< How long the acceleration, the greatest one then, is kept.
};

/// Whether the numbers of a task let findPush find what there is: the state at the start can keep
/// the limits, the end velocity is within them, and squares can be represented.
bool isRegular(const Task &task) noexcept;

/// While the axis still slows down, the task's reach may rise, fall and rise again with the time
/// for which it is pushed on: the acceleration at which a push that begins in `from` must end to
/// reach farthest before the fall. Not below 0 if there is no fall.
double summitOf(const Task &task, const State &from) noexcept;

/// The shortest push of a regular task after which the change to the end velocity ends at the
/// task's distance, which the direct change does not reach. False if not even the way by way of the
/// top velocity does.
bool findPush(Push &push, const Task &task) noexcept;

/// A push of a task whose velocity passes standstill, where its rates change sides.
struct TurningPush : Push {
  bool passes = false; ///< First the axis turns to standstill; the push begins there.
};

/// The same as isRegular, for findTurningPush: the rates of the task are those of positive
/// velocities, and belong to magnitudes.
bool isRegularTurn(const Task &task) noexcept;

/// The same as summitOf, also where a task is not regular.
double turningSummit(const Task &task, const State &from) noexcept;

/// The same as findPush: the first push of all that reach the target.
bool findTurningPush(TurningPush &push, const Task &task) noexcept;

} // namespace stride::motion::parabolic

#endif
