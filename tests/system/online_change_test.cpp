// Online change from end to end: two versions of a program go through the compiler and g++, the
// first one runs some cycles, its state is carried over, the second one goes on.
#include "live_application.hpp"

#include <gmock/gmock-more-matchers.h>

namespace stride::test {
namespace {

using app::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(OnlineChange, AddedRemovedAndReordered) {
  Live live(R"(
VAR_GLOBAL total : DINT := 100; unused : LREAL; END_VAR
PROGRAM PLC_PRG
VAR a : INT := 1; gone : DINT; b : LREAL := 0.5; c : BOOL; END_VAR
  a := a + 1; gone := gone + 1; b := b * 2; c := NOT c; total := total + a;
END_PROGRAM
)");
  live.run(3); // a = 4, b = 4, c = TRUE, total = 100 + 2 + 3 + 4
  EXPECT_EQ(live.values({"PLC_PRG.a", "PLC_PRG.b", "PLC_PRG.c", "total"}), "4 4.0 TRUE 109");
  live.change(R"(
VAR_GLOBAL fresh : INT := 7; total : DINT := -1; END_VAR
PROGRAM PLC_PRG
VAR c : BOOL; added : INT := 40; b : LREAL := 77; a : INT := 9; END_VAR
  a := a + 10; added := added + 1; b := b + 1; c := NOT c; total := total + a;
END_PROGRAM
)");
  EXPECT_EQ(live.verdict, Verdict::Silent);
  EXPECT_THAT(live.events, IsEmpty());
  EXPECT_THAT(live.report, HasSubstr("added: Main.fresh : INT\n"));
  EXPECT_THAT(live.report, HasSubstr("dropped: Main.unused : LREAL\n"));
  EXPECT_THAT(live.report, HasSubstr("added: PLC_PRG.added : INT\n"));
  EXPECT_THAT(live.report, HasSubstr("dropped: PLC_PRG.gone : DINT\n"));
  EXPECT_EQ(live.values({"PLC_PRG.a", "PLC_PRG.b", "PLC_PRG.c", "PLC_PRG.added", "total", "fresh"}),
            "4 4.0 TRUE 40 109 7");
  live.run(2); // a = 24, b = 6, c = TRUE, added = 42, total = 109 + 14 + 24
  EXPECT_EQ(live.values({"PLC_PRG.a", "PLC_PRG.b", "PLC_PRG.c", "PLC_PRG.added", "total"}),
            "24 6.0 TRUE 42 147");
}

// A type that the compiler provides: values of a longer table are kept as those of a longer array.
TEST(OnlineChange, CamTables) {
  Live live(R"(
PROGRAM PLC_PRG
VAR t : SMC_CAMTable_UINT_3_1 := (Table := [1, 2, 3], fEditorMasterMax := 360); n : INT; END_VAR
  t.Table[n] := 70; n := n + 1;
END_PROGRAM
)");
  live.run(1);
  live.change(R"(
PROGRAM PLC_PRG
VAR
  n : INT; added : SMC_CAMTable_REAL_2_2;
  t : SMC_CAMTable_UINT_4_1 := (Table := [5, 5, 5, 5], fTableSlaveMin := 4);
END_VAR
  t.Table[n] := 80; n := n + 1;
END_PROGRAM
)");
  EXPECT_EQ(live.verdict, Verdict::Silent);
  live.run(1);
  EXPECT_EQ(
      live.values({"PLC_PRG.t.Table[0]", "PLC_PRG.t.Table[1]", "PLC_PRG.t.Table[2]",
                   "PLC_PRG.t.Table[3]", "PLC_PRG.t.fEditorMasterMax", "PLC_PRG.t.fTableSlaveMin",
                   "PLC_PRG.t.fTableSlaveMax", "PLC_PRG.added.fTableSlaveMax"}),
      "70 80 3 5 360.0 0.0 1.0 1.0");
}

// A chart goes on in its active steps, with their times and what its actions have stored.
TEST(OnlineChange, Charts) {
  Live live(R"(
PROGRAM PLC_PRG
VAR lamp, go : BOOL; n : INT; END_VAR
INITIAL_STEP Begin: lamp(S); END_STEP
TRANSITION FROM Begin TO Work := TRUE; END_TRANSITION
STEP Work: Count; END_STEP
ACTION Count: n := n + 1; END_ACTION
END_PROGRAM
)");
  live.run(4);
  EXPECT_EQ(live.values({"PLC_PRG.Begin.x", "PLC_PRG.Work.x", "PLC_PRG.Work.t", "PLC_PRG.lamp",
                         "PLC_PRG.n"}),
            "FALSE TRUE T#20ms TRUE 3");
  live.change(R"(
PROGRAM PLC_PRG
VAR go, lamp : BOOL; n : INT; END_VAR
INITIAL_STEP Begin: lamp(S); END_STEP
TRANSITION FROM Begin TO Added := TRUE; END_TRANSITION
STEP Added: END_STEP
TRANSITION FROM Added TO Work := TRUE; END_TRANSITION
STEP Work: Count; END_STEP
TRANSITION FROM Work TO Added := Work.t >= T#50ms; END_TRANSITION
ACTION Count: n := n + 10; END_ACTION
END_PROGRAM
)");
  EXPECT_EQ(live.verdict, Verdict::Silent);
  live.run(2);
  EXPECT_EQ(live.values({"PLC_PRG.Begin.x", "PLC_PRG.Work.x", "PLC_PRG.Work.t", "PLC_PRG.lamp",
                         "PLC_PRG.n"}),
            "FALSE TRUE T#40ms TRUE 23");
  live.run(1); // the final scan
  EXPECT_EQ(live.values({"PLC_PRG.Added.x", "PLC_PRG.Work.x", "PLC_PRG.n"}), "TRUE FALSE 33");
  live.change(R"(
PROGRAM PLC_PRG
VAR go, lamp : BOOL; n : INT; END_VAR
INITIAL_STEP Begin: lamp(S); END_STEP
TRANSITION FROM Begin TO Work := TRUE; END_TRANSITION
STEP Work: END_STEP
END_PROGRAM
)");
  live.run(1); // the active step is gone
  EXPECT_EQ(live.values({"PLC_PRG.Begin.x", "PLC_PRG.Work.x", "PLC_PRG.lamp"}), "TRUE FALSE TRUE");
}

TEST(OnlineChange, RetypedAndRenamed) {
  Live live(R"(
TYPE Mode : (off, manual, automatic); END_TYPE
VAR_GLOBAL CONSTANT kLimit : INT := 10; END_VAR
PROGRAM PLC_PRG
VAR
  i : INT := -3; r : REAL := 0.5; t : TIME := T#1s500ms; w : DINT := 70000; m : Mode := automatic;
  txt : STRING(8) := 'abcdefgh'; small : STRING(3) := 'xyz'; old : INT := 5; swapA : INT := 1;
  swapB : INT := 2; fresh : INT := 1; octet : BYTE := 200; l : INT;
END_VAR
  l := kLimit;
END_PROGRAM
)");
  live.run(1);
  live.change(R"(
TYPE Mode : (off, wait, manual, automatic); END_TYPE
VAR_GLOBAL CONSTANT kLimit : INT := 20; END_VAR
PROGRAM PLC_PRG
VAR
  i : LINT; r : LREAL; t : LTIME; w : INT := 12; m : Mode; txt : STRING(5); small : STRING(30);
  {attribute 'renamed_from' := 'old'} new_ : INT;
  {attribute 'renamed_from' := 'swapB'} swapA : INT;
  {attribute 'renamed_from' := 'swapA'} swapB : INT;
  {attribute 'init_on_onlchange'} fresh : INT := 33;
  octet : INT; l : INT;
END_VAR
  l := kLimit;
END_PROGRAM
)");
  EXPECT_EQ(live.verdict, Verdict::Losses);
  EXPECT_EQ(live.values({"PLC_PRG.i", "PLC_PRG.r", "PLC_PRG.t", "PLC_PRG.w", "PLC_PRG.m"}),
            "-3 0.5 LTIME#1s500ms 12 automatic");
  EXPECT_EQ(live.values({"PLC_PRG.txt", "PLC_PRG.small", "PLC_PRG.new_", "PLC_PRG.swapA",
                         "PLC_PRG.swapB", "PLC_PRG.fresh", "PLC_PRG.octet", "PLC_PRG.l"}),
            "'abcde' 'xyz' 5 2 1 33 200 10");
  EXPECT_THAT(live.report, HasSubstr("lost: PLC_PRG.w : DINT -> INT\n"));
  EXPECT_THAT(live.report, HasSubstr("may be cut: PLC_PRG.txt : STRING(8) -> STRING(5)\n"));
  EXPECT_THAT(live.report,
              HasSubstr("converted: PLC_PRG.m : Mode (manual = 1 is now 2, automatic = "
                        "2 is now 3)\n"));
  EXPECT_THAT(live.events, ElementsAre("PLC_PRG.txt: its text was cut to 5 characters"));
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.l", "kLimit"}), "20 20");
}

constexpr const char *kCounter = R"(
FUNCTION_BLOCK Counter
VAR_INPUT step : INT := 1; END_VAR
VAR_IN_OUT total : DINT; END_VAR
VAR_OUTPUT count : INT; END_VAR
  count := count + step; total := total + step;
END_FUNCTION_BLOCK
)";

TEST(OnlineChange, Bits) {
  Live live(R"(
TYPE Flags : STRUCT a, b, c : BIT; n : INT; d : BIT; e : BOOL; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR f : Flags; g : ARRAY[0..1] OF Flags; same : ARRAY[0..1] OF Flags; END_VAR
  f.b := TRUE; f.d := TRUE; f.e := TRUE; f.n := 5; g[1].c := TRUE; same := g;
END_PROGRAM
)");
  live.run(1);
  live.change(R"(
TYPE Flags : STRUCT x, c, b, e : BIT; d : BOOL; n : INT; a : BIT := TRUE; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR g : ARRAY[0..1] OF Flags; f : Flags; same : ARRAY[0..1] OF Flags; END_VAR
  f.x := f.b; g[0] := f;
END_PROGRAM
)");
  EXPECT_EQ(live.values({"PLC_PRG.f.a", "PLC_PRG.f.b", "PLC_PRG.f.c", "PLC_PRG.f.d", "PLC_PRG.f.e",
                         "PLC_PRG.f.n", "PLC_PRG.f.x"}),
            "FALSE TRUE FALSE TRUE TRUE 5 FALSE");
  EXPECT_EQ(
      live.values({"PLC_PRG.g[0].c", "PLC_PRG.g[1].c", "PLC_PRG.g[1].b", "PLC_PRG.same[1].c"}),
      "FALSE TRUE FALSE TRUE");
  live.run(1);
  EXPECT_EQ(live.values({"PLC_PRG.f.x", "PLC_PRG.g[0].x", "PLC_PRG.g[0].c"}), "TRUE TRUE FALSE");
}

TEST(OnlineChange, InstancesInArraysAndStructures) {
  Live live(std::string(kCounter) + R"(
TYPE Motor : STRUCT speed : REAL := 1.5; counters : ARRAY[1..2] OF Counter; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR motors : ARRAY[0..2] OF Motor; sum : DINT; other : DINT; i : INT; k : INT; END_VAR
  FOR i := 0 TO 2 DO
    FOR k := 1 TO 2 DO motors[i].counters[k](step := k + i, total := sum); END_FOR
    motors[i].speed := motors[i].speed * 2;
  END_FOR
END_PROGRAM
)");
  live.run(2);
  // each cycle adds 1 + 2, 2 + 3, 3 + 4 = 15
  EXPECT_EQ(live.values({"PLC_PRG.sum", "PLC_PRG.motors[2].counters[2].count"}), "30 8");
  live.change(std::string(kCounter) + R"(
TYPE Motor : STRUCT
  label : STRING(5) := 'm'; counters : ARRAY[1..3] OF Counter; extra : LREAL := 2.5; speed : REAL := 9;
END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR other : DINT; motors : ARRAY[1..3] OF Motor; i : INT; sum : DINT; k : INT; END_VAR
  other := other + motors[2].counters[2].count;
END_PROGRAM
)");
  EXPECT_EQ(live.verdict, Verdict::Losses); // motors[0]
  EXPECT_THAT(live.report, HasSubstr("elements lost: PLC_PRG.motors : "));
  EXPECT_THAT(live.report, HasSubstr("added: PLC_PRG.motors[1].extra : LREAL in 2 places\n"));
  EXPECT_EQ(
      live.values({"PLC_PRG.motors[1].counters[1].count", "PLC_PRG.motors[1].counters[2].count",
                   "PLC_PRG.motors[2].counters[1].count", "PLC_PRG.motors[2].counters[2].count",
                   "PLC_PRG.motors[3].counters[1].count", "PLC_PRG.motors[2].counters[3].count",
                   "PLC_PRG.motors[2].counters[3].step", "PLC_PRG.motors[2].counters[2].step"}),
      "4 6 6 8 0 0 1 4");
  EXPECT_EQ(live.values({"PLC_PRG.motors[1].speed", "PLC_PRG.motors[3].speed",
                         "PLC_PRG.motors[1].label", "PLC_PRG.motors[1].extra"}),
            "6.0 9.0 'm' 2.5");
  // the in-outs of the instances lead to the sum, wherever it is now
  EXPECT_EQ(
      live.values({"PLC_PRG.motors[1].counters[2].total", "PLC_PRG.motors[3].counters[1].total"}),
      "30 NULL");
  EXPECT_EQ(live.application().stateBlock().belowFourGiB(), true);
  live.run(2);
  EXPECT_EQ(live["PLC_PRG.other"], "16");
}

TEST(OnlineChange, AnInOutThatIsNotBoundAgain) {
  // The body uses the in-out in a call without binding, which keeps the last one.
  Live live(std::string(kCounter) + R"(
VAR_GLOBAL x : DINT; y : DINT; END_VAR
PROGRAM PLC_PRG
VAR c : Counter; n : INT; END_VAR
  n := n + 1;
  IF n = 1 THEN c(total := y); END_IF
END_PROGRAM
)");
  live.run(3);
  EXPECT_EQ(live.values({"x", "y", "PLC_PRG.c.total"}), "0 1 1");
  live.change(std::string(kCounter) + R"(
VAR_GLOBAL y : DINT; filler : STRING; x : DINT; END_VAR
PROGRAM PLC_PRG
VAR filler : LREAL; n : INT; c : Counter; END_VAR
  y := y + 10;
END_PROGRAM
)");
  live.run(2);
  EXPECT_EQ(live.values({"x", "y", "PLC_PRG.c.total"}), "0 21 21");
}

TEST(OnlineChange, PointersIntoTheApplication) {
  const std::string types = std::string(kCounter) + R"(
TYPE Point : STRUCT x : INT; y : INT; END_STRUCT END_TYPE
)";
  Live live(types + R"(
VAR_GLOBAL g : INT := 1; gone : INT := 2; table : ARRAY[1..5] OF INT := [10, 20, 30, 40, 50]; END_VAR
PROGRAM PLC_PRG
VAR
  pt : Point := (x := 3, y := 4); pts : ARRAY[0..3] OF Point; c : Counter; m : ARRAY[1..2, 1..3] OF INT;
  pScalar, pMember, pElement, pNested, pGone, pOutput, pLast, pOutside : POINTER TO INT;
  pPoint, pPoints : POINTER TO Point; pCounter : POINTER TO Counter; pArray : POINTER TO ARRAY[1..5] OF INT;
  pNull : POINTER TO INT; pp : POINTER TO POINTER TO INT; r : REFERENCE TO INT; sum : DINT;
END_VAR
  pScalar := ADR(g); pMember := ADR(pt.y); pElement := ADR(table[4]); pNested := ADR(m[2, 3]);
  pGone := ADR(gone); pOutput := ADR(c.count); pLast := ADR(pts[3].y); pOutside := ADR(table[5]);
  pPoint := ADR(pt); pPoints := ADR(pts[2]); pCounter := ADR(c); pArray := ADR(table);
  pp := ADR(pElement); r REF= table[2];
  m[2, 3] := 23; pts[2].x := 22; pts[3].y := 33;
  c(step := 5, total := sum);
END_PROGRAM
)");
  live.run(1);
  live.change(types + R"(
VAR_GLOBAL table : ARRAY[1..4] OF INT := [4(1)]; filler : STRING(3); g : INT; END_VAR
PROGRAM PLC_PRG
VAR
  r : REFERENCE TO INT; pp : POINTER TO POINTER TO INT; filler : ARRAY[1..7] OF BYTE;
  pNull : POINTER TO INT;
  pScalar, pMember, pElement, pNested, pGone, pOutput, pLast, pOutside : POINTER TO INT;
  pPoint, pPoints : POINTER TO Point; pCounter : POINTER TO Counter; pArray : POINTER TO ARRAY[1..4] OF INT;
  c : Counter; m : ARRAY[0..3, 2..4] OF INT; pts : ARRAY[1..9] OF Point; pt : Point; sum : DINT;
END_VAR
  pScalar^ := pScalar^ + 100; pMember^ := pMember^ + 100; pElement^ := pElement^ + 100;
  pNested^ := pNested^ + 100; pOutput^ := pOutput^ + 100; pLast^ := pLast^ + 100;
  pPoint^.x := pPoint^.x + 100; pPoints^.x := pPoints^.x + 100; pArray^[2] := pArray^[2] + 100;
  pp^^ := pp^^ + 1000; r := r + 1000; pCounter^(step := 1, total := sum);
END_PROGRAM
)");
  EXPECT_THAT(
      live.events,
      ElementsAre("PLC_PRG.pGone is now 0: it pointed to Main.gone, which the new build does "
                  "not have",
                  "PLC_PRG.pOutside is now 0: it pointed to Main.table[5], which the new build "
                  "does not have"));
  EXPECT_EQ(
      live.values({"PLC_PRG.pScalar^", "PLC_PRG.pMember^", "PLC_PRG.pElement^", "PLC_PRG.pNested^",
                   "PLC_PRG.pOutput^", "PLC_PRG.pLast^", "PLC_PRG.pPoint^.y", "PLC_PRG.pPoints^.x",
                   "PLC_PRG.pCounter^.count", "PLC_PRG.pNull^", "PLC_PRG.pp^^", "PLC_PRG.r"}),
      "1 4 40 23 5 33 4 22 5 NULL 40 20");
  live.run(1);
  EXPECT_EQ(
      live.values({"g", "PLC_PRG.pt.x", "PLC_PRG.pt.y", "table[4]", "table[2]", "PLC_PRG.m[2,3]",
                   "PLC_PRG.pts[3].y", "PLC_PRG.pts[2].x", "PLC_PRG.c.count", "PLC_PRG.sum"}),
      "101 103 104 1140 1120 123 133 122 106 6");
}

