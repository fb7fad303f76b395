#include "runtime/app/nearest.hpp"

#include <algorithm>

namespace stride::app {

namespace {

/// Edits (insert, delete, replace, swap of neighbours) between two texts.
std::size_t distance(const std::string &a, const std::string &b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

} // namespace

std::string lowered(std::string_view text) {
  std::string out(text);
  for (char &c : out) {
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::string didYouMean(std::string_view name, const std::vector<std::string> &candidates) {
  const std::string wanted = lowered(name);
  const std::size_t limit = std::max<std::size_t>(1, wanted.size() / 3);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string &candidate : candidates) {
    const std::string other = lowered(candidate);
    std::size_t d = distance(wanted, other);
    if (d > limit && wanted.size() >= 3 && other.find(wanted) != std::string::npos)
      d = limit; // part of a longer name
    if (d <= limit)
      near.emplace_back(d, candidate);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });
  if (near.size() > 3)
    near.resize(3);
  std::string text;
  for (std::size_t i = 0; i < near.size(); ++i) {
    text += i == 0 ? "; did you mean " : (i + 1 == near.size() ? " or " : ", ");
    text += "'" + near[i].second + "'";
  }
  return text.empty() ? text : text + "?";
}

} // namespace stride::app
