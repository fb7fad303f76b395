// Initial values to any depth.

#include "program.hpp"

#include <gtest/gtest.h>

namespace stc::test {

TEST(CodegenInit, EverythingHasItsDefault) {
  App app(R"(
TYPE Color : (red := 1, green, blue) := blue; END_TYPE
TYPE Small : INT(5..10); END_TYPE
TYPE Five : INT := 5; END_TYPE
TYPE Point : STRUCT x : INT := 1; y : INT; c : Color; s : STRING(4) := 'ab'; END_STRUCT END_TYPE
TYPE Line : STRUCT a : Point; b : Point := (x := 7, s := ''); w : ARRAY[0..2] OF LREAL := [1.5, 2(0.5)]; END_STRUCT END_TYPE
TYPE Line3 EXTENDS Line : STRUCT n : INT := 3; END_STRUCT END_TYPE
FUNCTION_BLOCK Fb
VAR_INPUT i : INT := 4; l : Line := (a := (y := 9)); END_VAR
VAR_OUTPUT o : BOOL := TRUE; END_VAR
VAR k : ARRAY[1..2] OF Point := [(x := 5), (y := 6)]; END_VAR
END_FUNCTION_BLOCK
PROGRAM Main
VAR
  c : Color; s : Small; f : Five; g : Five := 6; l : Line; l3 : Line3 := (n := 4, b := (y := 2)); fb : Fb;
  fbs : ARRAY[0..1] OF Fb := [(i := 8), (l := (w := [3(9.0)]))];
  m : ARRAY[0..1, 0..2] OF INT := [1, 2, 3, 4, 5, 6];
  n : ARRAY[0..1] OF ARRAY[0..2] OF INT := [[1, 2], [3(7)]];
  big : ARRAY[1..100] OF INT := [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11];
  rep : ARRAY[0..99] OF INT := [2(1, 2), 20(3, 4, 5), 7];
  colors : ARRAY[1..3] OF Color; z : Point := (x := 0); v23 : ARRAY[1..3] OF INT := 1, 2(5);
  strings : ARRAY[0..1] OF STRING(8) := ['one', 'two']; t : TIME := T#5s; ld : LREAL := 1; r : REAL := 0.1; neg : ARRAY[-1..1] OF INT := [-1, 0, 1];
END_VAR
END_PROGRAM
)");
  EXPECT_EQ(app["Main.c"], "3");
  EXPECT_EQ(app["Main.s"], "5");
  EXPECT_EQ(app["Main.f"], "5");
  EXPECT_EQ(app["Main.g"], "6");
  EXPECT_EQ(app["Main.l.a.x"], "1");
  EXPECT_EQ(app["Main.l.a.c"], "3");
  EXPECT_EQ(app["Main.l.a.s"], "'ab'");
  EXPECT_EQ(app["Main.l.b.x"], "7");
  EXPECT_EQ(app["Main.l.b.s"], "''");
  EXPECT_EQ(app["Main.l.w[0]"], "1.5");
  EXPECT_EQ(app["Main.l.w[2]"], "0.5");
  EXPECT_EQ(app["Main.l3.n"], "4");
  EXPECT_EQ(app["Main.l3.a.x"], "1");
  EXPECT_EQ(app["Main.l3.b.x"], "7");
  EXPECT_EQ(app["Main.l3.b.y"], "2");
  EXPECT_EQ(app["Main.fb.i"], "4");
  EXPECT_EQ(app["Main.fb.o"], "TRUE");
  EXPECT_EQ(app["Main.fb.l.a.y"], "9");
  EXPECT_EQ(app["Main.fb.l.b.x"], "7");
  EXPECT_EQ(app["Main.fb.k[1].x"], "5");
  EXPECT_EQ(app["Main.fb.k[2].x"], "1");
  EXPECT_EQ(app["Main.fb.k[2].y"], "6");
  EXPECT_EQ(app["Main.fbs[0].i"], "8");
  EXPECT_EQ(app["Main.fbs[1].i"], "4");
  EXPECT_EQ(app["Main.fbs[1].l.w[1]"], "9.0");
  EXPECT_EQ(app["Main.m[1,0]"], "4");
  EXPECT_EQ(app["Main.m[1,2]"], "6");
  EXPECT_EQ(app["Main.n[0,1]"], "2");
  EXPECT_EQ(app["Main.n[0,2]"], "0");
  EXPECT_EQ(app["Main.n[1,2]"], "7");
  EXPECT_EQ(app["Main.big[11]"], "11");
  EXPECT_EQ(app["Main.big[12]"], "0");
  EXPECT_EQ(app["Main.rep[3]"], "2");
  EXPECT_EQ(app["Main.rep[4]"], "3");
  EXPECT_EQ(app["Main.rep[63]"], "5");
  EXPECT_EQ(app["Main.rep[64]"], "7");
  EXPECT_EQ(app["Main.rep[65]"], "0");
  EXPECT_EQ(app["Main.colors[2]"], "3");
  EXPECT_EQ(app["Main.z.x"], "0");
  EXPECT_EQ(app["Main.v23[3]"], "5");
  EXPECT_EQ(app["Main.strings[1]"], "'two'");
  EXPECT_EQ(app["Main.t"], "T#5s");
  EXPECT_EQ(app["Main.r"], "0.1");
  EXPECT_EQ(app["Main.neg[-1]"], "-1");
}

TEST(CodegenInit, AliasesBringTheirDefaults) {
  App app(R"(
TYPE Seven : DINT := 7; END_TYPE
TYPE Again : Seven; END_TYPE
TYPE Hey : STRING(5) := 'hey'; END_TYPE
TYPE Pair : ARRAY[0..1] OF INT := [1, 2]; END_TYPE
TYPE P : STRUCT x : INT := 3; y : INT; END_STRUCT END_TYPE
TYPE P9 : P := (y := 9); END_TYPE
TYPE Row : ARRAY[0..1] OF Again; END_TYPE
TYPE Holder : STRUCT n : Seven; a : ARRAY[0..1] OF Seven; END_STRUCT END_TYPE
FUNCTION F : DINT
VAR_INPUT d : Seven; a : Pair; END_VAR
VAR local : Again; rows : ARRAY[1..2] OF Row; END_VAR
  F := d * 100 + a[1] * 10 + local + rows[2][1];
END_FUNCTION
PROGRAM Main
VAR
  d : Again; s : Hey; a : Pair; p : P9; e : ARRAY[0..1, 0..1] OF Seven; r : Row; rr : ARRAY[0..2] OF Row;
  h : Holder := (n := 1); pp : ARRAY[1..2] OF P9; x : DINT; m : ARRAY[0..1] OF Seven := [4];
END_VAR
  x := F(a := a, d := 1);
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["Main.d"], "7");
  EXPECT_EQ(app["Main.s"], "'hey'");
  EXPECT_EQ(app["Main.a[1]"], "2");
  EXPECT_EQ(app["Main.p.x"], "3");
  EXPECT_EQ(app["Main.p.y"], "9");
  EXPECT_EQ(app["Main.e[1,1]"], "7");
  EXPECT_EQ(app["Main.r[1]"], "7");
  EXPECT_EQ(app["Main.rr[2][0]"], "7");
  EXPECT_EQ(app["Main.h.n"], "1");
  EXPECT_EQ(app["Main.h.a[1]"], "7");
  EXPECT_EQ(app["Main.pp[2].x"], "3");
  EXPECT_EQ(app["Main.pp[2].y"], "9");
  EXPECT_EQ(app["Main.m[0]"], "4");
  EXPECT_EQ(app["Main.m[1]"], "7");
  EXPECT_EQ(app["Main.x"], "134");
}

TEST(CodegenInit, LocalsAreFreshAtEachCall) {
  App app(R"(
TYPE Point : STRUCT x : INT := 1; y : INT; END_STRUCT END_TYPE
FUNCTION F : INT
VAR_INPUT p : Point := (y := 5); END_VAR
VAR n : INT; a : ARRAY[0..2] OF INT := [1, 2, 3]; q : Point; s : STRING := 'x'; k : INT := 4; END_VAR
  n := n + 1; a[0] := a[0] + 1; q.x := q.x + 1; s := CONCAT(s, 'y'); k := k + 1;
  F := n * 1000 + a[0] * 100 + q.x * 10 + LEN(s) + k + p.y;
END_FUNCTION
FUNCTION_BLOCK B
VAR_TEMP t : INT; u : Point; END_VAR
VAR_OUTPUT o : INT; END_VAR
  t := t + 1; u.x := u.x + t;
  o := t * 10 + u.x;
END_FUNCTION_BLOCK
PROGRAM Main
VAR r : INT; b : B; in : INT; END_VAR
VAR CONSTANT table : ARRAY[0..2] OF INT := [7, 8, 9]; END_VAR
  r := F();
  r := F();
  b();
  b();
  in := table[1];
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["Main.r"], "1232");
  EXPECT_EQ(app["Main.b.o"], "12");
  EXPECT_EQ(app["Main.in"], "8");
}

} // namespace stc::test
