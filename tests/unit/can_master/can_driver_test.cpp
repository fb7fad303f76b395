// Start, cycle, configuration and end of the driver.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::can {
namespace {

using CanBus = test::CanBusTest;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CanBus, StartsAllDrivesTogetherAndSendsOnceForEachSync) {
  addDrive(3);
  addDrive(9);
  addDrive(1);
  start();
  cycle();
  const std::vector<std::string> sent = port->takeSent();
  EXPECT_EQ(sent.front(), "080#") << "SYNC comes first";
  EXPECT_EQ(sent[1], "203#0000"
                     "B80B0000");
  EXPECT_EQ(sent[2], "209#0000"
                     "28230000");
  EXPECT_EQ(sent[3], "201#0000"
                     "E8030000");
  EXPECT_EQ(driver->status(1).position, 9000U);
  EXPECT_EQ(driver->controllerModes(0), 8);
  EXPECT_GT(host.syncs, 10);
}

TEST_F(CanBus, SendsItsHeartbeat) {
  addDrive(3);
  setup.busParameters.add({"heartbeat", "", 0.05});
  start();
  int beats = 0;
  for (int i = 0; i < 500; ++i) {
    cycle();
    for (const std::string &one : port->takeSent())
      beats += one == "77E#05" ? 1 : 0;
  }
  EXPECT_EQ(beats, 10);
}

TEST_F(CanBus, ADriveIsPoweredByWhatItShows) {
  addDrive(3);
  start();
  commands[0].regulatorOn = true;
  cycle();
  EXPECT_THAT(port->takeSent(), Contains(HasSubstr("203#0600")));
  shows(0, 0x221, 3000);
  cycles(2);
  EXPECT_THAT(port->takeSent(), Contains(HasSubstr("203#0700")));
  shows(0, 0x223, 3000);
  cycles(2);
  EXPECT_TRUE(driver->status(0).regulatorOn);
  EXPECT_FALSE(driver->status(0).driveStarted);
  enable(0);
}

// Configuration.
TEST_F(CanBus, NodeIdsThatCannotBe) {
  for (const auto &[id, part] : std::vector<std::pair<uint32_t, std::string>>{
           {0, "1 to 127"}, {128, "1 to 127"}, {70000, "1 to 127"}, {126, "the master's own"}}) {
    nodes.clear();
    setup.drives.clear();
    addDrive(id);
    make();
    driver->executeStart();
    uint16_t progress = 0;
    EXPECT_EQ(driver->init(0, progress, message), bus::StartUp::Failed);
    EXPECT_THAT(std::string(message.text()), HasSubstr(part));
    driver->executeEnd();
  }
  nodes.clear();
  setup.drives.clear();
  addDrive(5);
  addDrive(5);
  make();
  uint16_t progress = 0;
  EXPECT_EQ(driver->init(1, progress, message), bus::StartUp::Failed);
  EXPECT_THAT(std::string(message.text()), HasSubstr("same wDriveId"));
}

TEST_F(CanBus, MoreThanTheBusCanCarryIsNews) {
  for (uint32_t id = 1; id <= 5; ++id)
    addDrive(id);
  make();
  EXPECT_TRUE(host.heard("SYNC and PDOs need 121 % of the cycle: it must have 2000 us"));
}

TEST_F(CanBus, FourDrivesFit) {
  for (uint32_t id = 1; id <= 4; ++id)
    addDrive(id);
  make();
  EXPECT_TRUE(host.news.empty());
}

TEST_F(CanBus, DefaultsOfTheSchema) {
  setup.parameters.add({"ControllerNo", "", 2});
  setup.parameters.add({"BaudRate", "500", 500});
  bus::SetupParameters &drive = setup.addDrive("X", 7).parameters;
  CanSetup can = canSetup(setup);
  EXPECT_EQ(can.interface, "can2");
  EXPECT_EQ(can.bitRate, 500U);
  EXPECT_EQ(can.load.bits, 55U + 270U);
  const NodeConfig &node = can.master.nodes[0];
  EXPECT_EQ(node.drive.power.timeout, 2000U);
  EXPECT_EQ(node.drive.power.resetTime, 1000U);
  EXPECT_EQ(node.drive.brakeRelease, 0U);
  EXPECT_EQ(node.drive.modeTimeout, 500U);
  EXPECT_TRUE(node.drive.homesItself);
  EXPECT_EQ(node.drive.velocityScale, 1);
  EXPECT_EQ(node.pdoTimeout, 3U);
  EXPECT_EQ(node.guard, 0);
  EXPECT_EQ(node.masterNode, 126);
  EXPECT_FALSE(node.plan.carries(Signal::Inputs));
  EXPECT_TRUE(can.master.givesSync);
  drive.add({"bHWLimitEnable", "", 1});
  drive.add({"identity.product", "", 4294967295.0});
  setup.busParameters.add({"interface", "vcan0", 0});
  can = canSetup(setup);
  EXPECT_EQ(can.interface, "vcan0");
  EXPECT_TRUE(can.master.nodes[0].plan.carries(Signal::Inputs)) << "limit switches are used";
  EXPECT_EQ(can.master.nodes[0].identity[1], 0xFFFFFFFFU);
}

// The end of the application.
TEST_F(CanBus, AStandingDriveGoesOffWhenTheApplicationStops) {
  addDrive(3);
  start();
  enable(0);
  driver->applicationStopped();
  EXPECT_FALSE(driver->atRest());
  cycles(12);
  EXPECT_THAT(port->takeSent(), Contains(HasSubstr("203#0700")));
  EXPECT_FALSE(driver->atRest());
  shows(0, 0x221, 1000);
  cycles(8);
  EXPECT_TRUE(driver->atRest());
}

TEST_F(CanBus, ADriveThatIsStillMovedAfterASecondStopsByItself) {
  addDrive(3);
  start();
  enable(0);
  driver->applicationStopped();
  for (int i = 0; i < 1100; ++i) {
    commands[0].position += 10;
    shows(0, 0x227, commands[0].position);
    cycle();
    if (i < 990) {
      ASSERT_THAT(port->takeSent(), Not(Contains(HasSubstr("203#0200")))) << i;
    }
  }
  EXPECT_THAT(port->takeSent(), Contains(HasSubstr("203#0200")));
  EXPECT_FALSE(driver->atRest());
  shows(0, 0x207, 77777);
  cycles(10);
  EXPECT_TRUE(driver->atRest());
}

TEST_F(CanBus, ADriveThatNeverComesToRestIsNotWaitedForForever) {
  addDrive(3);
  start();
  enable(0);
  driver->applicationStopped();
  for (int i = 0; i < 3001; ++i) {
    shows(0, 0x227, static_cast<uint32_t>(i * 100));
    cycle();
  }
  EXPECT_TRUE(driver->atRest());
}

} // namespace
} // namespace stride::can
