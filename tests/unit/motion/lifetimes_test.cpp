// How long the outputs of motion blocks stay, and how a command ends that is not let end: manual
// section 5.2 and PLCopen Motion Control 1.0. For every block that moves an axis by an Execute pin.
#include "tests/unit/motion/state_scene.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using stride::test::Actor;
using stride::test::axisState;
using stride::test::fresh;
using stride::test::makeActor;
using stride::test::Shown;
using stride::test::StateScene;

struct Kind {
  const char *block;
  bool ends;        ///< By itself; the others go on with a velocity once they are done.
  bool outOfMotion; ///< Tried from an axis in motion: blocks that brake.
};

void PrintTo(const Kind &kind, std::ostream *out) { *out << kind.block; }

constexpr Kind kKinds[] = {
    {"MC_MoveAbsolute", true, false},
    {"MC_MoveRelative", true, false},
    {"MC_MoveAdditive", true, false},
    {"MC_MoveSuperImposed", true, false},
    {"MC_PositionProfile", true, false},
    {"MC_VelocityProfile", true, false},
    {"MC_AccelerationProfile", true, false},
    {"MC_Halt", true, true},
    {"MC_Stop", true, true},
    {"MC_MoveVelocity", false, false},
    {"SMC_MoveContinuousAbsolute", false, false},
    {"SMC_MoveContinuousRelative", false, false},
    {"MC_GearIn", false, false},
    {"MC_GearInPos", false, false},
    {"MC_Phasing", false, false},
    {"MC_CamIn", false, false},
};

class Lifetimes : public testing::TestWithParam<Kind> {
protected:
  Lifetimes()
      : scene(GetParam().outOfMotion ? "continuous_motion" : "standstill",
              GetParam().outOfMotion ? "MC_MoveVelocity in velocity" : "switched on"),
        block(makeActor(scene.rig, GetParam().block)) {
    scene.owner.reset();
  }

  void cycle(bool execute) {
    scene.rig.cycle([&] { block.call(execute); });
  }
  [[nodiscard]] Shown shown() const { return block.show(); }
  [[nodiscard]] bool isStop() const { return std::string(GetParam().block) == "MC_Stop"; }

  StateScene scene;
  Actor block;
};

TEST_P(Lifetimes, ExecuteForOneCycleShowsDoneOnce) {
  cycle(true);
  int done = 0;
  for (int i = 0; i < 10000; ++i) {
    cycle(false);
    ASSERT_FALSE(shown().error) << shown().errorId;
    ASSERT_FALSE(shown().aborted);
    done += shown().done ? 1 : 0;
  }
  EXPECT_EQ(done, 1);
  EXPECT_EQ(shown().busy, !GetParam().ends) << "one with a velocity goes on";
}

TEST_P(Lifetimes, LongExecuteKeepsDone) {
  int since = 0;
  for (int i = 0; i < 10000; ++i) {
    cycle(true);
    ASSERT_FALSE(shown().error) << shown().errorId;
    if (since > 0 || shown().done)
      ++since;
    ASSERT_EQ(shown().done, since > 0) << "cycle " << i;
  }
  EXPECT_GT(since, 1000);
  cycle(false);
  EXPECT_FALSE(shown().done);
}

TEST_P(Lifetimes, AnotherEdgeOnTheWayStartsAnew) {
  for (int i = 0; i < 50; ++i)
    cycle(true);
  ASSERT_TRUE(shown().busy && !shown().done);
  cycle(false);
  EXPECT_FALSE(shown().done || shown().aborted || shown().error);
  cycle(true);
  EXPECT_FALSE(shown().done || shown().aborted || shown().error);
  EXPECT_TRUE(shown().busy);
  int i = 0;
  for (; i < 10000 && !shown().done; ++i)
    cycle(true);
  EXPECT_TRUE(shown().done);
  EXPECT_FALSE(shown().aborted);
}

