// Statements: loops at the limits of their types, CASE, EXIT, assignments, checks.

#include "program.hpp"

#include <gtest/gtest.h>

namespace stc::test {

TEST(CodegenStatements, ForLoops) {
  App app(R"(
PROGRAM Main
VAR
  u : USINT; n : INT; d : INT; m : INT; i : INT; last : INT; s : SINT; k : INT; step : INT := -2; sum : DINT;
  never : INT; j : INT; once : INT; over : INT; lim : INT := 3; evaluated : INT; li : LINT; ll : INT;
END_VAR
  FOR u := 250 TO 255 DO n := n + 1; END_FOR
  FOR s := 100 TO 127 BY 10 DO d := d + 1; END_FOR
  FOR i := 5 TO 1 BY -1 DO m := m + i; END_FOR
  last := i;
  FOR k := 9 TO 1 BY step DO sum := sum + k; END_FOR
  FOR j := 3 TO 2 DO never := never + 1; END_FOR
  FOR once := 7 TO 7 DO over := over + 1; END_FOR
  FOR j := 1 TO lim DO lim := 10; evaluated := evaluated + 1; END_FOR
  FOR li := 9223372036854775806 TO 9223372036854775807 DO ll := ll + 1; END_FOR
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["Main.n"], "6");
  EXPECT_EQ(app["Main.u"], "0");
  EXPECT_EQ(app["Main.d"], "3");
  EXPECT_EQ(app["Main.s"], "-126");
  EXPECT_EQ(app["Main.m"], "15");
  EXPECT_EQ(app["Main.last"], "0");
  EXPECT_EQ(app["Main.sum"], "25");
  EXPECT_EQ(app["Main.k"], "-1");
  EXPECT_EQ(app["Main.never"], "0");
  EXPECT_EQ(app["Main.over"], "1");
  EXPECT_EQ(app["Main.once"], "8");
  EXPECT_EQ(app["Main.evaluated"], "3");
  EXPECT_EQ(app["Main.ll"], "2");
  EXPECT_EQ(app["Main.li"], "-9223372036854775808");
}

TEST(CodegenStatements, EndlessLoopsEnd) {
  App app(R"(
PROGRAM Main
VAR i : INT; step : INT; mode : INT; END_VAR
  mode := mode + 1;
  CASE mode OF
    1: WHILE TRUE DO i := i + 1; END_WHILE
    2: FOR i := 1 TO 10 BY step DO ; END_FOR
    3: REPEAT CONTINUE; UNTIL FALSE END_REPEAT
    4: FOR i := 1 TO 10 DO i := 5; END_FOR
  END_CASE
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "EndlessLoop Main.st:6:8");
  app.run();
  EXPECT_EQ(app.exception(), "EndlessLoop Main.st:7:8");
  app.run();
  EXPECT_EQ(app.exception(), "EndlessLoop Main.st:8:8");
  app.run();
  EXPECT_EQ(app.exception(), "EndlessLoop Main.st:9:8");
}

TEST(CodegenStatements, LoopsInCallsCount) {
  App app(R"(
FUNCTION Busy : INT
VAR i : INT; END_VAR
  WHILE i < 1000 DO i := i + 1; END_WHILE
  Busy := i;
END_FUNCTION
PROGRAM Main
VAR n : DINT; x : INT; END_VAR
  WHILE TRUE DO x := Busy(); n := n + 1; END_WHILE
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "EndlessLoop Main.st:4:3");
  EXPECT_EQ(app["Main.n"], "99"); // the budget of 100,000 rounds is used up in the next call
}

TEST(CodegenStatements, LoopControl) {
  App app(R"(
TYPE Color : (red, green := 5, blue); END_TYPE
PROGRAM Main
VAR i : INT; j : INT; n : INT; c : Color := green; name : STRING; w : INT; r : INT; big : INT; big2 : INT; odd : INT; END_VAR
  FOR i := 1 TO 100 DO
    CASE i OF
      1, 2: CONTINUE;
      3..5: n := n + 10;
      Color.blue: EXIT;
    ELSE
      n := n + 1000;
    END_CASE
    n := n + 1;
  END_FOR
  CASE c OF
    red: name := 'red';
    green: name := 'green';
    Color.blue: name := 'blue';
  END_CASE
  WHILE w < 10 DO
    w := w + 1;
    IF w MOD 2 = 0 THEN CONTINUE; END_IF
    odd := odd + 1;
    IF w = 7 THEN EXIT; END_IF
  END_WHILE
  REPEAT r := r + 1; UNTIL r >= 3 END_REPEAT
  FOR j := 0 TO 3000 BY 1000 DO
    CASE j OF
      0: big := big + 1;
      1..1500: big := big + 10;
      2000..32767: big := big + 100;
    END_CASE
  END_FOR
  IF n > 100 THEN big2 := 1; ELSIF n = 33 THEN big2 := 2; ELSE big2 := 3; END_IF
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["Main.n"], "33");
  EXPECT_EQ(app["Main.i"], "6");
  EXPECT_EQ(app["Main.name"], "'green'");
  EXPECT_EQ(app["Main.odd"], "4");
  EXPECT_EQ(app["Main.w"], "7");
  EXPECT_EQ(app["Main.r"], "3");
  EXPECT_EQ(app["Main.big"], "211");
  EXPECT_EQ(app["Main.big2"], "2");
}

TEST(CodegenStatements, Assignments) {
  App app(R"(
TYPE Point : STRUCT x : INT; y : INT; END_STRUCT END_TYPE
TYPE Point3 EXTENDS Point : STRUCT z : INT; END_STRUCT END_TYPE
PROGRAM Main
VAR
  a : INT; b : DINT; c : LINT; p : Point; q : Point; t : Point3; m : ARRAY[0..1, -1..1] OF INT; n : ARRAY[0..1, -1..1] OF INT;
  s : BOOL; r : BOOL := TRUE; w : WORD; ref : REFERENCE TO INT; ptr : POINTER TO Point; pp : POINTER TO POINTER TO Point;
  k : INT := 1; aps : ARRAY[1..2] OF Point; viaPtr : INT; str : STRING(4); bits : BYTE; rows : ARRAY[0..1] OF ARRAY[-1..1] OF INT;
  isNull : BOOL; same : BOOL;
END_VAR
  c := b := a := 7;
  p.x := 3; p.y := 4;
  q := p;
  t.x := 1; t.z := 9;
  m[k, k - 1] := 5;
  n := m;
  rows[1] := n[1];
  s S= TRUE;
  s S= FALSE;
  r R= TRUE;
  w.4 S= TRUE;
  ref REF= a;
  ref := ref + 1;
  ptr := ADR(aps[2]);
  ptr^.x := 42;
  pp := ADR(ptr);
  viaPtr := pp^^.x;
  isNull := ptr = 0;
  same := ptr = ADR(aps[2]);
  bits.0 := bits.1 := TRUE;
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["Main.a"], "8");
  EXPECT_EQ(app["Main.b"], "7");
  EXPECT_EQ(app["Main.c"], "7");
  EXPECT_EQ(app["Main.q.y"], "4");
  EXPECT_EQ(app["Main.t.x"], "1");
  EXPECT_EQ(app["Main.t.z"], "9");
  EXPECT_EQ(app["Main.n[1,0]"], "5");
  EXPECT_EQ(app["Main.rows[1,0]"], "5");
  EXPECT_EQ(app["Main.s"], "TRUE");
  EXPECT_EQ(app["Main.r"], "FALSE");
  EXPECT_EQ(app["Main.w"], "16");
  EXPECT_EQ(app["Main.aps[2].x"], "42");
  EXPECT_EQ(app["Main.viaPtr"], "42");
  EXPECT_EQ(app["Main.ptr^.x"], "42");
  EXPECT_EQ(app["Main.isNull"], "FALSE");
  EXPECT_EQ(app["Main.same"], "TRUE");
  EXPECT_EQ(app["Main.bits"], "3");
}

TEST(CodegenStatements, ChecksRaise) {
  App app(R"(
PROGRAM Main
VAR
  mode : INT; i : INT := 4; a : ARRAY[1..3] OF INT; z : INT; p : POINTER TO INT; r : REFERENCE TO INT;
  sub : INT(0..10); x : INT; b : BOOL;
END_VAR
  mode := mode + 1;
  CASE mode OF
    1: x := a[i];
    2: x := 5 / z;
    3: x := 5 MOD z;
    4: x := p^;
    5: x := r;
    6: sub := i * 3;
    7: b := i > 100 AND a[i] = 0;
    8: b := i > 100 AND_THEN a[i] = 0;
  END_CASE
END_PROGRAM
)");
  const auto next = [&] {
    app.run();
    return app.exception();
  };
  EXPECT_EQ(next(), "IndexOutOfRange Main.st:9:15");
  EXPECT_EQ(next(), "DivisionByZero Main.st:10:15");
  EXPECT_EQ(next(), "DivisionByZero Main.st:11:15");
  EXPECT_EQ(next(), "NullPointer Main.st:12:13");
  EXPECT_EQ(next(), "NullPointer Main.st:13:13");
  EXPECT_EQ(next(), "RangeViolation Main.st:14:15");
  EXPECT_EQ(next(), "IndexOutOfRange Main.st:15:27"); // AND evaluates both sides
  EXPECT_EQ(next(), "");                              // AND_THEN does not
}

TEST(CodegenStatements, Unchecked) {
  App app(R"(
PROGRAM Main
VAR i : INT := 2; a : ARRAY[1..3] OF INT := [1, 2, 3]; z : INT; x : INT; sub : INT(0..10); p : POINTER TO INT; END_VAR
  p := ADR(a[3]);
  x := a[i] * 10 + p^;
  sub := i * 30;
  i := 1 / z;
END_PROGRAM
)",
          {.checks = false, .library = {}});
  app.run();
  EXPECT_EQ(app["Main.x"], "23");
  EXPECT_EQ(app["Main.sub"], "60");
  EXPECT_EQ(app.exception(), "DivisionByZero Main.st:7:10"); // division is always tested
}

TEST(CodegenStatements, LongChains) {
  std::string text =
      "PROGRAM Main\nVAR x : DINT := 1; n : INT := 2999; k : DINT; b : BOOL; END_VAR\n  x := x";
  for (int i = 0; i < 10000; ++i)
    text += " + x";
  text += ";\n  IF n = 0 THEN k := 0;\n";
  for (int i = 1; i < 10000; ++i)
    text += "  ELSIF n = " + std::to_string(i) + " THEN k := " + std::to_string(i) + ";\n";
  text += "  END_IF\n  b := ";
  for (int i = 0; i < 3001; ++i)
    text += "NOT ";
  text += "b;\nEND_PROGRAM\n";
  App app(text);
  app.run();
  EXPECT_EQ(app["Main.x"], "10001");
  EXPECT_EQ(app["Main.k"], "2999");
  EXPECT_EQ(app["Main.b"], "TRUE");
}

} // namespace stc::test
