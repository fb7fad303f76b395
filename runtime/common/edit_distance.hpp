// How far a name is from another one.
#ifndef STRIDE_RUNTIME_COMMON_EDIT_DISTANCE_HPP
#define STRIDE_RUNTIME_COMMON_EDIT_DISTANCE_HPP

#include <cstddef>
#include <string_view>

namespace stride::common {

/// Edits (insert, delete, replace, swap of neighbours) that lead from `a` to `b`, the case of
/// letters ignored, or `limit + 1` when there are more, or a name has more than 255 bytes.
/// Source: optimal string alignment distance.
[[nodiscard]] size_t editDistance(std::string_view a, std::string_view b, size_t limit);

} // namespace stride::common

#endif
