// What the reference says of declarations, and how HTML says it.
#include "compiler/doc/html.hpp"
#include "compiler/semantics/builtins.hpp"
#include "compiler/syntax/parser.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace stc::doc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class Reference : public ::testing::Test {
protected:
  Module describeText(const std::string &text) {
    const FileId id = sources_.add("Plant.st", text);
    const ast::File *file = parse(sources_.file(id), interner_, arena_, diagnostics_);
    EXPECT_FALSE(diagnostics_.hasErrors());
    const ast::File *const files[] = {file};
    return describe("Plant", files, sources_);
  }

  static std::vector<std::string> names(const Group &group) {
    std::vector<std::string> result;
    for (const Member &member : group.members)
      result.push_back(member.name);
    return result;
  }

  Sources sources_;
  Interner interner_;
  Arena arena_;
  Diagnostics diagnostics_;
};

TEST_F(Reference, ShowsWhatOthersUse) {
  const Module module = describeText(R"st(/// Fills a tank. Stops at the top.
FUNCTION_BLOCK Filler EXTENDS Base
VAR_INPUT
  /// Start. [bool]
  run : BOOL;
  {attribute 'hide'} secret : INT;
END_VAR
VAR_IN_OUT tank : Tank; END_VAR
VAR_INPUT rate : LREAL := 2.5; END_VAR
VAR_OUTPUT full : BOOL; END_VAR
VAR inner : INT; END_VAR
/// Empties it.
METHOD PUBLIC Drain : BOOL
VAR_INPUT fast : BOOL; END_VAR
END_METHOD
METHOD PRIVATE Helper END_METHOD
PROPERTY Level : LREAL GET END_GET END_PROPERTY
END_FUNCTION_BLOCK
{attribute 'hide'}
FUNCTION Internal : INT END_FUNCTION
TYPE Tank : STRUCT height : LREAL; END_STRUCT END_TYPE
TYPE Mode : (idle, /// Runs.
  running := 5) BYTE; END_TYPE
VAR_GLOBAL CONSTANT kMax : INT := 3; END_VAR
)st");
  ASSERT_EQ(module.entries.size(), 4U);
  const Entry &filler = module.entries[0];
  EXPECT_EQ(filler.kind, "Function block");
  EXPECT_EQ(filler.name, "Filler");
  EXPECT_EQ(filler.suffix, "EXTENDS Base");
  EXPECT_EQ(firstSentence(filler.text), "Fills a tank.");
  ASSERT_EQ(filler.groups.size(), 3U);
  EXPECT_EQ(filler.groups[0].title, "Inputs");
  EXPECT_THAT(names(filler.groups[0]), ElementsAre("run", "rate"));
  EXPECT_EQ(filler.groups[0].members[0].text, "Start. [bool]");
  EXPECT_EQ(filler.groups[0].members[1].init, "2.5");
  EXPECT_THAT(names(filler.groups[1]), ElementsAre("tank"));
  EXPECT_THAT(names(filler.groups[2]), ElementsAre("full"));
  ASSERT_EQ(filler.parts.size(), 2U);
  EXPECT_EQ(filler.parts[0].name, "Filler.Drain");
  EXPECT_EQ(filler.parts[0].suffix, ": BOOL");
  EXPECT_EQ(filler.parts[1].suffix, ": LREAL (read only)");
  EXPECT_EQ(module.entries[1].name, "Mode");
  EXPECT_EQ(module.entries[1].groups[0].members[1].init, "5");
  EXPECT_EQ(module.entries[2].name, "Plant");
  EXPECT_EQ(module.entries[2].kind, "Global variables");
  EXPECT_EQ(module.entries[3].name, "Tank");
}

TEST_F(Reference, HtmlEscapesAndLinks) {
  const Module module =
      describeText("/// True if a < b & c. See Tank.\n"
                   "FUNCTION Less : BOOL VAR_INPUT t : Tank; END_VAR "
                   "END_FUNCTION\n"
                   "TYPE Tank : STRUCT x : STRING := 'a\"<b'; END_STRUCT END_TYPE\n");
  for (const Page &page : htmlPages("A & B", {module})) {
    if (page.path != "Plant.html")
      continue;
    EXPECT_THAT(page.text, HasSubstr("True if a &lt; b &amp; c. See <a href=\"Plant.html#Tank\">"));
    EXPECT_THAT(page.text, HasSubstr("'a&quot;&lt;b'"));
    EXPECT_THAT(page.text, HasSubstr("A &amp; B"));
    EXPECT_THAT(page.text, Not(HasSubstr("A & B")));
  }
}

