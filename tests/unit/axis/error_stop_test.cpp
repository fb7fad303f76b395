// How an axis brakes into error stop: under its own ramp type, and hard where no way is left.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace axis = stride::axis;
namespace state = stride::axis::state;
using MoveVelocity = ::st::SM_PLCopen::MC_MoveVelocity;

constexpr double kCycle = 0.001;
constexpr double kDeceleration = 800; ///< More than the command's.
constexpr double kJerk = 20000;

/// An axis that accelerates to 90 u/s with 500 u/s².
struct Moving {
  Moving(int16_t ramp, int cycles) {
    rig.axis.eRampType = ramp;
    rig.axis.fJerk = kJerk;
    rig.axis.fSWMaxDeceleration = kDeceleration;
    rig.powerUp();
    move.Axis = &rig.axis;
    move.Velocity = 90;
    move.Acceleration = 500;
    move.Deceleration = 300;
    move.Direction = 1;
    for (int i = 0; i < cycles; ++i)
      rig.cycle([&] { rig.call(move, true); });
  }

  AxisRig rig{kCycle};
  MoveVelocity move = fresh<MoveVelocity>();
};

class Ramps : public testing::TestWithParam<int> {};

TEST_P(Ramps, AnErrorStopKeepsTheJerk) {
  const auto ramp = static_cast<int16_t>(GetParam());
  // Within the jerk's first phase, while it accelerates, near its velocity, at its velocity.
  for (const int cycles : {5, 60, 190, 205, 400}) {
    SCOPED_TRACE("after " + std::to_string(cycles) + " cycles");
    Moving m(ramp, cycles);
    auto &ref = m.rig.axis;
    ASSERT_GT(ref.fSetVelocity, 0);
    int braking = 0;
    double largest = 0;
    while (braking == 0 || (ref.stPlanner.bActive != 0 && braking < 2000)) {
      const double p = ref.fSetPosition;
      const double v = ref.fSetVelocity;
      const double a = ref.fSetAcceleration;
      m.rig.idle();
      ++braking;
      ASSERT_EQ(ref.nAxisState, state::kErrorStop);
      largest = std::fmax(largest, std::fabs(ref.fSetAcceleration));
      if (ramp >= 2) {
        ASSERT_LE(std::fabs(ref.fSetAcceleration - a), kJerk * kCycle * (1 + 1e-6))
            << "jerk in cycle " << braking;
        ASSERT_LE(largest, kDeceleration * (1 + 1e-9));
      }
      ASSERT_LE(std::fabs(ref.fSetVelocity - v), 1.6 * kDeceleration * kCycle);
      ASSERT_NEAR(ref.fSetPosition - p, 0.5 * (v + ref.fSetVelocity) * kCycle, 1e-3);
    }
    EXPECT_EQ(ref.fSetVelocity, 0);
    EXPECT_EQ(ref.fSetAcceleration, 0);
    EXPECT_EQ(ref.wFBErrorID, 30);
    if (cycles == 400) { // the larger deceleration: v / a + a / J
      const double time = ramp == 1   ? 90 / kDeceleration
                          : ramp == 2 ? 90 / kDeceleration + kDeceleration / kJerk
                                      : 1.5707963 * 90 / kDeceleration;
      EXPECT_NEAR(braking * kCycle, time, 2 * kCycle);
    }
  }
}

TEST_P(Ramps, AtASoftwareLimitTheWholeDecelerationCountsAtOnce) {
  const auto ramp = static_cast<int16_t>(GetParam());
  Moving m(ramp, 400);
  auto &ref = m.rig.axis;
  ref.bSWLimitEnable = 1;
  ref.fSWLimitNegative = -10;
  ref.fSWLimitPositive = ref.fSetPosition + 1;
  while (ref.nAxisState != state::kErrorStop)
    m.rig.cycle([&] { m.rig.call(m.move, true); });
  EXPECT_EQ(ref.wFBErrorID, 10);
  m.rig.idle();
  EXPECT_NEAR(ref.fSetAcceleration, -kDeceleration, 1e-6);
  m.rig.idle(200);
  EXPECT_EQ(ref.fSetVelocity, 0);
  EXPECT_LT(ref.fSetPosition - ref.fSWLimitPositive,
            0.5 * 90 * 90 / kDeceleration + 2 * 90 * kCycle);
}

TEST_P(Ramps, AnErrorStopThatReachesALimitBrakesHardFromThere) {
  const auto ramp = static_cast<int16_t>(GetParam());
  Moving m(ramp, 400);
  auto &ref = m.rig.axis;
  ref.bSWLimitEnable = 1;
  ref.fSWLimitNegative = -10;
  ref.fSWLimitPositive = ref.fSetPosition + 1.5; // reached within the jerk's phase
  while (ref.fSetPosition <= ref.fSWLimitPositive)
    m.rig.idle();
  EXPECT_EQ(ref.wFBErrorID, 30) << "it is the first error that counts";
  m.rig.idle(2);
  EXPECT_LE(ref.fSetAcceleration, -kDeceleration * (1 - 1e-9));
  m.rig.idle(300);
  EXPECT_EQ(ref.fSetVelocity, 0);
}

TEST(ErrorStop, WithoutAJerkOrAfterAJumpItBrakesWithTheDeceleration) {
  Moving m(2, 400);
  m.rig.axis.fJerk = 0;
  m.rig.idle(2);
  ASSERT_EQ(m.rig.axis.nAxisState, state::kErrorStop);
  EXPECT_NEAR(m.rig.axis.fSetAcceleration, -kDeceleration, 1e-6);

  Moving jumped(2, 400);
  jumped.rig.axis.fSetAcceleration = 5e6; // as after a jump of set values
  jumped.rig.idle(1);
  EXPECT_LE(jumped.rig.axis.fSetVelocity, 90);
  jumped.rig.idle(400);
  EXPECT_EQ(jumped.rig.axis.fSetVelocity, 0);
}

INSTANTIATE_TEST_SUITE_P(ErrorStop, Ramps, testing::Values(1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

} // namespace
