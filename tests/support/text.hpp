// Files, lines and readable differences.
#ifndef STRIDE_TESTS_SUPPORT_TEXT_HPP
#define STRIDE_TESTS_SUPPORT_TEXT_HPP

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stride::test {

/// The bytes of a file; throws std::runtime_error when it cannot be read.
std::string readFile(const std::filesystem::path &path);

/// Replaces a file's content; throws std::runtime_error when it cannot be written.
void writeFile(const std::filesystem::path &path, std::string_view content);

/// The lines of a text without their line ends; a last line without '\n' counts as one.
std::vector<std::string> splitLines(std::string_view text);

/// Splits at blanks; '…' and "…" keep blanks together (no escapes).
std::vector<std::string> splitWords(std::string_view text);

/// `text` with every occurrence of `from` replaced by `to`.
std::string replaceAll(std::string text, std::string_view from, std::string_view to);

/// The text with blanks at the ends of lines and empty lines at its end removed; each line ends in
/// '\n'. Two outputs count as equal when their canonical forms are.
std::string canonical(std::string_view text);

/// A line-by-line difference: ' ' common, '-' only expected, '+' only actual, with a few lines of
/// context. Empty when the canonical forms are equal.
std::string diff(std::string_view expected, std::string_view actual);

/// A directory of its own under the system's temporary directory, removed at the end.
class ScratchDirectory {
public:
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory &) = delete;
  ScratchDirectory &operator=(const ScratchDirectory &) = delete;

  const std::filesystem::path &path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace stride::test

#endif // STRIDE_TESTS_SUPPORT_TEXT_HPP
