// Words and values of one drive in operation.
#include "drivers/sercos/master/drive_axis.hpp"

#include "tests/unit/sercos_master/scripted_ring.hpp"

#include <gtest/gtest.h>

namespace stride::sercos::test {
namespace {

class DriveAxisTest : public testing::Test {
protected:
  DriveAxisTest() {
    CyclicWish wish;
    wish.controlType = 0;
    wish.send = {1100, 1110, 1160};
    wish.receive = {1101, 1111, 1161};
    std::vector<std::string> errors;
    config.settings.cyclic = planCyclic(wish, errors);
    config.torqueRated = 8;
    config.powerTimeout = 5;
    config.modeTimeout = 4;
    config.probeInputs = 15;
    facts.position = 0x8A;
    facts.turn = facts.modulo = 1000;
    facts.velocity = 0x0A; // own, per minute: 6 turns/min are 100 increments/s
    facts.velocityFactor = 6;
  }
  void begin() {
    axis = std::make_unique<DriveAxis>(config);
    axis->begin(facts, 0, at());
  }
  Bytes at() const {
    Bytes bytes = words({status, 0});
    for (const Bytes &part : {dword(position), dword(velocity), word(torque)})
      bytes.insert(bytes.end(), part.begin(), part.end());
    return bytes;
  }
  /// The control word after a cycle.
  uint16_t cycle() {
    axis->read(at());
    axis->command(command);
    Bytes record(14);
    axis->write(record);
    told = static_cast<uint32_t>(record[4] | record[5] << 8 | record[6] << 16 |
                                 static_cast<uint32_t>(record[7]) << 24);
    toldVelocity = static_cast<int32_t>(record[8] | record[9] << 8 | record[10] << 16 |
                                        static_cast<uint32_t>(record[11]) << 24);
    toldTorque = static_cast<int16_t>(record[12] | record[13] << 8);
    return static_cast<uint16_t>(record[0] | record[1] << 8);
  }
  void run() {
    command.regulatorOn = command.driveStart = true;
    status = 0xC008;
    cycle();
    cycle();
  }

  DriveConfig config;
  ScalingFacts facts;
  std::unique_ptr<DriveAxis> axis;
  bus::DriveCommand command;
  uint16_t status = 0x4000;
  uint32_t position = 990;
  uint32_t velocity = 0;
  uint16_t torque = 0;
  uint32_t told = 0;
  int32_t toldVelocity = 0;
  int16_t toldTorque = 0;
};

TEST_F(DriveAxisTest, PowerNeedsTheMainPower) {
  begin();
  command.regulatorOn = command.driveStart = true;
  EXPECT_EQ(cycle() & 0xE000, 0); // 01: logic only
  status = 0x8000;
  EXPECT_EQ(cycle() & 0xE000, 0xE000);
  EXPECT_FALSE(axis->status().regulatorOn);
  status = 0xC000;
  cycle();
  EXPECT_FALSE(axis->status().regulatorOn); // both at once
  status = 0xC008;
  cycle();
  cycle();
  EXPECT_TRUE(axis->status().regulatorOn);
  EXPECT_TRUE(axis->status().driveStarted);
  command.driveStart = false;
  EXPECT_EQ(cycle() & 0xE000, 0xC000); // halt under torque
  cycle();
  EXPECT_TRUE(axis->status().regulatorOn);
  EXPECT_FALSE(axis->status().driveStarted);
  command.regulatorOn = false;
  EXPECT_EQ(cycle() & 0xE000, 0);
}

TEST_F(DriveAxisTest, IpoSyncTurnsWithEachCycle) {
  begin();
  const uint16_t first = cycle();
  const uint16_t second = cycle();
  EXPECT_EQ((first ^ second) & 0x0400, 0x0400);
}

TEST_F(DriveAxisTest, PowerThatDoesNotComeIsAnError) {
  begin();
  command.regulatorOn = command.driveStart = true;
  status = 0x8000;
  for (int i = 0; i < 4; ++i)
    cycle();
  cycle();
  cycle();
  EXPECT_TRUE(axis->status().error);
  EXPECT_EQ(axis->status().errorId, 0xFFFF);
  EXPECT_EQ(cycle() & 0xE000, 0);
  command.errorAckn = true;
  EXPECT_EQ(cycle() & 0xE000, 0xE000);
  command.errorAckn = false;
  cycle();
  EXPECT_FALSE(axis->status().error);
}

TEST_F(DriveAxisTest, PositionsGoRound) {
  begin();
  EXPECT_EQ(axis->status().position, 990U);
  run();
  position = 5;
  command.position = 1025;
  cycle();
  EXPECT_EQ(axis->status().position, 1005U);
  EXPECT_EQ(told, 25U);
}

TEST_F(DriveAxisTest, WithoutTorqueItIsToldWhereItIs) {
  begin();
  command.position = 500;
  position = 700;
  cycle();
  EXPECT_EQ(told, 700U);
  EXPECT_EQ(toldVelocity, 0);
}

TEST_F(DriveAxisTest, ValuesInTheDrivesUnits) {
  begin();
  velocity = static_cast<uint32_t>(-3);
  torque = static_cast<uint16_t>(-250);
  command.velocity = 1249;
  run();
  EXPECT_NEAR(axis->status().velocity, -300, 1e-9);
  EXPECT_NEAR(axis->status().torque, -2, 1e-9);
  EXPECT_EQ(toldVelocity, 12);
  EXPECT_EQ(toldTorque, -250); // what it has, until torques are regulated
}

TEST_F(DriveAxisTest, ChangesModes) {
  begin();
  EXPECT_EQ(axis->controllerModes(), 1 << 1 | 1 << 2 | 1 << 3);
  run();
  EXPECT_EQ(axis->status().controllerMode, 3);
  command.controllerMode = 1; // S-0-0034
  command.torque = 1.6;
  EXPECT_EQ(cycle() & 0x0B00, 0x0200);
  EXPECT_EQ(axis->status().controllerMode, 3);
  status = 0xC208;
  cycle();
  EXPECT_EQ(axis->status().controllerMode, 1);
  EXPECT_EQ(toldTorque, 200);
  command.controllerMode = 2;
  for (int i = 0; i < 6; ++i) // it does not take it
    cycle();
  EXPECT_EQ(cycle() & 0x0B00, 0x0200);
}

TEST_F(DriveAxisTest, HomesByItsCommand) {
  begin();
  run();
  command.homing = true;
  cycle();
  cycle();
  EXPECT_EQ(axis->status().homing, bus::Homing::Running);
  const ServiceWish start = axis->wish();
  EXPECT_EQ(start, (ServiceWish{ServiceWish::Kind::Write, 148, 3}));
  axis->answered(start, {true});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::State, 148}));
  axis->answered(axis->wish(), {true, 7});
  EXPECT_EQ(axis->wish().kind, ServiceWish::Kind::State); // still running
  axis->answered(axis->wish(), {true, 3});
  EXPECT_EQ(axis->wish().idn, 52);
  axis->answered(axis->wish(), {true, 125});
  EXPECT_EQ(axis->wish().idn, 150);
  axis->answered(axis->wish(), {false});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 148, 0}));
  position = 100; // it knows where it is now
  axis->answered(axis->wish(), {true});
  cycle();
  EXPECT_EQ(axis->status().homing, bus::Homing::Found);
  EXPECT_EQ(axis->status().homePosition, 1125U); // 100 is 1100 now: it went the shorter way
  command.homing = false;
  cycle();
  cycle();
  EXPECT_EQ(axis->status().homing, bus::Homing::None);
}

