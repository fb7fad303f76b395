// test
#include "compiler/cli/commands.hpp"
#include "compiler/project/build.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <fnmatch.h>

namespace stc::cli {

int testCommand(const ProjectOptions &options, const TestOptions &test) {
  std::vector<std::string> arguments;
  std::string application;
  {
    const EmbeddedLibraryIndex index(standardLibrary());
    Project project(options.path, Purpose::Test, settingsOf(options), index);
    std::vector<std::string> plans;
    for (size_t i = 0; i < project.tests().size(); ++i) {
      const TestBlock &one = project.tests()[i];
      if (!test.filter.empty() && ::fnmatch(test.filter.c_str(), one.name.c_str(), 0) != 0)
        continue;
      if (test.list)
        std::printf("%s\n", one.name.c_str());
      plans.push_back(fmt::format("{};{};{};{};{};{}", i, one.cycleNs, one.timeoutNs,
                                  project.sources().position(one.place).line, one.name,
                                  project.sources().file(one.place.file).name()));
    }
    const bool noneOfThatName = plans.empty() && !test.filter.empty();
    ProgressLine progress;
    std::optional<BuildResult> result;
    if (!project.hasErrors() && !test.list && !noneOfThatName) {
      BuildOptions build;
      build.debug = true;
      build.use = BuildUse::RunOnce;
      build.progress = [&](std::string_view what, size_t done, size_t total) {
        progress.update(what, done, total);
      };
      result = stc::build(project, build);
    }
    progress.clear();
    const int exitCode = show(project.diagnostics(), project.sources(), options.output);
    if (exitCode == 0 && noneOfThatName)
      throw CLI::ValidationError("--filter", "no test is called '" + test.filter + "'");
    if (exitCode != 0 || !result)
      return exitCode;
    arguments = {result->runnable.string(), "--suite", project.name(), "--root",
                 project.isSingleFile() ? "." : project.path().string()};
    arguments.insert(arguments.end(), {"--files", result->filesRoot.string()});
    if (!test.junit.empty())
      arguments.insert(arguments.end(), {"--junit", test.junit});
    for (const std::string &plan : plans)
      arguments.insert(arguments.end(), {"--test", plan});
  }
  return hostOnlyCommand("test", arguments);
}

} // namespace stc::cli
