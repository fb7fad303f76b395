// Random machines for tests of axis groups.
#ifndef STRIDE_TESTS_PROPERTY_GROUP_PROBLEMS_HPP
#define STRIDE_TESTS_PROPERTY_GROUP_PROBLEMS_HPP

#include "group_machines.hpp"
#include "motion_problems.hpp"

namespace stride::test {

using group::kArmAxes;

/// Limits of all axes.
inline void setRandomLimits(Machine &machine, Random &random) {
  for (int k = 0; k < kAxes; ++k) {
    AxisLimits &limits = machine.limits[k];
    limits.velocity = random.uniform(100, 500);
    limits.acceleration = limits.velocity * random.magnitude(0, 1);
    limits.jerk = limits.acceleration * random.magnitude(0.5, 2);
    limits.low = -1e4;
    limits.high = 1e4;
  }
}

inline Machine randomMachine(Random &random) {
  const int kind = random.below(3);
  Machine machine = kind == 0 ? gantry() : (kind == 1 ? scara() : articulated());
  machine.more = random.below(3);
  setRandomLimits(machine, random);
  return machine;
}

inline bool isOfMachine(const Machine &machine, int k) {
  return k < machine.joints || (k >= kArmAxes && k < kArmAxes + machine.more);
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GROUP_PROBLEMS_HPP