/// A procedure command stays until it is cancelled: whoever gives the run up after its end must
/// cancel it as well, or the next one would not begin.
TEST_F(DriveAxisTest, AHomingThatIsGivenUpAtItsEndIsCancelled) {
  for (const int answers : {2, 3}) { // while S-0-0052, or S-0-0150, is read
    begin();
    run();
    command.homing = true;
    cycle();
    for (int i = 0; i < answers; ++i) {
      const ServiceWish wish = axis->wish();
      ASSERT_NE(wish.kind, ServiceWish::Kind::None);
      axis->answered(wish, {true, wish.kind == ServiceWish::Kind::State ? 3 : 0});
      cycle();
    }
    EXPECT_EQ(axis->wish().idn, answers == 2 ? idns::kReferenceDistance1 : idns::kReferenceOffset1);
    command.homing = false;
    cycle();
    const ServiceWish wish = axis->wish();
    EXPECT_EQ(wish.kind, ServiceWish::Kind::Write);
    EXPECT_EQ(wish.idn, idns::kDriveHoming);
    EXPECT_EQ(wish.value, command::kCancel);
    axis->answered(wish, {true, 0});
    cycle();
    EXPECT_EQ(axis->wish().kind, ServiceWish::Kind::None);
    EXPECT_EQ(axis->status().homing, bus::Homing::None);
  }
}

TEST_F(DriveAxisTest, AHomingThatFailsIsCleared) {
  begin();
  run();
  command.homing = true;
  cycle();
  axis->answered(axis->wish(), {true});
  axis->answered(axis->wish(), {true, 15});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 148, 0}));
  axis->answered(axis->wish(), {true});
  cycle();
  EXPECT_EQ(axis->status().homing, bus::Homing::Failed);
}

TEST_F(DriveAxisTest, ProbesAreEnabledReadAndArmedAnew) {
  begin();
  command.capture = 4; // the positive edge of probe 2
  cycle();
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 169, 15}));
  axis->answered(axis->wish(), {true});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 170, 3}));
  axis->answered(axis->wish(), {true});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 406, 1}));
  axis->answered(axis->wish(), {true});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Read, 179}));
  axis->answered(axis->wish(), {true, 8}); // another edge
  EXPECT_EQ(axis->wish().idn, 179);
  axis->answered(axis->wish(), {true, 4});
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Read, 132}));
  axis->answered(axis->wish(), {true, 977});
  cycle();
  EXPECT_EQ(axis->status().captured, 4);
  EXPECT_EQ(axis->status().capturedPosition[2], 977U);
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 406, 0}));
  axis->answered(axis->wish(), {true});
  EXPECT_EQ(axis->wish().kind, ServiceWish::Kind::None);
  command.capture = 0;
  cycle();
  command.capture = 4;
  cycle();
  cycle();
  EXPECT_EQ(axis->status().captured, 0);
  EXPECT_EQ(axis->wish(), (ServiceWish{ServiceWish::Kind::Write, 406, 1}));
}

TEST_F(DriveAxisTest, HomeSwitchIsTheFirstRealTimeBit) {
  begin();
  cycle();
  EXPECT_FALSE(axis->status().homeSwitch);
  status = 0x4040;
  cycle();
  EXPECT_TRUE(axis->status().homeSwitch);
}

} // namespace
} // namespace stride::sercos::test
