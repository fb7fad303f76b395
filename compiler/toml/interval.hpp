#ifndef STRIDE_COMPILER_TOML_INTERVAL_HPP
#define STRIDE_COMPILER_TOML_INTERVAL_HPP
// Durations as IEC writes them.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stc {

/// Nanoseconds of `3ms`, `T#3ms`, `TIME#1s500ms`, `LT#250us`, `t#1.5s` (units d, h, m, s, ms, us,
/// ns in this order, each at most once, underscores allowed, decimals on the last). Nothing when
/// the text is not such a duration or does not fit.
[[nodiscard]] std::optional<int64_t> parseInterval(std::string_view text);

/// The shortest spelling: `T#3ms`, `T#1s500ms`, `LT#250us`.
[[nodiscard]] std::string formatInterval(int64_t nanoseconds);

} // namespace stc

#endif // STRIDE_COMPILER_TOML_INTERVAL_HPP
