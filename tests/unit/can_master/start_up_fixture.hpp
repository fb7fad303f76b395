// A node that is brought into operation, cycle by cycle.
#ifndef STRIDE_TESTS_UNIT_CAN_MASTER_START_UP_FIXTURE_HPP
#define STRIDE_TESTS_UNIT_CAN_MASTER_START_UP_FIXTURE_HPP

#include "drivers/can/master/master.hpp"
#include "tests/unit/can_master/fake_bus.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace stride::can::test {

class StartUpOf : public ::testing::Test {
protected:
  StartUpOf() {
    DriveWish wish;
    wish.node = 5;
    wish.controlType = 4;
    config.plan = planDrive(wish).plan;
    config.pdoTimeout = 3;
    node.pdosInOperation = {"185#400203010000"};
  }

  void make() {
    MasterConfig masterConfig;
    masterConfig.nodes = {config};
    masterConfig.sdoPerCycle = sdoPerCycle;
    masterConfig.givesSync = !config.producesSync;
    auto owned = std::make_unique<FakePort>(); // the node keeps the other one
    owned->heard = [this, raw = owned.get()](const Frame &frame) {
      sent.push_back(test::text(frame));
      node.hear(frame);
      while (!port.toReceive.empty()) {
        raw->toReceive.push_back(port.toReceive.front());
        port.toReceive.pop_front();
      }
    };
    master = std::make_unique<Master>(masterConfig, std::move(owned));
    master->attach(host);
  }

  bus::StartUp cycle() {
    master->executeStart();
    const bus::StartUp result = master->node(0).init(progress, message, master->news());
    seen.push_back(progress);
    master->executeEnd();
    ++cycles;
    return result;
  }

  bus::StartUp run(int most = 8000) {
    if (!master)
      make();
    bus::StartUp result = bus::StartUp::Busy;
    while (result == bus::StartUp::Busy && cycles < most)
      result = cycle();
    return result;
  }
  std::string text() const { return std::string(message.text()); }
  void expectFailure(const std::string &part) {
    EXPECT_EQ(run(), bus::StartUp::Failed);
    EXPECT_THAT(text(), ::testing::HasSubstr(part));
    EXPECT_FALSE(master->node(0).started());
    EXPECT_FALSE(master->node(0).communication());
  }

  NodeConfig config;
  uint32_t sdoPerCycle = 1;
  FakePort port;
  ScriptedNode node{port, 5};
  FakeHost host;
  std::unique_ptr<Master> master;
  bus::Message message;
  std::vector<std::string> sent;
  std::vector<uint16_t> seen;
  uint16_t progress = 0;
  int cycles = 0;
};

} // namespace stride::can::test

#endif
