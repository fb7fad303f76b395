#ifndef STRIDE_COMPILER_PROJECT_SOURCE_FILES_HPP
#define STRIDE_COMPILER_PROJECT_SOURCE_FILES_HPP
// The files that belong to a project, and the project that belongs to a folder.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/toml/schema.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace stc {

/// Name of the file that makes a folder a project.
inline constexpr std::string_view kManifest = "stride.toml";

struct FoundFiles {
  std::vector<std::filesystem::path> files; ///< sorted by path
  std::error_code error;                    ///< the folder cannot be read
  /// Links to folders that cannot be followed, and where they lead.
  std::vector<std::pair<std::filesystem::path, std::string>> notFollowed;
};

/// All source files below these folders (which may also be files), also those that are not saved
/// yet. Hidden folders and those named `build` are left out, and other projects. Links to folders
/// are followed; a file that several paths lead to is taken once.
[[nodiscard]] FoundFiles findSources(const Sources &sources,
                                     const std::vector<std::filesystem::path> &roots);

/// The same of the cam files, *.cam.toml.
[[nodiscard]] FoundFiles findCams(const Sources &sources,
                                  const std::vector<std::filesystem::path> &roots);

/// The same of the CNC files, *.cnc, but for those below the folder `without`.
[[nodiscard]] FoundFiles findCncFiles(const Sources &sources,
                                      const std::vector<std::filesystem::path> &roots,
                                      const std::filesystem::path &without);

/// Where the files of a project are, as `sources` of its stride.toml says (empty: the folder). What
/// is not there is reported; then false.
bool findRoots(const std::filesystem::path &folder, const std::vector<ConfigName> &named,
               const Sources &sources, Diagnostics &diagnostics,
               std::vector<std::filesystem::path> &roots);
/// Reports what could not be looked into; then false.
bool reportUnfound(const FoundFiles &found, const std::filesystem::path &folder,
                   Diagnostics &diagnostics);

/// The folder of the project that a folder belongs to: itself, or the nearest one around it that
/// has a stride.toml of the folder's owner; without one, itself.
[[nodiscard]] std::filesystem::path findProjectFolder(const std::filesystem::path &folder);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_SOURCE_FILES_HPP
