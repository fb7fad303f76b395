// `stride run`: the real clock, from outside. Nothing here depends on how fast the machine is, but
// that a second is enough for some cycles of 1 ms.
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
using ::testing::Not;

TEST_F(Run, CountsAndShowsItsStatistics) {
  write("a.st", kCounter);
  const ProcessResult result =
      stride({"run", "a.st", "--for", "300ms", "--print", "PLC_PRG.n", "--histogram"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, ContainsRegex("PLC_PRG.n = [1-9][0-9]*"));
  EXPECT_THAT(result.err, AllOf(HasSubstr("late p50"), HasSubstr("Fast "), HasSubstr("run time"),
                                HasSubstr("delay of the start")));
  EXPECT_THAT(stride({"run", "a.st", "--for", "50ms", "--turns", "--quiet"}).err, "");
}

TEST_F(Run, TheTraceIsThatOfASimulation) {
  write("a.st", kCounter);
  const std::vector<std::string> trace = {"--trace", "PLC_PRG.n,PLC_PRG.t", "--quiet"};
  std::vector<std::string> real = {"run", "a.st", "--for", "200ms", "--out", "run.csv"};
  std::vector<std::string> sim = {"sim", "a.st", "--for", "200ms", "--out", "sim.csv"};
  real.insert(real.end(), trace.begin(), trace.end());
  sim.insert(sim.end(), trace.begin(), trace.end());
  ASSERT_EQ(stride(real).exitCode, 0);
  ASSERT_EQ(stride(sim).exitCode, 0);
  std::istringstream run(readFile(scratch_.path() / "run.csv"));
  std::istringstream simulated(readFile(scratch_.path() / "sim.csv"));
  // The program sees planned times, so that the rows agree where no cycle was skipped.
  int same = 0;
  for (std::string a, b; std::getline(run, a) && std::getline(simulated, b) && a == b;)
    ++same;
  EXPECT_GT(same, 3);
}

TEST_F(Run, EqualSimulationsEndInEqualStates) {
  const std::string project = STRIDE_SOURCE_DIR "/examples/PLCopenSingle";
  const std::string sim = "\"$STRIDE\" sim " + project + " --state-hash --quiet --for ";
  const std::string once = shell(sim + "10m").out;
  EXPECT_THAT(once, ContainsRegex("^state [0-9a-f]{16}\n$"));
  EXPECT_EQ(shell(sim + "10m").out, once);
  EXPECT_EQ(shell("GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-AVX512F " + sim + "10m").out,
            once);
  EXPECT_NE(shell(sim + "599s").out, once);
}

TEST_F(Run, SignalsShowAndStop) {
  build("a", kCounter);
  const ProcessResult result = shell("\"$HOST\" run a.so --print PLC_PRG.n & p=$!\n"
                                     "sleep 0.3; kill -USR1 $p; sleep 0.1; kill -TERM $p; wait $p");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.n = "));
  size_t tables = 0;
  for (auto at = result.err.find("late p50"); at != std::string::npos;
       at = result.err.find("late p50", at + 1))
    ++tables;
  EXPECT_EQ(tables, 2U) << result.err;
}

constexpr const char *kFailing = R"(
FUNCTION Half : DINT
VAR_INPUT x : DINT; END_VAR
Half := 100 / (x - 50);
END_FUNCTION
PROGRAM PLC_PRG
VAR n, r : DINT; END_VAR
n := n + 1;
r := Half(n);
END_PROGRAM
CONFIGURATION C
  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);
  PROGRAM PLC_PRG WITH Fast;
END_CONFIGURATION
)";

TEST_F(Run, AFaultStopsOneApplicationAndTheOthersGoOn) {
  build("bad", kFailing);
  build("good", kCounter);
  const ProcessResult result =
      shell("\"$HOST\" run bad.so good.so --for 400ms --trace PLC_PRG.n --out bad.csv");
  EXPECT_EQ(result.exitCode, 2) << result.err;
  EXPECT_THAT(
      result.err,
      AllOf(
          ContainsRegex(
              "bad: error: division by zero at bad.st:4:13 [(]task Fast, cycle 49, at "
              "T#[0-9]+ms[)]; stride explain SR0001\n  in Half at bad.st:4\n  called by PLC_PRG at "
              "bad.st:9"),
          Not(HasSubstr("good: error"))));
  EXPECT_THAT(readFile(scratch_.path() / "bad.csv"), ContainsRegex("\n0[.][0-9]+,49\n"));
}

