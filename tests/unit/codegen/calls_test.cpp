// Calls: functions, function blocks, programs; the order of evaluation.

#include "program.hpp"

#include <gtest/gtest.h>

namespace stc::test {

TEST(CodegenCalls, Functions) {
  App app(R"(
FUNCTION Add : INT
VAR_INPUT a : INT; b : INT := 10; END_VAR
  Add := a + b;
END_FUNCTION
FUNCTION Fac : LINT
VAR_INPUT n : LINT; END_VAR
  IF n <= 1 THEN Fac := 1; RETURN; END_IF
  Fac := n * Fac(n - 1);
END_FUNCTION
FUNCTION Split : BOOL
VAR_INPUT x : DINT; END_VAR
VAR_OUTPUT high : INT; low : INT := 3; END_VAR
VAR_IN_OUT count : INT; END_VAR
  high := DINT_TO_INT(x / 1000);
  low := DINT_TO_INT(x MOD 1000);
  count := count + 1;
  Split := high > 0;
END_FUNCTION
FUNCTION Clear
VAR_IN_OUT a : ARRAY[1..3] OF INT; END_VAR
VAR i : INT; END_VAR
  FOR i := 1 TO 3 DO a[i] := 0; END_FOR
END_FUNCTION
FUNCTION Counter : INT
VAR_STAT n : INT := 100; END_VAR
  n := n + 1;
  Counter := n;
END_FUNCTION
FUNCTION Name : STRING
VAR_INPUT s : STRING(5); END_VAR
  s := CONCAT(s, '!');
  Name := s;
END_FUNCTION
PROGRAM Main
VAR
  a : INT; b : INT; f : LINT; h : INT; l : DINT; ok : BOOL; n : INT; arr : ARRAY[1..3] OF INT := [1, 2, 3]; c : INT;
  s : STRING; flags : WORD; diff : INT;
END_VAR
  a := Add(1);
  b := Add(b := 2, a := 5) * 2;
  f := Fac(20);
  ok := Split(123456, high => h, low => l, count := n);
  Split(x := 7, count := n);
  Clear(arr);
  diff := Counter() - Counter();
  c := Counter();
  s := Name('abc');
  flags.3 := Split(1000, count := n);
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["Main.a"], "11");
  EXPECT_EQ(app["Main.b"], "14");
  EXPECT_EQ(app["Main.f"], "2432902008176640000");
  EXPECT_EQ(app["Main.h"], "123");
  EXPECT_EQ(app["Main.l"], "456");
  EXPECT_EQ(app["Main.ok"], "TRUE");
  EXPECT_EQ(app["Main.n"], "3");
  EXPECT_EQ(app["Main.arr[2]"], "0");
  EXPECT_EQ(app["Main.diff"], "-1"); // from left to right
  EXPECT_EQ(app["Main.c"], "103");
  EXPECT_EQ(app["Counter.n"], "103");
  EXPECT_EQ(app["Main.s"], "'abc!'");
  EXPECT_EQ(app["Main.flags"], "8");
}

TEST(CodegenCalls, OrderOfEvaluation) {
  App app(R"(
VAR_GLOBAL trace : STRING; g : INT := 1; END_VAR
FUNCTION T : INT
VAR_INPUT v : INT; END_VAR
  trace := CONCAT(trace, INT_TO_STRING(v));
  g := g + 1;
  T := v;
END_FUNCTION
FUNCTION Join : INT
VAR_INPUT a, b, c : INT; END_VAR
  Join := a * 100 + b * 10 + c;
END_FUNCTION
PROGRAM Main
VAR a : INT; b : INT; c : BOOL; d : BOOL; e : INT; f : INT; x : ARRAY[1..9] OF INT; y : INT; z : INT; END_VAR
  a := T(1) + T(2) * T(3);
  b := Join(c := T(4), a := T(5), b := T(6));
  c := T(7) > 9 AND T(8) > 0;
  d := T(9) > 99 AND_THEN T(0) > 0;
  g := 1;
  e := g + T(1) + g;
  f := T(1) - g;
  x[T(2)] := T(3);
  y := MAX(T(4), T(5));
  z := T(6) / T(7);
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "");
  EXPECT_EQ(app["trace"], "'1234567891123"
                          "4567'");
  EXPECT_EQ(app["Main.a"], "7");
  EXPECT_EQ(app["Main.b"], "564");
  EXPECT_EQ(app["Main.c"], "FALSE");
  EXPECT_EQ(app["Main.e"], "4");
  EXPECT_EQ(app["Main.f"], "-2");
  EXPECT_EQ(app["Main.x[2]"], "3");
  EXPECT_EQ(app["Main.y"], "5");
}

TEST(CodegenCalls, FunctionBlocks) {
  App app(R"(
TYPE Point : STRUCT x : LREAL := 1.5; y : LREAL; END_STRUCT END_TYPE
FUNCTION_BLOCK Counter
VAR_INPUT step : INT := 1; END_VAR
VAR_IN_OUT total : DINT; pt : Point; END_VAR
VAR_OUTPUT count : INT; done : BOOL; END_VAR
VAR_STAT calls : INT; END_VAR
VAR_TEMP tmp : INT := 3; END_VAR
VAR int : INT; END_VAR
  calls := calls + 1;
  tmp := tmp + step;
  int := tmp;
  count := count + step;
  total := total + step;
  pt.x := pt.x + 1;
  done := count > 3;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer
VAR_IN_OUT inner : Counter; END_VAR
VAR_OUTPUT n : INT; END_VAR
VAR total : DINT; p : Point; END_VAR
  inner(step := 10, total := total, pt := p, count => n);
END_FUNCTION_BLOCK
PROGRAM Main
VAR
  c : Counter := (step := 2); total : DINT; pt : Point; n : LINT; d : ARRAY[0..1] OF Counter; i : INT := 1; o : Outer;
  ptr : POINTER TO Counter; ref : REFERENCE TO Counter; copy : Counter; bits : BYTE; unbound : DINT;
END_VAR
  c(total := total, pt := pt);
  c(step := 5, total := total, pt := pt, count => n, done => bits.2);
  d[i](total := total, pt := pt);
  ptr := ADR(d[0]);
  ptr^(step := 3, total := total, pt := pt);
  ref REF= d[0];
  ref(total := total, pt := pt);
  o(inner := c);
  copy := c;
  unbound := copy.total;
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app.exception(), "UnboundInOut Main.st:38:14"); // a copy is not bound
  EXPECT_EQ(app["Main.n"], "7");
  EXPECT_EQ(app["Main.bits"], "4");
  EXPECT_EQ(app["Main.total"], "14");
  EXPECT_EQ(app["Main.pt.x"], "6.5");
  EXPECT_EQ(app["Main.d[0].count"], "6");
  EXPECT_EQ(app["Main.d[1].count"], "1");
  EXPECT_EQ(app["Main.o.n"], "17");
  EXPECT_EQ(app["Main.o.total"], "10");
  EXPECT_EQ(app["Main.copy.count"], "17");
  EXPECT_EQ(app["Counter.calls"], "6");
  EXPECT_EQ(app["Main.c.int"], "13");
}

TEST(CodegenCalls, ProgramsAndGlobals) {
  App app(std::vector<Source>{{"GVL.st", R"(
{attribute 'qualified_only'}
VAR_GLOBAL limit : INT := 100; list : ARRAY[0..2] OF INT := [1, 2, 3]; END_VAR
VAR_GLOBAL CONSTANT kMax : DINT := 70000; END_VAR
)"},
                              {"Path.st", R"(
PROGRAM Path
VAR_INPUT go : BOOL; END_VAR
VAR_OUTPUT bReady : BOOL; n : INT; END_VAR
  n := n + 1;
  bReady := go;
END_PROGRAM
)"},
                              {"Main.st", R"(
VAR_GLOBAL shared : DINT := 5; END_VAR
PROGRAM Main
VAR x : DINT; y : INT; z : BOOL; k : DINT; END_VAR
VAR_EXTERNAL shared : DINT; END_VAR
  Path(go := TRUE, n => y);
  z := Path.bReady;
  GVL.limit := GVL.limit + 1;
  GVL.list[1] := 20;
  shared := shared + kMax;
  x := GVL.limit + GVL.list[1];
  k := kMax;
END_PROGRAM
)"}});
  app.run();
  EXPECT_EQ(app["Main.x"], "121");
  EXPECT_EQ(app["Main.z"], "TRUE");
  EXPECT_EQ(app["GVL.limit"], "101");
  EXPECT_EQ(app["shared"], "70005");
  EXPECT_EQ(app["Main.k"], "70000");
  EXPECT_EQ(app["Path.n"], "2");
}

TEST(CodegenCalls, LibraryBlocks) {
  const Options options{
      .checks = true,
      .library = {
          {"TON.st", R"(
FUNCTION_BLOCK TON
VAR_INPUT IN : BOOL; PT : TIME; END_VAR
VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR
VAR {attribute 'hide'} start : TIME; running : BOOL; speed : Mode := Mode.slow; END_VAR
  IF NOT IN THEN running := FALSE; ET := T#0s; Q := FALSE; RETURN; END_IF
  IF NOT running THEN running := TRUE; start := TIME(); END_IF
  ET := TIME() - start;
  IF ET >= PT THEN ET := PT; Q := TRUE; END_IF
END_FUNCTION_BLOCK
)"},
          {"Mode.st", "TYPE Mode : (fast, slow, other); END_TYPE\n"},
          {"Holder.st", "TYPE Holder : STRUCT idle : Idle; END_STRUCT END_TYPE\n"},
          {"Idle.st", "FUNCTION_BLOCK Idle VAR_OUTPUT n : INT := 7; END_VAR END_FUNCTION_BLOCK\n"},
          {"Twice.st", R"(
FUNCTION Twice : LREAL
VAR_INPUT x : LREAL := 4; END_VAR
  Twice := 2 * x;
END_FUNCTION
)"}}};
  App app(R"(
PROGRAM Main
VAR TON : TON; t2 : Lib.TON; x : LREAL; m : Mode; h : Holder; mode : Mode := Mode.other; END_VAR
  TON(IN := TRUE, PT := T#30ms);
  x := Twice() + Lib.Twice(1);
  m := Mode.other;
END_PROGRAM
)",
          options);
  app.run(3);
  EXPECT_EQ(app["Main.TON.Q"], "FALSE");
  EXPECT_EQ(app["Main.TON.ET"], "T#20ms");
  app.run(1);
  EXPECT_EQ(app["Main.TON.Q"], "TRUE");
  EXPECT_EQ(app["Main.TON.speed"], "1");
  EXPECT_EQ(app["Main.x"], "10.0");
  EXPECT_EQ(app["Main.m"], "2");
  EXPECT_EQ(app["Main.h.idle.n"], "7"); // of a block that nobody calls
  EXPECT_EQ(app["Main.mode"], "2");
}

TEST(CodegenCalls, NamesOfCpp) {
  App app(R"(
TYPE class : STRUCT int : INT; double : LREAL := 2; NULL : INT; template : BOOL; END_STRUCT END_TYPE
FUNCTION new : INT
VAR_INPUT delete, this_, auto : INT; END_VAR
VAR stride : INT; END_VAR
  stride := delete;
  new := stride + this_ + auto;
END_FUNCTION
FUNCTION_BLOCK operator
VAR_INPUT switch : INT; END_VAR
VAR_OUTPUT return_ : INT; END_VAR
  return_ := switch + 1;
END_FUNCTION_BLOCK
PROGRAM main
VAR struct_ : class; operator : operator; int32_t : INT; st : INT; default : INT; static : INT; INT8_MAX : INT; file : INT; class_ : class; END_VAR
  struct_.int := 3;
  operator(switch := struct_.int, return_ => int32_t);
  st := new(1, 2, 3);
  default := struct_.int + INT8_MAX;
  static := st;
  file := default;
END_PROGRAM
)");
  app.run();
  EXPECT_EQ(app["main.int32_t"], "4");
  EXPECT_EQ(app["main.static"], "6");
  EXPECT_EQ(app["main.file"], "3");
  EXPECT_EQ(app["main.struct_.double"], "2.0");
}

} // namespace stc::test
