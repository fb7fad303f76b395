#include "tests/bench/st/twin.h"

namespace {

enum Phase : int16_t { Idle, Positioning, Filling, Draining, Closing, Leaving, Fault };

struct Station {
  bool start;
  int16_t level;
  bool valve;
  bool clamp;
  int32_t done;
  Phase state;
  int16_t wait;

  void update() {
    switch (state) {
    case idle:
      valve = false;
      clamp = false;
      if (start) {
        state = positioning;
        wait = 3;
      }
      break;
    case positioning:
      --wait;
      if (wait <= 0) {
        clamp = true;
        state = filling;
      }
      break;
    case filling:
      valve = true;
      if (level > 95) {
        state = draining;
        wait = 2;
      } else if (level < 0) {
        state = fault;
      }
      break;
    case draining:
      valve = false;
      --wait;
      if (wait <= 0)
        state = closing;
      break;
    case closing:
      clamp = false;
      state = leaving;
      break;
    case leaving:
      ++done;
      state = idle;
      break;
    default:
      valve = false;
      state = idle;
      break;
    }
  }
};

struct Plc {
  static constexpr int kN = 100;
  Station stations[kN];
  int16_t levels[kN];
  int32_t open;
  int64_t checksum;

  void init() {}

  void cycle(int64_t) {
    for (int i = 0; i < kN; ++i) {
      Station &station = stations[i];
      station.start = (i + 1) % 3 != 0;
      station.level = levels[i];
      station.update();
      if (station.valve) {
        levels[i] = static_cast<int16_t>(levels[i] + 5 + (i + 1) % 7);
        ++open;
      } else if (levels[i] > 0) {
        levels[i] = static_cast<int16_t>(levels[i] / 2);
      }
      checksum += station.done;
    }
    checksum += open;
  }
};

} // namespace

STRIDE_TWIN(Plc)
