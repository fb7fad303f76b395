// Pragmas: where they may stand, messages, conditional compilation.
#include "tests/unit/syntax/print_ast.hpp"

#include "compiler/syntax/parser.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

std::string errors(const std::string &text) { return Parsed(text).errors(); }

/// The statements that are left of `text`, with `defines` and the declarations of `others`.
std::string body(const std::string &text, std::vector<Define> defines = {},
                 const std::string &others = {}) {
  Sources sources;
  Interner interner;
  Arena arena;
  Diagnostics diagnostics;
  const FileId id = sources.addBytes("T.st", "PROGRAM P\n" + text + "\nEND_PROGRAM\n");
  const FileId other = sources.addBytes("Gvl.st", others);
  DeclaredNames names(sources, {id, other});
  const ParseOptions options{std::move(defines), &names};
  const ast::File *file = parse(sources.file(id), interner, arena, diagnostics, &options);
  std::string out;
  for (const Diagnostic &d : diagnostics.all())
    out += d.message + '\n';
  for (const ast::Stmt *one : ast::as<ast::PouDecl>(file->declarations[0])->body)
    out += print(one);
  return out;
}

TEST(Pragma, StandAnywhere) {
  EXPECT_EQ(
      errors("{region 'x'} PROGRAM {a} P {b}\nVAR {c} x {d} : {e} INT {f} := {g} 1 {h} ; {i} "
             "END_VAR {j}\nx {k} := {l} f({m} 1 {n}, {o} a {p} := {q} 2 {r}) {s} + {t} y[{u} "
             "1 {v}] {w} ; {analysis -33}\nIF {x} x > 1 {y} THEN {z} END_IF\n{endregion}\n"
             "END_PROGRAM {end}\nTYPE {a} T {b} : {c} STRUCT {d} u : INT; {e} END_STRUCT {f} "
             "END_TYPE {g}\nFUNCTION_BLOCK {h} B {i} EXTENDS {j} C {k} METHOD {l} PUBLIC {m} n "
             "{o} : {p} INT END_METHOD {q} END_FUNCTION_BLOCK"),
      "");
  EXPECT_EQ(
      print(*Parsed("{attribute 'a'}\nPROGRAM P\nVAR\n {attribute 'b'}\n x : INT;\n y : INT; "
                    "{attribute 'c'}\n z : INT;\nEND_VAR\nEND_PROGRAM\n{attribute 'd'}\nMETHOD "
                    "PUBLIC m\n{attribute 'e'}\nVAR w : INT; END_VAR\nEND_METHOD\n{attribute "
                    "'f'}\nPROPERTY p : INT\n{attribute 'g'}\nGET END_GET\nEND_PROPERTY")
                 .file),
      "(PROGRAM P {a}\n  (VAR x INT {b})\n  (VAR y INT)\n  (VAR z INT {c})\n  (METHOD PUBLIC "
      "m {d}\n  (VAR w INT))\n  (PROPERTY p {f} : INT GET : INT))\n");
}

TEST(Pragma, Messages) {
  EXPECT_EQ(bodyErrors("\n{warning 'w'} {error \"e\"} {info 'i'} {text 't'} {warning disable C0195}"
                       "\n{warning restore C0195} {unknown 'x'} {} { }"),
            "SE0226 2:1 w\nSE0225 2:15 e\nSE0227 2:27 i\nSE0227 2:38 t\n");
}

TEST(Pragma, Branches) {
  EXPECT_EQ(body("{IF defined (A)} a(); {ELSIF defined(B)} b(); {ELSE} c(); {END_IF} d();"),
            "(call c)(call d)");
  EXPECT_EQ(body("{if defined (a)} a(); {elsif defined(B)} b(); {else} c(); {end_if} d();",
                 {{"A", ""}, {"B", ""}}),
            "(call a)(call d)");
  EXPECT_EQ(
      body("{IF defined (A)} a(); {ELSIF defined(b)} b(); {ELSE} c(); {END_IF} d();", {{"B", ""}}),
      "(call b)(call d)");
  EXPECT_EQ(
      body("{IF defined (A)} x {IF defined (B)} y {ELSE} z {END_IF} '{END_IF}' (* {END_IF} *) "
           "// {END_IF}\n %% {ELSE} {IF defined (B)} b(1 {IF NOT defined (C)} , 2 {END_IF}); "
           "{END_IF} {END_IF} d();",
           {{"B", ""}}),
      "(call b 1 2)(call d)");
  EXPECT_EQ(body("x := 1 {IF defined (A)} + 2 {ELSE} + 3 {END_IF};"), "(:= x (+ 1 3))");
  EXPECT_EQ(body("{define A} {IF defined (A)} a(); {END_IF} {undefine A} {IF defined (A)} b(); "
                 "{END_IF} {define v '5'} {IF hasvalue (v, '5')} c(); {END_IF} {IF hasvalue (v, "
                 "'6')} d(); {END_IF}"),
            "(call a)(call c)");
  EXPECT_EQ(body("{IF (defined (A) OR NOT defined (B)) AND (NOT (NOT defined (STRIDE)))} a(); "
                 "{END_IF}{IF defined (A) OR defined (A) AND defined (STRIDE)} b(); {END_IF}"),
            "(call a)");
}

