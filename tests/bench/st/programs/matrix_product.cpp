#include "tests/bench/st/twin.h"

namespace {

struct Plc {
  static constexpr int32_t kN = 48;
  double a[kN][kN];
  double b[kN][kN];
  double c[kN][kN];
  bool filled;
  double checksum;

  void init() {}

  void cycle(int64_t) {
    if (!filled) {
      for (int32_t i = 0; i < kN; ++i) {
        for (int32_t j = 0; j < kN; ++j) {
          a[i][j] = (((i + 1) * 7 + (j + 1) * 3) % 11) / 8.0;
          b[i][j] = (((i + 1) * 5 + (j + 1) * 2) % 13) / 16.0;
        }
      }
      filled = true;
    }
    for (int32_t i = 0; i < kN; ++i) {
      for (int32_t j = 0; j < kN; ++j) {
        double sum = 0;
        for (int32_t k = 0; k < kN; ++k)
          sum += a[i][k] * b[k][j];
        c[i][j] = sum;
      }
    }
    a[0][0] = c[kN - 1][kN - 1] / 1000.0;
    checksum = checksum + c[0][0] + c[kN - 1][2] + c[4][kN - 1];
  }
};

} // namespace

STRIDE_TWIN(Plc)
