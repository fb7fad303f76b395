#include "runtime/monitor/value_json.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>

namespace stride::monitor {

namespace {

using nlohmann::json;

template <class T> json numberOf(const void *value) {
  T number;
  std::memcpy(&number, value, sizeof number);
  return number;
}

json realOf(const StrideAppV1 &app, const TypeDesc &type, const void *value) {
  // The shortest text that reads back the same: a REAL of 0.1 is 0.1, not 0.10000000149.
  std::string text;
  app::appendCsv(app, type, value, text);
  double number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end.ec == std::errc() && std::isfinite(number))
    return number;
  return text;
}

/// What stands between the quotes of the CSV field.
json textOf(const StrideAppV1 &app, const TypeDesc &type, const void *value) {
  std::string field;
  app::appendCsv(app, type, value, field);
  std::string text;
  for (size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"')
      ++i; // doubled
  }
  return text;
}

std::string quoted(Kind kind, const std::string &text) {
  const bool narrow = kind == Kind::STRING || kind == Kind::CHAR;
  const char quote = narrow ? '\'' : '"';
  std::string literal(1, quote);
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == quote || c == '$')
      literal += {'$', c};
    else if (code < 0x20)
      literal += narrow ? fmt::format("${:02X}", code) : fmt::format("${:04X}", code);
    else
      literal += c;
  }
  return literal + quote;
}

} // namespace

json valueToJson(const StrideAppV1 &app, const TypeDesc &type, const void *value) {
  switch (type.kind) {
  case Kind::BOOL:
    return *static_cast<const std::byte *>(value) != std::byte{0};
  case Kind::SINT:
    return numberOf<int8_t>(value);
  case Kind::INT:
    return numberOf<int16_t>(value);
  case Kind::DINT:
    return numberOf<int32_t>(value);
  case Kind::LINT:
    return numberOf<int64_t>(value);
  case Kind::USINT:
  case Kind::BYTE:
    return numberOf<uint8_t>(value);
  case Kind::UINT:
  case Kind::WORD:
    return numberOf<uint16_t>(value);
  case Kind::UDINT:
  case Kind::DWORD:
    return numberOf<uint32_t>(value);
  case Kind::ULINT:
  case Kind::LWORD:
    return numberOf<uint64_t>(value);
  case Kind::REAL:
  case Kind::LREAL:
    return realOf(app, type, value);
  default:
    return app::isText(type.kind) ? textOf(app, type, value)
                                  : json(app::formatLiteral(app, type, value));
  }
}

std::string literalOfJson(const TypeDesc &type, const json &value) {
  if (value.is_boolean())
    return value.get<bool>() ? "TRUE" : "FALSE";
  if (value.is_number())
    return value.dump();
  if (!value.is_string())
    throw app::Error("a value is true, false, a number or a text");
  const auto &text = value.get_ref<const std::string &>();
  return app::isText(type.kind) ? quoted(type.kind, text) : text;
}

} // namespace stride::monitor