TEST(Pragma, Questions) {
  const std::string others =
      "VAR_GLOBAL CONSTANT\n{attribute 'x'}\nlimit : INT := 5;\nname : STRING := 'abc';\nEND_VAR\n"
      "{attribute 'y'}\nFUNCTION_BLOCK Fb\nVAR\n here : REAL;\nEND_VAR\nMETHOD m END_METHOD\n"
      "END_FUNCTION_BLOCK\nTYPE\n {attribute 'z'}\n T : STRUCT\n limit2 : INT;\nEND_STRUCT;\nU : "
      "(a, b);\nEND_TYPE\n";
  const auto ask = [&](const std::string &question) {
    return body("{IF " + question + "} yes(); {ELSE} no(); {END_IF}", {}, others) == "(call yes)";
  };
  EXPECT_TRUE(ask("defined (variable: limit)"));
  EXPECT_TRUE(ask("defined (variable: GVL.LIMIT)"));
  EXPECT_FALSE(ask("defined (variable: limit2)"));
  EXPECT_FALSE(ask("defined (variable: here)"));
  EXPECT_TRUE(ask("defined (variable: Fb.here)"));
  EXPECT_TRUE(ask("defined (pou: P)"));
  EXPECT_TRUE(ask("defined (pou: fb)"));
  EXPECT_TRUE(ask("defined (pou: fb.m)"));
  EXPECT_FALSE(ask("defined (pou: T)"));
  EXPECT_TRUE(ask("defined (type: T)"));
  EXPECT_TRUE(ask("defined (type: U)"));
  EXPECT_TRUE(ask("defined (type: Fb)"));
  EXPECT_FALSE(ask("defined (type: limit)"));
  EXPECT_FALSE(ask("defined (task: T)"));
  EXPECT_TRUE(ask("hasattribute (variable: limit, 'X')"));
  EXPECT_FALSE(ask("hasattribute (variable: name, 'X')"));
  EXPECT_TRUE(ask("hasattribute (pou: Fb, 'y')"));
  EXPECT_TRUE(ask("hasattribute (type: T, 'z')"));
  EXPECT_TRUE(ask("hastype (variable: limit, INT)"));
  EXPECT_FALSE(ask("hastype (variable: limit, DINT)"));
  EXPECT_TRUE(ask("hasconstantvalue (variable: limit, 5)"));
  EXPECT_TRUE(ask("hasconstantvalue (limit, 4, >)"));
  EXPECT_FALSE(ask("hasconstantvalue (limit, 4, <=)"));
  EXPECT_TRUE(ask("hasconstantvalue (name, 'abc')"));
}

TEST(Pragma, Errors) {
  EXPECT_EQ(bodyErrors("\n{IF A} a(); {END_IF}\n{IF defined A} a(); {END_IF}\n{IF} {END_IF}\n{IF "
                       "defined (a) b} {END_IF}\n{IF defined (class: a)} {END_IF}\n{define}"),
            "SE0223 2:5 this condition cannot be understood\n"
            "SE0223 3:13 this condition cannot be understood\n"
            "SE0223 4:4 this condition cannot be understood\n"
            "SE0223 5:17 this condition cannot be understood\n"
            "SE0223 6:14 this condition cannot be understood\n"
            "SE0223 7:1 `{define}` needs a name\n");
  EXPECT_EQ(errors("PROGRAM P\n{END_IF}\n{ELSE}\n{ELSIF defined (a)}\n{IF defined (a)} {ELSE} "
                   "{ELSE} {ELSIF defined (a)} {END_IF}\nEND_PROGRAM\n{IF NOT defined (a)}"),
            "SE0224 2:1 `{END_IF}` without an `{IF …}`\n"
            "SE0224 3:1 `{ELSE}` without an `{IF …}`\n"
            "SE0224 4:1 `{ELSIF}` without an `{IF …}`\n"
            "SE0224 5:25 `{ELSE}` after the `{ELSE}` of the same `{IF …}`\n"
            "SE0224 5:32 `{ELSIF}` after the `{ELSE}` of the same `{IF …}`\n"
            "SE0224 7:1 this `{IF …}` has no `{END_IF}`\n");
  EXPECT_EQ(errors("PROGRAM P\n{IF defined (a)}\nx := ;\nEND_PROGRAM\n"),
            "SE0224 2:1 this `{IF …}` has no `{END_IF}`\n");
}

} // namespace
} // namespace stc::test
