// Homing, probes, switches, diagnostics and what programs see.
#include "tests/unit/sercos_simulation/ring_master.hpp"

namespace stride::sercos::simulation {
namespace {

struct Operating : DriveScene {
  explicit Operating(const DriveSetup &setup = plainDrive()) : DriveScene(setup) {
    master.toPhase4();
    master.powerOn(id);
  }
};

DriveSetup withSwitch() {
  DriveSetup setup = plainDrive();
  setup.drive.home = {true, 100, 150};
  setup.drive.index = {true, 37, 500};
  setup.drive.hasLimitNegative = true;
  setup.drive.limitNegative = -400;
  return setup;
}

// ---- homing

TEST(SercosHoming, OnTheEdgeOfTheSwitch) {
  Operating o(withSwitch());
  ASSERT_EQ(o.master.write(3, 147, 0x41), 0); // negative, no index pulse
  ASSERT_EQ(o.master.write(3, 52, 5000, 4), 0);
  EXPECT_EQ(o.drive.list().value(403), 0);
  ASSERT_EQ(o.master.write(3, 148, 3), 0);
  o.master.cycle(5);
  EXPECT_EQ(o.master.records[3].status & 0x0008U, 0U) << "it does not follow";
  o.master.cycle(2000);
  EXPECT_EQ(o.master.read(3, 148, 1).number() & 15, 3);
  EXPECT_EQ(o.drive.list().value(403), 1);
  const auto reference = o.drive.mechanics().position() - (o.master.actual(3) - 5000);
  EXPECT_EQ(reference, 150) << "it came from above: the upper edge";
  EXPECT_EQ(o.drive.mechanics().velocity(), 0);
  o.master.setTarget(3, o.master.actual(3));
  ASSERT_EQ(o.master.write(3, 148, 0), 0);
  const int64_t before = o.drive.mechanics().position();
  o.master.cycle(5);
  EXPECT_EQ(o.drive.mechanics().position(), before) << "it follows again, and stays";
  EXPECT_EQ(o.master.records[3].status & 0x0008U, 0x0008U);
}

TEST(SercosHoming, AtAnIndexPulse) {
  for (const int64_t how : {0x20, 0x21, 0x01}) {
    Operating o(withSwitch());
    ASSERT_EQ(o.master.write(3, 147, how), 0);
    ASSERT_EQ(o.master.write(3, 52, -70, 4), 0);
    ASSERT_EQ(o.master.write(3, 148, 3), 0);
    o.master.cycle(3000);
    EXPECT_EQ(o.master.read(3, 148, 1).number() & 15, 3);
    const auto reference = o.drive.mechanics().position() - (o.master.actual(3) + 70);
    // From 777 upwards 1037, downwards 537; off the switch, upwards from 150, it is 537 too.
    EXPECT_EQ(reference, how == 0x20 ? 1037 : 537) << how;
  }
}

TEST(SercosHoming, Here) {
  Operating o;
  ASSERT_EQ(o.master.write(3, 147, 0x60), 0);
  ASSERT_EQ(o.master.write(3, 52, 123, 4), 0);
  ASSERT_EQ(o.master.write(3, 148, 3), 0);
  EXPECT_EQ(o.master.read(3, 148, 1).number(), 3);
  EXPECT_EQ(o.master.actual(3), 123);
  EXPECT_EQ(o.drive.mechanics().position(), 777);
}

TEST(SercosHoming, Fails) {
  DriveSetup setup = plainDrive(); // no switch, but an end
  setup.drive.hasLimitNegative = true;
  setup.drive.limitNegative = -400;
  Operating o(setup);
  ASSERT_EQ(o.master.write(3, 147, 0x41), 0);
  ASSERT_EQ(o.master.write(3, 148, 3), 0);
  EXPECT_EQ(o.master.write(3, 147, 0x40), 0x7005) << "not meanwhile";
  o.master.cycle(500);
  EXPECT_EQ(o.master.read(3, 148, 1).number(), 15);
  EXPECT_EQ(o.drive.list().value(403), 0);
  ASSERT_EQ(o.master.write(3, 148, 0), 0);
  o.master.setControl(3, 0);
  o.master.cycle(3);
  EXPECT_EQ(o.master.command(3, 148), 15) << "not without torque";
}

TEST(SercosHoming, CanBeCancelled) {
  Operating o(withSwitch());
  ASSERT_EQ(o.master.write(3, 147, 0x41), 0);
  ASSERT_EQ(o.master.write(3, 148, 3), 0);
  o.master.cycle(5);
  ASSERT_EQ(o.master.write(3, 148, 1), 0);
  EXPECT_EQ(o.master.read(3, 148, 1).number(), 5);
  o.master.cycle(50);
  EXPECT_EQ(o.drive.mechanics().velocity(), 0);
  EXPECT_EQ(o.drive.list().value(403), 0);
}

// ---- probes

TEST(SercosProbes, EachEdgeOfEachInput) {
  for (size_t input = 0; input < 4; ++input) {
    Operating o;
    const auto edge = static_cast<int64_t>(1U << input);
    const Idn enable = input < 2 ? 405 : 406;
    o.drive.probe(input);
    ASSERT_EQ(o.master.write(3, 169, edge), 0);
    ASSERT_EQ(o.master.write(3, enable, 1), 0);
    o.drive.probe(input);
    EXPECT_EQ(o.drive.list().value(179), 0) << "the command does not run";
    ASSERT_EQ(o.master.write(3, 170, 3), 0);
    for (size_t other = 0; other < 4; ++other)
      if (other != input)
        o.drive.probe(other);
    EXPECT_EQ(o.drive.list().value(179), 0) << "another edge";
    o.drive.probe(input);
    EXPECT_EQ(o.master.read(3, 179).number(), edge);
    const Idn latched = static_cast<Idn>(409 + input);
    const Idn value = static_cast<Idn>(130 + input);
    EXPECT_EQ(o.master.read(3, latched).number(), 1);
    EXPECT_EQ(o.master.read(3, value, 7, 4).number(), 777);
    o.master.setTarget(3, 801);
    o.master.cycle(4);
    o.drive.probe(input);
    EXPECT_EQ(o.drive.list().value(value), 777) << "once";
    ASSERT_EQ(o.master.write(3, enable, 0), 0);
    EXPECT_EQ(o.drive.list().value(latched), 0);
    ASSERT_EQ(o.master.write(3, enable, 1), 0);
    o.drive.probe(input);
    EXPECT_EQ(o.drive.list().value(value), 801) << "and again";
    ASSERT_EQ(o.master.write(3, 170, 0), 0);
    EXPECT_EQ(o.drive.list().value(179), 0);
  }
}

TEST(SercosProbes, MarksAlongTheAxisAndRealTimeBits) {
  DriveSetup setup = plainDrive();
  setup.drive.probe = {true, 790, 0};
  Operating o(setup);
  ASSERT_EQ(o.master.write(3, 169, 1), 0);
  ASSERT_EQ(o.master.write(3, 301, 405), 0);
  ASSERT_EQ(o.master.write(3, 305, 409), 0);
  ASSERT_EQ(o.master.write(3, 170, 3), 0);
  o.master.setControl(3, 0xE040); // enables it
  o.master.setTarget(3, 799);
  o.master.cycle(4);
  EXPECT_EQ(o.drive.list().value(130), 790);
  EXPECT_EQ(o.master.records[3].status & 0x00C0U, 0x0040U);
  o.master.setControl(3, 0xE000);
  o.master.cycle(3);
  EXPECT_EQ(o.master.records[3].status & 0x00C0U, 0U);
}

// ---- limits and classes

TEST(SercosLimits, OfPositionOnlyWithAReference) {
  DriveScene scene;
  RingMaster &master = scene.master;
  master.toPhase3();
  master.write(3, 32, 3);
  master.write(3, 55, 0x10);
  master.write(3, 49, 1000, 4);
  master.write(3, 50, -1000, 4);
  master.check(128);
  master.phase = 4;
  master.cycle(3);
  master.powerOn(3);
  master.setTarget(3, 1200);
  master.cycle(5);
  EXPECT_FALSE(scene.drive.hasError());
  master.setTarget(3, 900);
  master.cycle(5);
  master.write(3, 147, 0x60);
  master.write(3, 52, 900, 4);
  EXPECT_EQ(master.command(3, 148), 3);
  master.setTarget(3, 1000);
  master.cycle(5);
  EXPECT_FALSE(scene.drive.hasError()) << "at the limit";
  EXPECT_EQ(scene.drive.list().value(12), 0);
  master.setTarget(3, 1001);
  master.cycle(5);
  EXPECT_EQ(scene.drive.list().value(11), 0x2000);
}

TEST(SercosLimits, MonitoringWindow) {
  DriveSetup setup = plainDrive();
  setup.drive.mechanics.model = dummy::Model::Lag;
  setup.drive.mechanics.timeConstant = 0.05;
  Operating o(setup);
  ASSERT_EQ(o.master.write(3, 159, 60, 4), 0);
  o.master.setTarget(3, 777 + 60);
  o.master.cycle(100);
  EXPECT_FALSE(o.drive.hasError());
  o.master.setTarget(3, 777 + 200);
  o.master.cycle(5);
  EXPECT_EQ(o.drive.list().value(11), 0x0800);
}

TEST(SercosClasses, ChangeBitsLastUntilTheyAreRead) {
  Operating o;
  o.master.read(3, 13);
  o.master.cycle(3);
  EXPECT_EQ(o.master.records[3].status & 0x0800U, 0U);
  o.master.setTarget(3, 800);
  o.master.cycle(3);
  EXPECT_EQ(o.master.records[3].status & 0x0800U, 0x0800U) << "it has moved";
  o.master.cycle(10);
  EXPECT_EQ(o.master.records[3].status & 0x0800U, 0x0800U);
  EXPECT_EQ(o.master.read(3, 13).number(), 0x42) << "it stands, in position";
  o.master.cycle(2);
  EXPECT_EQ(o.master.records[3].status & 0x0800U, 0U);
  ASSERT_EQ(o.master.write(3, 98, 0), 0);
  o.master.setTarget(3, 900);
  o.master.cycle(5);
  EXPECT_EQ(o.master.records[3].status & 0x0800U, 0U) << "masked";
}

TEST(SercosClasses, FollowingDistance) {
  DriveSetup setup = plainDrive();
  setup.drive.mechanics.model = dummy::Model::Lag;
  setup.drive.mechanics.timeConstant = 0.02;
  Operating o(setup);
  int32_t target = 777;
  for (int i = 0; i < 200; ++i) {
    o.master.setTarget(3, target += 10); // 5000 inc/s: 100 after
    o.master.cycle();
  }
  EXPECT_NEAR(static_cast<double>(o.drive.list().value(189)), 100, 1);
}

// ---- programs

TEST(SercosSim, WhatProgramsDo) {
  DriveSim sim{};
  DriveScene scene(withSwitch());
  scene.drive.bind(&sim);
  RingMaster &master = scene.master;
  master.toPhase4();
  sim.bMoveByHand = 1;
  sim.fHandPosition = 120;
  master.cycle(2);
  EXPECT_EQ(master.actual(3), 120);
  EXPECT_EQ(sim.bHomeSwitch, 1);
  EXPECT_EQ(scene.drive.list().value(400), 1);
  EXPECT_EQ(scene.drive.list().value(32769), 4);
  sim.bForceIndex = 1;
  master.cycle(2);
  EXPECT_EQ(sim.udiIndexCount, 1U);
  EXPECT_EQ(scene.drive.list().value(32771), 1);
  EXPECT_EQ(scene.drive.list().value(32770), 120);
  sim.bRegulatorStuck = 1;
  master.setTarget(3, 120);
  master.setControl(3, 0xE000);
  master.cycle(5);
  EXPECT_EQ(master.records[3].status >> 14U, 2U);
  sim.bRegulatorStuck = 0;
  master.cycle(2);
  EXPECT_EQ(master.records[3].status >> 14U, 3U);
  sim.wDriveError = 99;
  sim.bErrorPersistent = 1;
  master.cycle(4);
  EXPECT_EQ(scene.drive.list().value(129), 99);
  EXPECT_EQ(master.command(3, 99), 15);
  sim.bErrorPersistent = 0;
  EXPECT_EQ(master.command(3, 99), 3);
  EXPECT_EQ(sim.wDriveError, 0);
  sim.bLoseCommunication = 1;
  master.cycle(3);
  EXPECT_EQ(scene.drive.phase(), Phase::Zero);
  EXPECT_EQ(master.answers.count, 0U);
  EXPECT_TRUE(master.answers.light) << "its light still passes";
  sim.bLoseCommunication = 0;
  sim.bFailStartUp = 1;
  master.toPhase2();
  master.writeTimes();
  EXPECT_EQ(master.command(3, 127), 15);
}

// ---- I/O

TEST(SercosIo, OutputsAndInputs) {
  IoSetup setup;
  setup.device.address = 3;
  SimulatedIo io(setup);
  RingMaster master;
  master.ring.attach(io);
  master.records[3];
  io.setInputs(0xA55A);
  master.toPhase2();
  master.writeTimes(4, 2, 7);
  EXPECT_EQ(master.writeIds(3, 16, {32768 + 16, 32768 + 17}), 0);
  EXPECT_EQ(master.writeIds(3, 24, {32768 + 16}), 0);
  master.check(127);
  master.phase = 3;
  master.setTarget(3, 0x1234, 0, 2);
  master.cycle(5);
  EXPECT_EQ(io.outputs(), 0) << "not before phase 4";
  master.check(128);
  master.phase = 4;
  master.cycle(3);
  EXPECT_EQ(io.outputs(), 0x1234);
  EXPECT_EQ(static_cast<uint32_t>(master.actual(3)), 0xA55A'1234U);
  master.phase = 0;
  master.cycle();
  EXPECT_EQ(io.outputs(), 0);
  EXPECT_EQ(io.list().find(47), nullptr) << "it is no drive";
}

} // namespace
} // namespace stride::sercos::simulation
