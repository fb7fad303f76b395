// Finding code between comments, pragmas and texts, and making texts for it.
#include "compiler/import/texts.hpp"
#include "compiler/source/st_scan.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stc;
using namespace stc::import;

TEST(StScan, FindsTheFirstWord) {
  EXPECT_EQ(firstKeyword("(* a (* b *) c *) {attribute 'x}'} // d\n  function_Block X"),
            "FUNCTION_BLOCK");
  EXPECT_EQ(firstKeyword("/* a */PROGRAM"), "PROGRAM");
  EXPECT_EQ(firstKeyword("(* open"), "");
  EXPECT_EQ(firstKeyword("{open"), "");
  EXPECT_EQ(firstKeyword(""), "");
}

/// As the compiler reads them: `(*` nests in `(*` only.
TEST(StScan, NestsOneKindOfComments) {
  EXPECT_EQ(firstKeyword("/* a /* b */ FUNCTION"), "FUNCTION");
  EXPECT_EQ(firstKeyword("/* a (* b */ FUNCTION"), "FUNCTION");
  EXPECT_EQ(firstKeyword("(* a /* b *) FUNCTION"), "FUNCTION");
  EXPECT_EQ(firstKeyword("(* a // b *) FUNCTION"), "FUNCTION");
  EXPECT_EQ(firstKeyword("(* a (* b *) FUNCTION"), "");
  EXPECT_EQ(commentEnd("x // a", 2), 6U);
  EXPECT_EQ(commentEnd("{a}", 0), 0U);
}

TEST(StScan, EndsPragmasAsTheCompilerDoes) {
  EXPECT_EQ(afterPragma("{a 'b}' c} d", 0), 10U);
  EXPECT_EQ(afterPragma("{it's} d", 0), 6U);
  EXPECT_EQ(afterPragma("{it's\n'} d", 0), 8U);
  EXPECT_EQ(afterPragma("{it's} x := 'a';", 0), 6U);
  EXPECT_EQ(afterPragma("{region L'axe d'en bas} x := 'a';", 0), 23U);
  EXPECT_EQ(afterPragma("{warning '5$'} x := 'a';", 0), 14U);
  EXPECT_EQ(afterPragma("{text \"it's}\"} d", 0), 14U);
  EXPECT_EQ(afterPragma("{a := 'b}' 'c}'} d", 0), 16U);
  EXPECT_EQ(afterPragma("{open", 0), 5U);
  EXPECT_EQ(afterPragma("a", 0), 0U);
}

TEST(StScan, CutsCodeIntoWords) {
  const std::string_view text = "/* /* */ a1 := 16#FF + b(*x*)%IX0.3 'y z' {w} // v";
  std::string words;
  for (const StWord &each : wordsOf(text))
    words += std::string(text.substr(each.begin, each.end - each.begin)) + "|";
  EXPECT_EQ(words, "a1|:|=|16#FF|+|b|%IX0.3|");
}

TEST(StScan, FindsTheWordsAfterAnApostropheInAPragma) {
  const std::string_view text = "{region it's here}\na := 'b'; {it's} c := 'd {e}';";
  std::string words;
  for (const StWord &each : wordsOf(text))
    words += std::string(text.substr(each.begin, each.end - each.begin)) + "|";
  EXPECT_EQ(words, "a|:|=|;|c|:|=|;|");
}

TEST(StScan, StepsOverTexts) {
  EXPECT_EQ(afterString("'a$'b' c", 0), 6U);
  EXPECT_EQ(afterString("\"a'b\" c", 0), 5U);
  EXPECT_EQ(afterString("'open", 0), 5U);
  EXPECT_EQ(afterString("'open$", 0), 6U);
  EXPECT_EQ(afterString("x", 0), 0U);
  EXPECT_EQ(afterString("", 0), 0U);
}

TEST(StScan, MakesIdentifiers) {
  EXPECT_EQ(asIdentifier("Axis 1"), "Axis_1");
  EXPECT_EQ(asIdentifier("1st  axis!"), "_1st_axis");
  EXPECT_EQ(asIdentifier("a__b"), "a_b");
  EXPECT_EQ(asIdentifier("x "), "x");
  EXPECT_EQ(asIdentifier(""), "_");
  EXPECT_EQ(asIdentifier("_"), "_");
}

TEST(StScan, ReadsPaths) {
  EXPECT_EQ(stemOf("a\\b.c\\Feed.1.xti"), "Feed.1");
  EXPECT_EQ(stemOf("Feed"), "Feed");
  EXPECT_EQ(withSlashes("a\\b/c"), "a/b/c");
  EXPECT_EQ(quotedForSt("it's $5\n"), "it$'s $$5 ");
}

} // namespace
