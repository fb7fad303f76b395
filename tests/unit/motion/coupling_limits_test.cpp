// What couplings refuse, and what they do with masters and slaves that are not as usual.
#include "tests/unit/motion/couplings.hpp"

#include "runtime/axis/forecast.hpp"

#include "st/SM_PLCopen/MC_GearIn.h"
#include "st/SM_PLCopen/MC_GearOut.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_Phasing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

namespace pl = ::st::SM_PLCopen;
namespace basic = ::st::SM_DriveBasic;
namespace state = stride::axis::state;
using stride::test::AxisRig;
using stride::test::Couplings;
using stride::test::fresh;

constexpr int16_t kBuffered = basic::MC_BUFFER_MODE__Buffered;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(Couplings, RefuseWhatTheyCannotUse) {
  const auto errorOf = [&](auto block) {
    rig.cycle([&] { call(block, true); });
    EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
    return block.ErrorID;
  };
  const auto with = [](auto block, auto change) {
    change(block);
    return block;
  };
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.RatioDenominator = 0; })), 675);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.Acceleration = 0; })), 676);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.Acceleration = kNan; })), 676);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.Jerk = -1; })), 676);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.Deceleration = -5; })), 677);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.BufferMode = 6; })), 311);
  EXPECT_EQ(errorOf(with(sync, [](auto &b) { b.BufferMode = -1; })), 311);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.Master = nullptr; })), 31);
  EXPECT_EQ(errorOf(with(gear, [](auto &b) { b.Master = b.Slave; })), 31);
  EXPECT_EQ(errorOf(with(sync, [](auto &b) { b.RatioDenominator = 0; })), 675);
  EXPECT_EQ(errorOf(with(sync, [](auto &b) { b.MasterSyncPosition = kNan; })), 12);
  auto phase = coupled<pl::MC_Phasing>();
  phase.Velocity = phase.Acceleration = phase.Deceleration = 50;
  EXPECT_EQ(errorOf(with(phase, [](auto &b) { b.Velocity = 0; })), 725);
  EXPECT_EQ(errorOf(with(phase, [](auto &b) { b.Acceleration = -1; })), 725);
  EXPECT_EQ(errorOf(with(phase, [](auto &b) { b.PhaseShift = kNan; })), 725);
  master.iMovementType = 0;
  master.fPositionPeriod = 0;
  EXPECT_EQ(errorOf(phase), 726);
  master.iMovementType = 1;
  rig.axis.eRampType = 2; // parabolic: needs a jerk
  EXPECT_EQ(errorOf(gear), 676);
  EXPECT_EQ(errorOf(phase), 725);
}

TEST_F(Couplings, NothingUnheardOfReachesTheAxis) {
  // A way of next to nothing, and places that no axis has.
  for (const double place : {1e-3, 1e200, 1e308, -1e308})
    for (const double left : {1e-200, 1e-9, 5.0}) {
      SCOPED_TRACE(place);
      master.fSetVelocity = left < 1 ? left : 10;
      sync.MasterSyncPosition = master.fSetPosition + left;
      sync.SlaveSyncPosition = place;
      for (int i = 0; i < 100; ++i) {
        rig.cycle([&] {
          master.fSetPosition += master.fSetVelocity * 0.001;
          call(sync, i < 99);
        });
        ASSERT_TRUE(std::isfinite(rig.axis.fSetPosition));
        ASSERT_TRUE(std::isfinite(rig.axis.fSetVelocity));
        ASSERT_TRUE(std::isfinite(rig.axis.fSetAcceleration));
      }
      rig.axis.nAxisState = state::kStandstill; // as after MC_Reset
      rig.axis.fSetPosition = rig.axis.fSetVelocity = 0;
      rig.axis.iOwner = 0;
      rig.axis.stPlanner.bActive = 0;
    }
}

TEST_F(Couplings, AnotherMasterOnTheWayIsAnError) {
  auto other = master;
  for (int i = 0; i < 50; ++i)
    cycle([&] { call(gear, true); });
  gear.Master = &other;
  rig.cycle([&] { call(gear, true); });
  EXPECT_EQ(gear.ErrorID, 32);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
}

TEST_F(Couplings, TheForecastEndsWhereACouplingBegins) {
  gear.BufferMode = kBuffered;
  for (int i = 0; i < 500; ++i)
    cycle([&] {
      call(move, true);
      call(gear, i >= 10);
    });
  // The move takes 1 s + 0.4 s.
  stride::motion::State at{};
  double jerk = 0;
  stride::motion::Forecast forecast(rig.axis);
  EXPECT_TRUE(forecast.at(0.8, at, jerk));
  EXPECT_NEAR(at.position, 20, 0.5);
  EXPECT_FALSE(forecast.at(2.0, at, jerk));
}

TEST_F(Couplings, GearOutTakesASuperimposedMotionAlong) {
  auto out = fresh<pl::MC_GearOut>();
  out.Slave = &rig.axis;
  auto add = fresh<pl::MC_MoveSuperImposed>();
  add.Axis = &rig.axis;
  add.Distance = 30;
  add.VelocityDiff = 5;
  add.Acceleration = add.Deceleration = 50;
  for (int i = 0; i < 1500; ++i)
    cycle([&] {
      call(gear, true);
      call(out, i >= 1200);
      call(add, i >= 500);
    });
  EXPECT_TRUE(add.CommandAborted && out.Done);
  EXPECT_NEAR(rig.axis.fSetVelocity, 15, 1e-9);
}

