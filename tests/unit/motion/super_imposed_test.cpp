// MC_HaltSuperImposed: what it leaves of a superimposed motion, and that the motion below does not
// notice. Every ramp type.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_HaltSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveSuperImposed.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace axis = stride::axis;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

class SuperImposed : public testing::TestWithParam<int> {
protected:
  void SetUp() override {
    ASSERT_GT(rig.powerUp(), 0);
    rig.axis.eRampType = static_cast<int16_t>(GetParam());
    rig.axis.fJerk = 2000;
    below.Axis = add.Axis = halt.Axis = &rig.axis;
    below.Velocity = 10;
    below.Acceleration = below.Deceleration = 100;
    below.Direction = -1;
    add.Distance = 40;
    add.VelocityDiff = 30;
    add.Acceleration = add.Deceleration = 200;
    halt.Deceleration = 120;
  }

  void cycle(bool haltFirst = false) {
    rig.cycle([&] {
      if (moving)
        rig.call(below, true);
      if (haltFirst)
        rig.call(halt, stopping);
      rig.call(add, adding);
      if (!haltFirst)
        rig.call(halt, stopping);
    });
  }

  AxisRig rig;
  pl::MC_MoveVelocity below = fresh<pl::MC_MoveVelocity>();
  pl::MC_MoveSuperImposed add = fresh<pl::MC_MoveSuperImposed>();
  pl::MC_HaltSuperImposed halt = fresh<pl::MC_HaltSuperImposed>();
  bool moving = true;
  bool adding = false;
  bool stopping = false;
};

TEST_P(SuperImposed, TheMotionBelowGoesOn) {
  for (const bool haltFirst : {false, true}) {
    adding = stopping = false;
    for (int i = 0; i < 400; ++i)
      cycle();
    EXPECT_EQ(rig.axis.fSetVelocity, -10);
    const double start = rig.axis.fSetPosition;
    adding = true;
    for (int i = 0; i < 400; ++i)
      cycle(haltFirst);
    EXPECT_NEAR(rig.axis.fSetVelocity, 20, 1e-9);
    const double added = rig.axis.fSetPosition - start + 10 * 0.4;
    stopping = true;
    double last = rig.axis.fSetVelocity;
    double lastPosition = rig.axis.fSetPosition;
    int cycles = 0;
    do {
      cycle(haltFirst);
      ++cycles;
      EXPECT_EQ(add.CommandAborted, haltFirst || cycles > 1 ? 1 : 0) << cycles;
      EXPECT_LE(std::fabs(rig.axis.fSetVelocity - last), 120 * 0.001 * M_PI / 2 + 1e-9);
      EXPECT_NEAR(rig.axis.fSetPosition - lastPosition, 0.0005 * (last + rig.axis.fSetVelocity),
                  1e-4);
      EXPECT_EQ(below.InVelocity, 1);
      last = rig.axis.fSetVelocity;
      lastPosition = rig.axis.fSetPosition;
    } while (halt.Busy != 0 && cycles < 2000);
    EXPECT_EQ(halt.Done, 1);
    EXPECT_EQ(halt.Error, 0);
    EXPECT_EQ(rig.axis.fSetVelocity, -10);
    // 30 u/s were taken away symmetrically: the mean is half of it.
    const double braking = 0.5 * 30 * cycles * 0.001;
    EXPECT_NEAR(rig.axis.fSetPosition - start, added + braking - 10 * (0.4 + cycles * 0.001), 0.05);
    const double end = rig.axis.fSetPosition;
    for (int i = 0; i < 100; ++i)
      cycle(haltFirst);
    EXPECT_NEAR(rig.axis.fSetPosition, end - 1, 1e-9) << "what has been added stays";
  }
}

TEST_P(SuperImposed, AloneTheAxisComesToStandstill) {
  moving = false;
  adding = true;
  for (int i = 0; i < 300; ++i)
    cycle();
  EXPECT_EQ(rig.axis.nAxisState, state::kDiscrete);
  stopping = true;
  for (int i = 0; i < 600; ++i)
    cycle();
  EXPECT_EQ(halt.Done, 1);
  EXPECT_EQ(add.CommandAborted, 1);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
  EXPECT_LT(rig.axis.fSetPosition, 39);
  EXPECT_GT(rig.axis.fSetPosition, 5);
}

TEST_P(SuperImposed, WithoutOneItIsDoneAtOnceAndBadInputsAreRefused) {
  stopping = true;
  cycle();
  EXPECT_EQ(halt.Done, 1);
  EXPECT_EQ(halt.Busy, 0);
  stopping = false;
  cycle();
  EXPECT_EQ(halt.Done, 0);
  for (const double bad : {0.0, -3.0, static_cast<double>(NAN)}) {
    halt.Deceleration = bad;
    stopping = true;
    cycle();
    EXPECT_EQ(halt.ErrorID, axis::error::kSuperimposedValues);
    stopping = false;
    cycle();
    EXPECT_EQ(halt.Error, 0);
  }
}

TEST_P(SuperImposed, AStopEndsBoth) {
  adding = true;
  for (int i = 0; i < 300; ++i)
    cycle();
  stopping = true;
  cycle();
  auto stop = rig.stop(300);
  rig.cycle([&] {
    rig.call(stop, true);
    rig.call(add, adding);
    rig.call(halt, stopping);
  });
  EXPECT_EQ(halt.CommandAborted, 1);
  EXPECT_EQ(halt.Busy, 0);
}

INSTANTIATE_TEST_SUITE_P(Ramps, SuperImposed, testing::Range(0, 4));

} // namespace
