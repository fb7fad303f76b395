// SMC3_PersistPosition: the position of an axis over a restart, when its encoder has moved, has
// overflowed, has been replaced; SMC3_BrakeStatus.
#include "runtime/axis/set_point.hpp"

#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC3_BrakeStatus.h"
#include "st/SM_PLCopen/SMC3_PersistPosition.h"
#include "st/SM_PLCopen/SMC3_PersistPositionSingleturn.h"
#include "st/SM_PLCopen/SMC3_PersistPositionSingleturn_Data.h"
#include "st/SM_PLCopen/SMC3_PersistPosition_Data.h"

#include <gtest/gtest.h>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
namespace axis = stride::axis;
namespace pl = ::st::SM_PLCopen;

/// An axis that has started up, whose encoder is at `increments`: 1000 of them are a unit.
axis::AxisRef started(int64_t increments, double period = 0) {
  auto ref = fresh<axis::AxisRef>();
  ref.wCommunicationState = axis::kNormalOperation;
  ref.bCommunication = 1;
  ref.bRealDrive = 1;
  ref.dwRatioTechUnitsDenom = 1000;
  ref.iRatioTechUnitsNum = 1;
  ref.iMovementType = period > 0 ? 0 : 1;
  if (period > 0)
    ref.fPositionPeriod = period;
  ref.liActIncrements = increments;
  ref.fActPosition = ref.fSetPosition =
      axis::shownPosition(ref, static_cast<double>(increments) / 1000);
  return ref;
}

class Persist : public testing::Test {
protected:
  /// A run: one call with the axis, then one with the encoder `way` further on.
  void run(axis::AxisRef &ref, int64_t way = 0) {
    auto block = fresh<pl::SMC3_PersistPosition>();
    block.Axis = &ref;
    block.PersistentData = &data;
    block.bEnable = 1;
    block.maxPersistedValue = most;
    block.body__(ctx);
    shown = block;
    ref.liActIncrements += way;
    ref.fActPosition = axis::shownPosition(ref, ref.fActPosition + static_cast<double>(way) / 1000);
    ref.fSetPosition = ref.fActPosition;
    block.body__(ctx);
  }

  stride::Ctx ctx{};
  pl::SMC3_PersistPosition_Data data = fresh<pl::SMC3_PersistPosition_Data>();
  pl::SMC3_PersistPosition shown = fresh<pl::SMC3_PersistPosition>();
  uint32_t most = 0xFFFFFFFF;
};

TEST_F(Persist, TheFirstTimeThereIsNothingToRestore) {
  auto ref = started(5000);
  run(ref);
  EXPECT_EQ(shown.bPositionRestored, 0);
  EXPECT_EQ(shown.bPositionStored, 1);
  EXPECT_EQ(shown.bError, 0);
  EXPECT_EQ(ref.fActPosition, 5);
}

TEST_F(Persist, ZeroPointAndWayAreRestored) {
  auto before = started(5000);
  before.fActPosition = before.fSetPosition = 105; // homed
  run(before, 2000);
  auto after = started(6500); // half a unit back while it was off
  run(after);
  EXPECT_EQ(shown.bPositionRestored, 1);
  EXPECT_NEAR(after.fActPosition, 106.5, 1e-9);
  EXPECT_NEAR(after.fSetPosition, 106.5, 1e-9);
  EXPECT_NEAR(after.fOffsetPosition, 100, 1e-9);
}

TEST_F(Persist, AnOverflowOfTheEncoderIsSeen) {
  most = 65535;
  auto before = started(65000);
  run(before);
  auto after = started(400); // 936 further on
  run(after);
  EXPECT_NEAR(after.fActPosition, 65.936, 1e-9);
  auto back = started(65100); // and back over the end
  run(back);
  EXPECT_NEAR(back.fActPosition, 65.1, 1e-9);
  auto half = started(65100 - 32768); // just half a turn: backwards
  run(half);
  EXPECT_NEAR(half.fActPosition, 65.1 - 32.768, 1e-9);
}

TEST_F(Persist, OnARotaryAxisThePositionIsWithinThePeriod) {
  auto before = started(359000, 360);
  before.fActPosition = before.fSetPosition = 350;
  run(before, 4000);
  EXPECT_NEAR(before.fActPosition, 354, 1e-9);
  auto after = started(373000, 360);
  run(after);
  EXPECT_NEAR(after.fActPosition, 4, 1e-9);
}

