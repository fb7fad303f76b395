#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

using namespace ast;

TEST(Expression, Precedence) {
  EXPECT_EQ(printExpression("a + b * c - d"), "(- (+ a (* b c)) d)");
  EXPECT_EQ(printExpression("a OR b XOR c AND d"), "(OR a (XOR b (AND c d)))");
  EXPECT_EQ(printExpression("a AND b & c"), "(AND (AND a b) c)");
  EXPECT_EQ(printExpression("a = b AND c < d + 1"), "(AND (= a b) (< c (+ d 1)))");
  EXPECT_EQ(printExpression("a < b = c >= d"), "(= (< a b) (>= c d))");
  EXPECT_EQ(printExpression("a <> b"), "(<> a b)");
  EXPECT_EQ(printExpression("a - b - c"), "(- (- a b) c)");
  EXPECT_EQ(printExpression("a / b MOD c * d"), "(* (MOD (/ a b) c) d)");
  EXPECT_EQ(printExpression("2 * a ** b ** c"), "(* 2 (** (** a b) c))");
  EXPECT_EQ(printExpression("a AND_THEN b OR_ELSE c"), "(OR_ELSE (AND_THEN a b) c)");
  EXPECT_EQ(printExpression("a <= b OR a > b"), "(OR (<= a b) (> a b))");
}

TEST(Expression, OperatorsAsFunctions) {
  EXPECT_EQ(printExpression("AND(a, b)"), "(call AND a b)");
  EXPECT_EQ(printExpression("a AND (b)"), "(AND a pb)");
  EXPECT_EQ(printExpression("a AND AND (* x *) (b, c)"), "(AND a (call AND b c))");
  EXPECT_EQ(printExpression("OR(a, b) AND (c)"), "(AND (call OR a b) pc)");
  EXPECT_EQ(printExpression("NOT xor(a, b)"), "(NOT (call xor a b))");
  EXPECT_EQ(printExpression("-MOD(a, b) MOD (2)"), "(MOD (- (call MOD a b)) p2)");
  EXPECT_EQ(printExpression("f(AND(a, b), a[MOD(i, 2)])"),
            "(call f (call AND a b) ([] a (call MOD i 2)))");
  EXPECT_EQ(printExpression("TRUE AND (a)"), "(AND TRUE pa)");
  EXPECT_EQ(printExpression("p^ OR (16#1 XOR (a.0))"), "(OR (^ p) p(XOR 1 p(. a bit 0)))");
}

TEST(Expression, Prefixes) {
  EXPECT_EQ(printExpression("NOT a AND -b + +c"), "(AND (NOT a) (+ (- b) (+ c)))");
  EXPECT_EQ(printExpression("NOT NOT a"), "(NOT (NOT a))");
  EXPECT_EQ(printExpression("NOT NOT NOT a"), "(NOT a)");
  EXPECT_EQ(printExpression("- - - - a"), "(- (- a))");
  EXPECT_EQ(printExpression("NOT - NOT a"), "(NOT (- (NOT a)))");
  EXPECT_EQ(printExpression("-a.b[1]^"), "(- (^ ([] (. a b) 1)))");
  EXPECT_EQ(printExpression("NOT (a = b)"), "(NOT p(= a b))");
}

TEST(Expression, Operands) {
  EXPECT_EQ(printExpression("a.b[i, j + 1].c^.d"), "(. (^ (. ([] (. a b) i (+ j 1)) c)) d)");
  EXPECT_EQ(printExpression("w.3 AND a.b.15"), "(AND (. w bit 3) (. (. a b) bit 15))");
  EXPECT_EQ(printExpression("((a + b)) * c"), "(* p(+ a b) c)");
  EXPECT_EQ(printExpression("color#green"), "color#green");
  EXPECT_EQ(printExpression("lib.f(1, g())"), "(call (. lib f) 1 (call g))");
  EXPECT_EQ(printExpression("fb.type.if.end_var"), "(. (. (. fb type) if) end_var)");
  EXPECT_EQ(printExpression("THIS^.x"), "(. (^ THIS) x)");
  EXPECT_EQ(printExpression("__NEW(x)"), "(call __NEW x)");
}

TEST(Expression, AggregatesAndRepetitionsAreLeftToTheChecker) {
  EXPECT_EQ(printExpression("[1, 2(0)]"), "(list 1 2*0)");
  EXPECT_EQ(printExpression("(a := 1, b := 2)"), "(struct a:=1 b:=2)");
  EXPECT_EQ(printExpression("3(0)"), "(call 3 0)");
}

TEST(Statement, Assignments) {
  EXPECT_EQ(printBody("a := 1; b := c := d[1] := 2;"), "(:= a 1)\n(:= b c ([] d 1) 2)");
  EXPECT_EQ(printBody("a S= b; a.c R= TRUE; p[1] REF= q; s s= s;"),
            "(S= a b)\n(R= (. a c) TRUE)\n(REF= ([] p 1) q)\n(S= s s)");
  EXPECT_EQ(printBody("w.3 S= x;"), "(S= (. w bit 3) x)");
}

TEST(Statement, SetAndResetOnlyBehindAVariable) {
  EXPECT_EQ(printBody("IF S=1 OR R=2 AND REF=3 THEN S := R; END_IF"),
            "(if (OR (= S 1) (AND (= R 2) (= REF 3))) { (:= S R) })");
  EXPECT_EQ(printBody("f(S=>x, R:=S=1);"), "(call f S=>x R:=(= S 1))");
}

