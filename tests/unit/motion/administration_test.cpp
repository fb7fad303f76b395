// Blocks that set what belongs to an axis, or watch it: SMC_SetSoftwareLimits,
// SMC_ChangeDynamicLimits, SMC_SetMovementType, SMC_InPosition, SMC_CheckAxisCommunication,
// SMC_FollowSetValues beside motion.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_CONTROLLER_MODE.h"
#include "st/SM_DriveBasic/SMC_ChangeDynamicLimits.h"
#include "st/SM_DriveBasic/SMC_CheckAxisCommunication.h"
#include "st/SM_DriveBasic/SMC_FollowSetValues.h"
#include "st/SM_DriveBasic/SMC_InPosition.h"
#include "st/SM_DriveBasic/SMC_SetMovementType.h"
#include "st/SM_DriveBasic/SMC_SetSoftwareLimits.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace axis = stride::axis;
namespace state = stride::axis::state;
namespace basic = ::st::SM_DriveBasic;
namespace error = ::st::SM_Error;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Administration : public testing::Test {
protected:
  void SetUp() override { ASSERT_GT(rig.powerUp(), 0); }

  /// One edge of a block's bExecute.
  template <class Block> void edge(Block &block) {
    block.bExecute = 0;
    block.body__(rig.ctx);
    block.bExecute = 1;
    block.body__(rig.ctx);
  }

  /// What the axis's list ends with.
  [[nodiscard]] int newestError() const {
    const auto &list = rig.axis.stFBErrors;
    const auto &errors = list.aError;
    return list.uiCount == 0 ? 0 : errors.v[(list.uiFirst + list.uiCount - 1U) % errors.kSize];
  }

  AxisRig rig;
};

basic::SMC_SetSoftwareLimits someLimits(axis::AxisRef &ref) {
  auto b = fresh<basic::SMC_SetSoftwareLimits>();
  b.Axis = &ref;
  b.SWL_Activated = 1;
  b.SWL_Positive = 7;
  b.SWL_Negative = -3;
  return b;
}

TEST_F(Administration, SoftwareLimitsAreSet) {
  auto limits = someLimits(rig.axis);
  edge(limits);
  EXPECT_EQ(limits.bDone, 1);
  EXPECT_EQ(rig.axis.bSWLimitEnable, 1);
  EXPECT_EQ(rig.axis.fSWLimitPositive, 7);
  EXPECT_EQ(rig.axis.fSWLimitNegative, -3);
  limits.SWL_Activated = 0;
  limits.SWL_Positive = limits.SWL_Negative = 0;
  limits.body__(rig.ctx);
  EXPECT_EQ(rig.axis.bSWLimitEnable, 1) << "no edge";
  edge(limits);
  EXPECT_EQ(limits.bDone, 1) << "what does not count need not make sense";
  EXPECT_EQ(rig.axis.bSWLimitEnable, 0);
}

TEST_F(Administration, WrongSoftwareLimitsAreRefused) {
  const auto refused = [&](auto change) {
    auto limits = someLimits(rig.axis);
    change(limits);
    edge(limits);
    EXPECT_EQ(limits.bDone, 0);
    EXPECT_EQ(limits.bError, 1);
    EXPECT_EQ(newestError(), error::SMC_ERROR__SMC_INVALID_PARAMETER);
    EXPECT_EQ(rig.axis.fSWLimitPositive, 0);
    EXPECT_EQ(rig.axis.bSWLimitEnable, 0);
    limits.bExecute = 0;
    limits.body__(rig.ctx);
    EXPECT_EQ(limits.bError, 0);
  };
  refused([](auto &l) { l.SWL_Negative = 7; });
  refused([](auto &l) { l.SWL_Positive = kNan; });
  refused([](auto &l) { l.SWL_Negative = -kInfinity; });
  refused([](auto &l) { l.SWL_Error_Deceleration = -1; });
  refused([](auto &l) { l.SWL_Error_MaxDistance = kNan; });
}

