// Which reader reads which file.
#include "compiler/import/reader.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stc::import {
namespace {

using testing::HasSubstr;

TEST(Reader, findsAnExportByItsNameAndByItsContent) {
  const FormatChoice byName = formatOf("plant/Pump.EXP", "FUNCTION F : INT\n");
  ASSERT_NE(byName.format, nullptr);
  EXPECT_EQ(byName.format->name, "CoDeSys V2.3 export");
  const FormatChoice byContent = formatOf("plant/Pump.txt", "\n(* @NESTEDCOMMENTS := 'Yes' *)\n");
  EXPECT_EQ(byContent.format, byName.format);
}

TEST(Reader, refusesBinaryProjectsWithAWayOut) {
  const FormatChoice old = formatOf("a/Press.pro", std::string_view("CoDeSys+\0\1", 10));
  EXPECT_EQ(old.format, nullptr);
  EXPECT_TRUE(old.known);
  EXPECT_THAT(old.refusal, HasSubstr("Project > Export"));
  EXPECT_THAT(formatOf("Press.PROJECT", "PK\3\4").refusal, HasSubstr("PLCopenXML"));
}

TEST(Reader, refusesWhatNobodyKnows) {
  const FormatChoice other = formatOf("notes.txt", "(* no export *)");
  EXPECT_EQ(other.format, nullptr);
  EXPECT_FALSE(other.known);
  EXPECT_THAT(other.refusal, HasSubstr("CoDeSys V2.3 export (.exp)"));
  EXPECT_FALSE(hasKnownExtension("notes.exp.txt"));
  EXPECT_TRUE(hasKnownExtension("folder.txt/notes.eXp"));
}

} // namespace
} // namespace stc::import
