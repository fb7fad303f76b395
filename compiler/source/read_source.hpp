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

/// And a CNC program that a command looks at alone: a million lines have some 40 bytes each.
inline constexpr size_t kMaxCncBytes = size_t{64} << 20U;

/// The bytes of a regular file of the disk; compilations ask Sources. Nothing when it cannot be
/// read, is longer than `most`, or is something else than a file: a pipe without a writer, a device
/// and the like are not waited for. Then errno tells why, and readSourceError() says it.
[[nodiscard]] std::optional<std::string> readSource(const std::filesystem::path &path,
                                                    size_t most = kMaxSourceBytes);

/// Why the last readSource(), with the same `most`, gave nothing.
[[nodiscard]] std::string readSourceError(size_t most = kMaxSourceBytes);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_READ_SOURCE_HPP
