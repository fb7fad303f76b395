#ifndef STRIDE_COMPILER_PROJECT_INSTALLATION_HPP
#define STRIDE_COMPILER_PROJECT_INSTALLATION_HPP
// Where Stride's own files lie.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stc {

/// The files that building and running an application needs besides the program `stride` itself.
struct Installation {
  std::filesystem::path include;                ///< runtime/iec/types.h, st/<Library>/<Name>.h
  std::vector<std::filesystem::path> libraries; ///< archives that applications link, in this order
  std::vector<std::string> compileFlags;        ///< besides the dialect's (a sanitizer's)
  std::vector<std::string> linkFlags;
  std::filesystem::path host;        ///< stride-host
  std::filesystem::path canTool;     ///< stride-can
  std::filesystem::path debugScript; ///< what gdb knows of ST
  /// With `main` and all of stride-host, for static executables: linked before `libraries`.
  std::vector<std::filesystem::path> hostLibraries;
  std::vector<std::string> staticFlags; ///< linked after everything else
};

/// Finds them from the running program: in a build tree `<dir>/share/stride` and `<dir>/lib`,
/// installed `<prefix>/share/stride` and `<prefix>/lib/stride`. `missing` gets the path that was
/// looked for last when there is none. With `target` the archives are those for that processor, in
/// a folder of its name beside those of this machine.
[[nodiscard]] std::optional<Installation> findInstallation(std::string &missing,
                                                           const std::string &target = {});

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_INSTALLATION_HPP
