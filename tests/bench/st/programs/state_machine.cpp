#include "tests/bench/st/twin.h"

namespace {

enum Phase : int16_t { kIdle, kPositioning, kFilling, kDraining, kClosing, kLeaving, kFault };

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
    case kIdle:
      valve = false;
      clamp = false;
      if (start) {
        state = kPositioning;
        wait = 3;
      }
      break;
    case kPositioning:
      --wait;
      if (wait <= 0) {
        clamp = true;
        state = kFilling;
      }
      break;
    case kFilling:
      valve = true;
      if (level > 95) {
        state = kDraining;
        wait = 2;
      } else if (level < 0) {
        state = kFault;
      }
      break;
    case kDraining:
      valve = false;
      --wait;
      if (wait <= 0)
        state = kClosing;
      break;
    case kClosing:
      clamp = false;
      state = kLeaving;
      break;
    case kLeaving:
      ++done;
      state = kIdle;
      break;
    default:
      valve = false;
      state = kIdle;
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
