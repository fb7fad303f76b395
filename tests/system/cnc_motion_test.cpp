// `stride cnc run` and `stride cnc plot`: what a G-code file alone gives.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char *kCorner = "% corner\n"
                                "N10 G17\n"
                                "N20 G1 X30 F50 E400 E-300\n"
                                "N30 Y20\n"
                                "N40 M7 K2\n"
                                "N50 G4 T0.25\n"
                                "N60 X10 A12\n";

/// A table that was written, by column.
struct Table {
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;

  explicit Table(const std::string &text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    std::istringstream head(line);
    for (std::string name; std::getline(head, name, ',');)
      names.push_back(name);
    while (std::getline(lines, line)) {
      std::istringstream row(line);
      std::string cell;
      for (const std::string &name : names) {
        std::getline(row, cell, ',');
        columns[name].push_back(std::stod(cell));
      }
    }
  }
};

class CncMotion : public ::testing::Test {
protected:
  ProcessResult cnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "cnc"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &text) { writeFile(scratch_.path() / "a.cnc", text); }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }

  ScratchDirectory scratch_;
};

TEST_F(CncMotion, WritesTheSetPositionsOfEachCycle) {
  write(kCorner);
  const ProcessResult result = cnc({"run", "a.cnc", "--cycle", "2ms"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const Table table(read("a.csv"));
  EXPECT_THAT(table.names,
              ElementsAre("t", "X", "Y", "Z", "A", "velocity", "acceleration", "way", "line"));
  const auto &t = table.columns.at("t");
  for (size_t i = 1; i < t.size(); ++i)
    ASSERT_NEAR(t[i] - t[i - 1], 0.002, 1e-9);
  EXPECT_EQ(table.columns.at("X").back(), 10);
  EXPECT_EQ(table.columns.at("Y").back(), 20);
  EXPECT_EQ(table.columns.at("A").back(), 12);
  EXPECT_NEAR(table.columns.at("way").back(), 70, 1e-9);
  // Three motions of 30, 20 and 20 u from rest to rest, and a quarter of a second.
  const double ramps = 50.0 / 400 + 50.0 / 300;
  const double time = 70 / 50.0 + 3 * ramps / 2 + 0.25;
  EXPECT_NEAR(t.back(), time, 0.05);
  EXPECT_THAT(result.out, AllOf(HasSubstr("length        70\n"), HasSubstr("stops         2\n"),
                                HasSubstr("velocity      50\n"), HasSubstr("acceleration  400\n"),
                                HasSubstr("  A             velocity"), Not(HasSubstr("jerk"))));
}

TEST_F(CncMotion, BlendsCornersWithinTheTolerance) {
  write("% corner\nG17 G1 X30 F50 E400 E-400\nY20\n");
  ASSERT_EQ(cnc({"run", "a.cnc"}).exitCode, 1) << "two functions in a sentence";
  write("% corner\nG17\nG1 X30 F50 E400 E-400\nY20\n");
  const Table sharp((cnc({"run", "a.cnc", "-o", "sharp.csv"}), read("sharp.csv")));
  const ProcessResult result =
      cnc({"run", "a.cnc", "--blend", "0.3", "--max-acceleration", "X=400,Y=400"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1 of them blends"), HasSubstr("stops         0\n"),
                                HasSubstr("(limit 400)")));
  const Table round(read("a.csv"));
  EXPECT_LT(round.columns.at("t").back(), sharp.columns.at("t").back() - 0.02);
  double nearest = 100;
  for (size_t i = 0; i < round.columns.at("t").size(); ++i)
    nearest =
        std::min(nearest, std::hypot(round.columns.at("X")[i] - 30, round.columns.at("Y")[i]));
  EXPECT_NEAR(nearest, 0.3, 0.02);
  EXPECT_EQ(round.columns.at("Y").back(), 20);
}

/// Three words that differ in a digit: the last one would be driven until memory is used up.
TEST_F(CncMotion, RefusesWhatTakesTooLong) {
  const std::string head = "% long\nG1 F10 E400 E-400 X";
  const auto words = HasSubstr("the path takes 3.1e+07 cycles at least: more than 30000000");
  write(head + "310000\n");
  const ProcessResult longer = cnc({"run", "a.cnc"});
  EXPECT_EQ(longer.exitCode, 1);
  EXPECT_THAT(longer.err, AllOf(HasSubstr("SE0882"), words));
  EXPECT_THAT(cnc({"plot", "a.cnc"}).err, words);
  EXPECT_EQ(cnc({"run", "a.cnc", "--cycle", "1s"}).exitCode, 0) << "31000 cycles";
  write(head + "31000000000000000000\n");
  EXPECT_EQ(cnc({"run", "a.cnc"}).exitCode, 1);
}

/// A dwell takes cycles as a motion does.
TEST_F(CncMotion, RefusesDwellsOfDays) {
  write("% dwell\nG4 T30001\nG1 X1 F10 E400 E-400\n");
  const auto words = HasSubstr("the path takes 3.00011e+07 cycles at least: more than 30000000");
  EXPECT_THAT(cnc({"run", "a.cnc"}).err, AllOf(HasSubstr("SE0882"), words));
  EXPECT_THAT(cnc({"plot", "a.cnc"}).err, words);
  EXPECT_EQ(cnc({"run", "a.cnc", "--cycle", "1s"}).exitCode, 0) << "30001 cycles";
  write("% dwells\nG1 X1 F10 E400 E-400\nG4 T20000\nG1 X2\nG4 T20000\n");
  EXPECT_EQ(cnc({"run", "a.cnc"}).exitCode, 1) << "both together";
}

TEST_F(CncMotion, SaysThatAProgramIsEmpty) {
  for (const char *const text : {"", "\n\n", "% title\n", "(a comment)\n"}) {
    write(text);
    const ProcessResult result = cnc({"check", "a.cnc"});
    EXPECT_EQ(result.exitCode, 0) << "a warning";
    EXPECT_THAT(result.err, AllOf(HasSubstr("SE0886"), HasSubstr("no sentence"))) << text;
  }
  write("SUBPROGRAM Drill{#x : LREAL}\nN10 G0 X#x\nEND_SUBPROGRAM\n");
  EXPECT_EQ(cnc({"check", "a.cnc"}).err, "") << "called by others";
}

TEST_F(CncMotion, MergesLines) {
  std::string text = "% circle\nG17\nG1 X20 F50 E400 E-400\n";
  for (int i = 1; i <= 360; ++i)
    text += "X" + std::to_string(20 * std::cos(i * M_PI / 180)) + " Y" +
            std::to_string(20 * std::sin(i * M_PI / 180)) + "\n";
  write(text);
  const ProcessResult result = cnc({"run", "a.cnc", "--merge", "0.01", "--blend", "0.01"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("361 of the program, "));
  const Table table(read("a.csv"));
  for (size_t i = 0; i < table.columns.at("t").size(); ++i)
    if (table.columns.at("way")[i] > 20.5) {
      ASSERT_NEAR(std::hypot(table.columns.at("X")[i], table.columns.at("Y")[i]), 20, 0.025);
    }
}

TEST_F(CncMotion, KeepsTheJerkAndTheOverride) {
  write("% line\nG17\nG1 X100 F50 E400 E-400\n");
  const ProcessResult result =
      cnc({"run", "a.cnc", "--velocity-mode", "quadratic", "--jerk", "5000", "--feed", "0.5"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("velocity      25\n"), HasSubstr("(limit 5000)")));
  const Table table(read("a.csv"));
  const auto &way = table.columns.at("way");
  for (size_t i = 3; i < way.size(); ++i)
    ASSERT_LT(std::fabs(way[i] - 3 * way[i - 1] + 3 * way[i - 2] - way[i - 3]), 5000 * 1.001e-9);
}

TEST_F(CncMotion, TakesVelocitiesThatTheProgramLeavesOut) {
  write("% line\nG1 X100\n");
  const ProcessResult without = cnc({"run", "a.cnc"});
  EXPECT_EQ(without.exitCode, 1);
  EXPECT_THAT(without.err, AllOf(HasSubstr("velocity 0"), HasSubstr("--velocity")));
  const ProcessResult with = cnc({"run", "a.cnc", "--velocity", "40", "--acceleration", "900"});
  EXPECT_EQ(with.exitCode, 0) << with.err;
  EXPECT_THAT(with.out, AllOf(HasSubstr("velocity      40\n"), HasSubstr("acceleration  900\n")));
}

TEST_F(CncMotion, SaysWhatIsWrong) {
  const auto error = [this](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", "a.cnc"});
    const ProcessResult result = cnc(arguments);
    EXPECT_EQ(result.exitCode, 1);
    return result.err;
  };
  write("% x\nG1 X5 F9\n");
  EXPECT_THAT(error({"--velocity-mode", "quadratic"}), HasSubstr("needs a --jerk"));
  EXPECT_THAT(error({"--velocity-mode", "cubic"}), HasSubstr("cubic"));
  EXPECT_THAT(error({"--max-velocity", "K=3"}), HasSubstr("`K=3` is no limit of an axis"));
  EXPECT_THAT(error({"--max-acceleration", "X=3,Y"}), HasSubstr("`Y` is no limit"));
  EXPECT_THAT(error({"--cycle", "2s"}), HasSubstr("2s"));
  EXPECT_THAT(error({"--feed", "0"}), HasSubstr("`0` is no number"));
  EXPECT_THAT(error({"-o", "a.cnc/a.csv"}), HasSubstr("cannot be written"));
  EXPECT_THAT(error({"-o", "../" + scratch_.path().filename().string() + "/a.cnc"}),
              AllOf(HasSubstr("SE0833"), HasSubstr("is the program")));
  EXPECT_EQ(read("a.cnc"), "% x\nG1 X5 F9\n");
  write("% x\nN10 G1 X5 F9\nN20 G20 L10 K1\n");
  EXPECT_THAT(error({}), HasSubstr("do not end"));
  write("% x\nG1 X5 F9 J\n");
  EXPECT_THAT(error({}), HasSubstr("SE0880"));
}

TEST_F(CncMotion, BearsProgramsInWhichNothingMoves) {
  for (const char *text : {"", "% nothing\n", "% waits\nM3\nG4 T1\n"}) {
    SCOPED_TRACE(text);
    write(text);
    const ProcessResult run = cnc({"run", "a.cnc"});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("duration      0 s\n"));
    const ProcessResult plot = cnc({"plot", "a.cnc"});
    EXPECT_EQ(plot.exitCode, 1);
    EXPECT_THAT(plot.err, HasSubstr("nothing moves"));
  }
}

TEST_F(CncMotion, RefusesFilesThatAreNoPrograms) {
  std::string lines;
  for (int i = 0; i < 300'000; ++i)
    lines += "N" + std::to_string(i) + " G1 X" + std::to_string(i % 1000) +
             " F5 (a comment of a post-processor, with its date)\n";
  write(lines); // more bytes than ST may have
  EXPECT_EQ(cnc({"check", "a.cnc"}).exitCode, 0);
  const auto error = [this] {
    for (const char *command : {"check", "format", "plot", "run"})
      EXPECT_EQ(cnc({command, "a.cnc"}).exitCode, 1) << command;
    return cnc({"info", "a.cnc"}).err;
  };
  std::filesystem::resize_file(scratch_.path() / "a.cnc", (64U << 20U) + 1);
  EXPECT_THAT(error(), HasSubstr("longer than 64 MiB"));
  for (const std::string &bytes : {std::string("\x7f"
                                               "ELF\x02\x01\x01\0\0",
                                               9),
                                   std::string("G1 X1 F9\0Y2\n", 12), std::string("G\0001\0", 4)}) {
    writeFile(scratch_.path() / "a.cnc", bytes);
    EXPECT_THAT(error(), HasSubstr("error[SE0880]"));
  }
  std::filesystem::remove(scratch_.path() / "a.cnc");
  EXPECT_THAT(error(), HasSubstr("No such file"));
  ASSERT_EQ(mkfifo((scratch_.path() / "a.cnc").c_str(), 0600), 0);
  EXPECT_THAT(error(), HasSubstr("not a regular file"));
  std::filesystem::remove(scratch_.path() / "a.cnc");
  std::filesystem::create_directory(scratch_.path() / "a.cnc");
  EXPECT_THAT(error(), HasSubstr("Is a directory"));
}

TEST_F(CncMotion, CarriesExpressionsAndSubprogramsOut) {
  writeFile(scratch_.path() / "leg.cnc", "SUBPROGRAM Leg{#x : LREAL, #up : BOOL}\n"
                                         "N1 G20 L?1 K NOT #up\n"
                                         "N2 G1 Z#x / 2\n"
                                         "N3 L!1 G1 X#x\n"
                                         "END_SUBPROGRAM\n");
  write("% legs\nLET #i : LREAL := 2\nN5 F100\nN10 LEG{#i * 10, #i > 2}\nN20 G36 O#i D#i + 1\n"
        "N30 G20 L10 K #i < 4 AND $on$ = 0\n");
  const ProcessResult info = cnc({"info", "a.cnc", "leg.cnc"});
  EXPECT_EQ(info.exitCode, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("a.cnc: legs"), HasSubstr("objects     3"),
                              HasSubstr("X           0 … 30"), HasSubstr("Z           0 … 15")));
  EXPECT_EQ(cnc({"check", "a.cnc", "leg.cnc"}).exitCode, 0);
  EXPECT_THAT(cnc({"run", "a.cnc"}).out, HasSubstr("objects       3 of the program"));
  EXPECT_NE(cnc({"format", "a.cnc"}).exitCode, 0);
}

TEST_F(CncMotion, SaysWhatIsWrongWithExpressions) {
  const auto says = [this](const std::string &text, const std::string &error) {
    write(text);
    const ProcessResult result = cnc({"check", "a.cnc"});
    EXPECT_NE(result.exitCode, 0) << text;
    EXPECT_THAT(result.err, HasSubstr(error));
  };
  says("N1 G1 X{1 + F5\n", "there is no such function");
  says("N1 G1 X1 F5\nN2 X1/{1 - 1}\n", "division by zero");
  says("N1 G1 X1 F5\nN2 Nothing{1}\n", "there is no file nothing.cnc");
  says("LET #a : LREAL\nN1 G1 X#a G2\n", "a sentence has one G or M function");
  says("LET #a : LREAL\nN1 G1 X#b\n", "there is no such local variable");
  says("LET #a : LREAL\nN1 G1 X1 F5\nN2 G20 L1 K TRUE\n", "do not end");
}

TEST_F(CncMotion, DrawsThePathAndTheMotion) {
  write("% plate & more\nG17\nG1 X30 Z3 F50 E400 E-300\nG2 X40 Y-10 I10\n");
  const ProcessResult result =
      cnc({"plot", "a.cnc", "--velocity-mode", "quadratic", "--jerk", "9000", "--blend", "0.1"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "a.svg\n");
  const std::string svg = read("a.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("plate &amp; more"), HasSubstr(">XY<"), HasSubstr(">XZ<"),
                         HasSubstr(">YZ<"), HasSubstr(">isometric<"), HasSubstr("Velocity [u/s]")));
  EXPECT_THAT(svg, AllOf(HasSubstr("Acceleration"), HasSubstr("Jerk")));
  const auto count = [&svg](const std::string &what) {
    size_t found = 0;
    for (size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(count("<svg "), 2U);
  EXPECT_EQ(count("</svg>"), 2U);
  EXPECT_GT(count("<polyline stroke="), 20U); // slow and fast parts differ in colour
}

} // namespace
} // namespace stride::test
