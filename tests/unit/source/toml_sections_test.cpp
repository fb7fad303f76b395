// stride.toml cut into sections, whatever stands in their texts.
#include "compiler/source/toml_sections.hpp"

#include <gtest/gtest.h>

#include <string>

namespace stc {
namespace {

/// `name: text` of each section, with `|` between them.
std::string cut(std::string_view text) {
  std::string all;
  for (const TomlSectionText &section : tomlSections(text))
    all += std::string(section.name) + ": " + std::string(section.text) + "|";
  return all;
}

TEST(TomlSections, BeginWithTheCommentsBeforeTheirHeaders) {
  EXPECT_EQ(cut("a = 1\n# one\n# more\n[x]\n# inside\nb = 2\n\n# two\n  [[ \"y\" . z ]]\n"),
            "x: # one\n# more\n[x]\n# inside\nb = 2\n\n|y: # two\n  [[ \"y\" . z ]]\n|");
}

TEST(TomlSections, AreNotFoundInLists) {
  EXPECT_EQ(cut("[x]\na = [ # [\n[1, 2],\n['[', \"\\\"[\"],\n]\n[y]\n"),
            "x: [x]\na = [ # [\n[1, 2],\n['[', \"\\\"[\"],\n]\n|y: [y]\n|");
}

TEST(TomlSections, AreNotFoundInTextsOfSeveralLines) {
  EXPECT_EQ(cut("[x]\na = \"\"\"\n[no]\n# no \\\"\"\"\n\"\"\"\n[y]\nb = '''\n[no]\n'''\n"),
            "x: [x]\na = \"\"\"\n[no]\n# no \\\"\"\"\n\"\"\"\n|y: [y]\nb = '''\n[no]\n'''\n|");
}

TEST(TomlSections, AreNotHiddenByQuotes) {
  EXPECT_EQ(cut("[x]\na = \"\"\"\"[ \"\"\"\n[y]\n"), "x: [x]\na = \"\"\"\"[ \"\"\"\n|y: [y]\n|");
  EXPECT_EQ(cut("[x]\na = \"\"\"b\"\"\"\"\"\n[y]\n"), "x: [x]\na = \"\"\"b\"\"\"\"\"\n|y: [y]\n|");
  EXPECT_EQ(cut("[x]\na = ['', \"\", '\\']\n[y]\n"), "x: [x]\na = ['', \"\", '\\']\n|y: [y]\n|");
}

} // namespace
} // namespace stc
