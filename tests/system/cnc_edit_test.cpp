// `stride cnc number`: where the program goes, and what is refused.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

class CncNumber : public ::testing::Test {
protected:
  ProcessResult number(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc", "number", "a.cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &text) { writeFile(scratch_.path() / "a.cnc", text); }
  std::string text(const char *name) { return readFile(scratch_.path() / name); }

  ScratchDirectory scratch_;
};

TEST_F(CncNumber, WritesWhereItIsTold) {
  const std::string before = "N1 G1 X30 F50 (c)\nN2 G20 L1 K0\n";
  const std::string after = "N5 G1 X30 F50 (c)\nN8 G20 L5 K0\n";
  write(before);
  ProcessResult result = number({"--first", "5", "--step", "3"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, after);
  EXPECT_EQ(text("a.cnc"), before);
  result = number({"--first", "5", "--step", "3", "-o", "b.cnc"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(text("b.cnc"), after);
  EXPECT_EQ(text("a.cnc"), before);
  EXPECT_EQ(number({"--first", "5", "--step", "3", "--in-place"}).exitCode, 0);
  EXPECT_EQ(text("a.cnc"), after);
}

TEST_F(CncNumber, WritesNothingWithErrors) {
  const std::string before = "N1 G1 X30 F50\nN2 G20 L$g_i$\n";
  write(before);
  for (const std::vector<std::string> &where :
       {std::vector<std::string>{}, {"-o", "b.cnc"}, {"--in-place"}}) {
    const ProcessResult result = number(where);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("error[SE0884]"));
    EXPECT_THAT(result.err, HasSubstr("a.cnc:2:8"));
  }
  EXPECT_EQ(text("a.cnc"), before);
}

TEST_F(CncNumber, RefusesWrongOptionsAndFiles) {
  EXPECT_NE(number({}).exitCode, 0) << "no such file";
  write("G1 X1 F1\n");
  EXPECT_NE(number({"--step", "0"}).exitCode, 0);
  EXPECT_NE(number({"--step", "1.5"}).exitCode, 0);
  EXPECT_NE(number({"--first", "-1"}).exitCode, 0);
  EXPECT_NE(number({"--first", "2147483648"}).exitCode, 0);
  EXPECT_NE(number({"--in-place", "-o", "b.cnc"}).exitCode, 0);
  EXPECT_NE(number({"-o", "./a.cnc"}).exitCode, 0) << "the program itself";
  EXPECT_NE(number({"-o", "a.cnc/b.cnc"}).exitCode, 0);
  EXPECT_EQ(text("a.cnc"), "G1 X1 F1\n");
}

} // namespace
} // namespace stride::test
