#ifndef STRIDE_COMPILER_PROJECT_OUTPUT_FOLDER_HPP
#define STRIDE_COMPILER_PROJECT_OUTPUT_FOLDER_HPP
// Writing below a folder that somebody else has filled.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace stc {

/// A folder below which Stride writes results. Whoever gave the project away may have put links
/// there: every folder below it is opened without following one, and a file that is a link is
/// replaced, not followed. The folder itself is what the user named, be it a link or not.
class OutputFolder {
public:
  /// Makes the folder if it is not there. Nothing on failure (errno).
  [[nodiscard]] static std::optional<OutputFolder> open(const std::filesystem::path &folder);
  OutputFolder(OutputFolder &&other) noexcept;
  OutputFolder &operator=(OutputFolder &&) = delete;
  OutputFolder(const OutputFolder &) = delete;
  OutputFolder &operator=(const OutputFolder &) = delete;
  ~OutputFolder();

  /// Writes `name`, a relative path without `..`, as writeFile does, making the folders it lies in.
  /// False on failure (errno): ELOOP where one of them is a link.
  [[nodiscard]] bool write(const std::filesystem::path &name, std::string_view text,
                           unsigned mode = 0666) const;
  /// The contents of a file; nothing when it is none, or a link or below one, or has more bytes
  /// (errno).
  [[nodiscard]] std::optional<std::string> read(const std::filesystem::path &name,
                                                uintmax_t limit) const;
  [[nodiscard]] bool hasFile(const std::filesystem::path &name) const;
  /// Removes a file, or a link. False on failure (errno).
  [[nodiscard]] bool remove(const std::filesystem::path &name) const;

private:
  explicit OutputFolder(int handle) : handle_(handle) {}
  [[nodiscard]] int parentOf(const std::filesystem::path &name, bool make) const;

  int handle_ = -1;
};

/// Sees that git leaves out what is in the folder `build` below a project. False on failure
/// (errno).
[[nodiscard]] bool hideBuilds(const OutputFolder &project);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_OUTPUT_FOLDER_HPP
