// Blocks that are given set values or a course, against every state of PLCopen's diagram: whether
// they may start, which state follows, who loses the axis, and who may take it from them.
#include "runtime/axis/axis_cycle.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_ControlAxisByPos.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByPosVel.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByVel.h"
#include "st/SM_DriveBasic/SMC_FollowPosition.h"
#include "st/SM_DriveBasic/SMC_FollowPositionVelocity.h"
#include "st/SM_DriveBasic/SMC_FollowVelocity.h"
#include "st/SM_PLCopen/MC_AccelerationProfile.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_PositionProfile.h"
#include "st/SM_PLCopen/MC_TA_REF.h"
#include "st/SM_PLCopen/MC_TP_REF.h"
#include "st/SM_PLCopen/MC_TV_REF.h"
#include "st/SM_PLCopen/MC_VelocityProfile.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace drive = ::st::SM_DriveBasic;
namespace pl = ::st::SM_PLCopen;
namespace error = stride::axis::error;
namespace state = stride::axis::state;

/// A block behind what all of them have.
struct Subject {
  std::function<void(bool)> call; ///< With bExecute, bEnable or Execute.
  std::function<bool()> busy, aborted;
  std::function<int()> errorId;
  int16_t movingState; ///< The axis's state while it works.
};

class SetValueBlocks {
public:
  AxisRig rig{0.002};

  SetValueBlocks() {
    rig.axis.fSWMaxVelocity = 1000;
    rig.axis.fSWMaxAcceleration = 1e6;
    rig.axis.fSWMaxDeceleration = 1e6;
    positions_.Number_of_pairs = velocities_.Number_of_pairs = accelerations_.Number_of_pairs = 2;
    for (int i = 0; i < 2; ++i) {
      positions_.MC_TP_Array.v[i] = {500, 10.0 * (i + 1)};
      velocities_.MC_TV_Array.v[i] = {500, 10.0};
      accelerations_.MC_TA_Array.v[i] = {500, 10.0};
    }
    positions_.IsAbsolute = 0;
    add(position_, state::kSynchronized);
    add(positionVelocity_, state::kSynchronized);
    add(velocity_, state::kSynchronized);
    add(byPos_, state::kSynchronized);
    add(byPosVel_, state::kSynchronized);
    add(byVel_, state::kSynchronized);
    positionProfile_.TimePosition = &positions_;
    velocityProfile_.TimeVelocity = &velocities_;
    accelerationProfile_.TimeAcceleration = &accelerations_;
    add(positionProfile_, state::kDiscrete);
    add(velocityProfile_, state::kContinuous);
    add(accelerationProfile_, state::kContinuous);
  }

  std::vector<Subject> subjects;

private:
  template <class Block> void add(Block &block, int16_t movingState) {
    block.Axis = &rig.axis;
    Subject s;
    s.movingState = movingState;
    s.call = [this, &block](bool on) {
      if constexpr (requires { block.fSetPosition; })
        block.fSetPosition = rig.axis.fSetPosition; // stay
      if constexpr (requires { block.ArraySize; })
        block.ArraySize = 2;
      if constexpr (requires { block.bExecute; })
        block.bExecute = on;
      else if constexpr (requires { block.bEnable; })
        block.bEnable = on;
      else
        block.Execute = on;
      block.body__(rig.ctx);
    };
    if constexpr (requires { block.bBusy; }) {
      s.busy = [&block] { return block.bBusy != 0; };
      s.aborted = [&block] { return block.bCommandAborted != 0; };
      s.errorId = [&block] { return static_cast<int>(block.iErrorID); };
    } else {
      s.busy = [&block] { return block.Busy != 0; };
      s.aborted = [&block] { return block.CommandAborted != 0; };
      s.errorId = [&block] { return static_cast<int>(block.ErrorID); };
    }
    subjects.push_back(s);
  }

