// Nodes behind a port, as `stride can simulate` has them behind a socket.
#include "tests/unit/can_simulation/drive_scene.hpp"

#include "drivers/can/simulation/io401.hpp"
#include "drivers/can/simulation/node_host.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace stride::can::simulation {
namespace {

/// A port that takes what a test allows.
class StubPort final : public Port {
public:
  void beginCycle() noexcept override {}
  SendResult send(const Frame &frame, SendClass /*sendClass*/) noexcept override {
    if (room == 0)
      return SendResult::QueueFull;
    --room;
    sent.push_back(frame);
    return SendResult::Sent;
  }
  size_t receive(std::span<Received> frames) noexcept override {
    size_t taken = 0;
    for (; taken < frames.size() && !coming.empty(); ++taken) {
      frames[taken].frame = coming.front();
      coming.pop_front();
    }
    return taken;
  }
  [[nodiscard]] ControllerState state() const noexcept override { return now; }
  [[nodiscard]] PortCounters counters() const noexcept override { return {}; }

  size_t room = 1000;
  std::vector<Frame> sent;
  std::deque<Frame> coming;
  ControllerState now = ControllerState::Active;
};

struct HostScene : ::testing::Test {
  HostScene() : drive(plainDrive(5)), io({.node = {.id = 6, .bootNs = 30'000'000}}), host(port) {
    host.add(drive, 0);
    host.add(io, 0);
  }

