// Nothing that fails around a run ends it: full disks, dead pipes, pipes that nobody reads,
// signals.
#include "moving.hpp"

#include "tests/support/fault_injection.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char *kDone = "Main.done = TRUE";
constexpr int kIncomplete = 4;

class FaultyRun : public ::testing::Test {
protected:
  void SetUp() override {
    buildMoving(scratch_.path());
    writeFile(scratch_.path() / "a.script", "at T#100ms: force Main.go := TRUE\n");
  }
  /// With everything that writes.
  std::vector<std::string> run() const {
    return {STRIDE_BINARY_DIR "/stride-host",
            "run",
            "moving.so",
            "--for",
            "800ms",
            "--trace",
            "Drive.fSetPosition",
            "--out",
            "t.csv",
            "--print",
            "Main.done",
            "--statistics",
            "s.json",
            "--retain",
            "kept",
            "--record",
            "r.rec",
            "--listen",
            "unix:s",
            "--script",
            "a.script"};
  }
  ProcessResult shell(const std::string &script) {
    return runProcess({"sh", "-c", script}, scratch_.path(),
                      {{"RUN", STRIDE_BINARY_DIR "/stride-host run moving.so --for 800ms"},
                       {"HOST", STRIDE_BINARY_DIR "/stride-host"}});
  }
  void clean() {
    for (const char *name : {"t.csv", "s.json", "kept.a", "kept.b", "kept.lock", "r.rec", "s"})
      fs::remove(scratch_.path() / name);
  }
  std::string file(const char *name) const {
    return fs::exists(scratch_.path() / name) ? readFile(scratch_.path() / name) : std::string();
  }

  /// A run in which a call has failed.
  /// `mute`: it cannot write anything any more, so that only its exit code tells that it has ended
  /// as it should.
  void expectSound(const FaultedRun &run, bool mute) {
    const ProcessResult &result = run.result;
    EXPECT_FALSE(run.tooLong);
    EXPECT_THAT(result.err, Not(AnyOf(HasSubstr("terminate"), HasSubstr("nternal error"))));
    EXPECT_THAT(result.exitCode, AnyOf(0, 1, kIncomplete)) << result.err;
    const bool said = result.err.find("warning: ") != std::string::npos ||
                      result.err.find("error: ") != std::string::npos;
    const bool printed = result.out.find(kDone) != std::string::npos;
    const bool written = file("s.json").find("cycles") != std::string::npos &&
                         file("t.csv").find("\n0.6") != std::string::npos;
    if (result.exitCode == 0) { // all is there, or somebody was told
      EXPECT_TRUE((printed && written) || said) << result.out << result.err;
    } else if (result.exitCode == kIncomplete) { // it has reached its end, wherever that shows
      EXPECT_TRUE(printed || written || mute) << result.out << result.err;
    }
    EXPECT_FALSE(fs::exists(scratch_.path() / "s")) << "the socket's file is left";
  }

  void failEach(CallClass what, const std::vector<int> &errors) {
    if (!canInjectFaults())
      GTEST_SKIP() << "the system lets no calls be intercepted";
    const unsigned calls = runWithFault(run(), scratch_.path(), {what}).calls;
    ASSERT_GT(calls, 0U);
    const bool all = std::getenv("STRIDE_ALL_FAULTS") != nullptr;
    const unsigned step = all ? 1 : std::max(1U, calls / 8);
    for (unsigned n = 1; n <= calls; n += step)
      for (size_t e = 0; e < (all ? errors.size() : 1); ++e)
        for (const bool onwards : {false, true}) {
          if (!all && onwards == (n / step % 2 == 0))
            continue;
          const int error = errors[(n / step + e) % errors.size()];
          SCOPED_TRACE("call " + std::to_string(n) + " of " + std::to_string(calls) + ", errno " +
                       std::to_string(error) + (onwards ? " and all after it" : ""));
          clean();
          expectSound(runWithFault(run(), scratch_.path(), {what, n, error, onwards}),
                      onwards && what == CallClass::Write);
        }
  }

  ScratchDirectory scratch_;
};

TEST_F(FaultyRun, EachOpenFails) { failEach(CallClass::Open, {EACCES, EMFILE, ENOSPC}); }
TEST_F(FaultyRun, EachWriteFails) { failEach(CallClass::Write, {ENOSPC, EIO, EPIPE}); }
TEST_F(FaultyRun, EachSyncFails) { failEach(CallClass::Sync, {EIO, ENOSPC}); }
TEST_F(FaultyRun, EachRenameFails) { failEach(CallClass::Rename, {EACCES, ENOSPC}); }
TEST_F(FaultyRun, EachChangeOfAFileFails) { failEach(CallClass::Resize, {EACCES}); }
TEST_F(FaultyRun, EachCallOfASocketFails) { failEach(CallClass::Socket, {EMFILE, EACCES}); }

TEST_F(FaultyRun, AFullDiskUnderTheMessagesAndTheValues) {
  const ProcessResult messages = shell("$RUN --print Main.done 2>/dev/full");
  EXPECT_EQ(messages.exitCode, kIncomplete);
  EXPECT_THAT(messages.out, HasSubstr(kDone));
  const ProcessResult values = shell("$RUN --print Main.done --retain kept >/dev/full");
  EXPECT_EQ(values.exitCode, kIncomplete);
  EXPECT_THAT(values.err, HasSubstr("the values to print cannot be written: No space left"));
  EXPECT_TRUE(fs::exists(scratch_.path() / "kept.a"));
  const ProcessResult trace = shell("$RUN --trace Drive.fSetPosition --out /dev/full --print "
                                    "Main.done");
  EXPECT_EQ(trace.exitCode, kIncomplete);
  EXPECT_THAT(trace.err, HasSubstr("cannot write the trace to '/dev/full': No space left"));
  EXPECT_THAT(trace.out, HasSubstr(kDone));
}

