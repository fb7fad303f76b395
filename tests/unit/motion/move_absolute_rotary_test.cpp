// The ways of MC_MoveAbsolute on a rotary axis.
#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using stride::test::AxisRig;
namespace state = stride::axis::state;

constexpr int16_t kNegative = -1;
constexpr int16_t kShortest = 0;
constexpr int16_t kPositive = 1;
constexpr int16_t kCurrent = 2;
constexpr int16_t kFastest = 3;

/// Runs `block` until it is no longer busy; returns the number of cycles.
template <class Block> int runOut(AxisRig &rig, Block &block, bool execute = true) {
  for (int i = 1; i < 1000000; ++i) {
    rig.cycle([&] { rig.call(block, execute); });
    if (block.Busy == 0)
      return i;
  }
  return -1;
}

TEST(MoveAbsolute, DirectionCountsOnRotaryAxesOnly) {
  AxisRig linear;
  linear.powerUp();
  auto move = linear.move(-10);
  move.Direction = 9;
  linear.cycle([&] { linear.call(move, true); });
  EXPECT_EQ(move.Error, 0);

  AxisRig rotary;
  rotary.makeRotary(360);
  rotary.powerUp();
  auto turn = rotary.move(10);
  turn.Direction = 9;
  rotary.cycle([&] { rotary.call(turn, true); });
  EXPECT_EQ(turn.ErrorID, 202);
  EXPECT_EQ(rotary.axis.nAxisState, state::kStandstill);
}

TEST(MoveAbsolute, RotaryDirections) {
  struct Case {
    int16_t direction;
    double target;
    double way;
  };
  for (const Case c :
       {Case{kPositive, 300, 300}, Case{kNegative, 300, -60}, Case{kShortest, 300, -60},
        Case{kShortest, 170, 170}, Case{kCurrent, 300, 300}, Case{kFastest, 300, -60},
        Case{kPositive, 725, 5}, Case{kNegative, 5, -355}, Case{kPositive, 0, 0}}) {
    AxisRig rig(0.01);
    rig.makeRotary(360);
    rig.powerUp();
    auto move = rig.move(c.target);
    move.Direction = c.direction;
    double way = 0;
    for (int i = 0; i < 10000 && move.Done == 0; ++i) {
      const double v = rig.axis.fSetVelocity;
      rig.cycle([&] { rig.call(move, true); });
      way += 0.5 * (v + rig.axis.fSetVelocity) * 0.01;
      ASSERT_GE(rig.axis.fSetPosition, 0.0);
      ASSERT_LT(rig.axis.fSetPosition, 360.0);
    }
    EXPECT_NEAR(way, c.way, 0.1);
    EXPECT_EQ(rig.axis.fSetPosition, std::fmod(c.target, 360)) << "exact, and within the period";
    rig.idle();
    EXPECT_NEAR(rig.axis.fActPosition, rig.axis.fSetPosition, 1e-4);
    EXPECT_EQ(rig.axis.liActIncrements, std::llround(c.way * 10000));
  }
}

TEST(MoveAbsolute, CurrentDirectionAtRestIsTheLastOne) {
  AxisRig rig(0.01);
  rig.makeRotary(360);
  rig.powerUp();
  auto move = rig.move(350);
  move.Direction = kNegative;
  runOut(rig, move);
  EXPECT_EQ(rig.axis.liSetIncrements, -100000);
  rig.cycle([&] { rig.call(move, false); });
  move.Position = 355;
  move.Direction = kCurrent;
  runOut(rig, move);
  EXPECT_EQ(rig.axis.liSetIncrements, -3650000) << "-10 u to -365 u";
}

TEST(MoveAbsolute, ManyTurnsOnARotaryAxisDoNotDrift) {
  AxisRig rig(0.01);
  rig.axis.dwRatioTechUnitsDenom = 10000;
  rig.axis.iRatioTechUnitsNum = 3;
  rig.makeRotary(100); // 333333.33 increments
  rig.powerUp();
  const int turns = 300;
  for (int k = 0; k < turns; ++k) {
    for (const double target : {60.0, 20.0}) { // 60 on, then 60 on: one turn and 20 after
      auto move = rig.move(target, 5000, 50000, 50000);
      move.Direction = kPositive;
      ASSERT_GT(runOut(rig, move), 0);
    }
  }
  const double exact = (turns * 100.0 + 20.0) * 10000 / 3;
  EXPECT_NEAR(static_cast<double>(rig.axis.liSetIncrements), exact, 0.51);
}
} // namespace
