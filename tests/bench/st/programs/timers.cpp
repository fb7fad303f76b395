#include "tests/bench/st/twin.h"

namespace {

struct OnDelay {
  bool in;
  uint32_t pt;
  bool q;
  uint32_t et;
  bool running;
  uint32_t last;

  void update(uint32_t now) {
    if (!in) {
      running = false;
      q = false;
      et = 0;
    } else if (!q) {
      if (!running) {
        running = true;
        last = now;
        et = 0;
      }
      if (et >= pt || now - last >= pt - et) {
        et = pt;
        q = true;
      } else {
        et += now - last;
      }
    }
    last = now;
  }
};

struct Plc {
  static constexpr int32_t kN = 1000;
  OnDelay timers[kN];
  int32_t ended;
  uint32_t elapsed;
  int64_t checksum;

  void init() {}

  void cycle(int64_t nowNs) {
    const uint32_t now = static_cast<uint32_t>(nowNs / 1000000);
    for (int32_t i = 0; i < kN; ++i) {
      OnDelay &timer = timers[i];
      timer.in = !timer.q;
      timer.pt = static_cast<uint32_t>(5 + (i + 1) % 50);
      timer.update(now);
      if (timer.q)
        ++ended;
      elapsed += timer.et;
    }
    checksum += ended + static_cast<int32_t>(elapsed);
  }
};

} // namespace

STRIDE_TWIN(Plc)
