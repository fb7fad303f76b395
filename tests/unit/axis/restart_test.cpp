// The restart of one drive of a group: what the golden project drive_reinit does not see.
#include "tests/unit/axis/axis_rig.hpp"
#include "tests/unit/axis/idle_driver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

namespace {

namespace state = stride::axis::state;
using stride::test::AxisRig;

/// A drive whose regulator stays on, whatever it is told.
class StubbornDriver final : public stride::test::IdleDriver {
public:
  [[nodiscard]] stride::bus::DriveStatus status(size_t /*drive*/) const override {
    stride::bus::DriveStatus status;
    status.communication = true;
    status.regulatorOn = true;
    status.driveStarted = true;
    return status;
  }
  void command(size_t /*drive*/, const stride::bus::DriveCommand &command) override {
    demanded = command.regulatorOn;
  }

  bool demanded = false;
};

void ask(AxisRig &rig, bool simulated) {
  rig.axis.stRestart.bVirtual = simulated ? 1 : 0;
  ++rig.axis.stRestart.udiAsked;
}

TEST(Restart, WaitsAThousandCyclesForARegulatorThatStaysOn) {
  AxisRig rig;
  auto own = std::make_unique<StubbornDriver>();
  StubbornDriver &drive = *own;
  rig.axisGroup = std::make_unique<stride::bus::DriveGroup>(
      std::move(own), rig.group, std::vector<stride::axis::AxisRef *>{&rig.axis}, 0.001);
  rig.idle(5);
  ASSERT_TRUE(drive.demanded);
  ask(rig, false);
  rig.idle(); // it is at rest
  rig.idle(999);
  EXPECT_EQ(drive.resets, 0);
  EXPECT_FALSE(drive.demanded) << "it is told to switch off";
  rig.idle();
  EXPECT_EQ(drive.resets, 1);
  rig.idle(2);
  EXPECT_EQ(rig.axis.wCommunicationState, 100);
  EXPECT_TRUE(drive.demanded);
}

TEST(Restart, GoesOnAfterAResetOfTheWholeGroup) {
  AxisRig rig;
  rig.powerUp();
  auto move = rig.move(1000);
  for (int i = 0; i < 500; ++i)
    rig.cycle([&] { rig.call(move, true); });
  ask(rig, true);
  rig.idle(100); // brakes
  ASSERT_EQ(rig.axis.stRestart.byStep, 1);
  ++rig.group.udiResetsAsked;
  rig.idle(2);
  EXPECT_EQ(rig.axis.stRestart.byStep, 0);
  EXPECT_NE(rig.axis.stRestart.udiBegun, rig.axis.stRestart.udiAsked);
  rig.idle(1000);
  EXPECT_EQ(rig.group.wState, 100);
  EXPECT_EQ(rig.axis.stRestart.udiBegun, rig.axis.stRestart.udiAsked);
  EXPECT_EQ(rig.axis.bRealDrive, 0);
  EXPECT_EQ(rig.axis.nAxisState, state::kStandstill) << "MC_Power serves it";
}

/// Two drives that do at once what they are told.
class WillingDriver final : public stride::test::IdleDriver {
public:
  [[nodiscard]] stride::bus::DriveStatus status(size_t drive) const override {
    stride::bus::DriveStatus status;
    status.communication = communicates;
    status.regulatorOn = status.driveStarted = told[drive].regulatorOn;
    status.position = told[drive].position;
    return status;
  }
  void command(size_t drive, const stride::bus::DriveCommand &command) override {
    told[drive] = command;
  }

