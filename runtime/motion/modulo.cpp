#include "runtime/motion/modulo.hpp"

#include "runtime/axis/exact_math.hpp"
#include "runtime/axis/modulo_wrap.hpp"

namespace stride::motion {
namespace {

/// Positions this near (in periods) count as equal: rounding must not cost a whole turn.
constexpr double kSame = 1e-12;

double durationTo(const ModuloRequest &request, double target) noexcept {
  Profile profile;
  if (planTrapezoid(profile, request.position, request.velocity, target, request.limits) !=
      PlanError::None)
    return exact::kInfinity;
  return profile.duration;
}

} // namespace

bool resolveModulo(const ModuloRequest &request, double &target) noexcept {
  const double deceleration = request.limits.deceleration;
  if (!exact::isfinite(request.position) || !exact::isfinite(request.velocity) ||
      !exact::isfinite(request.target) || !exact::isfinite(request.period) ||
      !(request.period > 0.0) || !exact::isfinite(deceleration) || !(deceleration > 0.0))
    return false;

  const double period = request.period;
  const double wanted = axis::wrapPosition(request.target, period);
  const double velocity = request.velocity;
  const double halt = request.position + 0.5 * velocity * exact::fabs(velocity / deceleration);
  // Turns from the wanted position to the place where the axis would stop.
  const double turns = (halt - wanted) / period;
  if (!exact::isfinite(turns))
    return false;
  const double above = wanted + exact::ceil(turns - kSame) * period;
  const double below = wanted + exact::floor(turns + kSame) * period;

  Direction direction = request.direction;
  if (direction == Direction::Current) {
    if (velocity != 0.0)
      direction = velocity > 0.0 ? Direction::Positive : Direction::Negative;
    else
      direction =
          request.lastMotion == Direction::Negative ? Direction::Negative : Direction::Positive;
  }
  switch (direction) {
  case Direction::Positive:
    target = above;
    return true;
  case Direction::Negative:
    target = below;
    return true;
  case Direction::Shortest: {
    double way = wanted - axis::wrapPosition(request.position, period);
    if (way > 0.5 * period)
      way -= period;
    else if (way <= -0.5 * period)
      way += period;
    target = request.position + way;
    return true;
  }
  case Direction::Fastest: {
    const double up = durationTo(request, above);
    const double down = durationTo(request, below);
    target = up <= down ? above : below;
    return true;
  }
  case Direction::Current:
    break;
  }
  return false;
}

} // namespace stride::motion