TEST_P(Lifetimes, NotCalledAnyMoreIsAnErrorStop) {
  for (int i = 0; i < 50; ++i)
    cycle(true);
  for (int i = 0; i < 1000; ++i)
    scene.rig.idle();
  EXPECT_EQ(scene.rig.axis.nAxisState, axisState("errorstop"));
  EXPECT_EQ(scene.rig.axis.fSetVelocity, 0);
  const int number = isStop() ? 184 : 30;
  EXPECT_EQ(scene.rig.axis.wFBErrorID, number);
  cycle(true);
  EXPECT_EQ(shown().errorId, number);
  EXPECT_FALSE(shown().busy || shown().done || shown().aborted);
  cycle(false);
  EXPECT_EQ(shown().errorId, 0);
}

TEST_P(Lifetimes, AnotherAxisIsAnError) {
  for (int i = 0; i < 50; ++i)
    cycle(true);
  auto other = fresh<stride::axis::AxisRef>();
  block.bind(other);
  cycle(true);
  EXPECT_EQ(shown().errorId, 32);
  EXPECT_FALSE(shown().busy || shown().done || shown().aborted);
  for (int i = 0; i < 1000; ++i)
    scene.rig.idle();
  EXPECT_EQ(scene.rig.axis.nAxisState, axisState("errorstop")) << "nobody moves it any more";
}

TEST_P(Lifetimes, WithoutPowerItEnds) {
  for (int i = 0; i < 50; ++i)
    cycle(true);
  scene.rig.power.bRegulatorOn = 0;
  for (int i = 0; i < 20 && !shown().error; ++i)
    cycle(true);
  EXPECT_EQ(shown().errorId, 20);
  EXPECT_FALSE(shown().busy || shown().done || shown().aborted);
  EXPECT_EQ(scene.rig.axis.iOwner, 0);
  EXPECT_EQ(scene.rig.axis.nAxisState, axisState("power_off"));
}

TEST_P(Lifetimes, ADriveErrorEndsIt) {
  for (int i = 0; i < 50; ++i)
    cycle(true);
  scene.rig.drive->raiseError(0, 77);
  for (int i = 0; i < 20 && !shown().error; ++i)
    cycle(true);
  EXPECT_EQ(shown().errorId, 2);
  EXPECT_FALSE(shown().busy || shown().done || shown().aborted);
  EXPECT_EQ(scene.rig.axis.nAxisState, axisState("errorstop"));
}

TEST_P(Lifetimes, NoTaskCycleIsAnError) {
  scene.rig.axis.fTaskCycle = 0;
  scene.rig.power.Enable = 0; // it would say so, too
  cycle(true);
  EXPECT_EQ(shown().errorId, 110);
  EXPECT_FALSE(shown().busy || shown().done);
}

/// Called between the motion below, which has covered its way in this cycle, and what is added to
/// it, which has not.
TEST(TakenOverWithinACycle, WhatIsAddedCoversItsWay) {
  for (const char *const name :
       {"MC_MoveAbsolute", "MC_MoveVelocity", "MC_PositionProfile", "MC_VelocityProfile",
        "MC_AccelerationProfile", "MC_Halt", "MC_Stop", "MC_Jog", "MC_GearIn", "MC_GearInPos",
        "MC_CamIn", "SMC_TrackAxis"}) {
    SCOPED_TRACE(name);
    StateScene scene("continuous_motion", "MC_MoveVelocity in velocity");
    Actor taker = makeActor(scene.rig, name);
    Actor adding = makeActor(scene.rig, "MC_MoveSuperImposed");
    const auto &axis = scene.rig.axis;
    bool takes = false;
    double before = 0;
    double velocity = 0;
    for (int i = 0; i < 400; ++i) {
      before = axis.fSetPosition;
      velocity = axis.fSetVelocity;
      takes = i >= 200;
      scene.rig.cycle([&] {
        scene.owner->call(true);
        if (takes)
          taker.call(true);
        adding.call(true);
      });
      // Twice the greatest acceleration of a block here, and one of those that are added.
      const double way = axis.fSetPosition - before;
      ASSERT_NEAR(way / scene.rig.cycleSeconds, 0.5 * (velocity + axis.fSetVelocity), 0.2)
          << "cycle " << i;
    }
    EXPECT_TRUE(taker.show().busy || taker.show().done) << taker.show().errorId;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lifetimes, testing::ValuesIn(kKinds),
                         [](const auto &info) { return std::string(info.param.block); });

} // namespace
