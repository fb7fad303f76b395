// The checksum of files: CRC-32 of IEEE 802.3. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_CRC32_HPP
#define STRIDE_RUNTIME_NUMERIC_CRC32_HPP

#include <stdint.h>

namespace stride::numeric {

/// Of several pieces: what it returns is `before` of the next; 0 of the first.
inline uint32_t crc32(uint32_t before, const void *bytes, int64_t count) noexcept {
  // Half a byte at a time.
  constexpr uint32_t kTable[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC,
                                   0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
                                   0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                                   0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
  const auto *next = static_cast<const uint8_t *>(bytes);
  uint32_t value = ~before;
  for (int64_t i = 0; i < count; ++i) {
    value ^= next[i];
    value = (value >> 4) ^ kTable[value & 15U];
    value = (value >> 4) ^ kTable[value & 15U];
  }
  return ~value;
}

} // namespace stride::numeric

#endif // STRIDE_RUNTIME_NUMERIC_CRC32_HPP
