#ifndef STRIDE_COMPILER_SOURCE_READ_SOURCE_HPP
#define STRIDE_COMPILER_SOURCE_READ_SOURCE_HPP
// Reading files that people write: sources, configurations, cams.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace stc {

/// So many bytes a source file, a configuration or a cam file has at most.
inline constexpr size_t kMaxSourceBytes = size_t{16} << 20U;

/// The bytes of a regular file of the disk; compilations ask Sources. Nothing when it cannot be
/// read, is longer than kMaxSourceBytes, or is something else than a file: a pipe without a writer,
/// a device and the like are not waited for. Then errno tells why, and readSourceError() says it.
[[nodiscard]] std::optional<std::string> readSource(const std::filesystem::path &path);

/// Why the last readSource() gave nothing.
[[nodiscard]] std::string readSourceError();

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_READ_SOURCE_HPP
