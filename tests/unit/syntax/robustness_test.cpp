#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace stc::test {
namespace {

std::string repeat(std::string_view text, size_t count) {
  std::string out;
  out.reserve(text.size() * count);
  for (size_t i = 0; i < count; ++i)
    out += text;
  return out;
}

std::string errors(const std::string &text) { return Parsed(text).errors(); }

TEST(Robustness, EmptyAndBlankFiles) {
  EXPECT_EQ(errors(""), "");
  EXPECT_EQ(errors("\n\n  \t // only this\n(* or this *)"), "");
  EXPECT_EQ(errors(repeat("\n", 1'000'000)), "");
  EXPECT_EQ(errors(repeat(";", 100'000)), "");
}

TEST(Robustness, BinaryFileIsOneError) {
  EXPECT_EQ(errors(std::string("PROGRAM P\0END", 13)), "SE0102 `T.st` is not a text file\n");
  std::string bytes;
  uint32_t random = 1;
  for (int i = 0; i < 100'000; ++i) {
    random = random * 1664525 + 1013904223;
    bytes += static_cast<char>((random >> 24) | 1);
  }
  EXPECT_EQ(errors(bytes), "SE0102 `T.st` is not a text file\n");
}

TEST(Robustness, StrangeCharactersAreFewErrors) {
  const Parsed parsed("PROGRAM P\n" + repeat("§ € ", 10'000) + "\nEND_PROGRAM");
  EXPECT_LE(parsed.diagnostics.errorCount(), 25U);
  EXPECT_EQ(errors("PROGRAM P\n" + repeat("§", 10'000) + "\nEND_PROGRAM"),
            "SE0103 2:1 this character has no meaning here\n");
}

TEST(Robustness, NestingLimit) {
  const auto parentheses = [](size_t n) {
    return "x := " + repeat("(", n) + "1" + repeat(")", n) + ";";
  };
  EXPECT_EQ(bodyErrors(parentheses(256)), "");
  EXPECT_EQ(bodyErrors(parentheses(257)), "SE0114 1:272 this statement is nested too deeply\n");
  EXPECT_EQ(bodyErrors("\n" + parentheses(100'000) + "\na b;"),
            "SE0114 2:262 this statement is nested too deeply\nSE0201 3:3 expected `:=` or `;`, "
            "found `b`\n");
  EXPECT_EQ(bodyErrors("\n" + repeat("IF a THEN ", 256) + repeat("END_IF ", 256)), "");
  EXPECT_EQ(bodyErrors("\n" + repeat("IF a THEN ", 10'000) + repeat("END_IF ", 10'000) + "\na b;"),
            "SE0114 2:2561 this statement is nested too deeply\nSE0201 3:3 expected `:=` or `;`, "
            "found `b`\n");
  EXPECT_EQ(errors("VAR_GLOBAL a : " + repeat("ARRAY[0..1] OF ", 10'000) + "INT; b INT; END_VAR"),
            "SE0114 1:3846 this declaration is nested too deeply\nSE0202 1:150022 expected `:` "
            "between name and type\n");
  EXPECT_EQ(errors("TYPE a : " + repeat("POINTER TO ", 10'000) + "INT; b : INT; END_TYPE"),
            "SE0114 1:2826 this declaration is nested too deeply\n");
  EXPECT_EQ(bodyErrors("\na" + repeat("^", 10'000) + " := 1;"),
            "SE0114 2:1026 too many accesses after one another\n");
}

TEST(Robustness, LongExpressions) {
  EXPECT_EQ(bodyErrors("x := " + repeat("a + ", 10'000) + "1;"), "");
  EXPECT_EQ(printExpression(repeat("NOT ", 10'001) + "a"), "(NOT a)");
  EXPECT_EQ(bodyErrors("x := " + repeat("- NOT ", 10'000) + "a;"),
            "SE0114 1:16 too many operators before one operand\n");
  EXPECT_EQ(bodyErrors("\nx := " + repeat("a + ", 100'000) + "1;"),
            "SE0117 2:6 this expression has 100001 operands\n");
}

TEST(Robustness, LongChains) {
  std::string text = "IF a = 0 THEN ";
  for (int i = 0; i < 10'000; ++i)
    text += "ELSIF a = " + std::to_string(i) + " THEN b := 1; ";
  EXPECT_EQ(bodyErrors(text + "END_IF"), "");
  std::string cases = "CASE a OF ";
  for (int i = 0; i < 10'000; ++i)
    cases += std::to_string(i) + ", c" + std::to_string(i) + ": b := 1; ";
  EXPECT_EQ(bodyErrors(cases + "END_CASE"), "");
}

TEST(Robustness, LongLines) {
  const Parsed parsed("PROGRAM P " + repeat("a:=a+1;", 500'000) + "a b;" +
                      repeat("a:=a+1;", 100'000) + " END_PROGRAM");
  EXPECT_EQ(parsed.errors(), "SE0201 1:3500013 expected `:=` or `;`, found `b`\n");
  EXPECT_LT(parsed.rendered().size(), 1000U);
  EXPECT_EQ(bodyErrors("\n" + std::string(1'000'000, 'a') + " := 1;"),
            "SE0118 2:1 this name has 1000000 characters\n");
}

TEST(Robustness, ErrorsAreLimited) {
  const Parsed parsed("PROGRAM P\n" + repeat("a b;\n", 100'000) + "END_PROGRAM");
  EXPECT_LE(parsed.diagnostics.errorCount(), 102U);
  const Parsed units(repeat("PROGRAM a\n", 10'000));
  EXPECT_LE(units.diagnostics.errorCount(), 102U);
}

TEST(Robustness, UnterminatedThings) {
  EXPECT_EQ(errors("PROGRAM P\n" + repeat("(* ", 100'000)), "SE0104 2:1 this comment has no end\n");
  EXPECT_EQ(errors("PROGRAM P\na := 'x\n" + repeat("b := 1;\n", 1000)),
            "SE0105 2:6 this string has no end\n");
}

/// The limit at it and above it, for each thing that nests.
TEST(Robustness, NestingLimitOfEachKind) {
  struct Kind {
    std::string name;
    std::string begin;
    std::string open;
    std::string middle;
    std::string close;
    std::string end;
    size_t most; ///< so many are accepted
  };
  const std::string body = "PROGRAM P\n";
  const Kind kinds[] = {
      {"parentheses", body + "x := ", "(", "1", ")", ";", 256},
      {"brackets", body + "x := a", "[a", "[1]", "]", ";", 255},
      {"calls", body + "x := ", "f(", "1", ")", ";", 256},
      {"IF", body, "IF a THEN ", "", "END_IF ", "", 256},
      {"CASE", body, "CASE a OF 1: ", "", "END_CASE ", "", 256},
      {"FOR", body, "FOR i := 0 TO 1 DO ", "", "END_FOR ", "", 256},
      {"WHILE", body, "WHILE a DO ", "", "END_WHILE ", "", 256},
      {"REPEAT", body, "REPEAT ", "", "UNTIL a END_REPEAT ", "", 256},
      {"TRY", body, "__TRY ", "", "__FINALLY __ENDTRY ", "", 256},
      {"arrays", "VAR_GLOBAL x : ", "ARRAY[0..1] OF ", "INT", "", "; END_VAR", 255},
      {"pointers", "VAR_GLOBAL x : ", "POINTER TO ", "INT", "", "; END_VAR", 256},
      {"references", "TYPE T : ", "REFERENCE TO ", "INT", "", "; END_TYPE", 256},
      {"initial values", "VAR_GLOBAL x : T := ", "[", "1", "]", "; END_VAR", 256},
      {"fields", "VAR_GLOBAL x : T := ", "(a := ", "1", ")", "; END_VAR", 256},
  };
  for (const Kind &kind : kinds) {
    for (const size_t count : {kind.most, kind.most + 1, size_t{50'000}}) {
      const std::string text = kind.begin + repeat(kind.open, count) + kind.middle +
                               repeat(kind.close, count) + kind.end;
      const std::string found = errors(text);
      if (count == kind.most) {
        EXPECT_EQ(found, "") << kind.name;
      } else {
        EXPECT_NE(found, "") << kind.name << ' ' << count;
        EXPECT_LT(found.size(), 20'000U) << kind.name << ' ' << count;
      }
    }
  }
}

/// What has no limit needs no stack.
TEST(Robustness, DeepThingsWithoutLimit) {
  const size_t count = 50'000;
  EXPECT_EQ(errors(repeat("(* ", count) + repeat("*) ", count)), "");
  EXPECT_EQ(errors(repeat("{IF defined (x)}\n", count) + repeat("{END_IF}\n", count)), "");
  EXPECT_EQ(errors("{IF " + repeat("NOT ", count) + "defined (x)}\n{END_IF}\n"), "");
  EXPECT_NE(
      errors("{IF " + repeat("(", count) + "defined (x)" + repeat(")", count) + "}\n{END_IF}\n"),
      "");
  EXPECT_EQ(bodyErrors(repeat("a := ", 1000) + "b;"), "");
  EXPECT_EQ(errors(repeat("NAMESPACE a ", 32) + repeat("END_NAMESPACE ", 32)), "");
  const Parsed spaces(repeat("NAMESPACE a ", count) + repeat("END_NAMESPACE ", count));
  EXPECT_GE(spaces.diagnostics.errorCount(), 1U);
  EXPECT_LE(spaces.diagnostics.errorCount(), 300U);
  const Parsed blocks(repeat("FUNCTION_BLOCK b METHOD m ", count));
  EXPECT_LE(blocks.diagnostics.errorCount(), 200U);
}

/// What the second, reporting run expects does not depend on where the first one gave up.
TEST(Robustness, KeywordsInPlaceOfNames) {
  EXPECT_EQ(errors("PROGRAM END_VAR:=i.()"),
            "SE0201 1:9 expected a name, found `END_VAR`\n"
            "SE0207 1:9 `END_VAR` is a keyword, it cannot be a name\n"
            "SE0201 1:20 expected the name of a member after the point, found `(`\n");
  EXPECT_NE(errors("PROGRAM END_VAR:=n.+;"), "");
  EXPECT_NE(errors("PROGRAM END_FOR [].\xC2\xAC+10"), "");
  EXPECT_NE(errors("FUNCTION_BLOCK B IMPLEMENTS IA,\nEND_FUNCTION_BLOCK"), "");
  EXPECT_NE(errors("INTERFACE B EXTENDS IA,\nEND_INTERFACE"), "");
}

/// Every prefix of a text, and the text without any one of its tokens, is read without a crash.
TEST(Robustness, CutTexts) {
  const std::string text =
      "/// doc\n{attribute 'x'}\nTYPE E : (a, b := 5) BYTE; S : STRUCT p : INT := 3; END_STRUCT "
      "END_TYPE\n"
      "FUNCTION F : STRING(8) VAR_INPUT x, y AT %I* : ARRAY[0..2] OF POINTER TO INT := [1, 2(0)]; "
      "END_VAR\nIF a THEN b := f(1, c := 2, d => e)[1].g^; ELSIF NOT x = 'a$'b' THEN ; ELSE EXIT; "
      "END_IF\n"
      "CASE a OF 1, 2..3: b S= TRUE; E.a: CONTINUE; ELSE RETURN; END_CASE; FOR i := 0 TO 9 BY 2 DO "
      "WHILE a "
      "DO REPEAT x := T#5s; UNTIL TRUE END_REPEAT END_WHILE END_FOR END_FUNCTION\n";
  ASSERT_EQ(errors(text), "");
  for (size_t i = 0; i < text.size(); ++i) {
    const Parsed prefix(text.substr(0, i));
    const Parsed without(text.substr(0, i) + text.substr(i + 1));
    const Parsed suffix(text.substr(i));
    EXPECT_LE(prefix.diagnostics.errorCount(), 8U) << text.substr(0, i);
    EXPECT_LE(without.diagnostics.errorCount(), 12U) << without.rendered();
    EXPECT_LE(suffix.diagnostics.errorCount(), 30U) << suffix.rendered();
    EXPECT_FALSE(prefix.rendered().size() > 100'000);
  }
}

} // namespace
} // namespace stc::test
