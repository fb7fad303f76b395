// Positions on a rotary (modulo) axis: pure functions.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_MODULO_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_MODULO_HPP

#include "runtime/numeric/profile/planner.hpp"

namespace stride::motion {

/// How a rotary axis goes to a position; the values are those of MC_Direction.
enum class Direction : int8_t {
  Negative = -1, ///< Towards smaller positions.
  Shortest = 0,  ///< Whichever way is nearer, seen from the present position.
  Positive = 1,  ///< Towards larger positions.
  Current = 2,   ///< As the axis moves, or moved last.
  Fastest = 3,   ///< Whichever way takes less time, the present velocity considered.
};

/// A request to resolve a target on a rotary axis.
struct ModuloRequest {
  State start;          ///< Present set values.
  double target;        ///< Demanded position, any number of periods. [u]
  double endVelocity;   ///< Demanded there. [u/s]
  double period;        ///< Modulo period, > 0. [u]
  Direction direction;  ///< The demanded way.
  Direction lastMotion; ///< Positive or Negative: counts for Current at rest.
  Dynamics dynamics;    ///< Of the move: the way to standstill and the times depend on them.
};

/// The target as a position on the unrolled axis that continues from `request.start`.
/// Positive and Negative never reverse, apart from braking when the axis moves the other way: a
/// target that is too near to stop at, or to reach the end velocity, is reached one turn later. (An
/// end velocity against the direction has to reverse: then only for the arrival.) Half a period
/// away, Shortest goes in the positive direction. False if an argument is not finite, a limit or
/// the period not > 0.
bool resolveModulo(const ModuloRequest &request, double &target) noexcept;

} // namespace stride::motion

#endif
