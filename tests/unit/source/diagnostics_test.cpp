#include "compiler/source/diagnostic.hpp"

#include <gtest/gtest.h>

namespace stc {
namespace {

TEST(Diagnostics, CodesAreSortedUniqueAndExplained) {
  unsigned before = 0;
  for (const CodeInfo &code : allCodes()) {
    EXPECT_GT(static_cast<unsigned>(code.code), before);
    before = static_cast<unsigned>(code.code);
    EXPECT_FALSE(code.title.empty()) << codeName(code.code);
    EXPECT_NE(code.title.back(), '.') << codeName(code.code);
    EXPECT_GT(explainText(code.code).size(), 40U) << codeName(code.code);
    EXPECT_EQ(info(code.code).title, code.title);
  }
}

TEST(Diagnostics, NamesHaveFourDigits) {
  EXPECT_EQ(codeName(Code::UnreadableFile), "SE0101");
  EXPECT_EQ(codeName(static_cast<Code>(1234)), "SE1234");
}

TEST(Diagnostics, CountsBySeverity) {
  Diagnostics list;
  EXPECT_FALSE(list.hasErrors());
  list.report(Code::UnexpectedToken, {1, 3, 4}, "b");
  EXPECT_TRUE(list.hasErrors());
  EXPECT_EQ(list.errorCount(), 1U);
  EXPECT_EQ(list.warningCount(), 0U);
}

TEST(Diagnostics, SortsByPlaceAndDropsRepetitions) {
  Diagnostics list;
  list.report(Code::UnexpectedToken, {2, 0, 1}, "other file");
  list.report(Code::UnexpectedToken, {1, 9, 10}, "late").note("kept");
  list.report(Code::UnexpectedToken, {1, 3, 4}, "early");
  list.report(Code::UnexpectedToken, {1, 9, 10}, "late");
  list.report(Code::UnreadableFile, {}, "no place");
  list.sort();
  ASSERT_EQ(list.all().size(), 4U);
  EXPECT_EQ(list.all()[0].message, "no place");
  EXPECT_EQ(list.all()[1].message, "early");
  EXPECT_EQ(list.all()[2].message, "late");
  EXPECT_EQ(list.all()[2].notes.size(), 1U);
  EXPECT_EQ(list.all()[3].message, "other file");
  EXPECT_EQ(list.errorCount(), 4U);
}

} // namespace
} // namespace stc
