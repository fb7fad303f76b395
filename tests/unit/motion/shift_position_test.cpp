#include "runtime/axis/shift_position.hpp"

#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_SetPosition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
using SetPosition = ::st::SM_PLCopen::MC_SetPosition;

void shift(AxisRig &rig, double way) {
  auto block = fresh<SetPosition>();
  block.Axis = &rig.axis;
  block.Execute = 1;
  block.Position = way;
  block.Mode = 1;
  block.body__(rig.ctx);
  ASSERT_EQ(block.Done, 1);
}

/// Two axes get the same moves; the zero point of one is shifted at random, often during the moves.
/// Their drives do the same: apart from the rounding of one increment that a shift may bring.
void compare(bool rotary, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  AxisRig plain(0.001);
  AxisRig moved(0.001);
  if (rotary) {
    plain.makeRotary(360);
    moved.makeRotary(360);
  }
  ASSERT_GT(plain.powerUp(), 0);
  ASSERT_GT(moved.powerUp(), 0);
  double total = 0;
  for (int task = 0; task < 20; ++task) {
    const double velocity = number(1, 400);
    const double acceleration = number(50, 5000);
    const double way = number(-170, 170); // the shorter way round for both
    const double target = plain.axis.fSetPosition + way;
    auto a = plain.move(target);
    auto b = moved.move(moved.axis.fSetPosition + way);
    for (auto *block : {&a, &b}) {
      block->Velocity = velocity;
      block->Acceleration = acceleration;
      block->Deceleration = acceleration;
    }
    const int cycles = static_cast<int>(number(1, 2000));
    for (int i = 0; i < cycles; ++i) {
      const bool before = i > 0 && number(0, 1) < 0.01; // the target is in the old positions
      const bool after = number(0, 1) < 0.01;
      const double change = std::round(number(-1000, 1000) * 8) / 8;
      plain.cycle([&] { plain.call(a, true); });
      moved.cycle([&] {
        if (before)
          shift(moved, change);
        moved.call(b, true);
        if (after)
          shift(moved, change);
      });
      total += change * ((before ? 1 : 0) + (after ? 1 : 0));
      const auto difference =
          static_cast<int32_t>(moved.drive->status(0).position - plain.drive->status(0).position);
      ASSERT_LE(std::abs(difference), 1) << "task " << task << " cycle " << i;
      double apart = moved.axis.fSetPosition - plain.axis.fSetPosition - total;
      if (rotary)
        apart = std::remainder(apart, 360.0);
      ASSERT_NEAR(apart, 0, 1e-9) << "task " << task << " cycle " << i;
    }
    EXPECT_EQ(a.Done, b.Done);
  }
}

TEST(ShiftPosition, ALinearDriveDoesNotNotice) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    compare(false, seed);
}

TEST(ShiftPosition, ARotaryDriveDoesNotNotice) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    compare(true, seed);
}

TEST(ErrorList, KeepsTheLastTenInOrder) {
  namespace axis = stride::axis;
  auto ref = fresh<axis::AxisRef>();
  for (int16_t i = 1; i <= 25; ++i) {
    axis::listError(ref, i);
    axis::listError(ref, 0); // no error
  }
  ASSERT_EQ(ref.stFBErrors.uiCount, 10);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(ref.stFBErrors.aError.v[(ref.stFBErrors.uiFirst + i) % 10], 16 + i);
  axis::listError(ref, 25); // it has happened again
  ASSERT_EQ(ref.stFBErrors.uiCount, 10);
  for (int i = 0; i < 9; ++i)
    EXPECT_EQ(ref.stFBErrors.aError.v[(ref.stFBErrors.uiFirst + i) % 10], 17 + i);
  EXPECT_EQ(ref.stFBErrors.aError.v[(ref.stFBErrors.uiFirst + 9) % 10], 25);
}

TEST(ErrorList, HasWhatABlockMetOnceForEachTime) {
  namespace axis = stride::axis;
  AxisRig rig;
  ASSERT_GT(rig.powerUp(), 0);
  auto bad = rig.move(5, -1);
  for (int i = 0; i < 6; ++i)
    rig.cycle([&] { rig.call(bad, i % 2 == 0); }); // three edges
  ASSERT_EQ(rig.axis.stFBErrors.uiCount, 3);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(rig.axis.stFBErrors.aError.v[i], axis::error::kMoveAbsoluteValues);
  auto move = rig.move(500);
  for (int i = 0; i < 20; ++i)
    rig.cycle([&] { rig.call(move, true); });
  rig.idle(2); // it is not called: an error stop, which the block hears of as well
  for (int i = 0; i < 3; ++i)
    rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.ErrorID, 30);
  ASSERT_EQ(rig.axis.stFBErrors.uiCount, 4);
  EXPECT_EQ(rig.axis.stFBErrors.aError.v[3], axis::error::kNotCalled);
}

} // namespace
