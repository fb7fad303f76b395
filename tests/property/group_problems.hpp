// Random machines for tests of axis groups.
#ifndef STRIDE_TESTS_PROPERTY_GROUP_PROBLEMS_HPP
#define STRIDE_TESTS_PROPERTY_GROUP_PROBLEMS_HPP

#include "group_machines.hpp"
#include "motion_problems.hpp"

#include <cmath>

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

/// One whose tool turns by axes of its own. Its tool axes may be anywhere.
inline Machine randomMachineWithToolAxes(Random &random) {
  const int kind = random.below(3);
  Machine machine =
      kind == 0 ? scaraWithTool() : (kind == 1 ? articulatedWithTool() : offsetWrist());
  machine.more = random.below(3);
  setRandomLimits(machine, random);
  return machine;
}

inline uint8_t toolAxesOf(const Machine &machine) {
  unsigned given = 0;
  return machine.arm().kinematics.splits(given) ? static_cast<uint8_t>(given) : uint8_t{0};
}

/// Whether the tool turns that little between two places, and so far from a wrist in line, that it
/// can turn by the shortest way; tool axes as bits.
inline bool turnsLittle(const Machine &machine, uint8_t given, const double (&from)[kAxes],
                        const double (&to)[kAxes]) {
  const auto kinematics = machine.arm().kinematics;
  bool little = kinematics.configurationOf(to) == kinematics.configurationOf(from);
  for (int k = 0; k < kArmAxes; ++k)
    little = little && (!group::isGiven(given, k) || std::fabs(to[k] - from[k]) < 40);
  const auto bends = [](double angle) { return std::fabs(std::sin(angle * M_PI / 180)) > 0.5; };
  return little && (machine.joints < 6 || (bends(from[4]) && bends(to[4])));
}

inline bool isOfMachine(const Machine &machine, int k) {
  return k < machine.joints || (k >= kArmAxes && k < kArmAxes + machine.more);
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GROUP_PROBLEMS_HPP
