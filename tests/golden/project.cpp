#include "tests/golden/golden.hpp"
#include "tests/support/csv_compare.hpp"
#include "tests/support/text.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <toml++/toml.h>

namespace stride::golden {

namespace fs = std::filesystem;

namespace {

constexpr const char *kManifest = "golden.toml";

// A file that a run must write, and how it is compared.
struct ExpectedFile {
  std::string actual;
  std::string expected;
  size_t every = 1; // of a trace: keep every n-th row only
  test::CsvTolerance tolerance;

  bool isTrace() const { return actual.ends_with(".csv"); }
};

struct Run {
  std::vector<std::string> arguments;
  bool failure = false;
  std::string output; // name of the file with the expected output; empty: not compared
  std::vector<ExpectedFile> files;
};

struct Manifest {
  fs::path project;
  std::vector<Run> runs;
};

template <class T> T required(const toml::table &table, const char *key) {
  const std::optional<T> value = table[key].value<T>();
  if (!value)
    throw std::runtime_error(std::string(kManifest) + ": `" + key +
                             "` is missing or of wrong type");
  return *value;
}

void rejectUnknownKeys(const toml::table &table, std::initializer_list<std::string_view> known) {
  for (const auto &[key, value] : table)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      throw std::runtime_error(std::string(kManifest) + ": unknown key `" + std::string(key.str()) +
                               "`");
}

ExpectedFile readExpectedFile(const toml::table &table) {
  rejectUnknownKeys(table, {"actual", "expected", "every", "tolerance"});
  ExpectedFile file;
  file.actual = required<std::string>(table, "actual");
  file.expected = required<std::string>(table, "expected");
  file.every = table["every"].value_or<size_t>(1);
  if (const std::optional<double> all = table["tolerance"].value<double>())
    file.tolerance.otherwise = *all;
  if (const toml::table *columns = table["tolerance"].as_table())
    for (const auto &[key, value] : *columns)
      file.tolerance.absolute[std::string(key.str())] = value.value_or(0.0);
  return file;
}

Run readRun(const toml::table &table, bool failure) {
  rejectUnknownKeys(table, {"project", "args", "exit", "output", "file"});
  Run run;
  if (const toml::array *arguments = table["args"].as_array())
    for (const toml::node &argument : *arguments)
      run.arguments.push_back(argument.value_or(std::string()));
  else
    throw std::runtime_error(std::string(kManifest) + ": a run needs `args`");
  run.failure =
      table.contains("exit") ? required<std::string>(table, "exit") == "failure" : failure;
  run.output = table["output"].value_or(std::string());
  if (const toml::array *files = table["file"].as_array())
    for (const toml::node &file : *files)
      if (const toml::table *entry = file.as_table())
        run.files.push_back(readExpectedFile(*entry));
  return run;
}

Manifest readManifest(const fs::path &folder) {
  Manifest manifest{folder, {}};
  const bool failure = mustFail(folder);
  if (!fs::exists(folder / kManifest)) {
    manifest.runs.push_back({{"check", "--color", "never"}, failure, "expected.txt", {}});
    return manifest;
  }
  const toml::table table = toml::parse_file((folder / kManifest).string());
  if (const std::optional<std::string> project = table["project"].value<std::string>())
    manifest.project = fs::path(STRIDE_SOURCE_DIR) / *project;
  if (const toml::array *runs = table["run"].as_array()) {
    rejectUnknownKeys(table, {"project", "run"});
    for (const toml::node &run : *runs)
      if (const toml::table *entry = run.as_table())
        manifest.runs.push_back(readRun(*entry, failure));
  } else {
    manifest.runs.push_back(readRun(table, failure));
  }
  return manifest;
}

// Copies a project without what a build left there.
void copyProject(const fs::path &from, const fs::path &to) {
  fs::create_directories(to);
  for (const fs::directory_entry &entry : fs::directory_iterator(from)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with('.') && name != "build")
      fs::copy(entry.path(), to / name,
               fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  }
}

std::string readIfExists(const fs::path &path) {
  return fs::exists(path) ? test::readFile(path) : std::string();
}

std::string checkFile(const ExpectedFile &file, const fs::path &folder, const fs::path &project,
                      bool bless) {
  if (!fs::exists(project / file.actual))
    return file.actual + " was not written\n";
  std::string actual = test::readFile(project / file.actual);
  if (file.isTrace() && file.every > 1)
    actual = test::sampleRows(actual, file.every);
  const std::string expected = readIfExists(folder / file.expected);
  const std::string difference = file.isTrace() ? test::compareCsv(expected, actual, file.tolerance)
                                                : test::diff(expected, actual);
  if (difference.empty())
    return {};
  if (bless) {
    test::writeFile(folder / file.expected, actual);
    return {};
  }
  return file.actual + " differs from " + file.expected + ":\n" + difference;
}

std::string checkRun(const Run &run, const fs::path &folder, const fs::path &project, bool bless) {
  const test::ProcessResult result = runStride(run.arguments, project);
  const std::string output = outputOf(result, project);
  std::string report = checkExit(result.exitCode, run.failure);
  if (!report.empty())
    return report + output;
  if (!run.output.empty()) {
    const std::string difference = test::diff(readIfExists(folder / run.output), output);
    if (!difference.empty() && bless)
      test::writeFile(folder / run.output, test::canonical(output));
    else
      report += difference;
  }
  for (const ExpectedFile &file : run.files)
    report += checkFile(file, folder, project, bless);
  return report;
}

} // namespace

std::string runProject(const fs::path &folder, bool bless) {
  const Manifest manifest = readManifest(folder);
  const test::ScratchDirectory scratch;
  const fs::path project = scratch.path() / manifest.project.filename();
  copyProject(manifest.project, project);
  for (const Run &run : manifest.runs) {
    const std::string report = checkRun(run, folder, project, bless);
    if (report.empty())
      continue;
    std::string command = "$ stride";
    for (const std::string &argument : run.arguments)
      command += ' ' + argument;
    return command + '\n' + report;
  }
  return {};
}

} // namespace stride::golden
