#ifndef STRIDE_COMPILER_PROJECT_MADE_FILES_HPP
#define STRIDE_COMPILER_PROJECT_MADE_FILES_HPP
// Files that a build makes for the application.

#include "compiler/project/project.hpp"

#include <filesystem>

namespace stc {

/// Writes what CNC programs of the project in `folder` become into its folder for files, `root`, if
/// that lies in the project. False: something cannot be written, which is reported.
[[nodiscard]] bool writeMadeFiles(const Project &project, const std::filesystem::path &folder,
                                  const std::filesystem::path &root, Diagnostics &diagnostics);

/// Reports that a file of the project cannot be written: what errno says.
void reportCannotWrite(const std::filesystem::path &path, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_MADE_FILES_HPP
