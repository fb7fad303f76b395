#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using stride::test::AxisRig;
namespace state = stride::axis::state;

/// Runs `block` until it is no longer busy; returns the number of cycles.
template <class Block> int runOut(AxisRig &rig, Block &block, bool execute = true) {
  for (int i = 1; i < 1000000; ++i) {
    rig.cycle([&] { rig.call(block, execute); });
    if (block.Busy == 0)
      return i;
  }
  return -1;
}

TEST(MoveAbsolute, SingleAxisExampleTakesTwoSeconds) {
  AxisRig rig(0.003);
  rig.powerUp();
  auto move = rig.move(100);
  EXPECT_EQ(runOut(rig, move), 667) << "the first cycle at or after 2 s";
  EXPECT_EQ(move.Done, 1);
  EXPECT_EQ(move.Active, 0);
  EXPECT_EQ(move.Error, 0);
  EXPECT_EQ(rig.axis.fSetPosition, 100.0);
  EXPECT_EQ(rig.axis.fSetVelocity, 0.0);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
  rig.idle();
  EXPECT_EQ(rig.axis.fActPosition, 100.0);
}

TEST(MoveAbsolute, EndsWithTheCycleInWhichItsTimeIsUp) {
  for (const double cycle : {0.001, 0.002, 0.004, 0.005, 0.01, 0.02, 0.025, 0.1, 3e6 * 1e-9}) {
    AxisRig rig(cycle);
    rig.powerUp();
    auto move = rig.move(100);
    EXPECT_EQ(runOut(rig, move), static_cast<int>(std::ceil(2 / cycle - 1e-6))) << cycle;
  }
}

TEST(MoveAbsolute, SetValuesAreTheClosedForm) {
  AxisRig rig(0.01);
  rig.powerUp();
  auto move = rig.move(100);
  for (int n = 1; n < 200; ++n) {
    rig.cycle([&] { rig.call(move, true); });
    const double t = n * 0.01;
    const double s = t < 1 ? 50 * t * t : 100 - 50 * (2 - t) * (2 - t);
    EXPECT_NEAR(rig.axis.fSetPosition, s, 1e-12) << t;
    EXPECT_NEAR(rig.axis.fSetVelocity, t < 1 ? 100 * t : 100 * (2 - t), 1e-12);
    EXPECT_EQ(rig.axis.nAxisState, state::kDiscrete);
    EXPECT_EQ(rig.axis.fAimPosition, 100.0);
    EXPECT_EQ(rig.axis.bAccelerating, t < 0.9999);
    EXPECT_EQ(rig.axis.bDecelerating, t > 0.9999);
    EXPECT_EQ(rig.axis.fSetDeceleration, t > 0.9999 ? 100.0 : 0.0);
    EXPECT_EQ(move.Busy, 1);
    EXPECT_EQ(move.Active, 1);
    EXPECT_EQ(move.Done, 0);
  }
}

TEST(MoveAbsolute, OneAfterTheOtherStandsInBetween) {
  AxisRig rig;
  rig.powerUp();
  auto first = rig.move(6000, 3000, 5000, 5000);
  auto second = rig.move(10000, 2000, 5000, 5000);
  bool stood = false;
  for (int i = 0; i < 10000 && second.Done == 0; ++i) {
    rig.cycle([&] {
      rig.call(first, true);
      rig.call(second, first.Done != 0);
    });
    if (rig.axis.fSetPosition == 6000.0) {
      stood = true;
      EXPECT_EQ(rig.axis.fSetVelocity, 0.0);
      EXPECT_EQ(first.Done, 1);
    }
  }
  EXPECT_TRUE(stood);
  EXPECT_EQ(first.CommandAborted, 0);
  EXPECT_EQ(second.Done, 1);
  EXPECT_EQ(rig.axis.fSetPosition, 10000.0);
}

TEST(MoveAbsolute, SecondInterruptsFirst) {
  AxisRig rig;
  rig.powerUp();
  auto first = rig.move(6000, 3000, 5000, 5000);
  auto second = rig.move(10000, 2000, 5000, 5000);
  double before = 0;
  double slowest = HUGE_VAL;
  for (int i = 0; i < 10000 && second.Done == 0; ++i) {
    const bool test = i >= 1500;
    rig.cycle([&] {
      rig.call(first, true);
      rig.call(second, test);
    });
    EXPECT_LE(std::fabs(rig.axis.fSetVelocity - before), 5.0 + 1e-9) << i;
    before = rig.axis.fSetVelocity;
    if (test && rig.axis.fSetPosition < 9000)
      slowest = std::min(slowest, rig.axis.fSetVelocity);
    EXPECT_EQ(first.CommandAborted, i > 1500) << "at its next call";
    EXPECT_EQ(first.Done, 0);
  }
  EXPECT_NEAR(slowest, 2000, 1e-9) << "one run, without a stop";
  EXPECT_EQ(rig.axis.fSetPosition, 10000.0);
}

