// A frame on the wire, bit by bit. [ISO 11898-1]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_WIRE_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_WIRE_HPP

#include "drivers/can/port/frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace stride::can::simulation {

/// The part of a frame that is stuffed, from its start bit to the end of its checksum, with the
/// stuff bits. 0 is dominant.
class StuffedBits {
public:
  explicit StuffedBits(const Frame &frame);

  [[nodiscard]] size_t size() const { return size_; }
  [[nodiscard]] bool operator[](size_t place) const { return bits_[place]; }
  /// The checksum in it (CRC-15).
  [[nodiscard]] uint16_t crc() const { return crc_; }

private:
  static constexpr size_t kMost = 128; ///< 98 bits with 8 bytes, and a stuff bit after every four.

  void add(bool bit);

  std::array<bool, kMost> bits_{};
  size_t size_ = 0;
  uint16_t crc_ = 0;
  bool last_ = true;
  unsigned run_ = 0; ///< Equal bits up to here.
};

/// Delimiters, acknowledgement and end of frame …
inline constexpr uint32_t kTailBits = 10;
/// … and the gap after it.
inline constexpr uint32_t kGapBits = 3;
/// An error flag and its delimiter.
inline constexpr uint32_t kErrorBits = 14;
/// What a controller waits before it takes part again after bus-off.
inline constexpr uint32_t kRecoveryBits = 128 * 11;
/// What a passive controller waits after a frame of its own, beyond the gap.
inline constexpr uint32_t kSuspendBits = 8;

/// Bits of the frame from its start to the end of the gap after it: never more than worstBits().
uint32_t exactBits(const Frame &frame);

/// What decides who sends: the smaller goes first.
constexpr uint32_t arbitration(const Frame &frame) {
  return frame.id * 2U + (frame.remote ? 1U : 0U);
}

/// The first bit in which two frames differ; the size of the shorter one: in none.
size_t firstDifference(const StuffedBits &a, const StuffedBits &b);

} // namespace stride::can::simulation

#endif
