#include "runtime/iec/strings.h"

#include <cstring>
#include <type_traits>

namespace stride::detail {

template <class C> uint32_t textLength(const C *s, uint32_t cap) {
  if constexpr (sizeof(C) == 1)
    return static_cast<uint32_t>(strnlen(s, cap));
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

namespace {

uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

} // namespace

template <class C>
void textPart(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap, uint32_t from,
              uint32_t count) {
  // No need to look behind the part.
  const uint32_t end = count < srcCap && from < srcCap - count ? from + count : srcCap;
  const uint32_t length = textLength(src, end);
  const uint32_t n = from < length ? smaller(length - from, smaller(count, dstCap)) : 0;
  std::memmove(dst, src + (n > 0 ? from : 0), n * sizeof(C));
  dst[n] = 0;
}

template <class C>
void textTail(C *dst, uint32_t dstCap, const C *src, uint32_t srcCap, uint32_t count) {
  const uint32_t length = textLength(src, srcCap);
  const uint32_t from = count < length ? length - count : 0;
  const uint32_t n = smaller(length - from, dstCap);
  std::memmove(dst, src + from, n * sizeof(C));
  dst[n] = 0;
}

template <class C>
void textSplice(C *dst, uint32_t dstCap, const C *a, uint32_t aCap, uint32_t from, uint32_t count,
                const C *b, uint32_t bCap) {
  const uint32_t aLength = textLength(a, aCap);
  const uint32_t bLength = b == nullptr ? 0 : textLength(b, bCap);
  from = smaller(from, aLength);
  const uint32_t behind = count < aLength - from ? from + count : aLength;
  // How much of the three parts fits.
  const uint32_t head = smaller(from, dstCap);
  const uint32_t middle = smaller(bLength, dstCap - head);
  const uint32_t tail = smaller(aLength - behind, dstCap - head - middle);
  const auto size = [](uint32_t n) { return n * sizeof(C); };
  if (dst == a && dst == b) { // REPLACE(s, s, 1, 1): the tail would overwrite what is inserted
    C *const copy = static_cast<C *>(__builtin_alloca(size(middle) + 1));
    std::memcpy(copy, b, size(middle));
    std::memmove(dst + head + middle, a + behind, size(tail));
    std::memcpy(dst + head, copy, size(middle));
  } else if (dst == b) {
    std::memmove(dst + head, b, size(middle));
    std::memcpy(dst, a, size(head));
    std::memcpy(dst + head + middle, a + behind, size(tail));
  } else {
    std::memmove(dst + head + middle, a + behind, size(tail));
    if (dst != a)
      std::memcpy(dst, a, size(head));
    if (middle > 0)
      std::memcpy(dst + head, b, size(middle));
  }
  dst[head + middle + tail] = 0;
}

template <class C> uint32_t textFind(const C *s, uint32_t cap, const C *what, uint32_t whatCap) {
  const uint32_t wanted = textLength(what, whatCap);
  if (wanted == 0)
    return 0;
  const uint32_t length = textLength(s, cap);
  if constexpr (sizeof(C) == 1) {
    const void *const found =
        wanted == 1 ? std::memchr(s, what[0], length) : memmem(s, length, what, wanted);
    return found == nullptr ? 0 : static_cast<uint32_t>(static_cast<const C *>(found) - s) + 1;
  }
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
template void textPart(char *, uint32_t, const char *, uint32_t, uint32_t, uint32_t);
template void textPart(char16_t *, uint32_t, const char16_t *, uint32_t, uint32_t, uint32_t);
template void textTail(char *, uint32_t, const char *, uint32_t, uint32_t);
template void textTail(char16_t *, uint32_t, const char16_t *, uint32_t, uint32_t);
template void textSplice(char *, uint32_t, const char *, uint32_t, uint32_t, uint32_t, const char *,
                         uint32_t);
template void textSplice(char16_t *, uint32_t, const char16_t *, uint32_t, uint32_t, uint32_t,
                         const char16_t *, uint32_t);
template uint32_t textFind(const char *, uint32_t, const char *, uint32_t);
template uint32_t textFind(const char16_t *, uint32_t, const char16_t *, uint32_t);

} // namespace stride::detail
