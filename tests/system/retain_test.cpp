// Retained data as a user meets them: sim and run with --retain, stride.toml, new builds, reset.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using stride::test::ProcessResult;
using stride::test::replaceAll;
using stride::test::runProcess;
using stride::test::ScratchDirectory;
using stride::test::writeFile;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char *kProgram = R"(FUNCTION_BLOCK Counter
VAR RETAIN
  count : DINT;
END_VAR
VAR
  calls : DINT;
  toldToInit : BOOL;
END_VAR
METHOD FB_Init : BOOL
VAR_INPUT
  bInitRetains : BOOL;
  bInCopyCode : BOOL;
END_VAR
toldToInit := bInitRetains;
END_METHOD
count := count + 1;
calls := calls + 1;
END_FUNCTION_BLOCK

VAR_GLOBAL PERSISTENT
  total : LINT;
  name : STRING(20) := 'new';
END_VAR

PROGRAM Main
VAR
  plain : DINT;
  fb : Counter;
  p : POINTER TO DINT;
END_VAR
VAR RETAIN
  n : INT;
  whole : Counter;
END_VAR
p := ADR(plain);
plain := plain + 1;
n := n + 1;
total := total + 1;
name := 'old';
fb();
whole();
END_PROGRAM
)";

class RetainTest : public ::testing::Test {
protected:
  ScratchDirectory scratch;
  std::string program = kProgram;

  ProcessResult stride(std::vector<std::string> arguments) {
    writeFile(scratch.path() / "Main.st", program);
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch.path());
  }
  /// 10 cycles.
  ProcessResult sim(const std::vector<std::string> &more = {"--retain", "kept"}) {
    std::vector<std::string> arguments = {
        "sim",     "Main.st", "--for",
        "T#100ms", "--print", "Main.plain,Main.n,total,name,Main.fb,Main.whole"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return stride(arguments);
  }
};

std::string values(int plain, int retain, int persistent, bool init) {
  const std::string told = init ? "TRUE" : "FALSE";
  return "Main.plain = " + std::to_string(plain) + "\nMain.n = " + std::to_string(retain) +
         "\ntotal = " + std::to_string(persistent) +
         "\nname = 'old'\nMain.fb.count = " + std::to_string(retain) +
         "\nMain.fb.calls = " + std::to_string(plain) + "\nMain.fb.toldToInit = " + told +
         "\nMain.whole.count = " + std::to_string(retain) +
         "\nMain.whole.calls = " + std::to_string(retain) + "\nMain.whole.toldToInit = ";
}

TEST_F(RetainTest, ASimulationKeepsThemOnlyWhenAsked) {
  for (int i = 0; i < 2; ++i) {
    const ProcessResult result = sim({});
    EXPECT_THAT(result.out, HasSubstr(values(10, 10, 10, true))) << result.err;
  }
  for (int i = 1; i <= 3; ++i) {
    const ProcessResult result = sim();
    EXPECT_THAT(result.out, HasSubstr(values(10, 10 * i, 10 * i, i == 1))) << result.err;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "kept.a"));
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "kept.b"));
}

