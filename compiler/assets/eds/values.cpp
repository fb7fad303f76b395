#include "compiler/assets/eds/values.hpp"

#include "compiler/assets/eds/ini.hpp"

#include "runtime/common/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace stc::eds {
namespace {

using stride::common::lowerCase;

struct TypeRow {
  uint16_t type;
  unsigned bits;
  bool isSigned;
  bool isWhole;
  std::string_view name;
};

constexpr std::array<TypeRow, 25> kTypes = {
    {{0x01, 1, false, true, "BOOLEAN"},           {0x02, 8, true, true, "INTEGER8"},
     {0x03, 16, true, true, "INTEGER16"},         {0x04, 32, true, true, "INTEGER32"},
     {0x05, 8, false, true, "UNSIGNED8"},         {0x06, 16, false, true, "UNSIGNED16"},
     {0x07, 32, false, true, "UNSIGNED32"},       {0x08, 32, false, false, "REAL32"},
     {0x09, 0, false, false, "VISIBLE_STRING"},   {0x0A, 0, false, false, "OCTET_STRING"},
     {0x0B, 0, false, false, "UNICODE_STRING"},   {0x0C, 48, false, false, "TIME_OF_DAY"},
     {0x0D, 48, false, false, "TIME_DIFFERENCE"}, {0x0F, 0, false, false, "DOMAIN"},
     {0x10, 24, true, true, "INTEGER24"},         {0x11, 64, false, false, "REAL64"},
     {0x12, 40, true, true, "INTEGER40"},         {0x13, 48, true, true, "INTEGER48"},
     {0x14, 56, true, true, "INTEGER56"},         {0x15, 64, true, true, "INTEGER64"},
     {0x16, 24, false, true, "UNSIGNED24"},       {0x18, 40, false, true, "UNSIGNED40"},
     {0x19, 48, false, true, "UNSIGNED48"},       {0x1A, 56, false, true, "UNSIGNED56"},
     {0x1B, 64, false, true, "UNSIGNED64"}}};

const TypeRow *rowOf(uint16_t type) {
  const auto *const found = std::find_if(kTypes.begin(), kTypes.end(),
                                         [type](const TypeRow &row) { return row.type == type; });
  return found == kTypes.end() ? nullptr : found;
}

std::optional<int64_t> digits(std::string_view text, int base) {
  uint64_t number = 0;
  const char *const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number, base);
  if (text.empty() || error != std::errc() || at != end)
    return std::nullopt;
  return static_cast<int64_t>(number);
}

/// Whether a whole number is one of that type, also written as its bits.
bool fits(const TypeRow &row, int64_t number) {
  if (row.bits >= 64)
    return true;
  const int64_t most = (int64_t{1} << row.bits) - 1;
  const int64_t least = row.isSigned ? -(int64_t{1} << (row.bits - 1)) : 0;
  return number >= least && number <= most;
}

} // namespace

unsigned bitsOf(uint16_t type) {
  const TypeRow *row = rowOf(type);
  return row == nullptr ? 0 : row->bits;
}

bool isSigned(uint16_t type) {
  const TypeRow *row = rowOf(type);
  return row != nullptr && row->isSigned;
}

bool isWhole(uint16_t type) {
  const TypeRow *row = rowOf(type);
  return row != nullptr && row->isWhole;
}

std::string_view typeName(uint16_t type) {
  const TypeRow *row = rowOf(type);
  return row == nullptr ? std::string_view() : row->name;
}

std::optional<int64_t> numberOf(std::string_view text) {
  text = trimmed(text);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+'))
    text.remove_prefix(1);
  std::optional<int64_t> number;
  if (text.starts_with("0x") || text.starts_with("0X"))
    number = digits(text.substr(2), 16);
  else if (text.ends_with('h') || text.ends_with('H'))
    number = digits(text.substr(0, text.size() - 1), 16);
  else
    number = digits(text, 10);
  if (number && negative)
    number = static_cast<int64_t>(0 - static_cast<uint64_t>(*number));
  return number;
}

