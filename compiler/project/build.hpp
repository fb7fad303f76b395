#ifndef STRIDE_COMPILER_PROJECT_BUILD_HPP
#define STRIDE_COMPILER_PROJECT_BUILD_HPP
// From a checked project to a shared object that stride-host runs, or to one static executable.

#include "compiler/project/axes_group_sources.hpp"
#include "compiler/project/project.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace stc {

/// What a build is for.
enum class BuildUse : uint8_t {
  Keep,    ///< the application is written where `output` says, and is the project's latest build
  Run,     ///< nothing is written; it is the project's latest build
  RunOnce, ///< nothing is written
};

struct BuildOptions {
  BuildUse use = BuildUse::Keep;
  bool debug = false; ///< -O0 -g: quick to compile, for tests and the debugger
  /// Where the shared object (or with emitOnly the sources) goes. Empty: `<project>/build/app.so`,
  /// which must not be a single file.
  std::filesystem::path output;
  bool emitOnly = false; ///< only the C++ sources
  /// One executable with stride-host and the application, without shared libraries; its name is
  /// that of the application, without `.so`.
  bool isStatic = false;
  /// The user's folder for the program's files, which gets what CNC programs become, too; empty:
  /// none but the project's.
  std::filesystem::path filesFolder;
  std::string target; ///< a processor as Debian's cross compilers name it; empty: this machine's
  /// Called now and then with what is being done and how much is done of how much.
  std::function<void(std::string_view what, size_t done, size_t total)> progress;
};

/// What a build left behind.
struct BuildResult {
  std::filesystem::path application; ///< what was written; empty: nothing
  /// The application in the user's cache, where nobody else can change it: what is to be run.
  std::filesystem::path runnable;
  std::filesystem::path latest;  ///< leads to the project's latest build, then and later
  std::string name;              ///< the application's, where it does not carry one itself
  std::filesystem::path headers; ///< Stride's own, which the application's line tables name
  size_t compiled = 0; ///< translation units that were compiled; the others came from the cache
  size_t units = 0;
  std::filesystem::path folder;     ///< the project's, or that of the single file
  std::filesystem::path retainFile; ///< for RETAIN and PERSISTENT variables
  std::filesystem::path filesRoot;  ///< for the files of the program
  std::vector<GroupTrace> groups;   ///< those of [[axes_group]]
};

/// Folder of Stride's headers in the line tables of applications.
inline constexpr std::string_view kHeadersInLineTables = "/stride";

/// The project's folder, or that of the single file.
[[nodiscard]] std::filesystem::path folderOf(const Project &project);

/// Where `stride run` and `stride reset` look for retained data: as stride.toml says, relative to
/// the project, or `retain/NAME` in it; beside a single file `NAME.retain`.
[[nodiscard]] std::filesystem::path retainFileOf(const Project &project);

/// The folder for the files of the program: as stride.toml says, or `files`, relative to the
/// project or to the folder of a single file.
[[nodiscard]] std::filesystem::path filesRootOf(const Project &project);

/// Generates and compiles the project; it must be free of errors. What goes wrong is reported to
/// the project's diagnostics, and nothing is returned.
///
/// Each build compiles in a folder of its own in the user's cache, which also keeps its units and
/// applications by the hash of everything they were made from; below the project it only writes
/// results. The same sources give the same bytes, wherever they lie.
[[nodiscard]] std::optional<BuildResult> build(Project &project, const BuildOptions &options);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_BUILD_HPP
