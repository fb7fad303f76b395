// `stride run --listen` and `stride ctl`, scripts in real time, and the example of embedding.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Monitor : public ::testing::Test {
protected:
  ProcessResult shell(const std::string &script) {
    return runProcess({"sh", "-c", script}, scratch_.path(),
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()},
                       {"HOST", STRIDE_BINARY_DIR "/stride-host"},
                       {"STRIDE", STRIDE_BINARY_DIR "/stride"},
                       {"EMBED", STRIDE_BINARY_DIR "/stride_embed_example"},
                       {"SOURCE", STRIDE_SOURCE_DIR}});
  }
  void SetUp() override {
    writeFile(scratch_.path() / "app.st", R"(
PROGRAM Main
VAR
  n : DINT;
  copy : DINT;
  fixed : INT := 5;
  input AT %IX0.3 : BOOL;
  seen : BOOL;
END_VAR
n := n + 1;
copy := n;
seen := input;
END_PROGRAM
CONFIGURATION C
  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);
  PROGRAM Main WITH Fast;
END_CONFIGURATION
)");
    const ProcessResult built = shell("$STRIDE build app.st -W off=lints");
    ASSERT_EQ(built.exitCode, 0) << built.err;
  }
  /// What commands print while the application runs; each is what stands after `ctl ADDRESS`.
  ProcessResult served(const std::vector<std::string> &commands, const std::string &options = {}) {
    std::string script = "$HOST run app.so --for 60s --quiet --listen unix:plc.sock " + options +
                         " & run=$!\n"
                         "i=0; while [ ! -S plc.sock ] && [ $i -lt 200 ]; do sleep 0.05; "
                         "i=$((i+1)); done\n";
    for (const std::string &command : commands)
      script += "$HOST ctl unix:plc.sock " + command + "\n";
    return shell(script + "$HOST ctl unix:plc.sock end; wait $run; echo ended with $?");
  }

  ScratchDirectory scratch_;
};

TEST_F(Monitor, ReadsWritesForces) {
  const ProcessResult result =
      served({"read Main.fixed", "write Main.fixed=7", "read Main.fixed",
              "force Main.n=50 %IX0.3=TRUE", "forces", "read Main.n Main.copy Main.seen",
              "unforce --all", "forces", "read Main.fixd", "list Main", "state"});
  EXPECT_EQ(result.out, "Main.fixed = 5\n"
                        "Main.fixed = 7\n"
                        "Main.n = 50\n"
                        "%IX0.3 = TRUE\n"
                        "Main.n = 50\n"
                        "Main.copy = 51\n"
                        "Main.seen = TRUE\n"
                        "Main.n : DINT\n"
                        "Main.copy : DINT\n"
                        "Main.fixed : INT\n"
                        "Main.input : BOOL\n"
                        "Main.seen : BOOL\n" +
                            result.out.substr(result.out.find("app: running")));
  EXPECT_THAT(result.out, HasSubstr("ended with 0"));
  EXPECT_THAT(result.err, HasSubstr("did you mean 'fixed'?"));
}

TEST_F(Monitor, WatchesAndRecords) {
  const ProcessResult result =
      served({"watch Main.fixed --period 0.02 --count 3 | cut -f 2",
              "record Main.n Main.fixed --rows 5 --before 0.4 --trigger Main.n --threshold 100 "
              "--edge high --out rows.csv; wc -l < rows.csv; head -n 1 rows.csv",
              "stats"});
  EXPECT_THAT(result.out, StartsWith("Main.fixed\n5\n5\n5\n"));
  EXPECT_THAT(result.out, HasSubstr("t,Main.n,Main.fixed\n"));
  EXPECT_THAT(result.out, ContainsRegex("Fast +[0-9]+ "));
  EXPECT_EQ(result.err, "");
}

TEST_F(Monitor, TheSocketIsTheUsersOwnAndStaleOnesAreReplaced) {
  const ProcessResult result =
      shell("$HOST run app.so --for 60s --quiet --listen unix:plc.sock & first=$!\n"
            "while [ ! -S plc.sock ]; do sleep 0.05; done; stat -c %a plc.sock\n"
            "$HOST run app.so --for 1s --quiet --listen unix:plc.sock; echo second $?\n"
            "kill -KILL $first; wait $first; [ -S plc.sock ] && echo left\n"
            "$HOST run app.so --for 100ms --quiet --listen unix:plc.sock; echo third $?\n"
            "[ -e plc.sock ] || echo removed\n"
            "echo text > file; $HOST run app.so --for 1s --listen unix:file; echo fourth $?\n"
            "$HOST ctl unix:plc.sock state; echo fifth $?");
  EXPECT_EQ(result.out, "600\nsecond 1\nleft\nthird 0\nremoved\nfourth 1\nfifth 1\n") << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("a running program listens there already"),
                                HasSubstr("that is no socket"), HasSubstr("nobody listens at")));
}

TEST_F(Monitor, ScriptsInRealTime) {
  writeFile(scratch_.path() / "s.script", "wait until Main.n > 20\n"
                                          "force Main.fixed := 9\n"
                                          "at T#100h: Main.fixed := 1\n");
  const ProcessResult result =
      shell("$HOST run app.so --for 500ms --quiet --script s.script --print Main.fixed");
  EXPECT_EQ(result.out, "Main.fixed = 9\n");
  EXPECT_EQ(result.err,
            "warning: s.script:3:1: the run ended while the script still waited here\n");
}