TEST(OnlineChange, StaticsOfFunctions) {
  Live live(R"(
FUNCTION Next : DINT
VAR_STAT last : DINT := 10; END_VAR
  last := last + 1; Next := last;
END_FUNCTION
PROGRAM PLC_PRG
VAR n : DINT; END_VAR
  n := Next();
END_PROGRAM
)");
  live.run(3);
  EXPECT_EQ(live["PLC_PRG.n"], "13");
  live.change(R"(
FUNCTION Next : DINT
VAR_STAT calls : INT; last : DINT := 0; END_VAR
  calls := calls + 1; last := last + 100; Next := last + calls;
END_FUNCTION
PROGRAM PLC_PRG
VAR x : BOOL; n : DINT; END_VAR
  n := Next();
END_PROGRAM
)");
  live.run(1);
  EXPECT_EQ(live["PLC_PRG.n"], "114");
}

TEST(OnlineChange, TimersGoOn) {
  const auto program = [](const char *variables) {
    return std::string("PROGRAM PLC_PRG\nVAR\n") + variables +
           R"( cycles : INT; done : INT; c : CTU; END_VAR
  cycles := cycles + 1;
  t(IN := TRUE, PT := T#100ms);
  c(CU := (cycles MOD 2) = 0, PV := 4);
  IF t.Q AND done = 0 THEN done := cycles; END_IF
END_PROGRAM
)";
  };
  Live without(program("t : TON; "));
  without.run(15);
  Live live(program("t : TON; "));
  live.run(6);
  EXPECT_EQ(live.values({"PLC_PRG.t.ET", "PLC_PRG.t.Q"}), "T#50ms FALSE");
  live.change(program("filler : LREAL; t : TON; u : TOF; "));
  live.run(9);
  const std::vector<std::string> paths = {"PLC_PRG.done", "PLC_PRG.t.ET", "PLC_PRG.t.Q",
                                          "PLC_PRG.c.CV", "PLC_PRG.c.Q"};
  EXPECT_EQ(live.values(paths), without.values(paths));
  EXPECT_EQ(live["PLC_PRG.done"], "11");
}

