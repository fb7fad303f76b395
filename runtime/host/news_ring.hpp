// What a driver has to say in its cycles, for somebody else to show.
#ifndef STRIDE_RUNTIME_HOST_NEWS_RING_HPP
#define STRIDE_RUNTIME_HOST_NEWS_RING_HPP

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::host {

/// Texts from one thread to another. Putting one in neither allocates, locks nor waits: when nobody
/// has taken the others yet, it is counted only.
class NewsRing {
public:
  static constexpr size_t kTexts = 16;
  static constexpr size_t kLongest = 255; ///< Longer ones are cut. [bytes]

  void put(std::string_view text) noexcept {
    const uint32_t at = put_.load(std::memory_order_relaxed);
    if (at - taken_.load(std::memory_order_acquire) == kTexts) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    Text &to = ring_[at % kTexts];
    to.size = std::min(text.size(), kLongest);
    std::copy_n(text.data(), to.size, to.bytes.data());
    put_.store(at + 1, std::memory_order_release);
  }

  /// The texts since the last call, and how many are missing.
  std::vector<std::string> take() {
    std::vector<std::string> texts;
    uint32_t at = taken_.load(std::memory_order_relaxed);
    for (const uint32_t end = put_.load(std::memory_order_acquire); at != end; ++at) {
      const Text &from = ring_[at % kTexts];
      texts.emplace_back(from.bytes.data(), from.size);
      taken_.store(at + 1, std::memory_order_release);
    }
    if (const uint64_t lost = lost_.exchange(0, std::memory_order_relaxed); lost != 0)
      texts.push_back(fmt::format("{} more pieces of news are not shown", lost));
    return texts;
  }

private:
  struct Text {
    std::array<char, kLongest> bytes;
    size_t size;
  };
  std::array<Text, kTexts> ring_;
  std::atomic<uint32_t> put_{0};
  std::atomic<uint32_t> taken_{0};
  std::atomic<uint64_t> lost_{0};
};

} // namespace stride::host

#endif
