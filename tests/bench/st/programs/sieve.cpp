#include "tests/bench/st/twin.h"

namespace {

struct Plc {
  static constexpr int32_t kLimit = 8191;
  bool composite[kLimit - 1];
  int64_t checksum;

  void init() {}

  void cycle(int64_t) {
    for (int32_t i = 2; i <= kLimit; ++i)
      composite[i - 2] = false;
    int32_t count = 0;
    for (int32_t i = 2; i <= kLimit; ++i) {
      if (!composite[i - 2]) {
        ++count;
        for (int32_t k = i + i; k <= kLimit; k += i)
          composite[k - 2] = true;
      }
    }
    checksum += count;
  }
};

} // namespace

STRIDE_TWIN(Plc)
