// Finding code between comments, pragmas and texts.
#include "compiler/import/st_scan.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stc::import;

TEST(StScan, FindsTheFirstWord) {
  EXPECT_EQ(firstKeyword("(* a (* b *) c *) {attribute 'x}'} // d\n  function_Block X"),
            "FUNCTION_BLOCK");
  EXPECT_EQ(firstKeyword("/* a */PROGRAM"), "PROGRAM");
  EXPECT_EQ(firstKeyword("(* open"), "");
  EXPECT_EQ(firstKeyword("{open"), "");
  EXPECT_EQ(firstKeyword(""), "");
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
