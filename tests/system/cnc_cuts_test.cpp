// `stride cnc reverse`, `split`, `expand`: where the text goes, and bad input.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CncCuts : public ::testing::Test {
protected:
  ProcessResult cnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &text) { writeFile(scratch_.path() / "a.cnc", text); }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }

  ScratchDirectory scratch_;
};

TEST_F(CncCuts, WritesToTheOutputOrAFileOrTheFile) {
  const std::string text = "N10 G0 X30 F50 (c)\nN20 G1 X50 H1 L5\nN30 G6 X60 Y0 I5 J5\n";
  write(text);
  EXPECT_EQ(cnc({"reverse", "a.cnc"}).out,
            "N10 G0 X60 F50 (c)\nN30 G6 X50 Y0 I-5 J5\nN20 G1 X30 H1 L-5\n");
  EXPECT_EQ(cnc({"split", "a.cnc", "--sentence", "20", "--at", "0.75", "-o", "b.cnc"}).out, "");
  EXPECT_EQ(read("b.cnc"), "N10 G0 X30 F50 (c)\nN20 G1 X45 H1 L5\nG1 X50\nN30 G6 X60 Y0 I5 J5\n");
  EXPECT_EQ(read("a.cnc"), text);
  EXPECT_EQ(cnc({"expand", "a.cnc", "--length", "6", "--in-place"}).exitCode, 0);
  EXPECT_EQ(read("a.cnc"), "N10 G0 X30 F50 (c)\nN20 G1 X50 H1 L5\nN30 G1 X55 Y2.5\nG1 X60 Y0\n");
  EXPECT_EQ(cnc({"split", "a.cnc", "--length", "10"}).out,
            "N10 G0 X30 F50 (c)\nN20 G1 X40 H1 L5\nG1 X50\nN30 G1 X55 Y2.5\nG1 X60 Y0\n");
  EXPECT_EQ(cnc({"expand", "b.cnc", "--angle", "54"}).out,
            "N10 G0 X30 F50 (c)\nN20 G1 X45 H1 L5\nG1 X50\nN30 G1 X55 Y2.5\nG1 X60 Y0\n");
  // These two lines turn by 53.13 degrees.
  EXPECT_THAT(cnc({"expand", "b.cnc", "--angle", "53"}).out, Not(HasSubstr("X55 Y2.5")));
}

TEST_F(CncCuts, APathBeginsWhereTheCommandSays) {
  write("G1 X30 F50\nX20\n");
  EXPECT_EQ(cnc({"reverse", "a.cnc", "--start", "X=5,P=1"}).out, "G0 X20 F50\nG1 X30\nG1 X5 F50\n");
}

TEST_F(CncCuts, DMeansWhatTheGenerationSays) {
  write("G0 X1 F1\nG41 D2\nG1 X9 D7\nG40\nX3\n");
  EXPECT_THAT(cnc({"reverse", "a.cnc", "--softmotion", "2.3"}).out, HasSubstr("X1 D7"));
  EXPECT_THAT(cnc({"reverse", "a.cnc", "--softmotion", "3"}).out, Not(HasSubstr("D7\nX1 D7")));
}

TEST_F(CncCuts, LeavesAFileAloneThatItCannotChange) {
  const std::string text = "N10 G0 X30 F50\nN20 G1 Y$a$\nN30 G5 X1 Y1\n";
  write(text);
  for (const std::vector<std::string> &action : {std::vector<std::string>{"reverse"},
                                                 {"split", "--sentence", "20"},
                                                 {"expand", "--angle", "5"}}) {
    std::vector<std::string> arguments = action;
    arguments.insert(arguments.end(), {"a.cnc", "--in-place"});
    const ProcessResult result = cnc(arguments);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("error[SE0892]"));
    EXPECT_THAT(result.err, HasSubstr("a.cnc:2:8"));
    EXPECT_THAT(result.err, HasSubstr("help"));
    EXPECT_EQ(read("a.cnc"), text);
  }
}

TEST_F(CncCuts, RefusesBadArguments) {
  write("G1 X1 F1\n");
  EXPECT_THAT(cnc({"split", "a.cnc"}).err, HasSubstr("--sentence or --length is required"));
  EXPECT_THAT(cnc({"expand", "a.cnc"}).err, HasSubstr("--length or --angle is required"));
  EXPECT_NE(cnc({"split", "a.cnc", "--sentence", "1", "--at", "0"}).exitCode, 0);
  EXPECT_NE(cnc({"split", "a.cnc", "--sentence", "1", "--at", "1"}).exitCode, 0);
  EXPECT_NE(cnc({"split", "a.cnc", "--at", "0.5"}).exitCode, 0);
  EXPECT_NE(cnc({"split", "a.cnc", "--length", "0"}).exitCode, 0);
  EXPECT_NE(cnc({"split", "a.cnc", "--length", "1", "--sentence", "1"}).exitCode, 0);
  EXPECT_NE(cnc({"expand", "a.cnc", "--length", "nan"}).exitCode, 0);
  EXPECT_NE(cnc({"expand", "a.cnc", "--angle", "181"}).exitCode, 0);
  EXPECT_NE(cnc({"expand", "a.cnc", "--angle", "1", "--length", "1"}).exitCode, 0);
  EXPECT_NE(cnc({"reverse", "a.cnc", "--start", "X"}).exitCode, 0);
  EXPECT_NE(cnc({"reverse", "none.cnc"}).exitCode, 0);
  EXPECT_NE(cnc({"reverse", "a.cnc", "-o", "a.cnc"}).exitCode, 0);
  // Path processors are not for edits.
  EXPECT_NE(cnc({"reverse", "a.cnc", "--preprocess", "smooth"}).exitCode, 0);
  EXPECT_EQ(read("a.cnc"), "G1 X1 F1\n");
}

} // namespace
} // namespace stride::test
