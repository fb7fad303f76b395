// `stride cnc rotate`, `shift`, `scale`, `mirror`: where the text goes, and bad input.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

class CncMoves : public ::testing::Test {
protected:
  ProcessResult cnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &text) { writeFile(scratch_.path() / "a.cnc", text); }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }

  ScratchDirectory scratch_;
};

TEST_F(CncMoves, WritesToTheOutputOrAFileOrTheFile) {
  const std::string text = "N10 G1 X30 F50 (c)\nN20 Y20\n";
  write(text);
  EXPECT_EQ(cnc({"mirror", "a.cnc", "--at", "X=2"}).out, "N10 G1 X-26 F50 (c)\nN20 Y20\n");
  EXPECT_EQ(cnc({"scale", "a.cnc", "--factor", "0.5", "--about", "X=10", "-o", "b.cnc"}).out, "");
  EXPECT_EQ(read("b.cnc"), "N10 G1 X20 F50 (c)\nN20 Y10\n");
  EXPECT_EQ(read("a.cnc"), text);
  EXPECT_EQ(cnc({"shift", "a.cnc", "--by", "Y=1,P=2", "--in-place"}).exitCode, 0);
  EXPECT_EQ(read("a.cnc"), "N10 G1 X30 Y1 P2 F50 (c)\nN20 Y21\n");
}

TEST_F(CncMoves, LeavesAFileAloneThatItCannotChange) {
  const std::string text = "N10 G1 X30 F50\nN20 Y$a$\n";
  write(text);
  const ProcessResult result = cnc({"rotate", "a.cnc", "--angle", "90", "--in-place"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("error[SE0892]"));
  EXPECT_THAT(result.err, HasSubstr("a.cnc:2:5"));
  EXPECT_THAT(result.err, HasSubstr("help"));
  EXPECT_EQ(read("a.cnc"), text);
}

TEST_F(CncMoves, RefusesBadArguments) {
  write("G1 X1 F1\n");
  EXPECT_NE(cnc({"rotate", "a.cnc"}).exitCode, 0);
  EXPECT_NE(cnc({"rotate", "a.cnc", "--angle", "nan"}).exitCode, 0);
  EXPECT_NE(cnc({"rotate", "a.cnc", "--angle", "1", "--about", "Z=1"}).exitCode, 0);
  EXPECT_NE(cnc({"scale", "a.cnc", "--factor", "0"}).exitCode, 0);
  EXPECT_NE(cnc({"mirror", "a.cnc", "--at", "A=0"}).exitCode, 0);
  EXPECT_NE(cnc({"mirror", "a.cnc", "--at", "X=0,Y=0"}).exitCode, 0);
  EXPECT_NE(cnc({"shift", "a.cnc", "--by", "X=1", "-o", "b", "--in-place"}).exitCode, 0);
  EXPECT_NE(cnc({"shift", "none.cnc", "--by", "X=1"}).exitCode, 0);
  EXPECT_NE(cnc({"shift", "a.cnc", "--by", "X=1", "-o", "a.cnc/b.cnc"}).exitCode, 0);
  EXPECT_EQ(read("a.cnc"), "G1 X1 F1\n");
}

} // namespace
} // namespace stride::test
