// test
#include "compiler/cli/commands.hpp"
#include "compiler/cli/run_project.hpp"
#include "compiler/cli/trace_tests.hpp"
#include "compiler/project/build.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <fnmatch.h>

namespace stc::cli {

namespace {

/// What is to be done of a project.
struct Selection {
  std::vector<std::string> names; ///< of all of them
  std::vector<std::string> plans; ///< unit tests, as stride-host is told
  std::vector<TraceTest> traces;
};

Selection select(const Project &project, const std::string &filter) {
  const auto matches = [&](const std::string &name) {
    return filter.empty() || ::fnmatch(filter.c_str(), name.c_str(), 0) == 0;
  };
  Selection selection;
  for (size_t i = 0; i < project.tests().size(); ++i) {
    const TestBlock &one = project.tests()[i];
    if (!matches(one.name))
      continue;
    selection.names.push_back(one.name);
    selection.plans.push_back(fmt::format("{};{};{};{};{};{}", i, one.cycleNs, one.timeoutNs,
                                          project.sources().position(one.place).line, one.name,
                                          project.sources().file(one.place.file).name()));
  }
  for (const TraceTest &test : project.config().traceTests)
    if (matches(test.name.text)) {
      selection.names.push_back(test.name.text);
      selection.traces.push_back(test);
    }
  return selection;
}

std::optional<BuildResult> buildQuickly(Project &project, ProgressLine &progress) {
  BuildOptions build;
  build.debug = true;
  build.use = BuildUse::RunOnce;
  build.progress = [&](std::string_view what, size_t done, size_t total) {
    progress.update(what, done, total);
  };
  return stc::build(project, build);
}

/// What stride-host is given to run the unit tests.
std::vector<std::string> hostArguments(const Project &project, const BuildResult &result,
                                       const std::vector<std::string> &plans,
                                       const std::string &junit) {
  std::vector<std::string> arguments = {
      "test",    result.runnable.string(),
      "--suite", project.name(),
      "--root",  project.isSingleFile() ? "." : project.path().string(),
      "--files", result.filesRoot.string()};
  if (!junit.empty())
    arguments.insert(arguments.end(), {"--junit", junit});
  for (const std::string &plan : plans)
    arguments.insert(arguments.end(), {"--test", plan});
  return arguments;
}

/// The application that is simulated: without the tests. Nothing after an error, which is shown.
std::optional<BuildResult> buildForTraces(const ProjectOptions &options) {
  const EmbeddedLibraryIndex index(standardLibrary());
  Project project(options.path, Purpose::Build, settingsOf(options), index);
  ProgressLine progress;
  std::optional<BuildResult> result;
  if (!project.hasErrors())
    result = buildQuickly(project, progress);
  progress.clear();
  // Whatever else there is to say has been said of the project with its tests.
  std::vector<Diagnostic> errors = project.diagnostics();
  std::erase_if(errors, [](const Diagnostic &one) { return one.severity != Severity::Error; });
  if (!errors.empty())
    (void)show(errors, project.sources(), options.output);
  return result;
}

} // namespace

int testCommand(const ProjectOptions &options, const TestOptions &test) {
  Selection selection;
  std::vector<std::string> arguments;
  std::string name;
  {
    const EmbeddedLibraryIndex index(standardLibrary());
    Project project(options.path, Purpose::Test, settingsOf(options), index);
    name = project.name();
    selection = select(project, test.filter);
    const bool none = selection.names.empty();
    for (const std::string &one : selection.names)
      if (test.list)
        print(one + "\n");
    ProgressLine progress;
    std::optional<BuildResult> result;
    const bool builds = !selection.plans.empty() || (none && test.filter.empty());
    if (!project.hasErrors() && !test.list && builds)
      result = buildQuickly(project, progress);
    progress.clear();
    const int exitCode = show(project.diagnostics(), project.sources(), options.output);
    if (exitCode == 0 && none && !test.filter.empty())
      throw CLI::ValidationError("--filter", "no test is called '" + test.filter + "'");
    if (exitCode == 0 && test.bless && selection.traces.empty())
      throw CLI::ValidationError("--bless", "there is no [[test]] in stride.toml to write for");
    if (exitCode != 0 || test.list || (builds && !result))
      return exitCode;
    if (result)
      arguments = hostArguments(project, *result, selection.plans, test.junit);
  }
  if (selection.traces.empty())
    return becomeHost(std::move(arguments), options.output);
  int exitCode = 0;
  if (!arguments.empty())
    exitCode = runHost(arguments, options.output);
  const std::optional<BuildResult> application = buildForTraces(options);
  if (!application)
    return 1;
  if (!arguments.empty())
    print("\n");
  const std::vector<TraceResult> results =
      runTraceTests(options, *application, selection.traces, test.bless);
  if (std::any_of(results.begin(), results.end(),
                  [](const TraceResult &one) { return !one.failure.empty(); }))
    exitCode = std::max(exitCode, 1);
  if (!test.junit.empty() && !addToJunit(test.junit, arguments.empty(), name + " traces", results))
    return showError(Code::CannotWrite,
                     fmt::format("`{}` cannot be written: {}", test.junit, std::strerror(errno)),
                     options.output);
  return exitCode;
}

} // namespace stc::cli
