#include "compiler/syntax/literals.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace stc {

namespace {

using ast::LiteralKind;

constexpr uint64_t kMax64 = std::numeric_limits<uint64_t>::max();

int digitValue(char c) {
  if (isDigit(c))
    return c - '0';
  const char lower = lowerCase(c);
  return lower >= 'a' && lower <= 'z' ? lower - 'a' + 10 : 99;
}

std::string quote(std::string_view text) {
  std::string out(text.substr(0, 60));
  return "`" + out + (text.size() > 60 ? "…`" : "`");
}

void appendUtf8(std::string &out, uint32_t c) {
  const auto put = [&](uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xE0 | (c >> 12));
    put(0x80 | ((c >> 6) & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

bool isHighSurrogate(uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool isLowSurrogate(uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

/// Appends a UTF-16 code unit. Half of a surrogate pair takes three bytes, as if it was a
/// character; where the other half follows, both are the character that they mean.
void appendUnit(std::string &out, uint32_t unit, bool joins) {
  if (joins && isLowSurrogate(unit)) {
    const auto byte = [&](size_t fromEnd) {
      return static_cast<unsigned char>(out[out.size() - fromEnd]);
    };
    const uint32_t high = (byte(3) & 0x0FU) << 12 | (byte(2) & 0x3FU) << 6 | (byte(1) & 0x3FU);
    out.resize(out.size() - 3);
    const uint32_t point = 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00);
    out += static_cast<char>(0xF0 | (point >> 18));
    out += static_cast<char>(0x80 | ((point >> 12) & 0x3F));
    out += static_cast<char>(0x80 | ((point >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (point & 0x3F));
    return;
  }
  appendUtf8(out, unit);
}

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

} // namespace

bool LiteralReader::fail(Code code, Span span, std::string message, std::string label) {
  diagnostics_.report(code, span, std::move(message), std::move(label));
  return false;
}

bool LiteralReader::integer(std::string_view text, Span span, ast::Literal &out) {
  out.literal = LiteralKind::Integer;
  out.text = text;
  unsigned base = 10;
  std::string_view digits = text;
  uint32_t offset = 0;
  if (const auto hash = text.find('#'); hash != std::string_view::npos) {
    base = 0;
    for (const char c : text.substr(0, hash))
      base = isDigit(c) && base < 100 ? base * 10 + static_cast<unsigned>(c - '0') : 100;
    if (base != 2 && base != 8 && base != 10 && base != 16)
      return fail(Code::InvalidNumber,
                  {span.file, span.begin, span.begin + static_cast<uint32_t>(hash)},
                  "a number cannot have this base", "the base is 2, 8 or 16");
    digits = text.substr(hash + 1);
    offset = static_cast<uint32_t>(hash + 1);
  }
  uint64_t value = 0;
  bool tooLarge = false;
  bool lastUnderscore = true;
  for (size_t i = 0; i < digits.size(); ++i) {
    const char c = digits[i];
    const auto at = span.begin + offset + static_cast<uint32_t>(i);
    if (c == '_') {
      if (lastUnderscore)
        return fail(Code::InvalidNumber, {span.file, at, at + 1},
                    "misplaced underscore in a number", "underscores stand between digits");
      lastUnderscore = true;
      continue;
    }
    lastUnderscore = false;
    const int digit = digitValue(c);
    if (digit >= static_cast<int>(base)) {
      auto &d = diagnostics_.report(Code::InvalidNumber, {span.file, at, at + 1},
                                    "the number " + quote(text) + " is malformed",
                                    base == 10 ? "not a digit"
                                               : "not a digit to the base " + std::to_string(base));
      const bool prefixed = base == 10 && i == 1 && digits[0] == '0' && digits.size() > 2;
      if (prefixed && (c == 'x' || c == 'X' || c == 'b' || c == 'B')) {
        const std::string right =
            (c == 'x' || c == 'X' ? "16#" : "2#") + std::string(digits.substr(2));
        d.suggest("write `" + right + "`", span, right);
      }
      return false;
    }
    if (value > (kMax64 - static_cast<uint64_t>(digit)) / base)
      tooLarge = true;
    value = value * base + static_cast<uint64_t>(digit);
  }
  if (lastUnderscore)
    return fail(Code::InvalidNumber, span, "the number " + quote(text) + " is incomplete");
  if (tooLarge)
    return fail(Code::LiteralOutOfRange, span,
                "the number " + quote(text) + " does not fit into 64 bits");
  out.integer = value;
  return true;
}

bool LiteralReader::real(std::string_view text, Span span, ast::Literal &out) {
  out.literal = LiteralKind::Real;
  out.text = text;
  std::string clean;
  for (const char c : text)
    if (c != '_')
      clean += c;
  const auto [end, error] = std::from_chars(clean.data(), clean.data() + clean.size(), out.real);
  if (error == std::errc::result_out_of_range) {
    // Too small is zero; too large is an error.
    if (clean.find("e-") != std::string::npos || clean.find("E-") != std::string::npos) {
      out.real = 0;
      return true;
    }
    return fail(Code::LiteralOutOfRange, span,
                "the number " + quote(text) + " does not fit into an LREAL");
  }
  if (error != std::errc{} || end != clean.data() + clean.size())
    return fail(Code::InvalidNumber, span, "the number " + quote(text) + " is malformed");
  return true;
}

bool LiteralReader::string(std::string_view text, Span span, ast::Literal &out) {
  const bool wide = text[0] == '"';
  out.literal = wide ? LiteralKind::Wstring : LiteralKind::String;
  const std::string_view content = text.substr(1, text.size() - 2);
  if (content.find('$') == std::string_view::npos) {
    out.text = content;
    return true;
  }
  std::string value;
  size_t behindHigh = std::string::npos; // where the other half of a surrogate pair may follow
  for (size_t i = 0; i < content.size(); ++i) {
    if (content[i] != '$') {
      value += content[i];
      continue;
    }
    const auto at = span.begin + 1 + static_cast<uint32_t>(i);
    const char c = i + 1 < content.size() ? content[i + 1] : '\0';
    switch (lowerCase(c)) {
    case '$':
    case '\'':
    case '"':
      value += c;
      break;
    case 'l':
    case 'n':
      value += '\n';
      break;
    case 'p':
      value += '\f';
      break;
    case 'r':
      value += '\r';
      break;
    case 't':
      value += '\t';
      break;
    default: {
      const size_t digits = wide ? 4 : 2;
      uint32_t code = 0;
      bool good = i + digits < content.size();
      for (size_t k = 1; good && k <= digits; ++k) {
        const int digit = digitValue(content[i + k]);
        good = digit < 16;
        code = code * 16 + static_cast<uint32_t>(digit);
      }
      if (!good) {
        const uint32_t end = at + (c != '\0' && static_cast<unsigned char>(c) < 0x80 ? 2U : 1U);
        diagnostics_.report(Code::InvalidEscape, {span.file, at, end}, "unknown escape in a string")
            .help("a dollar sign is written `$$`; known escapes are $$ $' $\" $L $N $P $R $T and " +
                  std::string(wide ? "$hhhh" : "$hh"));
        return false;
      }
      appendUnit(value, code, behindHigh == value.size());
      behindHigh = isHighSurrogate(code) ? value.size() : std::string::npos;
      i += digits;
      continue;
    }
    }
    ++i;
  }
  out.text = arena_.copy(std::string_view(value));
  return true;
}

bool LiteralReader::duration(std::string_view value, bool isLong, Span span, ast::Literal &out) {
  out.literal = isLong ? LiteralKind::Ltime : LiteralKind::Time;
  uint64_t nanos = 0;
  bool overflow = false;
  bool first = true;
  size_t lowest = 0; // the next unit must not be larger than this index
  bool fraction = false;
  std::string_view rest = value;
  while (!rest.empty()) {
    const auto number = takeDecimal(rest);
    if (!number) {
      if (!first || !isDigit(rest[0]))
        return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                    "expected a number here: " + quote(rest));
      return fail(Code::LiteralOutOfRange, span, "the duration is too large");
    }
    size_t length = 0;
    while (length < rest.size() && digitValue(rest[length]) >= 10 && rest[length] != '_' &&
           rest[length] != '.')
      ++length;
    std::string name;
    for (const char c : rest.substr(0, length))
      name += lowerCase(c);
    rest.remove_prefix(length);
    if (!rest.empty() && rest[0] == '_')
      rest.remove_prefix(1);
    size_t unit = 0;
    while (unit < std::size(kUnits) && kUnits[unit].name != name)
      ++unit;
    if (unit == std::size(kUnits))
      return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                  name.empty() ? "a number has no unit"
                               : "unknown unit `" + name + "`; units are d, h, m, s, ms, us, ns");
    if (!isLong && unit > 4) {
      diagnostics_
          .report(Code::InvalidTimeLiteral, span, "a TIME literal counts whole milliseconds")
          .help("write `LTIME#" + std::string(value.substr(0, 60)) + "`");
      return false;
    }
    if (!first && unit < lowest)
      return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                  "units stand from the largest to the smallest, each one once");
    if (fraction)
      return fail(Code::InvalidTimeLiteral, span, "malformed duration",
                  "only the last number may have a fraction");
    fraction = number->fraction;
    lowest = unit + 1;
    first = false;
    const uint64_t scale = kUnits[unit].nanos;
    if (number->whole > kMax64 / scale || nanos > kMax64 - number->whole * scale) {
      overflow = true;
      continue;
    }
    nanos += number->whole * scale;
    nanos += scale >= 1'000'000'000 ? number->nanos * (scale / 1'000'000'000)
                                    : number->nanos / (1'000'000'000 / scale);
  }
  if (first)
    return fail(Code::InvalidTimeLiteral, span, "malformed duration");
  if (overflow || (isLong && nanos > static_cast<uint64_t>(std::numeric_limits<int64_t>::max())))
    return fail(Code::LiteralOutOfRange, span,
                "the duration does not fit into 64 bits of nanoseconds");
  if (isLong) {
    out.integer = nanos;
    return true;
  }
  out.integer = nanos / 1'000'000;
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
