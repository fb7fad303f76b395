// Numbers in frames: least byte first.
#ifndef STRIDE_DRIVERS_CAN_MASTER_FRAMES_HPP
#define STRIDE_DRIVERS_CAN_MASTER_FRAMES_HPP

#include "drivers/can/port/frame.hpp"

#include <cstddef>
#include <cstdint>

namespace stride::can {

/// `first + count` is at most Frame::kMostBytes.
inline uint32_t readNumber(const Frame &frame, size_t first, size_t count) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i)
    value |= uint32_t{frame.data[first + i]} << 8 * i;
  return value;
}

inline void writeNumber(Frame &frame, size_t first, size_t count, uint32_t value) {
  for (size_t i = 0; i < count; ++i)
    frame.data[first + i] = static_cast<uint8_t>(value >> 8 * i);
}

inline Frame makeFrame(uint32_t id, uint8_t length) {
  Frame frame;
  frame.id = static_cast<uint16_t>(id);
  frame.length = length;
  return frame;
}

/// Whole cycles that last at least so long, at least one; a time without end stays one.
inline uint32_t cyclesOf(double seconds, double cycleSeconds) {
  const double cycles = seconds / cycleSeconds;
  if (!(cycles > 1))
    return 1;
  constexpr double kMost = 4e9;
  if (cycles >= kMost)
    return static_cast<uint32_t>(kMost);
  const auto whole = static_cast<uint32_t>(cycles);
  // 0.5 s in cycles of 1 ms are 500, whatever the last bit says.
  return cycles - whole > 1e-6 ? whole + 1 : whole;
}

} // namespace stride::can

#endif
