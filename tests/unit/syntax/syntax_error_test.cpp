#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

std::string errors(const std::string &text) { return Parsed(text).errors(); }

// Each test shows that one mistake gives one message and that what follows is read.

TEST(SyntaxError, MissingSemicolon) {
  EXPECT_EQ(bodyErrors("\na := 1\nb := 2;"), "SE0202 2:7 expected `;` after the assignment\n");
  EXPECT_EQ(bodyErrors("\nf(1)\nb := 2;"), "SE0202 2:5 expected `;` after the call\n");
  EXPECT_EQ(bodyErrors("\nIF a THEN b := 1 END_IF\nEXIT\nc := 1;"),
            "SE0202 2:17 expected `;` after the assignment\nSE0202 3:5 expected `;` after the "
            "statement\n");
  EXPECT_EQ(errors("VAR_GLOBAL\n  a : INT\n  b : INT;\n  c : BOOL := TRUE\nEND_VAR"),
            "SE0202 2:10 expected `;` after the declaration\nSE0202 4:19 expected `;` after the "
            "declaration\n");
  EXPECT_EQ(bodyErrors("\nCASE a OF\n1: b := 2\n2: c := 3;\nEND_CASE"),
            "SE0202 3:10 expected `;` after the assignment\n");
}

TEST(SyntaxError, MissingWord) {
  EXPECT_EQ(bodyErrors("\nIF a = 1\n  b := 2;\nEND_IF"),
            "SE0202 2:9 expected `THEN` after the condition\n");
  EXPECT_EQ(bodyErrors("\nIF a b := 2; END_IF c := 1"),
            "SE0202 2:5 expected `THEN` after the condition\nSE0202 2:27 expected `;` after the "
            "assignment\n");
  EXPECT_EQ(bodyErrors("\nWHILE a\nb := 1; END_WHILE"),
            "SE0202 2:8 expected `DO` after the condition\n");
  EXPECT_EQ(bodyErrors("\nFOR i := 1 TO 5\nb := 1; END_FOR"),
            "SE0202 2:16 expected `DO` after the range\n");
  EXPECT_EQ(bodyErrors("\nCASE a\n1: b := 1; END_CASE"),
            "SE0202 2:7 expected `OF` after the selector\n");
  EXPECT_EQ(bodyErrors("\nREPEAT a := 1; END_REPEAT"),
            "SE0202 2:15 expected `UNTIL` before the condition\n");
  EXPECT_EQ(bodyErrors("\nIF a DO b := 1; END_IF"), "SE0201 2:6 expected `THEN`, found `DO`\n");
  EXPECT_EQ(errors("VAR_GLOBAL a INT; b : ARRAY[1..2] INT; END_VAR"),
            "SE0202 1:13 expected `:` between name and type\nSE0202 1:34 expected `OF` before "
            "the element type\n");
}

TEST(SyntaxError, MissingEnd) {
  EXPECT_EQ(bodyErrors("\nFOR i := 1 TO 5 DO\n  a := 1;"), "SE0203 2:1 missing `END_FOR`\n");
  EXPECT_EQ(bodyErrors("\nWHILE a DO\n  IF b THEN c := 1;\nEND_WHILE d := 1"),
            "SE0203 3:3 missing `END_IF`\nSE0202 4:17 expected `;` after the assignment\n");
  EXPECT_EQ(bodyErrors("\nCASE a OF\n1: IF b THEN c := 1;\n2: d := 1;\nEND_CASE"),
            "SE0203 3:4 missing `END_IF`\n");
  EXPECT_EQ(
      errors("FUNCTION_BLOCK A\nVAR a : INT;\na := 1;\nEND_FUNCTION_BLOCK\nPROGRAM P END_PROGRAM"),
      "SE0203 2:1 missing `END_VAR`\n");
  EXPECT_EQ(errors("PROGRAM A\na := 1;\nPROGRAM B\nEND_PROGRAM\n"),
            "SE0203 1:1 missing `END_PROGRAM`\n");
  EXPECT_EQ(errors("PROGRAM A\nEND_PROGRAM\nPROGRAM B\na := 1;\n"),
            "SE0203 3:1 missing `END_PROGRAM`\n");
  EXPECT_EQ(errors("TYPE A : STRUCT a : INT; END_TYPE PROGRAM B END_PROGRAM"),
            "SE0203 1:10 missing `END_STRUCT`\n");
  EXPECT_EQ(errors("TYPE A : INT; PROGRAM B END_PROGRAM"), "SE0203 1:1 missing `END_TYPE`\n");
}

