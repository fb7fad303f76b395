#include "runtime/app/value_text.hpp"

#include "runtime/iec/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

namespace stride::app {

namespace {

template <class T> T load(const void *p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

void appendUtf8(std::string &out, uint32_t c) {
  if (c < 0x80) {
    out.push_back(static_cast<char>(c));
  } else if (c < 0x800) {
    out.push_back(static_cast<char>(0xC0 | (c >> 6)));
    out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
  } else if (c < 0x10000) {
    out.push_back(static_cast<char>(0xE0 | (c >> 12)));
    out.push_back(static_cast<char>(0x80 | ((c >> 6) & 0x3F)));
    out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
  } else {
    out.push_back(static_cast<char>(0xF0 | (c >> 18)));
    out.push_back(static_cast<char>(0x80 | ((c >> 12) & 0x3F)));
    out.push_back(static_cast<char>(0x80 | ((c >> 6) & 0x3F)));
    out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
  }
}

bool isNarrow(Kind kind) { return kind == Kind::STRING || kind == Kind::CHAR; }

/// Calls `take` with each character of a STRING or WSTRING variable; surrogate pairs are joined.
template <class F> void eachCharacter(const TypeDesc &type, const void *value, F take) {
  const auto *bytes = static_cast<const unsigned char *>(value);
  if (isNarrow(type.kind)) {
    for (uint32_t i = 0; i < type.stringLength && bytes[i] != 0; ++i)
      take(uint32_t{bytes[i]});
    return;
  }
  for (uint32_t i = 0; i < type.stringLength; ++i) {
    uint32_t c = load<uint16_t>(bytes + size_t{i} * 2);
    if (c == 0)
      return;
    if (c >= 0xD800 && c < 0xDC00 && i + 1 < type.stringLength) {
      const uint32_t low = load<uint16_t>(bytes + (size_t{i} + 1) * 2);
      if (low >= 0xDC00 && low < 0xE000) {
        c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
        ++i;
      }
    }
    take(c >= 0xD800 && c < 0xE000 ? uint32_t{0xFFFD} : c);
  }
}

std::string stringLiteral(const TypeDesc &type, const void *value) {
  const char quote = isNarrow(type.kind) ? '\'' : '"';
  std::string out(1, quote);
  eachCharacter(type, value, [&](uint32_t c) {
    if (c == static_cast<uint32_t>(quote) || c == '$') {
      out.push_back('$');
      out.push_back(static_cast<char>(c));
    } else if (c == '\n') {
      out += "$L";
    } else if (c == '\r') {
      out += "$R";
    } else if (c == '\t') {
      out += "$T";
    } else if (c < 0x20 || (c >= 0x7F && c < 0xA0)) {
      out += isNarrow(type.kind) ? fmt::format("${:02X}", c) : fmt::format("${:04X}", c);
    } else {
      appendUtf8(out, c);
    }
  });
  out.push_back(quote);
  return out;
}

int64_t loadInteger(Kind kind, const void *value) {
  switch (kind) {
  case Kind::SINT:
    return load<int8_t>(value);
  case Kind::INT:
    return load<int16_t>(value);
  case Kind::DINT:
    return load<int32_t>(value);
  case Kind::LINT:
  case Kind::LTIME:
  case Kind::LDATE:
  case Kind::LTOD:
  case Kind::LDT:
  case Kind::ULINT:
  case Kind::LWORD:
    return load<int64_t>(value);
  case Kind::BOOL:
  case Kind::USINT:
  case Kind::BYTE:
    return load<uint8_t>(value);
  case Kind::UINT:
  case Kind::WORD:
    return load<uint16_t>(value);
  default:
    return load<uint32_t>(value);
  }
}

template <class T> void appendNumber(std::string &out, T value) {
  char buffer[64];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

} // namespace

bool isText(Kind kind) { return isNarrow(kind) || kind == Kind::WSTRING || kind == Kind::WCHAR; }

std::string formatLiteral(const StrideAppV1 &app, const TypeDesc &type, const void *value) {
  if (isText(type.kind))
    return stringLiteral(type, value);
  if (type.kind == Kind::Enum) {
    const TypeDesc &base = app.types[type.element];
    const int64_t number = loadInteger(base.kind, value);
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      const EnumeratorDesc &enumerator = app.enumerators[type.firstMember + i];
      if (enumerator.value == number)
        return enumerator.name;
    }
    return formatLiteral(app, base, value);
  }
  char buffer[text::kBufferSize];
  const uint32_t length = text::formatValue(buffer, type.kind, value);
  return std::string(buffer, length);
}

void appendCsv(const StrideAppV1 &app, const TypeDesc &type, const void *value, std::string &out) {
  switch (type.kind) {
  case Kind::REAL:
    appendNumber(out, load<float>(value));
    break;
  case Kind::LREAL:
    appendNumber(out, load<double>(value));
    break;
  case Kind::ULINT:
  case Kind::LWORD:
    appendNumber(out, load<uint64_t>(value));
    break;
  case Kind::BOOL:
    out.push_back(load<uint8_t>(value) != 0 ? '1' : '0');
    break;
  case Kind::STRING:
  case Kind::WSTRING:
  case Kind::CHAR:
  case Kind::WCHAR:
    out.push_back('"');
    eachCharacter(type, value, [&out](uint32_t c) {
      if (c == '"')
        out.push_back('"');
      appendUtf8(out, c);
    });
    out.push_back('"');
    break;
  case Kind::Enum:
    appendCsv(app, app.types[type.element], value, out);
    break;
  default:
    appendNumber(out, loadInteger(type.kind, value));
    break;
  }
}

size_t csvWidth(const TypeDesc &type) {
  const bool quoted = isText(type.kind);
  return quoted ? size_t{type.stringLength} * 3 + 2 : 32;
}

} // namespace stride::app
