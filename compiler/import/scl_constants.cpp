#include "compiler/import/scl_constants.hpp"

#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

namespace stc::import {

namespace scl_constants {
namespace {

/// Words before `#`, and the type of such a literal.
constexpr std::array<std::pair<std::string_view, std::string_view>, 33> kPrefixes = {
    {{"T", "TIME"},          {"TIME", "TIME"},   {"LT", "LTIME"},      {"LTIME", "LTIME"},
     {"D", "DATE"},          {"DATE", "DATE"},   {"LD", "LDATE"},      {"TOD", "TOD"},
     {"TIME_OF_DAY", "TOD"}, {"LTOD", "LTOD"},   {"DT", "DT"},         {"DATE_AND_TIME", "DT"},
     {"LDT", "LDT"},         {"BOOL", "BOOL"},   {"BYTE", "BYTE"},     {"WORD", "WORD"},
     {"DWORD", "DWORD"},     {"LWORD", "LWORD"}, {"SINT", "SINT"},     {"INT", "INT"},
     {"DINT", "DINT"},       {"LINT", "LINT"},   {"USINT", "USINT"},   {"UINT", "UINT"},
     {"UDINT", "UDINT"},     {"ULINT", "ULINT"}, {"REAL", "REAL"},     {"LREAL", "LREAL"},
     {"CHAR", "CHAR"},       {"WCHAR", "WCHAR"}, {"STRING", "STRING"}, {"WSTRING", "WSTRING"},
     {"LDATE", "LDATE"}}};

/// The integer types that a constant may get, the smallest first.
struct Range {
  std::string_view type;
  uint64_t largest;
  uint64_t smallest; ///< without its sign
};
constexpr std::array<Range, 5> kRanges = {
    {{"INT", 0x7FFF, 0x8000},
     {"DINT", 0x7FFF'FFFF, 0x8000'0000},
     {"UDINT", 0xFFFF'FFFF, 0},
     {"LINT", std::numeric_limits<int64_t>::max(), 0x8000'0000'0000'0000},
     {"ULINT", std::numeric_limits<uint64_t>::max(), 0}}};

std::string_view integerType(std::string digits, bool negative) {
  std::erase(digits, '_');
  int base = 10;
  if (const size_t hash = digits.find('#'); hash != std::string::npos) {
    const std::string_view written = std::string_view(digits).substr(0, hash);
    base = written == "16" ? 16 : written == "8" ? 8 : written == "2" ? 2 : 0;
    digits.erase(0, hash + 1);
  }
  uint64_t number = 0;
  if (base == 0)
    return {};
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number, base);
  if (error != std::errc() || end != digits.data() + digits.size())
    return {};
  const auto *const range = std::ranges::find_if(kRanges, [&](const Range &each) {
    return number <= (negative ? each.smallest : each.largest);
  });
  return range == kRanges.end() ? std::string_view() : range->type;
}

/// The sign and digits at `at`, which goes after them; nothing when none are there.
std::optional<unsigned> digitsAt(std::string_view text, size_t &at) {
  unsigned number = 0;
  const char *const begin = text.data() + std::min(at, text.size());
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  if (error != std::errc())
    return {};
  at += static_cast<size_t>(end - begin);
  return number;
}

/// `.25` of a second as nanoseconds; nothing when it has more than nine digits.
std::optional<unsigned> nanoseconds(std::string_view fraction) {
  if (fraction.empty())
    return 0;
  if (fraction.size() < 2 || fraction.size() > 10 || fraction.front() != '.')
    return {};
  std::string digits(fraction.substr(1));
  digits.resize(9, '0');
  size_t at = 0;
  const auto number = digitsAt(digits, at);
  return at == digits.size() ? number : std::nullopt;
}

/// How many values a type has, and of how many bits each is.
struct Shape {
  uint64_t count = 1;
  unsigned bits = 0;
};

/// Types whose values have the same bits here. DATE and S5TIME have not.
unsigned bitsOf(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, unsigned>, 18> kBits = {{{"BYTE", 8},
                                                                            {"SINT", 8},
                                                                            {"USINT", 8},
                                                                            {"CHAR", 8},
                                                                            {"WORD", 16},
                                                                            {"INT", 16},
                                                                            {"UINT", 16},
                                                                            {"DWORD", 32},
                                                                            {"DINT", 32},
                                                                            {"UDINT", 32},
                                                                            {"REAL", 32},
                                                                            {"TIME", 32},
                                                                            {"LWORD", 64},
                                                                            {"LINT", 64},
                                                                            {"ULINT", 64},
                                                                            {"LREAL", 64},
                                                                            {"LTIME", 64},
                                                                            {"TOD", 32}}};
  const auto *const found =
      std::ranges::find(kBits, type, &std::pair<std::string_view, unsigned>::first);
  return found == kBits.end() ? 0 : found->second;
}

/// Of an elementary type or `ARRAY [1..4] OF WORD`; nothing for all others.
std::optional<Shape> shapeOf(std::string_view type) {
  std::string text = stride::common::upperCase(type);
  std::erase_if(text, [](char c) { return static_cast<unsigned char>(c) <= ' '; });
  Shape shape;
  std::string_view element = text;
  if (text.starts_with("ARRAY[")) {
    const size_t dots = text.find("..");
    const size_t close = text.find(']');
    if (dots == std::string::npos || close == std::string::npos ||
        text.compare(close, 3, "]OF") != 0)
      return {};
    int64_t low = 0;
    int64_t high = 0;
    const char *const data = text.data();
    if (std::from_chars(data + 6, data + dots, low).ptr != data + dots ||
        std::from_chars(data + dots + 2, data + close, high).ptr != data + close || high < low)
      return {};
    shape.count = static_cast<uint64_t>(high) - static_cast<uint64_t>(low) + 1;
    element = std::string_view(text).substr(close + 3);
  }
  shape.bits = bitsOf(element);
  return shape.bits == 0 ? std::nullopt : std::optional(shape);
}

} // namespace
} // namespace scl_constants

std::string_view sclConstantType(std::string_view value) {
  const std::string upper = stride::common::upperCase(value);
  if (upper.starts_with('\''))
    return "STRING";
  if (upper == "TRUE" || upper == "FALSE")
    return "BOOL";
  if (upper.starts_with("(YEAR :="))
    return "DTL"; // what sclDateValue() makes
  if (const size_t hash = upper.find('#'); hash != std::string::npos)
    for (const auto &[prefix, type] : scl_constants::kPrefixes)
      if (std::string_view(upper).substr(0, hash) == prefix)
        return type;
  const size_t sign = upper.starts_with('-') || upper.starts_with('+') ? 1 : 0;
  if (upper.size() == sign || upper[sign] < '0' || upper[sign] > '9' ||
      upper.find_first_not_of("0123456789ABCDEF_#.+-", sign) != std::string::npos)
    return {};
  if (upper.find('#') == std::string::npos &&
      upper.find_first_not_of("0123456789_", sign) != std::string::npos) {
    double number = 0;
    const auto [end, error] =
        std::from_chars(upper.data() + sign, upper.data() + upper.size(), number);
    return error == std::errc() && end == upper.data() + upper.size() ? "REAL" : "";
  }
  return scl_constants::integerType(upper.substr(sign), upper.front() == '-');
}

std::optional<std::string> sclDateValue(std::string_view literal) {
  size_t at = std::min(literal.find('#'), literal.size() - 1) + 1;
  std::array<unsigned, 6> parts{}; // year, month, day, hour, minute, second
  constexpr std::string_view kBetween = "---::";
  for (size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && (at >= literal.size() || literal[at++] != kBetween[i - 1]))
      return {};
    const auto number = scl_constants::digitsAt(literal, at);
    if (!number)
      return {};
    parts[i] = *number;
  }
  const auto fraction = scl_constants::nanoseconds(literal.substr(at));
  const auto &[year, month, day, hour, minute, second] = parts;
  if (!fraction || year < 1970 || year > 2262 || hour > 23 || minute > 59 || second > 59)
    return {};
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(month), std::chrono::day(day)};
  if (!date.ok())
    return {};
  const unsigned weekday = std::chrono::weekday(std::chrono::sys_days(date)).c_encoding() + 1;
  return fmt::format("(YEAR := {}, MONTH := {}, DAY := {}, WEEKDAY := {}, HOUR := {}, MINUTE := "
                     "{}, SECOND := {}, NANOSECOND := {})",
                     year, month, day, weekday, hour, minute, second, *fraction);
}

bool isSclViewKept(std::string_view as, std::string_view of) {
  const auto view = scl_constants::shapeOf(as);
  const auto seen = scl_constants::shapeOf(of);
  return view && seen && view->bits == seen->bits && view->count <= seen->count;
}

} // namespace stc::import
