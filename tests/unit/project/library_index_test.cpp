#include "compiler/project/library_index.hpp"

#include <algorithm>
#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

namespace stc {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Kind = LibraryIndex::Kind;

MATCHER_P(Named, text, "") { return arg.text == text; }

constexpr EmbeddedFile kFiles[] = {{"A", "<stdlib>/A/x.st", "x"},
                                   {"A", "<stdlib>/A/y.st", "y"},
                                   {"B", "<stdlib>/B/x.st", "x of B"}};
constexpr EmbeddedName kNames[] = {{"x", "X", 0, Kind::Type},
                                   {"x", "x", 2, Kind::Type},
                                   {"x", "x", 0, Kind::Enumerator},
                                   {"y", "y", 0, Kind::Variable}};

TEST(LibraryIndexTables, FindOneFilePerLibraryInOrder) {
  const EmbeddedLibraryIndex index({kFiles, kNames});
  const std::vector<LibraryIndex::Entry> entries = index.find("x");
  ASSERT_THAT(entries, SizeIs(2));
  EXPECT_EQ(entries[0].library, "A");
  EXPECT_EQ(entries[1].text, "x of B");
  EXPECT_THAT(index.find("z"), IsEmpty());
  EXPECT_TRUE(index.isLibrary("b"));
  EXPECT_FALSE(index.isLibrary("c"));
  EXPECT_THAT(index.names(), ::testing::ElementsAre(Named("X"), Named("y")));
  EXPECT_THAT(index.files("A"), SizeIs(2));
  EXPECT_THAT(index.libraries(), ::testing::ElementsAre("A", "B"));
}

TEST(StandardLibrary, KnowsItsDeclarations) {
  const EmbeddedLibraryIndex index(standardLibrary());
  ASSERT_THAT(index.find("mc_power"), SizeIs(2)); // also Tc2_MC2's, by its library's name only
  EXPECT_EQ(index.find("mc_power")[0].library, "SM_PLCopen");
  EXPECT_EQ(index.find("mc_power")[0].fileName, "<stdlib>/SM_PLCopen/MC_Power.st");
  EXPECT_FALSE(index.find("mc_power")[0].qualifiedOnly);
  EXPECT_EQ(index.find("mc_power")[1].library, "Tc2_MC2");
  EXPECT_TRUE(index.find("mc_power")[1].qualifiedOnly);
  EXPECT_THAT(std::string(index.find("axis_ref")[0].text), HasSubstr("fSetPosition"));
  EXPECT_THAT(index.find("g_strbootuperror"), SizeIs(1)); // a global variable
  EXPECT_THAT(index.find("smc_no_error"), SizeIs(1));     // an enumerator
  EXPECT_THAT(index.find("fsetposition"), IsEmpty());     // a member is not global
  EXPECT_THAT(index.names(), Contains(Named("TON")));
  EXPECT_TRUE(index.isLibrary("standard"));
}

TEST(StandardLibrary, TablesAreSorted) {
  const EmbeddedTables tables = standardLibrary();
  EXPECT_TRUE(std::is_sorted(
      tables.names.begin(), tables.names.end(),
      [](const EmbeddedName &a, const EmbeddedName &b) { return a.lower < b.lower; }));
}

} // namespace
} // namespace stc
