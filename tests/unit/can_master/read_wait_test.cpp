// Cycles that wait for what drives say at their SYNC (read_wait).
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-matchers.h>

namespace stride::can {
namespace {

class ReadWaitOf : public test::CanBusTest {
protected:
  ReadWaitOf() {
    addDrive(5);
    addDrive(9);
    setup.kind = bus::BusKind::Real;
    setup.busParameters.add({"read_wait", "", 0.0004});
  }
  void begin() {
    ASSERT_NO_FATAL_FAILURE(start());
    cycles(100);
    port->clock = 7'000'000;
    port->waited.clear();
    for (test::ScriptedNode &node : nodes)
      node.atSync.clear(); // from here on they say what the test puts there
    inbox.toReceive.clear();
    port->toReceive.clear();
  }
  void arrives(size_t index, uint32_t position) {
    char text[40];
    std::snprintf(text, sizeof text, "%03X#%s", 0x180 + setup.drives[index].id,
                  pdo(0x0240, position).c_str());
    port->arriving.push_back(test::frame(text));
  }
  uint64_t late() const { return static_cast<CanDriver &>(*driver).master().counters().readsLate; }
};

TEST_F(ReadWaitOf, WhatArrivesMeanwhileIsOfThisCycle) {
  begin();
  arrives(1, 4321);
  port->arriving.push_back(test::frame("085#0000000000000000"));
  arrives(0, 1234);
  cycle();
  EXPECT_THAT(port->waited, ::testing::ElementsAre(7'400'000, 7'400'000, 7'400'000));
  EXPECT_EQ(driver->status(0).position, 1234U);
  EXPECT_EQ(driver->status(1).position, 4321U);
  EXPECT_EQ(late(), 0U);
}

/// Else a cycle that has once come too late would take the old values for new ones for ever.
TEST_F(ReadWaitOf, WhatIsThereBeforeSyncIsOfTheOneBefore) {
  begin();
  arrives(0, 10);
  arrives(1, 20);
  port->toReceive = port->arriving;
  port->arriving.clear();
  arrives(0, 11);
  arrives(1, 21);
  cycle();
  EXPECT_EQ(port->waited.size(), 2U);
  EXPECT_EQ(driver->status(0).position, 11U);
  EXPECT_EQ(driver->status(1).position, 21U);
  EXPECT_TRUE(communicates(0)) << "twice in a cycle once";
  EXPECT_EQ(late(), 0U);
}

TEST_F(ReadWaitOf, WhatIsThereRightAfterSyncNeedsNoWait) {
  begin();
  nodes[0].atSync = {"185#40020A000000"};
  nodes[1].atSync = {"189#400214000000"};
  port->heard = [this](const Frame &frame) {
    for (test::ScriptedNode &node : nodes)
      node.hear(frame);
    while (!inbox.toReceive.empty()) {
      port->arriving.push_back(inbox.toReceive.front());
      inbox.toReceive.pop_front();
    }
  };
  cycle();
  EXPECT_EQ(driver->status(0).position, 10U);
  EXPECT_EQ(driver->status(1).position, 20U);
  EXPECT_EQ(late(), 0U);
}

TEST_F(ReadWaitOf, ItsOwnFramesDoNotEndTheWait) {
  begin();
  port->echoes = 3; // SYNC and RPDOs have left the controller
  arrives(0, 7);
  arrives(1, 8);
  cycle();
  EXPECT_EQ(driver->status(0).position, 7U);
  EXPECT_EQ(driver->status(1).position, 8U);
  EXPECT_EQ(late(), 0U);
}

TEST_F(ReadWaitOf, ASilentNodeDelaysItsFirstCyclesOnly) {
  begin();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(communicates(1));
    arrives(0, 100);
    cycle();
  }
  EXPECT_FALSE(communicates(1));
  EXPECT_TRUE(communicates(0));
  EXPECT_EQ(late(), 3U);
  EXPECT_EQ(port->waited.size(), 6U);
  port->waited.clear();
  for (uint32_t i = 0; i < 5; ++i) {
    arrives(0, 200 + i);
    cycle();
    EXPECT_EQ(driver->status(0).position, 200U + i);
  }
  EXPECT_EQ(port->waited.size(), 5U) << "for the other one";
  EXPECT_EQ(late(), 3U);
  EXPECT_TRUE(communicates(0));
}

TEST_F(ReadWaitOf, ABusThatIsLostIsNotWaitedFor) {
  begin();
  port->controller = ControllerState::BusOff;
  cycle();
  EXPECT_TRUE(port->waited.empty());
}

TEST_F(ReadWaitOf, NeitherIsASimulatedBus) {
  setup.kind = bus::BusKind::Simulated;
  begin();
  cycles(3);
  EXPECT_TRUE(port->waited.empty());
}

TEST_F(ReadWaitOf, NorAPortWithoutAClock) {
  begin();
  port->clock = -1;
  cycle();
  EXPECT_TRUE(port->waited.empty());
}

TEST_F(ReadWaitOf, ABabblingNodeEndsTheWait) {
  begin();
  for (int i = 0; i < 1000; ++i)
    port->arriving.push_back(test::frame("7FF#"));
  cycle();
  EXPECT_LT(port->waited.size(), 100U);
  EXPECT_EQ(late(), 1U);
}

TEST(ReadWait, MustLeaveTimeForThePrograms) {
  const auto findings = [](double wait) {
    bus::GroupSetup setup(kSchema, 0.002);
    setup.addDrive("X", 5);
    setup.busParameters.add({"read_wait", "", wait});
    bus::GroupFindings result;
    checkGroup(setup, result);
    return result;
  };
  EXPECT_TRUE(findings(0.0019).empty());
  ASSERT_EQ(findings(0.002).size(), 1U);
  EXPECT_TRUE(findings(0.002)[0].isError);
  EXPECT_EQ(findings(0.0021).size(), 1U);
}

} // namespace
} // namespace stride::can
