// Couplings among other motions: buffer modes, what is refused, who ends when. The master runs with
// 10 u/s.
#include "tests/unit/axis/axis_rig.hpp"

#include "runtime/axis/forecast.hpp"

#include "st/SM_PLCopen/MC_CamOut.h"
#include "st/SM_PLCopen/MC_GearIn.h"
#include "st/SM_PLCopen/MC_GearInPos.h"
#include "st/SM_PLCopen/MC_GearOut.h"
#include "st/SM_PLCopen/MC_MoveAbsolute.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_Phasing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

namespace pl = ::st::SM_PLCopen;
namespace basic = ::st::SM_DriveBasic;
namespace state = stride::axis::state;
using stride::test::AxisRig;
using stride::test::fresh;

constexpr int16_t kBuffered = basic::MC_BUFFER_MODE__Buffered;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class Couplings : public testing::Test {
protected:
  Couplings() {
    rig.axis.fSWMaxDeceleration = 100;
    master.iMovementType = 1;
    master.fTaskCycle = 0.001;
    master.bRegulatorOn = 1;
    master.fSetVelocity = 10;
    rig.powerUp();
    gear = coupled<pl::MC_GearIn>();
    gear.Acceleration = gear.Deceleration = 50;
    sync = coupled<pl::MC_GearInPos>();
    move = rig.move(20, 20, 50, 50);
    velocity = fresh<pl::MC_MoveVelocity>();
    velocity.Axis = &rig.axis;
    velocity.Velocity = 5;
    velocity.Acceleration = velocity.Deceleration = 50;
    velocity.Direction = basic::MC_Direction__positive;
  }

  template <class Block> Block coupled() {
    auto block = fresh<Block>();
    block.Master = &master;
    block.Slave = &rig.axis;
    return block;
  }

  /// One cycle: the master, then `program`. Nothing may jump, and no axis may be left alone.
  template <class Program> void cycle(Program program) {
    const double before = rig.axis.fSetPosition;
    const double velocityBefore = rig.axis.fSetVelocity;
    rig.cycle([&] {
      master.fSetPosition += master.fSetVelocity * 0.001;
      program();
    });
    ASSERT_LE(std::fabs(rig.axis.fSetVelocity - velocityBefore), 0.06);
    ASSERT_NEAR(rig.axis.fSetPosition - before,
                0.5 * (rig.axis.fSetVelocity + velocityBefore) * 0.001, 3e-5);
  }

  template <class Block> void call(Block &block, bool execute) { rig.call(block, execute); }

  AxisRig rig;
  stride::axis::AxisRef master = fresh<stride::axis::AxisRef>();
  pl::MC_GearIn gear{};           ///< 1 : 1, ready in 0.2 s from rest.
  pl::MC_GearInPos sync{};        ///< 1 : 1.
  pl::MC_MoveAbsolute move{};     ///< To 20 with 20 u/s.
  pl::MC_MoveVelocity velocity{}; ///< 5 u/s.
};

TEST_F(Couplings, WaitForAMove) {
  gear.BufferMode = kBuffered;
  for (const bool gearFirst : {false, true}) {
    int begun = -1, done = -1;
    call(move, false);
    move.Position = rig.axis.fSetPosition + 10;
    for (int i = 0; i < 3000 && !gear.InGear; ++i) {
      cycle([&] {
        if (gearFirst)
          call(gear, i >= 10);
        call(move, true);
        if (!gearFirst)
          call(gear, i >= 10);
      });
      if (i == 100) {
        EXPECT_TRUE(gear.Busy && !gear.Active && move.Active);
        EXPECT_EQ(rig.axis.nAxisState, state::kDiscrete);
      }
      if (gear.Active && begun < 0)
        begun = i;
      if (move.Done && done < 0) {
        done = i;
        EXPECT_EQ(rig.axis.fSetPosition, move.Position) << "the place is reached, not blended";
      }
      ASSERT_FALSE(gear.Error || move.Error || move.CommandAborted || gear.CommandAborted);
    }
    EXPECT_GT(done, 0);
    EXPECT_EQ(begun, gearFirst ? done + 1 : done);
    EXPECT_TRUE(gear.InGear);
    EXPECT_EQ(rig.axis.nAxisState, state::kSynchronized);
    // To rest for the second round.
    auto stop = rig.stop(50);
    for (int i = 0; i < 1000; ++i)
      cycle([&] {
        call(stop, true);
        call(gear, false);
      });
    cycle([&] { call(stop, false); });
  }
}

TEST_F(Couplings, WaitForAVelocity) {
  gear.BufferMode = kBuffered;
  for (int i = 0; i < 1000 && !gear.InGear; ++i) {
    cycle([&] {
      call(velocity, true);
      call(gear, i >= 10);
    });
    if (i == 50) {
      EXPECT_TRUE(gear.Busy && !gear.Active);
    }
    // 5 u/s take 100 cycles.
    ASSERT_EQ(gear.Active != 0, i >= 99) << i;
    ASSERT_FALSE(velocity.CommandAborted);
  }
  EXPECT_TRUE(gear.InGear && velocity.InVelocity);
}

