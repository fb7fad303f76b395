// Declarations around a drawn body.
#include "compiler/import/networks/scope.hpp"
#include "compiler/import/networks/types.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stc::import::networks {
namespace {

using testing::ElementsAre;
using testing::Field;

Scope scene() {
  Scope scope;
  scope.declare("TYPE Point : STRUCT x, y : REAL; on : BOOL := TRUE; END_STRUCT END_TYPE\n"
                "TYPE Speed : LREAL; END_TYPE\nTYPE Mode : (Idle, Run := 5); END_TYPE\n"
                "VAR_GLOBAL CONSTANT limit : INT := 5; END_VAR\n"
                "FUNCTION_BLOCK Ramp VAR_INPUT go : BOOL; target : Speed := 1.5; END_VAR\n"
                "VAR_IN_OUT p : Point; END_VAR VAR_OUTPUT done : BOOL; now : Speed; END_VAR\n"
                "VAR state : INT; END_VAR go := FALSE; END_FUNCTION_BLOCK\n"
                "FUNCTION Twice : LREAL VAR_INPUT v : LREAL; END_VAR Twice := v; END_FUNCTION\n");
  scope.enter(
      "PROGRAM Main\nVAR\n  (* of *) a, b AT %IX0.1 : BOOL;\n  points : ARRAY [1..3] OF Point;\n"
      "  r : Ramp := (target := 2.0);\n  n : INT; w : WORD; t : TIME;\nEND_VAR\n");
  return scope;
}

TEST(Scope, knowsThePinsOfABlockInTheirOrder) {
  const Scope scope = scene();
  const Interface *ramp = scope.interfaceOf("ramp");
  ASSERT_NE(ramp, nullptr);
  EXPECT_THAT(ramp->inputs,
              ElementsAre(Field(&Declared::name, "go"), Field(&Declared::name, "target")));
  EXPECT_THAT(ramp->inOuts, ElementsAre(Field(&Declared::type, "Point")));
  EXPECT_THAT(ramp->outputs,
              ElementsAre(Field(&Declared::name, "done"), Field(&Declared::name, "now")));
  EXPECT_EQ(scope.interfaceOf("Lib.Twice")->returnType, "LREAL");
  EXPECT_EQ(scope.interfaceOf("Nobody"), nullptr);
}

TEST(Scope, followsMembersAndElements) {
  const Scope scope = scene();
  EXPECT_EQ(scope.typeOf("a"), "BOOL");
  EXPECT_EQ(scope.typeOf("B"), "BOOL");
  EXPECT_EQ(scope.typeOf("points[n + 1].y"), "REAL");
  EXPECT_EQ(scope.typeOf("r.now"), "Speed");
  EXPECT_EQ(scope.typeOf("w.3"), "BOOL");
  EXPECT_EQ(scope.typeOf("limit"), "INT");
  EXPECT_EQ(scope.typeOf("unknown.x"), "");
}

TEST(Scope, findsTypesOfExpressions) {
  const Scope scope = scene();
  EXPECT_EQ(typeOfText("n + 1", scope), "INT");
  EXPECT_EQ(typeOfText("n * 1.5", scope), "REAL");
  EXPECT_EQ(typeOfText("points[1].x > 3", scope), "BOOL");
  EXPECT_EQ(typeOfText("SEL(a, n, n)", scope), "INT");
  EXPECT_EQ(typeOfText("REAL_TO_TIME(points[1].x * 1000)", scope), "TIME");
  EXPECT_EQ(typeOfText("NOT a", scope), "BOOL");
  EXPECT_EQ(typeOfText("(t)", scope), "TIME");
  EXPECT_EQ(typeOfText("T#5s", scope), "TIME");
  EXPECT_EQ(typeOfText("Twice(1)", scope), "LREAL");
  EXPECT_EQ(typeOfText("Nobody(1)", scope), "");
}

TEST(Scope, givesNamesThatNobodyHas) {
  Scope scope = scene();
  EXPECT_EQ(scope.freshName("N"), "N_2");
  EXPECT_EQ(scope.freshName("n"), "n_3");
  EXPECT_EQ(scope.freshName("points[1].x"), "points_1__x");
  EXPECT_EQ(scope.freshName("limit"), "limit_2");
  EXPECT_EQ(scope.freshName("add"), "add_2");
  EXPECT_FALSE(scope.inFunction());
}

TEST(Scope, typesThatNameEachOtherHaveNoEnd) {
  Scope scope;
  std::string chain = "TYPE A : B; END_TYPE TYPE B : A; END_TYPE TYPE Own : OWN; END_TYPE\n"
                      "TYPE C0 : STRUCT x : INT; END_STRUCT END_TYPE "
                      "TYPE D0 : ARRAY [1..2] OF LINT; END_TYPE\n";
  for (int i = 1; i < 34; ++i)
    for (const char *name : {"C", "D"})
      chain += "TYPE " + (name + std::to_string(i)) + " : " + (name + std::to_string(i - 1)) +
               "; END_TYPE\n";
  scope.declare(chain);
  scope.enter("PROGRAM P VAR a : A; o : Own; c : C31; d : D30; e : C32; f : D31; END_VAR");
  EXPECT_EQ(scope.typeOf("a.x"), "");
  EXPECT_EQ(scope.typeOf("a[1]"), "");
  EXPECT_EQ(scope.typeOf("o[1]"), "");
  EXPECT_EQ(scope.typeOf("o.3"), "BOOL");
  EXPECT_EQ(scope.typeOf("c.x"), "INT");
  EXPECT_EQ(scope.typeOf("d[1]"), "LINT");
  EXPECT_EQ(scope.typeOf("e.x"), "");
  EXPECT_EQ(scope.typeOf("f[1]"), "");
}

TEST(Scope, pragmasAndCommentsDeclareNothing) {
  Scope scope;
  scope.declare("FUNCTION_BLOCK F VAR_INPUT {flag noread on} a : BOOL; /* (* b : INT; */ c : INT;\n"
                "// d : INT;\n (* { *) e : {attribute 'x'} REAL; {open f : INT; END_VAR");
  ASSERT_NE(scope.interfaceOf("F"), nullptr);
  EXPECT_THAT(scope.interfaceOf("F")->inputs,
              ElementsAre(Field(&Declared::name, "a"), Field(&Declared::name, "c"),
                          Field(&Declared::name, "e")));
  EXPECT_EQ(scope.interfaceOf("F")->inputs[2].type, "REAL");
}

} // namespace
} // namespace stc::import::networks
