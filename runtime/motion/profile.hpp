// A motion profile: the whole course of one axis from a state to a target, in closed form.
#ifndef STRIDE_RUNTIME_MOTION_PROFILE_HPP
#define STRIDE_RUNTIME_MOTION_PROFILE_HPP

#include "runtime/axis/motion_state.hpp"

#include <stdint.h>

namespace stride::motion {

/// Position, velocity and acceleration at one instant. [u], [u/s], [u/s^2]
using State = axis::MotionState;

/// One piece of a profile: a polynomial of third degree in t - reference, valid from `start` until
/// the next piece starts. A piece that ends at the target is anchored there (`reference` is its
/// end), so that the approach to the target is exact. Times count from the profile's start. [s]
struct Segment {
  double start;
  double reference;
  State origin; ///< The state at time `reference`.
  double jerk;  ///< [u/s^3]
};

/// A course of one axis as a value: no allocation, no reference to anything, evaluation in bounded
/// time at any instant and in any order.
struct Profile {
  /// Enough for a stop, a reversal and a jerk-limited move of seven pieces.
  static constexpr int32_t kMaxSegments = 12;

  Segment segments[kMaxSegments];
  int32_t count;   ///< Valid segments; 0 for a profile without any motion.
  double duration; ///< [s]
  State end;       ///< The state from `duration` on, exact.

  /// The state `t` seconds after the start. From `duration` on this is `end`, carried on at its
  /// velocity; before the start it is the state at the start.
  [[nodiscard]] State at(double t) const noexcept;
};

/// What a planner says. Every error leaves an empty profile.
enum class PlanError : uint8_t {
  None = 0,
  InvalidState,    ///< A position or velocity is not finite.
  InvalidLimit,    ///< A limit is not finite or not greater than zero.
  Unrepresentable, ///< The motion would last longer, or go farther, than a double can say.
};

} // namespace stride::motion

#endif
