#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

namespace {

using stride::test::AxisRig;
namespace state = stride::axis::state;

TEST(AxisGroup, StartsUpOverSomeCycles) {
  AxisRig rig;
  rig.start();
  EXPECT_EQ(rig.group.wState, 0);
  rig.idle();
  EXPECT_GT(rig.group.wState, 0);
  EXPECT_LT(rig.group.wState, 100);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
  EXPECT_EQ(rig.power.Status, 0);
  EXPECT_EQ(rig.power.Busy, 1);
  rig.idle(2);
  EXPECT_EQ(rig.group.wState, 100);
  EXPECT_EQ(rig.axis.wCommunicationState, 100);
  EXPECT_EQ(rig.axis.bCommunication, 1);
  EXPECT_EQ(rig.group.udiCycleCount, 3U);
}

TEST(AxisGroup, AfterAStopItIsAtRestWhenAxesAndDriverAre) {
  for (const bool quickStop : {false, true}) {
    AxisRig rig;
    stride::bus::GroupSetup setup = stride::dummy::plainSetup(1, 0.001);
    if (quickStop) // of a drive whose unit is the increment: it takes twice as long as the axis
      setup.drives[0].parameters.add({"physics.quick_stop", "", 500000});
    rig.start(setup);
    rig.powerUp();
    auto move = rig.move(1000, 10, 100, 100);
    move.Execute = 1;
    for (int i = 0; i < 300; ++i)
      rig.cycle([&] { move.body__(rig.ctx); });
    ASSERT_EQ(rig.axis.fSetVelocity, 10);
    EXPECT_FALSE(rig.axisGroup->atRest());
    rig.axisGroup->stopAll();
    int axis = 0;
    int cycles = 0;
    for (; !rig.axisGroup->atRest() && cycles < 1000; ++cycles) {
      axis += rig.axis.fSetVelocity != 0 ? 1 : 0;
      rig.axisGroup->executeStart();
      rig.axisGroup->executeEnd();
    }
    EXPECT_NEAR(axis, 100, 1) << "10 u/s with 100 u/s²";
    EXPECT_NEAR(cycles, quickStop ? 200 : 100, 1);
    EXPECT_EQ(rig.drive->status(0).velocity, 0);
  }
}

TEST(AxisGroup, KnowsOnlyCaptureInputsThatThereAre) {
  AxisRig rig;
  stride::bus::GroupSetup setup = stride::dummy::plainSetup(1);
  setup.drives[0].parameters.add({"physics.probe_inputs", "", 0xF5}); // more than four
  rig.start(setup);
  rig.powerUp();
  EXPECT_EQ(rig.axis.byCaptureInputs, 0x05);
}

TEST(AxisGroup, PowersUpToStandstillAndDown) {
  AxisRig rig;
  EXPECT_EQ(rig.powerUp(), 5);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.power.Busy, 0);
  EXPECT_EQ(rig.axis.fTaskCycle, 0.001);
  EXPECT_EQ(rig.axis.bRealDrive, 1);
  rig.power.bRegulatorOn = 0;
  rig.idle(2);
  EXPECT_EQ(rig.power.Status, 0);
  EXPECT_EQ(rig.power.bDriveStartRealState, 1);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
}

