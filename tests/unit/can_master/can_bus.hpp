// A driver on a bus that a test writes by hand.
#ifndef STRIDE_TESTS_UNIT_CAN_MASTER_CAN_BUS_HPP
#define STRIDE_TESTS_UNIT_CAN_MASTER_CAN_BUS_HPP

#include "drivers/can/can_driver.hpp"
#include "drivers/can/schema.hpp"
#include "tests/unit/can_master/fake_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace stride::can::test {

/// Time that a test turns on.
class FakeClock final : public bus::BusClock {
public:
  int64_t nowNs() const noexcept override { return now; }
  void sleepUntil(int64_t timeNs) noexcept override { now = std::max(now, timeNs); }
  int64_t monotonicNs(int64_t timeNs) const noexcept override {
    return real ? timeNs + 1000 : std::numeric_limits<int64_t>::max();
  }
  int64_t now = 0;
  bool real = false;
};

/// A drive group with nodes that answer by lists.
class CanBusTest : public ::testing::Test {
protected:
  CanBusTest() : setup(kSchema, 0.001) {}

  bus::SetupParameters &addDrive(uint32_t id, double controlType = 4) {
    bus::SetupParameters &drive = setup.addDrive("X", id).parameters;
    drive.add({"wControlType", "", controlType});
    nodes.emplace_back(inbox, static_cast<uint8_t>(id));
    char text[32];
    std::snprintf(text, sizeof text, "%03X#%s", 0x180 + id, pdo(0x0240, 1000 * id).c_str());
    nodes.back().pdosInOperation = {text};
    return drive;
  }
  static std::string pdo(uint32_t statusword, uint32_t position) {
    char text[32];
    std::snprintf(text, sizeof text, "%02X%02X%02X%02X%02X%02X", statusword & 0xFF,
                  statusword >> 8 & 0xFF, position & 0xFF, position >> 8 & 0xFF,
                  position >> 16 & 0xFF, position >> 24);
    return text;
  }
  /// What the node says at each SYNC from now on.
  void shows(size_t index, uint32_t statusword, uint32_t position) {
    char text[32];
    std::snprintf(text, sizeof text, "%03X#%s", 0x180 + setup.drives[index].id,
                  pdo(statusword, position).c_str());
    nodes[index].pdosInOperation = nodes[index].atSync = {text};
  }
  void make() {
    auto owned = std::make_unique<FakePort>();
    port = owned.get();
    port->heard = [this](const Frame &frame) {
      for (ScriptedNode &node : nodes)
        node.hear(frame);
      deliver();
    };
    driver = std::make_unique<CanDriver>(setup, std::move(owned));
    driver->attach(host);
    commands.resize(nodes.size());
    started.assign(nodes.size(), false);
  }
  void deliver() {
    while (!inbox.toReceive.empty()) {
      port->toReceive.push_back(inbox.toReceive.front());
      inbox.toReceive.pop_front();
    }
  }
  void cycle() {
    deliver();
    driver->executeStart();
    for (size_t i = 0; i < setup.drives.size(); ++i) {
      uint16_t progress = 0;
      if (!started[i] && driver->init(i, progress, message) == bus::StartUp::Started) {
        started[i] = true;
        commands[i].position = driver->status(i).position;
      }
      if (started[i])
        driver->command(i, commands[i]);
    }
    // Heartbeats of nodes that have them.
    if (heartbeats && port->cycles % 50 == 0)
      for (ScriptedNode &node : nodes)
        if (node.answers)
          node.say(0x700, node.state);
    driver->executeEnd();
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i)
      cycle();
  }
  void start() {
    if (!driver)
      make();
    for (int i = 0; i < 3000 && !allStarted(); ++i)
      cycle();
    ASSERT_TRUE(allStarted()) << message.text();
    cycles(5);
    port->takeSent();
    host.news.clear();
  }
  bool allStarted() const {
    return std::all_of(started.begin(), started.end(), [](bool one) { return one; });
  }
  /// Brings a drive into operation: it shows what it is told.
  void enable(size_t index) {
    commands[index].regulatorOn = commands[index].driveStart = true;
    for (const int word : {0x240, 0x221, 0x223, 0x227}) {
      shows(index, static_cast<uint32_t>(word), 1000);
      cycles(2);
    }
    ASSERT_TRUE(driver->status(index).driveStarted);
    port->takeSent();
  }
  bool communicates(size_t index) const { return driver->status(index).communication; }

  bus::GroupSetup setup;
  FakePort inbox; ///< Where nodes put what they say.
  std::vector<ScriptedNode> nodes;
  FakePort *port = nullptr;
  FakeHost host;
  std::unique_ptr<bus::AxisDriver> driver;
  std::vector<bus::DriveCommand> commands;
  std::vector<bool> started;
  bus::Message message;
  bool heartbeats = true;
};

} // namespace stride::can::test

#endif
