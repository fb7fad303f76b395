// Routes of the jerk-limited planner in scaled units: private to it.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_ROUTE_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_ROUTE_HPP

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion::parabolic {

inline constexpr double kEpsilon = 0x1p-52;

/// A piece of constant jerk.
struct Phase {
  double duration;
  double jerk;
  double acceleration; ///< At its end: exact where a limit is reached.

  void mirror() noexcept {
    jerk = -jerk;
    acceleration = -acceleration;
  }
};

inline State after(const State &state, const Phase &phase) noexcept {
  State next = numeric::evaluateCubic(state, phase.jerk, phase.duration);
  next.acceleration = phase.acceleration;
  return next;
}

/// The first part of a phase that begins with `state`.
inline Phase partOf(const Phase &phase, const State &state, double duration) noexcept {
  return {duration, phase.jerk, state.acceleration + phase.jerk * duration};
}

/// The rates at which a velocity may rise and fall (a signed velocity: not its magnitude).
struct Rates {
  double rising;
  double falling;
  double jerk;

  [[nodiscard]] Rates mirrored() const noexcept { return {falling, rising, jerk}; }
};

/// The velocity at which the axis is when its acceleration has been taken away.
inline double settledVelocity(double velocity, double acceleration, double jerk) noexcept {
  return velocity + acceleration * (exact::fabs(acceleration) / (2.0 * jerk));
}

/// The fastest change to a velocity without acceleration: up to three phases.
struct VelocityChange {
  Phase phases[3];

  VelocityChange() noexcept {} // no change yet: what a route has is assigned
  VelocityChange(double velocity, double acceleration, double to, const Rates &rates) noexcept {
    const double jerk = rates.jerk;
    const double settled = settledVelocity(velocity, acceleration, jerk);
    if (exact::fabs(to - settled) <= 8.0 * kEpsilon * (exact::fabs(velocity) + exact::fabs(to))) {
      // It is under way; the last digits would cost the root of what they are.
      set(0, exact::fabs(acceleration) / jerk, acceleration > 0.0 ? -jerk : jerk, 0.0);
      set(1, 0.0, 0.0, 0.0);
      set(2, 0.0, 0.0, 0.0);
      return;
    }
    const double sign = to > settled ? 1.0 : -1.0;
    const double limit = sign > 0.0 ? rates.rising : rates.falling;
    const double gain = sign * (to - velocity);
    const double from = sign * acceleration;
    if (from > limit) { // beyond the limit: back to it first
      const double hold = (gain - from * (from / (2.0 * jerk))) / limit;
      set(0, (from - limit) / jerk, -sign * jerk, sign * limit);
      set(1, hold, 0.0, sign * limit);
      set(2, limit / jerk, -sign * jerk, 0.0);
      return;
    }
    const double square = jerk * gain + 0.5 * from * from;
    const double most = limit * limit;
    double peak = 0.0;
    double hold = 0.0;
    bool held = square > most * (1.0 + 4.0 * kEpsilon);
    if (!held) { // else without a root
      peak = square > 0.0 ? exact::sqrt(square) : 0.0;
      held = peak > limit;
    }
    if (held) {
      hold = (gain - (most - 0.5 * from * from) / jerk) / limit;
      peak = limit;
    }
    set(0, (peak - from) / jerk, sign * jerk, sign * peak);
    set(1, hold, 0.0, sign * peak);
    set(2, peak / jerk, -sign * jerk, 0.0);
  }

  /// The way from the beginning to the end, where the velocity is `to`.
  [[nodiscard]] double distance(double velocity, double acceleration, double to) const noexcept {
    const State first =
        numeric::evaluateCubic({0.0, velocity, acceleration}, phases[0].jerk, phases[0].duration);
    // The rest as it is seen from the end, where the acceleration is 0.
    const double t1 = phases[1].duration;
    const double t2 = phases[2].duration;
    const double fast = to - 0.5 * phases[1].acceleration * t2;
    return first.position + (fast - 0.5 * phases[1].acceleration * t1) * t1 +
           (to + phases[2].jerk * t2 * (t2 * (1.0 / 6.0))) * t2;
  }

  [[nodiscard]] double duration() const noexcept {
    return phases[0].duration + phases[1].duration + phases[2].duration;
  }

private:
  void set(int index, double duration, double jerk, double acceleration) noexcept {
    phases[index] = {duration > 0.0 ? duration : 0.0, jerk, acceleration};
  }
};

/// How to reach a place with a velocity: some phases, a cruise, a change to the end velocity.
template <class Change, int kMost> struct RouteOf {
  Phase head[kMost];           ///< What the axis does first; nothing but the first `headCount`.
  State ends[kMost];           ///< Of these phases; each position counts from the phase's begin.
  int headCount = 0;           ///< Valid entries of `head` and `ends`.
  double cruise = 0.0;         ///< Time at `cruiseVelocity`, 0 for none.
  double cruiseVelocity = 0.0; ///< Mirrored as the phases are.
  double sign = 1.0;           ///< -1: all of it is mirrored.
  Change tail;                 ///< To the end velocity; ends at the target.

  RouteOf() noexcept {} // `head`, `ends` and `tail` are assigned

  /// The axis, which is in `state`, first does this, too; then it is in that state.
  void add(const Phase &phase, State &state) noexcept {
    const State next = after({0.0, state.velocity, state.acceleration}, phase);
    head[headCount] = phase;
    ends[headCount++] = next;
    state.position += next.position;
    state.velocity = next.velocity;
    state.acceleration = next.acceleration;
  }
};

/// A way on which the rates do not change.
using Route = RouteOf<VelocityChange, 3>;

/// A task in one dimension, in scaled units: from position 0 to `distance`.
struct Task {
  double velocity;
  double acceleration;
  double distance;
  double endVelocity;
  double top;    ///< Highest velocity.
  double bottom; ///< Lowest velocity, at most 0.
  Rates rates;
  double noise; ///< Distances below it are rounding.

  [[nodiscard]] Task mirrored() const noexcept {
    return {-velocity, -acceleration, -distance,        -endVelocity,
            -bottom,   -top,          rates.mirrored(), noise};
  }
  [[nodiscard]] VelocityChange changeFrom(const State &state) const noexcept {
    return VelocityChange(state.velocity, state.acceleration, endVelocity, rates);
  }
  /// Where the axis arrives when it changes to the end velocity in this state.
  [[nodiscard]] double reach(const State &state) const noexcept {
    return state.position +
           changeFrom(state).distance(state.velocity, state.acceleration, endVelocity);
  }
};

/// What the last digits of the state at the start make of the distance of a change.
inline double blurOf(const VelocityChange &change, double velocity, double acceleration,
                     double jerk) noexcept {
  const double swing = acceleration * (acceleration / jerk);
  return 16.0 * kEpsilon * change.duration() * (exact::fabs(velocity) + swing);
}

/// How far a change from the state `from` may miss the task's distance: more is not rounding.
inline double roundingOf(const Task &task, const State &from) noexcept {
  return 4.0 * task.noise + 16.0 * kEpsilon * exact::fabs(from.position);
}

/// A change of velocity, in the state `from`, that ends with a short bend back lasts as long as the
/// root of the last digits of the velocities says: makes the bend such that the change ends at the
/// task's distance, which is `gap` farther, if so small a difference of velocities does it. False
/// if not even nearly: then the change is of no use.
bool bend(VelocityChange &change, const Task &task, const State &from, double gap,
          double rounding) noexcept;

/// Finds the fastest way; false when the limits of velocity do not allow one.
bool findRoute(Route &route, const Task &task) noexcept;

} // namespace stride::motion::parabolic

#endif