TEST(MoveAbsolute, AbortIsSeenInTheSameCycleWhenCalledAfterTheWinner) {
  AxisRig rig;
  rig.powerUp();
  auto first = rig.move(6000, 3000, 5000, 5000);
  auto second = rig.move(10000, 2000, 5000, 5000);
  for (int i = 0; i < 100; ++i)
    rig.cycle([&] { rig.call(first, true); });
  const double before = rig.axis.fSetPosition;
  rig.cycle([&] {
    rig.call(second, true);
    rig.call(first, true);
  });
  EXPECT_EQ(first.CommandAborted, 1);
  EXPECT_EQ(first.Busy, 0);
  EXPECT_EQ(first.Active, 0);
  EXPECT_EQ(second.Active, 1);
  EXPECT_GT(rig.axis.fSetPosition, before) << "the winner moves at once";
  rig.cycle([&] {
    rig.call(second, true);
    rig.call(first, false);
  });
  EXPECT_EQ(first.CommandAborted, 0) << "cleared by the falling edge";
}

TEST(MoveAbsolute, ShortExecuteShowsDoneForOneCall) {
  AxisRig rig(0.01);
  rig.powerUp();
  auto move = rig.move(1);
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.Busy, 1);
  EXPECT_GT(runOut(rig, move, false), 10);
  EXPECT_EQ(move.Done, 1);
  rig.cycle([&] { rig.call(move, false); });
  EXPECT_EQ(move.Done, 0);
}

TEST(MoveAbsolute, LongExecuteKeepsDone) {
  AxisRig rig(0.01);
  rig.powerUp();
  auto move = rig.move(1);
  runOut(rig, move);
  for (int i = 0; i < 5; ++i) {
    rig.cycle([&] { rig.call(move, true); });
    EXPECT_EQ(move.Done, 1);
  }
  rig.cycle([&] { rig.call(move, false); });
  EXPECT_EQ(move.Done, 0);
}

TEST(MoveAbsolute, ShortExecuteShowsCommandAbortedForOneCall) {
  AxisRig rig;
  rig.powerUp();
  auto first = rig.move(1000);
  auto second = rig.move(-5);
  rig.cycle([&] { rig.call(first, true); });
  rig.cycle([&] { rig.call(first, false); });
  rig.cycle([&] {
    rig.call(second, true);
    rig.call(first, false);
  });
  EXPECT_EQ(first.CommandAborted, 1);
  rig.cycle([&] {
    rig.call(second, true);
    rig.call(first, false);
  });
  EXPECT_EQ(first.CommandAborted, 0);
}

TEST(MoveAbsolute, RetriggerWhileBusyReadsTheInputsAgain) {
  AxisRig rig;
  rig.powerUp();
  auto move = rig.move(1000);
  for (int i = 0; i < 1500; ++i)
    rig.cycle([&] { rig.call(move, true); });
  move.Position = 20; // after the axis: it has to come back
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(rig.axis.fAimPosition, 1000.0) << "inputs count at the edge only";
  rig.cycle([&] { rig.call(move, false); });
  EXPECT_EQ(move.Busy, 1);
  const double before = rig.axis.fSetVelocity;
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.Busy, 1);
  EXPECT_EQ(move.CommandAborted, 0);
  EXPECT_EQ(rig.axis.fAimPosition, 20.0);
  EXPECT_NEAR(rig.axis.fSetVelocity, before - 0.1, 1e-9);
  EXPECT_GT(runOut(rig, move), 0);
  EXPECT_EQ(rig.axis.fSetPosition, 20.0);
}

TEST(MoveAbsolute, TheExamplesDoubleCallInOneCycle) {
  // Manual 11.3: the block is called with Execute TRUE, and once more with FALSE when it is done.
  AxisRig rig(0.003);
  rig.powerUp();
  auto move = rig.move(100);
  int done = 0;
  for (int i = 0; i < 2000; ++i) {
    if (i == 1000)
      move.Position = 50;
    rig.cycle([&] {
      rig.call(move, true);
      if (move.Done != 0) {
        ++done;
        rig.call(move, false);
      }
    });
    EXPECT_EQ(move.Error, 0);
  }
  EXPECT_GT(done, 100);
  EXPECT_EQ(rig.axis.fSetPosition, 50.0);
}

