#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

/// The tree of a text without errors, or the errors.
std::string tree(const std::string &text) {
  const Parsed parsed(text);
  return parsed.diagnostics.hasErrors() ? parsed.rendered() : print(*parsed.file);
}

TEST(Declaration, Pous) {
  EXPECT_EQ(
      tree("PROGRAM A END_PROGRAM FUNCTION_BLOCK B END_FUNCTION_BLOCK; FUNCTION C END_FUNCTION"),
      "(PROGRAM A)\n(FUNCTION_BLOCK B)\n(FUNCTION C)\n");
  EXPECT_EQ(tree("FUNCTION F : INT; VAR_INPUT a : INT; END_VAR; F := a; END_FUNCTION"),
            "(FUNCTION F : INT\n  (VAR_INPUT a INT)\n  (:= F a))\n");
  EXPECT_EQ(tree("FUNCTION F : ARRAY[1..N] OF POINTER TO lib.T VAR END_VAR END_FUNCTION"),
            "(FUNCTION F : (array 1..N (pointer lib.T)))\n");
  EXPECT_EQ(tree("FUNCTION F : STRING(20) a := 1; END_FUNCTION"),
            "(FUNCTION F : STRING(20)\n  (:= a 1))\n");
  EXPECT_EQ(tree("FUNCTION F : STRING(N+1)\nb(1); END_FUNCTION"),
            "(FUNCTION F : STRING((+ N 1))\n  (call b 1))\n");
  EXPECT_EQ(tree("FUNCTION_BLOCK PUBLIC FINAL Final END_FUNCTION_BLOCK"),
            "(FUNCTION_BLOCK PUBLIC FINAL Final)\n");
}

TEST(Declaration, EndOfFileClosesTheOnlyPou) {
  EXPECT_EQ(tree("FUNCTION_BLOCK B\nVAR\n a : INT;\nEND_VAR\na := 1;\n"),
            "(FUNCTION_BLOCK B\n  (VAR a INT)\n  (:= a 1))\n");
  EXPECT_EQ(tree("PROGRAM P\nVAR\nEND_VAR\n"), "(PROGRAM P)\n");
}

TEST(Declaration, Sections) {
  EXPECT_EQ(
      tree("FUNCTION_BLOCK B VAR_INPUT a : INT; END_VAR VAR_OUTPUT b : INT; END_VAR VAR_IN_OUT "
           "CONSTANT c : INT; "
           "END_VAR VAR d : INT; END_VAR VAR_TEMP e : INT; END_VAR VAR_STAT f : INT; END_VAR "
           "VAR_EXTERNAL g : INT; "
           "END_VAR VAR RETAIN PERSISTENT h : INT; END_VAR VAR CONSTANT i : INT := 5; END_VAR VAR "
           "NON_RETAIN j : INT; "
           "END_VAR END_FUNCTION_BLOCK VAR_GLOBAL PERSISTENT k : INT; END_VAR"),
      "(FUNCTION_BLOCK B\n  (VAR_INPUT a INT)\n  (VAR_OUTPUT b INT)\n  (VAR_IN_OUT CONSTANT c "
      "INT)\n  (VAR d INT)\n  "
      "(VAR_TEMP e INT)\n  (VAR_STAT f INT)\n  (VAR_EXTERNAL g INT)\n  (VAR RETAIN PERSISTENT h "
      "INT)\n  (VAR CONSTANT "
      "i INT := 5)\n  (VAR NON_RETAIN j INT))\n(VAR_GLOBAL\n  (VAR_GLOBAL PERSISTENT k INT))\n");
}

std::string variables(const std::string &text) {
  const std::string out = tree("VAR_GLOBAL " + text + " END_VAR");
  const std::string head = "(VAR_GLOBAL\n  (VAR_GLOBAL ";
  return out.rfind(head, 0) == 0 ? out.substr(head.size(), out.size() - head.size() - 3) : out;
}

