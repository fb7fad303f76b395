// What a project takes from a library that it does not name itself.

#include "program.hpp"

#include <gtest/gtest.h>

namespace stc::test {

TEST(CodegenLibrary, BodiesReachGlobalsThatTheProjectDoesNotUse) {
  Options options;
  options.library = {
      {"bump.st", "FUNCTION bump : INT\nVAR_INPUT step : INT; END_VAR\n"
                  "VAR_STAT calls : INT; END_VAR\n"
                  "calls := calls + 1;\nlevel := level + step;\nbump := level * 100 + calls;\n"
                  "END_FUNCTION\n"},
      {"level.st", "VAR_GLOBAL level : INT := 5; END_VAR\n"},
      {"outer.st", "FUNCTION_BLOCK outer\nVAR_OUTPUT n : INT; END_VAR\nVAR i : inner; END_VAR\n"
                   "i();\nn := i.n;\nEND_FUNCTION_BLOCK\n"},
      {"inner.st", "FUNCTION_BLOCK inner\nVAR_OUTPUT n : INT; END_VAR\nn := bump(step := 2);\n"
                   "END_FUNCTION_BLOCK\n"}};
  App app("PROGRAM Main\nVAR o : outer; n : INT; END_VAR\no();\nn := o.n;\nEND_PROGRAM\n", options);
  app.run(2);
  EXPECT_EQ(app["Main.n"], "902");
}

TEST(CodegenLibrary, SmallBodiesAreCalledFromTheSameLibrary) {
  Options options;
  options.optimized = true;
  options.library = {
      {"small.st", "FUNCTION small : INT\nVAR_INPUT n : INT; END_VAR\nsmall := n + 1;\n"
                   "END_FUNCTION\n"},
      {"tiny.st", "FUNCTION_BLOCK tiny\nVAR_OUTPUT n : INT; END_VAR\nn := small(n);\n"
                  "END_FUNCTION_BLOCK\n"},
      {"user.st", "FUNCTION_BLOCK user\nVAR_OUTPUT n : INT; END_VAR\nVAR t : tiny; END_VAR\n"
                  "t();\nn := small(t.n) + later(1);\nEND_FUNCTION_BLOCK\n"},
      {"later.st", "FUNCTION later : INT\nVAR_INPUT n : INT; END_VAR\nlater := small(n) * 10;\n"
                   "END_FUNCTION\n"}};
  App app("PROGRAM Main\nVAR u : user; n : INT; END_VAR\nu();\nn := small(u.n);\nEND_PROGRAM\n",
          options);
  app.run(2);
  EXPECT_EQ(app["Main.n"], "24");
}

TEST(CodegenLibrary, DefaultsOfAliasesReachTheProjectsVariables) {
  Options options;
  options.library = {{"speed.st", "TYPE speed : REAL := 2.5; END_TYPE\n"},
                     {"speeds.st", "TYPE speeds : ARRAY [1..2] OF speed; END_TYPE\n"}};
  const App app("TYPE Pair : STRUCT a : speed; b : speed := 7.5; END_STRUCT END_TYPE\n"
                "PROGRAM Main\nVAR x : speed; p : Pair; list : speeds; own : ARRAY [0..1] OF speed;"
                " END_VAR\nEND_PROGRAM\n",
                options);
  EXPECT_EQ(app["Main.x"], "2.5");
  EXPECT_EQ(app["Main.p.a"], "2.5");
  EXPECT_EQ(app["Main.p.b"], "7.5");
  EXPECT_EQ(app["Main.list[2]"], "2.5");
  EXPECT_EQ(app["Main.own[1]"], "2.5");
}

} // namespace stc::test
