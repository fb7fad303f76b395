// Homing, switches, touch probes, and what programs see of the simulation.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace stride::can::simulation {
namespace {

Drive402Setup withSwitches() {
  Drive402Setup setup = plainDrive();
  dummy::DriveParameters &p = setup.drive;
  p.hasLimitNegative = p.hasLimitPositive = true;
  p.limitNegative = -5000;
  p.limitPositive = 6000;
  p.home = {true, -2000.25, -1000.75};
  p.index = {true, 333, 1000};
  p.probe = {true, 1500, 0};
  p.unitsPerIncrement = 0.001;
  return setup;
}

struct Homing {
  int method;
  int32_t offset;
  double reference; ///< Where the mechanics are when the counter is the offset.
};

TEST(CanDriveHoming, MethodsFindTheirReference) {
  for (const Homing &homing : {Homing{19, 100, -2000.25}, Homing{21, -40, -1000.75},
                               Homing{17, 0, -5000}, Homing{18, 7, 6000}, Homing{33, 0, 333},
                               Homing{34, 12, 1333}, Homing{35, 4711, 777}, Homing{37, 1, 777}}) {
    Drive402Setup setup = withSwitches();
    if (homing.method == 19)
      setup.drive.startPosition = -3000;
    DriveScene scene(setup);
    scene.operate();
    ASSERT_EQ(scene.master.write(5, 0x6098, 0, static_cast<uint32_t>(homing.method), 1), 0U);
    ASSERT_EQ(scene.master.write(5, 0x607C, 0, static_cast<uint32_t>(homing.offset), 4), 0U);
    ASSERT_EQ(scene.master.write(5, 0x6060, 0, 6, 1), 0U);
    scene.enable();
    EXPECT_EQ(scene.status & 0x3000, 0) << homing.method;
    int cycles = 0;
    double fastest = 0;
    bool moving = false;
    for (; cycles < 3000 && (scene.status & 0x3400) != 0x1400; ++cycles) {
      scene.cycle(0x1F, 0);
      fastest = std::max(fastest, std::abs(scene.drive.mechanics().velocity()));
      ASSERT_EQ(scene.status & 0x2000, 0) << homing.method;
      moving = moving || (scene.status & 0x1400) == 0x1000;
    }
    ASSERT_LT(cycles, 3000) << homing.method;
    EXPECT_EQ(moving, homing.method < 35) << "attained, and still braking";
    EXPECT_LE(fastest, homing.method < 30 ? 20000 : 3000);
    EXPECT_EQ(scene.drive.mechanics().velocity(), 0);
    EXPECT_NEAR(static_cast<double>(scene.drive.position() - homing.offset) + homing.reference,
                static_cast<double>(scene.drive.mechanics().position()), 0.5)
        << homing.method;
    // Back to positions: nothing jumps.
    const int32_t place = scene.drive.position();
    scene.drive.write(0x6060, 0, 8);
    for (int i = 0; i < 4; ++i)
      scene.cycle(0x0F, place);
    EXPECT_EQ(scene.actual, place);
  }
}

TEST(CanDriveHoming, FailsAtALimitSwitchAndStopsWhenTold) {
  Drive402Setup setup = withSwitches();
  setup.drive.home = {};
  DriveScene scene(setup);
  scene.operate();
  ASSERT_EQ(scene.master.write(5, 0x6060, 0, 6, 1), 0U);
  EXPECT_EQ(scene.master.write(5, 0x6098, 0, 5, 1), 0x06090030U) << "not one of its methods";
  scene.enable();
  for (int i = 0; i < 2000 && (scene.status & 0x2000) == 0; ++i)
    scene.cycle(0x1F, 0);
  for (int i = 0; i < 50; ++i)
    scene.cycle(0x1F, 0);
  EXPECT_EQ(scene.status & 0x3400, 0x2400) << "error, at rest";
  EXPECT_EQ(scene.drive.power(), PowerState::OperationEnabled);

  DriveScene other(withSwitches());
  other.operate();
  ASSERT_EQ(other.master.write(5, 0x6060, 0, 6, 1), 0U);
  other.enable();
  for (int i = 0; i < 40; ++i)
    other.cycle(0x1F, 0);
  EXPECT_EQ(other.status & 0x3400, 0) << "under way";
  EXPECT_LT(other.drive.mechanics().velocity(), -1000);
  for (int i = 0; i < 60; ++i)
    other.cycle(0x0F, 0);
  EXPECT_EQ(other.status & 0x3400, 0x0400) << "interrupted";
  EXPECT_EQ(other.drive.mechanics().velocity(), 0);
}

TEST(CanDriveSignals, SwitchesAreBitsOf60FDh) {
  DriveScene scene(withSwitches());
  const struct {
    int64_t place;
    uint32_t bits;
  } cases[] = {{-5000, 1}, {-4999, 0}, {-2000, 4}, {-1001, 4}, {-1000, 0}, {5999, 0}, {6000, 2}};
  for (const auto &[place, bits] : cases) {
    scene.drive.place(place);
    scene.master.cycle(3);
    EXPECT_EQ(scene.master.read(5, 0x60FD), bits) << place;
  }
}

TEST(CanDriveSignals, TouchProbesLatchOnceUntilTheyAreArmedAnew) {
  DriveScene scene(withSwitches());
  scene.operate();
  scene.enable();
  ASSERT_EQ(scene.master.write(5, 0x60B8, 0, 0x0011, 2), 0U); // probe 1, rising, first event
  EXPECT_EQ(scene.master.read(5, 0x60B9), 0x0001U);
  int32_t target = scene.drive.position();
  for (int i = 0; i < 100; ++i)
    scene.cycle(0x0F, target += 11);
  EXPECT_EQ(scene.drive.objects().value(0x60B9), 3U);
  EXPECT_EQ(scene.drive.objects().value(0x60BA), 1500U) << "exactly, between two cycles";
  for (int i = 0; i < 100; ++i)
    scene.cycle(0x0F, target -= 11);
  EXPECT_EQ(scene.drive.objects().value(0x60BA), 1500U);
  scene.drive.probe(0);
  EXPECT_EQ(scene.drive.objects().value(0x60BA), 1500U) << "it has its event";
  scene.drive.write(0x60B8, 0, 0);
  EXPECT_EQ(scene.drive.objects().value(0x60B9), 0U);
  scene.drive.write(0x60B8, 0, 0x3011); // and probe 2 at both edges, not enabled
  scene.drive.probe(0);
  scene.drive.probe(2);
  EXPECT_EQ(scene.drive.objects().value(0x60B9), 3U);
  EXPECT_EQ(scene.drive.objects().at(0x60BA).asSigned(), scene.drive.position());
  scene.drive.write(0x60B8, 0, 0x3111);
  scene.drive.probe(1); // the other edge of the first one
  scene.drive.probe(3);
  EXPECT_EQ(scene.drive.objects().value(0x60B9), 0x0503U);
  EXPECT_EQ(scene.drive.objects().at(0x60BD).asSigned(), scene.drive.position());
}

TEST(CanDriveSignals, AnIndexPulseCanBeLatched) {
  DriveScene scene(withSwitches());
  scene.operate();
  scene.enable();
  scene.drive.write(0x60B8, 0, 0x0015); // rising, index, first
  int32_t target = scene.drive.position();
  for (int i = 0; i < 100; ++i)
    scene.cycle(0x0F, target += 17);
  EXPECT_EQ(scene.drive.objects().value(0x60BA), 1333U);
}

TEST(CanDriveSignals, ProgramsSeeAndDisturbIt) {
  DriveSim sim{};
  DriveScene scene(withSwitches());
  scene.drive.bind(&sim);
  scene.operate();
  scene.enable();
  for (int i = 0; i < 6; ++i)
    scene.cycle(0x0F, 2000);
  EXPECT_EQ(sim.fPosition, 2.0);
  sim.wDriveError = 4711;
  scene.cycle(0x0F, 2000);
  scene.cycle(0x0F, 2000);
  scene.cycle(0x0F, 2000);
  EXPECT_EQ(scene.drive.power(), PowerState::Fault);
  EXPECT_EQ(scene.drive.objects().value(0x603F), 4711U);
  sim.bErrorPersistent = 1;
  scene.cycle(0x00, 2000);
  for (int i = 0; i < 4; ++i)
    scene.cycle(0x80, 2000);
  EXPECT_EQ(scene.drive.power(), PowerState::Fault);
  sim.bErrorPersistent = 0;
  scene.cycle(0x00, 2000);
  for (int i = 0; i < 4; ++i)
    scene.cycle(0x80, 2000);
  EXPECT_EQ(sim.wDriveError, 0);
  sim.fHandPosition = -1.5;
  sim.bMoveByHand = 1;
  scene.cycle(0x00, 2000);
  scene.cycle(0x00, 2000);
  EXPECT_EQ(scene.drive.position(), -1500);
  EXPECT_EQ(sim.bHomeSwitch, 1);
  sim.bRegulatorStuck = 1;
  for (int i = 0; i < 5; ++i)
    scene.cycle(0x06, -1500);
  for (int i = 0; i < 5; ++i)
    scene.cycle(0x07, -1500);
  EXPECT_EQ(scene.drive.power(), PowerState::ReadyToSwitchOn);
  sim.bRegulatorStuck = 0;
  for (int i = 0; i < 5; ++i)
    scene.cycle(0x07, -1500);
  EXPECT_EQ(scene.drive.power(), PowerState::SwitchedOn);
  sim.bLoseCommunication = 1;
  scene.cycle(0x07, -1500);
  scene.cycle(0x07, -1500);
  const int before = scene.telegrams;
  for (int i = 0; i < 10; ++i)
    scene.cycle(0x07, -1500);
  EXPECT_EQ(scene.telegrams, before);
  sim.bLoseCommunication = 0;
  for (int i = 0; i < 10; ++i)
    scene.cycle(0x07, -1500);
  EXPECT_GT(scene.telegrams, before);
}

TEST(CanDriveSignals, ProgramsKeepItFromStarting) {
  DriveSim sim{};
  DriveScene scene(withSwitches());
  scene.drive.bind(&sim);
  sim.bFailStartUp = 1;
  EXPECT_EQ(scene.master.write(5, 0x6060, 0, 8, 1), 0x08000021U);
  sim.bFailStartUp = 0;
  EXPECT_EQ(scene.master.write(5, 0x6060, 0, 8, 1), 0U);
  sim.bHoldParameters = 1;
  scene.master.cycle(3);
  EXPECT_FALSE(scene.master.read(5, 0x6060));
  EXPECT_EQ(scene.master.aborted, 1U) << "no answer at all";
  sim.bHoldParameters = 0;
  scene.master.cycle(3);
  EXPECT_EQ(scene.master.read(5, 0x6060), 8U);
}

TEST(CanDriveSignals, SwitchingTakesItsCycles) {
  Drive402Setup setup = plainDrive();
  setup.drive.switchCycles = 4;
  DriveScene scene(setup);
  scene.operate();
  for (int i = 0; i < 3; ++i)
    scene.cycle(0x06, 777);
  int cycles = 0;
  for (; scene.drive.power() != PowerState::SwitchedOn; ++cycles)
    scene.cycle(0x07, 777);
  EXPECT_EQ(cycles, 6) << "two on the way, and three more after the first one";
}

} // namespace
} // namespace stride::can::simulation
