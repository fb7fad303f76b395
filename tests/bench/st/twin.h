// What a hand-written twin offers to the harness: its state, made zero by the harness, and one
// cycle.
#ifndef STRIDE_TESTS_BENCH_ST_TWIN_H
#define STRIDE_TESTS_BENCH_ST_TWIN_H

#include <stddef.h>
#include <stdint.h>

struct Twin {
  size_t size;
  void (*init)(void *state);
  void (*cycle)(void *state, int64_t nowNs);
  uint64_t (*checksum)(const void *state); ///< the eight bytes of PLC_PRG.Checksum
};

/// Describes the class Plc, which has init(), cycle(int64_t nowNs) and the member checksum.
template <class Plc> constexpr Twin twinOf() {
  static_assert(sizeof(Plc::checksum) == 8);
  return {sizeof(Plc), [](void *state) { static_cast<Plc *>(state)->init(); },
          [](void *state, int64_t nowNs) { static_cast<Plc *>(state)->cycle(nowNs); },
          [](const void *state) {
            uint64_t bits = 0;
            __builtin_memcpy(&bits, &static_cast<const Plc *>(state)->checksum, sizeof bits);
            return bits;
          }};
}

#define STRIDE_TWIN(Plc)                                                                           \
  extern "C" __attribute__((visibility("default"))) const Twin stride_twin = twinOf<Plc>();

#endif
