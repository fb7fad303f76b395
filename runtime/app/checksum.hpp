// CRC-64/XZ: polynomial 42F0E1EBA9EA3693, reflected.
#ifndef STRIDE_RUNTIME_APP_CHECKSUM_HPP
#define STRIDE_RUNTIME_APP_CHECKSUM_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::app {

namespace detail {

constexpr std::array<uint64_t, 256> makeCrcTable() {
  std::array<uint64_t, 256> table{};
  for (uint64_t i = 0; i < table.size(); ++i) {
    uint64_t value = i;
    for (int bit = 0; bit < 8; ++bit)
      value = (value >> 1) ^ ((value & 1) != 0 ? 0xC96C5795D7870F42ULL : 0);
    table[i] = value;
  }
  return table;
}

inline constexpr std::array<uint64_t, 256> kCrcTable = makeCrcTable();

} // namespace detail

/// The checksum of several pieces, one after the other: the result of one is `before` of the next.
constexpr uint64_t crc64(std::span<const std::byte> bytes, uint64_t before = 0) {
  uint64_t value = ~before;
  for (const std::byte byte : bytes)
    value = detail::kCrcTable[(value ^ static_cast<uint64_t>(byte)) & 0xFF] ^ (value >> 8);
  return ~value;
}

} // namespace stride::app

#endif
