// Reference runs and touch probes of the drive.
#include "runtime/bus/drive_values.hpp"
#include "tests/unit/can_master/drive_fixture.hpp"

#include <gtest/gtest.h>

#include <array>

namespace stride::can {
namespace {

using test::kEnabledWord;

// Homing: bits 10, 12 and 13 in each combination.

class Homing : public test::DriveTest {
protected:
  void SetUp() override {
    plan(4, true);
    config.homingTimeout = 50;
    config.modeTimeout = 20;
    facts.homeOffset = 4321;
  }
  void start() {
    make();
    enable();
    command.homing = true;
  }
  bus::Homing homing() const { return drive->status().homing; }
  void cycles(int count, int bits) {
    for (int i = 0; i < count; ++i)
      cycle(kEnabledWord | bits);
  }
};

TEST_F(Homing, FindsItsReference) {
  start();
  signals.set(Signal::Position, 800);
  cycles(1, 0);
  EXPECT_EQ(number(Signal::Mode), 6);
  EXPECT_EQ(told(Signal::Controlword), 0x0FU) << "bit 4 after the mode only";
  cycles(3, 0);
  EXPECT_EQ(told(Signal::Controlword), 0x1FU);
  EXPECT_EQ(homing(), bus::Homing::Running);
  EXPECT_EQ(told(Signal::TargetPosition), 800U) << "where it is";
  cycles(500, 0); // as long as it likes
  EXPECT_EQ(homing(), bus::Homing::Running);
  cycles(10, 0x1000); // attained, and still moving
  EXPECT_EQ(homing(), bus::Homing::Running);
  EXPECT_EQ(number(Signal::Mode), 6);
  signals.set(Signal::Position, 4400);
  cycles(1, 0x1400);
  EXPECT_EQ(homing(), bus::Homing::Running);
  EXPECT_EQ(number(Signal::Mode), 8);
  EXPECT_EQ(told(Signal::Controlword), 0x0FU);
  EXPECT_EQ(told(Signal::TargetPosition), 4400U);
  cycles(3, 0x1400);
  EXPECT_EQ(homing(), bus::Homing::Found);
  EXPECT_EQ(drive->status().homePosition, 4321U);
  command.homing = false;
  command.position = 4399;
  cycles(2, 0x1400);
  EXPECT_EQ(homing(), bus::Homing::None);
  EXPECT_EQ(told(Signal::TargetPosition), 4399U);
}

TEST_F(Homing, TakesTheOffsetThatTheDriveHasThen) {
  for (const uint32_t offset : {99U, 777U}) {
    start();
    cycles(3, 0);
    EXPECT_EQ(drive->wish().object, object::kHomeOffset);
    answer(offset);
    EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::None) << "once in a run";
    cycles(10, 0);
    cycles(4, 0x1400);
    EXPECT_EQ(homing(), bus::Homing::Found);
    EXPECT_EQ(drive->status().homePosition, offset);
    command.homing = false;
    cycles(2, 0);
    command.homing = true;
    cycles(3, 0);
    EXPECT_EQ(drive->wish().object, object::kHomeOffset) << "and in the next one again";
    command.homing = false;
  }
}

TEST_F(Homing, WhatItSaidBeforeDoesNotCount) {
  start();
  for (int i = 0; i < 6; ++i) { // attained, from the last time
    cycles(1, 0x1400);
    EXPECT_NE(homing(), bus::Homing::Found);
  }
  cycles(20, 0);
  EXPECT_EQ(homing(), bus::Homing::Running);
}

TEST_F(Homing, AtItsPlaceAtOnce) {
  start();
  cycles(30, 0x1400);
  EXPECT_EQ(homing(), bus::Homing::Found);
}

TEST_F(Homing, Fails) {
  for (const int bits : {0x2000, 0x2400, 0x3000, 0x3400}) {
    start();
    cycles(20, 0);
    for (uint32_t i = 0; (bits & 0x0400) == 0 && i < 20; ++i) { // it brakes
      signals.set(Signal::Position, 1000 + 100 * i);
      cycles(1, bits);
      EXPECT_EQ(homing(), bus::Homing::Running) << bits;
      EXPECT_EQ(number(Signal::Mode), 6) << "it would be led back";
    }
    cycles(2, bits | 0x0400);
    EXPECT_EQ(homing(), bus::Homing::Failed) << bits;
    EXPECT_EQ(number(Signal::Mode), 8);
    EXPECT_EQ(told(Signal::Controlword), 0x0FU);
    command.homing = false;
    cycles(2, 0);
    EXPECT_EQ(homing(), bus::Homing::None);
  }
}

TEST_F(Homing, FailsAtRestWithoutSayingThatItRests) {
  start();
  cycles(20, 0);
  for (uint32_t i = 0; i < 5; ++i) {
    signals.set(Signal::Position, 1000 + 100 * i);
    cycles(1, 0x2000);
  }
  EXPECT_EQ(homing(), bus::Homing::Running);
  cycles(static_cast<int>(bus::kRestCycles) + 2, 0x2000);
  EXPECT_EQ(homing(), bus::Homing::Failed);
}

TEST_F(Homing, LosesPowerWhileItBrakes) {
  start();
  cycles(20, 0);
  signals.set(Signal::Position, 1000);
  cycles(1, 0x2000);
  cycle(0x240);
  cycle(0x240);
  EXPECT_EQ(homing(), bus::Homing::Failed);
}

TEST_F(Homing, IsInterrupted) {
  start();
  cycles(20, 0);
  cycles(2, 0x0400);
  EXPECT_EQ(homing(), bus::Homing::Failed);
}

TEST_F(Homing, DoesNotBegin) {
  start();
  cycles(50, 0x0400); // "not started"
  EXPECT_EQ(homing(), bus::Homing::Running);
  cycles(20, 0x0400);
  EXPECT_EQ(homing(), bus::Homing::Failed);
}

TEST_F(Homing, LosesPower) {
  start();
  cycles(20, 0);
  cycle(0x240);
  cycle(0x240);
  EXPECT_EQ(homing(), bus::Homing::Failed);
}

TEST_F(Homing, WithoutTheMode) {
  facts.supportedModes = 0x380;
  start();
  cycles(3, 0);
  EXPECT_EQ(homing(), bus::Homing::Failed);
  EXPECT_EQ(number(Signal::Mode), 8);
}

TEST_F(Homing, ByTheController) {
  config.homesItself = false;
  start();
  cycles(3, 0);
  EXPECT_EQ(homing(), bus::Homing::Failed);
}

TEST_F(Homing, TheModeIsNotTaken) {
  start();
  modeFollows = false;
  cycles(40, 0);
  EXPECT_EQ(homing(), bus::Homing::Failed);
  EXPECT_EQ(number(Signal::Mode), 8);
}

TEST_F(Homing, IsGivenUp) {
  start();
  cycles(20, 0);
  command.homing = false;
  for (uint32_t i = 0; i < 20; ++i) { // it brakes
    signals.set(Signal::Position, 1000 + 100 * i);
    cycles(1, 0);
    EXPECT_EQ(told(Signal::Controlword), 0x0FU) << "without bit 4";
    EXPECT_EQ(number(Signal::Mode), 6) << "it would be led back";
    EXPECT_EQ(homing(), bus::Homing::Running);
  }
  command.position = 7;
  cycles(static_cast<int>(bus::kRestCycles), 0);
  EXPECT_EQ(number(Signal::Mode), 8);
  EXPECT_EQ(told(Signal::TargetPosition), 2900U) << "where it is, until it has the mode";
  cycles(3, 0);
  EXPECT_EQ(homing(), bus::Homing::None);
  EXPECT_EQ(told(Signal::TargetPosition), 7U);
}

TEST_F(Homing, IsGivenUpAndLosesPower) {
  start();
  cycles(20, 0);
  command.homing = false;
  signals.set(Signal::Position, 1000);
  cycles(1, 0);
  cycle(0x240);
  cycle(0x240);
  EXPECT_EQ(homing(), bus::Homing::None);
}

TEST_F(Homing, IsGivenUpAndWantedAgain) {
  start();
  cycles(20, 0);
  command.homing = false;
  signals.set(Signal::Position, 1000);
  cycles(1, 0);
  command.homing = true;
  cycles(4, 0);
  EXPECT_EQ(told(Signal::Controlword), 0x0FU) << "it comes to rest first";
  cycles(20, 0);
  EXPECT_EQ(told(Signal::Controlword), 0x1FU);
}

/// Not in a reference run: nothing of the mode has been asked.
TEST_F(Homing, AModeThatMeansNothingStopsNoMotion) {
  make();
  enable();
  signals.set(Signal::Position, 990);
  for (uint32_t i = 0; i < 5; ++i) {
    command.position = 1000 + 10 * i;
    modeFollows = false;
    signals.setNumber(Signal::ModeDisplay, i % 2 == 0 ? 8 : 0);
    cycles(1, 0);
    EXPECT_EQ(told(Signal::TargetPosition), command.position) << i;
  }
}

// Touch probes.

class Probe : public test::DriveTest {
protected:
  void SetUp() override {
    wish.probeInputs = 15;
    plan(5);
    make();
  }
  void cycleWith(uint8_t capture, uint16_t status) {
    command.capture = capture;
    signals.set(Signal::ProbeStatus, status);
    cycle(0x240);
  }
};

TEST_F(Probe, ArmsLatchesAndArmsAnew) {
  cycleWith(0b0001, 0); // wanted from the next cycle on
  cycleWith(0b0001, 0);
  cycleWith(0b0001, 0);
  EXPECT_EQ(told(Signal::ProbeFunction), 0x0011U) << "on, first event, rising";
  cycleWith(0b0001, 0x0001);
  EXPECT_EQ(drive->status().captured, 0);
  signals.set(Signal::Probe1Rising, 5150);
  cycleWith(0b0001, 0x0003);
  EXPECT_EQ(drive->status().captured, 0b0001);
  EXPECT_EQ(drive->status().capturedPosition[0], 5150U);
  signals.set(Signal::Probe1Rising, 1);
  cycleWith(0b0001, 0x0003);
  EXPECT_EQ(drive->status().capturedPosition[0], 5150U) << "the first one";
  // Anew: off, until the drive says so.
  cycleWith(0, 0x0003);
  cycleWith(0b0001, 0x0003);
  EXPECT_EQ(told(Signal::ProbeFunction), 0U);
  EXPECT_EQ(drive->status().captured, 0);
  for (int i = 0; i < 5; ++i)
    cycleWith(0b0001, 0x0003);
  EXPECT_EQ(told(Signal::ProbeFunction), 0U);
  EXPECT_EQ(drive->status().captured, 0);
  cycleWith(0b0001, 0x0000);
  EXPECT_EQ(told(Signal::ProbeFunction), 0x0011U);
}

TEST_F(Probe, EachInputHasItsBits) {
  const std::array<uint32_t, 4> functions = {0x0011, 0x0021, 0x1100, 0x2100};
  const std::array<uint16_t, 4> latched = {0x0003, 0x0005, 0x0300, 0x0500};
  for (size_t input = 0; input < 4; ++input) {
    const auto bit = static_cast<uint8_t>(1U << input);
    cycleWith(0, 0);
    for (int i = 0; i < 3; ++i)
      cycleWith(bit, 0);
    EXPECT_EQ(told(Signal::ProbeFunction), functions[input]);
    const uint16_t on = input < 2 ? 0x0001 : 0x0100;
    cycleWith(bit, on);
    cycleWith(bit, on);
    EXPECT_EQ(drive->status().captured, 0);
    cycleWith(bit, latched[input]);
    if (input > 0) { // its position is not in a PDO
      EXPECT_EQ(drive->status().captured, 0);
      const ObjectWish asked = drive->wish();
      EXPECT_EQ(asked.object.index, 0x60BA + input);
      answer(static_cast<uint32_t>(7000 + input));
      cycleWith(bit, latched[input]);
      EXPECT_EQ(drive->status().capturedPosition[input], 7000 + input);
    }
    EXPECT_EQ(drive->status().captured, bit);
    cycleWith(0, 0);
    cycleWith(0, 0);
  }
}

TEST_F(Probe, AnEdgeThatNobodyWaitsForIsNotTaken) {
  for (int i = 0; i < 4; ++i)
    cycleWith(0b0001, 0x0000);
  cycleWith(0b0001, 0x0001);
  cycleWith(0b0001, 0x0005); // the falling one
  EXPECT_EQ(drive->status().captured, 0);
  EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::None);
}

TEST(NoProbe, WithoutInputsNothingIsArmed) {
  DriveWish wish;
  const DrivePlan plan = planDrive(wish).plan;
  Drive402 drive(DriveConfig{}, plan);
  Signals signals;
  drive.begin({}, signals);
  bus::DriveCommand command;
  command.capture = 15;
  drive.command(command);
  drive.read(signals, 0);
  drive.write(signals);
  EXPECT_EQ(signals.get(Signal::ProbeFunction), 0U);
}

} // namespace
} // namespace stride::can
