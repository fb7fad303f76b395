#include "drivers/io/simulated_io.hpp"

#include <algorithm>
#include <vector>

namespace stride::io::simulated {

namespace {

class SimulatedIo final : public IoDriver {
public:
  explicit SimulatedIo(const IoSettings &settings)
      : loopBack_(settings.parameters.flag("loop_back")),
        depth_(static_cast<uint32_t>(settings.parameters.number("delay")) + 1),
        bytes_(std::min(settings.inputBytes, settings.outputBytes)),
        history_(loopBack_ ? size_t{depth_} * bytes_ : 0), next_(loopBack_ ? bytes_ : 0) {}

  bool works(int64_t) noexcept override { return true; }

  bool read(uint32_t first, std::span<BYTE> to) noexcept override {
    if (!loopBack_)
      return false; // what is in the image stays
    for (uint32_t i = 0; i < to.size(); ++i) {
      const uint32_t byte = first + i;
      to[i] = byte < bytes_ ? oldest(byte) : BYTE{0};
    }
    return true;
  }

  void write(uint32_t first, std::span<const BYTE> from) noexcept override {
    for (uint32_t i = 0; loopBack_ && i < from.size() && first + i < bytes_; ++i) {
      const uint32_t byte = first + i;
      const uint32_t at = __atomic_load_n(&next_[byte], __ATOMIC_RELAXED);
      __atomic_store_n(&history_[size_t{byte} * depth_ + at], from[i], __ATOMIC_RELAXED);
      __atomic_store_n(&next_[byte], (at + 1) % depth_, __ATOMIC_RELEASE);
    }
  }

private:
  BYTE oldest(uint32_t byte) const noexcept {
    const uint32_t at = __atomic_load_n(&next_[byte], __ATOMIC_ACQUIRE);
    return __atomic_load_n(&history_[size_t{byte} * depth_ + at], __ATOMIC_RELAXED);
  }

  bool loopBack_;
  uint32_t depth_;
  uint32_t bytes_;
  std::vector<BYTE> history_;  ///< `depth_` values of each byte, in a ring.
  std::vector<uint32_t> next_; ///< By byte: where the next value goes, which is the oldest one.
};

} // namespace

std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings) {
  return std::make_unique<SimulatedIo>(settings);
}

} // namespace stride::io::simulated
