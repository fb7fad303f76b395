#ifndef STRIDE_COMPILER_PROJECT_LIBRARY_GRAPH_HPP
#define STRIDE_COMPILER_PROJECT_LIBRARY_GRAPH_HPP
// The libraries of the user's own that a project needs, with those that these need.

#include "compiler/project/cnc_config.hpp"
#include "compiler/project/config.hpp"
#include "compiler/semantics/program.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stc {

/// A library that has been found: its texts are read, not yet parsed.
struct FoundLibrary {
  std::filesystem::path folder;
  std::filesystem::path canonical; ///< which identifies it
  ProjectConfig config;            ///< its stride.toml
  std::string name;                ///< LibrarySource::name
  Span nameSpan;                   ///< where that comes from
  std::vector<FileId> sources;
  std::vector<FileId> cams;
  std::vector<CncFound> cncFiles;
  std::vector<LibrarySource::Use> uses;
};

/// Folders with installed libraries, in which NAME/stride.toml or NAME/VERSION/stride.toml lies:
/// those of STRIDE_LIBRARIES (with `:` between them), the user's (see userLibraries()), and that of
/// this installation.
[[nodiscard]] std::vector<std::filesystem::path> libraryFolders();
/// `$XDG_DATA_HOME/stride/libraries`, or the same in `~/.local/share`; empty: there is no home.
[[nodiscard]] std::filesystem::path userLibraries();

struct InstalledLibrary {
  std::filesystem::path folder;
  std::string name;
  std::string version;
  Version number{};
};

/// The installed libraries, by name and the latest first; of one name in lower case, or (empty)
/// all.
[[nodiscard]] std::vector<InstalledLibrary> installedLibraries(const std::string &lowerName = {});

class LibraryGraph {
public:
  /// All must outlive it. `project`: the folder, from which places are named.
  LibraryGraph(Program &program, const LibraryIndex &index, std::filesystem::path project)
      : program_(program), index_(index), project_(std::move(project)) {}

  /// Finds and reads what the project uses; what is wrong is reported. False: something is missing.
  bool load(const ProjectConfig &config);

  /// Each after those that it uses.
  [[nodiscard]] const std::vector<FoundLibrary> &libraries() const { return libraries_; }
  /// How the project calls those that it names itself.
  [[nodiscard]] const std::vector<LibrarySource::Use> &uses() const { return uses_; }

private:
  /// A library that is being read.
  struct Open {
    std::filesystem::path canonical;
    std::string name;
  };

  std::optional<LibrarySource::Use> use(const LibraryUse &wanted, const FoundLibrary *by);
  std::optional<std::filesystem::path> folderOf(const LibraryUse &wanted, const FoundLibrary *by);
  std::optional<FoundLibrary> read(const LibraryUse &wanted, const std::filesystem::path &folder);
  bool isThatLibrary(const LibraryUse &wanted, const FoundLibrary &found);
  bool readFiles(FoundLibrary &library);
  void checkNames(const FoundLibrary &found);
  bool isOpen(const LibraryUse &wanted, const std::filesystem::path &canonical);
  std::optional<std::string> standardLibrary(const LibraryUse &wanted) const;
  [[nodiscard]] std::string shown(const std::filesystem::path &path) const;

  Program &program_;
  const LibraryIndex &index_;
  std::filesystem::path project_;
  std::vector<FoundLibrary> libraries_;
  std::vector<LibrarySource::Use> uses_;
  std::vector<Open> open_;
  std::map<std::filesystem::path, ConfigName> renamed_; ///< by the project: names of libraries
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_LIBRARY_GRAPH_HPP
