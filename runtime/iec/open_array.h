// ARRAY[*]: what a VAR_IN_OUT of it holds, and its elements.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_OPEN_ARRAY_H
#define STRIDE_RUNTIME_IEC_OPEN_ARRAY_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

/// ARRAY[*, …] OF T with N dimensions: where the caller's array lies, and its bounds. The address
/// is the first member, so that the whole is an address slot like any other VAR_IN_OUT.
template <class T, uint32_t N> struct OpenArray {
  T *data;
  int64_t lo[N];
  int64_t hi[N];
};

namespace detail {

template <class A, uint32_t N> struct Bounds;
template <class T, int64_t Lo, int64_t Hi, uint32_t N> struct Bounds<Array<T, Lo, Hi>, N> {
  static constexpr void set(int64_t *lo, int64_t *hi) {
    *lo = Lo;
    *hi = Hi;
    if constexpr (N > 1)
      Bounds<T, N - 1>::set(lo + 1, hi + 1);
  }
};

} // namespace detail

/// The first N dimensions of an array of fixed bounds, whose elements are T.
template <class T, uint32_t N, class A> inline OpenArray<T, N> open(A &array) {
  OpenArray<T, N> r;
  r.data = reinterpret_cast<T *>(&array);
  detail::Bounds<A, N>::set(r.lo, r.hi);
  return r;
}

namespace detail {

/// Elements of all dimensions after the first one.
template <class T, uint32_t N> inline uint64_t rowSize(const OpenArray<T, N> &a) {
  uint64_t size = 1;
  for (uint32_t d = 1; d < N; ++d)
    size *= static_cast<uint64_t>(a.hi[d] - a.lo[d]) + 1;
  return size;
}

template <class T, uint32_t N>
inline OpenArray<T, N - 1> row(const OpenArray<T, N> &a, uint64_t place) {
  OpenArray<T, N - 1> r;
  r.data = a.data + place * rowSize(a);
  for (uint32_t d = 1; d < N; ++d) {
    r.lo[d - 1] = a.lo[d];
    r.hi[d - 1] = a.hi[d];
  }
  return r;
}

template <class X, class I>
inline uint64_t checkedPlace(X &ctx, I i, int64_t lo, int64_t hi, const char *file, uint32_t line,
                             uint32_t col) {
  const int64_t at = static_cast<int64_t>(i);
  if (at < lo || at > hi) [[unlikely]]
    raiseIndex(ctx, at, lo, hi, file, line, col);
  return static_cast<uint64_t>(at) - static_cast<uint64_t>(lo);
}

} // namespace detail

/// a[i]: an element, or the array of the dimensions after; raises IndexOutOfRange at the position.
template <class X, class T, class I>
inline T &at(X &ctx, const OpenArray<T, 1> &a, I i, const char *file, uint32_t line, uint32_t col) {
  return a.data[detail::checkedPlace(ctx, i, a.lo[0], a.hi[0], file, line, col)];
}
template <class X, class T, uint32_t N, class I>
inline OpenArray<T, N - 1> at(X &ctx, const OpenArray<T, N> &a, I i, const char *file,
                              uint32_t line, uint32_t col) {
  return detail::row(a, detail::checkedPlace(ctx, i, a.lo[0], a.hi[0], file, line, col));
}
/// The same without a check (--unchecked).
template <class T, class I> inline T &atPlace(const OpenArray<T, 1> &a, I i) {
  return a.data[static_cast<int64_t>(i) - a.lo[0]];
}
template <class T, uint32_t N, class I>
inline OpenArray<T, N - 1> atPlace(const OpenArray<T, N> &a, I i) {
  return detail::row(a, static_cast<uint64_t>(static_cast<int64_t>(i) - a.lo[0]));
}

/// The actual of a VAR_IN_OUT; raises UnboundInOut at the position.
template <class X, class T, uint32_t N>
inline OpenArray<T, N> &bound(X &ctx, OpenArray<T, N> &a, const char *file, uint32_t line,
                              uint32_t col) {
  if (a.data == nullptr) [[unlikely]]
    raise(ctx, ExceptionCode::UnboundInOut, file, line, col);
  return a;
}

/// A C++ structure is assigned member by member where it holds in-outs or places in the process
/// image: assign__ leaves those of the target as they are. Arrays element by element.
template <class T, int64_t Lo, int64_t Hi>
inline void assignBound(Ctx &ctx, Array<T, Lo, Hi> &to, const Array<T, Lo, Hi> &from);
template <class T> inline void assignBound(Ctx &ctx, T &to, const T &from) {
  to.assign__(ctx, from);
}
template <class T, int64_t Lo, int64_t Hi>
inline void assignBound(Ctx &ctx, Array<T, Lo, Hi> &to, const Array<T, Lo, Hi> &from) {
  for (uint64_t i = 0; i < Array<T, Lo, Hi>::kSize; ++i)
    assignBound(ctx, to.v[i], from.v[i]);
}

/// An array as one with other bounds and the same elements.
template <class To, class From> inline const To &reshape(const From &from) {
  static_assert(sizeof(To) == sizeof(From), "arrays of one shape");
  return reinterpret_cast<const To &>(from);
}

} // namespace stride

#endif
