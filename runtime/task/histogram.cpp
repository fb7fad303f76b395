#include "runtime/task/histogram.hpp"

#include <algorithm>
#include <cmath>

namespace stride::task {

uint64_t Histogram::total() const noexcept {
  uint64_t sum = 0;
  for (size_t i = 0; i < kBuckets; ++i)
    sum += count(i);
  return sum;
}

int64_t Histogram::quantile(double share) const noexcept {
  const uint64_t all = total();
  if (all == 0)
    return 0;
  const auto wanted = static_cast<uint64_t>(std::ceil(share * static_cast<double>(all)));
  uint64_t seen = 0;
  for (size_t i = 0; i < kBuckets; ++i) {
    seen += count(i);
    if (seen >= wanted && seen != 0)
      return std::min(lowerEnd(i + 1) - 1, greatest_.load(std::memory_order_relaxed));
  }
  return lowerEnd(kBuckets) - 1;
}

} // namespace stride::task
