#include "compiler/cli/import_command.hpp"

#include "compiler/cli/commands.hpp"
#include "compiler/import/finish.hpp"
#include "compiler/import/input_files.hpp"
#include "compiler/import/report.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/format_project.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/output_folder.hpp"
#include "compiler/project/project.hpp"
#include "compiler/semantics/builtins.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kUnreadable = 2;
constexpr size_t kPlacesOfACode = 5; ///< that the report shows

/// A folder beside the target in which the project is made. It is gone when it was not moved.
class StagingFolder {
public:
  explicit StagingFolder(const fs::path &target) {
    fs::path parent = target.parent_path();
    std::error_code ignored;
    if (!parent.empty())
      fs::create_directories(parent, ignored);
    std::string name = (parent / ".stride-import-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr)
      path_ = name;
  }
  ~StagingFolder() {
    std::error_code ignored;
    if (!path_.empty())
      fs::remove_all(path_, ignored);
  }
  StagingFolder(const StagingFolder &) = delete;
  StagingFolder &operator=(const StagingFolder &) = delete;

  /// Empty: it could not be made (errno).
  [[nodiscard]] const fs::path &path() const { return path_; }

private:
  fs::path path_;
};

fs::path targetOf(const ImportOptions &options) {
  if (!options.out.empty()) {
    const fs::path named = fs::path(options.out).lexically_normal();
    return named.has_filename() ? named : named.parent_path();
  }
  std::error_code error;
  const fs::path first = fs::weakly_canonical(options.paths.front(), error);
  return fs::is_directory(first, error) ? first.filename() : first.stem();
}

int showRemarks(const std::vector<import::Remark> &remarks, Code code, std::string_view whatToDo,
                const Output &output) {
  Diagnostics diagnostics;
  for (const import::Remark &each : remarks) {
    Diagnostic &diagnostic =
        diagnostics.report(code, {},
                           fmt::format("{}:{}: {}{}{}", each.origin.file, each.origin.line,
                                       each.object, each.object.empty() ? "" : ": ", each.text));
    if (!whatToDo.empty())
      diagnostic.help(std::string(whatToDo));
  }
  return show(diagnostics.all(), Sources(), output);
}

int notWritten(const fs::path &path, const Output &output) {
  return showError(Code::CannotWrite,
                   fmt::format("`{}` cannot be written: {}", path.string(), lastError()), output);
}

/// Checks the project as `stride check` does, and counts what it says by code.
std::vector<import::CheckCount> checkResult(const fs::path &folder) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project project(folder, Purpose::Check, {}, index);
  std::map<Code, import::CheckCount> counts;
  for (const Diagnostic &each : project.diagnostics()) {
    if (each.severity != Severity::Error && each.severity != Severity::Warning)
      continue;
    import::CheckCount &count = counts[each.code];
    count.code = codeName(each.code);
    count.title = info(each.code).title;
    ++(each.severity == Severity::Error ? count.errors : count.warnings);
    if (count.places.size() == kPlacesOfACode)
      continue;
    if (each.labels.empty()) {
      count.places.push_back(each.message);
      continue;
    }
    const Span place = each.labels.front().span;
    const LineColumn at = project.sources().position(place);
    count.places.push_back(fmt::format("{}:{}:{}: {}", project.sources().file(place.file).name(),
                                       at.line, at.column, each.message));
  }
  std::vector<import::CheckCount> result;
  for (auto &[code, count] : counts)
    result.push_back(std::move(count));
  return result;
}

/// Formats what was written. Files with errors of syntax stay as they are.
void formatSources(const fs::path &folder) {
  Sources sources;
  Diagnostics diagnostics;
  for (const FormattedFile &file : formatPath(folder, sources, diagnostics))
    if (file.before != file.after && !file.outside)
      (void)replaceFile(file.path, file.after); // else it stays as it is, too
}

/// Sources in the target that are not of this import.
size_t foreignSources(const fs::path &target, const std::vector<import::ProjectFile> &files) {
  size_t count = 0;
  const Sources sources;
  for (const fs::path &path : findSources(sources, {target}).files) {
    const std::string name = path.lexically_relative(target).generic_string();
    count += std::none_of(files.begin(), files.end(),
                          [&](const import::ProjectFile &each) { return each.path == name; });
  }
  return count;
}

/// Nothing: all is written. Else the path that could not be.
std::optional<fs::path> writeAll(const fs::path &folder,
                                 const std::vector<import::ProjectFile> &files) {
  const std::optional<OutputFolder> target = OutputFolder::open(folder);
  if (!target)
    return folder;
  for (const import::ProjectFile &file : files)
    if (!target->write(file.path, file.text))
      return folder / file.path;
  return std::nullopt;
}

