// MC_TorqueControl on a drive with a mass that regulates a torque.
#include "tests/unit/motion/state_scene.hpp"

#include "st/SM_DriveBasic/SMC_SetControllerMode.h"
#include "st/SM_PLCopen/MC_TorqueControl.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using stride::test::fresh;
using stride::test::ModeScene;
namespace axis = stride::axis;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

class TorqueControl : public testing::Test {
protected:
  TorqueControl() {
    block.Axis = &scene.rig.axis;
    block.Torque = 3;
    block.TorqueRamp = 50; // 0.05 Nm in a cycle of 1 ms
    block.Execute = 1;
  }

  void cycle(int cycles = 1) {
    for (int i = 0; i < cycles; ++i)
      scene.rig.cycle([&] { block.body__(scene.rig.ctx); });
  }
  void edge() {
    block.Execute = 0;
    cycle();
    block.Execute = 1;
    cycle();
  }

  ModeScene scene{1};
  axis::AxisRef &ref = scene.rig.axis;
  pl::MC_TorqueControl block = fresh<pl::MC_TorqueControl>();
};

TEST_F(TorqueControl, ReachesItsTorqueByTheRamp) {
  for (int i = 1; i <= 60; ++i) {
    cycle();
    ASSERT_NEAR(ref.fSetTorque, 0.05 * i, 1e-12);
    ASSERT_EQ(block.InTorque, i == 60) << i;
    ASSERT_EQ(block.Active, 1);
    ASSERT_EQ(ref.nAxisState, state::kContinuous);
  }
  cycle(10);
  EXPECT_EQ(ref.fSetTorque, 3);
  EXPECT_GT(ref.fActVelocity, 0);
  block.Torque = 1; // without an edge nothing
  cycle();
  EXPECT_EQ(ref.fSetTorque, 3);
  edge();
  EXPECT_NEAR(ref.fSetTorque, 2.95, 1e-12) << "from where the torque is";
  block.Direction = -1;
  edge();
  cycle(200);
  EXPECT_EQ(ref.fSetTorque, -1);
}

TEST_F(TorqueControl, ContinuousUpdateReadsInEveryCall) {
  block.ContinuousUpdate = 1;
  cycle(60);
  block.Torque = -0.5;
  block.TorqueRamp = 0;
  cycle();
  EXPECT_EQ(ref.fSetTorque, -0.5);
  EXPECT_EQ(block.InTorque, 1);
  block.Torque = NAN;
  cycle();
  EXPECT_EQ(block.ErrorID, axis::error::kInvalidParameter);
  EXPECT_EQ(ref.fSetTorque, 0);
  cycle();
  EXPECT_EQ(ref.nAxisState, state::kErrorStop);
}

TEST_F(TorqueControl, NeverMoreThanTheLimits) {
  ref.fSWMaxTorque = 2;
  block.TorqueRamp = 0;
  block.Torque = -7;
  cycle();
  EXPECT_EQ(ref.fSetTorque, -2);
  EXPECT_EQ(block.InTorque, 1);
  block.Velocity = 5;
  block.Torque = 1;
  edge();
  double fastest = 0;
  for (int i = 0; i < 3000; ++i) {
    cycle();
    fastest = std::max(fastest, ref.fActVelocity);
    ASSERT_TRUE(ref.fSetTorque == 0 || ref.fSetTorque == 1);
  }
  EXPECT_GT(fastest, 5);
  EXPECT_LT(fastest, 6);
}

TEST_F(TorqueControl, WrongInputsAreRefused) {
  const auto refused = [&] {
    edge();
    EXPECT_EQ(block.ErrorID, axis::error::kInvalidParameter);
    EXPECT_EQ(ref.nAxisState, state::kStandstill);
    EXPECT_EQ(ref.fSetTorque, 0);
  };
  block.Execute = 0;
  block.TorqueRamp = -1;
  refused();
  block.TorqueRamp = 1;
  block.Velocity = -1;
  refused();
  block.Velocity = 0;
  block.Direction = 0; // shortest
  refused();
  block.Direction = 1;
  block.Torque = INFINITY;
  refused();
}

TEST_F(TorqueControl, SwitchedBackTheBlockLosesTheAxis) {
  cycle(20);
  auto mode = fresh<::st::SM_DriveBasic::SMC_SetControllerMode>();
  mode.Axis = &ref;
  mode.bExecute = 1;
  for (int i = 0; i < 20; ++i)
    scene.rig.cycle([&] {
      mode.body__(scene.rig.ctx);
      block.body__(scene.rig.ctx);
    });
  EXPECT_EQ(block.ErrorID, axis::error::kWrongMode);
  EXPECT_EQ(block.Busy, 0);
  EXPECT_EQ(ref.fSetTorque, 0);
  edge();
  EXPECT_EQ(block.ErrorID, 75) << "no torque is regulated";
}

TEST_F(TorqueControl, WithoutPowerItEnds) {
  cycle(20);
  scene.rig.power.bRegulatorOn = 0;
  cycle(20);
  EXPECT_EQ(block.ErrorID, axis::error::kNotPowered);
  EXPECT_EQ(ref.fSetTorque, 0);
}

TEST_F(TorqueControl, NotCalledAnyMoreThereIsNoTorque) {
  cycle(20);
  scene.rig.idle(2);
  EXPECT_EQ(ref.nAxisState, state::kErrorStop);
  EXPECT_EQ(ref.fSetTorque, 0);
}

TEST_F(TorqueControl, AnotherOneTakesTheTorqueOver) {
  cycle(20);
  auto other = fresh<pl::MC_TorqueControl>();
  other.Axis = &ref;
  other.Torque = -1;
  other.Execute = 1;
  scene.rig.cycle([&] {
    other.body__(scene.rig.ctx);
    block.body__(scene.rig.ctx);
  });
  EXPECT_EQ(block.CommandAborted, 1);
  EXPECT_EQ(ref.fSetTorque, -1);
}

} // namespace
