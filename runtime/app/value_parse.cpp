#include "runtime/app/error.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/app/type_match.hpp"
#include "runtime/app/value_text.hpp"
#include "runtime/common/text.hpp"
#include "runtime/iec/text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

namespace stride::app {

namespace {

template <class T> void store(void *p, T value) { std::memcpy(p, &value, sizeof value); }

[[noreturn]] void notA(std::string_view text, const char *what, const char *example) {
  throw Error(
      fmt::format("'{}' is not a value of type {}; write for example {}", text, what, example));
}

uint32_t length(std::string_view text) { return static_cast<uint32_t>(text.size()); }

/// Range of an integer kind.
struct Range {
  int64_t min;
  uint64_t max;
};

std::optional<Range> literalRange(Kind kind) {
  switch (kind) {
  case Kind::SINT:
    return Range{INT8_MIN, INT8_MAX};
  case Kind::INT:
    return Range{INT16_MIN, INT16_MAX};
  case Kind::DINT:
    return Range{INT32_MIN, INT32_MAX};
  case Kind::LINT:
    return Range{INT64_MIN, INT64_MAX};
  case Kind::USINT:
  case Kind::BYTE:
    return Range{0, UINT8_MAX};
  case Kind::UINT:
  case Kind::WORD:
    return Range{0, UINT16_MAX};
  case Kind::UDINT:
  case Kind::DWORD:
    return Range{0, UINT32_MAX};
  case Kind::ULINT:
  case Kind::LWORD:
    return Range{0, UINT64_MAX};
  default:
    return std::nullopt;
  }
}

/// Without a prefix TYPE# in any case; 16# and the like stay.
std::string_view withoutPrefix(std::string_view text, std::string_view type) {
  if (text.size() > type.size() && text[type.size()] == '#' &&
      common::lowerCase(text.substr(0, type.size())) == common::lowerCase(type))
    return text.substr(type.size() + 1);
  return text;
}

/// Without a prefix that names the type, of a subrange its base type.
std::string_view withoutPrefix(const StrideAppV1 &app, const TypeDesc &type,
                               std::string_view text) {
  return withoutPrefix(text,
                       (type.flags & kTypeRange) != 0 ? app.types[type.element].name : type.name);
}

void storeInteger(const StrideAppV1 &app, const TypeDesc &type, const Range &range,
                  std::string_view text, void *value) {
  const std::string_view digits = withoutPrefix(app, type, text);
  const text::Scanned number = text::scanInteger(digits.data(), length(digits));
  if (number.used == 0 || number.used != digits.size())
    notA(text, type.name, "50, -3 or 16#FF");
  const uint64_t lowest = uint64_t{0} - static_cast<uint64_t>(range.min);
  const bool fits = !number.overflow &&
                    (number.negative ? number.magnitude <= lowest : number.magnitude <= range.max);
  const uint64_t bits = number.negative ? uint64_t{0} - number.magnitude : number.magnitude;
  if ((type.flags & kTypeRange) != 0 && !(fits && isInRange(type, static_cast<int64_t>(bits))))
    throw Error(fmt::format("{} is out of range for {}", text, type.name));
  if (!fits)
    throw Error(
        fmt::format("{} is out of range for {} ({}..{})", text, type.name, range.min, range.max));
  switch (type.size) {
  case 1:
    store(value, static_cast<uint8_t>(bits));
    break;
  case 2:
    store(value, static_cast<uint16_t>(bits));
    break;
  case 4:
    store(value, static_cast<uint32_t>(bits));
    break;
  default:
    store(value, bits);
    break;
  }
}

void storeBool(std::string_view text, void *value) {
  const std::string word = common::lowerCase(withoutPrefix(text, "BOOL"));
  if (word == "true" || word == "1")
    store(value, BOOL{1});
  else if (word == "false" || word == "0")
    store(value, BOOL{0});
  else
    notA(text, "BOOL", "TRUE or FALSE");
}

void storeReal(const TypeDesc &type, std::string_view text, void *value) {
  const std::string_view digits = withoutPrefix(text, type.name);
  const text::Scanned number = text::scanReal(digits.data(), length(digits));
  double real = number.real;
  if (number.used == 0 || number.used != digits.size()) {
    const text::Scanned based = text::scanInteger(digits.data(), length(digits));
    if (based.used == 0 || based.used != digits.size() || based.overflow)
      notA(text, type.name, "50, -0.5 or 1.5e3");
    real = static_cast<double>(based.magnitude);
    if (based.negative)
      real = -real;
  }
  if (number.overflow ||
      (type.kind == Kind::REAL && std::isfinite(real) && std::isinf(static_cast<float>(real))))
    throw Error(fmt::format("{} is out of range for {}", text, type.name));
  if (type.kind == Kind::REAL)
    store(value, static_cast<float>(real));
  else
    store(value, real);
}

/// Times and dates: what the scan gave, in the units of the type.
void storeTime(const TypeDesc &type, std::string_view text, const text::Scanned &scanned,
               const char *example, void *value) {
  if (scanned.used == 0 || scanned.used != text.size())
    notA(text, type.name, example);
  const int64_t units = scanned.ns / detail::unitNs(type.kind);
  const bool fits =
      !scanned.overflow && (type.size == 8 || (scanned.ns >= 0 && units <= int64_t{UINT32_MAX}));
  if (!fits)
    throw Error(fmt::format("{} is out of range for {}", text, type.name));
  if (type.size == 8)
    store(value, scanned.ns);
  else
    store(value, static_cast<uint32_t>(units));
}

uint32_t takeUtf8(std::string_view text, size_t &at) {
  const auto byte = [&](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const uint32_t first = byte(at);
  const auto follows = [&](size_t n) {
    for (size_t i = 1; i <= n; ++i) {
      if ((byte(at + i) & 0xC0U) != 0x80U)
        return false;
    }
    return true;
  };
  uint32_t c = first; // not UTF-8: taken as Latin-1
  size_t used = 1;
  if (first >= 0xC2 && first < 0xE0 && follows(1)) {
    c = ((first & 0x1FU) << 6) | (byte(at + 1) & 0x3FU);
    used = 2;
  } else if (first >= 0xE0 && first < 0xF0 && follows(2)) {
    c = ((first & 0x0FU) << 12) | ((byte(at + 1) & 0x3FU) << 6) | (byte(at + 2) & 0x3FU);
    used = 3;
  } else if (first >= 0xF0 && first < 0xF5 && follows(3)) {
    c = ((first & 0x07U) << 18) | ((byte(at + 1) & 0x3FU) << 12) | ((byte(at + 2) & 0x3FU) << 6) |
        (byte(at + 3) & 0x3FU);
    used = 4;
  }
  at += used;
  return c;
}

/// What stands after a $; false when it is no escape.
bool takeEscape(std::string_view body, size_t &at, size_t hexDigits, uint32_t &c) {
  if (at >= body.size())
    return false;
  const char kind = body[at];
  switch (kind) {
  case '$':
  case '\'':
  case '"':
    c = static_cast<uint32_t>(kind);
    ++at;
    return true;
  case 'L':
  case 'l':
  case 'N':
  case 'n':
    c = '\n';
    ++at;
    return true;
  case 'P':
  case 'p':
    c = '\f';
    ++at;
    return true;
  case 'R':
  case 'r':
    c = '\r';
    ++at;
    return true;
  case 'T':
  case 't':
    c = '\t';
    ++at;
    return true;
  default:
    break;
  }
  if (at + hexDigits > body.size())
    return false;
  c = 0;
  for (size_t i = 0; i < hexDigits; ++i) {
    const char d = body[at + i];
    uint32_t digit = 0;
    if (d >= '0' && d <= '9')
      digit = static_cast<uint32_t>(d - '0');
    else if (d >= 'A' && d <= 'F')
      digit = static_cast<uint32_t>(d - 'A' + 10);
    else if (d >= 'a' && d <= 'f')
      digit = static_cast<uint32_t>(d - 'a' + 10);
    else
      return false;
    c = c * 16 + digit;
  }
  at += hexDigits;
  return true;
}

void storeString(const TypeDesc &type, std::string_view text, void *value) {
  const bool wide = type.kind == Kind::WSTRING || type.kind == Kind::WCHAR;
  const char quote = wide ? '"' : '\'';
  const char *example = wide ? "\"abc\"" : "'abc'";
  if (text.size() < 2 || text.front() != quote || text.back() != quote)
    notA(text, type.name, example);
  const std::string_view body = text.substr(1, text.size() - 2);
  std::vector<uint32_t> units;
  for (size_t at = 0; at < body.size();) {
    uint32_t c = 0;
    if (body[at] == '$') {
      ++at;
      if (!takeEscape(body, at, wide ? 4 : 2, c))
        throw Error(fmt::format("{} has an unknown escape; $$ is a dollar sign, $' a quote, ${} "
                                "a character by its number",
                                text, wide ? "0041" : "41"));
    } else if (body[at] == quote) {
      notA(text, type.name, example);
    } else {
      c = takeUtf8(body, at);
    }
    if (!wide && c > 0xFF)
      throw Error(fmt::format("{} has a character that a STRING (Latin-1) cannot hold", text));
    if (c > 0xFFFF) {
      units.push_back(0xD800 + ((c - 0x10000) >> 10));
      c = 0xDC00 + ((c - 0x10000) & 0x3FF);
    }
    units.push_back(c);
  }
  if (units.size() > type.stringLength)
    throw Error(fmt::format("{} has {} characters, {} holds {}", text, units.size(), type.name,
                            type.stringLength));
  auto *bytes = static_cast<unsigned char *>(value);
  std::memset(bytes, 0, type.size);
  for (size_t i = 0; i < units.size(); ++i) {
    if (wide)
      store(bytes + i * 2, static_cast<uint16_t>(units[i]));
    else
      bytes[i] = static_cast<unsigned char>(units[i]);
  }
}

void storeEnum(const StrideAppV1 &app, const TypeDesc &type, std::string_view text, void *value) {
  std::string_view name = withoutPrefix(text, type.name);
  const size_t dot = name.find('.');
  if (dot != std::string_view::npos &&
      common::lowerCase(name.substr(0, dot)) == common::lowerCase(type.name))
    name = name.substr(dot + 1);
  const std::string wanted = common::lowerCase(name);
  std::vector<std::string> names;
  for (uint32_t i = 0; i < type.memberCount; ++i) {
    const EnumeratorDesc &enumerator = app.enumerators[type.firstMember + i];
    if (common::lowerCase(enumerator.name) == wanted) {
      std::memcpy(value, &enumerator.value, type.size); // little-endian: the low bytes
      return;
    }
    names.emplace_back(enumerator.name);
  }
  const bool number = !name.empty() && (name[0] == '-' || (name[0] >= '0' && name[0] <= '9'));
  if (!number)
    throw Error(
        fmt::format("{} has no enumerator '{}'{}", type.name, name, didYouMean(name, names)));
  parseLiteral(app, app.types[type.element], name, value);
}

} // namespace

void parseLiteral(const StrideAppV1 &app, const TypeDesc &type, std::string_view text,
                  void *value) {
  while (!text.empty() && text.front() == ' ')
    text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ')
    text.remove_suffix(1);
  if (text.empty())
    throw Error(fmt::format("a value of type {} is missing", type.name));
  const char *data = text.data();
  const uint32_t size = length(text);
  if (const std::optional<Range> range = literalRange(type.kind))
    return storeInteger(app, type, *range, text, value);
  switch (type.kind) {
  case Kind::BOOL:
    return storeBool(text, value);
  case Kind::REAL:
  case Kind::LREAL:
    return storeReal(type, text, value);
  case Kind::TIME:
  case Kind::LTIME:
    return storeTime(type, text, text::scanDuration(data, size), "T#1s500ms", value);
  case Kind::DATE:
  case Kind::LDATE:
    return storeTime(type, text, text::scanDate(data, size), "D#2024-02-29", value);
  case Kind::TOD:
  case Kind::LTOD:
    return storeTime(type, text, text::scanTimeOfDay(data, size), "TOD#13:05:00", value);
  case Kind::DT:
  case Kind::LDT:
    return storeTime(type, text, text::scanDateAndTime(data, size), "DT#2024-02-29-13:05:00",
                     value);
  case Kind::STRING:
  case Kind::WSTRING:
  case Kind::CHAR:
  case Kind::WCHAR:
    return storeString(type, text, value);
  case Kind::Enum:
    return storeEnum(app, type, text, value);
  default:
    throw Error(
        fmt::format("a {} cannot be written as a whole; name one of its elements", type.name));
  }
}

} // namespace stride::app