TEST(Statement, Calls) {
  EXPECT_EQ(printBody("f(); f(1, b); a[i].fb(In := 1, Q => x.y, Out =>, Skip := , 5);"),
            "(call f)\n(call f 1 b)\n(call (. ([] a i) fb) In:=1 Q=>(. x y) Out=> Skip:= 5)");
}

TEST(Statement, Blocks) {
  EXPECT_EQ(printBody("IF a THEN b := 1; ELSIF c THEN ELSIF d THEN f(); ELSE g(); END_IF"),
            "(if a { (:= b 1) } c { } d { (call f) } else { (call g) })");
  EXPECT_EQ(
      printBody("FOR i := 0 TO 10 BY -2 DO EXIT; END_FOR FOR a.i := 1 TO n DO CONTINUE; END_FOR"),
      "(for i 0 10 (- 2) { (exit) })\n(for (. a i) 1 n null { (continue) })");
  EXPECT_EQ(printBody("WHILE a DO RETURN; END_WHILE REPEAT f(); UNTIL b = 1 END_REPEAT"),
            "(while a { (return) })\n(repeat { (call f) } (= b 1))");
  EXPECT_EQ(printBody("REPEAT UNTIL b; END_REPEAT;"), "(repeat { } b)");
}

TEST(Statement, Case) {
  EXPECT_EQ(
      printBody(
          "CASE a OF 1, 2..5: x := 1; -3: ; green: y := 2; f(z); E.red, lib.E.blue, E#x: END_CASE"),
      "(case a 1 2..5 { (:= x 1) } (- 3) { (;) } green { (:= y 2) (call f z) } (. E red) (. (. lib "
      "E) blue) "
      "E#x { })");
  EXPECT_EQ(
      printBody("CASE a OF 1: CASE b OF x: f(); ELSE g(); END_CASE 2: h(); ELSE k(); END_CASE"),
      "(case a 1 { (case b x { (call f) } else { (call g) }) } 2 { (call h) } else { (call k) })");
  EXPECT_EQ(printBody("CASE a OF c + 1 .. c + 2: f(); END_CASE"),
            "(case a (+ c 1)..(+ c 2) { (call f) })");
  EXPECT_EQ(printBody("CASE a OF END_CASE"), "(case a)");
}

TEST(Statement, SemicolonsBehindBlocks) {
  EXPECT_EQ(printBody("IF a THEN END_IF; WHILE a DO END_WHILE b := 1;"),
            "(if a { })\n(while a { })\n(:= b 1)");
  EXPECT_EQ(printBody("IF a THEN END_IF;;"), "(if a { })\n(;)");
  EXPECT_EQ(printBody("a := 1;;"), "(:= a 1)\n(;)");
}

TEST(Statement, SoftKeywordsAreNames) {
  EXPECT_EQ(
      printBody(
          "continue := 1; CONTINUE(x); continue.a := method; METHOD := final; class[1] := step;"),
      "(:= continue 1)\n(call CONTINUE x)\n(:= (. continue a) method)\n(:= METHOD final)\n(:= ([] "
      "class 1) step)");
  EXPECT_EQ(printBody("abstract := property + interface AND namespace; Action(); x := pointer; at "
                      ":= reference;"),
            "(:= abstract (AND (+ property interface) namespace))\n(call Action)\n(:= x "
            "pointer)\n(:= at reference)");
  EXPECT_EQ(printBody("IF union THEN using := and_then; END_IF; FOR public := private TO internal "
                      "BY step DO END_FOR"),
            "(if union { (:= using and_then) })\n(for public private internal step { })");
}

TEST(Statement, Comments) {
  EXPECT_EQ(printBody("a (* x (* y *) z *) := // end\n 1 /* c */ ; (**) (***) (* * ) *) b := 2;"),
            "(:= a 1)\n(:= b 2)");
  EXPECT_EQ(printBody("a := 'x // (* '; {pragma 'with }' } b := {unknown} 2; // {"),
            "(:= a 'x // (* ')\n(:= b 2)");
}

TEST(Spans, AreNarrow) {
  const Parsed parsed(
      "PROGRAM P\n  abc.d := f(x) + ( 12 );\n  IF a THEN b := 1; END_IF;\nEND_PROGRAM");
  const auto *pou = as<PouDecl>(parsed.file->declarations[0]);
  EXPECT_EQ(parsed.text(pou->name.span), "P");
  const auto *assign = as<AssignStmt>(pou->body[0]);
  EXPECT_EQ(parsed.text(assign->span), "abc.d := f(x) + ( 12 )");
  EXPECT_EQ(parsed.text(assign->opSpan), ":=");
  EXPECT_EQ(parsed.text(assign->targets[0]->span), "abc.d");
  EXPECT_EQ(parsed.text(as<MemberExpr>(assign->targets[0])->name.span), "d");
  const auto *sum = as<BinaryExpr>(assign->value);
  EXPECT_EQ(parsed.text(sum->span), "f(x) + ( 12 )");
  EXPECT_EQ(parsed.text(sum->opSpan), "+");
  EXPECT_EQ(parsed.text(sum->left->span), "f(x)");
  EXPECT_EQ(parsed.text(sum->right->span), "( 12 )");
  EXPECT_EQ(parsed.text(as<CallExpr>(sum->left)->arguments[0].span), "x");
  EXPECT_EQ(parsed.text(pou->body[1]->span), "IF a THEN b := 1; END_IF");
}

} // namespace
} // namespace stc::test
