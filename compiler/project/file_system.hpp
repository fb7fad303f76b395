#ifndef STRIDE_COMPILER_PROJECT_FILE_SYSTEM_HPP
#define STRIDE_COMPILER_PROJECT_FILE_SYSTEM_HPP
// Reading and writing files without surprises.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stc {

/// Permissions of a folder that nobody but the user may enter.
inline constexpr unsigned kUserOnly = 0700;

/// The whole file; nothing when it cannot be read (errno tells why).
[[nodiscard]] std::optional<std::string> readFile(const std::filesystem::path &path);

/// As readFile, of a regular file that has not more than `limit` bytes; a link is not followed, and
/// a pipe not waited for.
[[nodiscard]] std::optional<std::string> readRegularFile(const std::filesystem::path &path,
                                                         uintmax_t limit = UINTMAX_MAX);

/// As readRegularFile, in an open folder.
[[nodiscard]] std::optional<std::string> readRegularFileAt(int folder, const std::string &name,
                                                           uintmax_t limit = UINTMAX_MAX);

/// Replaces the file at once (written beside it, then renamed), making its folder; false on failure
/// (errno). A device or a pipe is never replaced, it is given the text.
[[nodiscard]] bool writeFile(const std::filesystem::path &path, std::string_view text);

[[nodiscard]] bool writeFile(const std::filesystem::path &path, std::string_view text,
                             unsigned mode);

/// Writes a file that is not there yet, making its folder; false on failure (errno). What fails may
/// leave a part of it: for folders that nobody else looks into.
[[nodiscard]] bool writeNewFile(const std::filesystem::path &path, std::string_view text);

/// As writeFile, in an open folder: neither the file written beside it, which gets a name that
/// nobody can know before, nor the renaming follows a link.
[[nodiscard]] bool writeAt(int folder, const std::string &name, std::string_view text,
                           unsigned mode);

/// Gives an existing file new content at once; its permissions stay, and a link to it. False on
/// failure (errno), also when the file must not be written.
[[nodiscard]] bool replaceFile(const std::filesystem::path &path, std::string_view text);

/// Whether links lead from `path` to something that does not lie in `folder`. What is not there
/// leads nowhere.
[[nodiscard]] bool leadsOut(const std::filesystem::path &folder, const std::filesystem::path &path);

/// As writeFile, but leaves the file alone when it already has this content.
[[nodiscard]] bool writeIfDifferent(const std::filesystem::path &path, std::string_view text);

/// Text of the last system error.
[[nodiscard]] std::string lastError();

/// Path, size, times and inode of a file in one text, for fingerprints; empty when there is no such
/// file.
[[nodiscard]] std::string fileStamp(const std::filesystem::path &path);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_FILE_SYSTEM_HPP