TEST(MoveAbsolute, CallingTwiceInACycleMovesOnce) {
  AxisRig once(0.01);
  AxisRig twice(0.01);
  once.powerUp();
  twice.powerUp();
  auto a = once.move(10);
  auto b = twice.move(10);
  for (int i = 0; i < 100; ++i) {
    once.cycle([&] { once.call(a, true); });
    twice.cycle([&] {
      twice.call(b, true);
      twice.call(b, true);
    });
    EXPECT_EQ(once.axis.fSetPosition, twice.axis.fSetPosition);
  }
}

TEST(MoveAbsolute, WhereTheAxisStandsIsDoneAtOnce) {
  AxisRig rig;
  rig.powerUp();
  auto move = rig.move(0);
  EXPECT_EQ(runOut(rig, move), 1);
  EXPECT_EQ(move.Done, 1);
}

TEST(MoveAbsolute, NotPowered) {
  AxisRig rig;
  rig.power.bRegulatorOn = 0;
  rig.start();
  rig.idle(5);
  auto move = rig.move(100);
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.Error, 1);
  EXPECT_EQ(move.ErrorID, 20);
  EXPECT_EQ(move.Busy, 0);
  EXPECT_EQ(rig.axis.wFBErrorID, 20);
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.Error, 1) << "stays with Execute";
  rig.cycle([&] { rig.call(move, false); });
  EXPECT_EQ(move.Error, 0);
  EXPECT_EQ(move.ErrorID, 0);
}

TEST(MoveAbsolute, PowerOffDuringMotion) {
  for (const bool powerFirst : {true, false}) {
    AxisRig rig;
    rig.powerUp();
    auto move = rig.move(1000);
    for (int i = 0; i < 500; ++i)
      rig.cycle([&] { rig.call(move, true); });
    if (powerFirst) { // MC_Power is called before the move
      rig.power.bRegulatorOn = 0;
      rig.cycle([&] { rig.call(move, true); });
    } else {
      rig.cycle([&] {
        rig.call(move, true);
        rig.power.bRegulatorOn = 0;
        rig.power.body__(rig.ctx);
      });
      rig.cycle([&] { rig.call(move, true); });
    }
    EXPECT_EQ(move.Error, 1);
    EXPECT_EQ(move.ErrorID, 20);
    EXPECT_EQ(move.Busy, 0);
    EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
    EXPECT_EQ(rig.axis.fSetVelocity, 0.0);
    rig.idle(3);
    const double place = rig.axis.fActPosition;
    EXPECT_EQ(rig.axis.fSetPosition, place);
    rig.power.bRegulatorOn = 1;
    rig.idle(5);
    EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
    EXPECT_EQ(rig.axis.fActPosition, place);
  }
}

TEST(MoveAbsolute, InvalidValues) {
  const double inf = std::numeric_limits<double>::infinity();
  AxisRig rig;
  rig.powerUp();
  for (const double bad : {0.0, -1.0, inf, std::nan("")}) {
    for (int input = 0; input < 3; ++input) {
      auto move = rig.move(100);
      (input == 0 ? move.Velocity : input == 1 ? move.Acceleration : move.Deceleration) = bad;
      rig.cycle([&] { rig.call(move, true); });
      EXPECT_EQ(move.ErrorID, 201);
    }
  }
  for (const double bad : {inf, -inf, std::nan("")}) {
    auto move = rig.move(bad);
    rig.cycle([&] { rig.call(move, true); });
    EXPECT_EQ(move.ErrorID, 201);
  }
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(MoveAbsolute, NotCalledDuringMotion) {
  AxisRig rig;
  rig.axis.fSWMaxDeceleration = 50; // less than the command's 100
  rig.powerUp();
  auto move = rig.move(1000);
  for (int i = 0; i < 1000; ++i)
    rig.cycle([&] { rig.call(move, true); });
  EXPECT_NEAR(rig.axis.fSetVelocity, 100, 1e-9);
  double before = rig.axis.fSetVelocity;
  for (int i = 0; i < 1000; ++i) {
    rig.idle();
    EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
    EXPECT_NEAR(before - rig.axis.fSetVelocity, 0.1, 1e-9) << "brakes without a jump";
    before = rig.axis.fSetVelocity;
  }
  rig.idle();
  EXPECT_EQ(rig.axis.fSetVelocity, 0.0);
  EXPECT_NEAR(rig.axis.fSetPosition, 100, 1e-9);
  EXPECT_EQ(rig.axis.wFBErrorID, 30);
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.Error, 1);
  EXPECT_EQ(move.ErrorID, 30);
  // No command works until the error is acknowledged.
  auto again = rig.move(0);
  rig.cycle([&] { rig.call(again, true); });
  EXPECT_EQ(again.ErrorID, 34);
  rig.axis.bErrorAckn = 1;
  rig.idle(2);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  rig.cycle([&] { rig.call(again, false); });
  EXPECT_GT(runOut(rig, again), 0);
  EXPECT_EQ(rig.axis.fSetPosition, 0.0);
}