TEST(Declaration, Types) {
  EXPECT_EQ(variables("a : ARRAY [0..9, -1..N - 1] OF ARRAY[*] OF REFERENCE TO lib.T;"),
            "a (array 0..9 (- 1)..(- N 1) (array * (reference lib.T)))");
  EXPECT_EQ(variables("s : STRING;"), "s STRING");
  EXPECT_EQ(variables("s : STRING[20];"), "s STRING(20)");
  EXPECT_EQ(variables("s : WSTRING(N);"), "s WSTRING(N)");
  EXPECT_EQ(variables("s : INT(-5..+5) := 1;"), "s (range INT (- 5) (+ 5)) := 1");
  EXPECT_EQ(variables("s : (red, green := 5) BYTE := red;"),
            "s (enum of BYTE red green:=5) := red");
  EXPECT_EQ(variables("p : POINTER TO POINTER TO INT;"), "p (pointer (pointer INT))");
  EXPECT_EQ(variables("s : lib.Sub.T;"), "s lib.Sub.T");
}

TEST(Declaration, Names) {
  EXPECT_EQ(
      variables("a, b AT %QX1.3, c : BOOL := TRUE;"),
      "a BOOL := TRUE)\n  (VAR_GLOBAL b AT %QX1.3 BOOL := TRUE)\n  (VAR_GLOBAL c BOOL := TRUE");
  EXPECT_EQ(variables("a AT %I* : WORD; b AT %MD4 : DWORD;"),
            "a AT %IX* WORD)\n  (VAR_GLOBAL b AT %MD4 DWORD");
  EXPECT_EQ(variables("retain, constant : INT; persistent : BOOL; at : INT; pointer : INT;"),
            "retain INT)\n  (VAR_GLOBAL constant INT)\n  (VAR_GLOBAL persistent BOOL)\n  "
            "(VAR_GLOBAL at INT)\n  "
            "(VAR_GLOBAL pointer INT");
  EXPECT_EQ(
      variables(
          "method, S, property, r : INT; continue : INT; reference : REFERENCE TO reference;"),
      "method INT)\n  (VAR_GLOBAL S INT)\n  (VAR_GLOBAL property INT)\n  (VAR_GLOBAL r INT)\n  "
      "(VAR_GLOBAL continue "
      "INT)\n  (VAR_GLOBAL reference (reference reference)");
}

TEST(Declaration, InitialValues) {
  EXPECT_EQ(variables("a : ARRAY[1..5] OF INT := [1, 2, 3(0)];"),
            "a (array 1..5 INT) := (list 1 2 3*0)");
  EXPECT_EQ(variables("a : ARRAY[1..5] OF INT := 1, 2, 3(0);"),
            "a (array 1..5 INT) := (list 1 2 3*0)");
  EXPECT_EQ(variables("a : ARRAY[1..5] OF INT := 5(0);"), "a (array 1..5 INT) := (list 5*0)");
  EXPECT_EQ(variables("a : ARRAY[1..4] OF INT := [2(1, 2), 2()];"),
            "a (array 1..4 INT) := (list 2*{ 1 2 } 2*{ })");
  EXPECT_EQ(variables("a : A := [[1, 2], [3, 2(4)]];"), "a A := (list (list 1 2) (list 3 2*4))");
  EXPECT_EQ(variables("a : A := [2([3(1)])];"), "a A := (list 2*(list 3*1))");
  EXPECT_EQ(variables("c : MC_CamIn := (StartMode := ramp_in, VelocityDiff := 100);"),
            "c MC_CamIn := (struct StartMode:=ramp_in VelocityDiff:=100)");
  EXPECT_EQ(variables("a : A := (x := 1), (x := 2, y := [1, 2]);"),
            "a A := (list (struct x:=1) (struct x:=2 y:=(list 1 2)))");
  EXPECT_EQ(variables("a : A := [(x := 1), 2((x := 2)), 3(x := 5)];"),
            "a A := (list (struct x:=1) 2*(struct x:=2) 3*(struct x:=5))");
  EXPECT_EQ(variables("a : A := (p := 3, 3, q := 5, 2(1), s := (t := 4(0)));"),
            "a A := (struct p:=(list 3 3) q:=(list 5 2*1) s:=(struct t:=(list 4*0)))");
  EXPECT_EQ(variables("x : INT := (1 + 2) * MAX(3, 4);"), "x INT := (* p(+ 1 2) (call MAX 3 4))");
  EXPECT_EQ(variables("x : A := [N(0), f(1)];"), "x A := (list (call N 0) (call f 1))");
}