/// How far an axis goes beyond its upper limit of 7 u with 20 u/s.
double wayBeyond(double deceleration, double distance, double ofAxis) {
  AxisRig rig;
  EXPECT_GT(rig.powerUp(), 0);
  auto limits = someLimits(rig.axis);
  limits.SWL_Error_Deceleration = deceleration;
  limits.SWL_Error_MaxDistance = distance;
  rig.axis.fSWMaxDeceleration = ofAxis;
  auto move = fresh<::st::SM_PLCopen::MC_MoveVelocity>();
  move.Axis = &rig.axis;
  move.Velocity = 20;
  move.Acceleration = 1000;
  move.Deceleration = 50;
  move.Direction = 1;
  double at = 0;
  for (int i = 0; i < 2000; ++i) {
    rig.cycle([&] {
      limits.bExecute = 1;
      limits.body__(rig.ctx);
      rig.call(move, true);
    });
    if (rig.axis.nAxisState != state::kErrorStop)
      at = rig.axis.fSetPosition;
  }
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
  return rig.axis.fSetPosition - at - 0.02; // the cycle in which the limit was passed
}

TEST_F(Administration, AnErrorStopBrakesWithTheGreatestOfAll) {
  EXPECT_NEAR(wayBeyond(0, 0, 0), 4, 1e-9);    // the command's 50 u/s^2
  EXPECT_NEAR(wayBeyond(0, 0, 80), 2.5, 1e-9); // the axis's
  EXPECT_NEAR(wayBeyond(160, 0, 80), 1.25, 1e-9);
  EXPECT_NEAR(wayBeyond(160, 2, 80), 1.25, 1e-9);
  EXPECT_NEAR(wayBeyond(160, 0.5, 80), 0.5, 1e-9);
  EXPECT_NEAR(wayBeyond(40, 0, 80), 2.5, 1e-9);
}

TEST_F(Administration, DynamicLimitsChangeInStandstillOnly) {
  auto change = fresh<basic::SMC_ChangeDynamicLimits>();
  change.Axis = &rig.axis;
  change.fMaxVelocity = 11;
  change.fMaxAcceleration = 12;
  change.fMaxDeceleration = 13;
  change.fMaxJerk = 14;
  edge(change);
  EXPECT_EQ(change.bDone, 1);
  EXPECT_EQ(rig.axis.fSWMaxVelocity, 11);
  EXPECT_EQ(rig.axis.fSWMaxAcceleration, 12);
  EXPECT_EQ(rig.axis.fSWMaxDeceleration, 13);
  EXPECT_EQ(rig.axis.fSWMaxJerk, 14);
  EXPECT_EQ(rig.axis.fSWMaxTorque, std::numeric_limits<double>::max());
  change.fMaxTorque = 5;
  edge(change);
  EXPECT_EQ(rig.axis.fSWMaxTorque, 5);
  for (double *input : {&change.fMaxVelocity, &change.fMaxAcceleration, &change.fMaxDeceleration,
                        &change.fMaxJerk, &change.fMaxTorque})
    for (const double bad : {0.0, -1.0, kNan}) {
      const double good = *input;
      *input = bad;
      edge(change);
      EXPECT_EQ(change.ErrorID, error::SMC_ERROR__SMC_INVALID_PARAMETER);
      EXPECT_EQ(change.bDone, 0);
      *input = good;
    }
  EXPECT_EQ(rig.axis.fSWMaxVelocity, 11);
  rig.axis.nAxisState = state::kDiscrete;
  change.fMaxVelocity = 21;
  edge(change);
  EXPECT_EQ(change.ErrorID, axis::error::kNotReady);
  EXPECT_EQ(rig.axis.fSWMaxVelocity, 11);
  rig.axis.nAxisState = state::kPowerOff;
  edge(change);
  EXPECT_EQ(rig.axis.fSWMaxVelocity, 21);
}

