#pragma once
// From a checked project to a shared object that stride-host runs, or to one static executable.

#include "compiler/project/project.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace stc {

struct BuildOptions {
  bool debug = false; ///< -O0 -g: quick to compile, for tests and the debugger
  /// Where the shared object (or with emitOnly the sources) goes. Empty: `<project>/build/app.so`;
  /// for a single file a place in the user's cache folder.
  std::filesystem::path output;
  bool emitOnly = false; ///< only the C++ sources
  /// One executable with stride-host and the application, without shared libraries; its name is
  /// that of the application, without `.so`.
  bool isStatic = false;
  std::string target; ///< a processor as Debian's cross compilers name it; empty: this machine's
  /// Called now and then with what is being done and how much is done of how much.
  std::function<void(std::string_view what, std::size_t done, std::size_t total)> progress;
};

/// What a build left behind.
struct BuildResult {
  std::filesystem::path application; ///< the shared object, or the folder of the sources
  std::size_t compiled =
      0; ///< translation units that were compiled; the others came from the cache
  std::size_t units = 0;
  std::filesystem::path retainFile; ///< for RETAIN and PERSISTENT variables
  std::filesystem::path filesRoot;  ///< for the files of the program
};

/// Where `stride run` and `stride reset` look for retained data: as stride.toml says, relative to
/// the project, or `retain/NAME` in it; beside a single file `NAME.retain`.
[[nodiscard]] std::filesystem::path retainFileOf(const Project &project);

/// The folder for the files of the program: as stride.toml says, or `files`, relative to the
/// project or to the folder of a single file.
[[nodiscard]] std::filesystem::path filesRootOf(const Project &project);

/// Generates and compiles the project; it must be free of errors. What goes wrong is reported to
/// the project's diagnostics, and nothing is returned.
[[nodiscard]] std::optional<BuildResult> build(Project &project, const BuildOptions &options);

/// The user's folder for caches of single files: $XDG_CACHE_HOME/stride or ~/.cache/stride.
[[nodiscard]] std::filesystem::path userCacheFolder();

} // namespace stc
