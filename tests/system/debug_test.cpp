// `stride debug`: gdb stops, steps and prints in ST.
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

constexpr const char *kProgram = R"st(TYPE Color : (red, green := 5, blue); END_TYPE
TYPE Point : STRUCT x, y : LREAL; name : STRING(20); END_STRUCT END_TYPE
FUNCTION_BLOCK Base
VAR
  calls : UINT;
END_VAR
METHOD Count : UINT
  calls := calls + 1;
  Count := calls;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Totals EXTENDS Base
VAR_INPUT
  step : INT;
END_VAR
VAR_OUTPUT
  total : DINT;
END_VAR
  THIS^.Count();
  total := total + step;
  total := total * 2;
END_FUNCTION_BLOCK
FUNCTION Ratio : DINT
VAR_INPUT
  divisor : DINT;
END_VAR
  Ratio := 100 / divisor;
END_FUNCTION
VAR_GLOBAL
  gSpeed : REAL := 2.5;
END_VAR
PROGRAM Main
VAR
  sums : Totals;
  text : STRING := 'it$'s $Ncents';
  wide : WSTRING := "été";
  delay : TIME := T#1h1m1s500ms;
  fine : LTIME := LTIME#1s5ns;
  day : DATE := D#2024-02-29;
  moment : DT := DT#2026-11-21-10:00:01;
  noon : TOD := TOD#12:30:00.25;
  list : ARRAY[-1..1] OF INT := [7, 8, 9];
  table : ARRAY[0..1, 1..2] OF TIME := [T#1ms, T#2ms, T#3ms, T#4ms];
  colors : ARRAY[1..2] OF Color := [green, blue];
  color : Color := green;
  places : ARRAY[3..4] OF Point := [(x := 1.5, name := 'home'), (y := 0.1)];
  mask : BYTE := 16#A5;
  on : BOOL := TRUE;
  target : POINTER TO Point;
  n : DINT := 3;
END_VAR
  target := ADR(places[4]);
  sums(step := 6);
  n := n - 1;
  n := Ratio(n) / 10;
END_PROGRAM
)st";

/// What gdb prints when it executes these commands after the start of the program.
class Debugging : public ::testing::Test {
protected:
  ProcessResult debug(const std::string &commands, const std::string &program = kProgram) {
    writeFile(scratch_.path() / "Main.st", program);
    writeFile(scratch_.path() / "commands.gdb", commands);
    return runProcess({STRIDE_BINARY_DIR "/stride", "debug", "Main.st", "-W", "off=lints", "--for",
                       "T#50ms", "--batch", "-x", "commands.gdb"},
                      scratch_.path(), {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()}});
  }

  ScratchDirectory scratch_;
};

TEST_F(Debugging, ValuesAreStLiterals) {
  const ProcessResult gdb = debug("break Main.st:53\ncontinue\n"
                                  "print TEXT\nprint wide\nprint delay\nprint fine\nprint day\n"
                                  "print moment\nprint noon\nprint list\nprint list[-1]\n"
                                  "print mask\nprint on\nprint color\nprint sums.total\n"
                                  "set print pretty off\n"
                                  "print table\nprint colors\nprint places[3]\n"
                                  "st print target^\nst print main.table[1, 2]\n"
                                  "st print MAIN.places[3].name\nst print gspeed\n"
                                  "st print list[sums.step]\nst print colors[n]\n");
  for (const char *line : {"Main.st:53",
                           "$1 = 'it$'s $Ncents'\n",
                           "$2 = \"été\"\n",
                           "$3 = T#1h1m1s500ms\n",
                           "$4 = LTIME#1s5ns\n",
                           "$5 = D#2024-02-29\n",
                           "$6 = DT#2026-11-21-10:00:01\n",
                           "$7 = TOD#12:30:00.25\n",
                           "[-1] = 7,\n",
                           "$9 = 7\n",
                           "$10 = 16#A5\n",
                           "$11 = TRUE\n",
                           "$12 = green (5)\n",
                           "$13 = 0\n",
                           "$14 = ARRAY[0..1] = {[0] = ARRAY[1..2] = {[1] = T#1ms, [2] = T#2ms}, "
                           "[1] = ARRAY[1..2] = {[1] = T#3ms, [2] = T#4ms}}\n",
                           "$15 = ARRAY[1..2] = {[1] = green (5), [2] = blue (6)}\n",
                           "$16 = {x = 1.5, y = 0.0, name = 'home'}\n",
                           "target^ = {x = 0.0, y = 0.1, name = ''}\n",
                           "main.table[1, 2] = T#4ms\n",
                           "MAIN.places[3].name = 'home'\n",
                           "gspeed = 2.5\n",
                           "list[sums.step] = 8\n"})
    EXPECT_THAT(gdb.out, HasSubstr(line));
  // The last command is the one that fails, as scripts end there.
  EXPECT_THAT(gdb.err, HasSubstr("index 3 is outside of 1..2"));
}

