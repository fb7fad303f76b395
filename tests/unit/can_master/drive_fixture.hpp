// A drive without a bus, for tests.
#ifndef STRIDE_TESTS_UNIT_CAN_MASTER_DRIVE_FIXTURE_HPP
#define STRIDE_TESTS_UNIT_CAN_MASTER_DRIVE_FIXTURE_HPP

#include "drivers/can/master/drive402.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace stride::can::test {

inline constexpr uint16_t kEnabledWord = 0x0227;
inline constexpr uint16_t kFaultWord = 0x0208;

/// A drive whose statuswords a test gives, cycle by cycle.
class DriveTest : public ::testing::Test {
protected:
  void plan(uint8_t type, bool modeInPdo = false) {
    wish.controlType = type;
    wish.modeInPdo = modeInPdo;
  }
  void make() {
    if (wish.probeInputs != 0)
      config.probeInputs = wish.probeInputs;
    thePlan = planDrive(wish).plan;
    drive = std::make_unique<Drive402>(config, thePlan);
    if (facts.mode == mode::kNone)
      facts.mode = mode::kCyclicPosition;
    signals.setNumber(Signal::ModeDisplay, facts.mode);
    drive->begin(facts, signals);
    command.position = signals.get(Signal::Position);
    command.controllerMode = drive->status().controllerMode;
  }
  /// A cycle in which the drive shows that word; it takes what it is told about its mode.
  void cycle(int word) {
    signals.set(Signal::Statusword, static_cast<uint16_t>(word));
    drive->read(signals, emcy);
    drive->command(command);
    drive->write(signals);
    if (modeFollows)
      signals.set(Signal::ModeDisplay, signals.get(Signal::Mode));
  }
  void enable() {
    command.regulatorOn = command.driveStart = true;
    for (const int word : {0x240, 0x221, 0x223, 0x227, 0x227})
      cycle(word);
    ASSERT_TRUE(drive->status().driveStarted);
  }
  uint32_t told(Signal signal) const { return signals.get(signal); }
  int32_t number(Signal signal) const { return signals.number(signal); }
  void answer(uint32_t value) {
    const ObjectWish asked = drive->wish();
    ASSERT_NE(asked.kind, ObjectWish::Kind::None);
    drive->answered(asked, {true, value});
  }

  DriveWish wish;
  DriveConfig config;
  DriveFacts facts;
  DrivePlan thePlan;
  std::unique_ptr<Drive402> drive;
  Signals signals;
  bus::DriveCommand command;
  uint16_t emcy = 0;
  bool modeFollows = true;
};

} // namespace stride::can::test

#endif
