// Couplings among other motions: buffer modes, what is refused, who ends when. The master runs with
// 10 u/s.
#include "tests/unit/motion/couplings.hpp"

#include "st/SM_PLCopen/MC_CamOut.h"
#include "st/SM_PLCopen/MC_GearIn.h"
#include "st/SM_PLCopen/MC_GearOut.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

namespace pl = ::st::SM_PLCopen;
namespace basic = ::st::SM_DriveBasic;
namespace state = stride::axis::state;
using stride::test::Couplings;
using stride::test::fresh;

constexpr int16_t kBuffered = basic::MC_BUFFER_MODE__Buffered;

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
} // namespace
