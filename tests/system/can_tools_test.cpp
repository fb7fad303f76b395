// `stride can`, where there is no bus: what reaches the tool, and what it refuses.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class CanTools : public ::testing::Test {
protected:
  CanTools() {
    fs::create_directories(project());
    writeFile(project() / "stride.toml", R"toml([project]
name = "Axes"
[[task]]
name = "Fast"
interval = "T#2ms"
programs = ["Main"]
[[bus]]
name = "Bus"
InterfaceType = "CAN (SocketCAN)"
[[bus.axis_group]]
name = "Group"
sTask = "Fast"
[[bus.axis_group.drive]]
name = "X"
wDriveId = 1
)toml");
    writeFile(project() / "Main.st", "PROGRAM Main\nEND_PROGRAM\n");
  }
  fs::path cache() const { return scratch_.path() / "cache"; }
  fs::path project() const { return scratch_.path() / "project"; }
  ProcessResult can(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "can"});
    return runProcess(arguments, scratch_.path(), {{"XDG_CACHE_HOME", cache().string()}});
  }

  ScratchDirectory scratch_;
};

TEST_F(CanTools, MonitorBuildsTheProjectAndThenLooksForTheInterface) {
  const ProcessResult result = can({"monitor", "nobus7", "--project", "project", "--count", "3"});
  EXPECT_EQ(result.exitCode, 1) << result.out;
  EXPECT_THAT(result.err, HasSubstr("nobus7"));
  EXPECT_TRUE(fs::exists(cache())) << "its PDOs come from the built application";
}

TEST_F(CanTools, MonitorOfAProjectWithErrorsShowsThem) {
  writeFile(project() / "Main.st", "PROGRAM Main\nn := 1;\nEND_PROGRAM\n");
  const ProcessResult result = can({"monitor", "nobus7", "--project", "project"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("Main.st:2:1"));
  EXPECT_THAT(result.err, Not(HasSubstr("nobus7")));
}

TEST_F(CanTools, MonitorWithoutAProjectLooksForTheInterface) {
  const ProcessResult result = can({"monitor", "nobus7"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("nobus7"));
  EXPECT_FALSE(fs::exists(cache())) << "nothing is built";
}

TEST_F(CanTools, WhatChangesANodeMustBeAskedForTwice) {
  const ProcessResult set = can({"lss", "nobus7", "--set", "5"});
  EXPECT_EQ(set.exitCode, 1);
  EXPECT_THAT(set.err, HasSubstr("add --write"));
  EXPECT_THAT(can({"lss", "nobus7", "--set", "5", "--write"}).err, HasSubstr("nobus7"));
  EXPECT_EQ(can({"lss", "nobus7", "--set", "128", "--write"}).exitCode, 1);
  EXPECT_EQ(can({"lss", "nobus7", "--identity", "1", "2", "3"}).exitCode, 1);
}

} // namespace
} // namespace stride::test
