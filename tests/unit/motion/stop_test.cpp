#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using stride::test::AxisRig;
namespace state = stride::axis::state;

/// A rig whose axis moves at 100 u/s under `move`.
struct MovingAxis {
  MovingAxis() {
    rig.powerUp();
    move = rig.move(100000);
    for (int i = 0; i < 1500; ++i)
      rig.cycle([&] { rig.call(move, true); });
  }
  AxisRig rig;
  AxisRig::MoveAbsolute move = stride::test::fresh<AxisRig::MoveAbsolute>();
};

TEST(Stop, BrakesAndHoldsTheAxisWhileExecute) {
  MovingAxis m;
  AxisRig &rig = m.rig;
  auto stop = rig.stop(200);
  const double from = rig.axis.fSetPosition;
  double before = rig.axis.fSetVelocity;
  int cycles = 0;
  while (stop.Done == 0 && cycles < 5000) {
    rig.cycle([&] {
      rig.call(m.move, true);
      rig.call(stop, true);
    });
    EXPECT_EQ(rig.axis.nAxisState, state::kStopping);
    EXPECT_LE(std::fabs(rig.axis.fSetVelocity - before), 0.2 + 1e-9);
    before = rig.axis.fSetVelocity;
    ++cycles;
  }
  EXPECT_EQ(cycles, 501) << "the move had already moved the axis in the first cycle";
  EXPECT_EQ(m.move.CommandAborted, 1);
  EXPECT_NEAR(rig.axis.fSetPosition, from + 0.1 + 25, 1e-9);
  EXPECT_EQ(stop.Busy, 0);
  // Held: no other command is accepted.
  auto other = rig.move(0);
  for (int i = 0; i < 10; ++i)
    rig.cycle([&] {
      rig.call(stop, true);
      rig.call(other, true);
    });
  EXPECT_EQ(other.ErrorID, 184);
  EXPECT_EQ(rig.axis.nAxisState, state::kStopping);
  EXPECT_EQ(stop.Done, 1);
  // Released by Execute = FALSE, in time for a command in the same cycle.
  rig.cycle([&] {
    rig.call(stop, false);
    rig.call(other, false);
    EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
    rig.call(other, true);
  });
  EXPECT_EQ(stop.Done, 0);
  EXPECT_EQ(other.Busy, 1);
}

TEST(Stop, ShortExecuteStillBlocksUntilStandstill) {
  MovingAxis m;
  AxisRig &rig = m.rig;
  auto stop = rig.stop();
  rig.cycle([&] { rig.call(stop, true); });
  auto other = rig.move(0);
  int cycles = 0;
  while (stop.Busy != 0 && cycles < 5000) {
    rig.cycle([&] {
      rig.call(stop, false);
      if (stop.Busy != 0) {
        rig.call(other, true);
        rig.call(other, false);
      }
    });
    ++cycles;
  }
  EXPECT_EQ(cycles, 999);
  EXPECT_EQ(other.Busy, 0);
  EXPECT_EQ(stop.Done, 1);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
  rig.cycle([&] { rig.call(stop, false); });
  EXPECT_EQ(stop.Done, 0);
}