TEST_F(Persist, AnotherAxisIsNotRestored) {
  auto before = started(5000);
  run(before);
  auto after = started(1000);
  after.dwRatioTechUnitsDenom = 2000;
  run(after);
  EXPECT_EQ(shown.bPositionRestored, 0);
  EXPECT_EQ(after.fActPosition, 1);
  EXPECT_EQ(shown.bPositionStored, 1) << "from now on the new one";
}

TEST_F(Persist, DataThatAreNotWholeAreNotUsed) {
  auto before = started(5000);
  run(before);
  ++data.udiBegun;
  auto after = started(1000);
  run(after);
  EXPECT_EQ(shown.bPositionRestored, 0);
  EXPECT_EQ(after.fActPosition, 1);
  auto again = started(3000);
  run(again);
  EXPECT_EQ(shown.bPositionRestored, 1);
}

TEST_F(Persist, ItWaitsForTheDrive) {
  auto ref = started(5000);
  ref.wCommunicationState = 40;
  run(ref);
  EXPECT_EQ(shown.bPositionStored, 0);
  EXPECT_EQ(data.udiBegun, 0U);
}

TEST_F(Persist, ADriveThatStartsUpAnewIsRestoredAgain) {
  auto ref = started(5000);
  ref.fActPosition = ref.fSetPosition = 105; // homed
  run(ref);
  auto block = fresh<pl::SMC3_PersistPosition>();
  block.Axis = &ref;
  block.PersistentData = &data;
  block.bEnable = 1;
  block.body__(ctx);
  EXPECT_EQ(block.bPositionRestored, 1);
  ref.wCommunicationState = 33;
  block.body__(ctx);
  EXPECT_EQ(block.bPositionRestored, 0);
  EXPECT_EQ(block.bPositionStored, 0);
  ref = started(5250); // its encoder knows nothing of homing
  block.body__(ctx);
  EXPECT_EQ(block.bPositionRestored, 1);
  EXPECT_NEAR(ref.fActPosition, 105.25, 1e-9);
}

TEST_F(Persist, ARangeOfNothingIsAnError) {
  most = 0;
  auto ref = started(5000);
  run(ref);
  EXPECT_EQ(shown.eErrorID, axis::error::kInvalidParameter);
  EXPECT_EQ(shown.bPositionStored, 0);
}

TEST(PersistSingleturn, ATurnHasSoManyBits) {
  stride::Ctx ctx{};
  auto data = fresh<pl::SMC3_PersistPositionSingleturn_Data>();
  const auto run = [&](axis::AxisRef &ref, uint8_t bits) {
    auto block = fresh<pl::SMC3_PersistPositionSingleturn>();
    block.Axis = &ref;
    block.PersistentData = &data;
    block.bEnable = 1;
    block.usiNumberOfAbsoluteBits = bits;
    block.body__(ctx);
    return block;
  };
  auto before = started(4000);
  EXPECT_EQ(run(before, 12).bPositionStored, 1);
  auto after = started(100); // 196 further on
  EXPECT_EQ(run(after, 12).bPositionRestored, 1);
  EXPECT_NEAR(after.fActPosition, 4.196, 1e-9);
  EXPECT_EQ(run(after, 7).bError, 1);
  EXPECT_EQ(run(after, 33).bError, 1);
  EXPECT_EQ(run(after, 32).bError, 0);
  EXPECT_EQ(run(after, 8).bError, 0);
}

TEST(BrakeStatus, IsThatOfTheDrive) {
  AxisRig rig;
  ASSERT_GT(rig.powerUp(), 0);
  auto brake = fresh<::st::SM_DriveBasic::SMC3_BrakeStatus>();
  brake.Axis = &rig.axis;
  brake.body__(rig.ctx);
  EXPECT_EQ(brake.bValid, 0);
  brake.bEnable = 1;
  brake.body__(rig.ctx);
  EXPECT_EQ(brake.bValid, 1);
  EXPECT_EQ(brake.bBrakeClosed, 0);
  rig.axis.bDriveStartRealState = 0;
  brake.body__(rig.ctx);
  EXPECT_EQ(brake.bBrakeClosed, 1);
}

} // namespace
