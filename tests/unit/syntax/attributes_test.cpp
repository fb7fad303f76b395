// The tables of attributes and pragmas: names, and what the documentation says of them.
#include "compiler/syntax/attributes.hpp"
#include "compiler/syntax/pragmas.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace stc {
namespace {

using ast::AttributeId;

std::string page(const std::string &name) {
  std::ifstream in(std::string(STRIDE_SOURCE_DIR "/docs/") + name);
  EXPECT_TRUE(in) << name;
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Attributes, AreFoundByTheirNamesWhateverTheirCase) {
  for (size_t i = 0; i < attributeRows().size(); ++i) {
    const auto id = static_cast<AttributeId>(i + 1);
    EXPECT_EQ(findAttribute(attributeRows()[i].name), id);
    EXPECT_EQ(&attributeRow(id), &attributeRows()[i]);
  }
  EXPECT_EQ(findAttribute("qualified_only"), AttributeId::QualifiedOnly); // the first
  EXPECT_EQ(findAttribute("Pack_MODE"), AttributeId::PackMode);
  EXPECT_EQ(findAttribute("program instance"), AttributeId::ProgramInstance); // the last
  EXPECT_EQ(findAttribute("qualified"), AttributeId::Unknown);
  EXPECT_EQ(findAttribute("qualified_only "), AttributeId::Unknown);
  EXPECT_EQ(findAttribute(""), AttributeId::Unknown);
}

TEST(Attributes, TheFirstOfAKindCounts) {
  const ast::Attribute list[] = {{AttributeId::Unknown, "x", "0", {}},
                                 {AttributeId::RenamedFrom, "renamed_from", "A", {}},
                                 {AttributeId::RenamedFrom, "renamed_from", "B", {}}};
  EXPECT_EQ(attributeOf(list, AttributeId::RenamedFrom), &list[1]);
  EXPECT_EQ(attributeValue(list, AttributeId::RenamedFrom), "A");
  EXPECT_TRUE(hasAttribute(list, AttributeId::RenamedFrom));
  EXPECT_FALSE(hasAttribute(list, AttributeId::Hide));
  EXPECT_EQ(attributeValue(list, AttributeId::Hide), "");
}

TEST(Attributes, AreDocumented) {
  const std::string pages[] = {page("language.md"), page("testing.md"),
                               page("developers/contributing.md")};
  for (const AttributeRow &row : attributeRows()) {
    std::string line = "| `{attribute '" + std::string(row.name) + "'";
    if (!row.example.empty())
      line += " := '" + std::string(row.example) + "'";
    line += "}` | " + std::string(row.before) + " | " + std::string(row.text) + " |\n";
    EXPECT_NE(pages[static_cast<size_t>(row.audience)].find(line), std::string::npos) << "lacks\n"
                                                                                      << line;
  }
}

TEST(Pragmas, AreFoundByTheirWordsWhateverTheirCase) {
  for (size_t i = 0; i < pragmaRows().size(); ++i)
    EXPECT_EQ(findPragma(pragmaRows()[i].word), static_cast<PragmaWord>(i + 1));
  EXPECT_EQ(findPragma("attribute"), PragmaWord::Attribute); // the first
  EXPECT_EQ(findPragma("End_If"), PragmaWord::EndIf);
  EXPECT_EQ(findPragma("EXTERNAL"), PragmaWord::External); // the last
  EXPECT_EQ(findPragma("region"), PragmaWord::None);
  EXPECT_EQ(findPragma(""), PragmaWord::None);
}

TEST(Pragmas, AreDocumented) {
  const std::string language = page("language.md");
  for (const PragmaRow &row : pragmaRows()) {
    if (row.text.empty())
      continue;
    const std::string line =
        "| " + std::string(row.example) + " | " + std::string(row.text) + " |\n";
    EXPECT_NE(language.find(line), std::string::npos) << "lacks\n" << line;
  }
}

} // namespace
} // namespace stc