TEST(Declaration, TypeBlocks) {
  EXPECT_EQ(tree("TYPE A : INT := 5; b : A(0..3); C : STRING(10) := 'x'; END_TYPE"),
            "(ALIAS A INT := 5)\n(ALIAS b (range A 0 3))\n(ALIAS C STRING(10) := 'x')\n");
  EXPECT_EQ(tree("TYPE E : (a, b := 5, c) := b; F : (x) USINT; END_TYPE TYPE G : DINT (p, q := 2) "
                 ":= p; END_TYPE;"),
            "(ENUM E (enum a b:=5 c) := b)\n(ENUM F (enum of USINT x))\n(ENUM G (enum of DINT p "
            "q:=2) := p)\n");
  EXPECT_EQ(tree("TYPE S : STRUCT a, b : INT := 1; c : ARRAY[0..1] OF BOOL; END_STRUCT END_TYPE"),
            "(STRUCT S\n  (VAR a INT := 1)\n  (VAR b INT := 1)\n  (VAR c (array 0..1 BOOL)))\n");
  EXPECT_EQ(tree("TYPE S EXTENDS B : STRUCT; END_STRUCT; T : POINTER TO S; END_TYPE"),
            "(STRUCT S EXTENDS B)\n(ALIAS T (pointer S))\n");
}

TEST(Declaration, AttributesAndDocumentation) {
  EXPECT_EQ(tree("/// Valve.\n///  Opens.\n{attribute 'hide'} {attribute 'a b' := "
                 "'c'}\nFUNCTION_BLOCK B // no\n"
                 "VAR_INPUT\n  /// the input\n  {attribute 'x'}\n  a, b : INT; /// not behind\n  c "
                 ": INT;\nEND_VAR\n"
                 "END_FUNCTION_BLOCK"),
            "(FUNCTION_BLOCK B {hide} {a b=c} \"Valve.\n Opens.\"\n  (VAR_INPUT a INT {x} \"the "
            "input\")\n  (VAR_INPUT b INT "
            "{x} \"the input\")\n  (VAR_INPUT c INT))\n");
  EXPECT_EQ(tree("/// Colours.\nTYPE E : (\n  /// warm\n  red,\n  blue); \n/// second\n{attribute "
                 "'q'}\nF : INT; END_TYPE"),
            "(ENUM E \"Colours.\" (enum red///warm blue))\n(ALIAS F {q} \"second\" INT)\n");
  EXPECT_EQ(
      tree(
          "{attribute 'qualified_only'}\n/// Constants\nVAR_GLOBAL CONSTANT a : INT := 1; END_VAR"),
      "(VAR_GLOBAL {qualified_only} \"Constants\"\n  (VAR_GLOBAL CONSTANT a INT := 1))\n");
}

TEST(Declaration, External) {
  EXPECT_EQ(tree("FUNCTION_BLOCK B VAR a : INT; END_VAR {external} END_FUNCTION_BLOCK PROGRAM P "
                 "END_PROGRAM"),
            "(FUNCTION_BLOCK B external\n  (VAR a INT))\n(PROGRAM P)\n");
  EXPECT_EQ(tree("FUNCTION F : INT\n{external}\n"), "(FUNCTION F : INT external)\n");
}

TEST(Declaration, LargeSectionsComeTogether) {
  std::string text = "VAR_GLOBAL RETAIN\n";
  for (int i = 0; i < 3000; ++i)
    text += "v" + std::to_string(i) + " : INT := " + std::to_string(i) + ";\n";
  text += "END_VAR\nTYPE\n";
  for (int i = 0; i < 3000; ++i)
    text += "t" + std::to_string(i) + " : INT;\n";
  text += "END_TYPE\nPROGRAM P\n";
  for (int i = 0; i < 3000; ++i)
    text += "v" + std::to_string(i) + " := 1; IF a THEN END_IF;\n";
  text += "END_PROGRAM\n";
  const Parsed parsed(text);
  EXPECT_EQ(parsed.errors(), "");
  ASSERT_EQ(parsed.file->declarations.size(), 3002U);
  const auto *globals = ast::as<ast::GlobalsDecl>(parsed.file->declarations[0]);
  ASSERT_EQ(globals->variables.size(), 3000U);
  EXPECT_EQ(globals->variables[2999]->name.text, "v2999");
  EXPECT_EQ(globals->variables[2999]->qualifiers, ast::kQualRetain);
  EXPECT_EQ(ast::as<ast::PouDecl>(parsed.file->declarations[3001])->body.size(), 6000U);
}

} // namespace
} // namespace stc::test
