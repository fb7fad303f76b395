// The check sum of SDO block transfers. [CiA 301, 7.2.4.3.16]
#ifndef STRIDE_DRIVERS_CAN_MASTER_CRC16_HPP
#define STRIDE_DRIVERS_CAN_MASTER_CRC16_HPP

#include <cstdint>
#include <span>

namespace stride::can {

/// x^16 + x^12 + x^5 + 1, most significant bit first, from 0.
constexpr uint16_t crc16(std::span<const uint8_t> bytes) {
  unsigned crc = 0;
  for (const uint8_t byte : bytes) {
    crc ^= unsigned{byte} << 8U;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 0x8000U) != 0 ? (crc << 1U ^ 0x1021U) & 0xFFFFU : crc << 1U & 0xFFFFU;
  }
  return static_cast<uint16_t>(crc);
}

} // namespace stride::can

#endif
