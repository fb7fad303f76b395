#ifndef STRIDE_COMPILER_SOURCE_SUGGEST_HPP
#define STRIDE_COMPILER_SOURCE_SUGGEST_HPP
// "Did you mean …"

#include <string_view>
#include <vector>

namespace stc {

/// The candidate nearest to `word` (optimal string alignment distance, case ignored), or an empty
/// view when none is near enough to be meant: at most a third of the word's length, at least one
/// edit; one letter must be the same. Never the word itself, which does not stand for what is
/// meant.
[[nodiscard]] std::string_view nearest(std::string_view word,
                                       const std::vector<std::string_view> &candidates);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_SUGGEST_HPP
