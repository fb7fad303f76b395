#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/project/config_reader.hpp"

#include "compiler/project/driver_sections.hpp"
#include "compiler/project/file_system.hpp"
#include "drivers/io/registry.hpp"
#include "drivers/registry.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <string>

namespace stc {
namespace {

using ::testing::HasSubstr;

// Calls `visit` for a section and all below it.
template <class Visit> void forEachSection(const SectionSchema &section, const Visit &visit) {
  visit(section);
  for (const SectionSchema *child : section.sections)
    forEachSection(*child, visit);
}

TEST(Schema, IsDocumented) {
  std::optional<std::string> text = readFile(STRIDE_SOURCE_DIR "/docs/projects.md");
  const std::optional<std::string> libraries = readFile(STRIDE_SOURCE_DIR "/docs/libraries.md");
  ASSERT_TRUE(text && libraries);
  *text += *libraries;
  const auto check = [&](const SectionSchema &section) {
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
  };
  forEachSection(projectSchema(), check);
  forEachSection(librarySchema(), check);
}

/// What the documentation says of a parameter's values.
std::string valuesOf(const Parameter &row) {
  const stride::common::Default &otherwise = row.otherwise;
  if (row.type == ParameterType::Choice) {
    std::string text;
    for (const Choice &choice : row.choices)
      text += fmt::format("{}`\"{}\"`{}", text.empty() ? "" : ", ", choice.name,
                          otherwise.any && otherwise.number == static_cast<double>(choice.value)
                              ? " (default)"
                              : "");
    return text;
  }
  std::string text;
  switch (row.type) {
  case ParameterType::Boolean:
    text = "BOOL";
    break;
  case ParameterType::Interval:
    text = "duration";
    break;
  case ParameterType::DriveName:
    text = "name of a drive of the same axis group";
    break;
  case ParameterType::Integer:
  case ParameterType::Real:
    if (row.high < 1e9)
      text = fmt::format("{} … {}", row.low, row.high);
    if (!row.unit.empty())
      text += fmt::format("{}{}", text.empty() ? "" : " ", row.unit);
    if (text.empty())
      text = "number";
    break;
  case ParameterType::NameList:
    text = "list of texts";
    break;
  default:
    text = "text";
    break;
  }
  if (!otherwise.any)
    return text;
  if (otherwise.computed != nullptr)
    return fmt::format("{}; default: {}", text, otherwise.text);
  if (row.type == ParameterType::Interval)
    return fmt::format("{}, default {} ms", text, otherwise.number * 1000);
  if (row.type == ParameterType::Text)
    return fmt::format("{}, default `{}`", text, otherwise.text);
  if (row.type == ParameterType::Boolean)
    return fmt::format("{}, default {}", text, otherwise.number != 0 ? "`true`" : "`false`");
  return fmt::format("{}, default {}", text, otherwise.number);
}

std::string lineOf(const Parameter &row) {
  std::string model;
  for (const Choice &choice : stride::dummy::physics::kModels)
    if (row.only.parameter == "model" && row.only.value == choice.value)
      model = fmt::format("{}: ", choice.name);
  return fmt::format("| `{}` | {} | {}{} |\n", row.name, valuesOf(row), model, row.text);
}

void expectLines(std::span<const Parameter> rows, const std::string &text) {
  for (const Parameter &row : rows) {
    EXPECT_FALSE(row.text.empty()) << row.name;
    EXPECT_THAT(text, HasSubstr(lineOf(row)));
  }
}

/// All rows of a driver, by the section they belong to.
void forEachDriverRows(const stride::bus::DriverSchema &driver,
                       const std::function<void(std::span<const Parameter>)> &visit) {
  for (const auto rows : {driver.bus, driver.axisGroup, driver.drive, driver.encoder})
    visit(rows);
  for (const auto tables : {driver.axisGroupTables, driver.driveTables, driver.encoderTables})
    for (const stride::common::ParameterTable &table : tables)
      visit(table.parameters);
}

TEST(Schema, ParametersOfDriversAreDocumentedAsTheirRowsSay) {
  const std::optional<std::string> text = readFile(STRIDE_SOURCE_DIR "/docs/projects.md");
  ASSERT_TRUE(text);
  for (const stride::bus::DriverSchema *driver : stride::drivers::kSchemas)
    forEachDriverRows(*driver, [&](std::span<const Parameter> rows) { expectLines(rows, *text); });
  for (const stride::io::IoSchema *device : stride::drivers::kIoSchemas)
    for (const Parameter &row : device->parameters)
      EXPECT_THAT(*text, HasSubstr(fmt::format("| `{}` | {} | {}: {} |\n", row.name, valuesOf(row),
                                               device->name, row.text)));
}

TEST(Schema, RulesOfDriversNameParametersOfTheSameSection) {
  size_t rules = 0;
  const auto check = [&](std::span<const Parameter> rows) {
    for (const Parameter &row : rows)
      for (const std::string_view other : {row.only.parameter, row.without, row.with, row.lessThan})
        if (!other.empty()) {
          ++rules;
          EXPECT_TRUE(std::any_of(rows.begin(), rows.end(),
                                  [&](const Parameter &one) { return one.name == other; }))
              << row.name << ": " << other;
        }
  };
  for (const stride::bus::DriverSchema *driver : stride::drivers::kSchemas)
    forEachDriverRows(*driver, check);
  for (const stride::io::IoSchema *device : stride::drivers::kIoSchemas)
    check(device->parameters);
  EXPECT_GT(rules, 15U);
}

// Two drivers that there are not.
using namespace stride::common;
constexpr std::array kBlueRows = {flag("shade"), real("depth", 0, 9, "m").needed()};
constexpr std::array kRedRows = {whole("shade", 1, 5)};
constexpr std::array kRedTables = {ParameterTable{"fire", "the fire of a drive", kRedRows}};
constexpr stride::bus::DriverSchema kBlue = {
    .name = "Blue", .interfaceType = "Blue (sea)", .drive = kBlueRows};
constexpr stride::bus::DriverSchema kRed = {
    .name = "Red", .interfaceType = "Red (sunset)", .drive = kRedRows, .driveTables = kRedTables};
constexpr std::array kBoth = {&kBlue, &kRed};

const SectionSchema &driveOf(const BusSection &bus) {
  return *bus.section().sections.front()->sections.front();
}

/// What a drive with this text gets to hear.
std::string saidOf(const SectionSchema &drive, const std::string &text) {
  Sources sources;
  Diagnostics diagnostics;
  const SourceFile &file =
      sources.file(sources.add("stride.toml", "name = \"X\"\nwDriveId = 1\n" + text));
  const std::unique_ptr<TomlNode> document = parseToml(file, diagnostics);
  const CheckedSection section(*document, drive, diagnostics);
  std::vector<ConfigParameter> parameters;
  addParameters(section, "", parameters);
  std::string said;
  for (const Diagnostic &diagnostic : diagnostics.all())
    said += fmt::format("{} ({}); ", diagnostic.message, diagnostic.labels.front().text);
  for (const ConfigParameter &parameter : parameters)
    if (parameter.name == "shade" || parameter.name == "depth")
      said += fmt::format("{} = {}; ", parameter.name, parameter.number);
  return said;
}

TEST(Schema, ADriverHasItsOwnParametersAndThoseOfOthersHaveNoEffect) {
  const BusSection blue(&kBlue, kBoth);
  EXPECT_EQ(saidOf(driveOf(blue), "shade = true\ndepth = 3.5\n"), "shade = 1; depth = 3.5; ");
  EXPECT_EQ(saidOf(driveOf(blue), "depth = 1\n[fire]\nshade = 2\n"),
            "`fire` has no effect here (only with InterfaceType = \"Red (sunset)\"); depth = 1; ");
  EXPECT_EQ(saidOf(driveOf(blue), "shade = 2\ndepth = 9.5\n"),
            "`shade` must be `true` or `false` (this is an integer); "
            "`depth` must be in 0 … 9 m (too large); ");
  const BusSection red(&kRed, kBoth);
  EXPECT_EQ(saidOf(driveOf(red), "shade = 2\ndepth = 3.5\n"),
            "`depth` has no effect here (only with InterfaceType = \"Blue (sea)\"); shade = 2; ");
}

TEST(Schema, WithAnUnknownDriverThoseOfAllCount) {
  const BusSection unknown(nullptr, kBoth);
  EXPECT_EQ(saidOf(driveOf(unknown), "depth = 3.5\n[fire]\n"), "depth = 3.5; ");
}

TEST(Schema, CamFilesAreDocumented) {
  const std::optional<std::string> text =
      readFile(STRIDE_SOURCE_DIR "/docs/synchronized-motion.md");
  ASSERT_TRUE(text);
  forEachSection(camSchema(), [&](const SectionSchema &section) {
    if (!section.name.empty()) {
      EXPECT_THAT(*text,
                  HasSubstr((section.list ? "`[[" : "`[") + std::string(section.name) + "]"));
    }
    for (const Parameter &parameter : section.parameters) {
      EXPECT_THAT(*text, HasSubstr("`" + std::string(parameter.name) + "`"));
      for (const Choice &choice : parameter.choices)
        EXPECT_THAT(*text, HasSubstr("`\"" + std::string(choice.name) + "\"`"));
    }
  });
}

void expectSense(const SectionSchema &schema) {
  forEachSection(schema, [](const SectionSchema &section) {
    std::set<std::string_view> names;
    for (const Parameter &parameter : section.parameters) {
      EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
      EXPECT_EQ(parameter.type == ParameterType::Choice, !parameter.choices.empty())
          << parameter.name;
      if (parameter.type == ParameterType::Integer || parameter.type == ParameterType::Real) {
        EXPECT_LT(parameter.low, parameter.high) << parameter.name;
      }
    }
    for (const SectionSchema *child : section.sections)
      EXPECT_TRUE(names.insert(child->name).second) << child->name;
  });
}

TEST(Schema, MakesSense) {
  expectSense(projectSchema());
  expectSense(camSchema());
}

} // namespace
} // namespace stc
