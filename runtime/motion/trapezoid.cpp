#include "runtime/motion/trapezoid.hpp"

#include "runtime/axis/exact_math.hpp"

namespace stride::motion {
namespace {

constexpr double kEpsilon = 0x1p-52;

/// Binary exponent of |x|, 0.5 <= |x| / 2^e < 1; far below every other for 0.
int exponentOf(double x) noexcept {
  if (x == 0.0)
    return -4000;
  int exponent = 0;
  (void)exact::frexp(x, &exponent);
  return exponent;
}

int maxOf(int a, int b) noexcept { return a > b ? a : b; }

/// Units in which the problem's numbers are near 1. All are powers of two, so that going to them
/// and back is exact and the plan does not depend on the user's units.
struct Scale {
  int length = 0;       ///< [u]
  int velocity = 0;     ///< [u/s]
  int acceleration = 0; ///< [u/s^2]
  int time = 0;         ///< [s]

  static Scale of(double distance, double velocity, double acceleration,
                  double deceleration) noexcept {
    Scale scale;
    const double weaker = acceleration < deceleration ? acceleration : deceleration;
    scale.acceleration = exponentOf(weaker);
    scale.length = maxOf(exponentOf(distance), 2 * exponentOf(velocity) - exponentOf(deceleration));
    if (((scale.length - scale.acceleration) & 1) != 0)
      ++scale.acceleration;
    scale.time = (scale.length - scale.acceleration) / 2;
    scale.velocity = scale.length - scale.time;
    return scale;
  }
};

/// Appends pieces of constant acceleration to a profile; everything in scaled units except the
/// anchors' positions.
class Builder {
public:
  Builder(Profile &profile, const Scale &scale, double sign) noexcept
      : profile_(profile), scale_(scale), sign_(sign) {
    profile_.count = 0;
  }

  /// A piece anchored at its start.
  void add(double duration, double position, double velocity, double acceleration) noexcept {
    if (!(duration > 0.0))
      return;
    append(time_, position, velocity, acceleration);
    time_ += seconds(duration);
  }

  /// The last piece: brakes from `velocity` to rest at `target` and is anchored there.
  void finish(double velocity, double deceleration, double target) noexcept {
    const double duration = velocity / deceleration;
    const double end = time_ + seconds(duration);
    if (duration > 0.0)
      append(end, target, 0.0, -deceleration);
    time_ = end;
    profile_.duration = end;
    profile_.end = {target, 0.0, 0.0};
  }

  /// A distance in the direction of motion, in user units and with its sign.
  [[nodiscard]] double length(double scaled) const noexcept {
    return sign_ * exact::ldexp(scaled, scale_.length);
  }

  /// Whether every number of the finished profile can be represented.
  [[nodiscard]] bool valid() const noexcept {
    bool good = exact::isfinite(profile_.duration) && exact::isfinite(profile_.end.position);
    for (int32_t i = 0; i < profile_.count; ++i) {
      const Segment &segment = profile_.segments[i];
      good = good && exact::isfinite(segment.origin.position) &&
             exact::isfinite(segment.origin.velocity);
    }
    return good;
  }

private:
  [[nodiscard]] double seconds(double scaled) const noexcept {
    return exact::ldexp(scaled, scale_.time);
  }

  void append(double reference, double position, double velocity, double acceleration) noexcept {
    Segment &segment = profile_.segments[profile_.count++];
    segment.start = time_;
    segment.reference = reference;
    segment.origin.position = position;
    segment.origin.velocity = sign_ * exact::ldexp(velocity, scale_.velocity);
    segment.origin.acceleration = sign_ * exact::ldexp(acceleration, scale_.acceleration);
    segment.jerk = 0.0;
  }

