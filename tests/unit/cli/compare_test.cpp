// Comparing traces with what is expected.
#include "compiler/plot/compare.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stc::plot {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view kTrace = "t,Main.x,Main.n,Main.bRun\n"
                                    "0,0.5,7,0\n"
                                    "0.003,0.75,8,1\n"
                                    "0.006,1,9,1\n";

TraceDifference with(std::string_view from, std::string_view to, double tolerance = 0) {
  std::string actual(kTrace);
  const size_t at = actual.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  actual.replace(at, from.size(), to);
  return compareTraces(kTrace, actual, tolerance);
}

TEST(CompareTraces, FindsNothingInTheSame) {
  const TraceDifference difference = compareTraces(kTrace, kTrace, 0);
  EXPECT_TRUE(difference.none());
  EXPECT_EQ(difference.rows, 3U);
  EXPECT_EQ(describe(difference), "");
}

TEST(CompareTraces, TakesWhatEditorsDoToFiles) {
  const std::string expected = "\xEF\xBB\xBF\"t\", Main.bRun ,Main.x,Main.n\r\n"
                               "0,0,0.5,7\r\n\r\n0.003000,1,0.75,8\r\n0.006,1,1.0,9\r\n";
  EXPECT_TRUE(compareTraces(expected, kTrace, 0).none())
      << describe(compareTraces(expected, kTrace, 0));
}

TEST(CompareTraces, NamesTheFirstPlaceAndTheGreatestDifference) {
  const TraceDifference difference = compareTraces("t,a,b\n0,1,0\n1,2,0\n2,3,0\n3,4,0\n",
                                                   "t,a,b\n0,1,0\n1,2.5,0\n2,0,0\n3,3.5,0\n", 0.25);
  EXPECT_EQ(describe(difference),
            "`a` at 1 s: expected 2, is 2.5; 3 of 4 rows differ, by 3 at most (at 2 s)");
  ASSERT_EQ(difference.columns.size(), 1U);
  EXPECT_EQ(difference.columns[0].rows, 3U);
}

TEST(CompareTraces, KeepsTheTolerance) {
  EXPECT_TRUE(with("0.75", "0.7578125", 0.0078125).none()); // at it
  EXPECT_TRUE(with("0.75", "0.7421875", 0.0078125).none());
  EXPECT_FALSE(with("0.75", "0.7578125", 0.0078).none()); // below what differs
  EXPECT_TRUE(with("0.75", "0.7578125", 0.0079).none());
  EXPECT_FALSE(with("0.75", "0.7500000000000001").none());
  EXPECT_TRUE(with("8,1", "9,1", 1).none()); // whole numbers, too
  EXPECT_FALSE(with("8,1", "9,1", 0.5).none());
}

TEST(CompareTraces, TellsLargeNumbersApart) {
  const auto column = [](std::string_view value) { return "t,n\n0," + std::string(value) + "\n"; };
  EXPECT_FALSE(
      compareTraces(column("9223372036854775807"), column("9223372036854775806"), 0).none());
  EXPECT_TRUE(
      compareTraces(column("9223372036854775807"), column("9223372036854775806"), 1).none());
  EXPECT_TRUE(compareTraces(column("1e3"), column("1000"), 0).none());
}

TEST(CompareTraces, ComparesWhatIsNoNumberAsText) {
  EXPECT_FALSE(with("0.75", "NaN", 1e9).none());
  EXPECT_TRUE(compareTraces("t,x\n0,NaN\n", "t,x\n0,NaN\n", 0).none());
  EXPECT_EQ(describe(compareTraces("t,s\n0,'ab'\n", "t,s\n0,'ac'\n", 1)),
            "`s` at 0 s: expected 'ab', is 'ac'");
  EXPECT_EQ(describe(compareTraces("t,x\n0,1\n", "t,x\n0,\n", 1)),
            "`x` at 0 s: expected 1, is nothing");
}

TEST(CompareTraces, SaysWhatRowsAreMissingOrTooMany) {
  EXPECT_EQ(describe(with("0.006,1,9,1\n", "")),
            "the trace ends after 0.003 s, a row at 0.006 s is expected");
  EXPECT_EQ(describe(with("0.006,1,9,1\n", "0.006,1,9,1\n0.009,2,3,0\n")),
            "the trace has a row at 0.009 s, none is expected after 0.006 s");
  EXPECT_EQ(describe(with("0.003,", "0.004,")),
            "the trace has a row at 0.004 s, where one at 0.003 s is expected");
  EXPECT_EQ(describe(compareTraces("t,a\n", "t,a\n0,1\n", 0)),
            "the trace has a row at 0 s, none is expected after the beginning");
  EXPECT_TRUE(compareTraces("t,a\n", "t,a\n", 0).none());
}

TEST(CompareTraces, SaysWhatColumnsAreMissingOrTooMany) {
  EXPECT_EQ(describe(with("Main.x", "Main.y")), "the trace does not have `Main.x`");
  EXPECT_EQ(describe(with("Main.bRun", "Main.bRun,Main.m")),
            "`Main.m` of the trace is not expected");
  EXPECT_THAT(describe(compareTraces("", kTrace, 0)), HasSubstr("must begin with `t`"));
  EXPECT_THAT(describe(compareTraces("a,b\n1,2\n", kTrace, 0)), HasSubstr("must begin with `t`"));
  EXPECT_EQ(describe(compareTraces("t,a,b\n0,1\n", "t,a,b\n0,1,2\n", 0)),
            "what is expected has a row of 2 values after the beginning instead of 3");
}

TEST(CompareTraces, ShowsTenColumns) {
  std::string names = "t";
  std::string zeros = "0";
  std::string ones = "0";
  for (int i = 0; i < 12; ++i) {
    names += ",c" + std::to_string(i);
    zeros += ",0";
    ones += ",1";
  }
  const std::string text =
      describe(compareTraces(names + "\n" + zeros + "\n", names + "\n" + ones + "\n", 0));
  EXPECT_THAT(text, HasSubstr("`c9` at 0 s"));
  EXPECT_THAT(text, HasSubstr("\n… and 2 more columns"));
}

TEST(RowsAt, KeepsMultiples) {
  constexpr std::string_view kRows = "t,a\n0,1\n0.003,2\n0.006,3\n0.0075,4\n1.5,5\n";
  EXPECT_EQ(rowsAt(kRows, 6'000'000), "t,a\n0,1\n0.006,3\n1.5,5\n");
  EXPECT_EQ(rowsAt(kRows, 1'500'000), "t,a\n0,1\n0.003,2\n0.006,3\n0.0075,4\n1.5,5\n");
  EXPECT_EQ(rowsAt(kRows, 0), kRows);
  EXPECT_EQ(rowsAt("t,a\n18446744073709551616,1\n-1,2\n", 1), "t,a\n-1,2\n");
}

} // namespace
} // namespace stc::plot
