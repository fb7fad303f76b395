#include "tests/bench/st/twin.h"

#include <string.h>

namespace {

struct Telegram {
  uint32_t id;
  int64_t stamp;
  double values[16];
  char name[21];
  bool valid;
};

struct Queue {
  Telegram at[64];
};

uint32_t shift(Queue &queue) {
  const Telegram first = queue.at[0];
  for (int32_t i = 0; i < 63; ++i)
    queue.at[i] = queue.at[i + 1];
  queue.at[63] = first;
  return first.id;
}

struct Plc {
  Queue live;
  Queue backup;
  bool ready;
  int64_t checksum;

  void init() {}

  void cycle(int64_t) {
    if (!ready) {
      for (int32_t i = 0; i < 64; ++i) {
        Telegram &t = live.at[i];
        t.id = static_cast<uint32_t>(i * 3);
        t.stamp = i;
        t.values[i % 16] = i;
        strcpy(t.name, "telegram");
        t.valid = true;
      }
      ready = true;
    }
    backup = live;
    for (int32_t i = 0; i < 32; ++i) {
      const Telegram help = live.at[i];
      live.at[i] = live.at[63 - i];
      live.at[63 - i] = help;
    }
    checksum += shift(live);
    checksum += shift(backup);
    ++backup.at[5].stamp;
    live.at[6] = backup.at[5];
    checksum += live.at[6].stamp;
  }
};

} // namespace

STRIDE_TWIN(Plc)
