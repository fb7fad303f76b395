// Distribution of durations, recorded in the cyclic path and read from elsewhere.
#ifndef STRIDE_RUNTIME_TASK_HISTOGRAM_HPP
#define STRIDE_RUNTIME_TASK_HISTOGRAM_HPP

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace stride::task {

/// Counts durations from 0 ns to 2^40 ns (18 minutes; longer ones count as that) in buckets that
/// are 1/64 of their value wide at most. One thread records; any thread may read meanwhile and sees
/// each count either before or after a record.
class Histogram {
public:
  static constexpr unsigned kSubBits = 6; ///< 64 buckets per power of two.
  static constexpr unsigned kTopBit = 40;
  static constexpr size_t kBuckets = (kTopBit - kSubBits + 1) << kSubBits;

  /// Negative durations count as 0. [ns]
  void record(int64_t ns) noexcept {
    if (ns > greatest_.load(std::memory_order_relaxed))
      greatest_.store(ns, std::memory_order_relaxed);
    std::atomic<uint64_t> &count = counts_[bucketOf(ns)];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  uint64_t count(size_t bucket) const noexcept {
    return counts_[bucket].load(std::memory_order_relaxed);
  }
  uint64_t total() const noexcept;

  /// The duration that `share` (0 … 1) of all records do not exceed: the upper end of the bucket in
  /// which it lies, but never more than the greatest record; 0 without records. [ns]
  int64_t quantile(double share) const noexcept;

  void clear() noexcept {
    for (std::atomic<uint64_t> &count : counts_)
      count.store(0, std::memory_order_relaxed);
    greatest_.store(0, std::memory_order_relaxed);
  }

  static size_t bucketOf(int64_t ns) noexcept {
    if (ns <= 0)
      return 0;
    const auto value = static_cast<uint64_t>(ns);
    if (value < (1U << kSubBits))
      return static_cast<size_t>(value);
    const auto top = static_cast<unsigned>(std::bit_width(value)) - 1;
    if (top >= kTopBit)
      return kBuckets - 1;
    const unsigned shift = top - kSubBits;
    return (size_t{shift} << kSubBits) + static_cast<size_t>(value >> shift);
  }
  /// The smallest duration in the bucket. [ns]
  static int64_t lowerEnd(size_t bucket) noexcept {
    const size_t group = bucket >> kSubBits;
    if (group == 0)
      return static_cast<int64_t>(bucket);
    const size_t sub = (bucket & ((1U << kSubBits) - 1)) + (1U << kSubBits);
    return static_cast<int64_t>(sub << (group - 1));
  }

private:
  std::array<std::atomic<uint64_t>, kBuckets> counts_{};
  std::atomic<int64_t> greatest_{0};
};

} // namespace stride::task

#endif
