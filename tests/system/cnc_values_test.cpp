// `--set NAME=VALUE` of `stride cnc`: values of the variables of programs without an application.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::HasSubstr;

class CncValues : public ::testing::Test {
protected:
  ProcessResult cnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &name, const std::string &text) {
    writeFile(scratch_.path() / name, text);
  }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }

  ScratchDirectory scratch_;
};

/// A program of G-code, which changes one of its variables.
constexpr const char *kPlain =
    "N10 G1 X$g_rWidth$ F50\nN20 G36 O$iCount$ D3\nN30 G37 O$Start$ D2\nN40 Y$iCount$ Z$Start$\n";

TEST_F(CncValues, AreThoseOfThePath) {
  write("a.cnc", kPlain);
  const ProcessResult result =
      cnc({"info", "a.cnc", "--set", "G_RWIDTH=-7.5", "--set", "Start=1e1"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("X           -7.5 … 0\n"));
  EXPECT_THAT(result.out, HasSubstr("Y           0 … 3\n"));
  EXPECT_THAT(result.out, HasSubstr("Z           0 … 12\n")); // added to what was set
  EXPECT_THAT(cnc({"info", "a.cnc"}).out, HasSubstr("X           0 … 0\n")) << "else 0";
}

TEST_F(CncValues, CountForEachCommand) {
  write("a.cnc", "N10 G1 X$w$ F50\n");
  for (const char *command : {"check", "info", "run", "plot"})
    EXPECT_EQ(cnc({command, "a.cnc", "--set", "w=4"}).exitCode, 0) << command;
  EXPECT_THAT(read("a.csv"), HasSubstr("\n"));
  EXPECT_EQ(read("a.csv")
                    .substr(read("a.csv").find_last_of('\n', read("a.csv").size() - 2))
                    .find(",4,") != std::string::npos,
            true);
  EXPECT_EQ(cnc({"queue", "a.cnc", "-o", "a.queue", "--set", "w=4"}).exitCode, 0);
  for (const char *command : {"format", "number"})
    EXPECT_NE(cnc({command, "a.cnc", "--set", "w=4"}).exitCode, 0) << command;
}

TEST_F(CncValues, MakeChecksCertain) {
  write("a.cnc", "N10 G1 X1 F$f$\nN20 M$m$\n");
  EXPECT_EQ(cnc({"check", "a.cnc"}).exitCode, 0);
  EXPECT_EQ(cnc({"check", "a.cnc", "--set", "f=5", "--set", "m=7"}).exitCode, 0);
  const ProcessResult result = cnc({"check", "a.cnc", "--set", "f=5", "--set", "m=7.5"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("a.cnc:2:5"));
}

TEST_F(CncValues, HaveTheTypeThatExpressionsNeed) {
  write("a.cnc", "N10 G1 X{$w$ * 2} F50\nN20 DYNCALL{$Sub$, $on$}\n");
  write("part.cnc", "SUBPROGRAM Part{#b : BOOL}\nN10 G20 L?1 K #b\nN20 G1 Y9\nN30 L!1 G1 Z$deep$\n"
                    "END_SUBPROGRAM\n");
  const auto with = [this](const char *on) {
    return cnc({"info", "a.cnc", "--set", "w=2.5", "--set", "Sub=Part", "--set",
                std::string("on=") + on, "--set", "DEEP=-1"});
  };
  const ProcessResult leaps = with("TRUE");
  EXPECT_EQ(leaps.exitCode, 0) << leaps.err;
  EXPECT_THAT(leaps.out, HasSubstr("X           0 … 5\n"));
  EXPECT_THAT(leaps.out, HasSubstr("Z           -1 … 0\n"));
  EXPECT_THAT(leaps.out, HasSubstr("Y           0 … 0\n"));
  EXPECT_THAT(with("false").out, HasSubstr("Y           0 … 9\n"));
  EXPECT_EQ(with("'TRUE'").exitCode, 1) << "a text";
}

TEST_F(CncValues, MustBeOfVariablesThatThereAre) {
  write("a.cnc", kPlain);
  const ProcessResult near = cnc({"run", "a.cnc", "--set", "g_rWdth=1"});
  EXPECT_EQ(near.exitCode, 1);
  EXPECT_THAT(near.err, HasSubstr("no variable `g_rWdth`: did you mean `g_rWidth`?"));
  EXPECT_EQ(runProcess({"ls"}, scratch_.path()).out, "a.cnc\n") << "no table";
  EXPECT_THAT(cnc({"info", "a.cnc", "--set", "depth=1"}).err,
              HasSubstr("it has g_rWidth, iCount, Start"));
  write("b.cnc", "N10 G1 X1 F50\n");
  EXPECT_THAT(cnc({"queue", "b.cnc", "-o", "b.queue", "--set", "a=1"}).err,
              HasSubstr("it has none"));
  EXPECT_EQ(cnc({"info", "a.cnc", "b.cnc", "--set", "iCount=1"}).exitCode, 0) << "one has it";
}

TEST_F(CncValues, MustFit) {
  write("a.cnc", "N10 G1 X$w$ F50\nN20 M7 O$mp$\n");
  for (const char *bad : {"w", "=1", "w=", "w=one", "w=nan", "w=inf", "w=TRUE", "w='1'", "mp=1"})
    EXPECT_NE(cnc({"info", "a.cnc", "--set", bad}).exitCode, 0) << bad;
  EXPECT_NE(cnc({"info", "a.cnc", "--set", "w=1", "--set", "W=2"}).exitCode, 0) << "twice";
  EXPECT_THAT(cnc({"info", "a.cnc", "--set", "w=one"}).err, HasSubstr("error[SE0883]"));
  EXPECT_THAT(cnc({"info", "a.cnc", "--set", "w=one"}).err, HasSubstr("a.cnc:1:8"));
  EXPECT_EQ(cnc({"info", "a.cnc", "--set", "w=+1"}).exitCode, 0);
}

} // namespace
} // namespace stride::test