TEST_F(Run, AfterAFaultItCanStartAgain) {
  build("bad", kFailing);
  const ProcessResult result =
      shell("\"$HOST\" run bad.so --for 1600ms --on-fault restart --print PLC_PRG.n");
  EXPECT_THAT(result.err, HasSubstr("note: 'bad' is started again"));
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.n = 50\nPLC_PRG.n = ")) << "of both runs";
}

// What may go wrong in ST, each in the 20th cycle, three calls deep.
TEST_F(Run, EveryKindOfExceptionStopsWithItsPlaceAndCalls) {
  struct Case {
    const char *statement;
    const char *message;
  };
  const Case cases[] = {
      {"r := 7 / zero;", "division by zero"},
      {"r := a[n];", "array index out of range: index 20 is outside 1..5"},
      {"s := n;", "value outside its subrange type: value 20 is outside 0..9"},
      {"p := 0; r := p^;", "use of a null pointer or reference"},
      {"p := 16#1234567; r := p^;", "access through an invalid pointer"},
      {"r := Deep(n);", "stack overflow (calls nested too deeply)"},
  };
  for (const Case &c : cases) {
    write("p/stride.toml", "[[task]]\nname = \"T\"\ninterval = \"T#1ms\"\nprograms = [\"Main\"]\n");
    write("p/Main.st", std::string("FUNCTION Deep : DINT\nVAR_INPUT n : DINT; END_VAR\n"
                                   "IF n > 0 THEN Deep := Deep(n + 1) + 1; END_IF\nEND_FUNCTION\n"
                                   "FUNCTION_BLOCK Worker\nVAR_INPUT n : DINT; END_VAR\n"
                                   "VAR r, zero : DINT; a : ARRAY[1..5] OF DINT; s : DINT(0..9);\n"
                                   "p : POINTER TO DINT; END_VAR\nMETHOD Work\n") +
                           c.statement +
                           "\nEND_METHOD\nIF n = 20 THEN\n  Work();\nEND_IF\nEND_FUNCTION_BLOCK\n"
                           "PROGRAM Main\nVAR n : DINT; w : Worker; END_VAR\nn := n + 1;\n"
                           "w(n := n);\nEND_PROGRAM\n");
    const ProcessResult result = stride(
        {"run", "p", "--for", "20s", "--quiet", "--print", "Main.n", "-W", "off=all-warnings"});
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_THAT(result.err, AllOf(HasSubstr("error: " + std::string(c.message)),
                                  HasSubstr("(task T, cycle 19, at T#"),
                                  HasSubstr("called by Main at Main.st:19")))
        << c.statement;
    EXPECT_EQ(result.out, "Main.n = 20\n");
  }
}

