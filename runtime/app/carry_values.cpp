#include "runtime/app/carry_values.hpp"

#include "runtime/app/type_match.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace stride::app {

namespace {

template <class T> struct Tag { using Type = T; };

/// Calls f with the C++ type of a numeric, time or date kind.
template <class F> void withType(Kind kind, F f) {
  switch (kind) {
  case Kind::BOOL:
  case Kind::USINT:
  case Kind::BYTE:
    return f(Tag<uint8_t>());
  case Kind::SINT:
    return f(Tag<int8_t>());
  case Kind::INT:
    return f(Tag<int16_t>());
  case Kind::UINT:
  case Kind::WORD:
    return f(Tag<uint16_t>());
  case Kind::DINT:
    return f(Tag<int32_t>());
  case Kind::UDINT:
  case Kind::DWORD:
  case Kind::TIME:
  case Kind::DATE:
  case Kind::TOD:
  case Kind::DT:
    return f(Tag<uint32_t>());
  case Kind::LINT:
  case Kind::LTIME:
  case Kind::LDATE:
  case Kind::LTOD:
  case Kind::LDT:
    return f(Tag<int64_t>());
  case Kind::ULINT:
  case Kind::LWORD:
    return f(Tag<uint64_t>());
  case Kind::REAL:
    return f(Tag<float>());
  case Kind::LREAL:
    return f(Tag<double>());
  default:
    return;
  }
}

template <class From, class To, int64_t Scale>
void convert(const std::byte *from, std::byte *to, uint64_t count, uint64_t fromStride,
             uint64_t toStride) {
  for (uint64_t i = 0; i < count; ++i) {
    From a;
    std::memcpy(&a, from + i * fromStride, sizeof a);
    const To b = static_cast<To>(static_cast<To>(a) * static_cast<To>(Scale));
    std::memcpy(to + i * toStride, &b, sizeof b);
  }
}

} // namespace

NumberConversion numberConversion(Kind from, Kind to) {
  if (!keepsEveryValue(from, to))
    return nullptr;
  switch (to) {
  case Kind::LTIME:
  case Kind::LTOD:
    if (from != to)
      return convert<uint32_t, int64_t, 1'000'000>;
    break;
  case Kind::LDATE:
  case Kind::LDT:
    if (from != to)
      return convert<uint32_t, int64_t, 1'000'000'000>;
    break;
  default:
    break;
  }
  NumberConversion found = nullptr;
  withType(from, [&](auto a) {
    withType(to, [&](auto b) {
      using From = typename decltype(a)::Type;
      using To = typename decltype(b)::Type;
      found = convert<From, To, 1>;
    });
  });
  return found;
}

bool carryText(const std::byte *from, uint32_t fromLength, std::byte *to, uint32_t toLength,
               uint32_t unit) noexcept {
  constexpr std::byte kZero[2] = {};
  const uint32_t most = std::min(fromLength, toLength);
  uint32_t length = 0;
  while (length < most && std::memcmp(from + size_t{length} * unit, kZero, unit) != 0)
    ++length;
  const bool all =
      length == fromLength || std::memcmp(from + size_t{length} * unit, kZero, unit) == 0;
  std::memcpy(to, from, size_t{length} * unit);
  std::memset(to + size_t{length} * unit, 0, size_t{toLength + 1 - length} * unit);
  return all;
}

int64_t readInteger(Kind kind, const std::byte *from) noexcept {
  int64_t value = 0;
  withType(kind, [&](auto tag) {
    typename decltype(tag)::Type own;
    std::memcpy(&own, from, sizeof own);
    value = static_cast<int64_t>(own);
  });
  return value;
}

void writeInteger(Kind kind, int64_t value, std::byte *to) noexcept {
  withType(kind, [&](auto tag) {
    const auto own = static_cast<typename decltype(tag)::Type>(value);
    std::memcpy(to, &own, sizeof own);
  });
}

} // namespace stride::app