  drive::SMC_FollowPosition position_ = fresh<drive::SMC_FollowPosition>();
  drive::SMC_FollowPositionVelocity positionVelocity_ = fresh<drive::SMC_FollowPositionVelocity>();
  drive::SMC_FollowVelocity velocity_ = fresh<drive::SMC_FollowVelocity>();
  drive::SMC_ControlAxisByPos byPos_ = fresh<drive::SMC_ControlAxisByPos>();
  drive::SMC_ControlAxisByPosVel byPosVel_ = fresh<drive::SMC_ControlAxisByPosVel>();
  drive::SMC_ControlAxisByVel byVel_ = fresh<drive::SMC_ControlAxisByVel>();
  pl::MC_PositionProfile positionProfile_ = fresh<pl::MC_PositionProfile>();
  pl::MC_VelocityProfile velocityProfile_ = fresh<pl::MC_VelocityProfile>();
  pl::MC_AccelerationProfile accelerationProfile_ = fresh<pl::MC_AccelerationProfile>();
  pl::MC_TP_REF positions_ = fresh<pl::MC_TP_REF>();
  pl::MC_TV_REF velocities_ = fresh<pl::MC_TV_REF>();
  pl::MC_TA_REF accelerations_ = fresh<pl::MC_TA_REF>();
};

constexpr size_t kSubjects = 9;

/// What brings an axis into a state, and what a block may do there.
struct Row {
  int16_t axisState;
  int error; ///< 0: it takes the axis.
};

constexpr Row kRows[] = {
    {state::kPowerOff, error::kNotPowered}, {state::kErrorStop, error::kNotReady},
    {state::kStopping, error::kStopBlocks}, {state::kStandstill, error::kNone},
    {state::kDiscrete, error::kNone},       {state::kContinuous, error::kNone},
    {state::kSynchronized, error::kNone},   {state::kHoming, error::kNotReady},
};

/// Something that holds an axis in a state, called in every cycle.
class Holder {
public:
  Holder(AxisRig &rig, int16_t axisState) : rig_(rig), axisState_(axisState) {
    move_ = rig.move(1000, 10, 100, 100);
    endless_.Axis = &rig.axis;
    endless_.Velocity = 10;
    endless_.Acceleration = endless_.Deceleration = 100;
    endless_.Direction = 1;
    stop_ = rig.stop(10);
    follow_.Axis = &rig.axis;
  }

  void call() {
    switch (axisState_) {
    case state::kDiscrete:
      rig_.call(move_, true);
      break;
    case state::kContinuous:
      rig_.call(endless_, true);
      break;
    case state::kStopping:
      rig_.call(endless_, !stopping_);
      rig_.call(stop_, stopping_);
      break;
    case state::kSynchronized:
      follow_.bExecute = 1;
      follow_.body__(rig_.ctx);
      break;
    default:
      break;
    }
  }

  /// Brings the axis, which is in power, into the state.
  void prepare() {
    if (axisState_ == state::kPowerOff) {
      rig_.power.bRegulatorOn = 0;
      rig_.idle(5);
      return;
    }
    for (int i = 0; i < 20; ++i)
      rig_.cycle([this] { call(); });
    stopping_ = true;
    if (axisState_ == state::kStopping)
      rig_.cycle([this] { call(); });
    if (axisState_ == state::kErrorStop)
      rig_.cycle([this] { stride::axis::enterErrorStop(rig_.axis, error::kDrive); });
    if (axisState_ == state::kHoming)
      rig_.axis.nAxisState = state::kHoming;
  }

  bool aborted() const {
    return move_.CommandAborted != 0 || endless_.CommandAborted != 0 ||
           follow_.bCommandAborted != 0;
  }

private:
  AxisRig &rig_;
  int16_t axisState_;
  bool stopping_ = false;
  pl::MC_MoveAbsolute move_ = fresh<pl::MC_MoveAbsolute>();
  pl::MC_MoveVelocity endless_ = fresh<pl::MC_MoveVelocity>();
  pl::MC_Stop stop_ = fresh<pl::MC_Stop>();
  drive::SMC_FollowVelocity follow_ = fresh<drive::SMC_FollowVelocity>();
};

TEST(SetValueBlocks, StartInTheStatesThatAllowIt) {
  for (const Row &row : kRows) {
    for (size_t i = 0; i < kSubjects; ++i) {
      SCOPED_TRACE("state " + std::to_string(row.axisState) + " block " + std::to_string(i));
      SetValueBlocks blocks;
      AxisRig &rig = blocks.rig;
      ASSERT_GT(rig.powerUp(), 0);
      Holder holder(rig, row.axisState);
      holder.prepare();
      ASSERT_EQ(rig.axis.nAxisState, row.axisState);
      Subject &subject = blocks.subjects[i];
      rig.cycle([&] {
        holder.call();
        subject.call(true);
      });
      EXPECT_EQ(subject.errorId(), row.error);
      EXPECT_EQ(subject.busy(), row.error == 0);
      if (row.error != 0) {
        EXPECT_EQ(rig.axis.nAxisState, row.axisState);
        EXPECT_EQ(holder.aborted(), row.axisState == state::kStopping); // by MC_Stop
        EXPECT_NE(rig.axis.stFBErrors.uiCount, 0);
        continue;
      }
      EXPECT_EQ(rig.axis.nAxisState, subject.movingState);
      rig.cycle([&] {
        holder.call();
        subject.call(true);
      });
      EXPECT_EQ(holder.aborted(), row.axisState != state::kStandstill);
      EXPECT_TRUE(subject.busy());
    }
  }
}

