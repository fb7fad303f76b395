// Elementary values as text and back: X_TO_STRING and STRING_TO_X, and the workers below them that
// the symbol table and the compiler's constant folder use as well.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_TEXT_H
#define STRIDE_RUNTIME_IEC_TEXT_H

#include "runtime/iec/convert.h"
#include "runtime/iec/strings.h"
#include "runtime/iec/types.h"

namespace stride {

namespace text {

/// Room that any elementary value's text fits in, including the NUL.
inline constexpr uint32_t kBufferSize = 48;

// Each writes at most kBufferSize characters with a NUL and returns the length without it.
uint32_t formatSigned(char *out, int64_t value);
uint32_t formatUnsigned(char *out, uint64_t value);
/// Shortest text that reads back as the same value, with at least one decimal: 100.0, 0.1, 1.0e+20,
/// NaN, Infinity, -Infinity.
uint32_t formatLreal(char *out, LREAL value);
uint32_t formatReal(char *out, REAL value);
/// T#1s500ms, T#0ms; LTIME#1s500ms2us; D#2000-01-31; TOD#13:05:00.250; DT#2000-01-31-13:05:00.
uint32_t formatTime(char *out, TIME value);
uint32_t formatLtime(char *out, LTIME value);
uint32_t formatDate(char *out, DATE value);
uint32_t formatLdate(char *out, LDATE value);
uint32_t formatTod(char *out, TOD value);
uint32_t formatLtod(char *out, LTOD value);
uint32_t formatDt(char *out, DT value);
uint32_t formatLdt(char *out, LDT value);
/// Any elementary value but strings; `value` points to it.
uint32_t formatValue(char *out, Kind kind, const void *value);

/// What a scan found. `used` counts the characters read from the start, 0 when there is no value.
struct Scanned {
  uint32_t used;
  bool negative;      ///< Integers: a minus sign stood in front.
  bool overflow;      ///< The value does not fit 64 bits.
  uint64_t magnitude; ///< Integers: the absolute value.
  int64_t ns;         ///< Times and dates: nanoseconds.
  LREAL real;         ///< Reals.
};
/// [+-] decimal or based (2# 8# 16#) integer, underscores between digits allowed.
Scanned scanInteger(const char *s, uint32_t length);
/// [+-] real or integer number, also NaN and Infinity.
Scanned scanReal(const char *s, uint32_t length);
/// A duration without or with its prefix (T# TIME# LT# LTIME#): 1d2h3m4s5ms6us7ns, decimals
/// allowed in the last part, each unit at most once and in falling order.
Scanned scanDuration(const char *s, uint32_t length);
/// D#, TOD#, DT# and long forms, without or with the prefix; ns since 1970 or since midnight.
Scanned scanDate(const char *s, uint32_t length);
Scanned scanTimeOfDay(const char *s, uint32_t length);
Scanned scanDateAndTime(const char *s, uint32_t length);

/// STRING_TO_X: blanks in front are skipped, the longest prefix that is a value counts, text
/// without a value gives 0. Reals may also be `.5`, `5.` and `5.e3`. Integers wrap to the type as
/// other conversions do.
void parseValue(Kind kind, const char *s, uint32_t cap, void *value);

} // namespace text

/// X_TO_STRING with a result of declared length N.
template <Kind From, uint32_t N = 80> inline STRING<N> toString(KindType<From> value) {
  char buffer[text::kBufferSize];
  const uint32_t length = text::formatValue(buffer, From, &value);
  STRING<N> r;
  detail::textCopy(r.s, N, buffer, length);
  return r;
}
/// X_TO_WSTRING.
template <Kind From, uint32_t N = 80> inline WSTRING<N> toWstring(KindType<From> value) {
  char buffer[text::kBufferSize];
  const uint32_t length = text::formatValue(buffer, From, &value);
  WSTRING<N> r;
  uint32_t i = 0;
  for (; i < length && i < N; ++i)
    r.s[i] = static_cast<char16_t>(static_cast<unsigned char>(buffer[i]));
  r.s[i] = 0;
  return r;
}
/// STRING_TO_X.
template <Kind To, uint32_t N> inline KindType<To> fromString(const STRING<N> &s) {
  KindType<To> value{};
  text::parseValue(To, s.s, N, &value);
  return value;
}
/// STRING_TO_WSTRING and back: Latin-1 is the first page of UTF-16; other units become '?'.
template <uint32_t R, uint32_t N> inline WSTRING<R> widen(const STRING<N> &s) {
  WSTRING<R> r;
  uint32_t i = 0;
  for (; i < N && i < R && s.s[i] != 0; ++i)
    r.s[i] = static_cast<char16_t>(static_cast<unsigned char>(s.s[i]));
  r.s[i] = 0;
  return r;
}
template <uint32_t R, uint32_t N> inline STRING<R> narrow(const WSTRING<N> &s) {
  STRING<R> r;
  uint32_t i = 0;
  for (; i < N && i < R && s.s[i] != 0; ++i)
    r.s[i] = static_cast<char>(s.s[i] < 256 ? s.s[i] : u'?');
  r.s[i] = 0;
  return r;
}
/// WSTRING_TO_X.
template <Kind To, uint32_t N> inline KindType<To> fromString(const WSTRING<N> &s) {
  return fromString<To>(narrow<N>(s));
}

/// CHAR_TO_STRING and the like: a text of one character, empty for the character 0.
template <uint32_t N> inline STRING<N> characterText(CHAR c) {
  STRING<N> r{};
  r.s[0] = static_cast<char>(c);
  return r;
}
template <uint32_t N> inline WSTRING<N> wideCharacterText(WCHAR c) {
  WSTRING<N> r{};
  r.s[0] = static_cast<char16_t>(c);
  return r;
}
/// STRING_TO_CHAR and the like: the first character, 0 of an empty text.
template <uint32_t N> constexpr CHAR firstCharacter(const STRING<N> &s) {
  return static_cast<CHAR>(s.s[0]);
}
template <uint32_t N> constexpr WCHAR firstCharacter(const WSTRING<N> &s) {
  return static_cast<WCHAR>(s.s[0]);
}
/// WCHAR_TO_CHAR: characters beyond Latin-1 become '?'.
constexpr CHAR narrowCharacter(WCHAR c) { return static_cast<CHAR>(c < 256 ? c : u'?'); }

/// TO_STRING of an enumeration with {attribute 'to_string'}: the enumerator's name, or the number
/// where there is none.
template <uint32_t N> inline STRING<N> enumeratorText(const char *name, int64_t value) {
  char buffer[text::kBufferSize];
  STRING<N> r;
  if (name != nullptr) {
    detail::textCopy(r.s, N, name, N);
  } else {
    const uint32_t length = text::formatSigned(buffer, value);
    detail::textCopy(r.s, N, buffer, length);
  }
  return r;
}

} // namespace stride

#endif
