// Nodes that give SYNC, and how the task waits for it.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::can {
namespace {

using CanBus = test::CanBusTest;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// SYNC of a drive: missed, twice.
TEST_F(CanBus, SyncOfTheFirstDrive) {
  setup.parameters.add({"SyncProducer", "1.Drive", 1});
  addDrive(3);
  addDrive(4);
  make();
  const auto &master = dynamic_cast<CanDriver &>(*driver).master();
  const auto sync = [&](int count) {
    for (int i = 0; i < count; ++i)
      port->give("080#");
    for (const test::ScriptedNode &node : nodes)
      for (const std::string &one : node.atSync)
        if (count > 0)
          port->give(one);
    cycle();
  };
  for (int i = 0; i < 500 && !allStarted(); ++i)
    sync(1);
  ASSERT_TRUE(allStarted()) << message.text();
  EXPECT_THAT(nodes[0].written, Contains("1005:0/4=40000080"));
  EXPECT_THAT(nodes[1].written, Not(Contains(HasSubstr("1005"))));
  EXPECT_THAT(port->takeSent(), Not(Contains("080#")));
  sync(1);
  EXPECT_EQ(master.counters().syncMissed, 0U);
  sync(2);
  EXPECT_EQ(master.counters().syncTwice, 1U);
  sync(0);
  sync(0);
  EXPECT_EQ(master.counters().syncMissed, 2U);
  EXPECT_TRUE(communicates(0) && communicates(1));
  sync(0);
  EXPECT_FALSE(communicates(0));
  EXPECT_FALSE(communicates(1));
  EXPECT_TRUE(host.heard("no SYNC for 3 cycles"));
  sync(1);
  EXPECT_TRUE(communicates(0));
}

TEST_F(CanBus, TheSyncDeviceIsStartedByTheDriver) {
  setup.parameters.add({"SyncProducer", "SYNC device", 2});
  addDrive(3);
  make();
  nodes.emplace_back(inbox, uint8_t{127});
  commands.resize(1);
  for (int i = 0; i < 500 && !allStarted(); ++i) {
    port->give("080#");
    for (const std::string &one : nodes[0].atSync)
      port->give(one);
    cycle();
  }
  EXPECT_TRUE(allStarted()) << message.text();
  EXPECT_THAT(nodes[1].written, ::testing::ElementsAre("1006:0/4=3E8", "1005:0/4=40000080"));
}

TEST_F(CanBus, ASyncDeviceThatIsNotThereIsNews) {
  setup.parameters.add({"SyncProducer", "SYNC device", 2});
  addDrive(3);
  make();
  cycles(3000);
  EXPECT_TRUE(host.heard("SYNC device: node 127"));
  EXPECT_FALSE(host.heard("SYNC device"));
}

TEST_F(CanBus, WaitsForTheSyncOfANode) {
  setup.parameters.add({"SyncProducer", "1.Drive", 1});
  addDrive(3);
  make();
  test::FakeClock clock;
  clock.real = true;
  clock.now = 5000000;
  port->arriving = {test::frame("183#400200000000"), test::frame("080#"), test::frame("080#")};
  bus::SyncWake wake = driver->waitSync(4000000, 6500000, clock);
  EXPECT_TRUE(wake.arrived);
  EXPECT_EQ(wake.missed, 0U);
  EXPECT_EQ(port->arriving.size(), 1U) << "it does not wait for more";
  EXPECT_EQ(port->waited.front(), 6501000);
  port->arriving.clear();
  // Two that have come while the task was in its cycle.
  port->give("080#");
  port->give("080#");
  driver->executeStart();
  port->give("080#");
  port->give("080#");
  wake = driver->waitSync(5000000, 6500000, clock);
  EXPECT_TRUE(wake.arrived);
  EXPECT_EQ(wake.missed, 1U);
  driver->executeStart();
  wake = driver->waitSync(5000000, 6500000, clock);
  EXPECT_FALSE(wake.arrived);
  EXPECT_EQ(wake.timeNs, 6500000);
}

TEST_F(CanBus, VirtualTimeGoesByPeriods) {
  addDrive(3);
  make();
  test::FakeClock clock;
  bus::SyncWake wake = driver->waitSync(-1, 1500000, clock);
  EXPECT_EQ(wake.timeNs, 0);
  EXPECT_TRUE(wake.arrived);
  wake = driver->waitSync(0, 1500000, clock);
  EXPECT_EQ(wake.timeNs, 1000000);
  EXPECT_EQ(clock.now, 1000000);
  clock.now = 4200000; // the task has taken too long
  wake = driver->waitSync(1000000, 2500000, clock);
  EXPECT_EQ(wake.missed, 2U);
  EXPECT_EQ(wake.timeNs, 4000000);
}

} // namespace
} // namespace stride::can
