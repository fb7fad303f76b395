// Values of literals: durations, dates and times of day.

#include "compiler/syntax/literal_text.hpp"
#include "compiler/syntax/literals.hpp"

#include <chrono>
#include <limits>
#include <optional>
#include <string>

namespace stc {

namespace {

using ast::LiteralKind;

/// A decimal number with a fraction as an exact multiple of 10^-9.
struct Decimal {
  uint64_t whole = 0;
  uint32_t nanos = 0;
  bool fraction = false;
};

/// Takes a decimal number off the front; nullopt when there is none or it is too large.
std::optional<Decimal> takeDecimal(std::string_view &text) {
  Decimal out;
  size_t i = 0;
  for (; i < text.size() && (isDigit(text[i]) || (text[i] == '_' && i > 0)); ++i) {
    if (text[i] == '_')
      continue;
    if (out.whole > (kMax64 - 9) / 10)
      return std::nullopt;
    out.whole = out.whole * 10 + static_cast<uint64_t>(text[i] - '0');
  }
  if (i == 0)
    return std::nullopt;
  if (i + 1 < text.size() && text[i] == '.' && isDigit(text[i + 1])) {
    out.fraction = true;
    uint32_t scale = 100'000'000;
    for (++i; i < text.size() && (isDigit(text[i]) || text[i] == '_'); ++i) {
      if (text[i] == '_')
        continue;
      out.nanos += static_cast<uint32_t>(text[i] - '0') * scale;
      scale /= 10;
    }
  }
  text.remove_prefix(i);
  return out;
}

struct Unit {
  std::string_view name;
  uint64_t nanos;
};

constexpr Unit kUnits[] = {
    {"d", 86'400'000'000'000ULL},
    {"h", 3'600'000'000'000ULL},
    {"m", 60'000'000'000ULL},
    {"s", 1'000'000'000ULL},
    {"ms", 1'000'000ULL},
    {"us", 1'000ULL},
    {"ns", 1ULL},
};

bool takeNumber(std::string_view &text, unsigned digitsMin, unsigned digitsMax, unsigned &out) {
  size_t i = 0;
  out = 0;
  while (i < text.size() && isDigit(text[i]) && i < digitsMax)
    out = out * 10 + static_cast<unsigned>(text[i++] - '0');
  if (i < digitsMin)
    return false;
  text.remove_prefix(i);
  return true;
}

bool take(std::string_view &text, char c) {
  if (text.empty() || text[0] != c)
    return false;
  text.remove_prefix(1);
  return true;
}

/// `2024-02-29` → days since 1970.
std::optional<int64_t> takeDate(std::string_view &text) {
  unsigned year = 0;
  unsigned month = 0;
  unsigned day = 0;
  if (!takeNumber(text, 4, 4, year) || !take(text, '-') || !takeNumber(text, 1, 2, month) ||
      !take(text, '-') || !takeNumber(text, 1, 2, day))
    return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(month), std::chrono::day(day)};
  if (!date.ok())
    return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// `12:30:15.5` → ns since midnight.
std::optional<uint64_t> takeTimeOfDay(std::string_view &text) {
  unsigned hours = 0;
  unsigned minutes = 0;
  if (!takeNumber(text, 1, 2, hours) || !take(text, ':') || !takeNumber(text, 1, 2, minutes) ||
      hours > 23 || minutes > 59)
    return std::nullopt;
  Decimal seconds;
  if (take(text, ':')) {
    const auto read = takeDecimal(text);
    if (!read || read->whole > 59)
      return std::nullopt;
    seconds = *read;
  }
  return ((hours * 60ULL + minutes) * 60 + seconds.whole) * 1'000'000'000ULL + seconds.nanos;
}

/// Takes the letters of a unit off the front, and a `_` after them; in lower case.
std::string takeUnitName(std::string_view &text) {
  size_t length = 0;
  while (length < text.size() && digitValue(text[length]) >= 10 && text[length] != '_' &&
         text[length] != '.')
    ++length;
  std::string name;
  for (const char c : text.substr(0, length))
    name += lowerCase(c);
  text.remove_prefix(length);
  if (!text.empty() && text[0] == '_')
    text.remove_prefix(1);
  return name;
}

/// The index in kUnits; its size: there is no such unit.
size_t unitOf(std::string_view name) {
  size_t unit = 0;
  while (unit < std::size(kUnits) && kUnits[unit].name != name)
    ++unit;
  return unit;
}

/// Adds that many of a unit; false: the sum does not fit.
bool addTo(uint64_t &nanos, const Decimal &number, const Unit &unit) {
  const uint64_t scale = unit.nanos;
  if (number.whole > kMax64 / scale || nanos > kMax64 - number.whole * scale)
    return false;
  nanos += number.whole * scale;
  nanos += scale >= 1'000'000'000 ? number.nanos * (scale / 1'000'000'000)
                                  : number.nanos / (1'000'000'000 / scale);
  return true;
}

} // namespace

/// A duration while it is read.
struct LiteralReader::Duration {
  std::string_view text; ///< all of it
  bool isLong = false;
  Span span;
  uint64_t nanos = 0;
  bool overflow = false;
  bool fraction = false; ///< the last number has one
  size_t nextUnit = 0;   ///< the largest unit that may follow; 0 as long as nothing was read
};

/// Takes a number with its unit off the front of `rest`.
bool LiteralReader::durationPart(std::string_view &rest, Duration &duration) {
  const Span span = duration.span;
  const bool first = duration.nextUnit == 0;
  const auto number = takeDecimal(rest);
  if (!number) {
    if (!first || !isDigit(rest[0]))
      return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                  "expected a number here: " + quoteLiteral(rest));
    return fail(Code::LiteralOutOfRange, span, "the duration is too large");
  }
  const std::string name = takeUnitName(rest);
  const size_t unit = unitOf(name);
  if (unit == std::size(kUnits))
    return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                name.empty() ? "a number has no unit, which follows it without a blank: `T#5s`"
                             : "unknown unit `" + name + "`; units are d, h, m, s, ms, us, ns");
  if (unit < duration.nextUnit)
    return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                "units stand from the largest to the smallest, each one once");
  if (duration.fraction)
    return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                "only the last number may have a fraction");
  duration.fraction = number->fraction;
  duration.nextUnit = unit + 1;
  if (!addTo(duration.nanos, *number, kUnits[unit]))
    duration.overflow = true;
  return true;
}

