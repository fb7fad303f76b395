#include "compiler/project/tests.hpp"

#include "compiler/syntax/attributes.hpp"

#include "compiler/syntax/st_text.hpp"
#include "compiler/toml/interval.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc {

namespace {

constexpr int64_t kDefaultCycleNs = 10'000'000;
constexpr int64_t kDefaultTimeoutNs = 10'000'000'000;
constexpr int64_t kShortestCycleNs = 1'000;

bool isTest(const ast::Decl &decl) {
  return decl.kind == ast::DeclKind::FunctionBlock && decl.name &&
         hasAttribute(decl.attributes, ast::AttributeId::Test);
}

/// A duration, or `otherwise`.
int64_t durationOf(const ast::Decl &decl, ast::AttributeId id, int64_t otherwise,
                   Diagnostics &diagnostics) {
  const ast::Attribute *attribute = attributeOf(decl.attributes, id);
  if (attribute == nullptr)
    return otherwise;
  const std::string_view name = attributeRow(id).name;
  const std::optional<int64_t> value = parseInterval(attribute->value);
  if (value && *value >= kShortestCycleNs)
    return *value;
  diagnostics
      .report(Code::ConfigBadInterval, attribute->span.valid() ? attribute->span : decl.name.span,
              fmt::format("`{}` is a duration of 1 µs or more", name), "not such a duration")
      .help(fmt::format("write `{{attribute '{}' := 'T#10ms'}}`", name));
  return otherwise;
}

} // namespace

std::vector<TestBlock> findTests(const std::vector<ast::File *> &files, Diagnostics &diagnostics) {
  std::vector<TestBlock> tests;
  for (const ast::File *file : files) {
    for (const ast::Decl *decl : file->declarations) {
      if (!isTest(*decl))
        continue;
      TestBlock test;
      for (const ast::Name &space : decl->space)
        test.name += std::string(space.text) + ".";
      test.name += decl->name.text;
      test.place = decl->name.span;
      test.cycleNs = durationOf(*decl, ast::AttributeId::TestCycle, 0, diagnostics);
      test.timeoutNs =
          durationOf(*decl, ast::AttributeId::TestTimeout, kDefaultTimeoutNs, diagnostics);
      tests.push_back(std::move(test));
    }
  }
  return tests;
}

void removeTests(const std::vector<ast::File *> &files, Arena &arena) {
  for (ast::File *file : files) {
    std::vector<ast::Decl *> kept;
    std::copy_if(file->declarations.begin(), file->declarations.end(), std::back_inserter(kept),
                 [](const ast::Decl *decl) { return !isTest(*decl); });
    if (kept.size() != file->declarations.size())
      file->declarations = arena.copy(kept);
  }
}

SyntheticSource testProgram(const std::vector<TestBlock> &tests) {
  SyntheticSource out("<tests>");
  out.add(fmt::format("PROGRAM {}\nVAR\n  which__ : DINT := -1;\n", kTestProgram));
  for (size_t i = 0; i < tests.size(); ++i)
    out.add(fmt::format("  t{}__ : {};\n", i, tests[i].name), tests[i].place);
  out.add("END_VAR\n");
  if (tests.empty()) {
    out.add("which__ := 0;\nEND_PROGRAM\n");
    return out;
  }
  out.add("CASE which__ OF\n");
  for (size_t i = 0; i < tests.size(); ++i)
    out.add(fmt::format("  {}: t{}__();\n", i, i), tests[i].place);
  out.add("END_CASE\nEND_PROGRAM\n");
  return out;
}

void configureTests(ProjectConfig &config) {
  TaskConfig task;
  task.name.text = "Test";
  task.intervalNs = kDefaultCycleNs;
  task.programs.push_back({kTestProgram, {}});
  for (AxisGroupConfig &group : config.axisGroups) {
    group.task = {task.name.text, {}};
    if (group.cycleUs != 0)
      task.intervalNs = int64_t{group.cycleUs} * 1000;
  }
  for (AxisGroupConfig &group : config.axisGroups) // one task serves all
    group.cycleUs = 0;
  for (AxisConfig &axis : config.axes) {
    axis.task = {task.name.text, {}};
    axis.cycleUs = 0;
  }
  config.tasks.clear();
  config.tasks.push_back(std::move(task));
}

} // namespace stc
