// Machines whose axes are moved as a group, for tests and benchmarks.
#ifndef STRIDE_TESTS_PROPERTY_GROUP_MACHINES_HPP
#define STRIDE_TESTS_PROPERTY_GROUP_MACHINES_HPP

#include "runtime/numeric/group/group_motion.hpp"
#include "runtime/numeric/kinematics/any_kinematics.hpp"
#include "runtime/numeric/kinematics/arms.hpp"
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/planar_arms.hpp"
#include "runtime/numeric/kinematics/portals.hpp"

#include "tests/support/cases.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace stride::test {

using group::AxisLimits;
using group::kAxes;

/// How many random cases a test takes. Others by hand: STRIDE_GROUP_CASES=10000.
inline int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_GROUP_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

/// A machine: its kinematics, its axes' limits, and where it is at first.
struct Machine {
  kinematics::AnyKinematics kinematics{};
  AxisLimits limits[kAxes]{};
  int joints = 0;
  int more = 0;
  double home[kAxes]{};
  double spread = 0; ///< How far from home the axes of targets are. [u]

  group::Arm arm() const {
    return {kinematics.ref(), joints, more, limits, kinematics.ref().configurationOf(home)};
  }
};

inline Machine gantry() {
  Machine machine;
  machine.kinematics.setArm(kinematics::ArmKind::Gantry3, kinematics::Gantry3{});
  machine.joints = 3;
  machine.spread = 200;
  return machine;
}

inline Machine scara() {
  Machine machine;
  machine.kinematics.setArm(kinematics::ArmKind::Scara2Z, kinematics::Scara2Z{{400, 300}});
  machine.kinematics.setHand(kinematics::HandKind::TurningAxis, kinematics::TurningAxis{});
  machine.joints = 4;
  const double home[] = {10, 80, 20, -30};
  std::copy(std::begin(home), std::end(home), machine.home);
  machine.spread = 25;
  return machine;
}

inline Machine articulated() {
  Machine machine;
  kinematics::ArmRrr arm{};
  arm.d1 = 400;
  arm.a1 = 100;
  arm.a2 = 500;
  arm.a3 = 50;
  arm.d4 = 450;
  machine.kinematics.setArm(kinematics::ArmKind::ArmRrr, arm);
  machine.kinematics.setHand(kinematics::HandKind::Wrist3, kinematics::Wrist3{{0, 0, 80}});
  machine.joints = 6;
  const double home[] = {5, -60, 30, 12, 60, -20};
  std::copy(std::begin(home), std::end(home), machine.home);
  machine.spread = 12;
  return machine;
}

/// With a wrist whose axes do not meet.
inline Machine offsetWrist() {
  Machine machine;
  machine.kinematics.setArm(kinematics::ArmKind::OffsetWristArm,
                            kinematics::OffsetWristArm{160, -425, -392, 133, 100, 97});
  machine.joints = 6;
  const double home[] = {5, -60, 70, 20, 80, -20};
  std::copy(std::begin(home), std::end(home), machine.home);
  machine.spread = 12;
  return machine;
}

/// A Scara whose tool is beside its turning axis.
inline Machine scaraWithTool() {
  Machine machine = scara();
  machine.kinematics.setHand(kinematics::HandKind::TurningAxis,
                             kinematics::TurningAxis{{120, 30, 10}});
  return machine;
}

/// With a tool that is beside all axes of the wrist.
inline Machine articulatedWithTool() {
  Machine machine = articulated();
  machine.kinematics.setHand(kinematics::HandKind::Wrist3, kinematics::Wrist3{{40, -30, 80}});
  return machine;
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GROUP_MACHINES_HPP
