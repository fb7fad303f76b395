// What the generator chooses by limits: the C++ is right either way, but not as quick, or as small.

#include "program.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stc::test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The C++ of `Main`.
std::string mainOf(const std::string &text) {
  return fileText(generate({{"Main.st", text}}), "user/Main.cpp");
}

/// A CASE with so many ranges of 32 labels and so many single ones in one branch, and branches with
/// one label.
std::string caseOf(int ranges, int singles, int branches) {
  std::string text = "PROGRAM Main\nVAR n : DINT; x : INT; END_VAR\nCASE n OF\n";
  int next = 0;
  for (int i = 0; i < ranges; ++i, next += 40)
    text += (i == 0 ? "" : ", ") + std::to_string(next) + ".." + std::to_string(next + 31);
  for (int i = 0; i < singles; ++i)
    text += ", " + std::to_string(next++);
  text += ": x := 1;\n";
  for (int i = 0; i < branches; ++i)
    text += std::to_string(next++) + ": x := 2;\n";
  return text + "END_CASE\nEND_PROGRAM\n";
}

} // namespace

TEST(CodegenChoices, CaseIsASwitchWhereItsLabelsAreFew) {
  EXPECT_THAT(mainOf(caseOf(31, 31, 0)), HasSubstr("switch (n)"));
  EXPECT_THAT(mainOf(caseOf(32, 0, 0)), HasSubstr("switch (n)")); // 1024
  EXPECT_THAT(mainOf(caseOf(32, 1, 0)), Not(HasSubstr("switch (n)")));
  // More of them where they are not more than four to a branch, on an average.
  EXPECT_THAT(mainOf(caseOf(32, 0, 339)), Not(HasSubstr("switch (n)"))); // 1363 of 340
  EXPECT_THAT(mainOf(caseOf(32, 0, 340)), HasSubstr("switch (n)"));      // 1364 of 341
  EXPECT_THAT(mainOf(caseOf(32, 1, 340)), Not(HasSubstr("switch (n)"))); // 1365 of 341
  EXPECT_THAT(mainOf(caseOf(32, 1, 341)), HasSubstr("switch (n)"));      // 1366 of 342
}

TEST(CodegenChoices, SmallBodiesAreInlined) {
  const auto isInlined = [](const std::string &body) {
    const auto files =
        generate({{"Main.st", "FUNCTION F : INT VAR_INPUT n : INT; END_VAR\n" + body +
                                  "\nEND_FUNCTION\nPROGRAM Main VAR x : INT; END_VAR x := F(3); "
                                  "END_PROGRAM\n"}});
    return !fileText(files, "st/user/F.inline.h").empty();
  };
  std::string sum = "F := n";
  for (int i = 0; i < 60; ++i)
    sum += " + n";
  sum += ";\n";
  EXPECT_TRUE(isInlined(sum));
  EXPECT_FALSE(isInlined(sum + sum));
  EXPECT_FALSE(isInlined("IF n > 0 THEN " + sum + "ELSE " + sum + "END_IF"));
  EXPECT_TRUE(isInlined("CASE n OF 1: F := 3; ELSE " + sum + "END_CASE"));
  EXPECT_FALSE(isInlined("CASE n OF 1: F := 3; ELSE " + sum + sum + "END_CASE"));
  EXPECT_FALSE(isInlined("CASE n OF 1: " + sum + " 2: " + sum + "ELSE F := 3; END_CASE"));
  EXPECT_FALSE(isInlined("WHILE F < n DO F := F + 1; END_WHILE")); // a loop outweighs its call
}

