#include "compiler/project/schema.hpp"

#include "compiler/project/file_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace stc {
namespace {

using ::testing::HasSubstr;

// Calls `visit` for a section and all below it.
template <class Visit> void forEachSection(const Section &section, const Visit &visit) {
  visit(section);
  for (const Section *child : section.sections)
    forEachSection(*child, visit);
}

TEST(Schema, IsDocumented) {
  const std::optional<std::string> text = readFile(STRIDE_SOURCE_DIR "/docs/projects.md");
  ASSERT_TRUE(text);
  forEachSection(projectSchema(), [&](const Section &section) {
    EXPECT_THAT(*text, HasSubstr(std::string(section.path)));
    if (section.path == "diagnostics")
      return; // its keys are the codes and names that `stride explain --list` shows
    for (const Parameter &parameter : section.parameters) {
      EXPECT_THAT(*text, HasSubstr("`" + std::string(parameter.name) + "`"));
      if (parameter.name.starts_with("wCyclicDataR"))
        continue; // `"ActPosition"`, …
      for (const Choice &choice : parameter.choices)
        EXPECT_THAT(*text, HasSubstr("\"" + std::string(choice.name) + "\""));
    }
  });
}

TEST(Schema, CamFilesAreDocumented) {
  const std::optional<std::string> text =
      readFile(STRIDE_SOURCE_DIR "/docs/synchronized-motion.md");
  ASSERT_TRUE(text);
  forEachSection(camSchema(), [&](const Section &section) {
    if (!section.name.empty()) {
      EXPECT_THAT(*text,
                  HasSubstr((section.list ? "`[[" : "`[") + std::string(section.name) + "]"));
    }
    EXPECT_EQ(&section.file(), &camSchema()) << section.name;
    for (const Parameter &parameter : section.parameters) {
      EXPECT_THAT(*text, HasSubstr("`" + std::string(parameter.name) + "`"));
      for (const Choice &choice : parameter.choices)
        EXPECT_THAT(*text, HasSubstr("`\"" + std::string(choice.name) + "\"`"));
    }
  });
}

void expectSense(const Section &schema) {
  forEachSection(schema, [](const Section &section) {
    std::set<std::string_view> names;
    for (const Parameter &parameter : section.parameters) {
      EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
      EXPECT_EQ(parameter.type == ParameterType::choice, !parameter.choices.empty())
          << parameter.name;
      if (parameter.type == ParameterType::integer || parameter.type == ParameterType::real) {
        EXPECT_LT(parameter.low, parameter.high) << parameter.name;
      }
    }
    for (const Section *child : section.sections)
      EXPECT_TRUE(names.insert(child->name).second) << child->name;
  });
}

TEST(Schema, MakesSense) {
  expectSense(projectSchema());
  expectSense(camSchema());
}

} // namespace
} // namespace stc