TEST(SetValueBlocks, LoseTheAxisToWhoeverTakesIt) {
  for (size_t i = 0; i < kSubjects; ++i) {
    for (int taker = 0; taker < 3; ++taker) {
      SCOPED_TRACE("block " + std::to_string(i) + " taker " + std::to_string(taker));
      SetValueBlocks blocks;
      AxisRig &rig = blocks.rig;
      ASSERT_GT(rig.powerUp(), 0);
      Subject &subject = blocks.subjects[i];
      for (int k = 0; k < 10; ++k)
        rig.cycle([&] { subject.call(true); });
      ASSERT_TRUE(subject.busy());
      auto move = rig.move(5);
      auto stop = rig.stop();
      pl::MC_Halt halt = fresh<pl::MC_Halt>();
      halt.Axis = &rig.axis;
      halt.Deceleration = 100;
      const auto take = [&] {
        if (taker == 0)
          rig.call(move, true);
        else if (taker == 1)
          rig.call(stop, true);
        else
          rig.call(halt, true);
      };
      rig.cycle([&] {
        take();
        subject.call(true);
      });
      EXPECT_TRUE(subject.aborted()) << "called after the taker: in the same cycle";
      EXPECT_FALSE(subject.busy());
      EXPECT_EQ(subject.errorId(), 0);
      rig.cycle([&] {
        take();
        subject.call(true);
      });
      EXPECT_TRUE(subject.aborted()) << "as long as it is asked for";
      rig.cycle([&] {
        take();
        subject.call(false);
      });
      EXPECT_FALSE(subject.aborted());
      EXPECT_NE(rig.axis.nAxisState, state::kErrorStop);
    }
  }
}

TEST(SetValueBlocks, LeaveAnAxisInErrorStopWhenNotCalled) {
  for (size_t i = 0; i < kSubjects; ++i) {
    SCOPED_TRACE("block " + std::to_string(i));
    SetValueBlocks blocks;
    AxisRig &rig = blocks.rig;
    ASSERT_GT(rig.powerUp(), 0);
    Subject &subject = blocks.subjects[i];
    for (int k = 0; k < 10; ++k)
      rig.cycle([&] { subject.call(true); });
    rig.idle();
    EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
    EXPECT_EQ(rig.axis.wFBErrorID, error::kNotCalled);
    rig.cycle([&] { subject.call(true); });
    EXPECT_EQ(subject.errorId(), error::kNotCalled);
    EXPECT_FALSE(subject.busy());
  }
}

TEST(SetValueBlocks, EndWithThePower) {
  for (size_t i = 0; i < kSubjects; ++i) {
    SCOPED_TRACE("block " + std::to_string(i));
    SetValueBlocks blocks;
    AxisRig &rig = blocks.rig;
    ASSERT_GT(rig.powerUp(), 0);
    Subject &subject = blocks.subjects[i];
    for (int k = 0; k < 10; ++k)
      rig.cycle([&] { subject.call(true); });
    rig.power.bRegulatorOn = 0;
    for (int k = 0; k < 3; ++k)
      rig.cycle([&] { subject.call(true); });
    EXPECT_EQ(subject.errorId(), error::kNotPowered);
    EXPECT_FALSE(subject.busy());
    EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
  }
}

TEST(SetValueBlocks, BeginAnewAtAnotherEdge) {
  for (size_t i = 0; i < kSubjects; ++i) {
    SCOPED_TRACE("block " + std::to_string(i));
    SetValueBlocks blocks;
    AxisRig &rig = blocks.rig;
    ASSERT_GT(rig.powerUp(), 0);
    Subject &subject = blocks.subjects[i];
    for (int k = 0; k < 40; ++k)
      rig.cycle([&] { subject.call(k % 10 != 5); });
    EXPECT_TRUE(subject.busy());
    EXPECT_FALSE(subject.aborted());
    EXPECT_EQ(subject.errorId(), 0);
    EXPECT_EQ(rig.axis.nAxisState, subject.movingState);
  }
}

} // namespace