bool LiteralReader::duration(std::string_view value, bool isLong, Span span, ast::Literal &out) {
  out.literal = isLong ? LiteralKind::Ltime : LiteralKind::Time;
  Duration duration{value, isLong, span};
  for (std::string_view rest = value; !rest.empty();)
    if (!durationPart(rest, duration))
      return false;
  if (duration.nextUnit == 0)
    return fail(Code::InvalidTimeLiteral, span, "malformed duration");
  const uint64_t nanos = duration.nanos;
  const uint64_t most =
      static_cast<uint64_t>(std::numeric_limits<int64_t>::max()) + (out.negative ? 1 : 0);
  if (duration.overflow || (isLong && nanos > most))
    return fail(Code::LiteralOutOfRange, span,
                "the duration does not fit into 64 bits of nanoseconds");
  if (isLong) {
    out.integer = out.negative ? 0 - nanos : nanos;
    return true;
  }
  out.integer = nanos / 1'000'000;
  if (nanos % 1'000'000 != 0)
    diagnostics_
        .report(Code::PrecisionLoss, span, "a TIME counts whole milliseconds",
                "counts as T#" + std::to_string(out.integer) + "ms")
        .help("write `LTIME#" + std::string(value.substr(0, 60)) + "` where the rest matters");
  if (out.integer > std::numeric_limits<uint32_t>::max()) {
    diagnostics_
        .report(Code::LiteralOutOfRange, span, "the duration does not fit into a TIME",
                "longer than T#49d17h2m47s295ms")
        .help("write `LTIME#" + std::string(value.substr(0, 60)) + "`");
    return false;
  }
  return true;
}

bool LiteralReader::timeOrDate(std::string_view prefix, std::string_view value, Span span,
                               ast::Literal &out) {
  const bool isLong = prefix[0] == 'l';
  const std::string_view kind = isLong ? prefix.substr(1) : prefix;
  if (kind == "t" || kind == "time")
    return duration(value, isLong, span, out);

  constexpr int64_t kSecond = 1'000'000'000;
  std::string_view rest = value;
  if (kind == "tod" || kind == "time_of_day") {
    out.literal = isLong ? LiteralKind::Ltod : LiteralKind::Tod;
    const auto nanos = takeTimeOfDay(rest);
    if (!nanos || !rest.empty())
      return fail(Code::InvalidDateLiteral, span, "malformed time of day",
                  "expected for example `TOD#12:30:15.5`");
    out.integer = isLong ? *nanos : *nanos / 1'000'000;
    return true;
  }
  const bool both = kind == "dt" || kind == "date_and_time";
  out.literal = both ? (isLong ? LiteralKind::Ldt : LiteralKind::Dt)
                     : (isLong ? LiteralKind::Ldate : LiteralKind::Date);
  const auto days = takeDate(rest);
  std::optional<uint64_t> nanos = 0;
  if (days && both)
    nanos = take(rest, '-') ? takeTimeOfDay(rest) : std::nullopt;
  if (!days || !nanos || !rest.empty())
    return fail(Code::InvalidDateLiteral, span, both ? "malformed date and time" : "malformed date",
                both ? "expected for example `DT#2024-02-29-12:30:15`"
                     : "expected a date such as `D#2024-02-29`");
  const int64_t seconds = *days * 86'400 + static_cast<int64_t>(*nanos) / kSecond;
  if (!isLong) {
    if (seconds >= 0 && seconds <= std::numeric_limits<uint32_t>::max()) {
      out.integer = static_cast<uint64_t>(seconds);
      return true;
    }
    diagnostics_
        .report(Code::LiteralOutOfRange, span,
                seconds < 0 ? "the date is before 1970-01-01, the first one of 32 bits"
                            : "the date is after 2106-02-07, the last one of 32 bits")
        .help(std::string("write `") + (both ? "LDT#" : "LDATE#") +
              std::string(value.substr(0, 60)) + "`, which has 64 bits");
    return false;
  }
  // The sum may fit although the product does not: before 1970 the fraction counts from below.
  const int64_t below = seconds < 0 ? 1 : 0;
  int64_t total = 0;
  if (__builtin_mul_overflow(seconds + below, kSecond, &total) ||
      __builtin_add_overflow(total, static_cast<int64_t>(*nanos) % kSecond - below * kSecond,
                             &total))
    return fail(Code::LiteralOutOfRange, span,
                seconds < 0 ? "the date is too far in the past"
                            : "the date is too far in the future",
                "64 bits reach from 1677-09-22 to 2262-04-11");
  out.integer = static_cast<uint64_t>(total);
  return true;
}

} // namespace stc
