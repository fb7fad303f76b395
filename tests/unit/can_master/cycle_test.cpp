// What holds in every cycle: no memory is taken, the same frames give the same frames, and whatever
// comes, a drive is only told what is legal.
#include "drivers/can/master/power.hpp"
#include "tests/unit/can_master/can_bus.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace stride::test {
size_t allocations();
} // namespace stride::test

namespace stride::can {
namespace {

/// Gives the frames of a recorded life again, without taking memory.
class ReplayPort final : public Port {
public:
  explicit ReplayPort(const std::vector<std::vector<Frame>> &life) : life_(life) {
    sent.reserve(100000);
  }
  void beginCycle() noexcept override {}
  SendResult send(const Frame &frame, SendClass) noexcept override {
    if (sent.size() < sent.capacity())
      sent.push_back(frame);
    return SendResult::Sent;
  }
  size_t receive(std::span<Received> frames) noexcept override {
    if (cycle_ >= life_.size())
      return 0;
    const std::vector<Frame> &now = life_[cycle_++];
    for (size_t i = 0; i < now.size(); ++i)
      frames[i].frame = now[i];
    return now.size();
  }
  ControllerState state() const noexcept override { return ControllerState::Active; }
  PortCounters counters() const noexcept override { return {}; }

  std::vector<Frame> sent;

private:
  const std::vector<std::vector<Frame>> &life_;
  size_t cycle_ = 0;
};

class SilentHost final : public bus::DriverHost {
public:
  void raise(bus::BusEvent) noexcept override {}
  void say(const bus::Message &) noexcept override { ++said; }
  int said = 0;
};

/// Starts two drives, switches them on, homes one, breaks the other, asks for parameters.
void script(int cycle, std::vector<bus::DriveCommand> &commands) {
  if (cycle >= 300)
    commands[0].regulatorOn = commands[0].driveStart = true;
  if (cycle >= 320)
    commands[1].regulatorOn = true;
  commands[0].position += cycle >= 350 ? 5 : 0;
  commands[0].velocity = cycle >= 350 ? 5000 : 0;
  commands[0].capture = cycle >= 360 && cycle < 420 ? 3 : 0;
  commands[0].homing = cycle >= 450 && cycle < 520;
  commands[0].controllerMode = cycle >= 540 ? 2 : 3;
  commands[1].errorAckn = cycle >= 600;
}

class Life : public test::CanBusTest {
protected:
  void SetUp() override {
    for (const uint32_t id : {3U, 4U}) {
      bus::SetupParameters &drive = addDrive(id, 5);
      drive.add({"inputs", "", 1});
      drive.add({"probe_inputs", "", 15});
    }
    nodes[0].pdosInOperation = {"183#0000000000000000", "283#400208000000FF", "383#000000000000"};
    nodes[1].pdosInOperation = {"184#0000000000000000", "284#40020800000000", "384#000000000000"};
  }
  static constexpr int kCycles = 800;

  /// A cycle of a driver, as a drive group makes it.
  static void step(bus::AxisDriver &one, int cycle, std::vector<bus::DriveCommand> &commands,
                   std::array<bool, 2> &started) {
    one.executeStart();
    for (size_t i = 0; i < 2; ++i) {
      bus::Message message;
      uint16_t progress = 0;
      if (!started[i])
        started[i] = one.init(i, progress, message) == bus::StartUp::Started;
      (void)one.status(i);
      if (started[i])
        one.command(i, commands[i]);
    }
    bus::ParameterRequest request;
    request.number = 0x606400;
    bus::ParameterAnswer answer;
    if (cycle == 400)
      (void)one.startParameter(0, request);
    if (cycle > 400)
      (void)one.pollParameter(0, answer);
    one.executeEnd();
  }
};

TEST_F(Life, TakesNoMemoryAndCanBeRepeated) {
  make();
  std::array<bool, 2> began{};
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    deliver();
    if (cycle % 50 == 0)
      for (test::ScriptedNode &node : nodes)
        node.say(0x700, node.state);
    // What the drives show goes through their states.
    static constexpr std::array<const char *, 4> kWords = {"4002", "2102", "2302", "2702"};
    const int state = cycle < 310 ? 0 : cycle < 315 ? 1 : cycle < 320 ? 2 : 3;
    if (cycle > 300) {
      const std::string mode = cycle >= 460 && cycle < 530 ? "06" : "08";
      nodes[0].atSync = {"183#0500000000000000",
                         std::string("283#") + kWords[static_cast<size_t>(state)] + mode +
                             "00000000",
                         cycle > 380 ? "383#030011223344" : "383#010000000000"};
      nodes[1].atSync = {"184#0000000000000000",
                         cycle > 550 ? "284#08020800000000" : "284#21020800000000",
                         "384#000000000000"};
    }
    if (cycle == 560)
      nodes[1].say(0x080, "1032000000000000");
    script(cycle, commands);
    step(*driver, cycle, commands, began);
  }
  ASSERT_TRUE(began[0] && began[1]);
  const std::vector<std::vector<Frame>> life = port->taken;
  const std::vector<Frame> sent = port->allSent;
  EXPECT_GT(sent.size(), 2000U);

