// Operators, conversions and constants, as DESIGN's semantics table has them.

#include "program.hpp"

#include <gtest/gtest.h>

namespace stc::test {

TEST(CodegenArithmetic, Integers) {
  App app(R"(
PROGRAM Main
VAR
  i : INT := 32767; j : INT; d : DINT := 2147483647; e : DINT; u : USINT := 250; v : USINT;
  l : LINT; b : BYTE := 16#F0; c : BYTE; w : WORD; dw : DWORD; q : DINT := -7; r : DINT; s : DINT;
  si : SINT; ud : UDINT; neg : DINT; min : DINT; minusOne : DINT := -1; quotient : DINT; rest : DINT;
  t : BOOL; n : UINT := 1;
END_VAR
  j := i + 1;
  e := d + 1;
  v := u + 10;
  l := DINT_TO_LINT(d) + 1;
  c := NOT b;
  w := NOT n;
  dw := NOT DWORD#0;
  r := q / 2;
  s := q MOD 2;
  neg := -q;
  si := -128;
  si := -si;
  ud := 0;
  ud := ud - 1;
  min := -2147483648;
  quotient := min / minusOne;
  rest := min MOD minusOne;
  t := b > 200 AND b < 16#F1;
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["Main.j"], "-32768");
  EXPECT_EQ(app["Main.e"], "-2147483648");
  EXPECT_EQ(app["Main.v"], "4");
  EXPECT_EQ(app["Main.l"], "2147483648");
  EXPECT_EQ(app["Main.c"], "15");
  EXPECT_EQ(app["Main.w"], "65534");
  EXPECT_EQ(app["Main.dw"], "4294967295");
  EXPECT_EQ(app["Main.r"], "-3");
  EXPECT_EQ(app["Main.s"], "-1");
  EXPECT_EQ(app["Main.neg"], "7");
  EXPECT_EQ(app["Main.si"], "-128");
  EXPECT_EQ(app["Main.ud"], "4294967295");
  EXPECT_EQ(app["Main.quotient"], "-2147483648");
  EXPECT_EQ(app["Main.rest"], "0");
  EXPECT_EQ(app["Main.t"], "TRUE");
}

TEST(CodegenArithmetic, BoolAndBits) {
  App app(R"(
PROGRAM Main
VAR
  a : BOOL := TRUE; b : BOOL; x : BOOL; y : BOOL; z : BOOL; n : BOOL; w : WORD := 2#1010; i : INT;
  eq : BOOL; k : DINT := 5; cmp : BOOL;
END_VAR
  x := a AND NOT b OR FALSE;
  y := a XOR a XOR a;
  z := NOT w.0 AND w.1;
  n := NOT (k > 3 AND k < 10);
  w.2 := TRUE;
  w.3 := FALSE;
  i.15 := TRUE;
  eq := (k = 5) = (k > 4);
  cmp := k > 3 XOR k > 4;
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["Main.x"], "TRUE");
  EXPECT_EQ(app["Main.y"], "TRUE");
  EXPECT_EQ(app["Main.z"], "TRUE");
  EXPECT_EQ(app["Main.n"], "FALSE");
  EXPECT_EQ(app["Main.w"], "6");
  EXPECT_EQ(app["Main.i"], "-32768");
  EXPECT_EQ(app["Main.eq"], "TRUE");
  EXPECT_EQ(app["Main.cmp"], "FALSE");
}

TEST(CodegenArithmetic, RealsAndConversions) {
  App app(R"(
PROGRAM Main
VAR
  x : LREAL := 2.5; r : REAL := 0.1; i : INT; j : INT; k : DINT; y : LREAL; z : REAL; s : STRING; t : STRING(3);
  n : INT := 7; d : INT; u : USINT; b : BOOL; h : LREAL; p : LREAL; inf : LREAL; zero : LREAL; q : LREAL;
END_VAR
  i := LREAL_TO_INT(x);
  j := LREAL_TO_INT(-x);
  k := TRUNC(-2.7);
  y := n / 2 + x;
  z := r * 2;
  h := n / 2.0;
  s := INT_TO_STRING(n);
  t := 'abcdef';
  d := STRING_TO_INT('42');
  u := LREAL_TO_USINT(300.0);
  b := INT_TO_BOOL(n);
  p := 2.0 ** 10;
  inf := 1.0 / zero;
  q := SQRT(16.0) + ABS(-x) + MAX(x, 1) + LIMIT(0, n, 5) + SEL(b, 1.0, 2.0);
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["Main.i"], "3");
  EXPECT_EQ(app["Main.j"], "-3");
  EXPECT_EQ(app["Main.k"], "-2");
  EXPECT_EQ(app["Main.y"], "5.5");
  EXPECT_EQ(app["Main.z"], "0.2");
  EXPECT_EQ(app["Main.h"], "3.5");
  EXPECT_EQ(app["Main.s"], "'7'");
  EXPECT_EQ(app["Main.t"], "'abc'");
  EXPECT_EQ(app["Main.d"], "42");
  EXPECT_EQ(app["Main.u"], "255");
  EXPECT_EQ(app["Main.b"], "TRUE");
  EXPECT_EQ(app["Main.p"], "1024.0");
  EXPECT_EQ(app["Main.inf"], "Infinity");
  EXPECT_EQ(app["Main.q"], "16.0");
}

TEST(CodegenArithmetic, Times) {
  App app(R"(
PROGRAM Main
VAR
  t : TIME := T#1s500ms; u : TIME; v : TIME; w : TIME; h : TIME; late : BOOL; now : TIME; long : LTIME;
  tod : TOD := TOD#12:00:00; later : TOD; day : DT := DT#2024-02-28-23:59:59; next : DT; gap : TIME;
  f : LREAL := 1.5; n : INT := 3;
END_VAR
  u := t + T#500ms;
  v := t * n;
  w := t / 2;
  h := t * f;
  late := u > t;
  now := TIME();
  long := t;
  later := tod + T#1h;
  next := day + T#2s;
  gap := later - tod;
END_PROGRAM
)");
  app.run(2);
  EXPECT_EQ(app["Main.u"], "T#2s");
  EXPECT_EQ(app["Main.v"], "T#4s500ms");
  EXPECT_EQ(app["Main.w"], "T#750ms");
  EXPECT_EQ(app["Main.h"], "T#2s250ms");
  EXPECT_EQ(app["Main.late"], "TRUE");
  EXPECT_EQ(app["Main.now"], "T#10ms");
  EXPECT_EQ(app["Main.long"], "LTIME#1s500ms");
  EXPECT_EQ(app["Main.later"], "TOD#13:00:00");
  EXPECT_EQ(app["Main.next"], "DT#2024-02-29-00:00:01");
  EXPECT_EQ(app["Main.gap"], "T#1h");
}

TEST(CodegenArithmetic, Strings) {
  App app(R"(
PROGRAM Main
VAR
  a : STRING(5) := 'hello'; b : STRING := 'x$'y'; c : STRING(20); n : INT; less : BOOL; same : BOOL; w : WSTRING := "w$00e4";
  l : STRING(3); r : STRING(10); m : STRING(10); f : INT; d : STRING; q : STRING; u : STRING := 'ä';
  k : STRING(4); mx : STRING;
END_VAR
VAR CONSTANT greeting : STRING := 'hi'; END_VAR
  c := CONCAT(a, ' world');
  n := LEN(c);
  less := a < 'help';
  same := a = 'hello' AND greeting = 'hi';
  l := LEFT(c, 3);
  r := RIGHT('abcdef', 2);
  m := MID(c, 5, 7);
  f := FIND(c, 'wor');
  d := DELETE(c, 6, 6);
  q := REPLACE(INSERT('ac', 'b', 1), 'Z', 1, 2);
  k := greeting;
  mx := MAX('abc', a);
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["Main.c"], "'hello world'");
  EXPECT_EQ(app["Main.b"], "'x'y'");
  EXPECT_EQ(app["Main.n"], "11");
  EXPECT_EQ(app["Main.less"], "TRUE");
  EXPECT_EQ(app["Main.same"], "TRUE");
  EXPECT_EQ(app["Main.l"], "'hel'");
  EXPECT_EQ(app["Main.r"], "'ef'");
  EXPECT_EQ(app["Main.m"], "'world'");
  EXPECT_EQ(app["Main.f"], "7");
  EXPECT_EQ(app["Main.d"], "'hello'");
  EXPECT_EQ(app["Main.q"], "'aZc'");
  EXPECT_EQ(app["Main.u"], "'\xE4'");
  EXPECT_EQ(app["Main.k"], "'hi'");
  EXPECT_EQ(app["Main.mx"], "'hello'");
}

TEST(CodegenArithmetic, SelectionAndShifts) {
  App app(R"(
PROGRAM Main
VAR
  i : INT := 1; m : INT; s : WORD; r : BYTE := 16#81; l : BYTE; g : BOOL := TRUE; t : STRING; n : INT; e : DINT;
  a : ARRAY[1..2] OF INT := [5, 6]; b : ARRAY[1..2] OF INT := [7, 8]; c : ARRAY[1..2] OF INT;
END_VAR
  m := MUX(i, m, INT#20, 30);
  s := SHL(WORD#1, 15);
  l := ROL(r, 1);
  t := SEL(g, 'no', 'yes');
  n := MIN(i, m, 3);
  c := SEL(g, a, b);
  e := SIZEOF(a);
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["Main.m"], "20");
  EXPECT_EQ(app["Main.s"], "32768");
  EXPECT_EQ(app["Main.l"], "3");
  EXPECT_EQ(app["Main.t"], "'yes'");
  EXPECT_EQ(app["Main.n"], "1");
  EXPECT_EQ(app["Main.c[2]"], "8");
  EXPECT_EQ(app["Main.e"], "4");
}

} // namespace stc::test
