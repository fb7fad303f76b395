// Variables that several tasks use: each access is one atomic step, and no more. Nothing is said
// about the order of accesses to different variables (relaxed), with one exception: whoever reads
// an address sees what had been written after it when it was stored (acquire, release). Free of
// the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_SHARED_H
#define STRIDE_RUNTIME_IEC_SHARED_H

#include "runtime/iec/types.h"

namespace stride {

template <class T> inline constexpr bool isAddress = false;
template <class T> inline constexpr bool isAddress<T *> = true;

/// The value of a variable that another task may write meanwhile.
template <class T> inline T load(const T &variable) {
  T value;
  __atomic_load(&variable, &value, isAddress<T> ? __ATOMIC_ACQUIRE : __ATOMIC_RELAXED);
  return value;
}

/// Stands for such a variable where it is written.
template <class T> struct Shared {
  T &variable;

  void operator=(T value) const {
    __atomic_store(&variable, &value, isAddress<T> ? __ATOMIC_RELEASE : __ATOMIC_RELAXED);
  }
  operator T() const { return load(variable); }
};
template <class T> inline Shared<T> shared(T &variable) { return {variable}; }

/// Sets or clears bit n: the other bits keep what other tasks write meanwhile.
template <class T> inline void setSharedBit(T &x, uint32_t n, bool value) {
  const T mask = static_cast<T>(T{1} << n);
  if (value)
    __atomic_fetch_or(&x, mask, __ATOMIC_RELAXED);
  else
    __atomic_fetch_and(&x, static_cast<T>(~mask), __ATOMIC_RELAXED);
}
/// Part n of a variable, a P of its width.
template <class P, class T> inline void setSharedPart(T &x, uint32_t n, P value) {
  const uint64_t shift = uint64_t{n} * sizeof(P) * 8;
  const uint64_t mask = uint64_t{static_cast<P>(~P{})} << shift;
  T old = load(x);
  T changed;
  do
    changed = static_cast<T>((static_cast<uint64_t>(old) & ~mask) | (uint64_t{value} << shift));
  while (!__atomic_compare_exchange(&x, &old, &changed, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED));
}
/// Bit n of an area of the process image.
inline BOOL getSharedBitAt(const BYTE *area, uint64_t n) {
  return static_cast<BOOL>((load(area[n >> 3U]) >> (n & 7U)) & 1U);
}
inline void setSharedBitAt(BYTE *area, uint64_t n, BOOL value) {
  setSharedBit(area[n >> 3U], static_cast<uint32_t>(n & 7U), value != 0);
}

/// The variable of a FOR loop (forUp … of ops.h).
template <class T> inline bool forUp(Shared<T> i, T end, ULINT step) {
  const T now = i;
  i = static_cast<T>(static_cast<ULINT>(now) + step);
  return now <= end && static_cast<ULINT>(end) - static_cast<ULINT>(now) >= step;
}
template <class T> inline bool forDown(Shared<T> i, T end, ULINT step) {
  const T now = i;
  i = static_cast<T>(static_cast<ULINT>(now) - step);
  return now >= end && static_cast<ULINT>(now) - static_cast<ULINT>(end) >= step;
}
template <class T> inline bool forUp(Shared<T> i, T end) { return forUp(i, end, ULINT{1}); }
template <class T> inline bool forDown(Shared<T> i, T end) { return forDown(i, end, ULINT{1}); }
template <class T> inline bool forNext(Shared<T> i, T end, LINT step) {
  return step < 0 ? forDown(i, end, ULINT{0} - static_cast<ULINT>(step))
                  : forUp(i, end, static_cast<ULINT>(step));
}

} // namespace stride

#endif
