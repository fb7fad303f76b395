#include "runtime/numeric/profile/modulo.hpp"

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/modulo_wrap.hpp"

namespace stride::motion {
namespace {

/// Positions this near (in periods) count as equal: rounding must not cost a whole turn.
constexpr double kSame = 1e-12;

double durationTo(const ModuloRequest &request, double target) noexcept {
  Profile profile;
  if (planMove(profile, request.start, target, request.endVelocity, request.dynamics) !=
      PlanError::None)
    return exact::kInfinity;
  return profile.duration;
}

/// Where the axis goes on to, without a demand.
Direction present(const ModuloRequest &request) noexcept {
  const State &start = request.start;
  double motion = start.velocity;
  if (motion == 0.0 && request.dynamics.ramp != RampType::Trapezoid)
    motion = start.acceleration;
  if (motion != 0.0)
    return motion > 0.0 ? Direction::Positive : Direction::Negative;
  return request.lastMotion == Direction::Negative ? Direction::Negative : Direction::Positive;
}

/// The nearest place where the axis can have the velocity; false if the request is not valid.
bool placeOf(const ModuloRequest &request, double velocity, double &place) noexcept {
  Profile profile;
  if (planVelocity(profile, request.start, velocity, request.dynamics) != PlanError::None)
    return false;
  place = profile.end.position;
  return true;
}

double nearest(double position, double wanted, double period) noexcept {
  double way = wanted - numeric::wrapPosition(position, period);
  if (way > 0.5 * period)
    way -= period;
  else if (way <= -0.5 * period)
    way += period;
  return position + way;
}

} // namespace

bool resolveModulo(const ModuloRequest &request, double &target) noexcept {
  if (!exact::isfinite(request.target) || !exact::isfinite(request.period) ||
      !(request.period > 0.0))
    return false;
  const Direction direction =
      request.direction == Direction::Current ? present(request) : request.direction;
  double velocity = request.endVelocity;
  if ((direction == Direction::Positive && velocity < 0.0) ||
      (direction == Direction::Negative && velocity > 0.0))
    velocity = 0.0;
  double place = 0.0;
  if (!placeOf(request, velocity, place))
    return false;

  const double period = request.period;
  const double wanted = numeric::wrapPosition(request.target, period);
  // Turns from the wanted position to the place where the axis would be.
  const double turns = (place - wanted) / period;
  if (!exact::isfinite(turns))
    return false;
  // A run-up would need the whole of its way; at rest a last digit is easily made good.
  const double same = velocity == 0.0 ? kSame : 0.0;
  const double above = wanted + exact::ceil(turns - same) * period;
  const double below = wanted + exact::floor(turns + same) * period;
  switch (direction) {
  case Direction::Positive:
    target = above;
    return true;
  case Direction::Negative:
    target = below;
    return true;
  case Direction::Shortest:
    target = nearest(request.start.position, wanted, period);
    return true;
  case Direction::Fastest:
    target = durationTo(request, above) <= durationTo(request, below) ? above : below;
    return true;
  case Direction::Current:
    break;
  }
  return false;
}

} // namespace stride::motion
