#include "compiler/toml/interval.hpp"

#include "compiler/source/identifier.hpp"

#include <array>
#include <cctype>

namespace stc {

namespace {

__extension__ using Wide = __int128;

struct Unit {
  std::string_view name;
  int64_t nanoseconds;
};
constexpr std::array<Unit, 7> kUnits = {{{"d", 86'400'000'000'000},
                                         {"h", 3'600'000'000'000},
                                         {"m", 60'000'000'000},
                                         {"s", 1'000'000'000},
                                         {"ms", 1'000'000},
                                         {"us", 1'000},
                                         {"ns", 1}}};

std::string lowered(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != '_')
      result += lowerCase(c);
  return result;
}

} // namespace

std::optional<int64_t> parseInterval(std::string_view text) {
  const std::string lower = lowered(text);
  std::string_view rest = lower;
  for (const std::string_view prefix : {"ltime#", "time#", "lt#", "t#"})
    if (rest.starts_with(prefix)) {
      rest.remove_prefix(prefix.size());
      break;
    }
  if (rest.empty())
    return std::nullopt;
  Wide total = 0;
  size_t next = 0; // units must come in descending order
  while (!rest.empty()) {
    size_t digits = 0;
    Wide value = 0;
    while (digits < rest.size() && std::isdigit(static_cast<unsigned char>(rest[digits])) &&
           digits < 19)
      value = value * 10 + (rest[digits++] - '0');
    if (digits == 0)
      return std::nullopt;
    rest.remove_prefix(digits);
    Wide numerator = 0;
    Wide denominator = 1;
    if (rest.starts_with('.')) {
      rest.remove_prefix(1);
      digits = 0;
      while (digits < rest.size() && std::isdigit(static_cast<unsigned char>(rest[digits])) &&
             digits < 15) {
        numerator = numerator * 10 + (rest[digits++] - '0');
        denominator *= 10;
      }
      if (digits == 0)
        return std::nullopt;
      rest.remove_prefix(digits);
    }
    size_t letters = 0;
    while (letters < rest.size() && std::isalpha(static_cast<unsigned char>(rest[letters])))
      ++letters;
    size_t unit = next;
    while (unit < kUnits.size() && kUnits[unit].name != rest.substr(0, letters))
      ++unit;
    if (unit == kUnits.size())
      return std::nullopt;
    rest.remove_prefix(letters);
    if (denominator != 1 && !rest.empty())
      return std::nullopt; // only the last number has decimals
    total += value * kUnits[unit].nanoseconds + numerator * kUnits[unit].nanoseconds / denominator;
    if (total > INT64_MAX)
      return std::nullopt;
    next = unit + 1;
  }
  return static_cast<int64_t>(total);
}

std::string formatInterval(int64_t nanoseconds) {
  if (nanoseconds <= 0)
    return "T#0ms";
  const bool fine = nanoseconds % 1'000'000 != 0;
  std::string result = fine ? "LT#" : "T#";
  for (const Unit &unit : kUnits)
    if (const int64_t count = nanoseconds / unit.nanoseconds; count != 0) {
      result += std::to_string(count) + std::string(unit.name);
      nanoseconds %= unit.nanoseconds;
    }
  return result;
}

} // namespace stc
