#include "tests/bench/st/twin.h"

namespace {

using Values = int32_t[1000];

void quickSort(Values &a, int32_t low, int32_t high) {
  int32_t i = low;
  int32_t j = high;
  const int32_t pivot = a[(low + high) / 2];
  while (i <= j) {
    while (a[i] < pivot)
      ++i;
    while (a[j] > pivot)
      --j;
    if (i <= j) {
      const int32_t help = a[i];
      a[i] = a[j];
      a[j] = help;
      ++i;
      --j;
    }
  }
  if (low < j)
    quickSort(a, low, j);
  if (i < high)
    quickSort(a, i, high);
}

struct Plc {
  Values a;
  uint32_t seed;
  int64_t checksum;

  void init() { seed = 1; }

  void cycle(int64_t) {
    for (int32_t &value : a) {
      seed = seed * 1664525U + 1013904223U;
      value = static_cast<int32_t>(seed >> 8U);
    }
    quickSort(a, 0, 999);
    checksum = checksum * 3 + a[0] + a[500] + a[999];
  }
};

} // namespace

STRIDE_TWIN(Plc)