  auto owned = std::make_unique<ReplayPort>(life);
  ReplayPort *replay = owned.get();
  const auto again = std::make_unique<CanDriver>(setup, std::move(owned));
  SilentHost silent;
  again->attach(silent);
  std::vector<bus::DriveCommand> same(2);
  std::array<bool, 2> started{};
  const size_t before = stride::test::allocations();
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    script(cycle, same);
    step(*again, cycle, same, started);
  }
  EXPECT_EQ(stride::test::allocations(), before);
  EXPECT_EQ(replay->sent, sent);
  EXPECT_GT(silent.said, 0);
}

using CanBus = test::CanBusTest;

/// A frame that is made to hurt: mostly with identifiers that mean something.
Frame anyFrame(std::mt19937 &random) {
  static constexpr std::array<uint16_t, 12> kIds = {0x183, 0x283, 0x383, 0x583, 0x703, 0x083,
                                                    0x080, 0x000, 0x603, 0x203, 0x184, 0x77E};
  Frame frame;
  frame.id =
      random() % 8 == 0 ? static_cast<uint16_t>(random() % 0x800) : kIds[random() % kIds.size()];
  frame.length = static_cast<uint8_t>(random() % 3 == 0 ? random() % 9 : 6);
  frame.remote = random() % 20 == 0;
  for (size_t i = 0; i < frame.length; ++i)
    frame.data[i] = static_cast<uint8_t>(random() % 4 == 0 ? random() : random() % 0x30);
  return frame;
}

TEST_F(CanBus, RandomFramesNeverEnableWhatNobodyHasCommanded) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    nodes.clear();
    setup.drives.clear();
    driver.reset();
    addDrive(3);
    start();
    uint32_t shown = 0x0240;
    bool acknowledged = false; // the error that it has
    for (int i = 0; i < 400; ++i) {
      if (random() % 40 == 0)
        commands[0].regulatorOn = !commands[0].regulatorOn;
      if (random() % 40 == 0)
        commands[0].driveStart = !commands[0].driveStart;
      commands[0].errorAckn = random() % 30 == 0;
      commands[0].homing = random() % 10 == 0;
      if (random() % 30 == 0)
        nodes[0].atSync.clear();
      for (auto n = random() % 3; n > 0; --n)
        port->toReceive.push_back(anyFrame(random));
      if (random() % 4 != 0) {
        static constexpr std::array<uint32_t, 8> kWords = {0x240, 0x221, 0x223, 0x227,
                                                           0x207, 0x208, 0x20F, 0x200};
        shows(0, kWords[random() % kWords.size()], static_cast<uint32_t>(random()));
      }
      port->takeSent();
      const size_t first = port->allSent.size();
      cycle();
      acknowledged = driver->status(0).error && (acknowledged || commands[0].errorAckn);
      for (const Frame &frame : port->taken.back())
        if (frame.id == 0x183 && frame.length == 6 && !frame.remote)
          shown = frame.data[0] | uint32_t{frame.data[1]} << 8U;
      for (size_t k = first; k < port->allSent.size(); ++k) {
        const Frame &frame = port->allSent[k];
        if (frame.id != 0x203)
          continue;
        ASSERT_EQ(frame.length, 6);
        const PowerState state = powerStateOf(static_cast<uint16_t>(shown));
        if ((frame.data[0] & 0x0FU) == 0x0FU) {
          ASSERT_TRUE(state == PowerState::SwitchedOn || state == PowerState::Enabled) << shown;
          ASSERT_TRUE(commands[0].regulatorOn && commands[0].driveStart);
          ASSERT_TRUE(communicates(0));
          ASSERT_TRUE(!driver->status(0).error || acknowledged);
        }
        if ((frame.data[0] & 0x80U) != 0) {
          ASSERT_EQ(state, PowerState::Fault);
        }
      }
    }
  }
}

// The same through all of a start-up.
TEST_F(CanBus, RandomFramesEndNoStartUpWithoutReason) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    nodes.clear();
    setup.drives.clear();
    driver.reset();
    addDrive(3);
    make();
    message.set();
    bus::StartUp result = bus::StartUp::Busy;
    for (int i = 0; i < 6000 && result == bus::StartUp::Busy; ++i) {
      if (random() % 20 == 0)
        port->toReceive.push_back(anyFrame(random));
      deliver();
      driver->executeStart();
      uint16_t progress = 0;
      result = driver->init(0, progress, message);
      ASSERT_LE(progress, 99);
      driver->executeEnd();
    }
    ASSERT_NE(result, bus::StartUp::Busy) << seed;
    EXPECT_EQ(result == bus::StartUp::Failed, !message.text().empty()) << seed;
  }
}

} // namespace
} // namespace stride::can
