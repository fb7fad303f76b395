// stride library

#include "compiler/cli/commands.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/library_graph.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/output_folder.hpp"
#include "compiler/project/project.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/read_source.hpp"
#include "compiler/source/render.hpp"

#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <system_error>
#include <utility>
#include <vector>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

/// What is installed of a library: its stride.toml, its sources and cams, and the files beside its
/// stride.toml (README.md, LICENSE), all relative to its folder.
std::vector<fs::path> filesOf(const Project &project) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(project.path(), error); !error && at != fs::directory_iterator();
       at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (std::error_code ignored; at->is_regular_file(ignored) && !name.starts_with('.'))
      files.emplace_back(name);
  }
  for (const std::string &file : project.files())
    if (file.find('/') != std::string::npos)
      files.emplace_back(file);
  return files;
}

int cannotWrite(const fs::path &path, const Output &output) {
  return showError(Code::CannotWrite,
                   fmt::format("`{}` cannot be written: {}", path.string(), lastError()), output);
}

} // namespace

int installLibraryCommand(const ProjectOptions &options, bool replace) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project project(options.path, Purpose::Check, settingsOf(options), index);
  if (const int exitCode = show(project.diagnostics(), project.sources(), options.output))
    return exitCode;
  if (!project.library())
    return showError(Code::LibraryMissing,
                     fmt::format("`{}` is not a library: its stride.toml has no [library]",
                                 project.path().string()),
                     options.output);
  const LibraryInfo &info = *project.library();
  if (userLibraries().empty())
    return showError(Code::CannotWrite,
                     "there is no folder for libraries: neither HOME nor XDG_DATA_HOME is set",
                     options.output);
  const fs::path folder = userLibraries() / info.name.text / info.version.text;
  std::error_code error;
  if (!replace && fs::exists(folder / kManifest, error))
    return showError(Code::TargetExists,
                     fmt::format("{} {} is installed in `{}`: give the library another version, or "
                                 "use --replace",
                                 info.name.text, info.version.text, folder.string()),
                     options.output);
  std::vector<std::pair<fs::path, std::string>> files; // all read before anything is removed
  for (const fs::path &file : filesOf(project)) {
    if (*file.begin() == "..")
      return showError(
          Code::LibraryContent,
          fmt::format("`{}` lies outside of the library: it cannot be installed", file.string()),
          options.output);
    std::optional<std::string> bytes = readSource(project.path() / file);
    if (!bytes)
      return showError(Code::UnreadableFile,
                       fmt::format("`{}` cannot be read: {}", file.string(), readSourceError()),
                       options.output);
    files.emplace_back(file, std::move(*bytes));
  }
  fs::remove_all(folder, error);
  const std::optional<OutputFolder> target = OutputFolder::open(folder);
  if (!target)
    return cannotWrite(folder, options.output);
  for (const auto &[file, bytes] : files)
    if (!target->write(file, bytes))
      return cannotWrite(folder / file, options.output);
  std::fputs(fmt::format("Installed {} {} in {}\n", info.name.text, info.version.text,
                         visible(folder.string()))
                 .c_str(),
             stdout);
  return 0;
}

int listLibrariesCommand() {
  for (const InstalledLibrary &one : installedLibraries())
    std::fputs(fmt::format("{} {}  {}\n", visible(one.name), visible(one.version),
                           visible(one.folder.string()))
                   .c_str(),
               stdout);
  return 0;
}

} // namespace stc::cli