TEST(OnlineChange, StructuresWithBases) {
  Live live(R"(
TYPE Base : STRUCT id : INT := 1; flag : BOOL; END_STRUCT END_TYPE
TYPE Derived EXTENDS Base : STRUCT value : LREAL; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR d : ARRAY[1..2] OF Derived; b : Base; p : POINTER TO INT; END_VAR
  d[2].id := 42; d[2].flag := TRUE; d[2].value := 1.25; b.id := 7; p := ADR(d[2].id);
END_PROGRAM
)");
  live.run(1);
  live.change(R"(
TYPE Base : STRUCT value : LREAL; extra : LREAL := 3; id : INT := 1; END_STRUCT END_TYPE
TYPE Derived EXTENDS Base : STRUCT own : INT := 5; flag : BOOL; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR p : POINTER TO INT; b : Base; d : ARRAY[1..2] OF Derived; END_VAR
  p^ := p^ + 1;
END_PROGRAM
)");
  live.run(1);
  EXPECT_EQ(
      live.values({"PLC_PRG.d[2].id", "PLC_PRG.d[2].flag", "PLC_PRG.d[2].value", "PLC_PRG.d[2].own",
                   "PLC_PRG.d[2].extra", "PLC_PRG.b.id", "PLC_PRG.b.extra", "PLC_PRG.d[1].id"}),
      "43 TRUE 1.25 5 3.0 7 3.0 1");
}

