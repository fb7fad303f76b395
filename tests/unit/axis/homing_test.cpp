// What SMC_Homing looks at in every call.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_Homing.h"

#include <gtest/gtest.h>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace dummy = stride::dummy;
namespace state = stride::axis::state;

struct HomingRun {
  explicit HomingRun(int16_t mode) {
    rig.start();
    rig.drive->bindData(0, &sim);
    rig.axis.bHWLimitEnable = 1;
    rig.powerUp();
    homing.Axis = &rig.axis;
    homing.fVelocitySlow = 2;
    homing.fVelocityFast = 20;
    homing.fAcceleration = homing.fDeceleration = 500;
    homing.nHomingMode = mode;
    homing.bEndSwitch = 1;
  }

  void cycles(int count) {
    for (int i = 0; i < count; ++i)
      rig.cycle([&] {
        homing.bExecute = 1;
        homing.body__(rig.ctx);
      });
  }

  AxisRig rig;
  dummy::DriveSim sim = fresh<dummy::DriveSim>();
  ::st::SM_DriveBasic::SMC_Homing homing = fresh<::st::SM_DriveBasic::SMC_Homing>();
};

constexpr int16_t kBackwards = 0; // FAST_BSLOW_S_STOP
constexpr int16_t kAcross = 4;    // FAST_SLOW_S_STOP

TEST(Homing, IgnoresTheLimitSwitchesAsLongAsItIsTold) {
  HomingRun run(kBackwards);
  run.homing.bIgnoreHWLimit = 1;
  run.cycles(50);
  run.sim.bForceLimitNegative = 1;
  run.cycles(50);
  EXPECT_EQ(run.rig.axis.nAxisState, state::kHoming);
  run.homing.bIgnoreHWLimit = 0;
  run.cycles(2);
  EXPECT_EQ(run.rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(run.homing.nErrorID, 11);
}

TEST(Homing, CanBeToldAfterItHasBegun) {
  HomingRun run(kBackwards);
  run.cycles(50);
  run.homing.bIgnoreHWLimit = 1;
  run.cycles(1);
  run.sim.bForceLimitNegative = 1;
  run.cycles(50);
  EXPECT_EQ(run.rig.axis.nAxisState, state::kHoming);
  EXPECT_EQ(run.homing.bError, 0);
}

TEST(Homing, AcrossTheSwitchTheLimitSwitchesAlwaysCount) {
  HomingRun run(kAcross);
  run.cycles(50);
  EXPECT_EQ(run.homing.bError, 0);
  run.homing.bIgnoreHWLimit = 1;
  run.cycles(1);
  EXPECT_EQ(run.homing.nErrorID, 51);
  EXPECT_EQ(run.rig.axis.nAxisState, state::kErrorStop);
}

} // namespace