TEST_F(Couplings, TakeAVelocityThatHasBeenReached) {
  gear.BufferMode = kBuffered;
  for (const bool gearFirst : {false, true})
    for (int i = 0; i < 1000; ++i) {
      if (i == 0) {
        call(velocity, false);
        call(gear, false);
      }
      cycle([&] {
        if (gearFirst)
          call(gear, i >= 500);
        call(velocity, true);
        if (!gearFirst)
          call(gear, i >= 500);
      });
      if (i >= 502) {
        ASSERT_TRUE(gear.Active && velocity.CommandAborted) << i;
      }
      ASSERT_FALSE(gear.Error) << gear.ErrorID;
    }
  EXPECT_TRUE(gear.InGear);
}

TEST_F(Couplings, AMoveWaitsForTheGear) {
  move.BufferMode = kBuffered;
  move.Position = 100;
  for (const bool moveFirst : {false, true}) {
    int inGear = 0, aborted = 0;
    call(move, false);
    call(gear, false);
    for (int i = 0; i < 1000; ++i) {
      cycle([&] {
        if (moveFirst)
          call(move, i >= 10);
        call(gear, true);
        if (!moveFirst)
          call(move, i >= 10);
      });
      inGear += gear.InGear ? 1 : 0;
      aborted += gear.CommandAborted ? 1 : 0;
      if (i > 10 && i < 150) {
        ASSERT_TRUE(gear.Active && move.Busy && !move.Active) << i;
      }
      ASSERT_FALSE(gear.Error || move.Error);
    }
    EXPECT_GT(inGear, 500) << "InGear stays with Execute: the command has come to its end";
    EXPECT_EQ(aborted, 0);
    EXPECT_TRUE(move.Active);
    EXPECT_EQ(rig.axis.nAxisState, state::kDiscrete);
    auto stop = rig.stop(50);
    for (int i = 0; i < 1000; ++i)
      cycle([&] {
        call(stop, true);
        call(gear, false);
        call(move, false);
      });
    cycle([&] { call(stop, false); });
  }
}

TEST_F(Couplings, ACommandThatComesLaterTakesTheGearAtOnce) {
  move.BufferMode = kBuffered;
  move.Position = 100;
  for (int i = 0; i < 1000; ++i) {
    cycle([&] {
      call(gear, true);
      call(move, i >= 500);
    });
    ASSERT_EQ(gear.InGear != 0, i >= 199 && i < 501) << i;
    ASSERT_EQ(gear.CommandAborted != 0, i >= 501) << i;
    ASSERT_EQ(move.Active != 0, i >= 501) << i;
  }
}

TEST_F(Couplings, GearsWaitForGears) {
  auto second = gear;
  second.RatioNumerator = 2;
  second.BufferMode = kBuffered;
  for (int i = 0; i < 1000; ++i) {
    cycle([&] {
      call(second, i >= 10);
      call(gear, true);
    });
    ASSERT_EQ(second.Active != 0, i >= 200) << i;
  }
  EXPECT_TRUE(second.InGear);
  EXPECT_NEAR(rig.axis.fSetVelocity, 20, 1e-12);
}

TEST_F(Couplings, AFifthOneIsRefused) {
  auto last = gear;
  pl::MC_GearIn waiting[5];
  for (auto &block : waiting) {
    block = gear;
    block.BufferMode = kBuffered;
  }
  cycle([&] {
    call(gear, true);
    for (auto &block : waiting)
      call(block, true);
  });
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(waiting[i].Busy && !waiting[i].Error);
  EXPECT_EQ(waiting[4].ErrorID, 34);
  // An aborting command sends all of them away.
  cycle([&] {
    call(gear, true);
    for (auto &block : waiting)
      call(block, true);
    call(last, true);
  });
  cycle([&] {
    call(gear, true);
    for (auto &block : waiting)
      call(block, true);
    call(last, true);
  });
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(waiting[i].CommandAborted && !waiting[i].Busy);
  EXPECT_TRUE(gear.CommandAborted && last.Active);
}

TEST_F(Couplings, TheMotionBeforeGoesOnUntilTheMasterIsNear) {
  // 20 u/s to 20: the master is at 10 after a second.
  sync.MasterSyncPosition = 30;
  sync.SlaveSyncPosition = 40;
  sync.MasterStartDistance = 20;
  int started = -1;
  for (int i = 0; i < 4000 && !sync.InSync; ++i) {
    cycle([&] {
      call(move, true);
      call(sync, i >= 100);
    });
    if (i == 500) {
      EXPECT_TRUE(sync.Busy && !sync.Active && !sync.StartSync && move.Active);
    }
    if (sync.StartSync && started < 0)
      started = i;
    ASSERT_FALSE(sync.Error) << sync.ErrorID;
  }
  EXPECT_NEAR(started, 1000, 25);
  EXPECT_TRUE(move.CommandAborted && sync.InSync);
}