TEST_F(RetainTest, AReaderOfAConsistentVariableBeginsWithWhatWasKept) {
  program = R"(TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
VAR_GLOBAL PERSISTENT
  {attribute 'consistent'}
  shared : Pair := (a := 5);
END_VAR
PROGRAM Read
  VAR first, last : INT; END_VAR
  last := shared.a;
  IF first = 0 THEN first := last; END_IF
END_PROGRAM
PROGRAM Write
  shared.a := shared.a + 10;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Plc ON PC
    TASK Early (INTERVAL := T#10ms, PRIORITY := 1);
    TASK Late (INTERVAL := T#10ms, PRIORITY := 2);
    PROGRAM Read WITH Early;
    PROGRAM Write WITH Late;
  END_RESOURCE
END_CONFIGURATION
)";
  const std::vector<std::string> run = {"sim",      "Main.st", "--for",   "T#100ms",
                                        "--retain", "kept",    "--print", "Read.first,Read.last"};
  EXPECT_THAT(stride(run).out, HasSubstr("Read.first = 5\nRead.last = 95\n"));
  EXPECT_THAT(stride(run).out, HasSubstr("Read.first = 105\nRead.last = 195\n"));
}

TEST_F(RetainTest, AnotherBuildKeepsPersistentOnes) {
  sim();
  program = replaceAll(program, "n := n + 1;", "n := n + 1; plain := plain + 0;");
  program = replaceAll(program, "total : LINT", "total : INT");
  const ProcessResult result = sim();
  EXPECT_THAT(result.out, HasSubstr(values(10, 10, 10, true)));
  for (const char *name : {"Main.n", "Main.whole", "Main.fb.count"})
    EXPECT_THAT(result.err, HasSubstr(std::string(name) +
                                      " is not restored: this is another build of the program, and "
                                      "only PERSISTENT variables survive that, not RETAIN"));
  EXPECT_THAT(result.err, HasSubstr("warning: retained data: Main.total is not restored: it was "
                                    "LINT and is INT"));
  program = replaceAll(program, "total : INT", "total : DINT");
  const ProcessResult wider = sim();
  EXPECT_THAT(wider.out, HasSubstr(values(10, 10, 20, true)));
  EXPECT_THAT(wider.err,
              HasSubstr("note: retained data: Main.total was INT and is DINT: converted"));
  EXPECT_THAT(sim().out, HasSubstr(values(10, 20, 30, false)));
}

TEST_F(RetainTest, AfterAnOnlineChangeTheyAreTheNewBuilds) {
  const std::string old = program;
  const std::string changed =
      replaceAll(program, "  whole : Counter;", "  whole : Counter;\n  added : INT := 3;");
  program = changed;
  ASSERT_EQ(stride({"build", "Main.st", "-o", "new.so"}).exitCode, 0);
  program = old;
  const ProcessResult first =
      sim({"--retain", "kept", "--change", "T#50ms,new.so", "--print", "Main.added"});
  EXPECT_THAT(first.out, HasSubstr(values(10, 10, 10, true))) << first.err;
  program = changed;
  const ProcessResult second = sim();
  EXPECT_THAT(second.out, HasSubstr(values(10, 20, 20, false)));
  EXPECT_THAT(second.err, Not(HasSubstr("retained")));
}

TEST_F(RetainTest, Reset) {
  const auto reset = [&](const std::string &kind) {
    return runProcess({STRIDE_BINARY_DIR "/stride-host", "reset", kind, "kept"}, scratch.path());
  };
  EXPECT_THAT(reset("cold").err, HasSubstr("there are no retained data in 'kept'"));
  sim();
  EXPECT_THAT(reset("warm").out, HasSubstr("5 RETAIN and PERSISTENT variables keep their values"));
  EXPECT_THAT(sim().out, HasSubstr(values(10, 20, 20, false)));
  EXPECT_THAT(reset("cold").out, HasSubstr("2 PERSISTENT variables keep their values"));
  EXPECT_THAT(sim().out, HasSubstr(values(10, 10, 30, true)));
  EXPECT_THAT(reset("origin").out, HasSubstr("All variables start with their initial values."));
  EXPECT_THAT(sim().out, HasSubstr(values(10, 10, 10, true)));
  EXPECT_NE(reset("hot").exitCode, 0);
}

TEST_F(RetainTest, AProjectKeepsThemWhereItSaysAndRunSavesThem) {
  std::filesystem::create_directory(scratch.path() / "project");
  const auto project = [&](const std::string &file) { return scratch.path() / "project" / file; };
  writeFile(project("stride.toml"),
            "[project]\nname = \"Kept\"\n\n[retain]\nfile = \"data/kept\"\nperiod = \"T#100ms\"\n\n"
            "[[task]]\nname = \"Task\"\ninterval = \"T#10ms\"\nprograms = [\"Main\"]\n");
  writeFile(project("Main.st"), program);
  const auto command = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch.path());
  };
  const ProcessResult first = command({"run", "project", "--for", "200ms", "--quiet"});
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_TRUE(std::filesystem::exists(project("data/kept.a")));
  const ProcessResult second =
      command({"run", "project", "--for", "100ms", "--quiet", "--print", "Main.n,Main.plain"});
  const int n = std::stoi(second.out.substr(second.out.find("Main.n = ") + 9));
  const int plain = std::stoi(second.out.substr(second.out.find("Main.plain = ") + 13));
  EXPECT_GT(n, plain + 5) << second.out;
  EXPECT_THAT(command({"reset", "origin", "project"}).out, HasSubstr("initial values"));
  EXPECT_FALSE(std::filesystem::exists(project("data/kept.a")));

  // Killed while it runs: the last saving is there. Meanwhile nobody else gets the file.
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const int null = ::open("/dev/null", O_WRONLY);
    ::dup2(null, 1);
    ::dup2(null, 2);
    ::execl(STRIDE_BINARY_DIR "/stride", "stride", "run", project("").c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 500 && !std::filesystem::exists(project("data/kept.b")); ++i)
    ::usleep(20'000);
  const ProcessResult other = command({"reset", "cold", "project"});
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_THAT(other.err, HasSubstr("are in use by another application"));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const ProcessResult after =
      command({"run", "project", "--for", "30ms", "--quiet", "--print", "Main.n"});
  ASSERT_EQ(after.exitCode, 0) << after.err;
  EXPECT_GT(std::stoi(after.out.substr(after.out.find("Main.n = ") + 9)), 10) << after.err;
}

