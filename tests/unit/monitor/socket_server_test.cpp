// Whose socket it is: several that begin or end at the same place.
#include "runtime/monitor/socket_server.hpp"

#include "runtime/app/error.hpp"
#include "runtime/monitor/file_handle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <unistd.h>

namespace stride::monitor {
namespace {

class SocketPlace : public ::testing::Test {
protected:
  SocketPlace() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "stride-socket-XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
    path = folder + "/plc.sock";
  }
  ~SocketPlace() override { std::filesystem::remove_all(folder); }

  std::unique_ptr<SocketServer> begin() const {
    try {
      return std::make_unique<SocketServer>("unix:" + path);
    } catch (const app::Error &) {
      return nullptr;
    }
  }
  bool answers() const {
    const FileHandle client(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const ::sockaddr_un address = socketAddress(path);
    return ::connect(client.number(), reinterpret_cast<const ::sockaddr *>(&address),
                     sizeof address) == 0;
  }

  std::string folder;
  std::string path;
};

TEST_F(SocketPlace, OfThoseWhoBeginAtOnceOneListens) {
  for (int round = 0; round < 60; ++round) {
    std::array<std::unique_ptr<SocketServer>, 3> servers;
    std::atomic<size_t> waiting{servers.size()};
    std::array<std::thread, 3> threads;
    for (size_t i = 0; i < servers.size(); ++i)
      threads[i] = std::thread([&, i] {
        --waiting;
        while (waiting.load() != 0) {
        }
        servers[i] = begin();
      });
    size_t listening = 0;
    for (size_t i = 0; i < servers.size(); ++i) {
      threads[i].join();
      listening += servers[i] != nullptr ? 1 : 0;
    }
    ASSERT_EQ(listening, 1U) << round;
    ASSERT_TRUE(answers()) << round;
  }
}

TEST_F(SocketPlace, ALockOfSomebodyElseDelaysOnly) {
  const FileHandle other(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  ASSERT_EQ(::flock(other.number(), LOCK_EX), 0);
  EXPECT_NE(begin(), nullptr);
}

TEST_F(SocketPlace, WhoEndsLeavesTheSocketOfAnother) {
  std::unique_ptr<SocketServer> first = begin();
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(begin(), nullptr);
  std::filesystem::remove(path);
  const std::unique_ptr<SocketServer> second = begin();
  ASSERT_NE(second, nullptr);
  first.reset();
  EXPECT_TRUE(answers());
}

TEST_F(SocketPlace, WhoEndsRemovesItsOwn) {
  begin().reset();
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_NE(begin(), nullptr);
}

} // namespace
} // namespace stride::monitor