TEST_F(FaultyRun, AFileThatMayNotGrow) {
  const ProcessResult result =
      shell("ulimit -f 8; $RUN --trace Drive.fSetPosition --out t.csv --print Main.done");
  EXPECT_EQ(result.exitCode, kIncomplete) << result.err;
  EXPECT_THAT(result.out, HasSubstr(kDone));
  EXPECT_THAT(result.err, HasSubstr("cannot write the trace to 't.csv': File too large"));
}

TEST_F(FaultyRun, ALogCollectorThatHasGone) {
  const ProcessResult result = shell("{ $RUN --print Main.done --histogram 3>&1 >out 2>&3; echo $? "
                                     ">code; } | true; cat out code");
  EXPECT_EQ(result.out, std::string(kDone) + "\n4\n");
}

TEST_F(FaultyRun, APipeThatNobodyReads) {
  // 500 bytes a cycle for 64 KiB of pipe and 256 KiB of memory; the messages have no room either.
  const ProcessResult result = shell(
      "mkfifo pipe; sleep 60 <pipe & reader=$!; "
      "timeout -s KILL 50 $HOST run moving.so --for 3s --trace Drive --retain kept >pipe 2>&1; "
      "code=$?; kill $reader; echo $code; ls kept.a");
  EXPECT_EQ(result.out, "4\nkept.a\n") << result.err;
}

TEST_F(FaultyRun, ATerminalThatStopsWhoWritesInTheBackground) {
  const ProcessResult result = runOnTerminal(
      {"timeout", "-s", "KILL", "30", "bash", "-mc",
       "stty tostop; $RUN --print Main.done > values & sleep 0.3; kill -USR1 $!; sleep 0.2; "
       "kill -USR1 $!; wait $!; echo ended with $?"},
      scratch_.path(), {{"RUN", STRIDE_BINARY_DIR "/stride-host run moving.so --for 800ms"}});
  EXPECT_THAT(result.out, HasSubstr("ended with 0"));
  EXPECT_THAT(result.out, HasSubstr("cycles"));
  EXPECT_EQ(file("values"), std::string(kDone) + "\n");
}

TEST_F(FaultyRun, StandardFilesThatAreClosed) {
  // Whatever is opened next does not get their numbers: nothing that is printed lands in it.
  const std::string print = "$RUN --retain kept --record r.rec --print Main.done ";
  for (const char *closed : {"<&-", "2>&-", "<&- 2>&-"}) {
    const ProcessResult result = shell(print + closed);
    EXPECT_EQ(result.exitCode, 0) << closed << result.err;
    EXPECT_EQ(result.out, std::string(kDone) + "\n") << closed;
    clean();
  }
  for (const char *closed : {">&-", "<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(shell(print + closed).exitCode, kIncomplete) << closed; // the values
    for (const char *name : {"kept.lock", "kept.a", "r.rec"})
      EXPECT_THAT(file(name), Not(HasSubstr("Main.done ="))) << closed << ' ' << name;
    EXPECT_EQ(shell("$HOST sim moving.so --replay r.rec --quiet").exitCode, 0) << closed;
    clean();
  }
}

TEST_F(FaultyRun, ItStartsAgainThoughNobodyHearsOfIt) {
  writeFile(scratch_.path() / "bad.st", R"(
PROGRAM Main
VAR n : DINT; zero : DINT; END_VAR
VAR RETAIN starts : DINT; END_VAR
IF n = 0 THEN starts := starts + 1; END_IF
n := n + 1;
IF n = 50 THEN n := n / zero; END_IF
END_PROGRAM
CONFIGURATION C
  TASK T (INTERVAL := T#1ms, PRIORITY := 1);
  PROGRAM Main WITH T;
END_CONFIGURATION
)");
  const ProcessResult result =
      shell(STRIDE_BINARY_DIR
            "/stride build bad.st -W off=lints; "
            "{ $HOST run bad.so --for 2500ms --on-fault restart --retain kept --print Main.starts "
            "3>&1 >out 2>&3; } | true; tail -n 1 out");
  EXPECT_THAT(result.out, AnyOf(HasSubstr("Main.starts = 2"), HasSubstr("Main.starts = 3")));
}

TEST_F(FaultyRun, SignalsAtAnyTimeEndNothing) {
  // From when the run takes them: before that the process has not come so far.
  const ProcessResult result =
      shell("$RUN --print Main.done --listen unix:s >out 2>err & p=$!; "
            "while kill -0 $p 2>/dev/null; do "
            "case $(sed -n 's/^SigBlk:[[:space:]]*//p' /proc/$p/status 2>/dev/null) in "
            "*[13579bdf]) kill -HUP $p; kill -USR1 $p;; esac; done 2>/dev/null; "
            "wait $p; echo $? >code; cat out code; ls s 2>&1");
  EXPECT_THAT(result.out, HasSubstr(std::string(kDone) + "\n0\n"));
  EXPECT_THAT(result.out, HasSubstr("No such file"));
}

TEST_F(FaultyRun, AStormOfSignalsDoesNotKeepItFromEnding) {
  const ProcessResult result =
      shell("$HOST run moving.so --listen unix:s --quiet 2>err & p=$!; "
            "while ! [ -e s ]; do sleep 0.01; done; "
            "( while kill -HUP $p 2>/dev/null; do kill -USR1 $p; done ) 2>/dev/null & "
            "sleep 0.3; kill -INT $p; wait $p; echo $?");
  EXPECT_EQ(result.out, "0\n");
  EXPECT_FALSE(fs::exists(scratch_.path() / "s"));
}

} // namespace
} // namespace stride::test
