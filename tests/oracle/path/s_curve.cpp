#include "tests/oracle/path/s_curve.hpp"

#include <algorithm>
#include <cmath>

namespace stride::oracle {

Phase after(const Phase &phase, double time) {
  const double a = phase.acceleration;
  const double v = phase.velocity;
  return {0.0, phase.jerk, phase.way + time * (v + time * (a / 2 + time * phase.jerk / 6)),
          v + time * (a + time * phase.jerk / 2), a + time * phase.jerk};
}

double changeTime(double change, double acceleration, double jerk) {
  change = std::fabs(change);
  if (change * jerk <= acceleration * acceleration)
    return 2.0 * std::sqrt(change / jerk);
  return change / acceleration + acceleration / jerk;
}

double changeWay(double from, double to, double acceleration, double jerk) {
  return 0.5 * (from + to) * changeTime(to - from, acceleration, jerk); // symmetric in time
}

std::vector<Phase> changePhases(double way, double from, double to, double acceleration,
                                double jerk) {
  std::vector<Phase> phases;
  const double whole = changeTime(to - from, acceleration, jerk);
  const double rise = std::min(0.5 * whole, acceleration / jerk);
  const double signedJerk = std::copysign(jerk, to - from);
  Phase state{0.0, 0.0, way, from, 0.0};
  const auto add = [&](double duration, double with) {
    if (duration <= 0.0)
      return;
    state.jerk = with;
    state.duration = duration;
    phases.push_back(state);
    state = after(state, duration);
  };
  add(rise, signedJerk);
  add(whole - 2.0 * rise, 0.0);
  add(rise, -signedJerk);
  return phases;
}

double restToRestTime(double way, double velocity, double acceleration, double jerk) {
  const double most = changeWay(0, velocity, acceleration, jerk);
  if (2.0 * most <= way)
    return 2.0 * changeTime(velocity, acceleration, jerk) + (way - 2.0 * most) / velocity;
  const double rampVelocity = acceleration * acceleration / jerk; // where a just reaches its limit
  if (2.0 * changeWay(0, rampVelocity, acceleration, jerk) >= way)
    return 4.0 * std::cbrt(way / (2.0 * jerk));
  // v (v / A + A / J) = way
  const double half = 0.5 * acceleration * acceleration / jerk;
  const double peak = std::sqrt(half * half + acceleration * way) - half;
  return 2.0 * changeTime(peak, acceleration, jerk);
}

} // namespace stride::oracle
