// Text to values.
#include "runtime/iec/text.h"

#include <charconv>
#include <cstring>
#include <limits>

namespace stride::text {

namespace {

constexpr uint64_t kSecondNs = 1000000000;

bool isDigit(char c) { return c >= '0' && c <= '9'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Reads on from a position; nothing here looks past the end.
class Reader {
public:
  Reader(const char *s, uint32_t length) : s_(s), length_(length) {}

  char peek(uint32_t ahead = 0) const { return at_ + ahead < length_ ? s_[at_ + ahead] : '\0'; }
  uint32_t at() const { return at_; }
  void seek(uint32_t at) { at_ = at; }
  void skip(uint32_t n = 1) { at_ += n; }
  bool take(char c) {
    if (peek() != c || at_ >= length_)
      return false;
    ++at_;
    return true;
  }
  /// A word in any case.
  bool takeWord(const char *word) {
    const uint32_t n = static_cast<uint32_t>(std::strlen(word));
    for (uint32_t i = 0; i < n; ++i) {
      if (upper(peek(i)) != word[i])
        return false;
    }
    at_ += n;
    return true;
  }
  template <size_t N> void takePrefix(const char *const (&prefixes)[N]) {
    for (const char *prefix : prefixes) {
      if (takeWord(prefix))
        return;
    }
  }
  /// Decimal digits with single underscores between them; false when there is none.
  bool takeDecimal(uint64_t &value, bool &overflow, uint32_t base = 10) {
    value = 0;
    bool any = false;
    for (;;) {
      if (any && peek() == '_' && digitValue(peek(1)) < base)
        ++at_;
      const uint32_t digit = digitValue(peek());
      if (digit >= base || at_ >= length_)
        return any;
      overflow = __builtin_mul_overflow(value, uint64_t{base}, &value) || overflow;
      overflow = __builtin_add_overflow(value, uint64_t{digit}, &value) || overflow;
      any = true;
      ++at_;
    }
  }
  /// Exactly `width` digits at most; at least one.
  bool takeField(uint32_t width, int64_t &value) {
    value = 0;
    uint32_t n = 0;
    for (; n < width && isDigit(peek()); ++n) {
      value = value * 10 + (peek() - '0');
      ++at_;
    }
    return n > 0 && !isDigit(peek());
  }

private:
  static uint32_t digitValue(char c) {
    if (isDigit(c))
      return static_cast<uint32_t>(c - '0');
    c = upper(c);
    return c >= 'A' && c <= 'F' ? static_cast<uint32_t>(c - 'A' + 10) : 99;
  }

  const char *s_;
  uint32_t length_;
  uint32_t at_ = 0;
};

Scanned nothing() { return Scanned{0, false, false, 0, 0, 0.0}; }

/// Digits after a decimal point as nanoseconds of a unit.
uint64_t takeFraction(Reader &in, uint64_t unitNs) {
  uint64_t value = 0;
  uint64_t step = unitNs;
  while (isDigit(in.peek())) {
    step /= 10;
    value += static_cast<uint64_t>(in.peek() - '0') * step;
    in.skip();
  }
  return value;
}

bool takeDay(Reader &in, int64_t &days) {
  int64_t year = 0;
  int64_t month = 0;
  int64_t day = 0;
  if (!in.takeField(4, year) || !in.take('-') || !in.takeField(2, month) || !in.take('-') ||
      !in.takeField(2, day))
    return false;
  static constexpr int64_t kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  if (month < 1 || month > 12 || day < 1 || day > kDays[month - 1] + (month == 2 && leap ? 1 : 0))
    return false;
  // Days since 1970-01-01, counting years from March.
  const int64_t y = month <= 2 ? year - 1 : year;
  const int64_t era = (y >= 0 ? y : y - 399) / 400;
  const int64_t yearOfEra = y - era * 400;
  const int64_t dayOfYear = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  days = era * 146097 + yearOfEra * 365 + yearOfEra / 4 - yearOfEra / 100 + dayOfYear - 719468;
  return true;
}

bool takeClock(Reader &in, int64_t &ns) {
  int64_t hour = 0;
  int64_t minute = 0;
  int64_t second = 0;
  if (!in.takeField(2, hour) || !in.take(':') || !in.takeField(2, minute))
    return false;
  uint64_t fraction = 0;
  if (in.take(':')) {
    if (!in.takeField(2, second))
      return false;
    if (in.peek() == '.' && isDigit(in.peek(1))) {
      in.skip();
      fraction = takeFraction(in, kSecondNs);
    }
  }
  if (hour > 23 || minute > 59 || second > 59)
    return false;
  ns = (hour * 3600 + minute * 60 + second) * static_cast<int64_t>(kSecondNs) +
       static_cast<int64_t>(fraction);
  return true;
}

template <class T> void store(void *p, T value) { std::memcpy(p, &value, sizeof value); }

void storeInteger(Kind kind, void *value, uint64_t bits) {
  switch (kind) {
  case Kind::SINT:
  case Kind::USINT:
  case Kind::BYTE:
    store(value, static_cast<uint8_t>(bits));
    break;
  case Kind::INT:
  case Kind::UINT:
  case Kind::WORD:
    store(value, static_cast<uint16_t>(bits));
    break;
  case Kind::DINT:
  case Kind::UDINT:
  case Kind::DWORD:
    store(value, static_cast<uint32_t>(bits));
    break;
  default:
    store(value, bits);
    break;
  }
}

} // namespace

Scanned scanInteger(const char *s, uint32_t length) {
  Scanned r = nothing();
  Reader in(s, length);
  if (in.peek() == '-' || in.peek() == '+') {
    r.negative = in.peek() == '-';
    in.skip();
  }
  if (!in.takeDecimal(r.magnitude, r.overflow))
    return nothing();
  if (in.peek() == '#' && (r.magnitude == 2 || r.magnitude == 8 || r.magnitude == 16)) {
    const uint32_t behindBase = in.at();
    Scanned based = r;
    in.skip();
    if (in.takeDecimal(based.magnitude, based.overflow, static_cast<uint32_t>(r.magnitude)))
      r = based;
    else
      in.seek(behindBase);
  }
  r.used = in.at();
  return r;
}

namespace {

/// The digits of a number as std::from_chars reads them; a literal's length bounds them.
struct Digits {
  char text[512];
  uint32_t count = 0;

