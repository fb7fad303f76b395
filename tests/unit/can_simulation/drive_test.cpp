// The simulated drive in its modes, seen from the bus.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stride::can::simulation {
namespace {

TEST(CanDrive, SaysWhatItIs) {
  DriveScene scene;
  EXPECT_EQ(scene.master.count(0x705), 1U) << "one boot-up message";
  EXPECT_EQ(scene.master.read(5, 0x1000), 0x00020192U);
  EXPECT_EQ(scene.master.read(5, 0x1018, 1), 0x1234U);
  EXPECT_EQ(scene.master.read(5, 0x6502), 0x1E4U) << "PV, HM, IP, CSP, CSV; nothing has a torque";
  Drive402Setup heavy = plainDrive();
  heavy.drive.mechanics.model = dummy::Model::SecondOrder;
  DriveScene other(heavy);
  EXPECT_EQ(other.master.read(5, 0x6502), 0x3ECU);
  EXPECT_EQ(scene.master.read(5, 0x6064), 777U);
}

/// The dead time of the design: set values of cycle k act from SYNC k+1 to k+2, and what is sampled
/// there is read in k+3.
TEST(CanDrive, IdealMechanicsAreExactlyWhereTheyWereToldToBe) {
  DriveScene scene;
  scene.operate();
  scene.enable();
  std::mt19937 random(3); // NOLINT: the same motion each time
  std::vector<int32_t> told = {scene.drive.position(), scene.drive.position(),
                               scene.drive.position()};
  for (int i = 0; i < 500; ++i) {
    const int32_t next = told.back() + static_cast<int32_t>(random() % 4001) - 1700;
    scene.cycle(0x0F, next);
    told.push_back(next);
    ASSERT_EQ(scene.actual, told[told.size() - 4]) << i;
    ASSERT_EQ(scene.status, 0x1637 & ~0x400U);
  }
}

TEST(CanDrive, PositionsWrapWhereThirtyTwoBitsEnd) {
  Drive402Setup setup = plainDrive();
  setup.drive.startPosition = 2'147'483'600;
  DriveScene scene(setup);
  scene.operate();
  scene.enable();
  const auto over = static_cast<int32_t>(2'147'483'600U + 300);
  for (int i = 0; i < 4; ++i)
    scene.cycle(0x0F, over);
  EXPECT_EQ(scene.actual, over);
  EXPECT_EQ(scene.drive.mechanics().position(), 2'147'483'900);
}

TEST(CanDrive, BetweenTwoSyncsItIsOnTheWay) {
  DriveScene scene;
  scene.operate();
  ASSERT_EQ(scene.master.read(5, 0x60C2, 2).value_or(0) & 0xFFU, 0xFDU);
  scene.enable();
  // 60C2h says 4 ms, SYNC comes every 1 ms: a quarter of the way each time.
  scene.drive.write(0x60C2, 1, 4);
  const int32_t start = scene.drive.position();
  for (int i = 0; i < 4; ++i) // told in the first, valid in the second, gone in the third
    scene.cycle(0x0F, start + 4000);
  EXPECT_EQ(scene.drive.position(), start + 1000);
  scene.cycle(0x0F, start + 4000);
  EXPECT_EQ(scene.drive.position(), start + 1750) << "and a quarter of the rest";
}

TEST(CanDrive, CyclicVelocity) {
  DriveScene scene;
  scene.operate(9, 0x60FF0020, 0x606C0020);
  scene.enable(0);
  const int32_t start = scene.drive.position();
  for (int i = 0; i < 104; ++i)
    scene.cycle(0x0F, 25'000);
  EXPECT_EQ(scene.actual, 25'000);
  EXPECT_NEAR(scene.drive.position() - start, 25 * 100.5, 0.51) << "from SYNC 2 to SYNC 103";
  EXPECT_EQ(scene.status & 0x1000, 0x1000);
}

TEST(CanDrive, ProfileVelocityKeepsItsRamps) {
  DriveScene scene;
  scene.operate(3, 0x60FF0020, 0x606C0020);
  ASSERT_EQ(scene.master.write(5, 0x6083, 0, 200'000, 4), 0U);
  ASSERT_EQ(scene.master.write(5, 0x6084, 0, 50'000, 4), 0U);
  scene.enable(0);
  int32_t before = 0;
  for (int i = 0; i < 200; ++i) {
    scene.cycle(0x0F, 10'000);
    ASSERT_LE(scene.actual - before, 200);
    ASSERT_EQ((scene.status & 0x400) != 0, scene.actual == (i < 2 ? 0 : 10'000)) << i;
    before = scene.actual;
  }
  EXPECT_EQ(scene.actual, 10'000);
  for (int i = 0; i < 300; ++i) { // halt
    scene.cycle(0x10F, 10'000);
    ASSERT_GE(scene.actual - before, -50);
    before = scene.actual;
  }
  EXPECT_EQ(scene.actual, 0);
  EXPECT_EQ(scene.status & 0x1400, 0x1400) << "at rest";
}

TEST(CanDrive, TorqueMovesAMass) {
  Drive402Setup setup = plainDrive();
  setup.drive.mechanics.model = dummy::Model::SecondOrder;
  setup.drive.mechanics.inertia = 1e-6;
  setup.drive.mechanics.torqueLimit = 4;
  setup.ratedTorque = 2;
  DriveScene scene(setup);
  scene.operate(10, 0x60710010, 0x606C0020);
  EXPECT_EQ(scene.master.read(5, 0x6076), 2000U);
  for (const unsigned word : {6U, 7U, 15U})
    for (int i = 0; i < 4; ++i) {
      scene.master.syncCycle();
      scene.master.send(0x205, {word, 0, 0, 0}, SendClass::Process);
    }
  for (int i = 0; i < 102; ++i) { // 0.1 of 2 Nm: 200000 inc/s²
    scene.master.syncCycle();
    scene.master.send(0x205, {0x0F, 0, 100, 0}, SendClass::Process);
  }
  EXPECT_NEAR(scene.drive.mechanics().velocity(), 200'000 * 0.1, 500);
  EXPECT_EQ(scene.drive.objects().at(0x6077).asSigned(), 100);
}

TEST(CanDrive, InterpolatedModeWaitsForItsBit) {
  DriveScene scene;
  scene.operate(7, 0x60C10120);
  scene.enable();
  const int32_t start = scene.drive.position();
  for (int i = 0; i < 5; ++i)
    scene.cycle(0x0F, start + 100);
  EXPECT_EQ(scene.actual, start);
  EXPECT_EQ(scene.status & 0x1000, 0);
  for (int i = 0; i < 5; ++i)
    scene.cycle(0x1F, start + 100);
  EXPECT_EQ(scene.actual, start + 100);
  EXPECT_EQ(scene.status & 0x1000, 0x1000);
}

TEST(CanDrive, QuickStopBrakesWithItsRampAndStaysIfTold) {
  for (const unsigned option : {2U, 6U}) {
    DriveScene scene;
    scene.operate();
    ASSERT_EQ(scene.master.write(5, 0x605A, 0, option, 2), 0U);
    ASSERT_EQ(scene.master.write(5, 0x6085, 0, 2'000'000, 4), 0U);
    scene.enable();
    int32_t target = scene.drive.position();
    for (int i = 0; i < 50; ++i)
      scene.cycle(0x0F, target += 30); // 30000 inc/s: 15 ms to rest, on 225 increments
    scene.cycle(0x02, target += 30);
    for (int i = 0; i < 2; ++i)
      scene.cycle(0x02, target);
    EXPECT_EQ(scene.drive.power(), PowerState::QuickStopActive);
    for (int i = 0; i < 20; ++i)
      scene.cycle(0x02, target);
    EXPECT_NEAR(scene.actual, target + 225, 31);
    EXPECT_EQ(scene.drive.power(),
              option == 2 ? PowerState::SwitchOnDisabled : PowerState::QuickStopActive);
    for (int i = 0; i < 3; ++i)
      scene.cycle(0x0F, scene.actual);
    EXPECT_EQ(scene.drive.power(),
              option == 2 ? PowerState::SwitchOnDisabled : PowerState::OperationEnabled);
  }
}

TEST(CanDrive, AFaultIsResetByAnEdgeOnly) {
  DriveScene scene;
  scene.operate();
  scene.enable();
  for (int i = 0; i < 3; ++i) // the bit is high before the fault
    scene.cycle(0x8F, scene.drive.position());
  EXPECT_EQ(scene.drive.power(), PowerState::OperationEnabled) << "the bit means nothing there";
  scene.master.seen.clear();
  scene.drive.raiseError(0x3210);
  for (int i = 0; i < 4; ++i)
    scene.cycle(0x8F, scene.drive.position());
  EXPECT_EQ(scene.status & 0x4F, 0x08);
  EXPECT_EQ(scene.drive.power(), PowerState::Fault) << "it was high all the time";
  EXPECT_EQ(scene.drive.objects().value(0x603F), 0x3210U);
  scene.cycle(0x00, scene.drive.position());
  for (int i = 0; i < 3; ++i)
    scene.cycle(0x80, scene.drive.position());
  EXPECT_EQ(scene.drive.power(), PowerState::SwitchOnDisabled);
  EXPECT_EQ(scene.drive.objects().value(0x603F), 0U);
}

TEST(CanDrive, FaultsAreToldByEmergencies) {
  DriveScene scene;
  scene.operate();
  scene.enable();
  scene.drive.raiseError(0x7305);
  scene.cycle(0x0F, scene.drive.position());
  scene.cycle(0x0F, scene.drive.position());
  const auto message = scene.master.last(0x085);
  ASSERT_TRUE(message);
  EXPECT_EQ(wordAt(*message, 0, 2), 0x7305U);
  EXPECT_EQ(message->data[2] & 1U, 1U);
  EXPECT_EQ(scene.drive.objects().value(0x1003, 1), 0x7305U);
}

TEST(CanDrive, TheFollowingErrorIsWatched) {
  Drive402Setup setup = plainDrive();
  setup.drive.mechanics.model = dummy::Model::Lag;
  setup.drive.mechanics.timeConstant = 0.02;
  DriveScene scene(setup);
  scene.operate();
  ASSERT_EQ(scene.master.write(5, 0x6065, 0, 300, 4), 0U);
  ASSERT_EQ(scene.master.write(5, 0x6066, 0, 10, 2), 0U);
  scene.enable();
  int32_t target = scene.drive.position();
  for (int i = 0; i < 100; ++i) // 10000 inc/s · 20 ms: 200 late
    scene.cycle(0x0F, target += 10);
  EXPECT_NEAR(static_cast<double>(scene.drive.objects().at(0x60F4).asSigned()), 200, 3);
  EXPECT_EQ(scene.status & 0x2000, 0);
  for (int i = 0; i < 100 && scene.drive.power() == PowerState::OperationEnabled; ++i)
    scene.cycle(0x0F, target += 20);
  for (int i = 0; i < 100; ++i)
    scene.cycle(0x0F, target);
  EXPECT_EQ(scene.drive.power(), PowerState::Fault);
  EXPECT_EQ(scene.drive.objects().value(0x603F), 0x8611U);
}

} // namespace
} // namespace stride::can::simulation
