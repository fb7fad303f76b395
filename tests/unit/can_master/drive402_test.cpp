// The drive behind the driver interface: modes, targets, scaling, errors.
#include "tests/unit/can_master/drive_fixture.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace stride::can {
namespace {

using Drive = test::DriveTest;
using test::kEnabledWord;
using test::kFaultWord;

TEST_F(Drive, StatusFollowsThePowerStates) {
  plan(4);
  make();
  struct Row {
    uint16_t word;
    bool regulator;
    bool started;
  };
  for (const Row &row : {Row{0x00, false, false}, Row{0x40, false, false}, Row{0x21, false, false},
                         Row{0x23, true, false}, Row{0x27, true, true}, Row{0x07, true, false},
                         Row{0x08, false, false}, Row{0x0F, false, false}}) {
    cycle(row.word);
    EXPECT_EQ(drive->status().regulatorOn, row.regulator) << row.word;
    EXPECT_EQ(drive->status().driveStarted, row.started) << row.word;
  }
}

TEST_F(Drive, SetPositionIsTheActualOneUntilItIsFollowed) {
  plan(4);
  signals.set(Signal::Position, 777);
  make();
  command.position = 123456;
  command.regulatorOn = command.driveStart = true;
  for (const int word : {0x240, 0x221, 0x223}) {
    cycle(word);
    EXPECT_EQ(told(Signal::TargetPosition), 777U);
  }
  EXPECT_EQ(told(Signal::Controlword), 0x0FU);
  cycle(kEnabledWord);
  EXPECT_EQ(told(Signal::TargetPosition), 123456U);
}

TEST_F(Drive, ItsBrakeOpensBeforeItMoves) {
  config.brakeRelease = 3;
  plan(4);
  make();
  command.regulatorOn = command.driveStart = true;
  for (const int word : {0x240, 0x221, 0x223})
    cycle(word);
  command.position = 99;
  for (int i = 1; i <= 3; ++i) {
    signals.set(Signal::Position, static_cast<uint32_t>(-i)); // the load sags: the target does not
    cycle(kEnabledWord);
    EXPECT_FALSE(drive->status().driveStarted) << i;
    EXPECT_EQ(told(Signal::TargetPosition), 0U);
  }
  cycle(kEnabledWord);
  EXPECT_TRUE(drive->status().driveStarted);
  EXPECT_EQ(told(Signal::TargetPosition), 99U);
}

TEST_F(Drive, VelocityGoesAheadOfPositionsInItsOwnUnit) {
  config.velocityScale = 16;
  plan(5);
  make();
  enable();
  command.velocity = -803.9;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::VelocityOffset), -50);
  signals.setNumber(Signal::Velocity, -49);
  cycle(kEnabledWord);
  EXPECT_EQ(drive->status().velocity, -784);
  command.velocity = 1e300;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::VelocityOffset), 2147483647);
  command.velocity = -1e300;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::VelocityOffset), -2147483647);
  command.velocity = std::numeric_limits<double>::quiet_NaN();
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::VelocityOffset), 0);
}

TEST_F(Drive, PositionsWrapAt32Bits) {
  plan(4);
  make();
  enable();
  command.position = 0xFFFFFFF0;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::TargetPosition), -16);
  command.position = 16;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::TargetPosition), 16);
}

TEST_F(Drive, TorqueIsPerMilleOfTheRatedOne) {
  plan(1);
  facts.mode = mode::kCyclicTorque;
  facts.ratedTorque = 2500; // mNm
  make();
  EXPECT_EQ(drive->controllerModes(), 1U << kTorqueControl);
  enable();
  command.torque = 1.25;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::TargetTorque), 500);
  command.torque = -1e9;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::TargetTorque), -32767);
  command.regulatorOn = false;
  cycle(kEnabledWord);
  cycle(0x223);
  EXPECT_EQ(number(Signal::TargetTorque), 0) << "without power there is none";
}

TEST_F(Drive, ActualTorqueAndCurrent) {
  wish.send = {1100, 0, 0};
  wish.receive = {1101, 1161, 1151};
  plan(0);
  config.torqueRated = 4;
  facts.ratedCurrent = 5000; // mA
  make();
  signals.setNumber(Signal::Torque, -250);
  signals.setNumber(Signal::Current, 100);
  cycle(0x240);
  EXPECT_DOUBLE_EQ(drive->status().torque, -1.0);
  EXPECT_DOUBLE_EQ(drive->status().current, 0.5);
  EXPECT_EQ(drive->status().received, bus::kPosition | bus::kTorque | bus::kCurrent);
}

TEST_F(Drive, WithoutRatedTorqueThereIsNoTorque) {
  wish.send = {1100, 1160, 0};
  wish.receive = {1101, 1161, 0};
  plan(0);
  make();
  EXPECT_EQ(drive->controllerModes(), 1U << kPositionControl);
  EXPECT_EQ(drive->status().received, bus::kPosition);
}

