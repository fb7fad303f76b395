#include "drivers/sercos/plan/idn_value.hpp"

#include "runtime/common/setup_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace stride::sercos {
namespace {

using common::trimmed;
using common::wholeNumber;

bool fail(std::string &error, std::string text) {
  error = std::move(text);
  return false;
}

/// "-12", "16#FF", "1_000".
std::optional<int64_t> numberOf(std::string_view text) {
  const auto number = wholeNumber(text);
  if (!number || number->magnitude > static_cast<uint64_t>(INT64_MAX))
    return std::nullopt;
  const auto value = static_cast<int64_t>(number->magnitude);
  return number->negative ? -value : value;
}

} // namespace

bool parseNumbers(std::string_view text, std::vector<int64_t> &numbers) {
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    const std::string_view one = trimmed(text.substr(at, end - at));
    if (const auto idn = parseIdn(one))
      numbers.push_back(*idn);
    else if (const auto number = numberOf(one))
      numbers.push_back(*number);
    else
      return false;
    at = end + 1;
  }
  return true;
}

bool parseIdnValue(std::string_view text, IdnValue &value, std::string &error) {
  value = {};
  const size_t sign = text.find(":=");
  if (sign == std::string_view::npos)
    return fail(error, "an entry is an IDN and its value: \"S-0-0041 := 100\"");
  const auto idn = parseIdn(trimmed(text.substr(0, sign)));
  if (!idn)
    return fail(error, "an IDN is written as S-0-0041 or P-0-0001");
  value.idn = *idn;
  const std::string_view given = trimmed(text.substr(sign + 2));
  if (given.size() >= 2 && given.front() == '\'' && given.back() == '\'') {
    value.isText = true;
    value.text = given.substr(1, given.size() - 2);
    return true;
  }
  if (!parseNumbers(given, value.numbers))
    return fail(error, "a value is a whole number, several of them or IDNs with commas between, or "
                       "a text in single quotes");
  return true;
}

std::string_view describe(EncodeFault fault) {
  constexpr std::array<std::string_view, 5> kTexts = {
      "nothing", "it is one number", "a number does not fit", "it is too long", "it is no text"};
  return kTexts[static_cast<size_t>(fault)];
}

EncodeFault encodeValue(const IdnValue &value, const Attribute &attribute, std::span<uint8_t> bytes,
                        size_t &count) {
  count = 0;
  if (value.isText) {
    if (!attribute.list || attribute.bytes != 1)
      return EncodeFault::NoText;
    if (value.text.size() > bytes.size())
      return EncodeFault::TooLong;
    std::copy(value.text.begin(), value.text.end(), bytes.begin());
    count = value.text.size();
    return EncodeFault::None;
  }
  if (!attribute.list && value.numbers.size() != 1)
    return EncodeFault::NotOne;
  const size_t size = attribute.bytes;
  if (value.numbers.size() * size > bytes.size())
    return EncodeFault::TooLong;
  for (const int64_t number : value.numbers) {
    // What is signed and what is not only the drive knows for certain: both are taken.
    const unsigned bits = 8U * static_cast<unsigned>(size);
    if (bits < 64 && (number >= int64_t{1} << bits || number < -(int64_t{1} << (bits - 1))))
      return EncodeFault::Range;
    for (size_t i = 0; i < size; ++i)
      bytes[count++] = static_cast<uint8_t>(static_cast<uint64_t>(number) >> 8 * i);
  }
  return EncodeFault::None;
}

} // namespace stride::sercos
