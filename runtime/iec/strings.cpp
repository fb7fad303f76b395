#include "runtime/iec/strings.h"

#include <cstring>
#include <type_traits>

namespace stride::detail {

template <class C> uint32_t textLength(const C *s, uint32_t cap) {
  uint32_t n = 0;
  while (n < cap && s[n] != 0)
    ++n;
  return n;
}

template <class C> void textCopy(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap) {
  const uint32_t n = textLength(src, srcCap < dstCap ? srcCap : dstCap);
  std::memmove(dst, src, n * sizeof(C));
  dst[n] = 0;
}

template <class C> int textCompare(const C *a, uint32_t aCap, const C *b, uint32_t bCap) {
  using U = std::make_unsigned_t<std::conditional_t<sizeof(C) == 1, char, uint16_t>>;
  for (uint32_t i = 0;; ++i) {
    const U x = i < aCap ? static_cast<U>(a[i]) : U{0};
    const U y = i < bCap ? static_cast<U>(b[i]) : U{0};
    if (x != y)
      return x < y ? -1 : 1;
    if (x == 0)
      return 0;
  }
}

template <class C>
void textAppend(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap, uint32_t from,
                uint32_t count) {
  const uint32_t have = textLength(dst, dstCap);
  const uint32_t length = textLength(src, srcCap);
  if (from >= length)
    return;
  uint32_t n = length - from;
  n = n < count ? n : count;
  n = n < dstCap - have ? n : dstCap - have;
  std::memmove(dst + have, src + from, n * sizeof(C));
  dst[have + n] = 0;
}

template <class C> uint32_t textFind(const C *s, uint32_t cap, const C *what, uint32_t whatCap) {
  const uint32_t length = textLength(s, cap);
  const uint32_t wanted = textLength(what, whatCap);
  if (wanted == 0)
    return 0;
  for (uint32_t i = 0; i + wanted <= length; ++i) {
    if (std::memcmp(s + i, what, wanted * sizeof(C)) == 0)
      return i + 1;
  }
  return 0;
}

template uint32_t textLength(const char *, uint32_t);
template uint32_t textLength(const char16_t *, uint32_t);
template void textCopy(char *, uint32_t, const char *, uint32_t);
template void textCopy(char16_t *, uint32_t, const char16_t *, uint32_t);
template int textCompare(const char *, uint32_t, const char *, uint32_t);
template int textCompare(const char16_t *, uint32_t, const char16_t *, uint32_t);
template void textAppend(char *, uint32_t, const char *, uint32_t, uint32_t, uint32_t);
template void textAppend(char16_t *, uint32_t, const char16_t *, uint32_t, uint32_t, uint32_t);
template uint32_t textFind(const char *, uint32_t, const char *, uint32_t);
template uint32_t textFind(const char16_t *, uint32_t, const char16_t *, uint32_t);

} // namespace stride::detail
