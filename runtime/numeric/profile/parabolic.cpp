#include "runtime/numeric/profile/parabolic.hpp"

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/parabolic_route.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion {
namespace {

using namespace parabolic;

/// So many units of the scaled problem are as good as no limit. Rates have squares.
constexpr double kUnlimited = 0x1p400;
constexpr double kUnlimitedJerk = 0x1p1000;

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

/// The limits in scaled units.
struct Limits {
  double velocity;
  double acceleration;
  double deceleration;
  double jerk;

  Limits(const JerkLimits &limits, const ScaledUnits &units) noexcept
      : velocity(scaled(limits.velocity, units.perVelocity())),
        acceleration(scaled(limits.acceleration, units.perAcceleration())),
        deceleration(scaled(limits.deceleration, units.perAcceleration())),
        jerk(scaled(limits.jerk, units.perJerk(), kUnlimitedJerk)) {}
  Limits(const JerkLimits &limits, const UserUnits & /*same*/) noexcept
      : velocity(limits.velocity), acceleration(limits.acceleration),
        deceleration(limits.deceleration), jerk(limits.jerk) {}

  /// For velocities in the direction of motion.
  [[nodiscard]] Rates ahead() const noexcept { return {acceleration, deceleration, jerk}; }
  [[nodiscard]] Rates stopping() const noexcept { return {deceleration, deceleration, jerk}; }

private:
  static double scaled(double limit, const PowerOfTwo &unit, double most = kUnlimited) noexcept {
    const double value = unit(limit);
    return value < most ? value : most;
  }
};

void clear(Profile &profile, double position) noexcept {
  profile.count = 0;
  profile.duration = 0.0;
  profile.end = {position, 0.0, 0.0};
}

bool areLimits(const JerkLimits &limits) noexcept {
  const double sum = (limits.velocity + limits.acceleration) + (limits.deceleration + limits.jerk);
  if (__builtin_expect(exact::isfinite(sum), 1))
    return limits.velocity > 0.0 && limits.acceleration > 0.0 && limits.deceleration > 0.0 &&
           limits.jerk > 0.0;
  return exact::isPositive(limits.velocity) && exact::isPositive(limits.acceleration) &&
         exact::isPositive(limits.deceleration) && exact::isPositive(limits.jerk);
}

bool areFinite(const State &start, double target, double endVelocity) noexcept {
  const double sum =
      (start.position + start.velocity) + (start.acceleration + target) + endVelocity;
  return exact::isfinite(sum) ||
         (isFinite(start) && exact::isfinite(target) && exact::isfinite(endVelocity));
}

Scale scaleOf(double distance, const State &start, double endVelocity,
              const JerkLimits &limits) noexcept {
  const double swing = start.acceleration * (start.acceleration / (2.0 * limits.jerk));
  const double fastest =
      exact::larger(exact::larger(exact::fabs(start.velocity), exact::fabs(endVelocity)), swing);
  return Scale::of(distance, fastest, limits.acceleration, limits.deceleration);
}

/// What is rounding of a way in scaled units.
template <class Units>
double noiseOf(const State &start, double target, double way, const Units &units) noexcept {
  const double places = exact::larger(exact::fabs(start.position), exact::fabs(target));
  return 16.0 * kEpsilon * (units.perLength()(places) + exact::fabs(way));
}

PlanError result(bool representable) noexcept {
  return representable ? PlanError::None : PlanError::Unrepresentable;
}

/// The axis stands; goes on to `target`, which is `distance` away, with `endVelocity` there.
template <class Units>
void moveFromRest(Builder<Units> &builder, double distance, double target, double endVelocity,
                  const Limits &limits, double noise) noexcept {
  const double side = endVelocity != 0.0 ? exact::signOf(endVelocity) : exact::signOf(distance);
  const double speed = side * endVelocity;
  const double ahead = side * distance;
  Task task = {0.0, 0.0, ahead, speed, limits.velocity, 0.0, limits.ahead(), noise};
  Route route;
  if (speed == 0.0) {
    (void)findRoute(route, task);
    builder.route(route, side, target, 0.0);
    return;
  }
  const VelocityChange runUp(0.0, 0.0, speed, limits.ahead());
  const double runUpWay = runUp.distance(0.0, 0.0, speed);
  if (ahead >= runUpWay - noise) {
    (void)findRoute(route, task);
    builder.route(route, side, target, endVelocity);
    return;
  }
  // Back to where the run-up must begin.
  task.distance = runUpWay - ahead;
  task.endVelocity = 0.0;
  (void)findRoute(route, task);
  builder.route(route, -side, target - builder.length(side * runUpWay), 0.0);
  builder.arrive(runUp, side, target, endVelocity);
}

/// The motion between different rates for rising and falling: they hold for the magnitude of the
/// velocity, so its sign may change only at rest.
template <class Units>
void moveOnOneSide(Builder<Units> &builder, const State &state, double distance, double target,
                   double endVelocity, const Limits &limits, double noise) noexcept {
  const double side =
      state.velocity != 0.0 ? exact::signOf(state.velocity) : exact::signOf(state.acceleration);
  const double velocity = side * state.velocity;
  const double acceleration = side * state.acceleration;
  if (settledVelocity(velocity, acceleration, limits.jerk) >= 0.0) {
    Task task = {velocity,        acceleration, side * distance, side * endVelocity,
                 limits.velocity, 0.0,          limits.ahead(),  noise};
    const double back = -task.endVelocity; // at the target
    VelocityChange runUp;
    double runUpWay = 0.0;
    if (back > 0.0) { // first as far as the run-up needs
      runUp = VelocityChange(0.0, 0.0, back, limits.ahead());
      runUpWay = runUp.distance(0.0, 0.0, back);
      task.distance += runUpWay;
      task.endVelocity = 0.0;
    }
    Route route;
    if (findRoute(route, task)) {
      builder.route(route, side, target + builder.length(side * runUpWay), side * task.endVelocity);
      if (back > 0.0)
        builder.arrive(runUp, -side, target, endVelocity);
      return;
    }
  }
  const VelocityChange stop(velocity, acceleration, 0.0, limits.stopping());
  builder.forward(stop, side);
  builder.settle(0.0);
  moveFromRest(builder, distance - side * stop.distance(velocity, acceleration, 0.0), target,
               endVelocity, limits, noise);
}

/// planParabolic where there is something to do and all can be represented.
template <class Units>
bool planTo(Profile &profile, const State &start, double target, double endVelocity,
            const JerkLimits &limits, const Units &units) noexcept {
  const Limits scaled(limits, units);
  Builder<Units> builder(profile, units, start);
  const State &state = builder.state();
  const double way = units.perLength()(target - start.position);
  const double last = units.perVelocity()(endVelocity);
  const double noise = noiseOf(start, target, way, units);
  if (scaled.acceleration == scaled.deceleration) {
    Route route;
    (void)findRoute(route, {state.velocity, state.acceleration, way, last, scaled.velocity,
                            -scaled.velocity, scaled.ahead(), noise});
    builder.route(route, 1.0, target, last);
  } else if (state.velocity == 0.0 && state.acceleration == 0.0) {
    moveFromRest(builder, way, target, last, scaled, noise);
  } else {
    moveOnOneSide(builder, state, way, target, last, scaled, noise);
  }
  return builder.finish(start.position, endVelocity);
}

/// Whether the user's units do: all numbers are valid then, too.
bool isMiddling(const State &start, double target, double endVelocity,
                const JerkLimits &limits) noexcept {
  constexpr double kLarge = 0x1p48;
  const double sum =
      (exact::fabs(start.position) + exact::fabs(target)) +
      (exact::fabs(start.velocity) + exact::fabs(endVelocity)) + exact::fabs(start.acceleration) +
      ((limits.velocity + limits.acceleration) + (limits.deceleration + limits.jerk));
  const double least = exact::smaller(exact::smaller(limits.velocity, limits.acceleration),
                                      exact::smaller(limits.deceleration, limits.jerk));
  return sum < kLarge && least > 1.0 / kLarge &&
         exact::fabs(target - start.position) > 1.0 / kLarge;
}

} // namespace

PlanError planParabolic(Profile &profile, const State &start, double target, double endVelocity,
                        const JerkLimits &limits) noexcept {
  if (__builtin_expect(isMiddling(start, target, endVelocity, limits), 1))
    return result(planTo(profile, start, target, endVelocity, limits, UserUnits()));
  clear(profile, start.position);
  if (!areFinite(start, target, endVelocity))
    return PlanError::InvalidState;
  if (!areLimits(limits))
    return PlanError::InvalidLimit;
  const double distance = target - start.position;
  if (!exact::isfinite(distance))
    return PlanError::Unrepresentable;
  if (distance == 0.0 && start.velocity == endVelocity && start.acceleration == 0.0) {
    profile.end = {target, endVelocity, 0.0};
    return PlanError::None;
  }
  const ScaledUnits units(scaleOf(distance, start, endVelocity, limits));
  return result(planTo(profile, start, target, endVelocity, limits, units));
}

PlanError planParabolicVelocity(Profile &profile, const State &start, double velocity,
                                const JerkLimits &limits) noexcept {
  clear(profile, start.position);
  if (!isFinite(start) || !exact::isfinite(velocity))
    return PlanError::InvalidState;
  if (!areLimits(limits))
    return PlanError::InvalidLimit;

  const Scale scale = scaleOf(0.0, start, velocity, limits);
  const ScaledUnits units(scale);
  const Limits scaled(limits, units);
  Builder<ScaledUnits> builder(profile, units, start);
  const State &state = builder.state();
  const double last = exact::ldexp(velocity, -scale.velocity);
  const double side = state.velocity != 0.0       ? exact::signOf(state.velocity)
                      : state.acceleration != 0.0 ? exact::signOf(state.acceleration)
                                                  : exact::signOf(last);
  const double speed = side * state.velocity;
  const double rate = side * state.acceleration;
  if (scaled.acceleration == scaled.deceleration ||
      (settledVelocity(speed, rate, scaled.jerk) >= 0.0 && side * last >= 0.0)) {
    builder.forward(VelocityChange(speed, rate, side * last, scaled.ahead()), side);
  } else {
    builder.forward(VelocityChange(speed, rate, 0.0, scaled.stopping()), side);
    builder.settle(0.0);
    const double to = exact::signOf(last);
    builder.forward(VelocityChange(0.0, 0.0, to * last, scaled.ahead()), to);
  }
  return result(builder.finish(start.position, velocity));
}

PlanError planParabolicStop(Profile &profile, const State &start, double deceleration,
                            double jerk) noexcept {
  return planParabolicVelocity(profile, start, 0.0, {1.0, deceleration, deceleration, jerk});
}

double reachableByParabola(const State &start, double target, double wanted,
                           const JerkLimits &limits) noexcept {
  const double distance = target - start.position;
  const Scale scale = scaleOf(distance, start, wanted, limits);
  const ScaledUnits units(scale);
  const Limits scaled(limits, units);
  double velocity = exact::ldexp(start.velocity, -scale.velocity);
  double acceleration = exact::ldexp(start.acceleration, -scale.acceleration);
  double way = exact::ldexp(distance, -scale.length);
  const VelocityChange stop(velocity, acceleration, 0.0, scaled.stopping());
  const double halt = stop.distance(velocity, acceleration, 0.0);
  double side = way - halt; // the way of the motion to the target
  if (exact::fabs(side) <=
      noiseOf(start, target, way, units) + blurOf(stop, velocity, acceleration, scaled.jerk))
    side = velocity;
  const double sign = side < 0.0 ? -1.0 : 1.0;
  const double speed = sign * exact::ldexp(wanted, -scale.velocity);
  if (!(speed > 0.0) || side == 0.0 || !exact::isfinite(way) || !exact::isfinite(halt))
    return 0.0;
  velocity *= sign;
  acceleration *= sign;
  way *= sign;
  double settled = settledVelocity(velocity, acceleration, scaled.jerk);
  const bool turns = velocity < 0.0 || settled < 0.0;
  if (turns && scaled.acceleration != scaled.deceleration) { // it stops first
    way -= sign * halt;
    velocity = acceleration = settled = 0.0;
  }
  const auto beyond = [&](double to) noexcept {
    return VelocityChange(velocity, acceleration, to, scaled.ahead())
               .distance(velocity, acceleration, to) -
           way;
  };
  if (!(beyond(speed) > 0.0))
    return wanted;
  const double slowest = exact::larger(settled, 0.0);
  // The jerk makes a small change take more way than a larger one: a stop may be possible where a
  // mere slowing down is not.
  double low = 0.0;
  double high = speed;
  if (speed > slowest) {
    const bool slower = beyond(slowest) > 0.0;
    (slower ? high : low) = slowest;
  }
  if (!(beyond(low) < 0.0))
    return exact::ldexp(sign * low, scale.velocity);
  // Not the last digits: they must not make the way too short.
  const double reached = bracketedRoot(beyond, low, high) * (1.0 - 4.0 * kEpsilon);
  return exact::ldexp(sign * exact::larger(reached, low), scale.velocity);
}

} // namespace stride::motion
