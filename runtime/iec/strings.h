// STRING and WSTRING: assignment, comparison and the standard string functions.
// Free of the C++ standard library; see types.h.
//
// Texts end at the first NUL or at the declared length. Assignment truncates. Positions count
// from 1. Comparison is by code unit, unsigned.
#ifndef STRIDE_RUNTIME_IEC_STRINGS_H
#define STRIDE_RUNTIME_IEC_STRINGS_H

#include "runtime/iec/types.h"

namespace stride {

namespace detail {

// Out-of-line workers, defined for char and char16_t. `cap` is a declared length: the buffer has
// cap + 1 places. Destinations may be sources, but must not overlap them otherwise.
template <class C> uint32_t textLength(const C *s, uint32_t cap);
template <class C> void textCopy(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap);
template <class C> int textCompare(const C *a, uint32_t aCap, const C *b, uint32_t bCap);
/// dst := the part [from, from + count) of src.
template <class C>
void textPart(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap, uint32_t from,
              uint32_t count);
/// dst := the last `count` characters of src.
template <class C>
void textTail(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap, uint32_t count);
/// dst := a with b in place of the part [from, from + count) of it; b may be null.
template <class C>
void textSplice(C *dst, uint32_t dstCap, const C *a, uint32_t aCap, uint32_t from, uint32_t count,
                const C *b, uint32_t bCap);
template <class C> uint32_t textFind(const C *s, uint32_t cap, const C *what, uint32_t whatCap);

inline constexpr uint32_t kRest = 0xFFFFFFFFU;

constexpr uint32_t clampCount(int64_t n) {
  if (n < 0)
    return 0;
  return n > int64_t{kRest} - 1 ? kRest - 1 : static_cast<uint32_t>(n);
}

/// A number of characters or a position, of any integer type. An ULINT beyond LINT is LINT's
/// largest value: by a plain conversion it would be below 0.
struct Count {
  int64_t value;
  template <class T> constexpr Count(T n) : value(static_cast<int64_t>(n)) {
    if (n > 0 && value < 0)
      value = INT64_MAX;
  }
  /// As the number of characters that come first.
  [[nodiscard]] constexpr uint32_t characters() const { return clampCount(value); }
  /// As a position, which counts from 1: the number of characters before it.
  [[nodiscard]] constexpr uint32_t before() const {
    return clampCount(value - (value > 0 ? 1 : 0));
  }
};

} // namespace detail

/// A literal as a value: lit("abc") is a STRING<3>, lit(u"abc") a WSTRING<3>. It is not copied.
template <uint32_t K> inline const STRING<K - 1> &lit(const char (&text)[K]) {
  return reinterpret_cast<const STRING<K - 1> &>(text);
}
template <uint32_t K> inline const WSTRING<K - 1> &lit(const char16_t (&text)[K]) {
  return reinterpret_cast<const WSTRING<K - 1> &>(text);
}

/// dst := src between any declared lengths; cuts what does not fit.
template <template <uint32_t> class S, uint32_t N, uint32_t M>
inline void assign(S<N> &dst, const S<M> &src) {
  detail::textCopy(dst.s, N, src.s, M);
}
template <uint32_t N, uint32_t K> inline void assign(STRING<N> &dst, const char (&text)[K]) {
  __builtin_memcpy(dst.s, text, K - 1 < N ? K : N);
  dst.s[K - 1 < N ? K - 1 : N] = 0;
}
template <uint32_t N, uint32_t K> inline void assign(WSTRING<N> &dst, const char16_t (&text)[K]) {
  __builtin_memcpy(dst.s, text, (K - 1 < N ? K : N) * sizeof(char16_t));
  dst.s[K - 1 < N ? K - 1 : N] = 0;
}
/// A copy with another declared length.
template <uint32_t N, template <uint32_t> class S, uint32_t M> inline S<N> resize(const S<M> &s) {
  S<N> r;
  detail::textCopy(r.s, N, s.s, M);
  return r;
}

/// Below 0, 0 or above 0 as a is less than, equal to or greater than b.
template <template <uint32_t> class S, uint32_t N, uint32_t M>
inline int compare(const S<N> &a, const S<M> &b) {
  return detail::textCompare(a.s, N, b.s, M);
}

namespace detail {
template <bool Long> struct PositionOf { using Type = INT; };
template <> struct PositionOf<true> { using Type = DINT; };
} // namespace detail

/// A number or position of the characters of a text declared with N: INT as far as it suffices.
template <uint32_t N> using Position = typename detail::PositionOf<(N > 32767)>::Type;

/// LEN.
template <template <uint32_t> class S, uint32_t N> inline Position<N> len(const S<N> &s) {
  return static_cast<Position<N>>(detail::textLength(s.s, N));
}

// The functions that make strings exist twice: with the target as first argument (which may be one
// of the others), and giving a string of length R. A target takes at most R characters.

/// LEFT(s, n): the first n characters.
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N>
inline void left(S<K> &to, const S<N> &s, detail::Count n) {
  detail::textPart(to.s, R < K ? R : K, s.s, N, 0, n.characters());
}
/// RIGHT(s, n): the last n characters.
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N>
inline void right(S<K> &to, const S<N> &s, detail::Count n) {
  detail::textTail(to.s, R < K ? R : K, s.s, N, n.characters());
}
/// MID(s, n, p): n characters from position p. Positions below 1 count as 1.
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N>
inline void mid(S<K> &to, const S<N> &s, detail::Count n, detail::Count p) {
  detail::textPart(to.s, R < K ? R : K, s.s, N, p.before(), n.characters());
}
/// CONCAT(a, b).
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N, uint32_t M>
inline void concat(S<K> &to, const S<N> &a, const S<M> &b) {
  detail::textSplice(to.s, R < K ? R : K, a.s, N, detail::kRest, 0, b.s, M);
}
/// REPLACE(a, b, n, p): b in place of n characters of a from position p.
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N, uint32_t M>
inline void replace(S<K> &to, const S<N> &a, const S<M> &b, detail::Count n, detail::Count p) {
  detail::textSplice(to.s, R < K ? R : K, a.s, N, p.before(), n.characters(), b.s, M);
}
/// INSERT(a, b, p): b inserted after character p of a.
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N, uint32_t M>
inline void insert(S<K> &to, const S<N> &a, const S<M> &b, detail::Count p) {
  detail::textSplice(to.s, R < K ? R : K, a.s, N, p.characters(), 0, b.s, M);
}
/// DELETE(s, n, p): without n characters from position p.
template <uint32_t R, template <uint32_t> class S, uint32_t K, uint32_t N>
inline void remove(S<K> &to, const S<N> &s, detail::Count n, detail::Count p) {
  detail::textSplice(to.s, R < K ? R : K, s.s, N, p.before(), n.characters(),
                     static_cast<decltype(&s.s[0])>(nullptr), 0);
}

template <uint32_t R = 255, template <uint32_t> class S, uint32_t N>
inline S<R> left(const S<N> &s, detail::Count n) {
  S<R> r;
  left<R>(r, s, n);
  return r;
}
template <uint32_t R = 255, template <uint32_t> class S, uint32_t N>
inline S<R> right(const S<N> &s, detail::Count n) {
  S<R> r;
  right<R>(r, s, n);
  return r;
}
template <uint32_t R = 255, template <uint32_t> class S, uint32_t N>
inline S<R> mid(const S<N> &s, detail::Count n, detail::Count p) {
  S<R> r;
  mid<R>(r, s, n, p);
  return r;
}
template <uint32_t R = 255, template <uint32_t> class S, uint32_t N, uint32_t M>
inline S<R> concat(const S<N> &a, const S<M> &b) {
  S<R> r;
  concat<R>(r, a, b);
  return r;
}
template <uint32_t R = 255, template <uint32_t> class S, uint32_t N, uint32_t M>
inline S<R> replace(const S<N> &a, const S<M> &b, detail::Count n, detail::Count p) {
  S<R> r;
  replace<R>(r, a, b, n, p);
  return r;
}
template <uint32_t R = 255, template <uint32_t> class S, uint32_t N, uint32_t M>
inline S<R> insert(const S<N> &a, const S<M> &b, detail::Count p) {
  S<R> r;
  insert<R>(r, a, b, p);
  return r;
}
template <uint32_t R = 255, template <uint32_t> class S, uint32_t N>
inline S<R> remove(const S<N> &s, detail::Count n, detail::Count p) {
  S<R> r;
  remove<R>(r, s, n, p);
  return r;
}
/// FIND(a, b): position of the first b in a, 0 when there is none or b is empty.
template <template <uint32_t> class S, uint32_t N, uint32_t M>
inline Position<N> find(const S<N> &a, const S<M> &b) {
  return static_cast<Position<N>>(detail::textFind(a.s, N, b.s, M));
}

} // namespace stride

#endif
