// Axes that a program declares: MC_Power serves them.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_Home.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_Reset.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using stride::test::fresh;
namespace axis = stride::axis;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

/// An axis without a drive group; its task has cycles of 2 ms.
struct VirtualRig {
  VirtualRig() {
    axis.fTaskCycle = 0.002;
    axis.fSWMaxDeceleration = 500;
    power.Axis = &axis;
    power.Enable = power.bRegulatorOn = power.bDriveStart = 1;
  }

  template <class Program> void cycle(Program program) {
    power.body__(ctx);
    program();
    ++ctx.cycle;
  }

  template <class Block> void call(Block &block, bool execute) {
    block.Axis = &axis;
    block.Execute = execute;
    block.body__(ctx);
  }

  pl::MC_MoveAbsolute move(double position) const {
    auto block = fresh<pl::MC_MoveAbsolute>();
    block.Position = position;
    block.Velocity = 100;
    block.Acceleration = block.Deceleration = 1000;
    return block;
  }

  stride::Ctx ctx{};
  axis::AxisRef axis = fresh<axis::AxisRef>();
  pl::MC_Power power = fresh<pl::MC_Power>();
};

TEST(VirtualAxis, HasPowerAtOnceAndIsWhereItIsSet) {
  VirtualRig rig;
  auto move = rig.move(12.5);
  double before = 0;
  int cycles = 0;
  for (; cycles < 1000 && move.Done == 0; ++cycles) {
    rig.cycle([&] {
      EXPECT_EQ(rig.power.Status, 1);
      EXPECT_EQ(rig.axis.fActPosition, before) << "that of the last cycle";
      rig.call(move, true);
    });
    before = rig.axis.fSetPosition;
    EXPECT_EQ(move.Error, 0) << move.ErrorID;
  }
  // 0.1 s up, 0.025 s at 100 u/s, 0.1 s down; the call in which it is seen to be over.
  EXPECT_EQ(cycles, 113);
  EXPECT_EQ(rig.axis.fSetPosition, 12.5);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
}

TEST(VirtualAxis, IsServedOncePerCycleHoweverManyBlocksSwitchIt) {
  VirtualRig rig;
  auto second = fresh<pl::MC_Power>();
  second.Axis = &rig.axis;
  second.Enable = second.bRegulatorOn = second.bDriveStart = 1;
  auto move = rig.move(1000);
  for (int i = 0; i < 200; ++i)
    rig.cycle([&] {
      rig.call(move, true);
      second.body__(rig.ctx);
      ASSERT_EQ(move.Error, 0) << move.ErrorID << " in cycle " << i;
    });
  // 100 u/s after 0.1 s; 200 cycles of 2 ms, the first of which begins the motion.
  EXPECT_NEAR(rig.axis.fSetPosition, 0.5 * 1000 * 0.01 + 100 * 0.3, 1e-9);
}

TEST(VirtualAxis, NeedsACycleTime) {
  VirtualRig rig;
  rig.axis.fTaskCycle = 0;
  for (int i = 0; i < 3; ++i)
    rig.cycle([] {});
  EXPECT_EQ(rig.power.Error, 1);
  EXPECT_EQ(rig.power.ErrorID, 110);
  EXPECT_EQ(rig.power.Status, 0);
  EXPECT_EQ(rig.axis.stFBErrors.uiCount, 1) << "noted once";
  auto move = rig.move(1);
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.ErrorID, 20);
}

TEST(VirtualAxis, WithoutPowerItStaysWhereItIs) {
  VirtualRig rig;
  auto move = rig.move(1000);
  for (int i = 0; i < 100; ++i)
    rig.cycle([&] { rig.call(move, true); });
  const double place = rig.axis.fSetPosition;
  rig.power.bRegulatorOn = 0;
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(rig.power.Status, 0);
  EXPECT_EQ(move.ErrorID, 20);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
  EXPECT_EQ(rig.axis.fSetPosition, place);
  EXPECT_EQ(rig.axis.fActPosition, place);
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
}