TEST_F(Drive, ModesByWhatTheDriveSupports) {
  struct Row {
    uint32_t supported;
    int8_t position, velocity, torque;
  };
  for (const Row &row : {Row{0x3A0, 8, 9, 10}, Row{0x4C, 7, 3, 4}, Row{0x08, 0, 0, 4},
                         Row{0x44, 7, 3, 0}, Row{0x01, 0, 0, 0}, Row{0xFFFFFFFF, 8, 9, 10}}) {
    // 40h is interpolated position, 04h profile velocity, 08h profile torque.
    EXPECT_EQ(modeFor(3, row.supported), row.position) << row.supported;
    EXPECT_EQ(modeFor(2, row.supported), row.velocity);
    EXPECT_EQ(modeFor(1, row.supported), row.torque);
    EXPECT_EQ(modeFor(0, row.supported), 0);
    EXPECT_EQ(modeFor(4, row.supported), 0);
  }
  EXPECT_FALSE(isSupported(0, 0xFFFFFFFF));
  EXPECT_FALSE(isSupported(-1, 0xFFFFFFFF));
  EXPECT_FALSE(isSupported(33, 0xFFFFFFFF));
  EXPECT_TRUE(isSupported(32, 0x80000000));
}

TEST_F(Drive, AModeChangeInPdos) {
  plan(5);
  make();
  EXPECT_EQ(drive->controllerModes(), 12);
  enable();
  modeFollows = false;
  command.position = 5;
  command.velocity = 40;
  cycle(kEnabledWord);
  command.controllerMode = 2;
  for (int i = 0; i < 3; ++i) { // the old targets go on meanwhile
    command.position += 5;
    cycle(kEnabledWord);
    EXPECT_EQ(number(Signal::Mode), 9);
    EXPECT_EQ(told(Signal::TargetPosition), command.position);
    EXPECT_EQ(drive->status().controllerMode, 3);
  }
  signals.setNumber(Signal::ModeDisplay, 9);
  signals.set(Signal::Position, 3);
  cycle(kEnabledWord);
  EXPECT_EQ(drive->status().controllerMode, 2);
  EXPECT_EQ(number(Signal::VelocityOffset), 40);
  EXPECT_EQ(told(Signal::TargetPosition), 3U) << "where the axis is";
}

TEST_F(Drive, AModeChangeBySdo) {
  wish.send = {1100, 1160, 0};
  wish.receive = {1101, 0, 0};
  plan(0);
  config.torqueRated = 1;
  make();
  ASSERT_FALSE(thePlan.carries(Signal::Mode));
  EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::None);
  enable();
  command.controllerMode = 1;
  cycle(kEnabledWord);
  EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::Write);
  EXPECT_EQ(drive->wish().object, object::kMode);
  EXPECT_EQ(drive->wish().value, 10U);
  answer(0);
  cycle(kEnabledWord);
  EXPECT_EQ(drive->status().controllerMode, 3);
  EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::Read);
  EXPECT_EQ(drive->wish().object, object::kModeDisplay);
  answer(8); // not yet
  cycle(kEnabledWord);
  EXPECT_EQ(drive->status().controllerMode, 3);
  answer(10);
  cycle(kEnabledWord);
  EXPECT_EQ(drive->status().controllerMode, 1);
  EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::None);
}

TEST_F(Drive, AModeThatIsNotTakenIsGivenUpAtItsTime) {
  plan(5);
  config.modeTimeout = 10;
  make();
  enable();
  modeFollows = false;
  command.controllerMode = 2;
  for (int i = 1; i <= 10; ++i) {
    cycle(kEnabledWord);
    EXPECT_EQ(number(Signal::Mode), 9) << i;
  }
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::Mode), 8) << "back to the one that it has";
  for (int i = 0; i < 50; ++i)
    cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::Mode), 8) << "not again and again";
  EXPECT_EQ(drive->status().controllerMode, 3);
  EXPECT_FALSE(drive->status().error);
  command.controllerMode = 3;
  cycle(kEnabledWord);
  command.controllerMode = 2;
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::Mode), 9) << "asked anew";
}

TEST_F(Drive, AModeThatItDoesNotHaveIsNotTried) {
  plan(4);
  make();
  enable();
  for (const uint8_t other : {uint8_t{0}, uint8_t{1}, uint8_t{2}, uint8_t{4}, uint8_t{77}}) {
    command.controllerMode = other;
    cycle(kEnabledWord);
    EXPECT_EQ(number(Signal::Mode), 8);
  }
}

TEST_F(Drive, TargetsOfOtherModesAreActualValues) {
  wish.send = {1110, 1160, 0};
  wish.receive = {1111, 1161, 0};
  plan(0);
  config.torqueRated = 1;
  facts.mode = mode::kCyclicVelocity;
  make();
  enable();
  command.velocity = 100;
  signals.setNumber(Signal::Velocity, 90);
  signals.setNumber(Signal::Torque, 300);
  cycle(kEnabledWord);
  EXPECT_EQ(number(Signal::TargetVelocity), 100);
  EXPECT_EQ(number(Signal::TargetTorque), 300);
  cycle(0x223);
  EXPECT_EQ(number(Signal::TargetVelocity), 0);
  EXPECT_EQ(number(Signal::TargetTorque), 0);
}

