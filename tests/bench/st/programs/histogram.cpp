#include "tests/bench/st/twin.h"

namespace {

struct Plc {
  static constexpr int32_t kSamples = 2000;
  static constexpr int32_t kClasses = 64;
  uint16_t samples[kSamples];
  uint32_t classes[kClasses];
  uint32_t sums[kClasses];
  uint32_t seed;
  int64_t checksum;

  void init() { seed = 99; }

  void cycle(int64_t) {
    for (int32_t i = 0; i < kSamples; ++i) {
      seed = seed * 1664525U + 1013904223U;
      samples[i] = static_cast<uint16_t>(seed >> 16U);
    }
    for (int32_t i = 0; i < kClasses; ++i)
      classes[i] = 0;
    for (int32_t i = 0; i < kSamples; ++i)
      ++classes[samples[i] / 1024];
    sums[0] = classes[0];
    for (int32_t i = 1; i < kClasses; ++i)
      sums[i] = sums[i - 1] + classes[i];
    checksum = checksum + sums[7] + sums[31] * 3U + sums[kClasses - 1];
  }
};

} // namespace

STRIDE_TWIN(Plc)