size_t occurrences(const std::string &text, const std::string &part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST_F(Reference, NamespacesAndEqualNames) {
  const Module module = describeText("FUNCTION_BLOCK Blk END_FUNCTION_BLOCK\n"
                                     "NAMESPACE N1 FUNCTION Blk : INT END_FUNCTION END_NAMESPACE\n"
                                     "PROGRAM Plant END_PROGRAM\n"
                                     "VAR_GLOBAL g : INT; END_VAR\n");
  ASSERT_EQ(module.entries.size(), 4U);
  EXPECT_EQ(module.entries[0].name, "Blk");
  EXPECT_EQ(module.entries[1].name, "N1.Blk");
  EXPECT_EQ(module.entries[2].name, "Plant");
  EXPECT_EQ(module.entries[3].name, "Plant");
  for (const Page &page : htmlPages("Plant", {module})) {
    if (page.path != "Plant.html")
      continue;
    EXPECT_EQ(occurrences(page.text, "id=\"Plant\""), 1U);
    EXPECT_EQ(occurrences(page.text, "id=\"Plant-2\""), 1U);
    EXPECT_EQ(occurrences(page.text, "id=\"N1.Blk\""), 1U);
  }
}

TEST_F(Reference, ShowsFigures) {
  Module module = describeText("/// Opens.\nFUNCTION_BLOCK Valve END_FUNCTION_BLOCK\n"
                               "FUNCTION_BLOCK Pump END_FUNCTION_BLOCK\n");
  for (Entry &entry : module.entries)
    if (entry.name == "Valve") {
      entry.figure = "figures/Plant/Valve.svg";
      entry.caption = "Opens within 2.5 s. Then a Pump starts.";
    }
  for (const Page &page : htmlPages("Plant", {module})) {
    EXPECT_EQ(occurrences(page.text, "<figure>"), page.path == "Plant.html" ? 1U : 0U);
    if (page.path == "Plant.html") {
      EXPECT_THAT(page.text, HasSubstr("<img src=\"figures/Plant/Valve.svg\" alt=\"Opens within "
                                       "2.5 s.\" loading=\"lazy\">"));
      EXPECT_THAT(page.text,
                  HasSubstr("<figcaption>Opens within 2.5 s. Then a <a href=\"Plant.html#"
                            "Pump\">Pump</a> starts.</figcaption>"));
    }
  }
}

TEST_F(Reference, TheSearchKnowsPins) {
  const Module module = describeText("/// Opens. Slowly.\nFUNCTION_BLOCK Valve VAR_INPUT\n"
                                     "/// Rising edge.\nbEnable : BOOL; END_VAR "
                                     "END_FUNCTION_BLOCK\n");
  for (const Page &page : htmlPages("Plant", {module})) {
    if (page.path == "search.js") {
      EXPECT_THAT(page.text, HasSubstr("[\"Valve\",\"Plant.html#Valve\",\"Plant, Function block\","
                                       "\"Opens.\",\" Slowly. bEnable Rising edge.\"]"));
    }
  }
}

TEST(Builtins, TheSearchKnowsEveryConversion) {
  for (const Page &page : htmlPages("All", {builtinFunctions()})) {
    if (page.path == "search.js") {
      for (const char *name : {"REAL_TO_INT", "DT_TO_DATE", "TO_WSTRING", "TRUNC_INT",
                               "BCD_TO_UINT", "TO_BCD_BYTE", "WCHAR_TO_CHAR"})
        EXPECT_THAT(page.text,
                    HasSubstr(std::string("[\"") + name + "\",\"Operators.html#TO_INT\""));
    }
  }
}

// Every function of the compiler is described, and nothing else.
TEST(Builtins, AllHaveTexts) {
  std::set<std::string> described;
  for (const Entry &entry : builtinFunctions().entries) {
    EXPECT_FALSE(entry.text.empty()) << entry.name;
    EXPECT_TRUE(described.insert(entry.name).second) << entry.name << " is described twice";
  }
  std::set<std::string> known{"TO_INT"};
  for (const BuiltinName &one : builtinNames())
    known.emplace(one.name);
  EXPECT_EQ(described, known);
}

} // namespace
} // namespace stc::doc
