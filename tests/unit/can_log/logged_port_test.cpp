// The file of a port's frames, written by a thread of its own or by the cycles.
#include "drivers/can/log/logged_port.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace stride::can::log {
namespace {

/// Gives a frame in each cycle, and takes what is sent in all but every third one.
class TestPort final : public Port {
public:
  void beginCycle() noexcept override { ++cycle_; }
  SendResult send(const Frame & /*frame*/, SendClass /*sendClass*/) noexcept override {
    return cycle_ % 3 == 0 ? SendResult::QueueFull : SendResult::Sent;
  }
  size_t receive(std::span<Received> frames) noexcept override {
    frames[0].frame.id = 0x185;
    frames[0].frame.length = 2;
    frames[0].frame.data = {static_cast<uint8_t>(cycle_), 0xA0};
    frames[0].timeNs = cycle_ * 1'000'000 - 250'000;
    return 1;
  }
  [[nodiscard]] ControllerState state() const noexcept override { return ControllerState::Warning; }
  [[nodiscard]] PortCounters counters() const noexcept override { return {1, 2, 3}; }

private:
  int64_t cycle_ = 0;
};

std::string read(const std::string &path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class LoggedPortTest : public ::testing::TestWithParam<bool> {
protected:
  LoggedPortTest() {
    setup.file = (std::filesystem::temp_directory_path() /
                  ("stride_logged_port_" + std::to_string(GetParam()) + ".log"))
                     .string();
    setup.interface = "can7";
    setup.ownThread = GetParam();
  }
  ~LoggedPortTest() override { std::filesystem::remove(setup.file); }
  static void cycle(LoggedPort &port, unsigned number) {
    port.beginCycle();
    Frame frame;
    frame.id = 0x205;
    frame.length = 1;
    frame.data[0] = static_cast<uint8_t>(number);
    (void)port.send(frame, SendClass::Process);
    std::array<Received, 4> received;
    EXPECT_EQ(port.receive(received), 1U);
  }

  LogSetup setup;
};

TEST_P(LoggedPortTest, HasEachFrameThatHasPassedInItsOrder) {
  constexpr unsigned kCycles = 2000;
  {
    LoggedPort port(std::make_unique<TestPort>(), setup);
    EXPECT_EQ(port.state(), ControllerState::Warning);
    EXPECT_EQ(port.counters().restarts, 3U);
    for (unsigned i = 1; i <= kCycles; ++i)
      cycle(port, i);
  }
  const Recording recording = readRecording(read(setup.file));
  EXPECT_EQ(recording.interface, "can7");
  EXPECT_EQ(recording.badLines, 0U);
  ASSERT_EQ(recording.entries.size(), kCycles + kCycles - kCycles / 3);
  size_t place = 0;
  for (unsigned i = 1; i <= kCycles; ++i) {
    if (i % 3 != 0) { // what finds no room has not been sent
      const Entry &sent = recording.entries[place++];
      EXPECT_EQ(sent.direction, Direction::Sent);
      EXPECT_EQ(sent.frame.data[0], i & 0xFFU);
      EXPECT_EQ(sent.timeNs, i * int64_t{1'000'000});
    }
    const Entry &received = recording.entries[place++];
    EXPECT_EQ(received.direction, Direction::Received);
    EXPECT_EQ(received.frame.id, 0x185);
    EXPECT_EQ(received.timeNs, i * int64_t{1'000'000} - 250'000);
  }
}

TEST_P(LoggedPortTest, IsWrittenAnew) {
  std::ofstream(setup.file) << "old\n";
  { const LoggedPort port(std::make_unique<TestPort>(), setup); }
  EXPECT_EQ(read(setup.file), "");
}

TEST_P(LoggedPortTest, ThatCannotBeWrittenIsAnError) {
  setup.file += "/nowhere/bus.log";
  try {
    const LoggedPort port(std::make_unique<TestPort>(), setup);
    FAIL();
  } catch (const std::runtime_error &error) {
    EXPECT_NE(std::string(error.what()).find("nowhere/bus.log' for the frames of a bus cannot"),
              std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(ByThreadAndByCycles, LoggedPortTest, ::testing::Bool());

} // namespace
} // namespace stride::can::log
