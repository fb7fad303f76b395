// Puts the phases of a jerk-limited motion into a profile: private to the planner.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_BUILDER_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_PARABOLIC_BUILDER_HPP

#include "runtime/numeric/profile/parabolic_route.hpp"
#include "runtime/numeric/profile/parabolic_turn.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion::parabolic {

/// Units in which a problem's numbers are near 1: to them, and back to the user's.
class ScaledUnits {
public:
  using Factor = PowerOfTwo;
  explicit ScaledUnits(const Scale &scale) noexcept : scale_(scale) {}
  [[nodiscard]] PowerOfTwo length() const noexcept { return PowerOfTwo(scale_.length); }
  [[nodiscard]] PowerOfTwo velocity() const noexcept { return PowerOfTwo(scale_.velocity); }
  [[nodiscard]] PowerOfTwo acceleration() const noexcept { return PowerOfTwo(scale_.acceleration); }
  [[nodiscard]] PowerOfTwo jerk() const noexcept {
    return PowerOfTwo(scale_.acceleration - scale_.time);
  }
  [[nodiscard]] PowerOfTwo time() const noexcept { return PowerOfTwo(scale_.time); }
  [[nodiscard]] PowerOfTwo perLength() const noexcept { return PowerOfTwo(-scale_.length); }
  [[nodiscard]] PowerOfTwo perVelocity() const noexcept { return PowerOfTwo(-scale_.velocity); }
  [[nodiscard]] PowerOfTwo perAcceleration() const noexcept {
    return PowerOfTwo(-scale_.acceleration);
  }
  [[nodiscard]] PowerOfTwo perJerk() const noexcept {
    return PowerOfTwo(scale_.time - scale_.acceleration);
  }

private:
  Scale scale_;
};

/// The user's units. They do where all numbers are middling: scaling by powers of two would change
/// no digit.
class UserUnits {
public:
  struct Factor {
    double operator()(double x) const noexcept { return x; }
  };
  [[nodiscard]] static Factor length() noexcept { return {}; }
  [[nodiscard]] static Factor velocity() noexcept { return {}; }
  [[nodiscard]] static Factor acceleration() noexcept { return {}; }
  [[nodiscard]] static Factor jerk() noexcept { return {}; }
  [[nodiscard]] static Factor time() noexcept { return {}; }
  [[nodiscard]] static Factor perLength() noexcept { return {}; }
  [[nodiscard]] static Factor perVelocity() noexcept { return {}; }
  [[nodiscard]] static Factor perAcceleration() noexcept { return {}; }
  [[nodiscard]] static Factor perJerk() noexcept { return {}; }
};

