#include "tests/bench/st/twin.h"

namespace {

struct Average {
  static constexpr int16_t kWindow = 32;
  double value;
  double mean;
  double ring[kWindow];
  int16_t at;
  int16_t filled;
  double sum;

  void update() {
    sum = sum - ring[at] + value;
    ring[at] = value;
    at = static_cast<int16_t>((at + 1) % kWindow);
    if (filled < kWindow)
      ++filled;
    mean = sum / filled;
  }
};

struct Plc {
  static constexpr int kChannels = 64;
  Average averages[kChannels];
  int16_t round;
  double checksum;

  void init() {}

  void cycle(int64_t) {
    for (int sample = 0; sample < 20; ++sample) {
      round = static_cast<int16_t>((round + 7) % 1000);
      for (int c = 0; c < kChannels; ++c) {
        averages[c].value = round + c + 1;
        averages[c].update();
      }
      checksum = checksum / 2.0 + averages[0].mean + averages[kChannels - 1].mean;
    }
  }
};

} // namespace

STRIDE_TWIN(Plc)
