#include "compiler/cli/trace_tests.hpp"

#include "compiler/cli/run_project.hpp"
#include "compiler/plot/compare.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/job_pool.hpp"
#include "compiler/project/output_folder.hpp"
#include "compiler/project/user_cache.hpp"
#include "compiler/source/render.hpp"
#include "compiler/toml/interval.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <pugixml.hpp>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

constexpr uintmax_t kMostTraceBytes = 1U << 30U;
constexpr size_t kMostLines = 20; // of what a simulation that has failed has said

/// Before the test has run, or of one that cannot.
TraceResult resultOf(const TraceTest &test, std::string problem = {}) {
  const bool isError = !problem.empty();
  return {test.name.text,
          fmt::format("tests/{}.csv", test.name.text),
          std::move(problem),
          isError,
          false,
          0};
}

/// What stands in the way of the files of a test.
std::string cannot(std::string_view what, const fs::path &path) {
  return fmt::format("`{}` cannot be {}: {}", path.string(), what, std::strerror(errno));
}

/// The first lines of what a program has said.
std::string beginningOf(std::string_view text) {
  std::string kept;
  for (size_t lines = 0; lines < kMostLines && !text.empty(); ++lines) {
    const size_t end = std::min(text.find('\n'), text.size());
    kept += fmt::format("{}{}", kept.empty() ? "" : "\n", text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
  }
  return text.empty() ? kept : kept + "\n…";
}

class TraceTests {
public:
  TraceTests(const ProjectOptions &options, const BuildResult &application, bool bless,
             OutputFolder project, fs::path work)
      : options_(options), application_(application), bless_(bless), project_(std::move(project)),
        work_(std::move(work)) {}

  TraceResult run(const TraceTest &test) {
    const auto start = std::chrono::steady_clock::now();
    TraceResult result = resultOf(test);
    if (const std::optional<std::string> trace = simulate(test, result))
      judge(test, *trace, result);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

private:
  std::vector<std::string> argumentsOf(const TraceTest &test, const fs::path &trace) const {
    std::vector<std::string> own = {"--quiet", "--for", formatInterval(test.durationNs), "--out",
                                    trace.string()};
    for (const std::string &variable : test.trace)
      own.insert(own.end(), {"--trace", variable});
    if (!test.script.empty())
      own.insert(own.end(), {"--script", (application_.folder / test.script).string()});
    for (const std::string &one : test.sets)
      own.insert(own.end(), {"--set", one});
    return own;
  }

  /// The rows of the trace that count; nothing: the simulation has failed, which the result says.
  std::optional<std::string> simulate(const TraceTest &test, TraceResult &result) {
    const fs::path file = work_ / "trace.csv";
    std::optional<std::vector<std::string>> arguments =
        hostArgumentsOf(options_, "sim", application_, argumentsOf(test, file));
    if (!arguments) {
      result.failure = "the simulation cannot begin"; // why has been shown
      return std::nullopt;
    }
    arguments->insert(arguments->begin(), hostProgram());
    const JobResult run = runJobs({{std::move(*arguments), test.name.text}}).front();
    if (run.status != 0) {
      result.isError = true;
      result.failure = fmt::format("the simulation has failed:\n{}", beginningOf(run.output));
      return std::nullopt;
    }
    const std::optional<std::string> trace = readFile(file);
    if (!trace) {
      result.failure = cannot("read", file);
      return std::nullopt;
    }
    return plot::rowsAt(*trace, test.everyNs);
  }

  void judge(const TraceTest &test, const std::string &trace, TraceResult &result) {
    const fs::path kept = fs::path("build") / "tests" / (test.name.text + ".csv");
    const std::optional<std::string> expected = project_.read(result.expected, kMostTraceBytes);
    const bool isMissing = !expected && errno == ENOENT;
    if (!expected && !isMissing) {
      result.failure = cannot("read", result.expected);
      return;
    }
    const plot::TraceDifference difference =
        expected ? plot::compareTraces(*expected, trace, test.tolerance) : plot::TraceDifference{};
    if (expected && difference.none()) {
      static_cast<void>(project_.remove(kept)); // that of an earlier test
      return;
    }
    if (bless_) {
      result.isNew = project_.write(result.expected, trace);
      if (!result.isNew)
        result.failure = cannot("written", result.expected);
      return;
    }
    std::string text =
        isMissing ? fmt::format("there is no `{}`", result.expected) : plot::describe(difference);
    if (hideBuilds(project_) && project_.write(kept, trace))
      text += fmt::format("\n= the trace: `{}`",
                          (application_.folder / kept).lexically_normal().string());
    result.failure =
        text + fmt::format("\n= if it is right, `stride test --bless --filter {}` writes "
                           "it to `{}`",
                           test.name.text, result.expected);
  }

  const ProjectOptions &options_;
  const BuildResult &application_;
  bool bless_;
  OutputFolder project_;
  fs::path work_;
};

void tell(const std::string &text) {
  print(text);
  std::fflush(stdout);
}

std::string outcomeOf(const TraceResult &result) {
  if (!result.failure.empty())
    return "FAILED";
  return result.isNew ? fmt::format("written to `{}`", result.expected) : "ok";
}

std::string indented(std::string_view text) {
  std::string out = "  ";
  for (const char c : text)
    out += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return out + "\n";
}

} // namespace

std::vector<TraceResult> runTraceTests(const ProjectOptions &options,
                                       const BuildResult &application,
                                       const std::vector<TraceTest> &tests, bool bless) {
  std::vector<TraceResult> results;
  const std::optional<UserCache> cache = UserCache::open();
  const std::optional<WorkFolder> work = cache ? cache->makeWorkFolder() : std::nullopt;
  std::optional<OutputFolder> project = OutputFolder::open(application.folder);
  if (!work || !project) {
    const std::string problem = cannot("used", work ? application.folder : fs::path("the cache"));
    for (const TraceTest &test : tests)
      results.push_back(resultOf(test, problem));
    tell(problem + "\n");
    return results;
  }
  TraceTests runner(options, application, bless, std::move(*project), work->path());
  tell(fmt::format("running {} trace{}\n", tests.size(), tests.size() == 1 ? "" : "s"));
  size_t failed = 0;
  for (const TraceTest &test : tests) {
    tell(fmt::format("trace {} ... ", test.name.text));
    results.push_back(runner.run(test));
    tell(outcomeOf(results.back()) + "\n");
    failed += results.back().failure.empty() ? 0 : 1;
    if (!results.back().failure.empty())
      tell(indented(results.back().failure));
  }
  tell(fmt::format("\ntrace result: {}. {} passed; {} failed\n", failed == 0 ? "ok" : "FAILED",
                   results.size() - failed, failed));
  return results;
}

bool addToJunit(const std::string &path, bool isNew, const std::string &suite,
                const std::vector<TraceResult> &results) {
  pugi::xml_document document;
  if (!isNew)
    static_cast<void>(document.load_file(path.c_str()));
  pugi::xml_node all = document.child("testsuites");
  if (!all)
    all = document.append_child("testsuites");
  pugi::xml_node own = all.append_child("testsuite");
  own.append_attribute("name") = suite.c_str();
  size_t failures = 0;
  size_t errors = 0;
  double seconds = 0;
  for (const TraceResult &result : results) {
    pugi::xml_node one = own.append_child("testcase");
    one.append_attribute("name") = result.name.c_str();
    one.append_attribute("classname") = suite.c_str();
    one.append_attribute("file") = result.expected.c_str();
    one.append_attribute("time") = fmt::format("{:.6f}", result.seconds).c_str();
    seconds += result.seconds;
    if (result.failure.empty())
      continue;
    ++(result.isError ? errors : failures);
    pugi::xml_node failure = one.append_child(result.isError ? "error" : "failure");
    failure.append_attribute("message") =
        result.failure.substr(0, result.failure.find('\n')).c_str();
    failure.append_attribute("type") = "trace";
    failure.text() = result.failure.c_str();
  }
  const auto count = [&](const char *name, size_t more) {
    own.append_attribute(name) = static_cast<unsigned long long>(more);
    pugi::xml_attribute sum = all.attribute(name);
    if (!sum)
      sum = all.append_attribute(name);
    sum = sum.as_ullong() + more;
  };
  count("tests", results.size());
  count("failures", failures);
  count("errors", errors);
  count("skipped", 0);
  const std::string time = fmt::format("{:.6f}", seconds);
  own.append_attribute("time") = time.c_str();
  pugi::xml_attribute sum = all.attribute("time");
  if (!sum)
    sum = all.append_attribute("time");
  sum = fmt::format("{:.6f}", sum.as_double() + seconds).c_str();
  return document.save_file(path.c_str(), "  ", pugi::format_default, pugi::encoding_utf8);
}

} // namespace stc::cli
