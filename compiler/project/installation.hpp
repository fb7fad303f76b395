#pragma once
// Where Stride's own files lie.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stc {

/// The files that building and running an application needs besides the program `stride` itself.
struct Installation {
  std::filesystem::path include; ///< runtime/iec/types.h, st/<Library>/<Name>.h
  std::vector<std::filesystem::path>
      libraries;              ///< archives that every application links, in this order
  std::filesystem::path host; ///< stride-host
};

/// Finds them from the running program: in a build tree `<dir>/share/stride`, `<dir>/lib`;
/// installed
/// `<prefix>/share/stride`, `<prefix>/lib/stride`. `missing` gets the path that was looked for last
/// when there is none.
[[nodiscard]] std::optional<Installation> findInstallation(std::string &missing);

} // namespace stc