TEST(SyntaxError, WrongEnd) {
  EXPECT_EQ(bodyErrors("\nIF a THEN b := 1; END_WHILE c := 1;"),
            "SE0211 2:19 `END_WHILE` does not close `IF`\n");
  EXPECT_EQ(bodyErrors("\na := 1; END_IF; c := 1; END_FOR"),
            "SE0211 2:9 `END_IF` closes nothing\nSE0211 2:25 `END_FOR` closes nothing\n");
  EXPECT_EQ(errors("FUNCTION A\nEND_PROGRAM\nPROGRAM B\nEND_PROGRAM"),
            "SE0211 2:1 `END_PROGRAM` does not close a FUNCTION\n");
  EXPECT_EQ(errors("PROGRAM A\nEND_PROGRAM\nEND_IF\nEND_PROGRAM"),
            "SE0211 3:1 `END_IF` closes nothing\nSE0211 4:1 `END_PROGRAM` closes nothing\n");
  EXPECT_EQ(bodyErrors("\nELSE a := 1; ELSIF b THEN c := 1;"),
            "SE0201 2:1 `ELSE` without a block that it belongs to\nSE0201 2:14 `ELSIF` without a "
            "block that it belongs to\n");
  EXPECT_EQ(bodyErrors("\nIF a THEN b := 1; ELSE c := 1; ELSIF d THEN e := 1; END_IF f := 1;"),
            "SE0201 2:32 `ELSIF` after the ELSE of the same IF\n");
}

TEST(SyntaxError, ElseIf) {
  EXPECT_EQ(
      bodyErrors(
          "\nIF a THEN\n  b := 1;\nELSE IF c THEN\n  b := 2;\nELSE IF d THEN\n  b := 3;\nEND_IF"),
      "SE0206 6:1 `ELSE IF` opens a second IF, whose END_IF is missing\n");
  EXPECT_EQ(bodyErrors("IF a THEN ELSE IF b THEN END_IF END_IF"), "");
}

TEST(SyntaxError, AssignmentAndComparison) {
  EXPECT_EQ(bodyErrors("\na = 5;"), "SE0204 2:3 `=` compares, it does not assign\n");
  EXPECT_EQ(bodyErrors("\na.b[1] = b = 5; IF a[0] := 1 AND b THEN c := 1; END_IF"),
            "SE0204 2:8 `=` compares, it does not assign\nSE0205 2:25 `:=` assigns, it does not "
            "compare\n");
  EXPECT_EQ(bodyErrors("\nFOR i = 1 TO 5 DO END_FOR"),
            "SE0204 2:7 `=` compares, it does not assign\n");
  EXPECT_EQ(bodyErrors("\na : = 5; b := 1;"), "SE0201 2:3 expected `:=` or `;`, found `:`\n");
  const Parsed parsed("PROGRAM P a = b; END_PROGRAM");
  EXPECT_EQ(print(*parsed.file), "(PROGRAM P\n  (:= a b))\n");
}

TEST(SyntaxError, OperatorsOfOtherLanguages) {
  EXPECT_EQ(bodyErrors("\nIF a == 1 && !b || c != 2 THEN d := 1; END_IF"),
            "SE0113 2:6 `==` is not an operator of Structured Text\nSE0113 2:11 `&&` is not an "
            "operator of Structured "
            "Text\nSE0113 2:14 `!` is not an operator of Structured Text\nSE0113 2:17 `||` is not "
            "an operator of "
            "Structured Text\nSE0113 2:22 `!=` is not an operator of Structured Text\n");
  EXPECT_EQ(bodyErrors("\na := b % 2; a == 5;"),
            "SE0113 2:8 `%` is not an operator of Structured Text\nSE0113 2:15 `==` is not an "
            "operator of Structured Text\n");
  EXPECT_EQ(bodyErrors("\nIF a => b THEN END_IF"),
            "SE0201 2:6 expected an operator or `THEN`, found `=>`\n");
}