namespace {

/// Whether Main.cpp takes the body of F; `others` besides, and the statements of Main.
bool takesBody(const std::string &others, const std::string &statements) {
  std::string sum = "F := n";
  for (int i = 0; i < 20; ++i)
    sum += " + n * n";
  const std::string main =
      mainOf("FUNCTION F : INT VAR_INPUT n : INT; END_VAR " + sum + "; END_FUNCTION\n" + others +
             "PROGRAM Main VAR i, x : INT; END_VAR\n" + statements + "\nEND_PROGRAM\n");
  const bool body = main.find("\"st/user/F.inline.h\"") != std::string::npos;
  EXPECT_NE(body, main.find("\"st/user/F.h\"") != std::string::npos) << main;
  return body;
}

} // namespace

TEST(CodegenChoices, BodiesAreInlinedWhereTheyRunOften) {
  EXPECT_FALSE(takesBody("", "x := F(3);"));
  EXPECT_FALSE(takesBody("", "x := F(3); FOR i := 0 TO 9 DO x := x + 1; END_FOR"));
  EXPECT_TRUE(takesBody("", "FOR i := 0 TO 9 DO x := x + F(i); END_FOR"));
  EXPECT_TRUE(takesBody("", "WHILE F(x) < 9 DO x := x + 1; END_WHILE"));
  EXPECT_TRUE(takesBody("", "REPEAT x := x + 1; UNTIL F(x) > 9 END_REPEAT"));
  EXPECT_TRUE(takesBody("", "FOR i := 0 TO 9 DO IF i > 3 THEN x := x + F(i); END_IF END_FOR"));
  EXPECT_TRUE(takesBody("", "again: x := F(x); IF x < 9 THEN JMP again; END_IF"));
  // By a loop of a caller further up, or calling itself.
  const auto up = [](const std::string &text) {
    return "PROGRAM Up VAR i : INT; END_VAR " + text + " END_PROGRAM\n";
  };
  EXPECT_TRUE(takesBody(up("FOR i := 0 TO 3 DO Main(); END_FOR"), "x := F(3);"));
  EXPECT_FALSE(takesBody(up("Main();"), "x := F(3);"));
  EXPECT_TRUE(takesBody(up("IF i > 0 THEN Main(); END_IF"), "x := F(3); Up();"));
}

