#include "runtime/numeric/profile/parabolic_turn.hpp"

namespace stride::motion::parabolic {

// Over the velocity, the acceleration first rises with the jerk to the rate of braking, and ends by
// falling with the jerk to what may go on beyond standstill. Whoever has a greater acceleration at
// each velocity is faster and farther at each time, so no other turn is sooner.
Turn::Turn(double velocity, double from, const Rates &rates, double top) noexcept {
  const double jerk = rates.jerk;
  const double braking = rates.falling;
  const double twice = 2.0 * jerk;
  // All squares of accelerations: what the jerk alone leads to at standstill, and what is allowed.
  const double most = from * from - twice * velocity;
  const double weaker = exact::smaller(braking, rates.rising);
  const double allowed = exact::smaller(weaker * weaker, twice * top * (1.0 - 8.0 * kEpsilon));
  double peak = 0.0;
  double hold = 0.0;
  double last = 0.0;
  if (most <= allowed) {
    peak = last = exact::sqrt(most);
  } else {
    const double half = 0.5 * (most + allowed);
    const double highest = exact::larger(from, braking); // it may begin beyond its limit
    last = exact::sqrt(allowed);
    peak = exact::sqrt(half);
    if (peak > highest) {
      peak = braking;
      hold = (half - highest * highest) / (jerk * braking);
    } else if (from > peak) { // what is too much at the start is not gone by then
      peak = last = exact::sqrt(from * from + twice * velocity);
    }
  }
  phases[0] = {exact::fabs(peak - from) / jerk, peak < from ? -jerk : jerk, peak};
  phases[1] = {hold, 0.0, peak};
  phases[2] = {(peak - last) / jerk, -jerk, last};
  State state = {0.0, velocity, from};
  for (const Phase &phase : phases)
    state = after(state, phase);
  way = state.position;
  acceleration = last;
}

} // namespace stride::motion::parabolic