TEST_F(Run, ACoupledAxisThatRestsAtTheEndIsNoNews) {
  fs::copy(STRIDE_SOURCE_DIR "/examples/CanGantry", scratch_.path() / "p",
           fs::copy_options::recursive);
  fs::remove_all(scratch_.path() / "p/build");
  std::string toml = readFile(scratch_.path() / "p/stride.toml");
  for (size_t at = 0; (at = toml.find("\"CAN (SocketCAN)\"", at)) != std::string::npos;)
    toml.replace(at, 17, "\"Dummy (CAN)\"");
  toml.erase(toml.find("[[io]]"));
  write("p/stride.toml", toml);
  write("p/Gantry.st",
        "PROGRAM Gantry\n"
        "VAR\n"
        "  l, r : MC_Power := (Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);\n"
        "  g : MC_GearIn := (RatioNumerator := 1, RatioDenominator := 1,\n"
        "                    Acceleration := 2000, Deceleration := 2000);\n"
        "END_VAR\n"
        "l(Axis := Left);\nr(Axis := Right);\n"
        "g(Execute := l.Status AND r.Status, Master := Left, Slave := Right);\n"
        "END_PROGRAM\n");
  const ProcessResult result =
      stride({"run", "p", "--for", "500ms", "--quiet", "--print", "Gantry.g.InGear"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "Gantry.g.InGear = TRUE\n");
  EXPECT_THAT(result.err, Not(HasSubstr("error stop")));
}

TEST_F(Run, AxesBrakeToRestAfterAFault) {
  fs::copy(STRIDE_SOURCE_DIR "/examples/PLCopenSingle", scratch_.path() / "p",
           fs::copy_options::recursive);
  fs::remove_all(scratch_.path() / "p/build");
  std::string text = readFile(scratch_.path() / "p/Ipo.st");
  text.insert(text.find("VAR\n") + 4, "  zero : DINT;\n");
  text += "\nIF Drive.fSetPosition > 30 THEN\n  zero := 1 / zero;\nEND_IF\n";
  text.erase(text.find("END_PROGRAM"), 11);
  text += "END_PROGRAM\n";
  write("p/Ipo.st", text);
  const ProcessResult result =
      stride({"run", "p", "--for", "20s", "--quiet", "--trace",
              "Drive.fSetPosition,Drive.fSetVelocity,Drive.nAxisState", "--out", "t.csv"});
  EXPECT_EQ(result.exitCode, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr("division by zero at Ipo.st"));
  EXPECT_THAT(result.err, HasSubstr("note: drive 'Drive' is in error stop"));
  std::istringstream rows(readFile(scratch_.path() / "t.csv"));
  std::string line;
  std::getline(rows, line);
  double last = 0;
  double velocity = 0;
  double fastest = 0;
  int braking = 0;
  while (std::getline(rows, line)) {
    double time = 0;
    double position = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &position, &velocity), 3);
    EXPECT_LE(std::abs(velocity - last), 100 * 0.003 + 1e-9) << "a ramp, not a step: " << line;
    fastest = std::max(fastest, velocity);
    braking += velocity < last ? 1 : 0;
    last = velocity;
  }
  EXPECT_GT(fastest, 50);
  EXPECT_GT(braking, 100);
  EXPECT_EQ(velocity, 0);
}

TEST_F(Run, TheWatchdogStopsAnEndlessLoop) {
  write("p/a.st", "PROGRAM PLC_PRG\nVAR n : DINT; b : BOOL; END_VAR\nn := n + 1;\nb := n < 20;\n"
                  "WHILE NOT b DO\n  n := n + 1;\nEND_WHILE\nEND_PROGRAM\n");
  write("p/stride.toml", "[[task]]\nname = \"T\"\ninterval = \"T#1ms\"\nwatchdog = \"T#20ms\"\n"
                         "programs = [\"PLC_PRG\"]\n");
  const ProcessResult result = stride({"run", "p", "--for", "20s", "--quiet"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("error: cycle longer than the watchdog allows: "),
                                HasSubstr(" us in this loop, allowed are 20000 us at a.st:5:")));
}

TEST_F(Run, BadOptionsAreRefused) {
  build("a", kCounter);
  EXPECT_THAT(shell("\"$HOST\" run a.so --core 4000 --for 1s").err,
              HasSubstr("--core 4000: this process may not use that processor"));
  EXPECT_THAT(shell("\"$HOST\" run a.so --for never").err, HasSubstr("--for: 'never'"));
  EXPECT_THAT(shell("\"$HOST\" run a.so --for 1s --on-fault explode").err, HasSubstr("--on-fault"));
  EXPECT_THAT(shell("\"$HOST\" run a.so --for 1s --print PLC_PRG.m").err,
              HasSubstr("PLC_PRG has no member 'm'; did you mean 'n' or 't'?"));
  EXPECT_THAT(shell("\"$HOST\" run none.so --for 1s").err, HasSubstr("cannot open application"));
}

/// The numbers that `--print` has shown.
std::vector<int> numbersIn(const std::string &printed) {
  std::vector<int> numbers;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);)
    numbers.push_back(std::stoi(line.substr(line.find(" = ") + 3)));
  return numbers;
}

