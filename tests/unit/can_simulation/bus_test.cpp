// The bus: time on the wire, who goes first, faults and what follows from them.
#include "tests/unit/can_simulation/bus_scene.hpp"

#include "drivers/can/simulation/wire.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stride::can::simulation {
namespace {

using ::testing::ElementsAre;

std::vector<uint16_t> idsOf(const std::vector<Received> &frames) {
  std::vector<uint16_t> ids;
  for (const Received &received : frames)
    ids.push_back(received.frame.id);
  return ids;
}

struct BusScene : ::testing::Test {
  SimulatedBus bus{BusSetup{}};
  Station master = bus.addPort();
  Puppet one;
  Puppet two;
  Station first = bus.attach(one);
  Station second = bus.attach(two);
};

TEST_F(BusScene, AFrameTakesTheTimeOfItsBits) {
  bus.port(master).beginCycle();
  const Frame frame = frameOf(0x201, {1, 2, 3});
  ASSERT_EQ(bus.port(master).send(frame, SendClass::Process), SendResult::Sent);
  const int64_t end = 1'000'000 + 1000 * (exactBits(frame) - 3);
  bus.runUntil(end - 1);
  EXPECT_TRUE(one.heard.empty());
  bus.runUntil(end);
  ASSERT_EQ(one.heard.size(), 1U);
  EXPECT_EQ(one.heard[0].frame, frame);
  EXPECT_EQ(one.heard[0].timeNs, end);
  EXPECT_EQ(two.heard.size(), 1U);
  EXPECT_TRUE(takeAll(bus.port(master)).empty()) << "nobody hears himself";
}

TEST(CanBus, TheBitRateStretchesTime) {
  for (const uint32_t rate : {125'000U, 500'000U, 800'000U}) {
    SimulatedBus slow(BusSetup{.bitRate = rate});
    const Station port = slow.addPort();
    Puppet listener;
    slow.attach(listener);
    slow.port(port).send(frameOf(0x80), SendClass::Process);
    slow.runUntil(5'000'000);
    ASSERT_EQ(listener.heard.size(), 1U);
    EXPECT_EQ(listener.heard[0].timeNs, (exactBits(frameOf(0x80)) - 3) * (1'000'000'000LL / rate));
  }
}

TEST_F(BusScene, TheSmallestIdentifierGoesFirstAndNobodyIsInterrupted) {
  one.orders = {{1000, frameOf(0x300, {1})}, {1000, frameOf(0x100)}};
  two.orders = {{1000, frameOf(0x200, {2})}, {2000, frameOf(0x081)}};
  bus.runUntil(1'000'000);
  // 200h wins at 1 µs and is not interrupted by 081h; the mailbox of the first is taken by 300h.
  EXPECT_THAT(idsOf(takeAll(bus.port(master))), ElementsAre(0x200, 0x081, 0x300, 0x100));
}

TEST_F(BusScene, ProcessDataOvertakesServicesInTheQueueOfThePort) {
  Port &port = bus.port(master);
  port.send(frameOf(0x601, {1}), SendClass::Service);
  port.send(frameOf(0x602, {2}), SendClass::Service);
  port.send(frameOf(0x201, {3}), SendClass::Process);
  bus.runUntil(1'000'000);
  // The first one is in the mailbox already.
  EXPECT_THAT(idsOf(one.heard), ElementsAre(0x601, 0x201, 0x602));
}

TEST_F(BusScene, AFullQueueSaysSo) {
  Port &port = bus.port(master);
  for (int i = 0; i < 11; ++i) // ten places and the mailbox
    EXPECT_EQ(port.send(frameOf(0x201), SendClass::Process), SendResult::Sent);
  EXPECT_EQ(port.send(frameOf(0x201), SendClass::Process), SendResult::QueueFull);
  bus.runUntil(100'000);
  EXPECT_EQ(port.send(frameOf(0x201), SendClass::Process), SendResult::Sent);
}

TEST_F(BusScene, WhatIsNotTakenIsDroppedAndCounted) {
  for (int i = 0; i < 300; ++i)
    one.orders.push_back({i * 100'000, frameOf(0x181, {static_cast<unsigned>(i % 256)})});
  bus.runUntil(50'000'000);
  EXPECT_EQ(takeAll(bus.port(master)).size(), 278U);
  EXPECT_EQ(bus.port(master).counters().dropped, 22U);
}

TEST(CanBus, FramesAreOnlySentWhenTheyAreReady) {
  SimulatedBus slow(BusSetup{.programNs = 300'000});
  const Station station = slow.addPort();
  Puppet listener;
  slow.attach(listener);
  Port &port = slow.port(station);
  port.beginCycle();
  port.send(frameOf(0x80), SendClass::Process);
  takeAll(port);
  port.send(frameOf(0x201), SendClass::Process);
  port.beginCycle();
  ASSERT_EQ(listener.heard.size(), 2U);
  EXPECT_LT(listener.heard[0].timeNs, 1'060'000);
  EXPECT_EQ(listener.heard[1].timeNs, 1'300'000 + 1000 * (exactBits(frameOf(0x201)) - 3));
}

TEST_F(BusScene, EqualIdentifiersWithOtherBytesDisturbEachOtherUntilOneIsPassive) {
  one.orders = {{1000, frameOf(0x181, {0x00})}};
  two.orders = {{1000, frameOf(0x181, {0xFF})}};
  bus.runUntil(3'000'000);
  EXPECT_EQ(bus.counters().collisions, 17U) << "16 times 8, and once more as passive ones";
  // Passive stations do not disturb: the dominant one goes through, and then the other.
  const std::vector<Received> got = takeAll(bus.port(master));
  ASSERT_EQ(got.size(), 2U);
  EXPECT_EQ(got[0].frame.data[0], 0x00);
  EXPECT_EQ(got[1].frame.data[0], 0xFF);
  EXPECT_EQ(bus.state(second), ControllerState::Passive);
}

TEST_F(BusScene, EqualFramesAreOneFrame) {
  one.orders = two.orders = {{1000, frameOf(0x181, {7})}};
  bus.runUntil(1'000'000);
  EXPECT_EQ(takeAll(bus.port(master)).size(), 1U);
  EXPECT_EQ(bus.counters().collisions, 0U);
}

TEST_F(BusScene, WithoutAnybodyToAcknowledgeAPortGetsPassiveAndGoesOnLater) {
  bus.setPiece(master, 1);
  Port &port = bus.port(master);
  port.send(frameOf(0x201, {1}), SendClass::Process);
  bus.runUntil(10'000'000);
  EXPECT_EQ(port.state(), ControllerState::Passive);
  EXPECT_TRUE(one.heard.empty());
  EXPECT_GE(port.counters().errorFrames, 16U);
  one.orders = {{11'000'000, frameOf(0x300)}};
  bus.runUntil(12'000'000);
  EXPECT_EQ(two.heard.size(), 1U) << "the others hear each other";
  bus.setPiece(master, 0);
  bus.runUntil(13'000'000);
  ASSERT_EQ(one.heard.size(), 1U);
  EXPECT_EQ(one.heard[0].frame.id, 0x201);
}

TEST_F(BusScene, BusOffEndsByRestartAfter128Times11Bits) {
  Port &port = bus.port(master);
  port.send(frameOf(0x201, {1}), SendClass::Process);
  bus.forceBusOff(master);
  EXPECT_EQ(port.state(), ControllerState::BusOff);
  EXPECT_EQ(port.send(frameOf(0x202), SendClass::Process), SendResult::Down);
  bus.runUntil(10'000'000);
  EXPECT_TRUE(one.heard.empty()) << "half a frame is none";
  bus.restart(master);
  bus.runUntil(10'000'000 + 128 * 11 * 1000 - 1);
  EXPECT_EQ(port.state(), ControllerState::BusOff);
  bus.runUntil(10'000'000 + 128 * 11 * 1000);
  EXPECT_EQ(port.state(), ControllerState::Active);
  EXPECT_EQ(port.counters().restarts, 1U);
}

TEST(CanBus, AutomaticRestartAndRecoveryOfNodes) {
  SimulatedBus other(BusSetup{.restartNs = 100'000'000});
  const Station port = other.addPort();
  Puppet node;
  const Station station = other.attach(node);
  other.forceBusOff(port);
  other.forceBusOff(station);
  other.runUntil(101'407'999);
  EXPECT_EQ(node.recoveries, 1);
  EXPECT_EQ(other.state(port), ControllerState::BusOff);
  other.runUntil(101'408'000);
  EXPECT_EQ(other.state(port), ControllerState::Active);
}

TEST_F(BusScene, AnInterfaceThatIsDown) {
  bus.setPower(master, false);
  EXPECT_EQ(bus.port(master).state(), ControllerState::Down);
  EXPECT_EQ(bus.port(master).send(frameOf(1), SendClass::Process), SendResult::Down);
  one.orders = {{1000, frameOf(0x181)}};
  bus.runUntil(1'000'000);
  EXPECT_TRUE(takeAll(bus.port(master)).empty());
  bus.setPower(master, true);
  EXPECT_EQ(bus.port(master).send(frameOf(1), SendClass::Process), SendResult::Sent);
}

TEST_F(BusScene, FaultsOnOrder) {
  bus.faults().order({.id = 0x181, .fault = Fault::Lose, .skip = 1});
  bus.faults().order({.id = 0x182, .fault = Fault::Corrupt, .byte = 1, .invert = 0x81});
  bus.faults().order({.id = 0x183, .fault = Fault::Delay, .delayNs = 700'000});
  bus.faults().order({.id = 0x184, .fault = Fault::Duplicate});
  bus.faults().order({.id = 0x185, .fault = Fault::Disturb, .count = 3});
  bus.faults().order({.id = 0x186, .fault = Fault::Corrupt, .length = 1});
  for (const int id : {0x181, 0x181, 0x181, 0x182, 0x183, 0x184, 0x185, 0x186})
    one.orders.push_back({1000, frameOf(static_cast<uint16_t>(id), {5, 6})});
  bus.runUntil(5'000'000);
  const std::vector<Received> got = takeAll(bus.port(master));
  EXPECT_THAT(idsOf(got), ElementsAre(0x181, 0x181, 0x182, 0x184, 0x184, 0x185, 0x186, 0x183));
  EXPECT_EQ(got[2].frame, frameOf(0x182, {5, 6 ^ 0x81}));
  EXPECT_EQ(got[6].frame, frameOf(0x186, {5}));
  EXPECT_EQ(bus.counters().errors, 3U);
}

/// The load of the bus is what the bits say, and arbitration is that of an ideal queue.
TEST(CanBus, ManyStationsAgainstAnIdealQueue) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    SimulatedBus bus(BusSetup{.receiveQueue = 2000});
    const Station port = bus.addPort();
    std::vector<std::unique_ptr<Puppet>> puppets;
    struct Waiting {
      int64_t timeNs;
      Frame frame;
    };
    std::vector<Waiting> all; // one frame per station at a time, so that mailboxes never matter
    for (unsigned i = 0; i < 40; ++i) {
      Frame frame = frameOf(static_cast<uint16_t>(1 + i * 37 % 2000), {});
      frame.length = static_cast<uint8_t>(random() % 9);
      for (uint8_t k = 0; k < frame.length; ++k)
        frame.data[k] = static_cast<uint8_t>(random());
      const auto time = static_cast<int64_t>(random() % 3'000'000);
      puppets.push_back(std::make_unique<Puppet>());
      puppets.back()->orders = {{time, frame}};
      bus.attach(*puppets.back());
      all.push_back({time, frame});
    }
    bus.runUntil(20'000'000);
    int64_t now = 0;
    uint64_t bits = 0;
    for (const Received &received : takeAll(bus.port(port))) {
      const auto soonest = std::min_element(all.begin(), all.end(),
                                            [](auto &a, auto &b) { return a.timeNs < b.timeNs; });
      now = std::max(now, soonest->timeNs);
      auto best = all.end();
      for (auto at = all.begin(); at != all.end(); ++at)
        if (at->timeNs <= now && (best == all.end() || at->frame.id < best->frame.id))
          best = at;
      ASSERT_EQ(received.frame, best->frame) << seed;
      now += exactBits(best->frame) * 1000;
      ASSERT_EQ(received.timeNs, now - 3000);
      bits += exactBits(best->frame);
      all.erase(best);
    }
    EXPECT_TRUE(all.empty());
    EXPECT_EQ(bus.counters().bits, bits);
  }
}

} // namespace
} // namespace stride::can::simulation
