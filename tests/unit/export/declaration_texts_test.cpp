// A source file cut into its declarations: heads, bodies, and whose each comment is.
#include "compiler/export/declaration_texts.hpp"
#include "compiler/syntax/parser.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using stc::exporting::DeclarationText;
using stc::exporting::FileTexts;

/// A text cut into pieces, and its tree.
struct Cut {
  explicit Cut(const std::string &text) {
    const stc::FileId id = sources.add("Line.st", text);
    file = stc::parse(sources.file(id), interner, arena, diagnostics);
    EXPECT_FALSE(diagnostics.hasErrors());
    texts = stc::exporting::declarationTexts(*file, sources.file(id).text());
  }

  [[nodiscard]] const stc::ast::PouDecl *pou(size_t index = 0) const {
    return static_cast<const stc::ast::PouDecl *>(file->declarations[index]);
  }
  [[nodiscard]] const DeclarationText &of(const stc::ast::Decl *decl) const {
    return texts.texts.at(decl);
  }

  stc::Sources sources;
  stc::Interner interner;
  stc::Arena arena;
  stc::Diagnostics diagnostics;
  stc::ast::File *file = nullptr;
  FileTexts texts;
};

TEST(DeclarationTexts, CutsABlockFromItsMembers) {
  const Cut cut("// about\n{attribute 'x'}\nFUNCTION_BLOCK A EXTENDS B // head\n"
                "VAR n : INT; (* END_VAR *) END_VAR // last\n"
                "n := 1; // one\n"
                "// of m\nMETHOD PRIVATE m : INT\nVAR_INPUT i : INT; END_VAR\nm := i;\n"
                "// end\nEND_METHOD // after m\n"
                "ACTION a: n := 2; END_ACTION\n// end of A\nEND_FUNCTION_BLOCK\n// rest\n");
  const DeclarationText &block = cut.of(cut.pou());
  EXPECT_EQ(block.leading, "// about\n{attribute 'x'}\n");
  EXPECT_EQ(block.declaration, "FUNCTION_BLOCK A EXTENDS B // head\n"
                               "VAR n : INT; (* END_VAR *) END_VAR // last");
  EXPECT_EQ(block.body, "\nn := 1; // one\n// end of A\n");
  EXPECT_EQ(block.tail, "\n// rest\n");
  const DeclarationText &method = cut.of(cut.pou()->methods.front());
  EXPECT_EQ(method.leading, "\n// of m\n");
  EXPECT_EQ(method.declaration, "METHOD PRIVATE m : INT\nVAR_INPUT i : INT; END_VAR");
  EXPECT_EQ(method.body, "\nm := i;\n// end\n // after m");
  const DeclarationText &action = cut.of(cut.pou()->actions.front());
  EXPECT_EQ(action.declaration, "ACTION a:");
  EXPECT_EQ(action.body, " n := 2; ");
  EXPECT_FALSE(cut.texts.onlyAsAWhole);
}

TEST(DeclarationTexts, KeepsSignsInTextsAndComments) {
  const Cut cut("FUNCTION f : STRING\nVAR s : STRING := 'END_VAR // $' (*'; END_VAR\n"
                "(* (* nested *) METHOD *) f := '(*'; f := \"{\" = \"}\" ;\nEND_FUNCTION\n");
  const DeclarationText &text = cut.of(cut.pou());
  EXPECT_EQ(text.declaration, "FUNCTION f : STRING\nVAR s : STRING := 'END_VAR // $' (*'; END_VAR");
  EXPECT_EQ(text.body, "\n(* (* nested *) METHOD *) f := '(*'; f := \"{\" = \"}\" ;\n");
}

/// Only `(*` nests, and only in `(*`.
TEST(DeclarationTexts, EndsCommentsWhereTheScannerDoes) {
  const Cut cut("(* files: lib/*.st *)\nPROGRAM A\nVAR n : INT; END_VAR\n"
                "/* one (* of /* two */ n := 7; // (* /*\nEND_PROGRAM\n"
                "(* */ (* *) *)\nPROGRAM B\nEND_PROGRAM\n");
  const DeclarationText &first = cut.of(cut.pou());
  EXPECT_EQ(first.leading, "(* files: lib/*.st *)\n");
  EXPECT_EQ(first.declaration, "PROGRAM A\nVAR n : INT; END_VAR");
  EXPECT_EQ(first.body, "\n/* one (* of /* two */ n := 7; // (* /*\n");
  EXPECT_EQ(cut.of(cut.pou(1)).leading, "\n(* */ (* *) *)\n");
  EXPECT_EQ(cut.of(cut.pou(1)).declaration, "PROGRAM B");
}

