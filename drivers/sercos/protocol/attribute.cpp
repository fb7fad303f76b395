#include "drivers/sercos/protocol/attribute.hpp"

#include <bit>

namespace stride::sercos {
namespace {

constexpr unsigned kLengthShift = 16;
constexpr unsigned kCommandShift = 19;
constexpr unsigned kDisplayShift = 20;
constexpr unsigned kDecimalsShift = 24;
constexpr unsigned kProtectionShift = 28;
constexpr uint32_t kListLength = 4; // 1, 2, 3: 2, 4, 8 bytes; 4 … 7: lists of 1, 2, 4, 8 bytes

} // namespace

bool Attribute::writableIn(Phase phase) const {
  switch (phase) {
  case Phase::Two:
    return (protection & protect::kPhase2) == 0;
  case Phase::Three:
    return (protection & protect::kPhase3) == 0;
  case Phase::Four:
    return (protection & protect::kPhase4) == 0;
  default:
    return false;
  }
}

uint32_t encode(const Attribute &attribute) {
  const auto power = static_cast<uint32_t>(std::countr_zero(uint32_t{attribute.bytes}));
  const uint32_t length = attribute.list ? kListLength + power : power;
  return attribute.factor | (length << kLengthShift) |
         (uint32_t{attribute.command} << kCommandShift) |
         (static_cast<uint32_t>(attribute.display) << kDisplayShift) |
         ((attribute.decimals & 15U) << kDecimalsShift) |
         ((attribute.protection & uint32_t{protect::kAlways}) << kProtectionShift);
}

Attribute decodeAttribute(uint32_t bits) {
  Attribute attribute;
  attribute.factor = static_cast<uint16_t>(bits);
  const uint32_t length = (bits >> kLengthShift) & 7U;
  attribute.list = length >= kListLength;
  const uint32_t power = attribute.list ? length - kListLength : length;
  attribute.bytes = static_cast<uint8_t>(length == 0 ? 2U : 1U << power);
  attribute.command = ((bits >> kCommandShift) & 1U) != 0;
  attribute.display = static_cast<Display>((bits >> kDisplayShift) & 7U);
  attribute.decimals = static_cast<uint8_t>((bits >> kDecimalsShift) & 15U);
  attribute.protection = static_cast<uint8_t>((bits >> kProtectionShift) & protect::kAlways);
  return attribute;
}

} // namespace stride::sercos
