#include "tests/bench/st/twin.h"

namespace {

using Table = int32_t[1000];

int32_t search(const Table &table, int32_t key) {
  int32_t low = 1;
  int32_t high = 1000;
  while (low <= high) {
    const int32_t middle = (low + high) / 2;
    const int32_t value = table[middle - 1];
    if (value == key)
      return middle;
    if (value < key)
      low = middle + 1;
    else
      high = middle - 1;
  }
  return 0;
}

struct Plc {
  Table table;
  uint32_t key;
  int64_t checksum;

  void init() { key = 12345; }

  void cycle(int64_t) {
    if (table[1] == 0) {
      for (int32_t i = 0; i < 1000; ++i)
        table[i] = (i + 1) * 3;
    }
    for (int32_t i = 0; i < 500; ++i) {
      key = key * 1664525U + 1013904223U;
      checksum += search(table, static_cast<int32_t>((key >> 16U) % 3000U));
    }
  }
};

} // namespace

STRIDE_TWIN(Plc)