TEST(MoveAbsolute, ExchangedAxis) {
  AxisRig rig;
  rig.powerUp();
  AxisRig other;
  other.powerUp();
  auto move = rig.move(1000);
  for (int i = 0; i < 10; ++i)
    rig.cycle([&] { rig.call(move, true); });
  move.Axis = &other.axis;
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.ErrorID, 32);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(other.axis.nAxisState, state::kStandstill);
  move.Axis = nullptr;
  rig.cycle([&] { rig.call(move, false); });
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.ErrorID, 31);
}

TEST(MoveAbsolute, SoftwareLimits) {
  AxisRig rig;
  rig.axis.bSWLimitEnable = 1;
  rig.axis.fSWLimitNegative = -10;
  rig.axis.fSWLimitPositive = 50;
  rig.powerUp();
  auto move = rig.move(200);
  double furthest = 0;
  double before = 0;
  for (int i = 0; i < 4000; ++i) {
    rig.cycle([&] { rig.call(move, true); });
    EXPECT_LE(std::fabs(rig.axis.fSetVelocity - before), 0.1 + 1e-9);
    before = rig.axis.fSetVelocity;
    furthest = std::max(furthest, rig.axis.fSetPosition);
  }
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.bSWEndSwitchActive, 1);
  EXPECT_EQ(rig.axis.wFBErrorID, 10);
  EXPECT_EQ(move.Error, 1);
  EXPECT_EQ(move.ErrorID, 10);
  EXPECT_NEAR(furthest, 100.1, 0.2) << "from 100 u/s it takes 50 u to brake";
  // After the acknowledgement the axis may come back, but go no further out.
  rig.axis.bErrorAckn = 1;
  rig.idle(2);
  auto out = rig.move(300);
  rig.cycle([&] { rig.call(out, true); });
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  rig.idle(200);
  rig.axis.bErrorAckn = 1;
  rig.idle(2);
  auto back = rig.move(0);
  EXPECT_GT(runOut(rig, back), 0);
  EXPECT_EQ(back.Done, 1);
  EXPECT_EQ(rig.axis.bSWEndSwitchActive, 0);
}

TEST(MoveAbsolute, BufferedFollowsWithoutInterrupting) {
  AxisRig rig;
  rig.powerUp();
  auto first = rig.move(100, 100, 1000, 1000);
  auto second = rig.move(150, 100, 1000, 1000);
  second.BufferMode = 1;
  bool stood = false;
  for (int i = 0; i < 3000; ++i) {
    rig.cycle([&] {
      rig.call(first, true);
      rig.call(second, i >= 10);
    });
    if (i >= 10 && first.Done == 0) {
      EXPECT_EQ(second.Busy, 1);
      EXPECT_EQ(second.Active, 0);
    }
    stood = stood || rig.axis.fSetPosition == 100.0;
  }
  EXPECT_TRUE(stood);
  EXPECT_EQ(first.Done, 1);
  EXPECT_EQ(second.Done, 1);
  EXPECT_EQ(rig.axis.fSetPosition, 150.0);
}

TEST(MoveAbsolute, AbortingTakesTheTurnOfAWaitingCommand) {
  AxisRig rig;
  rig.powerUp();
  auto first = rig.move(100);
  auto second = rig.move(150);
  auto third = rig.move(-20);
  second.BufferMode = 1;
  for (int i = 0; i < 40; ++i)
    rig.cycle([&] {
      rig.call(first, true);
      rig.call(second, i >= 10);
      rig.call(third, i >= 20);
    });
  EXPECT_EQ(first.CommandAborted, 1);
  EXPECT_EQ(second.CommandAborted, 1);
  EXPECT_EQ(third.Active, 1);
}

TEST(MoveAbsolute, OwnerNumbersWrapWithoutConfusion) {
  AxisRig rig;
  rig.powerUp();
  auto stale = rig.move(1000);
  rig.cycle([&] { rig.call(stale, true); });
  EXPECT_EQ(rig.axis.iOwner, 1);
  auto busy = rig.move(-1e7);
  for (int i = 0; i < 32767; ++i) {
    rig.cycle([&] {
      rig.call(busy, true);
      rig.call(busy, false);
    });
    ASSERT_EQ(busy.Busy, 1);
    ASSERT_GT(rig.axis.iOwner, 0);
  }
  EXPECT_EQ(rig.axis.iOwner, 1) << "the number of the stale block again";
  rig.cycle([&] {
    rig.call(busy, false);
    rig.call(stale, true);
  });
  EXPECT_EQ(stale.CommandAborted, 1);
}

} // namespace
