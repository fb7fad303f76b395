#include "compiler/semantics/suggest.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace stc {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Edits (insert, delete, replace, swap of neighbours) from a to b, or `limit + 1` when there are
/// more.
std::size_t distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t n = a.size();
  const std::size_t m = b.size();
  constexpr std::size_t kLongest = 255; // no name is longer
  if ((n > m ? n - m : m - n) > limit || m > kLongest)
    return limit + 1;
  std::array<std::array<std::size_t, kLongest + 1>, 3> rows;
  std::size_t *before = rows[0].data();
  std::size_t *previous = rows[1].data();
  std::size_t *current = rows[2].data();
  for (std::size_t j = 0; j <= m; ++j)
    previous[j] = j;
  for (std::size_t i = 1; i <= n; ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= m; ++j) {
      const std::size_t replace = previous[j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replace});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    if (*std::min_element(current, current + m + 1) > limit &&
        *std::min_element(previous, previous + m + 1) > limit)
      return limit + 1; // it does not get less
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[m];
}

} // namespace

std::string_view nearest(std::string_view word, const std::vector<std::string_view> &candidates) {
  // Any letter is one edit away from any other.
  std::size_t best = word.size() < 2 ? 0 : std::max<std::size_t>(1, word.size() / 3);
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    const std::size_t d = distance(word, candidate, best);
    if (d <= best && (found.empty() || d < best)) {
      best = d;
      found = candidate;
    }
  }
  return found;
}

} // namespace stc