TEST(Stop, FromStandstill) {
  AxisRig rig;
  rig.powerUp();
  auto stop = rig.stop();
  rig.cycle([&] { rig.call(stop, true); });
  EXPECT_EQ(stop.Done, 1);
  EXPECT_EQ(rig.axis.nAxisState, state::kStopping);
  rig.cycle([&] { rig.call(stop, false); });
  EXPECT_EQ(stop.Done, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(Stop, RetriggerBrakesHarder) {
  MovingAxis m;
  AxisRig &rig = m.rig;
  auto stop = rig.stop(10);
  for (int i = 0; i < 100; ++i)
    rig.cycle([&] { rig.call(stop, true); });
  EXPECT_NEAR(rig.axis.fSetVelocity, 99, 1e-9);
  stop.Deceleration = 1000;
  rig.cycle([&] { rig.call(stop, false); });
  rig.cycle([&] { rig.call(stop, true); });
  EXPECT_EQ(stop.Busy, 1);
  for (int i = 0; i < 99; ++i)
    rig.cycle([&] { rig.call(stop, true); });
  EXPECT_EQ(stop.Done, 1);
}

TEST(Stop, SecondInstanceIsRefused) {
  MovingAxis m;
  AxisRig &rig = m.rig;
  auto stop = rig.stop();
  auto second = rig.stop(1000);
  for (int i = 0; i < 10; ++i)
    rig.cycle([&] {
      rig.call(stop, true);
      rig.call(second, i > 2);
    });
  EXPECT_EQ(second.ErrorID, 184);
  EXPECT_EQ(stop.Error, 0);
  EXPECT_EQ(stop.Busy, 1);
}

TEST(Stop, NotCalledWhileBraking) {
  MovingAxis m;
  AxisRig &rig = m.rig;
  auto stop = rig.stop();
  rig.cycle([&] { rig.call(stop, true); });
  rig.idle();
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.wFBErrorID, 184);
  rig.idle(1100);
  EXPECT_EQ(rig.axis.fSetVelocity, 0.0);
  rig.cycle([&] { rig.call(stop, true); });
  EXPECT_EQ(stop.ErrorID, 184);
}

TEST(Stop, NeedNotBeCalledWhileItHoldsTheAxis) {
  AxisRig rig;
  rig.powerUp();
  auto stop = rig.stop();
  rig.cycle([&] { rig.call(stop, true); });
  rig.idle(10);
  EXPECT_EQ(rig.axis.nAxisState, state::kStopping);
  rig.cycle([&] { rig.call(stop, false); });
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(Stop, InvalidDeceleration) {
  for (const double bad : {0.0, -5.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    MovingAxis m;
    auto stop = m.rig.stop(bad);
    m.rig.cycle([&] {
      m.rig.call(m.move, true);
      m.rig.call(stop, true);
    });
    EXPECT_EQ(stop.ErrorID, 181);
    EXPECT_EQ(m.move.Busy, 1) << "the running motion goes on";
    EXPECT_EQ(m.rig.axis.nAxisState, state::kDiscrete);
  }
}

TEST(Stop, PoweredOffOrInErrorStop) {
  MovingAxis m;
  m.rig.idle(1100); // the move is not called: error stop
  auto stop = m.rig.stop();
  m.rig.cycle([&] { m.rig.call(stop, true); });
  EXPECT_EQ(stop.ErrorID, 183);

  AxisRig off;
  off.power.bRegulatorOn = 0;
  off.start();
  off.idle(5);
  auto other = off.stop();
  off.cycle([&] { off.call(other, true); });
  EXPECT_EQ(other.ErrorID, 20);
}

TEST(Stop, PowerLostWhileBraking) {
  MovingAxis m;
  AxisRig &rig = m.rig;
  auto stop = rig.stop();
  rig.cycle([&] { rig.call(stop, true); });
  rig.power.bRegulatorOn = 0;
  rig.cycle([&] { rig.call(stop, true); });
  EXPECT_EQ(stop.ErrorID, 20);
  EXPECT_EQ(stop.Busy, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
}

TEST(Stop, OnARotaryAxisAcrossTheWrap) {
  AxisRig rig;
  rig.makeRotary(360);
  rig.powerUp();
  auto move = rig.move(340, 100, 1000, 1000);
  move.Direction = 1;
  while (rig.axis.fSetPosition < 320)
    rig.cycle([&] { rig.call(move, true); });
  auto stop = rig.stop(100);
  for (int i = 0; i < 2000 && stop.Done == 0; ++i)
    rig.cycle([&] { rig.call(stop, true); });
  EXPECT_EQ(stop.Done, 1);
  EXPECT_NEAR(rig.axis.fSetPosition, 10, 0.2);
  EXPECT_NEAR(static_cast<double>(rig.axis.liSetIncrements), 3700000, 2000);
}

} // namespace