TEST_F(Monitor, WhatIsWrittenIsRecordedAndReplayed) {
  const ProcessResult result =
      served({"write Main.fixed=7", "read Main.fixed", "force Main.n=50 %IX0.3=TRUE", "read Main.n",
              "unforce --all", "write Main.fixed=8"},
             "--record in.rec --trace Main.n,Main.copy,Main.fixed,Main.seen --out run.csv");
  EXPECT_THAT(result.out, StartsWith("Main.fixed = 7\nMain.n = 50\n")) << result.err;
  EXPECT_EQ(result.err, "");
  const ProcessResult replay = shell(
      "$HOST sim app.so --replay in.rec --trace Main.n,Main.copy,Main.fixed,Main.seen "
      "--out sim.csv && cmp run.csv sim.csv && grep -c ',51,7,1$' sim.csv > /dev/null && tail "
      "-n 1 sim.csv | cut -d , -f 4");
  EXPECT_EQ(replay.out, "8\n") << replay.err;
}

/// The POUs rest, the monitor goes on; what was stopped and started is an input of the recording.
TEST_F(Monitor, StopsAndStarts) {
  const ProcessResult result = served(
      {"stop", "stop", "state",
       "read Main.n > first; $HOST ctl unix:plc.sock read Main.n > second; "
       "cmp first second && echo rests",
       "write Main.n=1000", "force %IX0.3=TRUE", "start",
       "record Main.n --rows 1 --trigger Main.n --threshold 1010 --edge high > rows; echo on",
       "read Main.seen", "stop", "change; echo changed $?", "state", "start", "state"},
      "--trace Main.n,Main.copy,Main.seen --out run.csv");
  EXPECT_THAT(result.out,
              ContainsRegex("^app: in STOP at [0-9.]+ s\napp: in STOP at [0-9.]+ s\n"
                            "app: in STOP at [0-9.]+ s\nrests\napp: running at [0-9.]+ s\non\n"
                            "Main.seen = TRUE\napp: in STOP at [0-9.]+ s\n.*changed 0\n"
                            "app: in STOP at [0-9.]+ s\napp: running at [0-9.]+ s\n"
                            "app: running at [0-9.]+ s\nended with 0\n$"))
      << result.err;
  EXPECT_THAT(result.err, StartsWith("note: online change done")); // in STOP
}

TEST_F(Monitor, StopsAndStartsAreRecordedAndReplayed) {
  const ProcessResult result = served(
      {"stop", "write Main.fixed=7", "start", "stop", "start", "record Main.n --rows 3 > rows"},
      "--record in.rec --trace Main.n,Main.copy,Main.fixed --out run.csv");
  EXPECT_EQ(result.err, "");
  const ProcessResult replay =
      shell("$HOST sim app.so --replay in.rec --trace Main.n,Main.copy,Main.fixed --out sim.csv && "
            "cmp run.csv sim.csv && tail -n 1 sim.csv | cut -d , -f 4; "
            "cut -d , -f 2 sim.csv | uniq -d | wc -l");
  EXPECT_EQ(replay.out, "7\n3\n") << "two stops, the end; " << replay.err;
}

/// Scripts, traces and clients are served where only events start tasks.
TEST_F(Monitor, WithoutAPeriodicTask) {
  writeFile(scratch_.path() / "app.st", R"(
VAR_GLOBAL go : BOOL; END_VAR
PROGRAM Main
VAR n : DINT; fixed : INT := 5; END_VAR
n := n + 1;
END_PROGRAM
CONFIGURATION C
  TASK OnGo (SINGLE := go, PRIORITY := 1);
  PROGRAM Main WITH OnGo;
END_CONFIGURATION
)");
  ASSERT_EQ(shell("$STRIDE build app.st -W off=lints").exitCode, 0);
  writeFile(scratch_.path() / "s.script", "wait T#50ms\nMain.fixed := 9\n");
  const ProcessResult result =
      served({"read Main.n", "write go=TRUE", "read Main.n"}, "--script s.script --print Main");
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith("Main.n = 0\nMain.n = 1\n"));
  EXPECT_THAT(result.out, HasSubstr("Main.fixed = 9\n"));
}

TEST_F(Monitor, AnOnlineChangeIsAnswered) {
  const ProcessResult result =
      served({"change; echo code $?", "state >/dev/null; echo garbage > g.so; mv g.so app.so",
              "change; echo code $?"});
  EXPECT_THAT(result.out,
              ContainsRegex("note: online change done; no cycle could begin for [0-9]+ us\n"
                            "code 0\ncode 1\n"));
  EXPECT_THAT(result.err, HasSubstr("error: the online change was refused"));
}

TEST_F(Monitor, Embedding) {
  const ProcessResult result =
      shell("cp $SOURCE/examples/embed/Tank.st . && $STRIDE build Tank.st -o "
            "Tank.so && $EMBED Tank.so && $EMBED missing.so");
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, "tank 1: filled 10 times up to 700, level 575\n"
                        "tank 2: filled 99 times up to 450, level 425\n"
                        "symbol 'Tank.levle': Tank has no member 'levle'; did you mean 'level'?\n");
  EXPECT_THAT(result.err, HasSubstr("missing.so"));
}

} // namespace
} // namespace stride::test