TEST_F(Run, DriversRaiseTheTasksOnTheirSync) {
  fs::copy(STRIDE_SOURCE_DIR "/tests/golden/projects/bus_sync_raised", scratch_.path() / "p",
           fs::copy_options::recursive);
  const std::string print = "--print Main.uiRuns,Urgent.uiRuns,Calm.uiRuns,Other.uiRuns";
  const ProcessResult result =
      shell("\"$STRIDE\" run p --for T#1s --record a.rec --quiet " + print);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<int> runs = numbersIn(result.out);
  ASSERT_EQ(runs.size(), 4U) << result.out;
  EXPECT_GT(runs[0], 20) << "cyclic: it sends SYNC";
  EXPECT_GT(runs[1], 10) << "raised by it";
  EXPECT_LE(runs[1], runs[0]) << "at most once per SYNC";
  EXPECT_GT(runs[2], 0) << "raised, too, when the others leave time";
  EXPECT_LE(runs[2], runs[0]);
  EXPECT_GT(runs[3], 10) << "waits for SYNC of its own bus";
  const ProcessResult replay = shell("\"$STRIDE\" sim p --replay a.rec " + print);
  EXPECT_EQ(replay.exitCode, 0) << replay.err;
  EXPECT_EQ(replay.out, result.out);
}

TEST_F(Run, ADriverSaysWhenItsSyncIsMissing) {
  fs::copy(STRIDE_SOURCE_DIR "/tests/golden/projects/bus_sync_faults", scratch_.path() / "p",
           fs::copy_options::recursive);
  const ProcessResult result = shell("\"$STRIDE\" run p --for T#500ms --quiet --print Main.uiRuns");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_GT(numbersIn(result.out).at(0), 10);
  EXPECT_THAT(result.err, HasSubstr("warning: axis group 'Axes': no SYNC for 3000 us: the task has "
                                    "run without it\n"));
}

TEST_F(Run, AStartUpThatFailsIsSaidWhenItFails) {
  fs::copy(STRIDE_SOURCE_DIR "/tests/golden/projects/quick_stop", scratch_.path() / "p",
           fs::copy_options::recursive);
  write("p/Main.st", "PROGRAM Main\nA_Sim.bFailStartUp := TRUE;\nEND_PROGRAM\n");
  const ProcessResult result = shell("\"$STRIDE\" run p --for T#500ms --quiet");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const std::string said = "warning: axis group 'Axes' did not start: drive A (1): ";
  EXPECT_THAT(result.err, HasSubstr(said));
  EXPECT_EQ(result.err.find(said), result.err.rfind(said)) << "once";
}

TEST_F(Run, ARecordingIsReplayedBitForBit) {
  build("a", kSeveralTasks);
  const ProcessResult result = shell(
      "\"$HOST\" run a.so --for 500ms --record a.rec --trace n,m,e,free --out run.csv "
      "--print n,m,e,free --quiet > run.txt && "
      "\"$HOST\" sim a.so --replay a.rec --trace n,m,e,free --out sim.csv "
      "--print n,m,e,free > sim.txt && cmp run.csv sim.csv && cmp run.txt sim.txt && cat run.txt");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("free = "));
  // Cut off, damaged, of another build, no recording at all: said, not believed.
  build("b", kCounter);
  const auto replay = [&](const std::string &app, const std::string &file) {
    return shell("\"$HOST\" sim " + app + " --replay " + file).err;
  };
  EXPECT_THAT(replay("b.so", "a.rec"), HasSubstr("is a recording of another build"));
  EXPECT_THAT(replay("a.so", "a.so"), HasSubstr("is no recording"));
  EXPECT_THAT(replay("a.so", "none.rec"), HasSubstr("cannot read 'none.rec'"));
  EXPECT_THAT(shell("head -c 40 a.rec > cut.rec; \"$HOST\" sim a.so --replay cut.rec").err,
              HasSubstr("is cut off"));
  EXPECT_THAT(shell("head -c -3 a.rec > cut.rec; \"$HOST\" sim a.so --replay cut.rec").err,
              HasSubstr("is cut off"));
  const ProcessResult damaged =
      shell("cp a.rec bad.rec; printf x | dd of=bad.rec bs=1 seek=$(($(stat -c %s bad.rec) / 2)) "
            "conv=notrunc 2>/dev/null; \"$HOST\" sim a.so --replay bad.rec");
  EXPECT_EQ(damaged.exitCode, 1);
  EXPECT_THAT(damaged.err, HasSubstr("is damaged"));
}