  Profile &profile_;
  Scale scale_;
  double sign_;
  double time_ = 0.0;
};

void clear(Profile &profile, double position) noexcept {
  profile.count = 0;
  profile.duration = 0.0;
  profile.end = {position, 0.0, 0.0};
}

bool isLimit(double x) noexcept { return exact::isfinite(x) && x > 0.0; }

/// The move that remains when the axis moves with `v` >= 0 towards a target which is `rest` >= 0
/// beyond the point where it would stop. `position` is the axis's place, in user units.
void moveAhead(Builder &builder, double position, double v, double rest, double target,
               double vLimit, double acceleration, double deceleration) noexcept {
  if (v > vLimit) {
    builder.add((v - vLimit) / deceleration, position, v, -deceleration);
    const double braking = (v - vLimit) * ((v + vLimit) / (2.0 * deceleration));
    builder.add(rest / vLimit, position + builder.length(braking), vLimit, 0.0);
    builder.finish(vLimit, deceleration, target);
    return;
  }
  // 1 / harmonic = 1 / acceleration + 1 / deceleration.
  const double harmonic = acceleration <= deceleration
                              ? acceleration / (1.0 + acceleration / deceleration)
                              : deceleration / (1.0 + deceleration / acceleration);
  const double peak = exact::sqrt(v * v + 2.0 * rest * harmonic);
  if (peak <= vLimit) {
    const double rise = 2.0 * rest * harmonic / (acceleration * (peak + v));
    builder.add(rise, position, v, acceleration);
    builder.finish(peak, deceleration, target);
    return;
  }
  const double gain = (vLimit - v) * (vLimit + v);
  const double cruise = rest - gain / (2.0 * harmonic);
  builder.add((vLimit - v) / acceleration, position, v, acceleration);
  builder.add(cruise / vLimit, position + builder.length(gain / (2.0 * acceleration)), vLimit, 0.0);
  builder.finish(vLimit, deceleration, target);
}

} // namespace

PlanError planTrapezoid(Profile &profile, double position, double velocity, double target,
                        const TrapezoidLimits &limits) noexcept {
  clear(profile, position);
  if (!exact::isfinite(position) || !exact::isfinite(velocity) || !exact::isfinite(target))
    return PlanError::InvalidState;
  if (!isLimit(limits.velocity) || !isLimit(limits.acceleration) || !isLimit(limits.deceleration))
    return PlanError::InvalidLimit;
  const double distance = target - position;
  if (!exact::isfinite(distance))
    return PlanError::Unrepresentable;
  if (distance == 0.0 && velocity == 0.0) {
    profile.end.position = target;
    return PlanError::None;
  }

  const Scale scale = Scale::of(distance, velocity, limits.acceleration, limits.deceleration);
  const double acceleration = exact::ldexp(limits.acceleration, -scale.acceleration);
  const double deceleration = exact::ldexp(limits.deceleration, -scale.acceleration);
  const double vLimit = exact::ldexp(limits.velocity, -scale.velocity);
  const double d = exact::ldexp(distance, -scale.length);
  const double v = exact::ldexp(velocity, -scale.velocity);
  if (!exact::isfinite(acceleration) || !exact::isfinite(deceleration) || !exact::isfinite(v))
    return PlanError::Unrepresentable;

  // Where the axis would come to rest, and what is missing from there to the target.
  const double stopping = 0.5 * v * exact::fabs(v / deceleration);
  const double rest = d - stopping;

  // A rest that is only rounding (the axis is on its braking ramp already): keep to the ramp with a
  // deceleration adjusted in its last digits instead of adding a tiny move back.
  const double noise =
      4.0 * kEpsilon *
      (exact::fabs(stopping) + exact::fabs(d) +
       exact::ldexp(exact::fabs(position) > exact::fabs(target) ? exact::fabs(position)
                                                                : exact::fabs(target),
                    -scale.length));
  if (exact::fabs(rest) <= noise && exact::fabs(rest) <= 5e-10 * exact::fabs(stopping)) {
    Builder builder(profile, scale, v < 0.0 ? -1.0 : 1.0);
    const double speed = exact::fabs(v);
    builder.finish(speed, speed * (speed / (2.0 * exact::fabs(d))), target);
    if (builder.valid())
      return PlanError::None;
    clear(profile, position);
    return PlanError::Unrepresentable;
  }

  const double sign = rest < 0.0 ? -1.0 : 1.0;
  const double towards = sign * v;
  Builder builder(profile, scale, sign);
  if (towards >= 0.0) {
    moveAhead(builder, position, towards, exact::fabs(rest), target, vLimit, acceleration,
              deceleration);
  } else {
    builder.add(-towards / deceleration, position, towards, deceleration);
    const double turn = position + builder.length(sign * stopping);
    moveAhead(builder, turn, 0.0, exact::fabs(rest), target, vLimit, acceleration, deceleration);
  }
  if (builder.valid())
    return PlanError::None;
  clear(profile, position);
  return PlanError::Unrepresentable;
}

PlanError planStop(Profile &profile, double position, double velocity,
                   double deceleration) noexcept {
  clear(profile, position);
  if (!exact::isfinite(position) || !exact::isfinite(velocity))
    return PlanError::InvalidState;
  if (!isLimit(deceleration))
    return PlanError::InvalidLimit;
  if (velocity == 0.0)
    return PlanError::None;
  const double target = position + 0.5 * velocity * exact::fabs(velocity / deceleration);
  Builder builder(profile, Scale{}, velocity < 0.0 ? -1.0 : 1.0);
  builder.finish(exact::fabs(velocity), deceleration, target);
  if (builder.valid())
    return PlanError::None;
  clear(profile, position);
  return PlanError::Unrepresentable;
}

} // namespace stride::motion