/// As the parser decides it: names of instructions are names of variables, too.
TEST(DeclarationTexts, KnowsInstructionLists) {
  using stc::exporting::isListBody;
  for (const char *list :
       {"LD a\nST b\n", "(*)*) ldn x // y\n", "{info 'x'}\nxorn b\n", "again: LD -1\n",
        "STN %QX0.0\n", "CALCN timer(IN := a)\n", "JMP again\n", "RETC\nLD a\n", "RET",
        "jmpcn over\nover: LD 3\n", "GE 5\n", "CAL\ttimer\n"})
    EXPECT_TRUE(isListBody(list)) << list;
  for (const char *statements :
       {"s := 1;\n", "r(IN := x);\n", "st.x := 2;\n", "ld[3] := 1;\n", "LD^ := 4;\n", "s S= x;\n",
        "(* LD a *)\nx := 1;\n", "(*) LD a *) x := 1;\n", "", "// LD a", "ret();\n", "JMP again;\n",
        "add := b;\n", "s (* of *) := 1;\n", "LDX a\n", "ld: s := 2;\n", "r\n:= 3;\n"})
    EXPECT_FALSE(isListBody(statements)) << statements;
}

TEST(DeclarationTexts, CutsTypesOfOneBlock) {
  const Cut cut("// first\nTYPE A : INT := 3; // of A\n  {attribute 'strict'}\n  E : (x, y);\n"
                "END_TYPE\nVAR_GLOBAL CONSTANT\n  k : INT := 4;\nEND_VAR\n");
  ASSERT_EQ(cut.file->declarations.size(), 3U);
  EXPECT_EQ(cut.of(cut.file->declarations[0]).leading, "// first\n ");
  EXPECT_EQ(cut.of(cut.file->declarations[0]).declaration, "A : INT := 3; // of A");
  EXPECT_EQ(cut.of(cut.file->declarations[1]).leading, "\n  {attribute 'strict'}\n  ");
  EXPECT_EQ(cut.of(cut.file->declarations[1]).declaration, "E : (x, y);");
  EXPECT_EQ(cut.of(cut.file->declarations[2]).declaration,
            "VAR_GLOBAL CONSTANT\n  k : INT := 4;\nEND_VAR");
}

TEST(DeclarationTexts, TakesTheOwnerOutOfAMembersHead) {
  const Cut cut("FUNCTION_BLOCK A\nEND_FUNCTION_BLOCK\n// way\n"
                "METHOD PUBLIC A . m : BOOL\nm := TRUE;\nEND_METHOD\n"
                "PROPERTY A.p : INT\nGET\np := 1;\nEND_GET\nSET PRIVATE\nEND_SET\nEND_PROPERTY\n");
  const stc::ast::PouDecl *block = cut.pou();
  EXPECT_EQ(cut.of(block->methods.front()).declaration, "METHOD PUBLIC  m : BOOL");
  EXPECT_EQ(cut.of(block->methods.front()).leading, "\n// way\n");
  const stc::ast::PropertyDecl *property = block->properties.front();
  EXPECT_EQ(cut.of(property).declaration, "PROPERTY p : INT");
  EXPECT_EQ(cut.of(property->get).declaration, "GET");
  EXPECT_EQ(cut.of(property->get).body, "\np := 1;\n");
  EXPECT_EQ(cut.of(property->set).body, " PRIVATE\n");
}

TEST(DeclarationTexts, SaysWhatOnlyTheWholeFileSays) {
  EXPECT_TRUE(Cut("{IF defined (x)}\nPROGRAM P\nEND_PROGRAM\n{END_IF}\n").texts.onlyAsAWhole);
  EXPECT_TRUE(
      Cut("NAMESPACE N\nFUNCTION f : INT\nEND_FUNCTION\nEND_NAMESPACE\n").texts.onlyAsAWhole);
  EXPECT_TRUE(Cut("PROGRAM P\nEND_PROGRAM\nVAR_CONFIG\n  P.x AT %IX0.0 : BOOL;\nEND_VAR\n")
                  .texts.onlyAsAWhole);
  EXPECT_TRUE(Cut("FUNCTION_BLOCK A\n").texts.onlyAsAWhole); // closed by the end of the file
  EXPECT_FALSE(Cut("PROGRAM P\n{warning 'if'}\nEND_PROGRAM\n").texts.onlyAsAWhole);
}

} // namespace
