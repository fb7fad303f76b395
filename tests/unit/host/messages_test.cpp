#include "runtime/host/messages.hpp"
#include "runtime/task/cycle_log.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace stride::test {
size_t allocations();
}

namespace {

using stride::host::Messages;
using stride::host::Output;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class Pipe {
public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      ADD_FAILURE() << "no pipe";
    ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ~Pipe() {
    ::close(ends_[1]);
    hangUp();
  }
  Pipe(const Pipe &) = delete;
  Pipe &operator=(const Pipe &) = delete;
  int writer() const { return ends_[1]; }
  std::string read() const {
    std::string text;
    char buffer[65536];
    for (ssize_t size = 0; (size = ::read(ends_[0], buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<size_t>(size));
    return text;
  }
  void hangUp() {
    if (ends_[0] >= 0)
      ::close(ends_[0]);
    ends_[0] = -1;
  }

private:
  std::array<int, 2> ends_{-1, -1};
};

TEST(Messages, AreLines) {
  const Pipe pipe;
  Messages messages(Output::Wait::Never, pipe.writer());
  messages.say({"warning: ", "one"});
  messages.say("two\n");
  EXPECT_EQ(pipe.read(), "warning: one\ntwo\n");
  EXPECT_TRUE(messages.finish());
}

TEST(Messages, NobodyWaitsForAReaderWhoDoesNotRead) {
  const Pipe pipe;
  Messages messages(Output::Wait::Never, pipe.writer());
  const std::string line(1000, 'x');
  const size_t before = stride::test::allocations();
  for (int i = 0; i < 1000; ++i)
    messages.say(line);
  EXPECT_EQ(stride::test::allocations(), before);
  std::string text = pipe.read();
  messages.lookAfter();
  for (std::string more = pipe.read(); !more.empty(); more = pipe.read()) {
    text += more;
    messages.lookAfter();
  }
  const auto written = static_cast<int>(text.size() / 1001);
  EXPECT_LT(written, 1000);
  EXPECT_THAT(text, EndsWith("x\n"));
  messages.say("again");
  EXPECT_EQ(pipe.read(), "warning: " + std::to_string(1000 - written) +
                             " lines of messages could not be written: nobody read them\nagain\n");
  EXPECT_TRUE(messages.finish());
}

TEST(Messages, AFullDiskIsToldWhenThereIsRoom) {
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  Messages messages(Output::Wait::Never, full);
  messages.say("one");
  messages.say("two\nthree");
  EXPECT_FALSE(messages.finish());
  ::close(full);
}

TEST(Messages, AReaderWhoHasGone) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  Pipe pipe;
  Messages messages(Output::Wait::Never, pipe.writer());
  pipe.hangUp();
  messages.say("one");
  EXPECT_FALSE(messages.finish());
  std::signal(SIGPIPE, before);
}

TEST(CycleLog, KeepsTheOrderAndCountsWhatIsTooMuch) {
  stride::task::CycleLog log;
  log.put("a");
  log.put("b");
  EXPECT_THAT(log.take(), ElementsAre("a", "b"));
  for (size_t i = 0; i < stride::task::CycleLog::kLines + 3; ++i)
    log.put("more");
  const std::vector<std::string> lines = log.take();
  EXPECT_EQ(lines.size(), stride::task::CycleLog::kLines + 1);
  EXPECT_THAT(lines.back(), HasSubstr("3 more lines"));
  EXPECT_THAT(log.take(), ElementsAre());
}

} // namespace