TEST_F(RetainTest, DataOfAnotherApplicationAreNotOverwritten) {
  sim();
  std::filesystem::copy(scratch.path() / "Main.st", scratch.path() / "Other.st");
  const ProcessResult result = runProcess(
      {STRIDE_BINARY_DIR "/stride", "sim", "Other.st", "--for", "T#100ms", "--retain", "kept"},
      scratch.path());
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("belong to application 'Main', not to 'Other'"));
}

TEST_F(RetainTest, WhatCannotBeSavedIsSaidAndTheRunGoesOn) {
  writeFile(scratch.path() / "file", "");
  const ProcessResult result = sim({"--retain", "file/kept"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("cannot create 'file/kept.lock'"));
}

// The clock begins anew, the time of the step goes on.
TEST_F(RetainTest, AChartGoesOnWhereItWas) {
  program = R"(FUNCTION_BLOCK Chart
VAR n, lateAt, overAt : INT; lamp, late, brief : BOOL; END_VAR
INITIAL_STEP Begin: lamp(S); END_STEP
TRANSITION FROM Begin TO Work := TRUE; END_TRANSITION
STEP Work: Count; late(D, T#150ms); brief(SL, T#120ms); END_STEP
ACTION Count:
n := n + 1;
IF late AND lateAt = 0 THEN lateAt := n; END_IF
IF n > 1 AND NOT brief AND overAt = 0 THEN overAt := n; END_IF
END_ACTION
END_FUNCTION_BLOCK
PROGRAM Main
VAR RETAIN chart : Chart; END_VAR
chart();
END_PROGRAM
)";
  const std::vector<std::string> run = {
      "sim",
      "Main.st",
      "--for",
      "T#100ms",
      "--retain",
      "kept",
      "--print",
      "Main.chart.n,Main.chart.lamp,Main.chart.late,Main.chart.lateAt,"
      "Main.chart.overAt,Main.chart.Work.t"};
  EXPECT_THAT(stride(run).out,
              HasSubstr("Main.chart.n = 9\nMain.chart.lamp = TRUE\nMain.chart.late = FALSE\n"
                        "Main.chart.lateAt = 0\nMain.chart.overAt = 0\n"
                        "Main.chart.Work.t = T#80ms\n"));
  EXPECT_THAT(stride(run).out,
              HasSubstr("Main.chart.n = 19\nMain.chart.lamp = TRUE\nMain.chart.late = TRUE\n"
                        "Main.chart.lateAt = 17\nMain.chart.overAt = 14\n"
                        "Main.chart.Work.t = T#170ms\n"));
}

} // namespace