TEST(MovementType, IsThatOfVirtualAxes) {
  stride::Ctx ctx{};
  auto ref = fresh<axis::AxisRef>();
  ref.nAxisState = state::kStandstill;
  ref.fSetPosition = ref.fActPosition = -30;
  auto set = fresh<basic::SMC_SetMovementType>();
  const auto edge = [&] {
    set.bExecute = 0;
    set.body__(ctx);
    set.bExecute = 1;
    set.body__(ctx);
  };
  set.Axis = &ref;
  set.fPositionPeriod = 100;
  edge();
  EXPECT_EQ(set.bDone, 1);
  EXPECT_EQ(ref.iMovementType, 0);
  EXPECT_EQ(ref.fPositionPeriod, 100);
  EXPECT_EQ(ref.fSetPosition, 70);
  EXPECT_EQ(ref.fActPosition, 70);
  set.iMovementType = 1;
  set.fPositionPeriod = -5; // does not matter
  edge();
  EXPECT_EQ(ref.iMovementType, 1);
  EXPECT_EQ(ref.fPositionPeriod, 100);
  EXPECT_EQ(ref.fSetPosition, 70);
  for (const int type : {-1, 0, 2}) {
    set.iMovementType = static_cast<int16_t>(type);
    edge();
    EXPECT_EQ(set.eErrorID, error::SMC_ERROR__SMC_INVALID_PARAMETER) << type;
    EXPECT_EQ(ref.iMovementType, 1);
  }
  set.iMovementType = 0;
  set.fPositionPeriod = 9;
  ref.nAxisState = state::kContinuous;
  edge();
  EXPECT_EQ(set.eErrorID, axis::error::kNotReady);
  ref.nAxisState = state::kPowerOff;
  ref.bRealDrive = 1;
  edge();
  EXPECT_EQ(set.eErrorID, error::SMC_ERROR__SMC_INVALID_PARAMETER);
  EXPECT_EQ(ref.iMovementType, 1);
}

class InPosition : public testing::Test {
protected:
  InPosition() {
    ctx.loopBudget = 1000; // for the remainder of a turn
    ref.fTaskCycle = 0.002;
    watch.Axis = &ref;
    watch.bEnable = 1;
    watch.fPosWindow = 0.5;
    watch.fPosTime = 0.01; // 5 cycles
    watch.fTimeOut = 0.03; // 15 cycles
  }

  /// Calls with this distance; whether the last one showed bInPosition.
  bool calls(int count, double distance) {
    ref.fActPosition = ref.fSetPosition - distance;
    for (int i = 0; i < count; ++i)
      watch.body__(ctx);
    return watch.bInPosition != 0;
  }

  stride::Ctx ctx{};
  axis::AxisRef ref = fresh<axis::AxisRef>();
  basic::SMC_InPosition watch = fresh<basic::SMC_InPosition>();
};

TEST_F(InPosition, AfterTheTimeWithinTheWindow) {
  EXPECT_FALSE(calls(5, 0.5));
  EXPECT_TRUE(calls(1, -0.5));
  EXPECT_FALSE(calls(1, 0.501));
  EXPECT_FALSE(calls(5, 0.1)) << "without a break";
  EXPECT_TRUE(calls(3, 0.1));
  EXPECT_EQ(watch.bTimeOut, 0);
  EXPECT_EQ(watch.bBusy, 1);
  watch.bEnable = 0;
  EXPECT_FALSE(calls(1, 0.1));
  EXPECT_EQ(watch.bBusy, 0);
  watch.bEnable = 1;
  watch.fPosTime = 0;
  EXPECT_TRUE(calls(1, 0.1));
}

TEST_F(InPosition, TimeOut) {
  calls(16, 1);
  EXPECT_EQ(watch.bTimeOut, 0) << "exactly fTimeOut";
  calls(1, 1);
  EXPECT_EQ(watch.bTimeOut, 1);
  calls(6, 0);
  EXPECT_EQ(watch.bTimeOut, 0);
  watch.fTimeOut = 0;
  calls(1000, 1);
  EXPECT_EQ(watch.bTimeOut, 0) << "0: never";
}

