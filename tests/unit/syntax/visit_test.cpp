#include "compiler/syntax/visit.hpp"

#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

using namespace ast;

/// The names that a walk over a program's body meets, in its order.
std::string namesIn(const std::string &statements) {
  const Parsed parsed("PROGRAM P\n" + statements + "\nEND_PROGRAM\n");
  EXPECT_FALSE(parsed.diagnostics.hasErrors()) << parsed.rendered();
  std::string out;
  walkExpressions(as<PouDecl>(parsed.file->declarations[0])->body, [&](const Expr *e) {
    if (e->kind == ExprKind::Name)
      out.append(as<NameExpr>(e)->name.text).append(" ");
  });
  return out;
}

TEST(Visit, ExpressionsInTheOrderOfTheText) {
  EXPECT_EQ(namesIn("a[i, j + k].m^ := -f(b, x := c, y => d) ** (e.3 AND NOT g);"),
            "a i j k f b c d e g ");
  EXPECT_EQ(namesIn("a := b := c;"), "a b c ");
  EXPECT_EQ(namesIn("a := lib#b; c := INT#5; d := %IX0.0; x := SIZEOF(STRING(n));"),
            "a c d x SIZEOF ");
}

TEST(Visit, StatementsOfEveryKind) {
  EXPECT_EQ(namesIn("IF a THEN b(); ELSIF c THEN d(); ELSE e(); END_IF"), "a b c d e ");
  EXPECT_EQ(namesIn("CASE a OF b, c..d: e(); g: ; ELSE f(); END_CASE"), "a b c d e g f ");
  EXPECT_EQ(namesIn("FOR a := b TO c BY d DO e(); END_FOR FOR f := 1 TO g DO ; END_FOR"),
            "a b c d e f g ");
  EXPECT_EQ(namesIn("WHILE a DO b(); END_WHILE REPEAT c(); UNTIL d END_REPEAT"), "a b c d ");
  EXPECT_EQ(namesIn("l: JMP l; EXIT; CONTINUE; RETURN; ;"), "");
  EXPECT_EQ(namesIn("__TRY a(); __CATCH (b) c(); __FINALLY d(); __ENDTRY __TRY e(); __CATCH f(); "
                    "__ENDTRY"),
            "a b c d e f ");
}

TEST(Visit, InitialValues) {
  const Parsed parsed("PROGRAM P VAR v : T := [a, 2(b), n((x := c, y := [d, e])), f(g, h)]; "
                      "END_VAR END_PROGRAM");
  std::string out;
  walk(as<PouDecl>(parsed.file->declarations[0])->variables[0]->init, [&](const Expr *e) {
    if (e->kind == ExprKind::Name)
      out.append(as<NameExpr>(e)->name.text).append(" ");
  });
  EXPECT_EQ(out, "a b n c d e f g h ");
}

TEST(Visit, LooksBelowOnlyWhereItIsTold) {
  const Parsed parsed("PROGRAM P\nIF a THEN WHILE b DO c(); END_WHILE d(e(f), g); END_IF\n"
                      "h();\nEND_PROGRAM\n");
  const Block body = as<PouDecl>(parsed.file->declarations[0])->body;
  std::string kinds;
  walkStatements(body, [&](const Stmt *s) {
    kinds.append(std::to_string(static_cast<int>(s->kind))).append(" ");
    return s->kind != StmtKind::While;
  });
  const auto kind = [](StmtKind k) { return std::to_string(static_cast<int>(k)) + " "; };
  EXPECT_EQ(kinds, kind(StmtKind::If) + kind(StmtKind::While) + kind(StmtKind::Call) +
                       kind(StmtKind::Call));
  size_t calls = 0;
  walkExpressions(body, [&](const Expr *e) {
    calls += e->kind == ExprKind::Call ? 1 : 0;
    return e->kind != ExprKind::Call;
  });
  EXPECT_EQ(calls, 3U); // e(f) stands in d(…)
}

TEST(Visit, KindsComeFromTheType) {
  const CallExpr call{};
  EXPECT_EQ(call.kind, ExprKind::Call);
  EXPECT_TRUE(PouDecl::holds(DeclKind::Action));
  EXPECT_FALSE(PouDecl::holds(DeclKind::Property));
  const PointerTypeExpr pointer{};
  EXPECT_EQ(pointer.kind, TypeExprKind::Pointer);
  EXPECT_TRUE(PointerTypeExpr::holds(TypeExprKind::Reference));
  EXPECT_EQ(Expr{}.kind, ExprKind::Error);
}

} // namespace
} // namespace stc::test
