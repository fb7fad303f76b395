#ifndef STRIDE_COMPILER_SOURCE_OVERLAY_HPP
#define STRIDE_COMPILER_SOURCE_OVERLAY_HPP
// Texts that an editor has not saved yet.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// Stands before the disk: a file in it is read from here, whether the disk has one or not. It
/// outlives the compilations that look at it; in between it may change.
class Overlay {
public:
  /// The file is these bytes from now on.
  void set(const std::filesystem::path &path, std::string bytes);
  /// The file is again what the disk has.
  void remove(const std::filesystem::path &path);
  /// The bytes of a file, or null.
  [[nodiscard]] const std::string *find(const std::filesystem::path &path) const;
  [[nodiscard]] bool empty() const { return files_.empty(); }
  /// The files below a folder, sorted; their paths begin with `folder` as it is given.
  [[nodiscard]] std::vector<std::filesystem::path>
  filesBelow(const std::filesystem::path &folder) const;

private:
  std::map<std::filesystem::path, std::string> files_; ///< by absolute path without links
};

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_OVERLAY_HPP
