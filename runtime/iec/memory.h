// Pointers, characters of strings and copies: what generated code does with memory.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_MEMORY_H
#define STRIDE_RUNTIME_IEC_MEMORY_H

#include "runtime/iec/convert.h"
#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

namespace detail {
template <class T> inline UXINT addressOf(T *p) { return reinterpret_cast<UXINT>(p); }
/// No variable lies below.
inline constexpr UXINT kFirstAddress = 65536;
} // namespace detail

/// p + n and p - n: bytes.
template <class T, class N> inline T *advance(T *p, N n) {
  return reinterpret_cast<T *>(detail::addressOf(p) + static_cast<UXINT>(n));
}
template <class T, class N> inline T *retreat(T *p, N n) {
  return reinterpret_cast<T *>(detail::addressOf(p) - static_cast<UXINT>(n));
}
/// p - q in bytes.
template <class T, class U> inline UXINT distance(T *p, U *q) {
  return detail::addressOf(p) - detail::addressOf(q);
}

/// p[i]: the i-th element behind a pointer; raises as deref does.
template <class X, class T, class I>
inline T &element(X &ctx, T *p, I i, const char *file, uint32_t line, uint32_t col) {
  if (detail::addressOf(p) < detail::kFirstAddress) [[unlikely]]
    raisePointer(ctx, p, file, line, col);
  return *advance(p, static_cast<UXINT>(i) * sizeof(T));
}
template <class T, class I> inline T &elementAt(T *p, I i) {
  return *advance(p, static_cast<UXINT>(i) * sizeof(T));
}

namespace detail {
template <class S> struct CharacterOf;
template <uint32_t N> struct CharacterOf<STRING<N>> { using Type = BYTE; };
template <uint32_t N> struct CharacterOf<WSTRING<N>> { using Type = WORD; };
} // namespace detail

/// s[i]: a character of a string, counted from 0, the end mark included; raises IndexOutOfRange at
/// the position.
template <class X, class S, class I>
inline auto character(X &ctx, S &s, I i, const char *file, uint32_t line, uint32_t col) ->
    typename detail::CharacterOf<S>::Type & {
  const int64_t at = static_cast<int64_t>(i);
  if (at < 0 || at > int64_t{S::kLength}) [[unlikely]]
    raiseIndex(ctx, at, 0, S::kLength, file, line, col);
  return reinterpret_cast<typename detail::CharacterOf<S>::Type &>(s.s[at]);
}
/// The same of a value that is no variable.
template <class X, class S, class I>
inline auto character(X &ctx, const S &s, I i, const char *file, uint32_t line, uint32_t col) ->
    typename detail::CharacterOf<S>::Type {
  return character(ctx, const_cast<S &>(s), i, file, line, col);
}
template <class S, class I>
inline auto characterAt(S &s, I i) -> typename detail::CharacterOf<S>::Type & {
  return reinterpret_cast<typename detail::CharacterOf<S>::Type &>(s.s[static_cast<int64_t>(i)]);
}
template <class S, class I>
inline auto characterAt(const S &s, I i) -> typename detail::CharacterOf<S>::Type {
  return characterAt(const_cast<S &>(s), i);
}
/// p[i] of a POINTER TO STRING: the characters from there on, without bounds.
template <class X, class S, class I>
inline auto character(X &ctx, S *p, I i, const char *file, uint32_t line, uint32_t col) ->
    typename detail::CharacterOf<S>::Type & {
  return element(ctx, reinterpret_cast<typename detail::CharacterOf<S>::Type *>(p), i, file, line,
                 col);
}
template <class S, class I>
inline auto characterAt(S *p, I i) -> typename detail::CharacterOf<S>::Type & {
  return elementAt(reinterpret_cast<typename detail::CharacterOf<S>::Type *>(p), i);
}

/// to := from for variables of one size that may overlap.
template <class To, class From> inline void copy(To &to, const From &from) {
  static_assert(sizeof(To) == sizeof(From), "arrays of one shape");
  __builtin_memmove(&to, &from, sizeof(To));
}

} // namespace stride

#endif
