#include "runtime/numeric/profile/ramps.hpp"

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion {
namespace {

constexpr double kEpsilon = 0x1p-52;
constexpr double kPi = 3.14159265358979323846;

/// So many units of the scaled problem are as good as no limit. Rates have squares.
constexpr double kUnlimited = 0x1p400;
constexpr double kUnlimitedJerk = 0x1p1000;

double clamped(double limit, int exponent, double most) noexcept {
  return exact::smaller(exact::ldexp(limit, -exponent), most);
}

/// The limits in scaled units.
struct Limits {
  RampType ramp;
  double velocity;
  double acceleration;
  double deceleration;
  double jerk;

  Limits(const Dynamics &dynamics, const Scale &scale) noexcept
      : ramp(dynamics.ramp), velocity(clamped(dynamics.velocity, scale.velocity, kUnlimited)),
        acceleration(clamped(dynamics.acceleration, scale.acceleration, kUnlimited)),
        deceleration(clamped(dynamics.deceleration, scale.acceleration, kUnlimited)),
        jerk(ramp == RampType::Trapezoid
                 ? 0.0
                 : clamped(dynamics.jerk, scale.acceleration - scale.time, kUnlimitedJerk)) {}

  /// Whether a ramp's time is in proportion to its change of velocity.
  [[nodiscard]] bool isLinear() const noexcept { return ramp != RampType::SigmoidLimited; }

  /// How long a ramp lasts.
  [[nodiscard]] double duration(double change, double rate) const noexcept {
    if (isLinear())
      return change / rate;
    return kPi * exact::larger(0.5 * change / rate, exact::sqrt(0.5 * change / jerk));
  }
};

/// A change of velocity that keeps its sign.
struct Ramp {
  double from;
  double to;
  double change; ///< to - from; exact also where both are nearly equal.
  double rate;   ///< The limit that counts, with its sign.
  double duration;

  [[nodiscard]] double way() const noexcept { return 0.5 * (from + to) * duration; }
};

/// Any change of velocity: through standstill it takes two ramps.
struct Change {
  Ramp ramps[2];
  int count = 0;

  Change() noexcept = default;

  /// `change` is to - from, as exactly as the caller knows it.
  Change(double from, double to, double change, const Limits &limits) noexcept {
    if ((from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0)) {
      add(from, 0.0, -from, limits.deceleration, limits);
      add(0.0, to, to, limits.acceleration, limits);
    } else {
      const bool faster = from + to < 0.0 ? change < 0.0 : change > 0.0;
      add(from, to, change, faster ? limits.acceleration : limits.deceleration, limits);
    }
  }
  Change(double from, double to, const Limits &limits) noexcept
      : Change(from, to, to - from, limits) {}

  [[nodiscard]] double way() const noexcept {
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
      sum += ramps[i].way();
    return sum;
  }
  /// What its ways add up to regardless of their direction.
  [[nodiscard]] double travel() const noexcept {
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
      sum += exact::fabs(ramps[i].way());
    return sum;
  }

private:
  void add(double from, double to, double change, double rate, const Limits &limits) noexcept {
    const double size = exact::fabs(change);
    if (!(size > 0.0))
      return;
    ramps[count++] = {from, to, change, change < 0.0 ? -rate : rate, limits.duration(size, rate)};
  }
};

/// How to reach a place with a velocity.
struct Route {
  Change head;
  double cruise = 0.0;   ///< Time at `velocity`.
  double velocity = 0.0; ///< Between head and tail.
  Change tail;           ///< Ends at the target.

  [[nodiscard]] double way() const noexcept { return head.way() + tail.way(); }
};

/// The harmonic sum of the rates: raising the velocity between two ramps from v to w takes
/// (w^2 - v^2) / (2 * harmonic) more way.
double harmonicOf(double acceleration, double deceleration) noexcept {
  return acceleration <= deceleration ? acceleration / (1.0 + acceleration / deceleration)
                                      : deceleration / (1.0 + deceleration / acceleration);
}

/// Finds the fastest way to a `distance` that is at least that of the direct change from `from` to
/// `to`. The velocity between the ramps may be anything from that of the direct change to the
/// limit.
Route findForward(double from, double to, double distance, const Limits &limits) noexcept {
  const double top = exact::larger(from, to);
  const bool within = top <= limits.velocity;
  const bool crosses = !within && exact::smaller(from, to) <= limits.velocity;
  double base = exact::larger(within || crosses ? top : exact::smaller(from, to), 0.0);

  const auto via = [&](double excess, double velocity) noexcept {
    Route route;
    route.velocity = velocity;
    route.head = Change(from, velocity, (base - from) + excess, limits);
    route.tail = Change(velocity, to, (to - base) - excess, limits);
    return route;
  };
  const auto beyond = [&](double excess) noexcept {
    return via(excess, base + excess).way() - distance;
  };
  const double gap = distance - via(0.0, base).way();
  if (!(gap > 0.0)) {
    if (limits.isLinear() || !(top < 0.0))
      return via(0.0, base);
    // The jerk makes a small change take more time than its share of a large one: a detour through
    // a lower speed does without standstill.
    base = top;
    const double excess = bracketedRoot(beyond, 0.0, -top);
    return via(excess, base + excess);
  }
  Route fastest = via(limits.velocity - base, limits.velocity);
  const double missing = distance - fastest.way();
  // Ramps in proportion to their change can be divided by the limit without a difference.
  if (missing >= 0.0 || (limits.isLinear() && crosses)) {
    fastest.cruise = exact::larger(missing, 0.0) / limits.velocity;
    return fastest;
  }
  const double up = limits.velocity < base ? -1.0 : 1.0;
  const double rate = harmonicOf(limits.acceleration, limits.deceleration);
  const auto excessAt = [&](double harmonic) noexcept {
    const double peak = exact::sqrt(exact::larger(base * base + up * 2.0 * harmonic * gap, 0.0));
    return up * 2.0 * harmonic * gap / (peak + base);
  };
  if (limits.isLinear()) {
    const double excess = excessAt(rate);
    return via(excess, base + excess);
  }
  double high = limits.velocity - base;
  if (within) { // the limit of the rate alone allows no more
    const double most = excessAt(rate * (2.0 / kPi)) * (1.0 + 8.0 * kEpsilon);
    if (most < high && beyond(most) >= 0.0)
      high = most;
  }
  const double excess = bracketedRoot(beyond, 0.0, high);
  return via(excess, base + excess);
}

/// Puts the pieces of a motion, in scaled units, into a profile.
class Builder {
public:
  Builder(Profile &profile, const Scale &scale, const Limits &limits, const State &start) noexcept
      : profile_(profile), scale_(scale), limits_(limits), place_(start.position),
        velocity_(exact::ldexp(start.velocity, -scale.velocity)) {
    profile.count = 0;
    profile.duration = 0.0;
    if (limits.ramp != RampType::Trapezoid)
      settle(exact::ldexp(start.acceleration, -scale.acceleration));
  }

  /// The velocity when the acceleration of the start has been taken away, and the way until then.
  [[nodiscard]] double velocity() const noexcept { return velocity_; }
  [[nodiscard]] double settling() const noexcept { return settling_; }

  void route(const Route &route, double sign, double target) noexcept {
    for (int i = 0; i < route.head.count; ++i)
      ahead(route.head.ramps[i], sign);
    if (route.cruise > 0.0) {
      append(profile_.duration, place_, sign * route.velocity, 0.0, 0.0, 0.0);
      profile_.duration += seconds(route.cruise);
    }
    arrive(route.tail, sign, target);
  }

  /// A change of velocity from here on.
  void change(const Change &change) noexcept { arrive(change, 1.0, place_ + length(change.way())); }

  /// Ends the profile here. False if a number of it cannot be represented; then it is empty.
  bool finish(double velocity, const State &start) noexcept {
    profile_.end = {place_, velocity, 0.0};
    bool good = exact::isfinite(profile_.duration) && exact::isfinite(place_) && reachable_;
    for (int32_t i = 0; i < profile_.count; ++i) {
      const Segment &segment = profile_.segments[i];
      good = good && exact::isfinite(segment.reference) && exact::isfinite(segment.jerk) &&
             exact::isfinite(segment.frequency) && exact::isfinite(segment.origin.position) &&
             exact::isfinite(segment.origin.velocity) &&
             exact::isfinite(segment.origin.acceleration);
    }
    if (!good)
      profile_ = Profile{{}, 0, 0.0, {start.position, 0.0, 0.0}};
    return good;
  }

private:
  [[nodiscard]] double seconds(double scaled) const noexcept {
    return exact::ldexp(scaled, scale_.time);
  }
  [[nodiscard]] double length(double scaled) const noexcept {
    return exact::ldexp(scaled, scale_.length);
  }

  /// Takes `acceleration` away with the jerk.
  void settle(double acceleration) noexcept {
    const double duration = exact::fabs(acceleration) / limits_.jerk;
    if (!(duration > 0.0))
      return;
    append(0.0, place_, velocity_, acceleration, acceleration > 0.0 ? -limits_.jerk : limits_.jerk,
           0.0);
    settling_ = (velocity_ + acceleration * duration * (1.0 / 3.0)) * duration;
    velocity_ += 0.5 * acceleration * duration;
    place_ += length(settling_);
    profile_.duration = seconds(duration);
  }

  /// A ramp from here on.
  void ahead(const Ramp &ramp, double sign) noexcept {
    addRamp(ramp, sign, profile_.duration, place_, ramp.from, 1.0);
    profile_.duration += seconds(ramp.duration);
    place_ += sign * length(ramp.way());
  }

  /// The last ramps; each is anchored at its end.
  void arrive(const Change &change, double sign, double target) noexcept {
    double left = change.way();
    reachable_ = exact::isfinite(place_) && exact::isfinite(target - sign * length(left));
    for (int i = 0; i < change.count; ++i) {
      const Ramp &ramp = change.ramps[i];
      const double end = profile_.duration + seconds(ramp.duration);
      left -= ramp.way();
      const double place = i + 1 < change.count ? target - sign * length(left) : target;
      addRamp(ramp, sign, end, place, ramp.to, -1.0);
      profile_.duration = end;
    }
    place_ = target;
  }

  /// Appends a ramp that is anchored at its start (`side` 1) or its end (-1).
  void addRamp(const Ramp &ramp, double sign, double reference, double position, double velocity,
               double side) noexcept {
    if (limits_.ramp == RampType::Trapezoid) {
      append(reference, position, sign * velocity, sign * ramp.rate, 0.0, 0.0);
      return;
    }
    const double frequency = kPi / ramp.duration;
    const double jerk = 0.5 * ramp.change * frequency * frequency;
    append(reference, position, sign * velocity, 0.0, sign * side * jerk, frequency);
  }

  void append(double reference, double position, double velocity, double acceleration, double jerk,
              double frequency) noexcept {
    Segment &segment = profile_.segments[profile_.count++];
    segment.start = profile_.duration;
    segment.reference = reference;
    segment.origin.position = position;
    segment.origin.velocity = exact::ldexp(velocity, scale_.velocity);
    segment.origin.acceleration = exact::ldexp(acceleration, scale_.acceleration);
    segment.jerk = exact::ldexp(jerk, scale_.acceleration - scale_.time);
    segment.frequency = exact::ldexp(frequency, -scale_.time);
  }

  Profile &profile_;
  Scale scale_;
  const Limits &limits_;
  double place_;    ///< Where the axis is. [u]
  double velocity_; ///< How fast it is after settling.
  double settling_ = 0.0;
  bool reachable_ = true; ///< Whether all places can be represented.
};

Scale scaleOf(double distance, const State &start, double endVelocity,
              const Dynamics &dynamics) noexcept {
  double fastest = exact::larger(exact::fabs(start.velocity), exact::fabs(endVelocity));
  if (dynamics.ramp != RampType::Trapezoid)
    fastest =
        exact::larger(fastest, start.acceleration * (start.acceleration / (2.0 * dynamics.jerk)));
  return Scale::of(distance, fastest, dynamics.acceleration, dynamics.deceleration);
}

PlanError check(const State &start, double endVelocity, const Dynamics &dynamics) noexcept {
  if (!exact::isfinite(start.position) || !exact::isfinite(start.velocity) ||
      !exact::isfinite(endVelocity))
    return PlanError::InvalidState;
  if (!exact::isPositive(dynamics.acceleration) || !exact::isPositive(dynamics.deceleration))
    return PlanError::InvalidLimit;
  if (dynamics.ramp == RampType::Trapezoid)
    return PlanError::None;
  if (!exact::isfinite(start.acceleration))
    return PlanError::InvalidState;
  return exact::isPositive(dynamics.jerk) ? PlanError::None : PlanError::InvalidLimit;
}

void clear(Profile &profile, const State &start) noexcept {
  profile.count = 0;
  profile.duration = 0.0;
  profile.end = {start.position, 0.0, 0.0};
}

/// Whether the axis already moves at a constant velocity.
bool isSteady(const State &start, const Dynamics &dynamics) noexcept {
  return dynamics.ramp == RampType::Trapezoid || start.acceleration == 0.0;
}

/// What is rounding of a way in scaled units.
double noiseOf(double travel, double way, double settling, const State &start, double target,
               const Scale &scale) noexcept {
  const double places = exact::larger(exact::fabs(start.position), exact::fabs(target));
  return 4.0 * kEpsilon *
         (travel + exact::fabs(way) + exact::fabs(settling) + exact::ldexp(places, -scale.length));
}

PlanError result(bool representable) noexcept {
  return representable ? PlanError::None : PlanError::Unrepresentable;
}

} // namespace

PlanError planRampMove(Profile &profile, const State &start, double target, double endVelocity,
                       const Dynamics &dynamics) noexcept {
  clear(profile, start);
  if (const PlanError error = check(start, endVelocity, dynamics); error != PlanError::None)
    return error;
  if (!exact::isfinite(target))
    return PlanError::InvalidState;
  if (!exact::isPositive(dynamics.velocity))
    return PlanError::InvalidLimit;
  const double distance = target - start.position;
  if (!exact::isfinite(distance))
    return PlanError::Unrepresentable;
  if (distance == 0.0 && start.velocity == endVelocity && isSteady(start, dynamics)) {
    profile.end = {target, endVelocity, 0.0};
    return PlanError::None;
  }

  const Scale scale = scaleOf(distance, start, endVelocity, dynamics);
  const Limits limits(dynamics, scale);
  Builder builder(profile, scale, limits, start);
  const double last = exact::ldexp(endVelocity, -scale.velocity);
  const double from = builder.velocity();
  const double way = exact::ldexp(distance, -scale.length) - builder.settling();
  const Change direct(from, last, limits);
  const double gap = way - direct.way();

  // Less than rounding: adding a tiny move, or one back, would be wrong.
  const double noise = noiseOf(direct.travel(), way, builder.settling(), start, target, scale);
  if (exact::fabs(gap) <= noise) {
    Route route;
    route.tail = direct;
    builder.route(route, 1.0, target);
  } else {
    const double sign = gap < 0.0 ? -1.0 : 1.0;
    builder.route(findForward(sign * from, sign * last, sign * way, limits), sign, target);
  }
  return result(builder.finish(endVelocity, start));
}

PlanError planRampVelocity(Profile &profile, const State &start, double velocity,
                           const Dynamics &dynamics) noexcept {
  clear(profile, start);
  if (const PlanError error = check(start, velocity, dynamics); error != PlanError::None)
    return error;
  if (start.velocity == velocity && isSteady(start, dynamics)) {
    profile.end = {start.position, velocity, 0.0};
    return PlanError::None;
  }
  const Scale scale = scaleOf(0.0, start, velocity, dynamics);
  const Limits limits(dynamics, scale);
  Builder builder(profile, scale, limits, start);
  builder.change(Change(builder.velocity(), exact::ldexp(velocity, -scale.velocity), limits));
  return result(builder.finish(velocity, start));
}

double reachableByRamp(const State &start, double target, double wanted,
                       const Dynamics &dynamics) noexcept {
  const double distance = target - start.position;
  const Scale scale = scaleOf(distance, start, wanted, dynamics);
  const Limits limits(dynamics, scale);
  Profile unused;
  const Builder builder(unused, scale, limits, start);
  double from = builder.velocity();
  double way = exact::ldexp(distance, -scale.length) - builder.settling();
  const double halt = Change(from, 0.0, limits).way();
  double side = way - halt; // the way of the motion to the target
  if (exact::fabs(side) <=
      noiseOf(exact::fabs(halt), way, builder.settling(), start, target, scale))
    side = from;
  const double sign = side < 0.0 ? -1.0 : 1.0;
  const double speed = sign * exact::ldexp(wanted, -scale.velocity);
  if (!(speed > 0.0) || side == 0.0 || !exact::isfinite(way))
    return 0.0;
  from *= sign;
  way *= sign;
  if (from < 0.0) { // it turns first
    way -= sign * halt;
    from = 0.0;
  }
  if (!(Change(from, speed, limits).way() > way))
    return wanted;
  double reached = 0.0;
  if (limits.isLinear()) {
    const double rise = 2.0 * limits.acceleration * way;
    reached = from + rise / (from + exact::sqrt(from * from + rise));
  } else if (speed > from) {
    const auto beyond = [&](double excess) noexcept {
      return Change(from, from + excess, excess, limits).way() - way;
    };
    reached = from + bracketedRoot(beyond, 0.0, speed - from);
  } else { // the jerk makes a small change take more way than a larger one
    const auto beyond = [&](double to) noexcept { return Change(from, to, limits).way() - way; };
    reached = bracketedRoot(beyond, 0.0, speed);
  }
  // Not the last digits: they must not make the way too short.
  reached *= 1.0 - 4.0 * kEpsilon;
  if (speed > from)
    reached = exact::larger(reached, from);
  return exact::ldexp(sign * exact::smaller(reached, speed), scale.velocity);
}

} // namespace stride::motion