/// Moves the finished project to its place. The path that could not be written, or nothing.
std::optional<fs::path> publish(const fs::path &staging, const fs::path &target,
                                std::vector<import::ProjectFile> &files) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(target, error))) {
    // As an ordinary folder is: mkdtemp lets nobody else in.
    fs::permissions(staging, fs::perms(0755), error);
    fs::rename(staging, target, error);
    if (!error)
      return std::nullopt;
    errno = error.value();
    return target;
  }
  for (import::ProjectFile &file : files) // as they may have been formatted
    if (std::optional<std::string> text = readFile(staging / file.path))
      file.text = std::move(*text);
  return writeAll(target, files);
}

bool isBuiltin(std::string_view lowerName) {
  const std::span<const BuiltinName> names = builtinNames();
  return std::any_of(names.begin(), names.end(), [&](const BuiltinName &each) {
    return equalIgnoringCase(each.name, lowerName);
  });
}

size_t errorsOf(const std::vector<import::CheckCount> &checked) {
  size_t errors = 0;
  for (const import::CheckCount &each : checked)
    errors += each.errors;
  return errors;
}

void showSum(const import::Model &model, const std::vector<import::CheckCount> &checked,
             const fs::path &target) {
  const auto some = [](size_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
  };
  print(fmt::format(
      "Imported {} from {} into {}: {} left out, {} changed, {} to look at, {} in the check. "
      "Report: {}\n",
      some(model.objects.size(), "object", "objects"), some(model.files, "file", "files"),
      target.string(), model.leftOut.size() + model.unreadable.size(), model.changed.size(),
      import::toLookAt(model), some(errorsOf(checked), "error", "errors"),
      (target / import::kReportFile).string()));
}

/// Writes, checks and reports what was read.
int makeProject(const ImportOptions &options, const import::Model &model, const fs::path &target) {
  const import::ProjectSettings settings{target.filename().string(), options.library};
  std::vector<import::ProjectFile> files = import::projectFiles(model, settings);
  const StagingFolder staging(target);
  if (staging.path().empty())
    return notWritten(target, options.output);
  if (const auto failed = writeAll(staging.path(), files))
    return notWritten(*failed, options.output);
  if (options.format)
    formatSources(staging.path());
  const std::vector<import::CheckCount> checked = checkResult(staging.path());
  const import::ProjectFile report{import::kReportFile,
                                   import::reportOf(model, settings, files, checked)};
  if (const auto failed = writeAll(staging.path(), {report}))
    return notWritten(*failed, options.output);
  files.push_back(report);
  if (const auto failed = publish(staging.path(), target, files))
    return notWritten(*failed, options.output);
  showSum(model, checked, target);
  if (const size_t count = options.force ? foreignSources(target, files) : 0)
    print(fmt::format("{} further .st {} in {}: not of this import, but of the project now\n",
                      count, count == 1 ? "file is" : "files are", target.string()));
  const bool lost = !model.leftOut.empty() || !model.unreadable.empty();
  return lost || errorsOf(checked) != 0 ? 1 : 0;
}

} // namespace

int importCommand(const ImportOptions &options) {
  const fs::path target = targetOf(options);
  const std::string name = target.filename().string();
  if (name.empty() || name == "." || name == "..")
    return showError(
        Code::ConfigBadName,
        fmt::format("`{}` cannot be the name of a project: name a folder with -o", target.string()),
        options.output);
  std::error_code error;
  if (!options.force && fs::exists(fs::symlink_status(target, error)))
    return showError(Code::TargetExists,
                     fmt::format("`{}` already exists: name another folder with -o, or use --force "
                                 "to write into it",
                                 target.string()),
                     options.output);
  import::Model model = import::readFiles(options.paths, options.encoding);
  if (model.files == 0) {
    showRemarks(model.unreadable, Code::ImportUnreadable, {}, options.output);
    return kUnreadable;
  }
  const EmbeddedLibraryIndex index(standardLibrary());
  std::vector<std::string_view> libraryTexts;
  for (const EmbeddedFile &file : standardLibrary().files)
    libraryTexts.push_back(file.text);
  const import::FinishSettings finish{
      options.library,
      options.addressing,
      options.configuration,
      {[&](std::string_view name) { return !index.find(name).empty() || isBuiltin(name); },
       [&](std::string_view name) { return index.isLibrary(name); }},
      std::move(libraryTexts)};
  if (const std::string problem = import::finish(model, finish); !problem.empty())
    return showError(Code::UnreadableFile, problem, options.output);
  if (!model.unreadable.empty())
    showRemarks(model.unreadable, Code::ImportUnreadable, {}, options.output);
  if (options.strict && (!model.leftOut.empty() || !model.unreadable.empty())) {
    showRemarks(model.leftOut, Code::ImportLoss, "without --strict the rest is imported",
                options.output);
    return 1;
  }
  return makeProject(options, model, target);
}

} // namespace stc::cli
