#include "compiler/source/suggest.hpp"

#include "runtime/common/edit_distance.hpp"

#include <algorithm>
#include <cstddef>

namespace stc {

std::string_view nearest(std::string_view word, const std::vector<std::string_view> &candidates) {
  // Any letter is one edit away from any other.
  size_t best = word.size() < 2 ? 0 : std::max<size_t>(1, word.size() / 3);
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    const size_t d = stride::common::editDistance(word, candidate, best);
    if (d <= best && (found.empty() || d < best)) {
      best = d;
      found = candidate;
    }
  }
  return found;
}

} // namespace stc
