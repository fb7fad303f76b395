// Bytes of an I/O device that is a node of a bus: the tasks that use them and the driver of the bus
// meet here.
#ifndef STRIDE_RUNTIME_COMMON_IO_EXCHANGE_HPP
#define STRIDE_RUNTIME_COMMON_IO_EXCHANGE_HPP

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace stride::common {

/// Bytes in one direction. Values of up to 8 bytes at aligned places are never seen in halves.
/// Neither side waits, allocates or throws.
class ExchangedBytes {
public:
  explicit ExchangedBytes(size_t count) : words_((count + 7) / 8), count_(count) {}

  [[nodiscard]] size_t size() const { return count_; }
  /// What lies beyond the end is 0.
  void read(size_t first, std::span<uint8_t> to) const noexcept {
    const size_t known = first < count_ ? std::min(to.size(), count_ - first) : 0;
    for (size_t at = known; at < to.size(); ++at)
      to[at] = 0;
    each(first, known, [&](auto *place, size_t at) {
      const auto value = __atomic_load_n(place, __ATOMIC_RELAXED);
      __builtin_memcpy(to.data() + at, &value, sizeof value);
    });
  }
  /// What lies beyond the end is nobody's.
  void write(size_t first, std::span<const uint8_t> from) noexcept {
    const size_t known = first < count_ ? std::min(from.size(), count_ - first) : 0;
    each(first, known, [&](auto *place, size_t at) {
      std::remove_reference_t<decltype(*place)> value;
      __builtin_memcpy(&value, from.data() + at, sizeof value);
      __atomic_store_n(place, value, __ATOMIC_RELAXED);
    });
  }

private:
  /// Step by step, with the longest step that the place allows.
  template <class Visit> void each(size_t first, size_t count, const Visit &visit) const noexcept {
    auto *const bytes = reinterpret_cast<uint8_t *>(const_cast<uint64_t *>(words_.data()));
    for (size_t at = 0; at < count;) {
      const size_t place = first + at;
      const size_t rest = count - at;
      if (place % 8 == 0 && rest >= 8) {
        visit(reinterpret_cast<uint64_t *>(bytes + place), at);
        at += 8;
      } else if (place % 4 == 0 && rest >= 4) {
        visit(reinterpret_cast<uint32_t *>(bytes + place), at);
        at += 4;
      } else if (place % 2 == 0 && rest >= 2) {
        visit(reinterpret_cast<uint16_t *>(bytes + place), at);
        at += 2;
      } else {
        visit(bytes + place, at);
        ++at;
      }
    }
  }

  std::vector<uint64_t> words_;
  size_t count_;
};

/// One device. The driver of its bus takes part as soon as it is made; without one the device does
/// not work.
struct IoExchange {
  IoExchange(size_t inputBytes, size_t outputBytes)
      : inputs(inputBytes), outputs(outputBytes), terminals(inputBytes) {}

  ExchangedBytes inputs;  ///< As the node has told.
  ExchangedBytes outputs; ///< That it is told.
  /// The node has started, answers, and has told its inputs.
  std::atomic<bool> works{false};
  std::atomic<bool> begun{false}; ///< It has worked once.

  // Of simulated nodes, whose world is the program's own:
  std::atomic<bool> simulated{false};
  ExchangedBytes terminals;        ///< What the world has at the node's inputs.
  std::atomic<bool> pulled{false}; ///< Its connector is off.
};

} // namespace stride::common

#endif
