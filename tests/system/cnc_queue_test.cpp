// `stride cnc queue`: the bytes of the file, and what it refuses. The golden project cnc_compile
// reads such a file.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

constexpr size_t kHeader = 112;
constexpr size_t kObject = 872;

class CncQueue : public ::testing::Test {
protected:
  ProcessResult queue(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc", "queue", "a.cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &text) { writeFile(scratch_.path() / "a.cnc", text); }
  std::string bytes() { return readFile(scratch_.path() / "a.queue"); }

  template <class Value> static Value at(const std::string &bytes, size_t offset) {
    Value value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  }

  ScratchDirectory scratch_;
};

TEST_F(CncQueue, WritesHeaderObjectsAndChecksum) {
  write("% name of it\nN10 G1 X30 F50\nN20 Y20\n/N30 X7\nN40 M7\n");
  const ProcessResult result = queue({"-o", "a.queue"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "a.queue: 4 objects, 3488 bytes of memory for SMC_ReadNCQueue\n");
  const std::string file = bytes();
  ASSERT_EQ(file.size(), kHeader + 4 * kObject + 4);
  EXPECT_EQ(file.substr(0, 8), std::string("\x89"
                                           "CNQ\r\n\x1A\n"));
  EXPECT_EQ(at<uint16_t>(file, 8), 2) << "version";
  EXPECT_EQ(at<uint8_t>(file, 10), 255) << "made by the compiler";
  EXPECT_EQ(at<uint32_t>(file, 12), kObject);
  EXPECT_EQ(at<uint32_t>(file, 16), 4U);
  EXPECT_STREQ(file.c_str() + 24, "name of it");
  EXPECT_EQ(at<int32_t>(file, kHeader + 4), 10) << "N of the first object";
  EXPECT_EQ(at<int32_t>(file, kHeader + 3 * kObject + 4), 40);
}

TEST_F(CncQueue, LeavesOutWhatIsSuppressed) {
  write("N10 G1 X30 F50\n/N20 X7\nN40 M7\n");
  EXPECT_EQ(queue({"-o", "a.queue", "--step-suppress"}).exitCode, 0);
  EXPECT_EQ(at<uint32_t>(bytes(), 16), 2U);
}

TEST_F(CncQueue, RefusesWhatHasNoEndOrNoVelocity) {
  write("N10 G1 X30 F50\nN20 G20 L10 K1\n");
  ProcessResult result = queue({"-o", "a.queue"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("the jumps of this program do not end"));
  write("N10 G1 X30\n");
  result = queue({"-o", "a.queue"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("moves with velocity 0"));
  EXPECT_EQ(queue({"-o", "a.queue", "--velocity", "0.5"}).exitCode, 0);
  write("N10 G7\n");
  EXPECT_EQ(queue({"-o", "a.queue"}).exitCode, 1);
}

// Factors of coordinates are SoftMotion 3's: the project of the file decides, or the command.
TEST_F(CncQueue, ReadsWordsAsTheProjectDoes) {
  write("N10 G54 I2 J2 K2\nN20 G1 X10 F50\n");
  const auto length = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc", "info", "a.cnc"});
    const std::string text = runProcess(arguments, scratch_.path()).out;
    const size_t at = text.find("length");
    return at == std::string::npos ? text : text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(length({}), "length      10");
  EXPECT_EQ(length({"--softmotion", "3"}), "length      20");
  writeFile(scratch_.path() / "stride.toml", "[project]\nsoftmotion = \"3\"\n");
  EXPECT_EQ(length({}), "length      20");
  EXPECT_EQ(length({"--softmotion", "2.3"}), "length      10");
  const auto check = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc", "check", "a.cnc"});
    return runProcess(arguments, scratch_.path()).err;
  };
  EXPECT_EQ(check({}), "");
  EXPECT_THAT(check({"--softmotion", "2.3"}), HasSubstr("SE0886"));
  write("N10 G54 I2 J3 K2\nN20 G3 X10 R5 F50\n");
  EXPECT_THAT(check({}), HasSubstr("X, Y and Z are scaled by different factors"));
}

// Files that programs become come into the folder that a run is given, too.
TEST_F(CncQueue, MakesFilesInTheFolderOfTheRun) {
  write("N10 G1 X30 F50\n");
  writeFile(scratch_.path() / "Main.st", "PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\nn := n + 1;\n"
                                         "END_PROGRAM\n");
  writeFile(scratch_.path() / "stride.toml",
            "[[cnc]]\nfile = \"a.cnc\"\ncompile = \"queue-file\"\n");
  const ProcessResult run = runProcess({std::string(STRIDE_BINARY_DIR) + "/stride", "sim", "--for",
                                        "T#20ms", "--files", "elsewhere"},
                                       scratch_.path());
  EXPECT_EQ(run.exitCode, 0) << run.err;
  const std::string made = readFile(scratch_.path() / "elsewhere/cnc/a.queue");
  ASSERT_GT(made.size(), kHeader);
  EXPECT_EQ(made, readFile(scratch_.path() / "files/cnc/a.queue"));
}

TEST_F(CncQueue, RefusesWrongOptions) {
  write("N10 G1 X30 F50\n");
  EXPECT_NE(queue({}).exitCode, 0) << "no -o";
  EXPECT_NE(queue({"-o", "a.queue", "--start", "T=5"}).exitCode, 0);
  EXPECT_NE(queue({"-o", "a.queue", "--start", "X="}).exitCode, 0);
  EXPECT_NE(queue({"-o", "a.queue", "--angle-tolerance", "180.1"}).exitCode, 0);
  EXPECT_NE(queue({"-o", "a.queue", "--deceleration", "0"}).exitCode, 0);
  EXPECT_EQ(queue({"-o", "a.queue", "--start", "X=-5,W=2", "--angle-tolerance", "180"}).exitCode,
            0);
  EXPECT_NE(queue({"-o", "a.cnc/a.queue"}).exitCode, 0);
  EXPECT_NE(queue({"-o", "./a.cnc"}).exitCode, 0) << "the program itself";
}

/// What [[cnc]] of the project says is what options say, and options say more.
TEST_F(CncQueue, ReadsTheSectionOfTheProject) {
  const std::string text = "N10 G41 D0\nN20 G1 X30\n/N30 X40\nN40 Y20\nN50 G40\nN60 G0 X50\n";
  const std::string section =
      "[[cnc]]\nfile = \"parts/../a.cnc\"\ncompile = \"queue\"\ndefault_velocity = 40\n"
      "default_acceleration = 300\ndefault_deceleration = 200\nangle_tolerance = 100\n"
      "preprocess = [\"tool\"]\ntool_radius = 2\nstep_suppress = true\nstart = { X = 5, Q = 1 }\n";
  write(text);
  const std::vector<std::string> all = {"-o",
                                        "a.queue",
                                        "--velocity",
                                        "40",
                                        "--acceleration",
                                        "300",
                                        "--deceleration",
                                        "200",
                                        "--angle-tolerance",
                                        "100",
                                        "--preprocess",
                                        "tool",
                                        "--tool-radius",
                                        "2",
                                        "--step-suppress",
                                        "--start",
                                        "X=5,Q=1"};
  ASSERT_EQ(queue(all).exitCode, 0);
  const std::string said = bytes();
  ASSERT_EQ(queue({"-o", "a.queue", "--velocity", "7", "--start", "X=1"}).exitCode, 0);
  const std::string plain = bytes();
  EXPECT_NE(said, plain);
  writeFile(scratch_.path() / "stride.toml", section);
  ASSERT_EQ(queue({"-o", "a.queue"}).exitCode, 0);
  EXPECT_EQ(bytes(), said);
  ASSERT_EQ(queue(all).exitCode, 0);
  EXPECT_EQ(bytes(), said);
  ASSERT_EQ(queue({"-o", "a.queue", "--preprocess", "none", "--start", "X=1", "--velocity", "9"})
                .exitCode,
            0);
  EXPECT_EQ(at<uint32_t>(bytes(), 16), 3U) << "neither N30 nor a positioning of the tool";
  // Another file of the project.
  std::string other = section;
  other.replace(other.find("a.cnc"), 5, "b.cnc");
  writeFile(scratch_.path() / "stride.toml", other);
  ASSERT_EQ(queue({"-o", "a.queue", "--velocity", "7", "--start", "X=1"}).exitCode, 0);
  EXPECT_EQ(bytes(), plain);
}

} // namespace
} // namespace stride::test