TEST(CodegenChoices, SaysWhichSourcesRunOnce) {
  const auto files = generate({{"Main.st", R"(
FUNCTION Often : INT Often := 3; END_FUNCTION
FUNCTION Once : INT Once := 4; END_FUNCTION
FUNCTION Loops : INT VAR i : INT; END_VAR FOR i := 0 TO 3 DO Loops := Loops + Often(); END_FOR END_FUNCTION
FUNCTION_BLOCK Acts VAR n : INT; END_VAR
ACTION Plain: n := Once(); END_ACTION
END_FUNCTION_BLOCK
FUNCTION_BLOCK Turns VAR n : INT; END_VAR
ACTION Round: WHILE n < 3 DO n := n + 1; END_WHILE END_ACTION
END_FUNCTION_BLOCK
FUNCTION_BLOCK Base END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base END_FUNCTION_BLOCK
PROGRAM Main VAR x : INT; a : Acts; t : Turns; d : Derived; END_VAR
x := Loops() + Once(); a.Plain(); t.Round(); d();
END_PROGRAM
)"}});
  std::string once;
  for (const GeneratedFile &file : files)
    if (file.runsOnce)
      once += file.path + ' ';
  // What extends another block may be called by whom nobody knows.
  EXPECT_EQ(once, "user/Once.cpp user/Acts.cpp user/Main.cpp ");
}

TEST(CodegenChoices, SaysWhichSourcesComputeWithArraysOfReals) {
  const auto isNumeric = [](const std::string &loops, const std::string &method = "") {
    const auto files =
        generate({{"Main.st", "FUNCTION_BLOCK Sums VAR a : ARRAY[0..9] OF LREAL; n : "
                              "ARRAY[0..9] OF DINT; i, j : DINT; x, y : LREAL; "
                              "END_VAR\n" +
                                  loops + "\nMETHOD Go\n" + method +
                                  "\nEND_METHOD\nEND_FUNCTION_BLOCK\nPROGRAM Main "
                                  "VAR s : Sums; END_VAR s(); END_PROGRAM\n"}});
    for (const GeneratedFile &file : files)
      if (file.path == "user/Sums.cpp")
        return file.isNumeric;
    return false;
  };
  const std::string head = "FOR i := 0 TO 9 DO WHILE j < 9 DO ";
  const std::string tail = " j := j + 1; END_WHILE END_FOR";
  EXPECT_TRUE(isNumeric(head + "x := x + a[j];" + tail));
  EXPECT_TRUE(isNumeric("", head + "IF x > y THEN a[j] := x * a[j]; END_IF" + tail));
  EXPECT_FALSE(isNumeric(head + "x := x + y;" + tail));
  EXPECT_FALSE(isNumeric(head + "x := a[j];" + tail));
  EXPECT_FALSE(isNumeric(head + "i := i + n[j];" + tail));
  EXPECT_FALSE(isNumeric("FOR i := 0 TO 9 DO x := x + a[j]; END_FOR"));
  EXPECT_FALSE(isNumeric("FOR i := 0 TO 9 DO " +
                         std::string("WHILE j < 9 DO j := j + 1; END_WHILE") +
                         " x := x + a[i]; END_FOR"));
}

TEST(CodegenChoices, TinyBodiesAreInlinedEverywhere) {
  const auto main = [](const std::string &body) {
    return mainOf("FUNCTION F : INT VAR_INPUT n : INT; END_VAR " + body +
                  " END_FUNCTION PROGRAM Main VAR x : INT; END_VAR x := F(3); END_PROGRAM\n");
  };
  EXPECT_THAT(main("F := n + n + n + n + n;"), HasSubstr("F.inline.h")); // 1 + 1 + 9 nodes
  EXPECT_THAT(main("F := n + n + n + n + n + n;"), Not(HasSubstr("F.inline.h")));
}

TEST(CodegenChoices, LocalsWithAnAddressAreOnTheDataStack) {
  const std::string text = fileText(generate({{"Main.st", R"(
FUNCTION_BLOCK Base
METHOD M : INT
VAR_IN_OUT a, b : INT; END_VAR
a := a + b;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Derived EXTENDS Base
VAR p : POINTER TO INT; END_VAR
METHOD M : INT
VAR_IN_OUT a, b : INT; END_VAR
p := ADR(a);
END_METHOD
END_FUNCTION_BLOCK
FUNCTION F : DINT
VAR_IN_OUT block : Base; END_VAR
VAR
  large : ARRAY[0..4095] OF DINT; larger : ARRAY[0..4096] OF DINT; first, second : INT;
  known : INT; r : REFERENCE TO INT REF= known; read : INT; copy : INT := read;
END_VAR
block.M(a := first, b := second);
F := large[1] + larger[2] + r + copy;
END_FUNCTION
PROGRAM Main
VAR block : Derived; n : DINT; END_VAR
n := F(block);
END_PROGRAM
)"}}),
                                    "user/F.cpp");
  const auto isOnDataStack = [&](const std::string &name) {
    EXPECT_THAT(text, HasSubstr(" " + name)) << name;
    return text.find(" " + name + "__local(") != std::string::npos;
  };
  EXPECT_FALSE(isOnDataStack("large")); // 16384 bytes
  EXPECT_TRUE(isOnDataStack("larger"));
  EXPECT_TRUE(isOnDataStack("first")); // of which the method of the derived block takes the address
  EXPECT_FALSE(isOnDataStack("second"));
  EXPECT_TRUE(isOnDataStack("known"));
  EXPECT_FALSE(isOnDataStack("read"));
  EXPECT_FALSE(isOnDataStack("copy"));
}

TEST(CodegenChoices, StructuresThatFollowEachOtherShareTables) {
  const auto valuesOf = [](int count) {
    std::string text =
        "TYPE P : STRUCT x : INT; y : LREAL; END_STRUCT END_TYPE\nPROGRAM Main VAR\n";
    for (int i = 1; i <= count; ++i)
      text += "p" + std::to_string(i) + " : P := (x := " + std::to_string(i) + ", y := -" +
              std::to_string(i) + ".5);\n";
    return mainOf(text + "END_VAR END_PROGRAM\n");
  };
  EXPECT_THAT(valuesOf(8), HasSubstr("[] = {1, 2, 3, 4, 5, 6, 7, 8};"));
  EXPECT_THAT(valuesOf(8), HasSubstr("[] = {-1.5, -2.5, -3.5, -4.5, -5.5, -6.5, -7.5, -8.5};"));
  EXPECT_THAT(valuesOf(7), HasSubstr("this->p7.y = -7.5;"));
}

TEST(CodegenChoices, LocalsWithAValueHaveTheirOwnLine) {
  const std::string text = fileText(generate({{"Main.st", "FUNCTION F : INT\n"
                                                          "VAR\n"
                                                          "  a : INT;\n"
                                                          "  b : INT := 3;\n"
                                                          "END_VAR\n"
                                                          "  F := a + b;\n"
                                                          "END_FUNCTION\n"
                                                          "PROGRAM Main\n"
                                                          "VAR n : INT; END_VAR\n"
                                                          "  n := F();\n"
                                                          "END_PROGRAM\n"}}),
                                    "user/F.cpp");
  // A debugger stops where a value is given, and else at the first statement.
  EXPECT_THAT(text, HasSubstr("#line 6\n  ::stride::INT a{};"));
  EXPECT_THAT(text, HasSubstr("#line 4\n  ::stride::INT b = 3;"));
}

TEST(CodegenChoices, BodiesThatFailOnlyWhereAnInOutLeadsNowherePutNothingBack) {
  const auto passes = [](const std::string &body) {
    const std::string text = mainOf(R"(
FUNCTION_BLOCK Led
VAR_IN_OUT led : LINT; all : ARRAY[0..3] OF LINT; END_VAR
VAR i : DINT; END_VAR
)" + body + R"(
END_FUNCTION_BLOCK
PROGRAM Main
VAR led : Led; x : LINT; all : ARRAY[0..3] OF LINT; i, n : DINT; END_VAR
FOR i := 1 TO 10 DO n := n + i; led(led := x, all := all); END_FOR
END_PROGRAM
)");
    return text.find("== nullptr ? static_cast<::stride::Ctx &>(loop__") != std::string::npos;
  };
  EXPECT_TRUE(passes("led := led + all[2];"));
  EXPECT_TRUE(passes("IF led > 3 THEN all[1] := led; RETURN; END_IF"));
  EXPECT_FALSE(passes("all[i] := led;"));
  EXPECT_FALSE(passes("led := led / all[0];"));
  EXPECT_FALSE(passes("WHILE led > 0 DO led := led - 1; END_WHILE"));
}

TEST(CodegenChoices, LoopsKeepVariablesOverCallsOfInstancesThatAreKnown) {
  const auto keeps = [](const std::string &call) {
    const std::string text = mainOf(R"(
FUNCTION_BLOCK Counter VAR_OUTPUT c : INT; END_VAR c := c + 1; END_FUNCTION_BLOCK
TYPE Holder : STRUCT own : Counter; led : REFERENCE TO Counter; END_STRUCT END_TYPE
PROGRAM Main
VAR holder : Holder; list : ARRAY[1..2] OF Holder; p : POINTER TO Holder; i, n : INT; END_VAR
FOR i := 1 TO 10 DO n := n + i; )" + call +
                                    " END_FOR\nEND_PROGRAM\n");
    return text.find("LoopContext") != std::string::npos;
  };
  EXPECT_TRUE(keeps("holder.own();"));
  EXPECT_TRUE(keeps("list[2].own();"));
  EXPECT_FALSE(keeps("holder.led();"));
  EXPECT_FALSE(keeps("p^.own();"));
}

} // namespace stc::test
