// Variables with {attribute 'consistent'}: one task writes the variable; each other task that reads
// it has copies of its own, which never change while its cycle runs. A copy is given at the end of
// the writer's cycle and taken at the start of the reader's. Nobody locks, nobody waits.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_CONSISTENT_H
#define STRIDE_RUNTIME_IEC_CONSISTENT_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

/// What one task reads. Of the three copies the reader has one, the writer another; the third is
/// the last complete one, and each of them gets it by an exchange.
template <class T> struct TaskCopy {
  static constexpr BYTE kFresh = 4; ///< In `last`: the reader has not taken it yet.

  T copies[3];
  BYTE last;    ///< The index that changes hands.
  BYTE taken;   ///< The reader's.
  BYTE written; ///< The writer's.

  void reset(const T &variable) {
    __builtin_memcpy(&copies[0], &variable, sizeof(T));
    taken = 0;
    last = 1;
    written = 2;
  }
  void give(const T &variable) {
    __builtin_memcpy(&copies[written], &variable, sizeof(T));
    const auto full = static_cast<BYTE>(written | kFresh);
    written = static_cast<BYTE>(__atomic_exchange_n(&last, full, __ATOMIC_ACQ_REL) & 3);
  }
  T &take() {
    if ((__atomic_load_n(&last, __ATOMIC_RELAXED) & kFresh) != 0)
      taken = static_cast<BYTE>(__atomic_exchange_n(&last, taken, __ATOMIC_ACQ_REL) & 3);
    return copies[taken];
  }
};

/// Beside the variable in the state.
template <class T, uint32_t Tasks, uint32_t Readers> struct Consistent {
  ULINT places[Tasks]; ///< Where in the state each task reads the variable.
  TaskCopy<T> readers[Readers];

  /// All tasks read the variable itself: nobody runs yet.
  void begin(const Ctx &ctx, T &variable) {
    for (ULINT &place : places)
      place = placeOf(ctx, variable);
  }
  /// The variable has the value with which the tasks start; `tasks` are those that read it.
  void settle(const Ctx &ctx, T &variable, const uint32_t (&tasks)[Readers]) {
    begin(ctx, variable);
    for (uint32_t i = 0; i < Readers; ++i) {
      readers[i].reset(variable);
      places[tasks[i]] = placeOf(ctx, readers[i].copies[0]);
    }
  }
  /// At the start of a cycle of the reader with this number.
  void take(const Ctx &ctx, uint32_t reader) {
    places[ctx.taskIndex] = placeOf(ctx, readers[reader].take());
  }
  /// At the end of a cycle of the writer.
  void give(const T &variable) {
    for (TaskCopy<T> &reader : readers)
      reader.give(variable);
  }

private:
  static ULINT placeOf(const Ctx &ctx, const T &copy) {
    return static_cast<ULINT>(reinterpret_cast<const char *>(&copy) -
                              static_cast<const char *>(ctx.state));
  }
};

/// The variable as the task of the context sees it; `places` is where its Consistent lies.
template <class T> inline T &seen(Ctx &ctx, ULINT places) {
  return root<T>(ctx, (&root<ULINT>(ctx, places))[ctx.taskIndex]);
}

} // namespace stride

#endif
