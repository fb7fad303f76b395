#include "tests/bench/st/twin.h"

namespace {

struct Plc {
  static constexpr int kN = 200;
  int16_t a[kN];
  uint32_t seed;
  int64_t checksum;

  void init() { seed = 1; }

  void cycle(int64_t) {
    for (int i = 0; i < kN; ++i) {
      seed = seed * 1664525U + 1013904223U;
      a[i] = static_cast<int16_t>(seed >> 17U);
    }
    int last = kN - 1;
    bool swapped = false;
    do {
      swapped = false;
      for (int i = 0; i < last; ++i) {
        if (a[i] > a[i + 1]) {
          const int16_t help = a[i];
          a[i] = a[i + 1];
          a[i + 1] = help;
          swapped = true;
        }
      }
      --last;
    } while (swapped);
    checksum = checksum * 3 + a[0] + a[kN / 2 - 1] + a[kN - 1];
  }
};

} // namespace

STRIDE_TWIN(Plc)