/// Expects the texts one after the other.
void expectInOrder(const ProcessResult &gdb, const std::vector<std::string> &texts) {
  size_t at = 0;
  for (const std::string &text : texts) {
    at = gdb.out.find(text, at);
    ASSERT_NE(at, std::string::npos) << text << "\nin\n" << gdb.out << gdb.err;
    at += text.size();
  }
}

TEST_F(Debugging, StepsLineByLine) {
  const ProcessResult gdb =
      debug("break Main.st:52\ncontinue\nnext\nstep\nstep\nstep\nprint calls\nfinish\n"
            "print STEP\nset var total = 20\nnext\nnext\nstep\nst print sums.total\n");
  expectInOrder(gdb, {"52\t  target", "\n53\t", "\n19\t", "\n8\t", "\n9\t", "$1 = 1\n", "\n20\t",
                      "Value returned is $2 = 1\n", "$3 = 6", "\n21\t", "\n22\t", "\n54\t",
                      "sums.total = 52\n"});
}

TEST_F(Debugging, FramesArePous) {
  const ProcessResult gdb = debug("st break base.count\nst break RATIO\ncontinue\nbt\nup\n"
                                  "st print step\nst print Calls\ncontinue\nbt\n");
  expectInOrder(gdb, {"Base.Count () at", "Main.st:8\n", "Totals () at", "Main.st:19\n",
                      "Main () at", "Main.st:53\n", "step = 6\n", "Calls = 0\n",
                      "Ratio (divisor=2) at", "Main () at"});
  EXPECT_THAT(gdb.out, Not(HasSubstr("runCycle")));
}

TEST_F(Debugging, ConditionsAndWatchpoints) {
  const ProcessResult gdb = debug("break Main.st:20 if total > 10\ncontinue\nprint total\n"
                                  "delete\nwatch total\ncontinue\n");
  expectInOrder(gdb, {"$1 = 12\n", "Old value = 12\n", "New value = 18\n", "21\t"});
}

TEST_F(Debugging, WatchesFromCycleToCycle) {
  const ProcessResult gdb =
      debug("break Main.st:53\ncontinue\ndelete\nwatch sums.total if sums.total > 12\ncontinue\n"
            "delete\nup\nwatch n\ncontinue\ncontinue\nwatch nothing\n");
  expectInOrder(gdb, {"Old value = 12\n", "New value = 18\n", "Old value = 5\n", "New value = 4\n",
                      "55\t", "New value = 2\n"});
  EXPECT_THAT(gdb.err, HasSubstr("No symbol \"nothing\" in current context"));
  EXPECT_THAT(gdb.err, Not(HasSubstr("Python")));
}

// The initial values of variables on one line do not reach to the next one.
TEST_F(Debugging, StopsAtTheFirstStatementInCyclesOnly) {
  const ProcessResult gdb = debug("break Main.st:3\ncontinue\nbt\nwatch n\ncontinue\nbreak "
                                  "Main.st:2\n",
                                  "PROGRAM Main\nVAR n : INT; k : INT := 3; END_VAR\n"
                                  "n := n + 1;\nk := n;\nEND_PROGRAM\n");
  expectInOrder(gdb, {"#0  Main () at", "Main.st:3\n", "New value = 1\n", "4\t"});
  EXPECT_THAT(gdb.out, Not(HasSubstr("2 locations")));
}