TEST(SyntaxError, Expressions) {
  EXPECT_EQ(bodyErrors("\na := 1 + ; b := * 2; c := d e; f := 1;"),
            "SE0201 2:10 expected an expression, found `;`\nSE0201 2:17 expected an expression, "
            "found `*`\n"
            "SE0201 2:29 expected an operator or `;`, found `e`\n");
  EXPECT_EQ(bodyErrors("\na := (1 + 2; f(1, (2); b := 1;"),
            "SE0202 2:12 expected `)`\nSE0202 2:22 expected `)`\n");
  EXPECT_EQ(bodyErrors("\na := b[1; c := d[];"),
            "SE0202 2:9 expected `]`\nSE0201 2:17 expected an index between the brackets\n");
  EXPECT_EQ(bodyErrors("\na := 1); b := 2;"),
            "SE0201 2:7 expected an operator or `;`, found `)`\n");
  EXPECT_EQ(bodyErrors("\nf(a b, c); g(a := ); h(a.b := 1);"),
            "SE0201 2:5 expected an operator, `,` or `)`, found `b`\n"
            "SE0213 2:24 expected the name of a parameter before `:=`\n");
  EXPECT_EQ(bodyErrors("\nIF THEN a := 1; END_IF WHILE DO b := END_WHILE"),
            "SE0201 2:4 expected an expression, found `THEN`\nSE0201 2:30 expected an expression, "
            "found `DO`\n"
            "SE0201 2:38 expected an expression, found `END_WHILE`\n");
  EXPECT_EQ(bodyErrors("\na := b. ; c := d.(e);"),
            "SE0201 2:9 expected the name of a member after the point, found `;`\n"
            "SE0201 2:18 expected the name of a member after the point, found `(`\n");
}

TEST(SyntaxError, KeywordsAsNames) {
  EXPECT_EQ(errors("VAR_GLOBAL type : INT; a, function : INT; b : INT; END_VAR"),
            "SE0207 1:12 `type` is a keyword, it cannot be a name\n"
            "SE0207 1:27 `function` is a keyword, it cannot be a name\n");
  EXPECT_EQ(bodyErrors("\ntype := 5; a := array; b := 1;"),
            "SE0207 2:1 `type` is a keyword, it cannot be a name\nSE0207 2:17 `array` is a "
            "keyword, it cannot be a name\n");
  EXPECT_EQ(errors("TYPE to : INT; a : (by, x); END_TYPE"),
            "SE0207 1:6 `to` is a keyword, it cannot be a name\n"
            "SE0207 1:21 `by` is a keyword, it cannot be a name\n");
  EXPECT_EQ(errors("TYPE a : (x, exit := 3, y, return); END_TYPE"),
            "SE0207 1:14 `exit` is a keyword, it cannot be a name\n"
            "SE0207 1:28 `return` is a keyword, it cannot be a name\n");
  EXPECT_EQ(errors("TYPE a : INT (1..exit); END_TYPE"),
            "SE0201 1:18 expected an expression, found `exit`\n");
  EXPECT_EQ(errors("VAR_GLOBAL a : B(TRUE, FALSE); END_VAR"), "");
}

TEST(SyntaxError, Declarations) {
  EXPECT_EQ(
      errors("VAR_GLOBAL\n a : ;\n b := 5;\n 5 : INT;\n c : INT;\nEND_VAR\nPROGRAM\nEND_PROGRAM"),
      "SE0201 2:6 expected a type, found `;`\nSE0201 3:4 expected `:` and a type, found `:=`\n"
      "SE0201 4:2 expected the name of a variable or `END_VAR`, found `5`\n"
      "SE0201 8:1 expected a name, found `END_PROGRAM`\n");
  const Parsed parsed("VAR_GLOBAL a : ; b := 5; c : INT := ; END_VAR");
  EXPECT_EQ(
      print(*parsed.file),
      "(VAR_GLOBAL\n  (VAR_GLOBAL a error)\n  (VAR_GLOBAL b error)\n  (VAR_GLOBAL c error))\n");
  EXPECT_EQ(
      errors("PROGRAM P a := 1; VAR b : INT; END_VAR c := 1; VAR d : INT; END_VAR END_PROGRAM"),
      "SE0210 1:19 declarations must stand before the first statement\n");
  EXPECT_EQ(errors("TYPE a : (b, 5, c); d : (1..2); e : INT(1..2, 3..4); END_TYPE"),
            "SE0201 1:14 expected the name of an enumerator\nSE0201 1:26 expected the name of an "
            "enumerator\n"
            "SE0201 1:47 a subrange has one range\n");
}

TEST(SyntaxError, OutsideDeclarations) {
  EXPECT_EQ(errors("a := 1;\nb := 2;\nPROGRAM P\nEND_PROGRAM"),
            "SE0209 1:1 expected a declaration, found `a`\n");
  EXPECT_EQ(errors("PROGRAM P\nEND_PROGRAM\nVAR a : INT; END_VAR"),
            "SE0209 3:1 `VAR` outside a program, function or function block\n");
}

