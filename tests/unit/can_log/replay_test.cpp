// A run is recorded, and the recording replayed: the same frames are received in the same cycles.
#include "drivers/can/log/recorder.hpp"
#include "drivers/can/log/replay_port.hpp"
#include "drivers/can/simulation/drive402.hpp"
#include "drivers/can/simulation/simulated_bus.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace stride::can::log {
namespace {

/// What it sends depends on everything that it has received, and in which cycle.
class Master {
public:
  explicit Master(unsigned flaw = 0) : flaw_(flaw) {}

  void cycle(Port &port) {
    ++cycles_;
    port.beginCycle();
    send(port, 0x080, {});
    std::array<Received, 16> frames;
    const size_t count = port.receive(frames);
    for (size_t i = 0; i < count; ++i) {
      const Frame &frame = frames[i].frame;
      for (size_t k = 0; k < frame.length; ++k)
        seen_ = seen_ * 31 + frame.data[k];
      seen_ = seen_ * 31 + frame.id + cycles_;
    }
    if (cycles_ == 30)
      send(port, 0x000, {1, 7});
    if (cycles_ == flaw_)
      ++seen_;
    if (cycles_ > 30)
      send(port, 0x207, {cycles_ < 40 ? 0x06U : cycles_ < 50 ? 0x07U : 0x0FU, seen_ & 0x70U});
    if (cycles_ % 7 == 0)
      send(port, 0x607, {0x40, 0x64, 0x60, 0, 0, 0, 0, seen_ & 0xFFU});
  }

private:
  static void send(Port &port, uint16_t id, std::initializer_list<unsigned> bytes) {
    Frame frame;
    frame.id = id;
    for (const unsigned byte : bytes)
      frame.data[frame.length++] = static_cast<uint8_t>(byte);
    port.send(frame, SendClass::Process);
  }

  unsigned flaw_;
  unsigned cycles_ = 0;
  unsigned seen_ = 0;
};

std::string record(bool directions) {
  simulation::SimulatedBus bus(simulation::BusSetup{});
  const simulation::Station station = bus.addPort();
  simulation::Drive402Setup setup;
  setup.node.id = 7;
  setup.drive.mechanics.cycle = 0.001;
  simulation::SimulatedDrive402 drive(setup);
  bus.attach(drive);
  Recorder recorder(10'000);
  RecordedPort port(bus.port(station), recorder, 1'000'000);
  Master master;
  for (int i = 0; i < 200; ++i)
    master.cycle(port);
  std::string text;
  Entry entry;
  while (recorder.take(entry)) {
    if (!directions)
      entry.direction = Direction::Unknown;
    std::array<char, kLongestLine> line{};
    text.append(line.data(), formatLine(entry, "can0", line.data(), line.size()));
  }
  EXPECT_EQ(recorder.lost(), 0U);
  return text;
}

TEST(CanReplay, TheSameMasterSendsTheSame) {
  for (const bool directions : {true, false}) {
    const Recording recording = readRecording(record(directions));
    EXPECT_GT(recording.entries.size(), 400U);
    ReplayPort port(recording, {});
    Master master;
    int cycles = 0;
    for (; !port.done() && cycles < 1000; ++cycles)
      master.cycle(port);
    EXPECT_EQ(cycles, 200);
    const ReplayResult result = port.result();
    EXPECT_EQ(result.different, 0U) << result.first.line << " in cycle " << result.first.cycle;
    EXPECT_EQ(result.left, 0U);
    EXPECT_GT(result.matched, 350U);
  }
}

TEST(CanReplay, AnotherMasterIsFound) {
  const Recording recording = readRecording(record(true));
  ReplayPort port(recording, {});
  Master master(120);
  for (int i = 0; i < 200; ++i)
    master.cycle(port);
  const ReplayResult result = port.result();
  EXPECT_GT(result.different, 10U);
  EXPECT_GE(result.first.cycle, 120U);
  EXPECT_LE(result.first.cycle, 124U) << "or soon after it: two bits of many are sent at once";
  EXPECT_NE(result.first.line, 0U);
  EXPECT_NE(result.first.expected, result.first.sent);
  EXPECT_EQ(result.first.expected.id, result.first.sent.id);
}

TEST(CanReplay, WhatIsNotSentIsLeft) {
  const Recording recording = readRecording(record(true));
  ReplayPort port(recording, {});
  for (int i = 0; i < 10; ++i)
    port.beginCycle();
  EXPECT_GT(port.result().left, 300U);
  Frame strange;
  strange.id = 0x123;
  port.send(strange, SendClass::Service);
  EXPECT_EQ(port.result().different, 1U);
  EXPECT_EQ(port.result().first.sent, strange);
}

TEST(CanReplay, AnEmptyRecordingIsDoneAtOnce) {
  ReplayPort port(readRecording(""), {});
  EXPECT_TRUE(port.done());
  std::array<Received, 4> frames;
  EXPECT_EQ(port.receive(frames), 0U);
}

TEST(CanReplay, MastersAreKnownByTheirIdentifiers) {
  const ReplaySetup setup{.masterId = 126};
  const auto sent = [&](uint16_t id, bool remote = false) {
    Frame frame;
    frame.id = id;
    frame.remote = remote;
    return sentByMaster(frame, setup);
  };
  for (const int id : {0x000, 0x080, 0x100, 0x205, 0x37F, 0x405, 0x505, 0x605, 0x77E, 0x7E5})
    EXPECT_TRUE(sent(static_cast<uint16_t>(id))) << id;
  for (const int id : {0x081, 0x0FF, 0x181, 0x285, 0x385, 0x485, 0x585, 0x705, 0x7E4})
    EXPECT_FALSE(sent(static_cast<uint16_t>(id))) << id;
  EXPECT_TRUE(sent(0x705, true)) << "a guard";
}

} // namespace
} // namespace stride::can::log