/// Also cycles in which a task that waits for an event takes STOP over.
TEST_F(Run, AReplayStopsAndStartsAsTheRunDid) {
  const std::string trace =
      " --script p/stop.script --trace Main.n,Main.speedBack,Main.valveBack,OnEvent.starts,"
      "OnEvent.lampBack --out ";
  const ProcessResult result = shell(
      "cp -r " STRIDE_SOURCE_DIR "/tests/golden/projects/plc_stop_io p && "
      "\"$STRIDE\" build p -o a.so && "
      "\"$HOST\" run a.so --for 300ms --record a.rec --quiet" +
      trace + "run.csv && \"$HOST\" sim a.so --replay a.rec" + trace +
      "sim.csv && cmp run.csv sim.csv && cut -d , -f 3,4,6 sim.csv | grep -c '^-2,10[0-9],0$'");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, ContainsRegex("^[1-9][0-9]*\n$")) << "fallback, hold, fallback at once";
}

TEST_F(Run, AReplayNeedsTheScriptOfItsRun) {
  build("a", kCounter);
  write("s.script", "at T#20ms: PLC_PRG.n := 1000000\n");
  write("other.script", "at T#20ms: PLC_PRG.n := 2000000\n");
  ASSERT_EQ(shell("\"$HOST\" run a.so --for 200ms --record a.rec --script s.script --quiet && "
                  "\"$HOST\" run a.so --for 50ms --record plain.rec --quiet")
                .exitCode,
            0);
  const auto replay = [&](const std::string &options) {
    const ProcessResult result = shell("\"$HOST\" sim a.so --replay " + options);
    return fmt::format("{} {}", result.exitCode, result.err);
  };
  EXPECT_EQ(replay("a.rec --script s.script"), "0 ");
  EXPECT_EQ(replay("a.rec"), "1 error: 'a.rec' was recorded with the script 's.script': give it "
                             "with --script\n");
  EXPECT_EQ(replay("a.rec --script other.script"),
            "1 error: 'a.rec' was recorded with the script 's.script', but 'other.script' is "
            "another one, or was changed since\n");
  EXPECT_EQ(replay("plain.rec --script s.script"),
            "1 error: 'plain.rec' was recorded without a script: leave --script out\n");
}

TEST_F(Run, AFaultIsReplayedWithItsPlace) {
  build("bad", kFailing);
  const ProcessResult result = shell("\"$HOST\" run bad.so --for 1s --record a.rec --quiet; "
                                     "\"$HOST\" sim bad.so --replay a.rec --print PLC_PRG.n");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.out, HasSubstr("PLC_PRG.n = 50"));
  const auto first = result.err.find("division by zero at bad.st:4:13 (task Fast, cycle 49");
  ASSERT_NE(first, std::string::npos) << result.err;
  EXPECT_NE(result.err.find("division by zero at bad.st:4:13 (task Fast, cycle 49", first + 1),
            std::string::npos);
}

TEST_F(Run, AReplayEndsWithTheWatchdogsExceptionOfTheRun) {
  // Loops with constant bounds do not look at the clock themselves.
  write("p/a.st", R"(
FUNCTION Some : DINT
VAR i : INT; END_VAR
FOR i := 1 TO 1000 DO Some := Some * 3 + i; END_FOR
END_FUNCTION
PROGRAM PLC_PRG
VAR n, i : DINT; sum : LINT; END_VAR
n := n + 1;
IF n = 20 THEN
  FOR i := 1 TO 15000 DO sum := sum + Some(); END_FOR
END_IF
END_PROGRAM
)");
  write("p/stride.toml", "[[task]]\nname = \"T\"\ninterval = \"T#1ms\"\nwatchdog = \"T#1ms\"\n"
                         "programs = [\"PLC_PRG\"]\n");
  const ProcessResult run =
      stride({"run", "p", "--for", "20s", "--quiet", "--record", "a.rec", "--print", "PLC_PRG"});
  EXPECT_EQ(run.exitCode, 2);
  const ProcessResult replay = stride({"sim", "p", "--replay", "a.rec", "--print", "PLC_PRG"});
  EXPECT_EQ(replay.exitCode, 2);
  EXPECT_EQ(replay.out, run.out);
  EXPECT_THAT(run.err, HasSubstr("error: "));
  EXPECT_THAT(replay.err, HasSubstr(run.err.substr(run.err.find("error: "))));
}

