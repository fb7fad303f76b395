#include "runtime/common/edit_distance.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace stride::common {

size_t editDistance(std::string_view a, std::string_view b, size_t limit) {
  constexpr size_t kLongest = 255;
  const size_t n = a.size();
  const size_t m = b.size();
  if ((n > m ? n - m : m - n) > limit || std::max(n, m) > kLongest)
    return limit + 1;
  std::array<std::array<size_t, kLongest + 1>, 3> rows;
  size_t *before = rows[0].data();
  size_t *previous = rows[1].data();
  size_t *current = rows[2].data();
  for (size_t j = 0; j <= m; ++j)
    previous[j] = j;
  for (size_t i = 1; i <= n; ++i) {
    current[0] = i;
    for (size_t j = 1; j <= m; ++j) {
      const bool same = lowerCase(a[i - 1]) == lowerCase(b[j - 1]);
      current[j] =
          std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lowerCase(a[i - 1]) == lowerCase(b[j - 2]) &&
          lowerCase(a[i - 2]) == lowerCase(b[j - 1]))
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    if (*std::min_element(current, current + m + 1) > limit &&
        *std::min_element(previous, previous + m + 1) > limit)
      return limit + 1; // it does not get less
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return std::min(previous[m], limit + 1);
}

} // namespace stride::common
