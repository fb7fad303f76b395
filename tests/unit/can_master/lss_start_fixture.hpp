// A drive that has its number and one that gets its own by LSS, on a bus of lists.
#ifndef STRIDE_TESTS_UNIT_CAN_MASTER_LSS_START_FIXTURE_HPP
#define STRIDE_TESTS_UNIT_CAN_MASTER_LSS_START_FIXTURE_HPP

#include "drivers/can/master/master.hpp"
#include "tests/unit/can_master/fake_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace stride::can {

/// The master with two nodes, the second one by LSS.
class LssStartOf : public ::testing::Test {
protected:
  LssStartOf() : masterConfig() {
    for (const uint8_t number : {uint8_t{5}, uint8_t{9}}) {
      NodeConfig config;
      DriveWish wish;
      wish.node = number;
      wish.controlType = 4;
      config.plan = planDrive(wish).plan;
      config.kind = NodeConfig::Kind::Drive;
      masterConfig.nodes.push_back(config);
    }
    masterConfig.sdoPerCycle = 4;
    NodeConfig &late = masterConfig.nodes[1];
    late.identity = {0x77, 0x22, 0x33, 0x44};
    late.lss.wanted = true;
    second.values[0x101801] = {4, 0x77};
    second.values[0x101802] = {4, 0x22};
    second.values[0x101803] = {4, 0x33};
    second.values[0x101804] = {4, 0x44};
    first.pdosInOperation = {"185#400203010000"};
    second.pdosInOperation = {"189#400204010000"};
    second.answers = second.boots = false;
  }
  void make() {
    auto owned = std::make_unique<test::FakePort>();
    port = owned.get();
    port->heard = [this](const Frame &frame) {
      sent.push_back(test::text(frame));
      resetsTooEarly = resetsTooEarly || (test::text(frame) == "000#8209" && bootsIn > 0);
      hearLss(frame);
      first.hear(frame);
      if (second.answers)
        second.hear(frame);
      while (!inbox.toReceive.empty()) {
        port->toReceive.push_back(inbox.toReceive.front());
        inbox.toReceive.pop_front();
      }
    };
    master = std::make_unique<Master>(masterConfig, std::move(owned));
    master->attach(host);
  }
  /// The second node as far as LSS goes.
  void hearLss(const Frame &frame) {
    if (frame.id == 0 && frame.data[0] == 0x82 && frame.data[1] == before && !second.answers) {
      if (bootTime > 0)
        bootsIn = bootTime;
      else
        begin();
      return;
    }
    if (frame.id != lss::kRequestId || !hasLss)
      return;
    switch (frame.data[0]) {
    case 0x43:
      if (frame.data[1] != 0x44)
        break;
      inbox.give("7E4#4400000000000000");
      break;
    case 0x5E: {
      char text[32];
      std::snprintf(text, sizeof text, "7E4#5E%02X000000000000", before);
      inbox.give(text);
      break;
    }
    case 0x11:
      inbox.give(refuses ? "7E4#1101000000000000" : "7E4#1100000000000000");
      set = !refuses;
      break;
    case 0x13:
      inbox.give("7E4#1300000000000000");
      break;
    case 0x17:
      inbox.give(stores ? "7E4#1700000000000000" : "7E4#1701000000000000");
      break;
    case 0x04:
      if (set && before == lss::kNoNode)
        begin();
      break;
    default:
      break;
    }
  }
  void begin() {
    set = false;
    second.answers = second.boots = true;
    second.say(0x700, "00");
    ++boots;
  }
  bus::StartUp cycle(size_t index = 1) {
    master->executeStart();
    uint16_t progress = 0;
    bus::StartUp result = bus::StartUp::Busy;
    if (bootsIn > 0 && --bootsIn == 0)
      begin();
    for (const size_t i : {size_t{0}, index}) {
      bus::Message text;
      const bus::StartUp one = i == 0 && !startsFirst
                                   ? bus::StartUp::Busy
                                   : master->node(i).init(progress, text, master->news());
      if (i == index) {
        result = one;
        message = text.text();
      }
    }
    if (++heartbeats % 50 == 0)
      for (test::ScriptedNode *node : {&first, &second})
        if (node->answers)
          node->say(0x700, node->state);
    while (!inbox.toReceive.empty()) {
      port->toReceive.push_back(inbox.toReceive.front());
      inbox.toReceive.pop_front();
    }
    master->executeEnd();
    return result;
  }
  bus::StartUp run(size_t index = 1) {
    if (!master)
      make();
    bus::StartUp result = bus::StartUp::Busy;
    for (cycles = 0; result == bus::StartUp::Busy && cycles < 8000; ++cycles)
      result = cycle(index);
    return result;
  }
  ptrdiff_t place(const std::string &text) const {
    return std::find(sent.begin(), sent.end(), text) - sent.begin();
  }

  MasterConfig masterConfig;
  test::FakePort inbox;
  test::ScriptedNode first{inbox, 5};
  test::ScriptedNode second{inbox, 9};
  test::FakePort *port = nullptr;
  test::FakeHost host;
  std::unique_ptr<Master> master;
  std::vector<std::string> sent;
  std::string message;
  uint8_t before = lss::kNoNode;
  bool hasLss = true;
  bool refuses = false;
  bool set = false;
  bool startsFirst = true;
  bool stores = true;
  bool resetsTooEarly = false;
  int bootTime = 0; ///< [cycles]
  int bootsIn = 0;
  int boots = 0;
  int heartbeats = 0;
  int cycles = 0;
};

} // namespace stride::can

#endif