TEST_F(Couplings, AnotherCommandEndsTheWaiting) {
  sync.MasterSyncPosition = 1e6;
  sync.MasterStartDistance = 20;
  for (int i = 0; i < 300; ++i)
    cycle([&] { call(sync, true); });
  EXPECT_TRUE(sync.Busy && !sync.Active);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  cycle([&] {
    call(move, true);
    call(sync, true);
  });
  EXPECT_TRUE(sync.CommandAborted && !sync.Busy && move.Active);
}

TEST_F(Couplings, AnErrorEndsTheWaiting) {
  sync.MasterSyncPosition = 1e6;
  sync.MasterStartDistance = 20;
  for (int i = 0; i < 300; ++i)
    cycle([&] { call(sync, true); });
  rig.drive->raiseError(0, 77);
  for (int i = 0; i < 10; ++i)
    rig.cycle([&] { call(sync, true); });
  EXPECT_EQ(sync.ErrorID, 2);
  EXPECT_FALSE(sync.Busy);
}

TEST_F(Couplings, BehindAVelocityTheSlaveKeepsItWhileItWaits) {
  sync.BufferMode = kBuffered;
  sync.MasterSyncPosition = 30;
  sync.SlaveSyncPosition = 25;
  sync.MasterStartDistance = 20;
  for (int i = 0; i < 4000 && !sync.InSync; ++i) {
    cycle([&] {
      call(velocity, true);
      call(sync, i >= 10);
    });
    if (i == 500) {
      EXPECT_TRUE(sync.Active && !sync.StartSync && rig.axis.fSetVelocity == 5);
      EXPECT_EQ(rig.axis.nAxisState, state::kSynchronized);
    }
  }
  EXPECT_TRUE(sync.InSync);
  EXPECT_NEAR(rig.axis.fSetPosition - 25, master.fSetPosition - 30, 1e-9);
}

TEST_F(Couplings, GearOutKeepsTheVelocity) {
  auto out = fresh<pl::MC_GearOut>();
  out.Slave = &rig.axis;
  cycle([&] { call(out, true); });
  EXPECT_EQ(out.ErrorID, 34) << "not coupled";
  cycle([&] { call(out, false); });
  for (const bool outFirst : {false, true}) {
    for (int i = 0; i < 500; ++i)
      cycle([&] { call(gear, true); });
    for (int i = 0; i < 100; ++i) {
      cycle([&] {
        if (outFirst)
          call(out, true);
        call(gear, true);
        if (!outFirst)
          call(out, true);
      });
      ASSERT_TRUE(out.Done && out.Busy && !out.Error);
      ASSERT_EQ(rig.axis.nAxisState, state::kContinuous);
      ASSERT_EQ(rig.axis.fSetVelocity, 10);
      ASSERT_EQ(gear.CommandAborted != 0, outFirst || i > 0);
    }
    cycle([&] { call(out, false); });
    EXPECT_FALSE(out.Done);
    EXPECT_TRUE(out.Busy) << "it moves the axis";
    call(gear, false);
    // What comes then does not abort it.
    cycle([&] {
      call(gear, true);
      call(out, false);
    });
    EXPECT_FALSE(out.Busy || out.Done || out.Error);
    call(gear, false);
  }
}

TEST_F(Couplings, CamOutAtRestIsStandstill) {
  master.fSetVelocity = 0;
  auto out = fresh<pl::MC_CamOut>();
  out.Slave = &rig.axis;
  cycle([&] { call(gear, true); });
  EXPECT_TRUE(gear.InGear);
  cycle([&] {
    call(gear, true);
    call(out, true);
  });
  EXPECT_TRUE(out.Done && !out.Busy);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
}

TEST_F(Couplings, ASuperimposedMotionIsAdded) {
  auto add = fresh<pl::MC_MoveSuperImposed>();
  add.Axis = &rig.axis;
  add.Distance = 3;
  add.VelocityDiff = 5;
  add.Acceleration = add.Deceleration = 50;
  for (int i = 0; i < 300; ++i)
    cycle([&] { call(gear, true); });
  const double before = rig.axis.fSetPosition - master.fSetPosition;
  for (int i = 0; i < 1500; ++i)
    rig.cycle([&] {
      master.fSetPosition += 0.01;
      call(gear, true);
      call(add, true);
    });
  EXPECT_TRUE(add.Done && gear.InGear && !gear.CommandAborted);
  EXPECT_NEAR(rig.axis.fSetPosition - master.fSetPosition - before, 3, 1e-9);
}

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