TEST(RotaryCouplings, TheDriveGetsEveryTurn) {
  // Up to 4 turns of the slave in a cycle, and 10,000 cycles of it.
  AxisRig rig;
  rig.makeRotary(100);
  rig.axis.dwRatioTechUnitsDenom = 1000;
  rig.powerUp();
  auto master = fresh<stride::axis::AxisRef>();
  master.iMovementType = 0;
  master.fPositionPeriod = 360;
  master.fTaskCycle = 0.001;
  master.bRegulatorOn = 1;
  auto gear = fresh<pl::MC_GearIn>();
  gear.Master = &master;
  gear.Slave = &rig.axis;
  gear.Acceleration = gear.Deceleration = 50;
  gear.RatioNumerator = -4;
  gear.RatioDenominator = 3;
  const auto begin = rig.axis.liSetIncrements;
  rig.cycle([&] { rig.call(gear, true); }); // both at rest: in gear
  long turns = 0;                           // of the master
  double velocity = 0;
  for (int i = 0; i < 12000; ++i) {
    const double wanted = i < 11000 ? 300000 : 0;
    const double before = velocity;
    velocity += std::fmax(-1000, std::fmin(1000, wanted - velocity));
    double position = master.fSetPosition + 0.5 * (before + velocity) * 0.001;
    while (position >= 360) {
      position -= 360;
      ++turns;
    }
    master.fSetPosition = position;
    master.fSetVelocity = velocity;
    rig.cycle([&] { rig.call(gear, true); });
    ASSERT_TRUE(gear.InGear) << i;
  }
  EXPECT_GT(turns, 8000);
  const double way = (static_cast<double>(turns) * 360 + master.fSetPosition) * -4 / 3;
  EXPECT_NEAR(static_cast<double>(rig.axis.liSetIncrements - begin), way * 1000, 1);
  rig.cycle([&] { rig.call(gear, true); });
  EXPECT_NEAR(rig.axis.fActPosition, rig.axis.fSetPosition, 0.002);
}

TEST_F(Couplings, FollowAnEncoder) {
  // Whole thousandths of a unit, so that the velocity is 7 or 8 u/s, 7.3 in the mean.
  master.bRegulatorOn = 0;
  for (const int8_t ramp : {int8_t{0}, int8_t{2}}) {
    rig.axis.eRampType = ramp;
    gear.Jerk = 1000;
    double exact = master.fActPosition;
    int cycles = 0;
    const auto step = [&](double velocity) {
      exact += velocity * 0.001;
      const double seen = std::floor(exact * 1000) / 1000;
      const double before = master.fActVelocity;
      master.fActVelocity = (seen - master.fActPosition) / 0.001;
      master.fActAcceleration = (master.fActVelocity - before) / 0.001;
      master.fActPosition = seen;
    };
    for (int i = 0; i < 50; ++i)
      rig.cycle([&] { step(7.3); });
    call(gear, false);
    for (; cycles < 2000 && !gear.InGear; ++cycles) {
      const double before = rig.axis.fSetVelocity;
      rig.cycle([&] {
        step(7.3);
        call(gear, true);
      });
      ASSERT_FALSE(gear.Error) << gear.ErrorID;
      if (!gear.InGear) {
        ASSERT_LE(std::fabs(rig.axis.fSetVelocity - before), 0.05 * (1 + 1e-9));
      }
    }
    EXPECT_TRUE(gear.InGear);
    EXPECT_NEAR(cycles, ramp == 0 ? 146 : 196, 15);
    const double difference = rig.axis.fSetPosition - master.fActPosition;
    for (int i = 0; i < 1000; ++i) {
      rig.cycle([&] {
        step(i < 500 ? 7.3 : -7.3);
        call(gear, true);
      });
      ASSERT_NEAR(rig.axis.fSetPosition - master.fActPosition, difference, 1e-12);
    }
    auto stop = rig.stop(50);
    for (int i = 0; i < 1000; ++i)
      rig.cycle([&] {
        call(stop, true);
        call(gear, false);
      });
    rig.cycle([&] { call(stop, false); });
  }
}

TEST_F(Couplings, ATremblingMasterDoesNotEndTheWay) {
  master.bRegulatorOn = 0;
  master.fActVelocity = 10;
  sync.MasterSyncPosition = 10;
  sync.SlaveSyncPosition = 5;
  for (int i = 0; i < 1100; ++i)
    rig.cycle([&] {
      master.fActPosition += i % 3 == 2 ? -0.01 : 0.02;
      call(sync, true);
      ASSERT_FALSE(sync.Error) << i;
    });
  EXPECT_TRUE(sync.InSync);
  EXPECT_NEAR(rig.axis.fSetPosition - 5, master.fActPosition - 10, 1e-9);
}

TEST_F(Couplings, ShiftsOfTheZeroPointAreNoMotion) {
  for (int i = 0; i < 500; ++i)
    cycle([&] { call(gear, true); });
  const double difference = rig.axis.fSetPosition - master.fSetPosition;
  master.fOffsetPosition += 100;
  master.fSetPosition += 100;
  for (int i = 0; i < 100; ++i)
    cycle([&] { call(gear, true); });
  EXPECT_NEAR(rig.axis.fSetPosition - master.fSetPosition + 100, difference, 1e-9);
}

} // namespace
