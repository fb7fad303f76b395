// A classic CAN frame, as it is on the wire. [CiA 301, ISO 11898-1]
#ifndef STRIDE_DRIVERS_CAN_PORT_FRAME_HPP
#define STRIDE_DRIVERS_CAN_PORT_FRAME_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stride::can {

/// A frame with an 11-bit identifier. Only the first `length` bytes of `data` mean something; the
/// others are 0.
struct Frame {
  static constexpr size_t kMostBytes = 8;
  static constexpr uint16_t kLastId = 0x7FF;

  uint16_t id = 0;     ///< COB-ID, 0 … kLastId.
  uint8_t length = 0;  ///< Bytes, 0 … kMostBytes.
  bool remote = false; ///< RTR: asks for the frame with this identifier; has no bytes.
  std::array<uint8_t, kMostBytes> data{};

  [[nodiscard]] std::span<const uint8_t> bytes() const { return {data.data(), length}; }
  friend bool operator==(const Frame &, const Frame &) = default;
};

/// Bits of a data frame with `bytes` bytes on the wire in the worst case: with a stuff bit wherever
/// one can be, and the gap after it.
constexpr uint32_t worstBits(uint32_t bytes) { return 47 + 8 * bytes + (34 + 8 * bytes - 1) / 4; }

} // namespace stride::can

#endif