  StubPort port;
  SimulatedDrive402 drive;
  SimulatedIo401 io;
  NodeHost host;
};

TEST_F(HostScene, NodesBootAndAnswer) {
  EXPECT_LE(host.nextNs(), 20'000'000);
  for (int64_t now = 0; now <= 40'000'000; now += 500'000)
    host.step(now);
  ASSERT_EQ(port.sent.size(), 2U);
  EXPECT_EQ(port.sent[0], frameOf(0x705, {0}));
  EXPECT_EQ(port.sent[1], frameOf(0x706, {0}));
  port.coming = {frameOf(0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
                 frameOf(0x606, {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
                 frameOf(0x605, {0x40, 0x64, 0x60, 0, 0, 0, 0, 0})};
  host.step(41'000'000);
  ASSERT_EQ(port.sent.size(), 5U) << "an answer to each";
  EXPECT_EQ(port.sent[2], frameOf(0x585, {0x43, 0, 0x10, 0, 0x92, 0x01, 0x02, 0x00}));
  EXPECT_EQ(port.sent[4], frameOf(0x585, {0x43, 0x64, 0x60, 0, 0x09, 0x03, 0, 0}));
}

TEST_F(HostScene, WhatAPortHasNoRoomForIsSentLater) {
  port.room = 0;
  for (int64_t now = 0; now <= 40'000'000; now += 1'000'000)
    host.step(now);
  EXPECT_TRUE(port.sent.empty());
  EXPECT_LE(host.nextNs(), 40'200'000) << "soon";
  port.room = 1;
  host.step(40'200'000);
  EXPECT_EQ(port.sent.size(), 1U);
  port.room = 5;
  host.step(40'400'000);
  EXPECT_EQ(port.sent.size(), 2U);
}

TEST_F(HostScene, TheyHearEachOther) {
  for (int64_t now = 0; now <= 40'000'000; now += 1'000'000)
    host.step(now);
  ASSERT_EQ(drive.write(0x1017, 0, 10), Abort::None);
  ASSERT_EQ(io.write(0x1016, 1, 5U << 16U | 25), Abort::None);
  for (int64_t now = 41'000'000; now <= 100'000'000; now += 1'000'000)
    host.step(now);
  EXPECT_EQ(io.objects().value(0x1003), 0U);
  drive.setSilent(true);
  for (int64_t now = 101'000'000; now <= 140'000'000; now += 1'000'000)
    host.step(now);
  EXPECT_EQ(io.objects().value(0x1003, 1), 0x8130U);
}

TEST_F(HostScene, ABusOffIsToldWhenItIsOver) {
  for (int64_t now = 0; now <= 40'000'000; now += 1'000'000)
    host.step(now);
  port.now = ControllerState::BusOff;
  host.step(41'000'000);
  EXPECT_EQ(io.objects().value(0x1003), 0U);
  port.now = ControllerState::Active;
  host.step(42'000'000);
  EXPECT_EQ(io.objects().value(0x1003, 1), 0x8140U);
  EXPECT_EQ(drive.power(), PowerState::Fault);
}

/// A bus that never rests does not keep it for ever.
TEST_F(HostScene, AStepComesToAnEnd) {
  for (int64_t now = 0; now <= 40'000'000; now += 1'000'000)
    host.step(now);
  for (int i = 0; i < 2000; ++i)
    port.coming.push_back(frameOf(0x080));
  host.step(41'000'000);
  EXPECT_GT(port.coming.size(), 1000U);
}

struct BacklogScene : HostScene {
  /// Both with a TPDO at each SYNC: 185h and 186h.
  void operate() {
    int64_t now = 0;
    for (; now <= 40'000'000; now += 1'000'000)
      host.step(now);
    ASSERT_EQ(drive.write(0x1800, 2, 1), Abort::None);
    ASSERT_EQ(drive.write(0x1400, 2, 1), Abort::None);
    ASSERT_EQ(io.write(0x1800, 2, 1), Abort::None);
    port.coming = {frameOf(0, {1, 0})};
    host.step(now);
    ASSERT_EQ(drive.state(), NmtState::Operational);
    port.coming = {frameOf(0x080)};
    host.step(now += 1'000'000);
    port.sent.clear();
  }
  [[nodiscard]] int count(uint16_t id) const {
    return static_cast<int>(std::count_if(port.sent.begin(), port.sent.end(),
                                          [id](const Frame &frame) { return frame.id == id; }));
  }
};

TEST_F(BacklogScene, OfSyncsThatHaveWaitedTheLastOneIsAnswered) {
  operate();
  for (const size_t waiting : {1U, 2U, 3U, 6U, 17U, 200U}) {
    port.coming.assign(waiting, frameOf(0x080));
    host.step(50'000'000);
    EXPECT_EQ(count(0x185), 1) << waiting;
    EXPECT_EQ(count(0x186), 1) << waiting;
    port.sent.clear();
  }
}

/// What has come before an old SYNC counts from the last one on, or has been overwritten.
TEST_F(BacklogScene, WhatElseHasWaitedIsTaken) {
  operate();
  const Frame question = frameOf(0x605, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0});
  port.coming = {frameOf(0x080),
                 question,
                 frameOf(0x205, {0x06, 0}),
                 frameOf(0x080),
                 frameOf(0x205, {0x80, 0}),
                 question};
  host.step(50'000'000);
  EXPECT_EQ(count(0x185), 1);
  EXPECT_EQ(count(0x585), 2) << "each question has its answer";
  EXPECT_EQ(drive.objects().value(0x6040), 0x06U) << "valid with SYNC; the other one is not yet";
  port.coming = {frameOf(0x080)};
  host.step(51'000'000);
  EXPECT_EQ(drive.objects().value(0x6040), 0x80U);
}

/// A node whose SYNC has another identifier has a backlog of its own.
TEST_F(BacklogScene, EachNodeHasItsOwnSync) {
  operate();
  ASSERT_EQ(io.write(0x1005, 0, 0x81), Abort::None);
  port.coming = {frameOf(0x081), frameOf(0x080), frameOf(0x080)};
  host.step(50'000'000);
  EXPECT_EQ(count(0x185), 1);
  EXPECT_EQ(count(0x186), 1);
}

/// The same drive behind a port of the bus: for the master there is no difference but time.
TEST(CanHost, ServesADriveOnABusToItsMaster) {
  Master master;
  const Station guest = master.bus.addPort();
  SimulatedDrive402 drive(plainDrive(5));
  NodeHost host(master.bus.port(guest));
  host.add(drive, 0);
  int64_t now = 0;
  const auto cycle = [&] {
    master.cycle();
    host.step(now += 1'000'000);
  };
  for (int i = 0; i < 30; ++i)
    cycle();
  EXPECT_EQ(master.count(0x705), 1U);
  master.seen.clear();
  master.send(0x605, {0x40, 0, 0x10, 0, 0, 0, 0, 0});
  for (int i = 0; i < 4; ++i)
    cycle();
  EXPECT_EQ(master.count(0x585), 1U);
}

} // namespace
} // namespace stride::can::simulation
