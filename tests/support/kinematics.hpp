// What models in tests need of motion and of circles; it uses nothing of the code that they judge.
#ifndef STRIDE_TESTS_SUPPORT_KINEMATICS_HPP
#define STRIDE_TESTS_SUPPORT_KINEMATICS_HPP

#include <cmath>

namespace stride::test {

/// The short way along a circle to where `way` leads: in [-period/2, period/2].
inline double shortWay(double way, double period) { return std::remainder(way, period); }

/// Where `position` is on a circle: in [0, period).
inline double onCircle(double position, double period) {
  const double nearest = shortWay(position, period); // exact
  const double place = nearest < 0.0 ? nearest + period : nearest;
  return place < period ? std::fabs(place) : 0.0; // a little less than nothing is rounded up
}

/// Position, velocity and acceleration (any struct of them) `t` seconds later at constant jerk.
template <class State> State movedOn(const State &from, double jerk, double t) {
  const long double a = from.acceleration;
  const long double v = from.velocity;
  const long double time = t;
  State to = from;
  to.acceleration = static_cast<double>(a + jerk * time);
  to.velocity = static_cast<double>(v + a * time + jerk * time * time / 2);
  to.position = static_cast<double>(from.position + v * time + a * time * time / 2 +
                                    jerk * time * time * time / 6);
  return to;
}

} // namespace stride::test

#endif
