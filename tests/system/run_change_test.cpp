// Online changes of `stride run` and `stride sim`, from outside.
#include "tests/system/run_scene.hpp"

#include <fmt/format.h>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class RunChange : public Run {
protected:
  void SetUp() override {
    fs::copy(STRIDE_SOURCE_DIR "/examples/PLCopenSingle", scratch_.path() / "p",
             fs::copy_options::recursive);
    fs::remove_all(scratch_.path() / "p/build");
    ASSERT_EQ(stride({"build", "p", "-o", "old.so"}).exitCode, 0);
  }
  /// Another build: `insert` after the first VAR of the program.
  void buildNew(const std::string &insert) {
    std::string text = readFile(scratch_.path() / "p/Ipo.st");
    text.insert(text.find("VAR\n") + 4, insert);
    write("p/Ipo.st", text);
    const ProcessResult result = stride({"build", "p", "-o", "new.so", "-W", "off=lints"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
  }
  /// Runs old.so as live.so; new.so takes its place in the middle of the move.
  ProcessResult runWithChange(const std::string &options, const std::string &time = "1200ms") {
    return shell("cp old.so live.so\n\"$HOST\" run live.so --for " + time +
                 " --trace "
                 "Drive.fSetPosition,Drive.fSetVelocity --out live.csv " +
                 options +
                 " & p=$!\nsleep 0.8; rm live.so; cp new.so live.so; kill -HUP $p; wait $p");
  }
};

// Tasks that wait for events keep nothing of the old build, and the loader does not take an old
// file for the newest one, also after a restart.
TEST_F(Run, EventTasksAndRestartsGoWithOnlineChanges) {
  std::string first = kSeveralTasks;
  std::string second = first;
  second.replace(second.find("n MOD 7 = 0"), 11, "n MOD 3 = 0");
  std::string third = second;
  third.replace(third.find("n := n + 1;"), 11, "n := n + 1000000;");
  std::string failing = third;
  failing.insert(failing.find("n := n + 1000000;"),
                 "IF n > 2000000000 THEN m := n / (n - n); END_IF\n");
  build("first", first);
  build("second", second);
  build("failing", failing);
  build("third", third);
  const ProcessResult result =
      shell("cp first.so live.so; \"$HOST\" run live.so --for 6s --on-fault restart --quiet "
            "--print n,e & p=$!\nsleep 0.5; rm live.so; cp second.so live.so; kill -HUP $p\n"
            "sleep 0.5; rm live.so; cp failing.so live.so; kill -HUP $p\n"
            "sleep 4; rm live.so; cp third.so live.so; kill -HUP $p; wait $p");
  EXPECT_THAT(result.err, HasSubstr("note: online change done"));
  EXPECT_THAT(result.err, HasSubstr("is started again"));
  EXPECT_THAT(result.err, HasSubstr("division by zero"));
  EXPECT_THAT(result.err, ContainsRegex("started again\n(.*\n)*note: online change done"));
  EXPECT_THAT(result.out, ContainsRegex("\ne = [1-9-]")) << result.err;
}

TEST_F(Run, AnInitialiserThatFailsStopsNothingElse) {
  build("good", "FUNCTION_BLOCK B\nVAR x : DINT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM PLC_PRG\n"
                "VAR n : DINT; b : B; END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  build("bad", "FUNCTION_BLOCK B\nVAR x : DINT; p : POINTER TO DINT; END_VAR\n"
               "METHOD FB_Init : BOOL\nVAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR\n"
               "p := 16#1234567;\nx := p^;\nEND_METHOD\nEND_FUNCTION_BLOCK\nPROGRAM PLC_PRG\n"
               "VAR n : DINT; b : B; END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  const ProcessResult alone = shell("\"$HOST\" run bad.so --for 1s --quiet");
  EXPECT_EQ(alone.exitCode, 2);
  EXPECT_THAT(alone.err, HasSubstr("error: access through an invalid pointer at bad.st:6"));
  const ProcessResult change =
      shell("cp good.so live.so; \"$HOST\" run live.so --for 1s --quiet --print PLC_PRG.n & p=$!\n"
            "sleep 0.4; rm live.so; cp bad.so live.so; kill -HUP $p; wait $p");
  EXPECT_EQ(change.exitCode, 0) << change.err;
  EXPECT_THAT(change.err, HasSubstr("error: online change: access through an invalid pointer"));
  EXPECT_THAT(change.out, HasSubstr("PLC_PRG.n = "));
}

TEST_F(RunChange, AMovingAxisTakesNoStep) {
  buildNew("  unrelated : ARRAY[0..999] OF LREAL := [1000(1.5)];\n");
  const ProcessResult result = runWithChange("--print Drive.fSetPosition", "2500ms");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.err,
              ContainsRegex("note: online change done; no cycle could begin for [0-9]+ us"));
  EXPECT_EQ(result.out, "Drive.fSetPosition = 100.0\n");
  // At most 100 u/s and 100 u/s² in cycles of 3 ms; a skipped cycle shows as such in the times.
  std::istringstream rows(readFile(scratch_.path() / "live.csv"));
  std::string line;
  std::getline(rows, line);
  double lastTime = 0;
  double lastPosition = 0;
  double lastVelocity = 0;
  double fastest = 0;
  while (std::getline(rows, line)) {
    double time = 0;
    double position = 0;
    double velocity = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &position, &velocity), 3);
    const double cycle = time - lastTime;
    // The planner goes by its own cycle count: between two rows one cycle has passed.
    EXPECT_LE(std::abs(position - lastPosition), 100 * 0.003 + 1e-9) << line;
    EXPECT_LE(std::abs(velocity - lastVelocity), 100 * 0.003 + 1e-9) << line;
    EXPECT_GE(cycle, 0);
    fastest = std::max(fastest, velocity);
    lastTime = time;
    lastPosition = position;
    lastVelocity = velocity;
  }
  EXPECT_GT(fastest, 50);
}