TEST_F(Drive, InterpolatedPositionsNeedBit4) {
  plan(4);
  facts.supportedModes = 0x41;
  facts.mode = mode::kInterpolatedPosition;
  make();
  enable();
  cycle(kEnabledWord);
  EXPECT_EQ(told(Signal::Controlword), 0x1FU);
  command.driveStart = false;
  cycle(kEnabledWord);
  EXPECT_EQ(told(Signal::Controlword), 0x07U);
}

TEST_F(Drive, AFaultHasTheNumberOf603FElseOfTheEmcy) {
  plan(4);
  make();
  enable();
  emcy = 0x3210;
  cycle(kFaultWord);
  EXPECT_TRUE(drive->status().error);
  EXPECT_EQ(drive->status().errorId, 0x3210);
  EXPECT_EQ(drive->wish().object, object::kErrorCode);
  answer(0x3211);
  cycle(kFaultWord);
  EXPECT_EQ(drive->status().errorId, 0x3211);
  EXPECT_EQ(drive->wish().kind, ObjectWish::Kind::None) << "once for each fault";
  command.errorAckn = true;
  cycle(kFaultWord);
  EXPECT_EQ(told(Signal::Controlword), 0x80U);
  cycle(0x240);
  cycle(0x240);
  EXPECT_FALSE(drive->status().error);
  EXPECT_EQ(drive->status().errorId, 0);
}

TEST_F(Drive, AnEmcyAloneIsNoError) {
  plan(4);
  make();
  enable();
  emcy = 0x4210;
  cycle(kEnabledWord);
  EXPECT_FALSE(drive->status().error);
  EXPECT_TRUE(drive->status().driveStarted);
}

TEST_F(Drive, StaysInAState) {
  plan(4);
  config.power.timeout = 5;
  make();
  command.regulatorOn = true;
  for (int i = 0; i < 6; ++i)
    cycle(0x221);
  EXPECT_TRUE(drive->stuck());
  EXPECT_TRUE(drive->status().error);
  EXPECT_EQ(drive->status().errorId, own_error::kPower);
}

TEST_F(Drive, SwitchesOf60FD) {
  plan(5);
  wish.inputs = true;
  config.inputsInverted = 0b010; // of the positive limit
  make();
  for (unsigned inputs = 0; inputs < 8; ++inputs) {
    signals.set(Signal::Inputs, inputs | 0xFFFF0000U);
    cycle(0x240);
    EXPECT_EQ(drive->status().limitNegative, (inputs & 1U) != 0);
    EXPECT_EQ(drive->status().limitPositive, (inputs & 2U) == 0);
    EXPECT_EQ(drive->status().homeSwitch, (inputs & 4U) != 0);
  }
}

TEST_F(Drive, WithoutInputsThereAreNoSwitches) {
  plan(4);
  config.inputsInverted = 7;
  make();
  cycle(0x240);
  EXPECT_FALSE(drive->status().limitNegative || drive->status().limitPositive ||
               drive->status().homeSwitch);
}

TEST_F(Drive, QuickStopIsKept) {
  plan(4);
  make();
  enable();
  drive->quickStop();
  cycle(kEnabledWord);
  EXPECT_EQ(told(Signal::Controlword), 0x02U);
  signals.set(Signal::Position, 1000);
  cycle(0x207);
  EXPECT_FALSE(drive->atRest());
  EXPECT_FALSE(drive->status().driveStarted);
  for (int i = 0; i < 6; ++i) {
    cycle(0x207);
    EXPECT_EQ(told(Signal::Controlword), 0x02U);
  }
  EXPECT_TRUE(drive->atRest());
  cycle(0x240);
  EXPECT_EQ(told(Signal::Controlword), 0U) << "never on again";
}

TEST_F(Drive, ReportsAVelocityInAnotherUnitOnce) {
  plan(5);
  make();
  enable();
  int said = 0;
  for (int i = 1; i <= 300; ++i) {
    signals.set(Signal::Position, static_cast<uint32_t>(i * 50));
    signals.setNumber(Signal::Velocity, 3000); // rpm instead of 50000 inc/s
    cycle(kEnabledWord);
    said += drive->velocityDoubtful() ? 1 : 0;
    EXPECT_TRUE(said == 0 || i >= 100);
  }
  EXPECT_EQ(said, 1);
}

TEST_F(Drive, AVelocityInTheRightUnitIsNotDoubtful) {
  plan(5);
  config.velocityScale = 50000.0 / 3000;
  make();
  enable();
  for (int i = 1; i <= 300; ++i) {
    signals.set(Signal::Position, static_cast<uint32_t>(-i * 50));
    signals.setNumber(Signal::Velocity, i < 50 ? -1600 : -3000);
    cycle(kEnabledWord);
    EXPECT_FALSE(drive->velocityDoubtful());
  }
}

} // namespace
} // namespace stride::can