  [[nodiscard]] const char *end() const { return text + count; }
};

/// What a real number may look like.
enum class Form : uint8_t {
  Literal, ///< a literal of ST: digits on both sides of the point
  Loose,   ///< also `.5`, `5.` and `5.e3`, which instruments and other programs write
};

bool pointBelongs(bool digitBefore, bool digitAfter, Form form) {
  return form == Form::Loose ? digitBefore || digitAfter : digitBefore && digitAfter;
}

/// Takes digits with at most one point, without the underscores between them; false: there is none.
bool takeMantissa(Reader &in, Digits &digits, Form form) {
  bool any = false;
  bool point = false;
  for (; digits.count < sizeof digits.text - 8; in.skip()) {
    const char c = in.peek();
    if (isDigit(c)) {
      any = true;
    } else if (c == '.' && !point && pointBelongs(any, isDigit(in.peek(1)), form)) {
      point = true;
    } else if (c == '_' && any && isDigit(in.peek(1))) {
      continue;
    } else {
      break;
    }
    digits.text[digits.count++] = c;
  }
  return any;
}

void takeExponent(Reader &in, Digits &digits) {
  const uint32_t sign = in.peek(1) == '-' || in.peek(1) == '+' ? 1 : 0;
  if (upper(in.peek()) != 'E' || !isDigit(in.peek(1 + sign)))
    return;
  digits.text[digits.count++] = 'e';
  if (in.peek(1) == '-')
    digits.text[digits.count++] = '-';
  in.skip(1 + sign);
  for (; isDigit(in.peek()) && digits.count < sizeof digits.text; in.skip())
    digits.text[digits.count++] = in.peek();
}

/// TRUE: a number that no double holds is too small, not too large. Its first digit other than 0
/// tells.
bool isTiny(const Digits &digits) {
  int64_t exponent = 0; // of the first digit that is not 0
  bool point = false;
  bool significant = false;
  for (const char *p = digits.text; p != digits.end(); ++p) {
    if (*p == 'e') {
      int64_t written = 0;
      const auto [last, error] = std::from_chars(p + 1, digits.end(), written);
      return error == std::errc::result_out_of_range ? p[1] == '-' : exponent + written < 0;
    }
    if (*p == '.')
      point = true;
    else if (point && !significant)
      --exponent;
    else if (!point && significant)
      ++exponent;
    significant = significant || (*p != '.' && *p != '0');
  }
  return exponent < 0;
}

/// T is the type that the digits are rounded to: by way of double a REAL would be rounded twice.
template <class T> void roundTo(const Digits &digits, Scanned &r) {
  T rounded = 0;
  std::from_chars_result result = std::from_chars(digits.text, digits.end(), rounded);
  r.real = static_cast<LREAL>(rounded);
  if (sizeof(T) < sizeof(LREAL) && result.ec == std::errc::result_out_of_range) {
    result = std::from_chars(digits.text, digits.end(), r.real);
    r.real = r.real > 1 ? std::numeric_limits<double>::infinity() : 0.0;
  }
  if (result.ec == std::errc::result_out_of_range) {
    const bool tiny = isTiny(digits);
    r.real = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    r.overflow = !tiny;
  }
}

/// Rounds to T.
template <class T> Scanned scanFloating(const char *s, uint32_t length, Form form) {
  Scanned r = nothing();
  Reader in(s, length);
  if (in.peek() == '-' || in.peek() == '+') {
    r.negative = in.peek() == '-';
    in.skip();
  }
  if (in.takeWord("INFINITY")) {
    r.real = std::numeric_limits<double>::infinity();
  } else if (in.takeWord("NAN")) {
    r.real = std::numeric_limits<double>::quiet_NaN();
  } else {
    Digits digits;
    if (!takeMantissa(in, digits, form))
      return nothing();
    takeExponent(in, digits);
    roundTo<T>(digits, r);
  }
  if (r.negative)
    r.real = -r.real;
  r.used = in.at();
  return r;
}

} // namespace

Scanned scanReal(const char *s, uint32_t length) {
  return scanFloating<LREAL>(s, length, Form::Literal);
}

namespace {

struct TimeUnit {
  const char *name;
  uint64_t ns;
};

// Two-letter units first, so that "ms" is not read as "m".
constexpr TimeUnit kTimeUnits[] = {
    {"MS", 1000000},         {"US", 1000},          {"NS", 1},       {"D", 86400 * kSecondNs},
    {"H", 3600 * kSecondNs}, {"M", 60 * kSecondNs}, {"S", kSecondNs}};

/// A number and its unit.
struct TimePart {
  uint64_t whole = 0;
  bool overflow = false;
  bool hasFraction = false;
  uint32_t fractionAt = 0; ///< where the digits after the point begin
  const TimeUnit *unit = nullptr;
};

/// Takes a number with its unit, which is null when there is none.
TimePart takeTimePart(Reader &in) {
  TimePart part;
  if (!in.takeDecimal(part.whole, part.overflow))
    return part;
  part.fractionAt = in.at() + 1;
  if (in.peek() == '.' && isDigit(in.peek(1))) {
    part.hasFraction = true;
    in.skip();
    while (isDigit(in.peek()))
      in.skip();
  }
  for (const TimeUnit &candidate : kTimeUnits) {
    if (in.takeWord(candidate.name)) {
      part.unit = &candidate;
      break;
    }
  }
  return part;
}

} // namespace

Scanned scanDuration(const char *s, uint32_t length) {
  static constexpr const char *kPrefixes[] = {"LTIME#", "TIME#", "LT#", "T#"};
  constexpr uint64_t kNoUnit = std::numeric_limits<uint64_t>::max();
  Scanned r = nothing();
  Reader in(s, length);
  in.takePrefix(kPrefixes);
  r.negative = in.take('-');
  uint64_t total = 0;
  uint64_t lastUnit = kNoUnit;
  for (;;) {
    const uint32_t start = in.at();
    if (lastUnit != kNoUnit)
      in.take('_');
    const TimePart part = takeTimePart(in);
    if (part.unit == nullptr || part.unit->ns >= lastUnit) {
      in.seek(start);
      break;
    }
    lastUnit = part.unit->ns;
    uint64_t ns = 0;
    r.overflow = part.overflow || __builtin_mul_overflow(part.whole, lastUnit, &ns) ||
                 __builtin_add_overflow(total, ns, &total) || r.overflow;
    if (part.hasFraction) {
      Reader digits(s, length);
      digits.seek(part.fractionAt);
      r.overflow =
          __builtin_add_overflow(total, takeFraction(digits, lastUnit), &total) || r.overflow;
      break;
    }
  }
  if (lastUnit == kNoUnit)
    return nothing();
  r.overflow = r.overflow || total > static_cast<uint64_t>(INT64_MAX);
  r.magnitude = total;
  r.ns = static_cast<int64_t>(r.negative ? uint64_t{0} - total : total);
  r.used = in.at();
  return r;
}

Scanned scanDate(const char *s, uint32_t length) {
  static constexpr const char *kPrefixes[] = {"LDATE#", "DATE#", "LD#", "D#"};
  Scanned r = nothing();
  Reader in(s, length);
  in.takePrefix(kPrefixes);
  int64_t days = 0;
  if (!takeDay(in, days))
    return nothing();
  r.overflow = __builtin_mul_overflow(days, detail::kDayNs, &r.ns);
  r.used = in.at();
  return r;
}

Scanned scanTimeOfDay(const char *s, uint32_t length) {
  static constexpr const char *kPrefixes[] = {"LTIME_OF_DAY#", "TIME_OF_DAY#", "LTOD#", "TOD#"};
  Scanned r = nothing();
  Reader in(s, length);
  in.takePrefix(kPrefixes);
  if (!takeClock(in, r.ns))
    return nothing();
  r.used = in.at();
  return r;
}

Scanned scanDateAndTime(const char *s, uint32_t length) {
  static constexpr const char *kPrefixes[] = {"LDATE_AND_TIME#", "DATE_AND_TIME#", "LDT#", "DT#"};
  Scanned r = nothing();
  Reader in(s, length);
  in.takePrefix(kPrefixes);
  int64_t days = 0;
  int64_t clock = 0;
  if (!takeDay(in, days) || !in.take('-') || !takeClock(in, clock))
    return nothing();
  r.overflow = __builtin_mul_overflow(days, detail::kDayNs, &r.ns) ||
               __builtin_add_overflow(r.ns, clock, &r.ns);
  r.used = in.at();
  return r;
}

void parseValue(Kind kind, const char *s, uint32_t cap, void *value) {
  uint32_t length = detail::textLength(s, cap);
  while (length > 0 && (*s == ' ' || *s == '\t')) {
    ++s;
    --length;
  }
  switch (kind) {
  case Kind::BOOL: {
    Reader in(s, length);
    store(value,
          static_cast<BOOL>(in.takeWord("TRUE") || scanInteger(s, length).magnitude != 0 ? 1 : 0));
    break;
  }
  case Kind::REAL:
    store(value, static_cast<REAL>(scanFloating<REAL>(s, length, Form::Loose).real));
    break;
  case Kind::LREAL:
    store(value, scanFloating<LREAL>(s, length, Form::Loose).real);
    break;
  case Kind::TIME:
    store(value, convert<Kind::TIME, Kind::LTIME>(scanDuration(s, length).ns));
    break;
  case Kind::LTIME:
    store(value, scanDuration(s, length).ns);
    break;
  case Kind::DATE:
    store(value, convert<Kind::DATE, Kind::LDATE>(scanDate(s, length).ns));
    break;
  case Kind::LDATE:
    store(value, scanDate(s, length).ns);
    break;
  case Kind::TOD:
    store(value, convert<Kind::TOD, Kind::LTOD>(scanTimeOfDay(s, length).ns));
    break;
  case Kind::LTOD:
    store(value, scanTimeOfDay(s, length).ns);
    break;
  case Kind::DT:
    store(value, convert<Kind::DT, Kind::LDT>(scanDateAndTime(s, length).ns));
    break;
  case Kind::LDT:
    store(value, scanDateAndTime(s, length).ns);
    break;
  default: {
    const Scanned r = scanInteger(s, length);
    storeInteger(kind, value, r.negative ? uint64_t{0} - r.magnitude : r.magnitude);
    break;
  }
  }
}

} // namespace stride::text
