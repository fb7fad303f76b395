#include "runtime/numeric/profile/parabolic.hpp"

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/parabolic_builder.hpp"
#include "runtime/numeric/profile/parabolic_route.hpp"
#include "runtime/numeric/profile/parabolic_turn.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion {
namespace {

using namespace parabolic;

/// So many units of the scaled problem are as good as no limit. Rates have squares.
constexpr double kUnlimited = 0x1p400;
constexpr double kUnlimitedJerk = 0x1p1000;

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

/// The motion of `task`, whose velocity lies in the direction `side`, where it must change its
/// sign. Apart, because the other motions are quicker without its code.
template <class Units>
[[gnu::noinline]] void moveAndTurn(Builder<Units> &builder, const Task &task, double side,
                                   double target, double endVelocity, Direct direct) noexcept {
  Task both = task;
  both.bottom = -task.top;
  TurningRoute route;
  findTurningRoute(route, both, direct);
  builder.route(route, side, target, endVelocity);
}

/// The axis stands; goes on to `target`, which is `distance` away, with `endVelocity` there.
template <class Units>
void moveFromRest(Builder<Units> &builder, double distance, double target, double endVelocity,
                  const Limits &limits, double noise) noexcept {
  const double side = endVelocity != 0.0 ? exact::signOf(endVelocity) : exact::signOf(distance);
  const double speed = side * endVelocity;
  const double ahead = side * distance;
  const Task task = {0.0, 0.0, ahead, speed, limits.velocity, 0.0, limits.ahead(), noise};
  const VelocityChange runUp(0.0, 0.0, speed, limits.ahead());
  if (speed == 0.0 || ahead >= runUp.distance(0.0, 0.0, speed) - noise) {
    Route route;
    (void)findRoute(route, task);
    builder.route(route, side, target, endVelocity);
    return;
  }
  // Back to where the run-up must begin.
  moveAndTurn(builder, task, side, target, endVelocity, Direct::Behind);
}

/// The motion between different rates for rising and falling: they hold for the magnitude of the
/// velocity.
template <class Units>
void moveOnOneSide(Builder<Units> &builder, const State &state, double distance, double target,
                   double endVelocity, const Limits &limits, double noise) noexcept {
  const double side =
      state.velocity != 0.0 ? exact::signOf(state.velocity) : exact::signOf(state.acceleration);
  const Task task = {side * state.velocity, side * state.acceleration,
                     side * distance,       side * endVelocity,
                     limits.velocity,       0.0,
                     limits.ahead(),        noise};
  Direct direct = Direct::Unknown;
  if (task.endVelocity >= 0.0 &&
      settledVelocity(task.velocity, task.acceleration, limits.jerk) >= 0.0) {
    Route route;
    if (findRoute(route, task)) {
      builder.route(route, side, target, endVelocity);
      return;
    }
    direct = Direct::Behind; // else it would have been found
  }
  moveAndTurn(builder, task, side, target, endVelocity, direct);
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
  if (scaled.acceleration == scaled.deceleration)
    builder.forward(VelocityChange(speed, rate, side * last, scaled.ahead()), side);
  else
    builder.forward(TurningChange(speed, rate, side * last, scaled.ahead()), side);
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
  const double settled = settledVelocity(velocity, acceleration, scaled.jerk);
  const bool alike = scaled.acceleration == scaled.deceleration;
  const auto beyond = [&](double to) noexcept {
    return (alike ? VelocityChange(velocity, acceleration, to, scaled.ahead())
                        .distance(velocity, acceleration, to)
                  : TurningChange(velocity, acceleration, to, scaled.ahead())
                        .distance(velocity, acceleration, to)) -
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
