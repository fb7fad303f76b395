// Clients of `stride run --listen` that do everything wrong: the application goes on, nothing
// grows, and whoever asks properly is answered.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kPatienceMs = 20'000;

/// Bytes to and from a socket, without any idea of what they mean.
class RawClient {
public:
  explicit RawClient(const fs::path &path) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    ::sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    if (::connect(socket_, reinterpret_cast<const ::sockaddr *>(&address), sizeof address) != 0)
      ADD_FAILURE() << "cannot connect: " << std::strerror(errno);
  }
  RawClient(RawClient &&other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  RawClient(const RawClient &) = delete;
  ~RawClient() {
    if (socket_ >= 0)
      ::close(socket_);
  }

  /// False when the other side has hung up, or takes nothing for so long.
  bool send(std::string_view text, int patienceMs = kPatienceMs) {
    while (!text.empty()) {
      ::pollfd file{socket_, POLLOUT, 0};
      if (::poll(&file, 1, patienceMs) <= 0)
        return false;
      const ::ssize_t sent = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent < 0)
        return false;
      text.remove_prefix(static_cast<size_t>(sent));
    }
    return true;
  }
  /// The next line; empty when the other side has hung up.
  std::string line() {
    for (;;) {
      if (const size_t end = got_.find('\n'); end != std::string::npos) {
        std::string text = got_.substr(0, end);
        got_.erase(0, end + 1);
        return text;
      }
      ::pollfd file{socket_, POLLIN, 0};
      char buffer[4096];
      if (::poll(&file, 1, kPatienceMs) <= 0) {
        ADD_FAILURE() << "no answer";
        return {};
      }
      const ::ssize_t size = ::recv(socket_, buffer, sizeof buffer, 0);
      if (size <= 0)
        return {};
      got_.append(buffer, static_cast<size_t>(size));
    }
  }
  /// Reads until the other side hangs up.
  void drain() {
    while (!line().empty()) {
    }
  }

private:
  int socket_;
  std::string got_;
};

class HostileClients : public ::testing::Test {
protected:
  void SetUp() override {
    writeFile(scratch_.path() / "app.st", R"(
PROGRAM Main
VAR n : DINT; a : ARRAY[0..999] OF DINT; END_VAR
n := n + 1;
END_PROGRAM
CONFIGURATION C
  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);
  PROGRAM Main WITH Fast;
END_CONFIGURATION
)");
    ASSERT_EQ(shell("$STRIDE build app.st -W off=lints").exitCode, 0);
    host_ = std::thread([this] {
      result_ =
          shell("$HOST run app.so --for 300s --quiet --listen unix:plc.sock & echo $! > pid.new;"
                " mv pid.new pid; wait $!");
    });
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!(fs::exists(socket()) && fs::exists(scratch_.path() / "pid")) &&
           std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    pid_ = std::stoi(readFile(scratch_.path() / "pid"));
  }
  void TearDown() override {
    if (pid_ != 0)
      ::kill(pid_, SIGINT);
    host_.join();
    EXPECT_EQ(result_.exitCode, 0) << result_.err;
  }

  ProcessResult shell(const std::string &script) {
    return runProcess({"sh", "-c", script}, scratch_.path(),
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()},
                       {"HOST", STRIDE_BINARY_DIR "/stride-host"},
                       {"STRIDE", STRIDE_BINARY_DIR "/stride"}});
  }
  fs::path socket() const { return scratch_.path() / "plc.sock"; }
  /// After the greeting.
  RawClient client() const {
    RawClient fresh(socket());
    EXPECT_THAT(fresh.line(), HasSubstr("\"hello\":\"stride\""));
    return fresh;
  }
  /// Somebody who asks properly is answered with a value that goes on growing.
  void expectServed() {
    RawClient good = client();
    const auto count = [&] {
      good.send("{\"id\":1,\"op\":\"read\",\"names\":[\"Main.n\"]}\n");
      const std::string answer = good.line();
      const size_t at = answer.find("\"value\":");
      EXPECT_NE(at, std::string::npos) << answer;
      return at == std::string::npos ? 0 : std::stol(answer.substr(at + 8));
    };
    const long before = count();
    EXPECT_GT(before, last_);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    last_ = count();
    EXPECT_GT(last_, before);
  }
  /// Of the running host. [KiB]
  long memory() const {
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("VmRSS:"))
        return std::stol(line.substr(6));
    return 0;
  }
  size_t openFiles() const {
    const fs::directory_iterator files("/proc/" + std::to_string(pid_) + "/fd");
    return static_cast<size_t>(std::distance(begin(files), end(files)));
  }
  /// Does it again and again; once the allocator has what it keeps, the host must not become
  /// larger.
  void expectNoGrowth(const char *what, const std::function<void()> &attack) {
    SCOPED_TRACE(what);
    for (int i = 0; i < 2; ++i) {
      attack();
      expectServed();
    }
    [[maybe_unused]] const long before = memory();
    attack();
    expectServed();
#ifndef __SANITIZE_ADDRESS__ // which keeps what is freed for a while
    EXPECT_LT(memory(), before + 2048);
#endif
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (openFiles() > files_ && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_LE(openFiles(), files_);
  }

  ScratchDirectory scratch_;
  std::thread host_;
  ProcessResult result_;
  int pid_ = 0;
  size_t files_ = 0;
  long last_ = 0;
};