TEST(AxisGroup, BothRegulatorAndBrakeAreNeeded) {
  AxisRig rig;
  rig.power.bDriveStart = 0;
  EXPECT_GT(rig.powerUp(), 0) << "in regulation";
  rig.idle(20);
  EXPECT_EQ(rig.power.Status, 1);
  EXPECT_EQ(rig.power.bDriveStartRealState, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
  auto move = rig.move(1);
  rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(move.ErrorID, 20);
  rig.power.bDriveStart = 1;
  rig.idle(5);
  EXPECT_EQ(rig.power.bDriveStartRealState, 1);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(AxisGroup, PowerNeedsACycleTime) {
  AxisRig rig(0.0);
  rig.start();
  rig.idle(5);
  EXPECT_EQ(rig.power.Error, 1);
  EXPECT_EQ(rig.power.ErrorID, 110);
  EXPECT_EQ(rig.power.Status, 0);
}

TEST(AxisGroup, PowerLeavesTheAxisAloneWithoutEnable) {
  AxisRig rig;
  rig.powerUp();
  rig.power.Enable = 0;
  rig.power.bRegulatorOn = 0;
  rig.idle(5);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
  EXPECT_EQ(rig.power.Status, 0);
}

TEST(AxisGroup, SetPositionFollowsTheDriveWithoutPower) {
  AxisRig rig;
  rig.power.bRegulatorOn = 0;
  rig.start();
  rig.idle(5);
  rig.drive->setPosition(0, 123456);
  rig.idle();
  EXPECT_EQ(rig.axis.fActPosition, 12.3456);
  EXPECT_EQ(rig.axis.fSetPosition, 12.3456);
  rig.power.bRegulatorOn = 1;
  rig.idle(5);
  EXPECT_EQ(rig.axis.fSetPosition, 12.3456) << "no jump when power comes";
  EXPECT_EQ(rig.drive->status(0).position, 123456U);
}

TEST(AxisGroup, ActualValuesLagByOneCycle) {
  AxisRig rig;
  rig.powerUp();
  auto move = rig.move(100);
  double before = 0;
  for (int i = 0; i < 1500; ++i) {
    rig.cycle([&] {
      EXPECT_NEAR(rig.axis.fActPosition, before, 0.5001e-4);
      rig.call(move, true);
    });
    before = rig.axis.fSetPosition;
  }
}

TEST(AxisGroup, StartUpFailureNamesTheDrive) {
  AxisRig rig;
  rig.makeRotary(1e9);
  rig.axis.wDriveId = 7;
  rig.start();
  rig.idle(5);
  EXPECT_EQ(rig.group.wState, 1001);
  EXPECT_EQ(rig.group.pErrorDrive, &rig.axis);
  EXPECT_EQ(rig.axis.bErrorDuringStartup, 1);
  EXPECT_NE(rig.axisGroup->bootupError().find("drive 7"), std::string::npos);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
}

TEST(AxisGroup, DriveErrorLeadsToErrorStopUntilAcknowledged) {
  AxisRig rig;
  rig.powerUp();
  rig.drive->raiseError(0, 4711);
  rig.idle(2);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.bError, 1);
  EXPECT_EQ(rig.axis.wErrorID, 4711);
  EXPECT_EQ(rig.axis.wFBErrorID, 2);
  rig.axis.bErrorAckn = 1;
  rig.idle(5);
  EXPECT_EQ(rig.axis.bError, 0);
  EXPECT_EQ(rig.axis.bErrorAckn, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill);
}

TEST(AxisGroup, LostCommunicationIsAnError) {
  AxisRig rig;
  rig.powerUp();
  rig.drive->setCommunication(0, false);
  rig.idle(1);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
  EXPECT_EQ(rig.axis.wFBErrorID, 1);
  EXPECT_EQ(rig.axis.bCommunication, 0);
}

TEST(AxisGroup, ADisabledDriveStaysOutOfTheGroup) {
  AxisRig rig;
  rig.axis.bDisableDriveInAxisGroup = 1;
  EXPECT_EQ(rig.powerUp(), -1);
  EXPECT_EQ(rig.group.wState, 100);
  EXPECT_EQ(rig.axis.nAxisState, state::kPowerOff);
}

TEST(AxisGroup, StopAllBrakesEveryMovingAxis) {
  AxisRig rig;
  rig.powerUp();
  auto move = rig.move(1000);
  for (int i = 0; i < 2000; ++i)
    rig.cycle([&] { rig.call(move, true); });
  EXPECT_FALSE(rig.axisGroup->atRest());
  rig.axisGroup->stopAll();
  int cycles = 0;
  while (!rig.axisGroup->atRest() && cycles < 5000) {
    const double before = rig.axis.fSetVelocity;
    rig.idle();
    EXPECT_LE(before - rig.axis.fSetVelocity, 0.1 + 1e-9);
    ++cycles;
  }
  EXPECT_NEAR(cycles, 1000, 2);
  EXPECT_EQ(rig.axis.nAxisState, state::kErrorStop);
}

} // namespace
