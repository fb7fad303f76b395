#pragma once
// Reading and writing files without surprises.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace stc {

/// The whole file; nothing when it cannot be read (errno tells why).
[[nodiscard]] std::optional<std::string> readFile(const std::filesystem::path &path);

/// Replaces the file at once (written beside it, then renamed), making its folder; false on failure
/// (errno).
[[nodiscard]] bool writeFile(const std::filesystem::path &path, std::string_view text);

[[nodiscard]] bool writeFile(const std::filesystem::path &path, std::string_view text,
                             unsigned mode);

/// Gives an existing file new content at once; its permissions stay, and a link to it. False on
/// failure (errno), also when the file must not be written.
[[nodiscard]] bool replaceFile(const std::filesystem::path &path, std::string_view text);

/// As writeFile, but leaves the file alone when it already has this content.
[[nodiscard]] bool writeIfDifferent(const std::filesystem::path &path, std::string_view text);

/// Text of the last system error.
[[nodiscard]] std::string lastError();

/// Path, size and time of a file in one text, for fingerprints; empty when there is no such file.
[[nodiscard]] std::string fileStamp(const std::filesystem::path &path);

} // namespace stc