TEST(VirtualAxis, BrakesIntoErrorStopAndIsReset) {
  VirtualRig rig;
  auto move = rig.move(1000);
  for (int i = 0; i < 200; ++i)
    rig.cycle([&] { rig.call(move, true); });
  ASSERT_EQ(rig.axis.fSetVelocity, 100);
  rig.cycle([] {}); // forgotten
  rig.cycle([] {});
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.wFBErrorID, 30);
  double before = rig.axis.fSetVelocity;
  for (int i = 0; i < 110; ++i) {
    rig.cycle([] {});
    EXPECT_LE(before - rig.axis.fSetVelocity, 1000 * 0.002 * (1 + 1e-9));
    before = rig.axis.fSetVelocity;
  }
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
  auto reset = fresh<pl::MC_Reset>();
  for (int i = 0; i < 5; ++i)
    rig.cycle([&] { rig.call(reset, true); });
  EXPECT_EQ(reset.Done, 1) << reset.ErrorID;
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(VirtualAxis, ThatNobodyServesDoesNotCarryOutAReset) {
  VirtualRig rig;
  auto move = rig.move(1000);
  rig.cycle([&] { rig.call(move, true); });
  rig.cycle([] {});
  rig.cycle([] {});
  ASSERT_EQ(rig.axis.nAxisState, state::kErrorStop);
  auto reset = fresh<pl::MC_Reset>();
  for (int i = 0; i < 1000; ++i) {
    rig.call(reset, true);
    ASSERT_EQ(reset.Error, 0) << i;
  }
  rig.call(reset, true);
  EXPECT_EQ(reset.ErrorID, 0) << "1000 cycles after the edge";
  rig.call(reset, true);
  EXPECT_EQ(reset.ErrorID, 121);
}

TEST(VirtualAxis, IsHomedWhereItIs) {
  VirtualRig rig;
  auto move = rig.move(7);
  for (int i = 0; i < 200 && move.Done == 0; ++i)
    rig.cycle([&] { rig.call(move, true); });
  rig.cycle([&] { rig.call(move, false); });
  auto home = fresh<pl::MC_Home>();
  home.Position = -3.5;
  home.Deceleration = 100;
  for (int i = 0; i < 10 && home.Done == 0; ++i)
    rig.cycle([&] { rig.call(home, true); });
  EXPECT_EQ(home.Done, 1) << home.ErrorID;
  rig.cycle([&] { rig.call(home, false); });
  EXPECT_EQ(rig.axis.fSetPosition, -3.5);
  EXPECT_EQ(rig.axis.fActPosition, -3.5);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(VirtualAxis, KeepsItsSoftwareLimits) {
  VirtualRig rig;
  rig.axis.bSWLimitEnable = 1;
  rig.axis.fSWLimitPositive = 20;
  rig.axis.fSWLimitNegative = -5;
  auto move = rig.move(1000);
  for (int i = 0; i < 1000 && rig.axis.nAxisState != state::kErrorStop; ++i)
    rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(rig.axis.wFBErrorID, 10);
  EXPECT_GT(rig.axis.fSetPosition, 20);
  EXPECT_LT(rig.axis.fSetPosition, 20 + 2 * 100 * 0.002);
}

TEST(VirtualAxis, CountsNoTurns) {
  VirtualRig rig;
  rig.axis.iMovementType = 0;
  rig.axis.fPositionPeriod = 0.75; // less than any increment
  auto velocity = fresh<pl::MC_MoveVelocity>();
  velocity.Velocity = 10;
  velocity.Acceleration = velocity.Deceleration = 1e5;
  velocity.Direction = 1;
  double way = 0;
  double before = 0;
  for (int i = 0; i < 500; ++i) {
    rig.cycle([&] { rig.call(velocity, true); });
    const double step = std::remainder(rig.axis.fSetPosition - before, 0.75);
    way += step;
    before = rig.axis.fSetPosition;
    ASSERT_GE(before, 0);
    ASSERT_LT(before, 0.75);
  }
  EXPECT_NEAR(way, 10 * 1.0, 0.011);
}

} // namespace