TEST(SyntaxError, CaseBranches) {
  EXPECT_EQ(bodyErrors("\nCASE a OF\n b := 1;\n 1: c := 2;\nEND_CASE d := 1;"),
            "SE0201 3:2 expected a CASE label, found `b`\n");
  EXPECT_EQ(bodyErrors("\nCASE a OF\n 1, : b := 1;\n 2.. : c := 1;\n 3: d := 1;\nEND_CASE"),
            "SE0201 3:5 expected an expression, found `:`\nSE0201 4:6 expected an expression, "
            "found `:`\n");
}

TEST(SyntaxError, Tokens) {
  EXPECT_EQ(bodyErrors("\na := 'abc;\nb := 1;"), "SE0105 2:6 this string has no end\n");
  EXPECT_EQ(bodyErrors("\nf('abc);\nb := 1;"), "SE0105 2:3 this string has no end\n");
  EXPECT_EQ(errors("PROGRAM P (* a (* b *)\nEND_PROGRAM"), "SE0104 1:11 this comment has no end\n");
  EXPECT_EQ(errors("PROGRAM P /* a\nEND_PROGRAM"), "SE0104 1:11 this comment has no end\n");
  EXPECT_EQ(errors("PROGRAM P {a\na := 1;\nEND_PROGRAM"), "SE0106 1:11 this pragma has no end\n");
  EXPECT_EQ(bodyErrors("\ngröße := 1; a__b := 2; __new := 3;"),
            "SE0103 2:3 a name may not contain this character\n"
            "SE0112 2:13 the name `a__b` has two underscores in a row\n");
  EXPECT_EQ(bodyErrors("\na := b § c; d := #;"),
            "SE0103 2:8 this character has no meaning here\n"
            "SE0103 2:18 this character has no meaning here\n");
  EXPECT_EQ(errors("VAR_GLOBAL a AT %X5 : BOOL; b AT %IX : BOOL; END_VAR"),
            "SE0115 1:17 malformed direct address\nSE0115 1:34 malformed direct address\n");
}

TEST(SyntaxError, OtherLanguages) {
  EXPECT_EQ(bodyErrors("\nLD a\nAND b\nST c\n"), "");
  EXPECT_EQ(bodyErrors("\nINITIAL_STEP s:\nEND_STEP\nTRANSITION FROM s TO t := a;\nEND_TRANSITION"
                       "\nACTION x:\ny := 1;\nEND_ACTION\nSTEP t:\nx(N);\nEND_STEP"),
            "");
  EXPECT_EQ(bodyErrors("\nINITIAL_STEP s:\nEND_STEP\nTRANSITION FROM s TO t := a;\nEND_TRANSITION"
                       "\nACTION x:\ny := 1;\nEND_ACTION\nSTEP t\nx(N);\nEND_STEP"),
            "SE0202 10:1 expected `:` in a sequential function chart\n");
}

TEST(SyntaxError, NoCascades) {
  EXPECT_EQ(bodyErrors("\na[1 := 5; b := 1;"), "SE0202 2:4 expected `]`\n");
  EXPECT_EQ(bodyErrors("\na := 1; i : INT; j : ARRAY[1..2] OF INT := [1, 2]; t : TON; b := 1;"),
            "SE0228 2:9 `i` is declared among the statements\n"
            "SE0228 2:18 `j` is declared among the statements\n"
            "SE0228 2:52 `t` is declared among the statements\n");
  EXPECT_EQ(errors("PROGRAM P\nVAR\n  a : INT;\nb(1);\na := 2;\nEND_PROGRAM"),
            "SE0203 2:1 missing `END_VAR`\n");
}

TEST(SyntaxError, ExternalBody) {
  EXPECT_EQ(
      errors("FUNCTION_BLOCK A\nVAR a : INT; END_VAR\n{external}\na := 1;\nEND_FUNCTION_BLOCK"),
      "SE0212 4:1 an external block has no statements\n");
}

TEST(SyntaxError, Rendered) {
  EXPECT_EQ(Parsed("PROGRAM P\nIF a > (3 THEN\n  b := 1\nEND_IF\nEND_PROGRAM").rendered(),
            "error[SE0202]: expected `)`\n"
            " --> T.st:2:10\n"
            "  |\n"
            "2 | IF a > (3 THEN\n"
            "  |        - ^ add `)` here\n"
            "  |        |\n"
            "  |        to close this one\n"
            "\n"
            "error[SE0202]: expected `;` after the assignment\n"
            " --> T.st:3:9\n"
            "  |\n"
            "3 |   b := 1\n"
            "  |         ^ add `;` here\n"
            "\n");
}

} // namespace
} // namespace stc::test