TEST_F(InPosition, OnARotaryAxisTheShorterWayCounts) {
  ref.iMovementType = 0;
  ref.fPositionPeriod = 360;
  ref.fSetPosition = 359.8;
  ref.fActPosition = 0.2;
  watch.fPosTime = 0;
  watch.body__(ctx);
  EXPECT_EQ(watch.bInPosition, 1);
  ref.fActPosition = 0.4;
  watch.body__(ctx);
  EXPECT_EQ(watch.bInPosition, 0);
}

TEST_F(Administration, CommunicationAsItIs) {
  auto check = fresh<basic::SMC_CheckAxisCommunication>();
  check.Axis = &rig.axis;
  check.bEnable = 1;
  check.body__(rig.ctx);
  EXPECT_EQ(check.bValid, 1);
  EXPECT_EQ(check.bOperational, 1);
  EXPECT_EQ(check.wComState, 100);
  rig.axis.wCommunicationState = 99;
  check.body__(rig.ctx);
  EXPECT_EQ(check.bOperational, 0);
  EXPECT_EQ(check.wComState, 99);
  check.bEnable = 0;
  check.body__(rig.ctx);
  EXPECT_EQ(check.bValid, 0);
  EXPECT_EQ(check.wComState, 0);
}

class FollowSetValues : public Administration {
protected:
  FollowSetValues() {
    follow.Axis = &rig.axis;
    follow.bExecute = 1;
  }
  void cycle(int cycles = 1) {
    for (int i = 0; i < cycles; ++i)
      rig.cycle([&] { follow.body__(rig.ctx); });
  }

  basic::SMC_FollowSetValues follow = fresh<basic::SMC_FollowSetValues>();
};

TEST_F(FollowSetValues, WritesWhatTheMaskSays) {
  follow.fSetPosition = 0.25;
  follow.fSetVelocity = 3;
  follow.fSetAcceleration = 4;
  follow.fSetJerk = 5;
  follow.fSetTorque = 6;
  follow.fSetCurrent = 7;
  follow.dwValueMask = 63;
  cycle();
  EXPECT_EQ(rig.axis.fSetPosition, 0.25);
  EXPECT_EQ(rig.axis.fSetVelocity, 3);
  EXPECT_EQ(rig.axis.fSetAcceleration, 4);
  EXPECT_EQ(rig.axis.fSetJerk, 5);
  EXPECT_EQ(rig.axis.fSetTorque, 6);
  EXPECT_EQ(rig.axis.fSetCurrent, 7);
  EXPECT_EQ(rig.axis.nAxisState, state::kSynchronized);
  follow.dwValueMask = 1;
  follow.fSetPosition = 0.5;
  follow.fSetJerk = follow.fSetTorque = 99;
  cycle();
  EXPECT_EQ(rig.axis.fSetPosition, 0.5);
  EXPECT_NEAR(rig.axis.fSetVelocity, 250, 1e-9) << "follows from the positions";
  EXPECT_NEAR(rig.axis.fSetAcceleration, 247000, 1e-3);
  EXPECT_EQ(rig.axis.fSetJerk, 5);
  EXPECT_EQ(rig.axis.fSetTorque, 6);
  follow.dwValueMask = 2;
  cycle();
  EXPECT_EQ(rig.axis.fSetPosition, 0.5) << "no position: it stays";
  EXPECT_EQ(rig.axis.fSetVelocity, 3);
}

TEST_F(FollowSetValues, OnlyWhatIsWrittenMustBeANumber) {
  follow.dwValueMask = 1;
  follow.fSetVelocity = follow.fSetTorque = kNan;
  cycle(3);
  EXPECT_EQ(follow.bError, 0);
  follow.dwValueMask = 17;
  cycle();
  EXPECT_EQ(follow.iErrorID, axis::error::kOutOfRange);
  cycle();
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
}