TEST_F(HostileClients, TheApplicationGoesOnAndNothingGrows) {
  expectServed();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  files_ = openFiles();

  { // a request in pieces is a request
    RawClient slow = client();
    for (const char piece :
         std::string_view("{\"id\":7,\"op\":\"read\",\"names\":[\"Main.n\"]}\r\n")) {
      ASSERT_TRUE(slow.send({&piece, 1}));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_THAT(slow.line(), HasSubstr("\"id\":7"));
    slow.send("{\"id\":8,\"op\":"); // and is not finished
  }
  expectServed();

  expectNoGrowth("a line without an end is refused", [&] {
    RawClient endless = client();
    const std::string piece(64 << 10, 'x');
    for (int i = 0; i < 32 && endless.send(piece); ++i) {
    }
    EXPECT_THAT(endless.line(),
                testing::AnyOf(HasSubstr("the line is too long"), testing::IsEmpty()));
    endless.drain();
  });

  expectNoGrowth("every line of nonsense is answered", [&] {
    RawClient confused = client();
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i) {
      std::string text(1 + random() % 300, ' ');
      for (char &c : text)
        do
          c = static_cast<char>(random());
        while (c == '\n');
      ASSERT_TRUE(confused.send(text + "x\n"));
      EXPECT_THAT(confused.line(), HasSubstr("\"code\":\"bad_"));
    }
    for (const std::string &line :
         {std::string(100'000, '['), std::string("{}"), std::string("[1]"), std::string("null"),
          std::string("{\"op\":7}"), std::string("{\"op\":\"read\",\"names\":7}"),
          std::string("{\"op\":\"read\",\"names\":[") + std::string(1000, '[') + "]}",
          std::string("{\"id\":1,\"op\":\"list\",\"limit\":-1}"),
          std::string("{\"id\":{},\"op\":\"state\"}")}) {
      ASSERT_TRUE(confused.send(line + "\n"));
      EXPECT_THAT(confused.line(), HasSubstr("\"error\":{\"code\":\""));
    }
    ASSERT_TRUE(confused.send("{\"id\":9,\"op\":\"state\"}\n"));
    EXPECT_THAT(confused.line(), HasSubstr("\"state\":\"running\""));
  });

  expectNoGrowth("who comes and goes", [&] {
    for (int i = 0; i < 1000; ++i) {
      RawClient brief(socket());
      if (i % 3 == 0)
        brief.send("{\"id\":1,\"op\":\"subscribe\",\"names\":[\"Main.a\"],\"period\":0.01}\n");
    }
  });

  expectNoGrowth("who asks and never reads", [&] {
    RawClient deaf(socket());
    const std::string ask = "{\"id\":1,\"op\":\"list\",\"path\":\"Main.a\",\"limit\":1000}\n";
    bool takes = true;
    for (int i = 0; takes && i < 2000; ++i)
      takes = deaf.send(ask, 1000);
    EXPECT_FALSE(takes);
  });

  expectNoGrowth("more of them than are let in", [&] {
    std::vector<std::unique_ptr<RawClient>> crowd;
    for (int i = 0; i < 24; ++i) // the others wait at the door
      crowd.push_back(std::make_unique<RawClient>(socket()));
    EXPECT_THAT(crowd.front()->line(), HasSubstr("hello"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    while (crowd.size() > 1)
      crowd.erase(crowd.begin());
    EXPECT_THAT(crowd.front()->line(), HasSubstr("hello"));
  });
}

/// They keep nobody waiting for ever.
TEST_F(HostileClients, SilentOnesGiveWay) {
  std::vector<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 16; ++i) {
    silent.push_back(std::make_unique<RawClient>(socket()));
    EXPECT_THAT(silent.back()->line(), HasSubstr("hello"));
  }
  silent[3]->send("{\"id\":1,\"op\":\"read\","); // half a request is none
  const ProcessResult asked = shell("$HOST ctl unix:plc.sock read Main.n");
  EXPECT_EQ(asked.exitCode, 0) << asked.err;
  EXPECT_THAT(asked.out, StartsWith("Main.n = "));
  EXPECT_THAT(silent.front()->line(), HasSubstr("\"code\":\"silent\""));
  EXPECT_TRUE(silent.back()->send("{\"id\":1,\"op\":\"state\"}\n"));
  EXPECT_THAT(silent.back()->line(), HasSubstr("running"));
}

TEST_F(HostileClients, WhoWaitsForSomethingKeepsItsPlace) {
  std::vector<std::unique_ptr<RawClient>> busy;
  for (int i = 0; i < 16; ++i) {
    busy.push_back(std::make_unique<RawClient>(socket()));
    EXPECT_THAT(busy.back()->line(), HasSubstr("hello"));
    busy.back()->send("{\"id\":1,\"op\":\"subscribe\",\"names\":[\"Main.n\"],\"period\":1}\n");
    EXPECT_THAT(busy.back()->line(), HasSubstr("\"subscription\":"));
  }
  const ProcessResult asked = shell("$HOST ctl unix:plc.sock read Main.n");
  EXPECT_EQ(asked.exitCode, 1);
  EXPECT_THAT(asked.err, HasSubstr("unix:plc.sock lets nobody in: all places for clients are "
                                   "taken, and all of them are busy"));
  busy.pop_back();
  expectServed();
}

/// A run that is stopped itself: who asks learns that it does not answer.
TEST_F(HostileClients, AServerThatDoesNotAnswer) {
  ::kill(pid_, SIGSTOP);
  const ProcessResult asked = shell("$HOST ctl unix:plc.sock read Main.n");
  ::kill(pid_, SIGCONT);
  EXPECT_EQ(asked.exitCode, 1);
  EXPECT_THAT(asked.err, HasSubstr("has not answered for 10 s"));
}

} // namespace
} // namespace stride::test
