// A drive's file with parameters: it is read again when the drive begins anew.
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace stride::can {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class FileOfADrive : public test::CanBusTest, public ::testing::WithParamInterface<bus::BusKind> {
protected:
  FileOfADrive()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ("can_file_" + std::to_string(static_cast<int>(GetParam())))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    setup.kind = GetParam();
    setup.files = folder_.string();
    addDrive(3).add({"parameters", "x.txt", 0});
    addDrive(4);
  }
  ~FileOfADrive() override { std::filesystem::remove_all(folder_); }

  void says(const std::string &text) { std::ofstream(folder_ / "x.txt") << text; }
  void begin(size_t index) {
    driver->reset(index);
    started[index] = false;
    message.set();
    nodes[index].written.clear();
  }
  /// Until the drive has started or cannot: a thread has its time for the file.
  void await(size_t index) {
    for (int i = 0; i < 4000 && !started[index] && message.text().empty(); ++i) {
      cycle();
      if (GetParam() == bus::BusKind::Real)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  std::filesystem::path folder_;
};

TEST_P(FileOfADrive, IsReadAgainWhenItBeginsAnew) {
  says("drive;3;\n6324992;500;\n"); // 6083h
  start();
  EXPECT_THAT(nodes[0].written, Contains("6083:0/4=1F4"));
  says("drive;3;\n6324992;620;\n6325248;7;\n"); // and 6084h
  begin(0);
  await(0);
  ASSERT_TRUE(started[0]) << message.text();
  EXPECT_THAT(nodes[0].written, Contains("6083:0/4=26C"));
  EXPECT_THAT(nodes[0].written, Contains("6084:0/4=7"));
  EXPECT_TRUE(communicates(1)) << "the other one goes on";
}

TEST_P(FileOfADrive, MayComeLater) {
  start();
  EXPECT_THAT(nodes[0].written, Not(Contains(HasSubstr("6083"))));
  says("drive;3;\n6324992;620;\n");
  begin(0);
  await(0);
  ASSERT_TRUE(started[0]) << message.text();
  EXPECT_THAT(nodes[0].written, Contains("6083:0/4=26C"));
  // And go: then it is said.
  host.news.clear();
  std::filesystem::remove(folder_ / "x.txt");
  begin(0);
  await(0);
  ASSERT_TRUE(started[0]) << message.text();
  EXPECT_TRUE(host.heard("there is no file 'x.txt' with its parameters"));
}

TEST_P(FileOfADrive, ThatIsWrongKeepsItFromStartingUntilItIsRight) {
  says("drive;3;\n6324992;500;\n");
  start();
  says("drive;3;\nabc;500;\n");
  begin(0);
  await(0);
  EXPECT_FALSE(started[0]);
  EXPECT_THAT(std::string(message.text()), HasSubstr("line 2"));
  says("drive;3;\n6324992;501;\n");
  begin(0);
  await(0);
  EXPECT_TRUE(started[0]) << message.text();
  EXPECT_THAT(nodes[0].written, Contains("6083:0/4=1F5"));
}

/// A drive that is not reset keeps what it has, whatever its file says now.
TEST_P(FileOfADrive, IsNoMatterOfDrivesInOperation) {
  says("drive;3;\n6324992;500;\n");
  start();
  says("drive;3;\nabc\n");
  begin(1);
  await(1);
  EXPECT_TRUE(started[1]) << message.text();
  EXPECT_TRUE(communicates(0));
}

INSTANTIATE_TEST_SUITE_P(Kinds, FileOfADrive,
                         ::testing::Values(bus::BusKind::Simulated, bus::BusKind::Real));

} // namespace
} // namespace stride::can