TEST_F(FollowSetValues, TheCoordinatesOfTheEdgeStay) {
  follow.dwValueMask = 1;
  cycle();
  rig.axis.fOffsetPosition += 5;
  rig.axis.fSetPosition += 5; // MC_SetPosition
  cycle();
  EXPECT_EQ(rig.axis.fSetPosition, 5);
  EXPECT_EQ(rig.axis.fSetVelocity, 0);
  follow.bFixedCoordinateSystem = 0;
  cycle();
  EXPECT_EQ(rig.axis.fSetPosition, 0);
}

TEST_F(FollowSetValues, AbortFreesAnAxisAtRest) {
  follow.dwValueMask = 17;
  follow.fSetTorque = 2;
  cycle(2);
  EXPECT_EQ(rig.axis.fSetTorque, 2);
  follow.bAbort = 1;
  cycle();
  EXPECT_EQ(follow.bBusy, 0);
  EXPECT_EQ(follow.bError, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.axis.iOwner, 0);
  EXPECT_EQ(rig.axis.fSetTorque, 0);
  auto other = fresh<axis::AxisRef>();
  follow.Axis = &other;
  follow.bAbort = 0;
  cycle();
  EXPECT_EQ(follow.bError, 0) << "no error for another axis";
}

TEST_F(FollowSetValues, AbortInMotionNeedsASuccessor) {
  follow.dwValueMask = 2;
  follow.fSetVelocity = 10;
  cycle(2);
  follow.bAbort = 1;
  auto halt = rig.stop(100);
  rig.cycle([&] {
    follow.body__(rig.ctx);
    rig.call(halt, true);
  });
  EXPECT_EQ(rig.axis.nAxisState, state::kStopping);
  EXPECT_EQ(follow.bCommandAborted, 0);
}

TEST_F(FollowSetValues, AbortInMotionWithoutOneIsAnErrorStop) {
  follow.dwValueMask = 2;
  follow.fSetVelocity = 10;
  cycle(2);
  follow.bAbort = 1;
  cycle(2);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
}

TEST_F(FollowSetValues, AForceAloneNeedsNoPositionControl) {
  rig.axis.byRealControllerMode = basic::SMC_CONTROLLER_MODE__SMC_torque;
  follow.dwValueMask = 17;
  follow.body__(rig.ctx);
  EXPECT_EQ(follow.iErrorID, axis::error::kWrongMode);
  follow.bExecute = 0;
  follow.body__(rig.ctx);
  follow.dwValueMask = 16;
  follow.fSetTorque = 3;
  follow.bExecute = 1;
  follow.body__(rig.ctx);
  EXPECT_EQ(follow.bError, 0);
  EXPECT_EQ(rig.axis.fSetTorque, 3);
  EXPECT_EQ(rig.axis.bMovedInThisCycle, 1);
  rig.axis.bMovedInThisCycle = 0;
  rig.axis.fSetPosition = 4; // the runtime: the actual one
  follow.body__(rig.ctx);
  EXPECT_EQ(rig.axis.fSetPosition, 4);
  follow.dwValueMask = 2;
  follow.body__(rig.ctx);
  EXPECT_EQ(follow.iErrorID, axis::error::kWrongMode);
}

TEST_F(FollowSetValues, AnotherCommandTakesTheAxisAndTheTorque) {
  follow.dwValueMask = 19;
  follow.fSetTorque = 2;
  cycle(2);
  auto move = rig.move(5);
  rig.cycle([&] {
    rig.call(move, true);
    follow.body__(rig.ctx);
  });
  EXPECT_EQ(follow.bCommandAborted, 1);
  EXPECT_EQ(follow.bBusy, 0);
  EXPECT_EQ(rig.axis.fSetTorque, 0);
}

} // namespace
