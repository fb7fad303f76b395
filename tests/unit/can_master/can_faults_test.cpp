// Each fault of the bus and of a node, and what the axes are told.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::can {
namespace {

using CanBus = test::CanBusTest;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// Section 9 of the design: node silent.
TEST_F(CanBus, ANodeWithoutPdosIsSilentAfterThreeCycles) {
  addDrive(3);
  addDrive(4);
  start();
  enable(0);
  nodes[0].atSync.clear();
  cycles(2);
  EXPECT_TRUE(communicates(0));
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_TRUE(communicates(1)) << "the others go on";
  EXPECT_TRUE(host.heard("node 3 is silent: no PDO for 3 cycles"));
  port->takeSent();
  cycles(2);
  EXPECT_THAT(port->takeSent(), Contains(HasSubstr("203#0700"))) << "if it hears, it goes off";
  shows(0, 0x227, 1000);
  cycles(2);
  EXPECT_TRUE(communicates(0));
  EXPECT_TRUE(host.heard("node 3 answers again"));
  port->takeSent();
  cycles(3);
  EXPECT_THAT(port->takeSent(), Not(Contains(HasSubstr("203#0F00"))));
  shows(0, 0x223, 1000);
  cycles(3);
  EXPECT_THAT(port->takeSent(), Not(Contains(HasSubstr("203#0F00"))));
  commands[0].errorAckn = true;
  cycles(2);
  EXPECT_THAT(port->takeSent(), Contains(HasSubstr("203#0F00"))) << "after MC_Reset";
}

/// It was told to switch off and does so with a ramp, in which it shows "operation enabled" and
/// goes where it likes.
TEST_F(CanBus, ALostDriveThatStillBrakesHasNoPower) {
  addDrive(3);
  start();
  enable(0);
  nodes[0].atSync.clear();
  cycles(4);
  shows(0, 0x227, 1100);
  cycles(2);
  EXPECT_TRUE(communicates(0));
  EXPECT_FALSE(driver->status(0).driveStarted || driver->status(0).regulatorOn);
  commands[0].errorAckn = true; // MC_Reset, too early
  cycle();
  commands[0].errorAckn = false;
  port->takeSent();
  shows(0, 0x227, 1200);
  cycles(3);
  EXPECT_THAT(port->takeSent(), Not(Contains(HasSubstr("203#0F00"))));
  shows(0, 0x223, 1300);
  cycles(2);
  EXPECT_THAT(port->takeSent(), Contains("203#0F0014050000")) << "from where it stands";
}

/// It may not have heard that it shall be off.
TEST_F(CanBus, ToADriveThatIsNotHeardControlwordsAreRepeated) {
  addDrive(3, 5);
  nodes[0].pdosInOperation = {"183#B80B000000000000", "283#400208"};
  start();
  port->takeSent();
  cycles(5);
  EXPECT_THAT(port->takeSent(), Not(Contains(HasSubstr("303#"))));
  nodes[0].atSync.clear();
  for (int i = 0; i < 6; ++i) {
    cycle();
    EXPECT_THAT(port->takeSent(), Contains("303#000008")) << i;
  }
}

TEST_F(CanBus, AfterABusOffControlwordsAreRepeated) {
  addDrive(3, 5);
  nodes[0].pdosInOperation = {"183#B80B000000000000", "283#400208"};
  start();
  port->controller = ControllerState::BusOff; // with what was in its queue
  cycle();
  port->controller = ControllerState::Active;
  port->takeSent();
  cycle();
  EXPECT_THAT(port->takeSent(), Contains("303#000008"));
}

TEST_F(CanBus, PdoTimeoutIsConfigured) {
  addDrive(3).add({"pdo_timeout", "", 10});
  start();
  nodes[0].atSync.clear();
  cycles(9);
  EXPECT_TRUE(communicates(0));
  cycle();
  EXPECT_FALSE(communicates(0));
}

TEST_F(CanBus, ANodeWithoutHeartbeatIsSilent) {
  addDrive(3);
  start();
  heartbeats = false;
  int alive = 0;
  for (; alive < 300 && communicates(0); ++alive)
    cycle();
  EXPECT_LE(alive, 151);
  EXPECT_GT(alive, 90);
  EXPECT_TRUE(host.heard("node 3 is silent: no heartbeat"));
}

// Drive fault.
TEST_F(CanBus, ADriveFaultHasItsNumberAndText) {
  addDrive(3);
  start();
  enable(0);
  nodes[0].values[0x603F00] = {2, 0x8611};
  nodes[0].say(0x080, "1086810000000000");
  shows(0, 0x208, 1000);
  cycles(2);
  EXPECT_TRUE(driver->status(0).error);
  EXPECT_TRUE(communicates(0));
  EXPECT_TRUE(host.heard("following error"));
  cycles(10);
  EXPECT_EQ(driver->status(0).errorId, 0x8611);
  nodes[0].say(0x080, "0000000000000000");
  cycles(2);
  EXPECT_TRUE(host.heard("its error has gone"));
}

TEST_F(CanBus, AFaultWithoutEmcyIsAskedFor) {
  addDrive(3);
  start();
  enable(0);
  nodes[0].values[0x603F00] = {2, 0x3210};
  shows(0, 0x208, 1000);
  cycles(5);
  EXPECT_EQ(driver->status(0).errorId, 0x3210);
  EXPECT_TRUE(host.heard("node 3 has a fault: overvoltage of the DC link (603Fh = 16#3210)"));
  EXPECT_FALSE(host.heard("fault")) << "once";
}

TEST_F(CanBus, AnEmcyWarnsOnly) {
  addDrive(3);
  start();
  enable(0);
  nodes[0].say(0x080, "1081110000000000");
  cycles(2);
  EXPECT_FALSE(driver->status(0).error);
  EXPECT_TRUE(driver->status(0).driveStarted);
  EXPECT_TRUE(host.heard("node 3 warns: the node has lost CAN frames"));
}

// Drive reset in operation.
TEST_F(CanBus, ADriveThatRestartsIsLostUntilItsReset) {
  addDrive(3);
  addDrive(4);
  start();
  enable(0);
  nodes[0].say(0x700, "00");
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_TRUE(communicates(1));
  EXPECT_TRUE(host.heard("node 3 has restarted in operation"));
  nodes[0].say(0x700, "05"); // whatever it says now
  cycles(50);
  EXPECT_FALSE(communicates(0));
  EXPECT_THAT(port->takeSent(), Not(Contains(HasSubstr("203#0F00"))));
  driver->reset(0);
  started[0] = false;
  commands[0] = {};
  shows(0, 0x240, 5);
  start();
  EXPECT_TRUE(communicates(0));
}

TEST_F(CanBus, ADriveThatLeavesOperationIsLost) {
  for (const char *state : {"7F", "04"}) {
    nodes.clear();
    setup.drives.clear();
    driver.reset();
    addDrive(3);
    start();
    nodes[0].say(0x700, state);
    cycle();
    EXPECT_FALSE(communicates(0));
    EXPECT_TRUE(host.heard("node 3 has left the state operational"));
  }
}

// PDO of wrong length.
TEST_F(CanBus, ThreePdosOfAnotherLengthAreSilence) {
  addDrive(3);
  start();
  nodes[0].atSync = {"183#4002FFFF"};
  cycles(2);
  EXPECT_TRUE(communicates(0));
  EXPECT_EQ(driver->status(0).position, 3000U) << "nothing is taken of them";
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_TRUE(host.heard("another length"));
  shows(0, 0x240, 3001);
  cycles(2);
  EXPECT_TRUE(communicates(0));
}

// The statusword has a PDO of its own, by event, beside one at SYNC that is as it should be.
TEST_F(CanBus, EachPdoHasItsLength) {
  addDrive(3, 5);
  nodes[0].pdosInOperation = {"183#B80B000000000000", "283#400208"};
  start();
  nodes[0].atSync = {"183#B80B000000000000", "283#4002"};
  cycles(2);
  EXPECT_TRUE(communicates(0));
  cycle();
  EXPECT_FALSE(communicates(0)) << "its statusword is none any more";
  EXPECT_TRUE(host.heard("another length"));
  nodes[0].atSync = {"183#B80B000000000000", "283#400208"};
  cycles(2);
  EXPECT_TRUE(communicates(0));
}

TEST_F(CanBus, ASecondNodeStopsAllInTheCycleInWhichItIsFound) {
  addDrive(3);
  addDrive(4);
  start();
  enable(0);
  enable(1);
  const std::string one = nodes[0].atSync.front();
  nodes[0].atSync = {one, one};
  while (communicates(1)) {
    port->takeSent();
    cycle();
  }
  const std::vector<std::string> sent = port->takeSent();
  EXPECT_THAT(sent, Contains(HasSubstr("204#0700")));
  EXPECT_THAT(sent, Not(Contains(HasSubstr("204#0F00"))));
}

// Duplicate node id.
TEST_F(CanBus, TwoNodesWithOneNumberStopAll) {
  addDrive(3);
  addDrive(4);
  start();
  const std::string one = nodes[0].atSync.front();
  nodes[0].atSync = {one, one};
  cycles(2);
  EXPECT_TRUE(communicates(0)) << "late frames come in pairs, too";
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_FALSE(communicates(1)) << "nobody knows what moves";
  EXPECT_TRUE(host.heard("duplicate node id"));
}

TEST_F(CanBus, LateFramesAreNoSecondNode) {
  addDrive(3);
  start();
  const std::string one = nodes[0].atSync.front();
  for (int i = 0; i < 200; ++i) {
    nodes[0].atSync = {};
    cycle();
    nodes[0].atSync = {one, one};
    cycle();
    ASSERT_TRUE(communicates(0)) << i;
  }
}

// Set values late, queue full.
TEST_F(CanBus, AFullQueueIsAnErrorInTheSecondCycle) {
  addDrive(3);
  addDrive(4);
  start();
  port->result = SendResult::QueueFull;
  port->onlyProcess = true;
  cycle();
  EXPECT_TRUE(communicates(0));
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_TRUE(host.heard("the queue of the interface is full"));
  port->result = SendResult::Sent;
  shows(0, 0x240, 3000);
  cycles(2);
  EXPECT_TRUE(communicates(0)) << "MC_Reset is enough";
}

TEST_F(CanBus, ASingleFullQueueIsCountedOnly) {
  addDrive(3);
  start();
  for (int i = 0; i < 20; ++i) {
    port->result = SendResult::QueueFull;
    cycle();
    port->result = SendResult::Sent;
    cycle();
    EXPECT_TRUE(communicates(0));
  }
  const auto &master = dynamic_cast<CanDriver &>(*driver).master();
  EXPECT_GE(master.counters().sendQueueFull, 20U);
}

TEST_F(CanBus, SetValuesThatAreLateTwiceAreAnError) {
  addDrive(3);
  addDrive(4);
  start();
  for (int i = 0; i < 10; ++i) {
    port->late = 1;
    cycle();
    port->late = 0;
    EXPECT_TRUE(communicates(0));
    cycle();
  }
  port->late = 2;
  cycles(2);
  EXPECT_FALSE(communicates(0) || communicates(1));
  EXPECT_TRUE(host.heard("set values are late"));
  EXPECT_EQ(dynamic_cast<CanDriver &>(*driver).master().counters().setValuesLate, 12U);
  port->late = 0;
  cycle();
  EXPECT_TRUE(communicates(0));
}

TEST_F(CanBus, AnEventPdoThatDidNotGoOutGoesOutLater) {
  addDrive(3, 5);
  nodes[0].pdosInOperation = {"183#B80B000000000000", "283#400208"};
  start();
  commands[0].regulatorOn = true;
  port->result = SendResult::QueueFull;
  cycle();
  port->result = SendResult::Sent;
  cycle();
  EXPECT_THAT(port->takeSent(), Contains("303#060008"));
  cycles(50);
  EXPECT_THAT(port->takeSent(), Not(Contains("303#060008"))) << "only when it changes";
  cycles(60);
  EXPECT_THAT(port->takeSent(), Contains("303#060008")) << "and every 100 ms";
}

// Bus-off, interface down, error-passive.
TEST_F(CanBus, ABusThatIsLostLosesAllDrivesUntilTheirReset) {
  for (const ControllerState state : {ControllerState::BusOff, ControllerState::Down}) {
    nodes.clear();
    setup.drives.clear();
    driver.reset();
    addDrive(3);
    addDrive(4);
    start();
    enable(0);
    port->controller = state;
    cycle();
    EXPECT_FALSE(communicates(0));
    EXPECT_FALSE(communicates(1));
    bus::Message problem;
    driver->problem(problem);
    EXPECT_FALSE(problem.text().empty());
    port->takeSent();
    cycles(3);
    EXPECT_TRUE(port->takeSent().empty()) << "nobody is there";
    port->controller = ControllerState::Active;
    cycles(100);
    EXPECT_TRUE(host.heard("the bus is back"));
    EXPECT_FALSE(communicates(0));
    bus::Message none;
    driver->problem(none);
    EXPECT_TRUE(none.text().empty());
    EXPECT_THAT(port->takeSent(), Not(Contains(HasSubstr("203#0F00"))));
    for (size_t i = 0; i < 2; ++i) {
      driver->reset(i);
      started[i] = false;
      shows(i, 0x240, 7);
      commands[i] = {};
    }
    start();
    EXPECT_TRUE(communicates(0) && communicates(1));
  }
}

// restart-ms is shorter than a cycle, or the cycle was late.
TEST_F(CanBus, ABusOffBetweenTwoCyclesLosesAllDrives) {
  addDrive(3);
  start();
  enable(0);
  port->portCounters.restarts = 1;
  cycle();
  EXPECT_FALSE(communicates(0));
  EXPECT_TRUE(host.heard("node 3 cannot be reached: the bus is off"));
  EXPECT_TRUE(host.heard("the bus is back"));
  cycles(100);
  EXPECT_FALSE(communicates(0)) << "until its reset";
  EXPECT_FALSE(host.heard("the bus is back"));
}

TEST_F(CanBus, AnInterfaceThatIsDownIsSaidAtStartUp) {
  addDrive(3);
  make();
  port->controller = ControllerState::Down;
  driver->executeStart();
  uint16_t progress = 0;
  EXPECT_EQ(driver->init(0, progress, message), bus::StartUp::Failed);
  EXPECT_THAT(std::string(message.text()), HasSubstr("not there or not up"));
}

TEST_F(CanBus, WhyAnInterfaceIsDownIsSaid) {
  addDrive(3);
  start();
  port->controller = ControllerState::Down;
  port->whyDown = "there is no interface 'can7'";
  cycle();
  EXPECT_TRUE(host.heard("there is no interface 'can7'"));
}

TEST_F(CanBus, ErrorPassiveIsNewsOnce) {
  addDrive(3);
  start();
  port->controller = ControllerState::Passive;
  cycles(5);
  EXPECT_TRUE(host.heard("error-passive"));
  EXPECT_FALSE(host.heard("error-passive"));
  EXPECT_TRUE(communicates(0));
  port->controller = ControllerState::Warning;
  cycles(2);
  port->controller = ControllerState::Passive;
  cycles(2);
  EXPECT_TRUE(host.heard("error-passive"));
}

TEST_F(CanBus, DroppedFramesAreNews) {
  addDrive(3);
  start();
  port->portCounters.dropped = 7;
  cycles(2);
  EXPECT_TRUE(host.heard("7 received frames were lost"));
  EXPECT_FALSE(host.heard("received frames were lost"));
}

// A babbling node does not hold up the cycle.
TEST_F(CanBus, MoreFramesThanACycleReads) {
  addDrive(3);
  start();
  for (int i = 0; i < 1000; ++i)
    port->give("7FF#0102030405060708");
  cycle();
  EXPECT_GT(port->toReceive.size(), 900U);
  EXPECT_TRUE(host.heard("more frames than"));
}

/// What others say at the same bus does not make old what the drive says.
TEST_F(CanBus, AFullBusIsReadAsFastAsItComes) {
  setup.cycleSeconds = 0.01;
  addDrive(3);
  start();
  constexpr int kMostInACycle = 10'000 / 47; // bits at 1 Mbit/s, and of the shortest frame
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < kMostInACycle; ++k)
      port->give("7FF#");
    shows(0, 0x240, static_cast<uint32_t>(i));
    cycles(1);
    ASSERT_LE(port->toReceive.size(), 2U) << i;
    ASSERT_EQ(driver->status(0).position, static_cast<uint32_t>(i));
  }
  EXPECT_FALSE(host.heard("more frames than"));
}

TEST_F(CanBus, SomebodyElsesSyncIsNews) {
  addDrive(3);
  start();
  port->give("080#");
  cycle();
  EXPECT_TRUE(host.heard("somebody else gives SYNC"));
}

} // namespace
} // namespace stride::can