  std::array<stride::bus::DriveCommand, 2> told{};
  bool communicates = true;
};

struct TwoAxes {
  TwoAxes() {
    auto own = std::make_unique<WillingDriver>();
    driver = &*own;
    std::vector<stride::axis::AxisRef *> refs;
    for (stride::axis::AxisRef *axis : {&first.axis, &second.axis}) {
      axis->bRegulatorOn = axis->bDriveStart = 1;
      refs.push_back(axis);
    }
    group = std::make_unique<stride::bus::DriveGroup>(std::move(own), groupRef, refs, 0.001);
  }
  template <class Program> void cycle(Program program) {
    group->executeStart();
    program();
    group->executeEnd();
  }
  AxisRig first;
  AxisRig second;
  stride::bus::AxisGroupRef groupRef = stride::test::fresh<stride::bus::AxisGroupRef>();
  WillingDriver *driver = nullptr;
  std::unique_ptr<stride::bus::DriveGroup> group;
};

TEST(GroupReset, DoesNotWaitForAnAxisThatIsSwitchedOnAndMovedMeanwhile) {
  TwoAxes two;
  for (int i = 0; i < 5; ++i)
    two.cycle([] {});
  ASSERT_EQ(two.second.axis.nAxisState, state::kStandstill);
  auto braking = two.first.move(1000);
  for (int i = 0; i < 500; ++i)
    two.cycle([&] { two.first.call(braking, true); });
  two.second.axis.bRegulatorOn = 0;
  two.cycle([&] { two.first.call(braking, true); });
  two.cycle([&] { two.first.call(braking, true); });
  ASSERT_EQ(two.second.axis.nAxisState, state::kPowerOff);
  ++two.groupRef.udiResetsAsked;
  two.cycle([&] { two.first.call(braking, true); });
  two.second.axis.bRegulatorOn = 1;
  auto endless = two.second.move(1e6);
  int cycles = 0;
  for (; cycles < 3000 && two.driver->resets == 0; ++cycles)
    two.cycle([&] {
      two.second.call(endless,
                      two.second.axis.nAxisState == state::kStandstill || endless.Busy != 0);
    });
  EXPECT_LT(cycles, 3000);
  EXPECT_EQ(two.driver->resets, 2);
}

/// A drive that has been lost goes on only when its driver hears of it.
TEST(GroupAcknowledgement, IsToldInTheCycleInWhichItCounts) {
  TwoAxes two;
  for (int i = 0; i < 5; ++i)
    two.cycle([] {});
  two.driver->communicates = false;
  two.cycle([] {});
  ASSERT_EQ(two.first.axis.nAxisState, state::kErrorStop);
  two.first.axis.bErrorAckn = 1; // MC_Reset has begun before
  two.cycle([] {});
  ASSERT_EQ(two.first.axis.nAxisState, state::kErrorStop);
  two.driver->communicates = true;
  two.cycle([] {});
  EXPECT_NE(two.first.axis.nAxisState, state::kErrorStop);
  EXPECT_TRUE(two.driver->told[0].errorAckn);
  EXPECT_FALSE(two.driver->told[1].errorAckn);
  two.cycle([] {});
  EXPECT_FALSE(two.driver->told[0].errorAckn) << "once";
}

TEST(Restart, AnAxisInVirtualModeIsNoMatterOfItsGroup) {
  AxisRig rig;
  rig.powerUp();
  ask(rig, true);
  rig.idle(10);
  ASSERT_EQ(rig.axis.bRealDrive, 0);
  EXPECT_FALSE(rig.drive->status(0).regulatorOn);
  auto move = rig.move(1000);
  for (int i = 0; i < 500; ++i)
    rig.cycle([&] { rig.call(move, true); });
  EXPECT_GT(rig.axis.fActPosition, 10.0);
  EXPECT_EQ(rig.drive->status(0).position, 0U);
  // The group starts anew without it, and its stop waits for nothing.
  const double velocity = rig.axis.fSetVelocity;
  ++rig.group.udiResetsAsked;
  for (int i = 0; i < 10; ++i)
    rig.cycle([&] { rig.call(move, true); });
  EXPECT_EQ(rig.group.wState, 100);
  EXPECT_GT(rig.axis.fSetVelocity, velocity);
  rig.axisGroup->stopAll();
  EXPECT_TRUE(rig.axisGroup->atRest());
}

TEST(Restart, AnotherOneWhileItGoesOnBeginsAnew) {
  AxisRig rig;
  rig.powerUp();
  ask(rig, true);
  rig.idle(1);
  ask(rig, false);
  rig.idle(10);
  EXPECT_EQ(rig.axis.bRealDrive, 1);
  EXPECT_EQ(rig.axis.wCommunicationState, 100);
  EXPECT_EQ(rig.axis.stRestart.udiBegun, 2U);
}

} // namespace