std::optional<Value> valueOf(std::string_view text) {
  constexpr std::string_view kNodeId = "$nodeid";
  text = trimmed(text);
  const std::string lower = lowerCase(text);
  Value value;
  value.text = text;
  const size_t at = lower.find(kNodeId);
  if (at == std::string::npos) {
    const std::optional<int64_t> number = numberOf(lower);
    if (!number)
      return std::nullopt;
    value.number = *number;
    return value;
  }
  value.plusNodeId = true;
  std::string_view before = trimmed(std::string_view(lower).substr(0, at));
  std::string_view after = trimmed(std::string_view(lower).substr(at + kNodeId.size()));
  if (before.empty() && after.empty())
    return value;
  if (before.empty() == after.empty())
    return std::nullopt;
  std::string_view &rest = before.empty() ? after : before;
  if (before.empty() ? !rest.starts_with('+') : !rest.ends_with('+'))
    return std::nullopt;
  rest = before.empty() ? rest.substr(1) : rest.substr(0, rest.size() - 1);
  const std::optional<int64_t> number = numberOf(rest);
  if (!number)
    return std::nullopt;
  value.number = *number;
  return value;
}

std::optional<Access> accessOf(std::string_view text) {
  constexpr std::pair<std::string_view, Access> kNames[] = {
      {"const", Access::Const},    {"ro", Access::ReadOnly},      {"wo", Access::WriteOnly},
      {"rw", Access::ReadWrite},   {"rwr", Access::Rwr},          {"rww", Access::Rww},
      {"constant", Access::Const}, {"readonly", Access::ReadOnly}};
  const std::string lower = lowerCase(trimmed(text));
  for (const auto &[name, access] : kNames)
    if (lower == name)
      return access;
  return std::nullopt;
}

std::optional<bool> flagOf(std::string_view text) {
  const std::string lower = lowerCase(trimmed(text));
  for (const std::string_view yes :
       {"1", "true", "yes", "optional", "default", "tpdo", "rpdo", "0x1", "0x01"})
    if (lower == yes)
      return true;
  for (const std::string_view no : {"0", "false", "no", "", "0x0", "0x00"})
    if (lower == no)
      return false;
  return std::nullopt;
}

std::string nameOf(const Object &object) {
  return fmt::format("{:04X}h:{}", object.index, object.sub);
}

std::optional<Value> readValue(std::string_view text, size_t line, const Object &object,
                               std::string_view what, Device &device) {
  text = trimmed(text);
  if (text.empty())
    return std::nullopt;
  const TypeRow *row = rowOf(object.type);
  if (row == nullptr || !row->isWhole) {
    Value value = valueOf(text).value_or(Value{});
    value.isText = row != nullptr && !row->isWhole;
    value.text = text;
    return value;
  }
  std::optional<Value> value = valueOf(text);
  if (const size_t remark = text.find(';'); !value && remark != std::string_view::npos) {
    value = valueOf(text.substr(0, remark));
    if (value)
      device.note(line,
                  fmt::format("{} of {}: what stands after ; is left out", what, nameOf(object)));
  }
  if (!value) {
    device.note(line, fmt::format("{} of {}: \"{}\" is no {}: left out", what, nameOf(object), text,
                                  row->name));
    return std::nullopt;
  }
  if (!value->plusNodeId && !fits(*row, value->number))
    device.note(line, fmt::format("{} of {}: {} is more than {} can be", what, nameOf(object), text,
                                  row->name));
  // Negative numbers are often written as their bits: 0xFFFF.
  if (row->isSigned && row->bits < 64 && value->number >= int64_t{1} << (row->bits - 1) &&
      value->number < int64_t{1} << row->bits)
    value->number -= int64_t{1} << row->bits;
  return value;
}

void checkLimits(Object &object, Device &device) {
  if (!object.low || !object.high || !isWhole(object.type) || object.low->plusNodeId ||
      object.high->plusNodeId || object.low->number <= object.high->number)
    return;
  device.note(object.line, fmt::format("the limits of {} exclude each other: both are left out",
                                       nameOf(object)));
  object.low = object.high = std::nullopt;
}

} // namespace stc::eds
