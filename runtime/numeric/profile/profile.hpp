// A motion profile: the whole course of one axis from a state to a target, in closed form.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PROFILE_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PROFILE_HPP

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/motion_state.hpp"

#include <stdint.h>

namespace stride::motion {

/// Position, velocity and acceleration at one instant. [u], [u/s], [u/s^2]
using State = numeric::MotionState;

inline bool isFinite(const State &state) noexcept {
  return exact::isfinite(state.position) && exact::isfinite(state.velocity) &&
         exact::isfinite(state.acceleration);
}

/// One piece of a profile, valid from `start` until the next piece starts. With u = t - reference:
/// if `frequency` is 0, a polynomial of third degree in u; else the acceleration is
/// origin.acceleration + jerk / frequency * sin(frequency * u), and velocity and position are its
/// integrals. A piece that ends at the target is anchored there (`reference` is its end), so that
/// the approach to the target is exact. Times count from the profile's start. [s]
struct Segment {
  double start;
  double reference;
  State origin;     ///< The state at time `reference`.
  double jerk;      ///< At `reference`; throughout the piece if `frequency` is 0. [u/s^3]
  double frequency; ///< Angular frequency of a sine-shaped acceleration, 0 for none. [rad/s]

  /// The state at time `t`.
  [[nodiscard]] State at(double t) const noexcept {
    return numeric::evaluatePiece(origin, jerk, frequency, t - reference);
  }
};

/// A course of one axis as a value: no allocation, no reference to anything, evaluation in bounded
/// time at any instant and in any order.
struct Profile {
  /// Enough for a jerk-limited stop (3), a move back (7) and a run-up (3).
  static constexpr int32_t kMaxSegments = 16;

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
  Blocked,         ///< No motion of the duration that is asked for keeps the limits.
};

} // namespace stride::motion

#endif
