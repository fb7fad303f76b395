#include "runtime/app/nearest.hpp"

#include "runtime/common/edit_distance.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>

namespace stride::app {

std::string didYouMean(std::string_view name, const std::vector<std::string> &candidates) {
  const std::string wanted = common::lowerCase(name);
  const size_t limit = std::max<size_t>(1, wanted.size() / 3);
  std::vector<std::pair<size_t, std::string>> near;
  for (const std::string &candidate : candidates) {
    const std::string other = common::lowerCase(candidate);
    size_t d = common::editDistance(wanted, other, limit);
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
  for (size_t i = 0; i < near.size(); ++i) {
    text += i == 0 ? "; did you mean " : (i + 1 == near.size() ? " or " : ", ");
    text += "'" + near[i].second + "'";
  }
  return text.empty() ? text : text + "?";
}

} // namespace stride::app
