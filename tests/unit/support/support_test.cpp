// The tests' own tools: a golden test is worth no more than its comparison.
#include "tests/support/csv_compare.hpp"
#include "tests/support/expectation_block.hpp"
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ExpectationBlock, SeparatesTheTrailingBlockAndItsEmptyLine) {
  const GoldenText text = splitExpectation("x := 1;\n\n//! a = 1\n//!\n//!   b\n");
  EXPECT_EQ(text.source, "x := 1;\n");
  EXPECT_EQ(text.expected, "a = 1\n\n  b\n");
}

TEST(ExpectationBlock, LeavesMarkersInsideTheSourceAlone) {
  const std::string file = "//! not at the end\nx := 1;\n";
  EXPECT_EQ(splitExpectation(file).source, file);
  EXPECT_EQ(splitExpectation(file).expected, "");
}

TEST(ExpectationBlock, AllowsAnEmptySource) {
  const GoldenText text = splitExpectation("//! error\n");
  EXPECT_EQ(text.source, "");
  EXPECT_EQ(text.expected, "error\n");
}

TEST(ExpectationBlock, JoiningIsStable) {
  for (const std::string source : {"", "x;\n", "x;\n\n", "(* open"}) {
    const std::string file = joinExpectation(source, "one\n\n two  \n\n");
    const GoldenText text = splitExpectation(file);
    EXPECT_EQ(text.expected, "one\n\n two\n");
    EXPECT_EQ(joinExpectation(text.source, text.expected), file);
    EXPECT_TRUE(text.source.starts_with(source));
  }
  EXPECT_EQ(joinExpectation("x;\n", ""), "x;\n");
}

TEST(ExpectationBlock, ReadsDirectivesAtTheTopOnly) {
  const std::string source = "// A test.\n// RUN: --for T#1s \nPROGRAM P\n// EXIT: 3\n";
  EXPECT_EQ(directive(source, "RUN"), "--for T#1s");
  EXPECT_EQ(directive(source, "EXIT"), "");
}

TEST(Text, SplitsWordsWithQuotes) {
  EXPECT_THAT(splitWords(" a 'b c' d\"e f\" '' "), ElementsAre("a", "b c", "de f", ""));
}

TEST(Text, DiffShowsOnlyWhatChanged) {
  EXPECT_EQ(diff("a\nb \n\n", "a\nb"), "");
  EXPECT_EQ(diff("a\nb\nc\n", "a\nx\nc\n"), "  a\n- b\n+ x\n  c\n");
  EXPECT_EQ(diff("", "x\n"), "+ x\n");
  EXPECT_EQ(diff("1\n2\n3\n4\n5\n6\n", "1\n2\n3\n4\n5\n6\n7\n"), "  ...\n  4\n  5\n  6\n+ 7\n");
}

TEST(Csv, ComparesNumbersWithinTheColumnsTolerance) {
  const CsvTolerance tolerance{{{"s", 1e-3}}, -1};
  EXPECT_EQ(compareCsv("t,s\n0,1.0\n", "t,s\n0,1.0005\n", tolerance), "");
  EXPECT_EQ(compareCsv("t,s\n0,1\n", "t,s\n0,1.1\n", tolerance),
            "line 2 (0), s: expected 1, got 1.1\n");
  EXPECT_THAT(compareCsv("t,s\n0,1\n", "t,s\n0.0,1\n", tolerance), HasSubstr("t: expected 0"));
  EXPECT_THAT(compareCsv("t,s\n0,1\n", "t,s\n0,nan\n", tolerance), HasSubstr("got nan"));
  EXPECT_THAT(compareCsv("t,s\n0,1\n", "t,s\n", tolerance), HasSubstr("expected 1 rows, got 0"));
  EXPECT_THAT(compareCsv("t,s\n0,1\n", "t,v\n0,1\n", tolerance), HasSubstr("+ t,v"));
}

TEST(Csv, SamplesRows) { EXPECT_EQ(sampleRows("t\n0\n1\n2\n3\n4\n", 2), "t\n0\n2\n4\n"); }

TEST(Process, CatchesOutputAndExitCode) {
  const ScratchDirectory scratch;
  const ProcessResult result = runProcess({"sh", "-c", "echo $GREETING; pwd >&2; exit 3"},
                                          scratch.path(), {{"GREETING", "hello"}});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.out, "hello\n");
  EXPECT_EQ(result.err, scratch.path().string() + "\n");
  EXPECT_EQ(runProcess({"sh", "-c", "kill -9 $$"}, scratch.path()).exitCode, 128 + 9);
  EXPECT_THROW(runProcess({"/nonexistent"}, scratch.path()), std::runtime_error);
}

} // namespace
} // namespace stride::test
