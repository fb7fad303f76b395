#include "tests/bench/st/twin.h"

namespace {

struct Plc {
  static constexpr int kW = 40;
  static constexpr int kH = 30;
  float plate[kH + 2][kW + 2];
  float next[kH + 2][kW + 2];
  double checksum;

  void init() {}

  void cycle(int64_t) {
    for (int x = 0; x <= kW + 1; ++x)
      plate[0][x] = 100.0F;
    for (int round = 0; round < 4; ++round) {
      for (int y = 1; y <= kH; ++y) {
        for (int x = 1; x <= kW; ++x)
          next[y][x] = plate[y][x] + 0.2F * (plate[y - 1][x] + plate[y + 1][x] + plate[y][x - 1] +
                                             plate[y][x + 1] - 4.0F * plate[y][x]);
      }
      for (int y = 1; y <= kH; ++y) {
        for (int x = 1; x <= kW; ++x)
          plate[y][x] = next[y][x];
      }
    }
    checksum = static_cast<double>(plate[1][1] + plate[kH / 2][kW / 2] + plate[kH][kW]);
  }
};

} // namespace

STRIDE_TWIN(Plc)
