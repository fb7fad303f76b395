// MC_Jog: how long its outputs stay, who takes the axis from it, the software limits, refused
// inputs.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_Jog.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace axis = stride::axis;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

class KeysTest : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_GT(rig.powerUp(), 0);
    jog.Axis = &rig.axis;
    jog.Velocity = 20;
    jog.Acceleration = 100;
    jog.Deceleration = 50;
  }

  void cycle(int cycles = 1) {
    for (int i = 0; i < cycles; ++i)
      rig.cycle([&] { jog.body__(rig.ctx); });
  }

  AxisRig rig;
  pl::MC_Jog jog = fresh<pl::MC_Jog>();
};

TEST_F(KeysTest, JogRunsWhileItsKeyIsPressed) {
  jog.JogBackward = 1;
  cycle(200); // 20 u/s at 100 u/s^2
  EXPECT_EQ(rig.axis.fSetVelocity, -20);
  EXPECT_EQ(rig.axis.nAxisState, state::kContinuous);
  jog.Deceleration = 1; // read when the key was pressed
  jog.JogBackward = 0;
  cycle(399);
  EXPECT_EQ(jog.Busy, 1);
  EXPECT_NEAR(rig.axis.fSetVelocity, -0.05, 1e-9);
  cycle();
  EXPECT_EQ(jog.Busy, 0);
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
  EXPECT_NEAR(rig.axis.fSetPosition, -2 - 4, 1e-9);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
}

TEST_F(KeysTest, BothKeysBrakeAndTheOneThatIsLeftMovesAgain) {
  jog.JogForward = 1;
  cycle(200);
  jog.JogBackward = 1;
  cycle(100);
  EXPECT_NEAR(rig.axis.fSetVelocity, 15, 1e-9);
  jog.JogForward = 0;
  cycle(300);
  EXPECT_NEAR(rig.axis.fSetVelocity, 0, 1e-9);
  EXPECT_EQ(jog.Busy, 1);
  cycle(200);
  EXPECT_EQ(rig.axis.fSetVelocity, -20);
}

TEST_F(KeysTest, BothKeysAtOnceAreNone) {
  jog.JogForward = jog.JogBackward = 1;
  cycle(10);
  EXPECT_EQ(jog.Busy, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST_F(KeysTest, AnotherCommandEndsItAndAPressAnewMovesAgain) {
  auto other = fresh<pl::MC_MoveVelocity>();
  other.Axis = &rig.axis;
  other.Velocity = 7;
  other.Acceleration = other.Deceleration = 100;
  other.Direction = 1;
  jog.JogForward = 1;
  cycle(50);
  rig.cycle([&] {
    rig.call(other, true);
    jog.body__(rig.ctx);
  });
  EXPECT_EQ(jog.CommandAborted, 1);
  EXPECT_EQ(jog.Busy, 0);
  for (int i = 0; i < 300; ++i)
    rig.cycle([&] {
      rig.call(other, true);
      jog.body__(rig.ctx);
    });
  EXPECT_EQ(jog.CommandAborted, 1) << "as long as the key is pressed";
  EXPECT_EQ(rig.axis.fSetVelocity, 7);
  jog.JogForward = 0;
  rig.cycle([&] {
    rig.call(other, true);
    jog.body__(rig.ctx);
  });
  EXPECT_EQ(jog.CommandAborted, 0);
  jog.JogForward = 1;
  rig.cycle([&] {
    rig.call(other, true);
    jog.body__(rig.ctx);
  });
  EXPECT_EQ(jog.Busy, 1);
  cycle(200);
  EXPECT_EQ(rig.axis.fSetVelocity, 20);
}

TEST_F(KeysTest, AbortedWhileItBrakesIsShownOnce) {
  jog.JogForward = 1;
  cycle(200);
  jog.JogForward = 0;
  cycle(10);
  auto stop = rig.stop(80);
  rig.cycle([&] {
    rig.call(stop, true);
    jog.body__(rig.ctx);
  });
  EXPECT_EQ(jog.CommandAborted, 1);
  rig.cycle([&] {
    rig.call(stop, true);
    jog.body__(rig.ctx);
  });
  EXPECT_EQ(jog.CommandAborted, 0);
}

TEST_F(KeysTest, BeyondASoftwareLimitIsAnErrorStopAndTheWayBackIsOpen) {
  rig.axis.bSWLimitEnable = 1;
  rig.axis.fSWLimitPositive = 4;
  rig.axis.fSWLimitNegative = -100;
  jog.JogForward = 1;
  cycle(400);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(jog.ErrorId, axis::error::kSwLimits);
  EXPECT_EQ(jog.Busy, 0);
  cycle(800);
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
  EXPECT_NEAR(rig.axis.fSetPosition, 4 + 20.0 * 20 / 2 / 50, 0.03);
  jog.JogForward = 0;
  rig.axis.nAxisState = state::kStandstill; // MC_Reset
  cycle();
  EXPECT_EQ(jog.Error, 0);
  jog.JogBackward = 1;
  cycle(600);
  EXPECT_EQ(rig.axis.fSetVelocity, -20);
  EXPECT_EQ(jog.Error, 0);
}

TEST_F(KeysTest, RefusedInputsMoveNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    for (double *input : {&jog.Velocity, &jog.Acceleration, &jog.Deceleration}) {
      const double good = *input;
      *input = bad;
      jog.JogForward = 1;
      cycle(3);
      EXPECT_EQ(jog.ErrorId, axis::error::kMoveVelocityValues);
      EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
      *input = good;
      cycle(3);
      EXPECT_EQ(jog.Error, 1) << "as long as the key is pressed";
      jog.JogForward = 0;
      cycle();
      EXPECT_EQ(jog.Error, 0);
    }
  }
}

TEST_F(KeysTest, NotCalledAnyMoreIsAnErrorStop) {
  jog.JogForward = 1;
  cycle(200);
  rig.idle(2);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.wFBErrorID, axis::error::kNotCalled);
  cycle();
  EXPECT_EQ(jog.ErrorId, axis::error::kNotCalled);
}

TEST_F(KeysTest, WithoutPowerItEndsAndDoesNotBeginAgainByItself) {
  jog.JogForward = 1;
  cycle(50);
  rig.power.bRegulatorOn = 0;
  cycle(20);
  EXPECT_EQ(jog.ErrorId, axis::error::kNotPowered);
  rig.power.bRegulatorOn = 1;
  cycle(50);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(jog.Busy, 0);
}

} // namespace
