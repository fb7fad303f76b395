#pragma once
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
  std::filesystem::path host; ///< stride-host
};

/// Finds them from the running program: in a build tree `<dir>/share/stride` and `<dir>/lib`,
/// installed `<prefix>/share/stride` and `<prefix>/lib/stride`. `missing` gets the path that was
/// looked for last when there is none.
[[nodiscard]] std::optional<Installation> findInstallation(std::string &missing);

} // namespace stc