/// Puts phases, in scaled units and in the direction `sign`, into a profile.
template <class Units> class Builder {
  using Factor = typename Units::Factor;

public:
  Builder(Profile &profile, const Units &units, const State &start) noexcept
      : profile_(profile), next_(profile.segments), length_(units.length()),
        velocity_(units.velocity()), acceleration_(units.acceleration()), jerk_(units.jerk()),
        time_(units.time()),
        place_(start.position), state_{0.0, units.perVelocity()(start.velocity),
                                       units.perAcceleration()(start.acceleration)} {}

  /// Goes on with a phase.
  void forward(const Phase &phase, double sign) noexcept {
    if (phase.duration > 0.0)
      forward(phase, sign,
              after(state_, {phase.duration, sign * phase.jerk, sign * phase.acceleration}));
  }

  void forward(const VelocityChange &change, double sign) noexcept {
    for (const Phase &phase : change.phases)
      forward(phase, sign);
  }

  /// How the axis moves now; its position is 0.
  [[nodiscard]] const State &state() const noexcept { return state_; }

  /// A distance in user units.
  [[nodiscard]] double length(double scaled) const noexcept { return length_(scaled); }

  /// The axis is at rest now, or moves at a constant velocity: without the rounding of the phases.
  void settle(double velocity) noexcept { state_ = {0.0, velocity, 0.0}; }

  void forward(const TurningChange &change, double sign) noexcept {
    if (change.turns) {
      for (const Phase &phase : change.lead)
        forward(phase, sign);
      state_ = {0.0, 0.0, sign * change.acceleration};
    }
    forward(change.rest, sign);
  }

  template <class Route>
  void route(const Route &route, double side, double target, double endVelocity) noexcept {
    const double sign = side * route.sign;
    for (int i = 0; i < route.headCount; ++i) {
      const State &end = route.ends[i];
      forward(route.head[i], sign,
              {sign * end.position, sign * end.velocity, sign * end.acceleration});
    }
    if (route.cruise > 0.0) {
      settle(sign * route.cruiseVelocity);
      forward({route.cruise, 0.0, 0.0}, sign);
    }
    arrive(route.tail, sign, target, endVelocity);
  }

  /// A change of velocity that ends at `target` and is anchored there.
  void arrive(const VelocityChange &change, double sign, double target,
              double endVelocity) noexcept {
    const Phase &first = change.phases[0];
    const Phase &hold = change.phases[1];
    const Phase &last = change.phases[2];
    // Back from the end; each piece is anchored at its own.
    const State end = {0.0, endVelocity, 0.0};
    State held = numeric::evaluateCubic(end, sign * last.jerk, -last.duration);
    held.acceleration = sign * hold.acceleration;
    State reached = numeric::evaluateCubic(held, sign * hold.jerk, -hold.duration);
    reached.acceleration = sign * first.acceleration;
    approach(first, sign, target, reached);
    approach(hold, sign, target, held);
    approach(last, sign, target, end);
    place_ = target;
    settle(endVelocity);
  }

  /// The same, through standstill.
  void arrive(const TurningChange &change, double sign, double target,
              double endVelocity) noexcept {
    if (change.turns) {
      const double way = change.rest.distance(0.0, change.acceleration, sign * endVelocity);
      State state = {-sign * way, 0.0, sign * change.acceleration};
      State ends[3];
      for (int i = 2; i >= 0; --i) {
        state.acceleration = sign * change.lead[i].acceleration;
        ends[i] = state;
        state = numeric::evaluateCubic(state, sign * change.lead[i].jerk, -change.lead[i].duration);
      }
      for (int i = 0; i < 3; ++i)
        approach(change.lead[i], sign, target, ends[i]);
    }
    arrive(change.rest, sign, target, endVelocity);
  }

  /// Ends the profile with this velocity, and where the axis is. False if a number of the profile
  /// cannot be represented; then it is empty.
  bool finish(double position, double velocity) noexcept {
    profile_.count = static_cast<int32_t>(next_ - profile_.segments);
    profile_.duration = duration_;
    profile_.end = {place_, velocity, 0.0};
    double sum = duration_ + place_; // is no number where one of them is none
    for (const Segment *it = profile_.segments; it != next_; ++it)
      sum += (it->reference + it->jerk) +
             (it->origin.position + it->origin.velocity + it->origin.acceleration);
    const bool good = exact::isfinite(sum);
    if (!good)
      profile_ = Profile{{}, 0, 0.0, {position, 0.0, 0.0}};
    return good;
  }

private:
  /// Goes on with a phase that lasts and ends in `end`, whose position counts from its begin.
  void forward(const Phase &phase, double sign, const State &end) noexcept {
    append(duration_, place_, state_, sign * phase.jerk);
    place_ += length_(end.position);
    duration_ += time_(phase.duration);
    settle(end.velocity);
    state_.acceleration = end.acceleration;
  }

  /// A phase that ends in `end`, whose position counts from `target`.
  void approach(const Phase &phase, double sign, double target, const State &end) noexcept {
    const double until = duration_ + time_(phase.duration);
    if (phase.duration > 0.0)
      append(until, target + length_(end.position), end, sign * phase.jerk);
    duration_ = until;
  }

  void append(double reference, double position, const State &state, double jerk) noexcept {
    Segment &segment = *next_++;
    segment.start = duration_;
    segment.reference = reference;
    segment.origin.position = position;
    segment.origin.velocity = velocity_(state.velocity);
    segment.origin.acceleration = acceleration_(state.acceleration);
    segment.jerk = jerk_(jerk);
    segment.frequency = 0.0;
  }

  Profile &profile_;
  Segment *next_;
  double duration_ = 0.0;
  [[no_unique_address]] Factor length_; ///< The units of the scaled problem.
  [[no_unique_address]] Factor velocity_;
  [[no_unique_address]] Factor acceleration_;
  [[no_unique_address]] Factor jerk_;
  [[no_unique_address]] Factor time_;
  double place_; ///< Where the axis is. [u]
  State state_;  ///< How it moves there; its position is 0.
};

} // namespace stride::motion::parabolic

#endif
