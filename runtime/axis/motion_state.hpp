// Position, velocity and acceleration of one axis at one instant, and the closed form that all
// polynomial motions share. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_MOTION_STATE_HPP
#define STRIDE_RUNTIME_AXIS_MOTION_STATE_HPP

namespace stride::axis {

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

} // namespace stride::axis

#endif