TEST_F(Run, AnEndlessLoopIsReplayedToTheSamePlace) {
  write("p/a.st", "PROGRAM PLC_PRG\nVAR n : DINT; b : BOOL; END_VAR\nn := n + 1;\nb := n < 20;\n"
                  "WHILE NOT b DO\n  n := n + 1;\nEND_WHILE\nEND_PROGRAM\n");
  write("p/stride.toml", "[[task]]\nname = \"T\"\ninterval = \"T#1ms\"\nwatchdog = \"T#20ms\"\n"
                         "programs = [\"PLC_PRG\"]\n");
  const ProcessResult run =
      stride({"run", "p", "--for", "20s", "--quiet", "--record", "a.rec", "--print", "PLC_PRG"});
  EXPECT_EQ(run.exitCode, 2);
  const ProcessResult replay = stride({"sim", "p", "--replay", "a.rec", "--print", "PLC_PRG"});
  EXPECT_EQ(replay.exitCode, 2);
  EXPECT_EQ(replay.out, run.out);
  const std::string error = run.err.substr(run.err.find("error: "));
  EXPECT_THAT(error, HasSubstr("at a.st:5:"));
  EXPECT_THAT(replay.err, HasSubstr(error.substr(0, error.find('\n'))));
}

TEST_F(Run, AnExceptionOfAnEventHasItsPlaceInTheProject) {
  write("p/Main.st", "PROGRAM Main\nVAR k : DINT; END_VAR\nk := k + 1;\nEND_PROGRAM\n"
                     "PROGRAM OnEvent\nEND_PROGRAM\n");
  write("p/stride.toml", "[[task]]\nname = \"T\"\ninterval = \"T#10ms\"\nprograms = [\"Main\"]\n"
                         "[[task]]\nname = \"TE\"\nkind = \"event\"\n"
                         "event = \"10 / (Main.k - 20) > 0\"\nprograms = [\"OnEvent\"]\n");
  EXPECT_THAT(stride({"sim", "p", "--for", "1s"}).err,
              HasSubstr("division by zero at stride.toml:8:13"));
}

TEST_F(Run, ATaskOfAConfigurationGetsItsWatchdogFromTheProject) {
  write("p/Main.st", "PROGRAM PLC_PRG\nVAR n : LINT; END_VAR\nWHILE TRUE DO n := n + 1; END_WHILE\n"
                     "END_PROGRAM\nCONFIGURATION C\n  TASK Fast (INTERVAL := T#1ms, PRIORITY := "
                     "1);\n  PROGRAM PLC_PRG WITH Fast;\nEND_CONFIGURATION\n");
  write("p/stride.toml", "[[task]]\nname = \"Fast\"\nwatchdog = \"T#7ms\"\n");
  const ProcessResult result = stride({"run", "p", "--for", "5s", "--quiet"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("allowed are 7000 us"));
}

TEST_F(Run, NamesOfSeveralApplications) {
  build("a", kCounter);
  build("b", "PROGRAM Other VAR k : DINT; seen : DINT; END_VAR seen := k; END_PROGRAM");
  write("b.script", "at T#0ms: Other.k := 77\n");
  const ProcessResult result =
      shell("\"$HOST\" run a.so b.so --for 200ms --print a:PLC_PRG.n,Other.seen,b:Other.k "
            "--script b=b.script --trace PLC_PRG.n,b:Other.seen --out t.csv --statistics s.json; "
            "head -n 1 t.a.csv t.b.csv; cat s.json");
  EXPECT_THAT(result.out,
              AllOf(ContainsRegex("PLC_PRG.n = [0-9]+\nOther.seen = 77\nOther.k = 77\n"),
                    HasSubstr("t,PLC_PRG.n\n"), HasSubstr("t,Other.seen\n"),
                    ContainsRegex("\"a\": \\[(.|\n)*\"b\": \\[")))
      << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("a:\ntask [us]"), HasSubstr("b:\ntask [us]")));
  const auto refused = [&](const std::string &options) {
    return shell("\"$HOST\" run a.so b.so --for 50ms " + options).err;
  };
  EXPECT_THAT(refused("--print c:Other.k"), HasSubstr("there is no application 'c'"));
  EXPECT_THAT(refused("--print Other.nothing"), HasSubstr("symbol 'Other.nothing'"));
  EXPECT_THAT(refused("--trace a:PLC_PRG.n,b:Other.k"), HasSubstr("give a file with --out"));
  EXPECT_THAT(refused("--script b=b.script --script b=b.script"), HasSubstr("has the script"));
}

// ------------------------------------------------------------------------------------------------
// online change

} // namespace
} // namespace stride::test
