// Position, velocity and acceleration of one axis at one instant, and the closed forms of motion.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_MOTION_STATE_HPP
#define STRIDE_RUNTIME_NUMERIC_MOTION_STATE_HPP

#include "runtime/iec/math.h"

namespace stride::numeric {

/// Where an axis is and how it moves. [u], [u/s], [u/s^2]
struct MotionState {
  double position;
  double velocity;
  double acceleration;
};

/// The state `t` seconds after (or, for negative `t`, before) `origin`, at constant jerk [u/s^3].
inline MotionState evaluateCubic(const MotionState &origin, double jerk, double t) noexcept {
  const double half = 0.5 * t;
  MotionState state;
  state.acceleration = origin.acceleration + jerk * t;
  state.velocity = origin.velocity + (origin.acceleration + jerk * half) * t;
  state.position = origin.position +
                   (origin.velocity + (origin.acceleration + jerk * (t * (1.0 / 3.0))) * half) * t;
  return state;
}

/// x - sin x, where `sine` is sin x, also near 0 to the last digits.
inline double sineDefect(double x, double sine) noexcept {
  const double z = x * x;
  if (!(z < 1.0))
    return x - sine;
  const double tail = 1.0 - z * (1.0 / 156) * (1.0 - z * (1.0 / 210) * (1.0 - z * (1.0 / 272)));
  const double middle = 1.0 - z * (1.0 / 72) * (1.0 - z * (1.0 / 110) * tail);
  return x * z * (1.0 / 6) * (1.0 - z * (1.0 / 20) * (1.0 - z * (1.0 / 42) * middle));
}

/// The state `t` seconds after (or before) `origin`, where the acceleration swings about the
/// origin's with the angular `frequency` [rad/s], > 0, and at first changes with `jerk` [u/s^3].
/// `origin` by value: else the constant jerk would write it to memory, too.
[[gnu::noinline]] inline MotionState evaluateSine(MotionState origin, double jerk, double frequency,
                                                  double t) noexcept {
  const double x = frequency * t;
  const double half = ::stride::sin(0.5 * x);
  const double sine = 2.0 * half * ::stride::cos(0.5 * x);
  const double amplitude = jerk / frequency;
  const double swing = amplitude / frequency;
  MotionState state;
  state.acceleration = origin.acceleration + amplitude * sine;
  state.velocity = origin.velocity + origin.acceleration * t + 2.0 * swing * (half * half);
  state.position = origin.position + (origin.velocity + 0.5 * origin.acceleration * t) * t +
                   swing / frequency * sineDefect(x, sine);
  return state;
}

/// The state `t` seconds after (or before) `origin` in a piece of a profile: at constant jerk if
/// `frequency` is 0, else see evaluateSine.
inline MotionState evaluatePiece(const MotionState &origin, double jerk, double frequency,
                                 double t) noexcept {
  if (__builtin_expect(frequency > 0.0, 0))
    return evaluateSine({origin.position, origin.velocity, origin.acceleration}, jerk, frequency,
                        t);
  return evaluateCubic(origin, jerk, t);
}

} // namespace stride::numeric

#endif
