// [build] launcher: who starts the C++ compiler.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <csignal>
#include <filesystem>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Launcher : public ::testing::Test {
protected:
  Launcher() {
    fs::create_directories(bin());
    fs::create_directories(scratch_.path() / "p");
    writeFile(scratch_.path() / "p/Main.st",
              "PROGRAM PLC_PRG\nVAR\n  x : INT := 5;\nEND_VAR\nx := x * 3;\nEND_PROGRAM\n");
    configure("");
  }

  [[nodiscard]] fs::path bin() const { return scratch_.path() / "bin"; }
  [[nodiscard]] fs::path log() const { return scratch_.path() / "log"; }

  void configure(const std::string &build) {
    writeFile(scratch_.path() / "p/stride.toml", "[project]\nname = \"p\"\n" + build);
  }

  /// Builds with `bin` as the first folder of PATH.
  ProcessResult build(std::vector<std::pair<std::string, std::string>> environment = {}) {
    const char *path = std::getenv("PATH");
    environment.emplace_back("XDG_CACHE_HOME", (scratch_.path() / "cache").string());
    if (std::none_of(environment.begin(), environment.end(),
                     [](const auto &variable) { return variable.first == "PATH"; }))
      environment.emplace_back("PATH",
                               bin().string() + ":" + (path != nullptr ? path : "/usr/bin:/bin"));
    return runProcess({STRIDE_BINARY_DIR "/stride", "build", "p"}, scratch_.path(), environment);
  }

  [[nodiscard]] std::string application() const {
    return readFile(scratch_.path() / "p/build/app.so");
  }

  ScratchDirectory scratch_;
};

TEST_F(Launcher, StartsTheCompiler) {
  // Tells what it is asked for, and does it.
  writeFile(bin() / "icecc",
            "#!/bin/sh\nprintf '%s\\n' \"$*\" >> '" + log().string() + "'\nexec \"$@\"\n");
  fs::permissions(bin() / "icecc", fs::perms::owner_all);
  ASSERT_EQ(build().exitCode, 0);
  EXPECT_FALSE(fs::exists(log()));
  configure("[build]\nlauncher = \"icecc\"\njobs = 7\n");
  const ProcessResult result = build(); // what the compiler itself has made is not taken
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::string calls = readFile(log());
  EXPECT_EQ(std::count(calls.begin(), calls.end(), '\n'), 1) << calls;
  EXPECT_THAT(calls, HasSubstr(" -c "));
  ASSERT_EQ(build().exitCode, 0);
  EXPECT_EQ(readFile(log()), calls);
}

TEST_F(Launcher, MissingOneIsReported) {
  configure("[build]\nlauncher = \"distcc\"\n");
  const char *compiler = std::getenv("STRIDE_CXX");
  fs::create_symlink("/usr/bin/g++", bin() / "g++");
  const ProcessResult result =
      build({{"PATH", bin().string()}, {"STRIDE_CXX", compiler != nullptr ? compiler : ""}});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("SE0991"));
  EXPECT_THAT(result.err, HasSubstr("`distcc`, the launcher that stride.toml names"));
  EXPECT_THAT(result.err, HasSubstr("apt-get install distcc"));
}

TEST_F(Launcher, ProjectsCannotNamePrograms) {
  writeFile(scratch_.path() / "p/evil", "#!/bin/sh\ntouch '" + log().string() + "'\n");
  fs::permissions(scratch_.path() / "p/evil", fs::perms::owner_all);
  for (const char *launcher : {"./evil", "evil", "p/evil", "/bin/sh", "distcc --version", ""}) {
    configure("[build]\nlauncher = \"" + std::string(launcher) + "\"\n");
    const ProcessResult result = build();
    EXPECT_EQ(result.exitCode, 1) << launcher;
    EXPECT_THAT(result.err, HasSubstr("stride.toml:4:")) << launcher;
    EXPECT_FALSE(fs::exists(log()));
  }
}

int freePort() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  const bool good = ::bind(socket, reinterpret_cast<sockaddr *>(&address), size) == 0 &&
                    ::getsockname(socket, reinterpret_cast<sockaddr *>(&address), &size) == 0;
  ::close(socket);
  return good ? ntohs(address.sin_port) : 0;
}

/// A distccd that compiles for this machine.
class Server {
public:
  Server(const fs::path &folder, int port) {
    const std::string number = std::to_string(port);
    const ProcessResult started =
        runProcess({"sh", "-c",
                    "timeout 100 distccd --no-detach --daemon --allow 127.0.0.1 --listen 127.0.0.1 "
                    "--jobs 2 --log-stderr --verbose --port " +
                        number + " > '" + (folder / "server").string() + "' 2>&1 & echo $!"},
                   folder);
    pid_ = std::atoi(started.out.c_str());
    for (int i = 0; i < 1000 && !answers(port); ++i)
      ::usleep(10000);
  }
  ~Server() {
    if (pid_ > 0)
      ::kill(pid_, SIGTERM);
  }
  Server(const Server &) = delete;
  Server &operator=(const Server &) = delete;

private:
  static bool answers(int port) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<uint16_t>(port));
    const bool good =
        ::connect(socket, reinterpret_cast<sockaddr *>(&address), sizeof(address)) == 0;
    ::close(socket);
    return good;
  }

  pid_t pid_ = 0;
};

TEST_F(Launcher, DistccGivesTheSameBytes) {
  if (runProcess({"sh", "-c", "command -v distcc distccd"}, scratch_.path()).exitCode != 0)
    GTEST_SKIP() << "without distcc";
  configure("[build]\nlauncher = \"distcc\"\n");
  fs::create_directories(scratch_.path() / "state");
  const std::pair<std::string, std::string> state = {"DISTCC_DIR",
                                                     (scratch_.path() / "state").string()};
  ASSERT_EQ(build({{"DISTCC_HOSTS", "localhost"}, state}).exitCode, 0); // compiles here
  const std::string here = application();
  fs::remove_all(scratch_.path() / "cache");
  const int port = freePort();
  const Server server(scratch_.path(), port);
  // Never here: whatever the server does not do fails.
  const ProcessResult result = build({{"DISTCC_HOSTS", "127.0.0.1:" + std::to_string(port)},
                                      {"DISTCC_FALLBACK", "0"},
                                      {"DISTCC_BACKOFF_PERIOD", "0"},
                                      state});
  ASSERT_EQ(result.exitCode, 0) << result.err << readFile(scratch_.path() / "server");
#ifndef __SANITIZE_ADDRESS__ // which writes the names of sources into objects
  EXPECT_TRUE(application() == here);
#endif
  EXPECT_THAT(readFile(scratch_.path() / "server"), HasSubstr("COMPILE_OK"));
}

} // namespace
} // namespace stride::test