TEST_F(RunChange, WhatCannotBeCarriedIsRefusedWithReasons) {
  write("p/stride.toml",
        readFile(scratch_.path() / "p/stride.toml") +
            "\n    [[bus.axis_group.drive]]\n    name = \"Second\"\n    wDriveId = 2\n");
  buildNew("");
  const ProcessResult result = runWithChange("");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("error: online change refused, the application must be started "
                                    "anew\n"));
  EXPECT_THAT(result.err, HasSubstr("axis group AxisGroup has other drives in the new build"));
}

TEST_F(RunChange, LossesNeedConsent) {
  std::string text = readFile(scratch_.path() / "p/Ipo.st");
  const auto at = text.find("p : REAL");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 8, "p : DINT");
  write("p/Ipo.st", text);
  buildNew("");
  EXPECT_THAT(runWithChange("").err,
              AllOf(HasSubstr("Ipo.p"), HasSubstr("values would be lost; --accept-losses")));
  EXPECT_THAT(runWithChange("--accept-losses").err,
              AllOf(HasSubstr("Ipo.p"), HasSubstr("note: online change done")));
}

TEST_F(Run, AChangedDeviceIsRefusedWithItsValues) {
  write("p/Main.st", "PROGRAM PLC_PRG VAR i AT %IB0 : BYTE; END_VAR END_PROGRAM");
  const auto buildWith = [&](int bytes, int delay, const char *out) {
    write("p/stride.toml",
          fmt::format("[[task]]\nname = \"T\"\ninterval = \"T#1ms\"\nprograms = [\"PLC_PRG\"]\n"
                      "[[io]]\nname = \"D1\"\ndevice = \"Simulated\"\nloop_back = true\n"
                      "delay = {}\ninputs = {}\noutputs = {}\n",
                      delay, bytes, bytes));
    const ProcessResult built = stride({"build", "p", "-o", out});
    ASSERT_EQ(built.exitCode, 0) << built.err;
  };
  buildWith(8, 0, "old.so");
  buildWith(4, 4, "new.so");
  EXPECT_THAT(shell("\"$HOST\" sim old.so --for 1s --change T#5ms,new.so").err,
              AllOf(HasSubstr("I/O device D1 has another place of its inputs: byte 0 to 3 instead "
                              "of byte 0 to 7"),
                    HasSubstr("I/O device D1 has another `delay`: 4 instead of 0")));
}

TEST_F(RunChange, TheTasksStayAsTheyAre) {
  std::string toml = readFile(scratch_.path() / "p/stride.toml");
  toml.replace(toml.find("priority = 1"), 12, "priority = 2");
  write("p/stride.toml", toml);
  buildNew("");
  EXPECT_THAT(runWithChange("").err,
              HasSubstr("task 'BusTask' has another priority: 2 instead of 1"));
}

TEST_F(RunChange, ParametersThatTakeEffectLaterAreNamed) {
  std::string toml = readFile(scratch_.path() / "p/stride.toml");
  toml.replace(toml.find("= -5000.0"), 9, "= -400.0");
  write("p/stride.toml", toml + "    fSWMaxVelocity = 900.0\n");
  buildNew("");
  const std::string limit = "warning: online change: drive Drive: fSWLimitNegative is -400 instead "
                            "of -5000; that takes effect at the next start";
  const ProcessResult run = runWithChange("");
  EXPECT_THAT(run.err, AllOf(HasSubstr(limit), HasSubstr("note: online change done")));
  EXPECT_THAT(run.err, HasSubstr("drive Drive: fSWMaxVelocity = 900 is new; that takes"));
  EXPECT_THAT(shell("\"$HOST\" sim old.so --for 1s --change T#500ms,new.so").err,
              HasSubstr("fSWLimitNegative is -400 instead of -5000"));
}

TEST_F(Run, ChangesThatFollowEachOtherDoNotUseUpThePath) {
  build("a", kCounter);
  std::string path; // near the limit of 4096
  for (int i = 0; i < 1990; ++i)
    path += "./";
  const std::string host = STRIDE_BINARY_DIR "/stride-host";
  std::vector<std::string> sim = {host, "sim",     "a.so",    "--for",
                                  "1s", "--quiet", "--print", "PLC_PRG.n"};
  for (int i = 1; i <= 100; ++i) {
    sim.emplace_back("--change");
    sim.push_back(fmt::format("{}ms,{}a.so", i, path));
  }
  const ProcessResult result = command(sim);
  EXPECT_EQ(result.exitCode, 0) << result.err.substr(0, 100);
  EXPECT_EQ(result.out, "PLC_PRG.n = 1000\n");
}

TEST_F(RunChange, ASimulationChangesAtAnInstantBitForBit) {
  buildNew("  unrelated : ARRAY[0..999] OF LREAL := [1000(1.5)];\n");
  const std::string sim = "\"$HOST\" sim old.so --for 4s --set T#2500ms,Ipo.p=50 "
                          "--trace Drive.fSetPosition,Drive.fSetVelocity,Drive.fActPosition ";
  const ProcessResult result =
      shell(sim + "--out without.csv && " + sim +
            "--out with.csv --change T#751ms,new.so --print Ipo.unrelated[3] && cmp without.csv "
            "with.csv && " +
            sim + "--out bad.csv --change T#1s,nowhere.so");
  EXPECT_THAT(result.out, "Ipo.unrelated[3] = 1.5\n") << result.err;
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("cannot open application"));
}

} // namespace
} // namespace stride::test