TEST_F(Debugging, SetsVariablesToLiterals) {
  std::string commands = "break Main.st:53\ncontinue\nset print pretty off\n";
  for (const char *set :
       {"TEXT := 'n$'eu$N'", "wide := \"\u00e9$20AC\"", "delay := T#1h_2.5s",
        "fine := LTIME#-1us7ns", "day := D#2030-01-31", "moment := DT#2030-01-31-23:59:58",
        "noon := TOD#23:59:59.5", "list[-1] := -16#7F", "table[1, 2] := t#5ms",
        "colors[2] := Color.red", "color := blue", "mask := 2#1111_0000", "on := FALSE",
        "gSpeed := -1.5E3", "Main.places[3].x := LREAL#7", "places[4] := places[3]", "n := DINT#-5",
        "sums.step := list[1]"})
    commands += std::string("st set ") + set + "\n";
  for (const char *print :
       {"text", "wide", "delay", "fine", "day", "moment", "noon", "list[-1]", "table[1, 2]",
        "colors[2]", "color", "mask", "on", "gSpeed", "places[4]", "n", "sums.step"})
    commands += std::string("st print ") + print + "\n";
  const ProcessResult gdb = debug(commands);
  for (const char *line :
       {"text = 'n$'eu$N'\n", "delay = T#1h2s500ms\n", "fine = LTIME#-1us7ns\n",
        "day = D#2030-01-31\n", "moment = DT#2030-01-31-23:59:58\n", "noon = TOD#23:59:59.5\n",
        "list[-1] = -127\n", "table[1, 2] = T#5ms\n", "colors[2] = red (0)\n", "color = blue (6)\n",
        "mask = 16#F0\n", "on = FALSE\n", "gSpeed = -1.5e+03\n",
        "places[4] = {x = 7.0, y = 0.0, name = 'home'}\n", "n = -5\n", "sums.step = 9\n"})
    EXPECT_THAT(gdb.out, HasSubstr(line)) << gdb.err;
  const std::string stop = "break Main.st:53\ncontinue\nst set ";
  EXPECT_THAT(debug(stop + "mask := 256\n").err, HasSubstr("256 is outside of BYTE"));
  EXPECT_THAT(debug(stop + "places[3].name := '123456789012345678901'\n").err,
              HasSubstr("has no room in this STRING"));
  EXPECT_THAT(debug(stop + "delay := 5\n").err,
              HasSubstr("`5` is neither a literal for `delay` (TIME) nor a variable"));
  EXPECT_THAT(debug(stop + "n := mask\n").err,
              HasSubstr("`mask` is of another type than `n` (DINT)"));
  EXPECT_THAT(debug(stop + "n\n").err, HasSubstr("say what: st set Main.total := 20"));
}

// A transition stops only while its step is active; an action is called where a step names it.
TEST_F(Debugging, StopsInCharts) {
  const ProcessResult gdb = debug("break Main.st:7\ncontinue\nst print First.t\nprint n\ncontinue\n"
                                  "print n\ndelete\nbreak Main.st:12\ncontinue\nbt\n"
                                  "st print Second.x\nst print First.x\n",
                                  "PROGRAM Main\nVAR n : INT; lamp : BOOL; END_VAR\n"
                                  "INITIAL_STEP First:\n  Count;\nEND_STEP\n"
                                  "TRANSITION FROM First TO Second :=\n  n >= 2;\nEND_TRANSITION\n"
                                  "STEP Second: lamp(N); END_STEP\n"
                                  "TRANSITION FROM Second TO First := lamp; END_TRANSITION\n"
                                  "ACTION Count:\n  n := n + 1;\nEND_ACTION\nEND_PROGRAM\n");
  expectInOrder(gdb, {"7\t  n >= 2;", "First.t = T#10ms\n", "$1 = 1\n", "7\t", "$2 = 2\n", "12\t",
                      "Count () at", "Main () at", "Main.st:4\n", "Second.x = TRUE\n",
                      "First.x = FALSE\n"});
}

TEST_F(Debugging, StopsAtExceptions) {
  const ProcessResult gdb = debug("st catch\ncontinue\nbt\n");
  EXPECT_THAT(gdb.out, HasSubstr("Ratio (divisor=0)"));
  EXPECT_THAT(gdb.out, Not(HasSubstr("TaskSet")));
}

TEST_F(Debugging, FindsTheSourcesOfAProject) {
  std::filesystem::create_directories(scratch_.path() / "plant" / "src");
  writeFile(scratch_.path() / "plant" / "src" / "Main.st", kProgram);
  writeFile(scratch_.path() / "plant" / "stride.toml", "[project]\nname = \"Plant\"\n");
  writeFile(scratch_.path() / "commands.gdb", "break Main.st:54\ncontinue\n");
  for (const char *path : {"plant", "plant/stride.toml"}) {
    const ProcessResult gdb = runProcess({STRIDE_BINARY_DIR "/stride", "debug", path, "-W",
                                          "off=lints", "--batch", "-x", "commands.gdb"},
                                         scratch_.path());
    EXPECT_THAT(gdb.out, HasSubstr("54\t  n := n - 1;")) << gdb.err;
  }
}

TEST_F(Debugging, SaysWhatItDoesNotFind) {
  EXPECT_THAT(debug("st break Nothing\n").err, HasSubstr("there is no POU `Nothing`"));
  EXPECT_THAT(debug("st print Main.n\n").err, HasSubstr("no POU is being executed"));
  EXPECT_THAT(debug("st break Main\ncontinue\nst print sums.totals\n").err,
              HasSubstr("there is no `totals` in `sums`"));
  EXPECT_THAT(debug("st break Main\ncontinue\nst print n..x\n").err, HasSubstr("no part of an ST"));
}

} // namespace
} // namespace stride::test