TEST(OnlineChange, RenamedTypesAndPrograms) {
  Live live(R"(
FUNCTION_BLOCK Old
VAR_OUTPUT n : INT; END_VAR
  n := n + 1;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR a : Old; b : Old; END_VAR
  a(); b();
END_PROGRAM
)");
  live.run(5);
  live.change(R"(
{attribute 'renamed_from' := 'Old'}
FUNCTION_BLOCK New
VAR_OUTPUT n : INT; END_VAR
  n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Other
VAR_OUTPUT n : INT; END_VAR
  n := n + 1;
END_FUNCTION_BLOCK
{attribute 'renamed_from' := 'PLC_PRG'}
PROGRAM Main
VAR a : New; b : Other; END_VAR
  a(); b();
END_PROGRAM
)");
  EXPECT_THAT(live.report, HasSubstr("lost: Main.b : Old -> Other\n"));
  EXPECT_THAT(live.report, HasSubstr("renamed: Main : PLC_PRG -> Main (was PLC_PRG)"));
  EXPECT_EQ(live.values({"Main.a.n", "Main.b.n"}), "5 0");
}

TEST(OnlineChange, ManyChangesOneAfterTheOther) {
  const auto version = [](int k) {
    std::string text = "PROGRAM PLC_PRG\nVAR\n";
    for (int i = 0; i < k; ++i)
      text += "  filler" + std::to_string(i) + " : ARRAY[0.." + std::to_string(i) + "] OF BYTE;\n";
    text += "  n : DINT; p : POINTER TO DINT;\nEND_VAR\n"
            "  IF p = 0 THEN p := ADR(n); END_IF\n  p^ := p^ + 1;\nEND_PROGRAM\n";
    return text;
  };
  Live live(version(0));
  for (int k = 1; k < 5; ++k) {
    live.run(10);
    live.change(version(k));
    EXPECT_THAT(live.events, IsEmpty());
  }
  live.run(10);
  EXPECT_EQ(live.values({"PLC_PRG.n", "PLC_PRG.p^"}), "50 50");
}

} // namespace
} // namespace stride::test
