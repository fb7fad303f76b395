// Switch points (H) of an object: which one comes next, and what it does. Free of the C++ standard
// library: linked into every application.
// Source: SoftMotion V2.3 manual, sections 3.2 and 6.2.8.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_SWITCH_POINTS_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_SWITCH_POINTS_HPP

#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// The number of the first switch point up to a part of the object's length that has not been
/// passed, which it is now; 0: there is none.
inline int16_t passSwitch(const PathObject &object, double part, uint8_t &passed) noexcept {
  int32_t nearest = -1;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const bool waits = object.switchId[i] != 0 && (passed >> static_cast<unsigned>(i) & 1U) == 0 &&
                       object.switchPosition[i] <= part;
    if (waits && (nearest < 0 || object.switchPosition[i] < object.switchPosition[nearest]))
      nearest = i;
  }
  if (nearest < 0)
    return 0;
  passed |= static_cast<uint8_t>(1U << static_cast<unsigned>(nearest));
  return object.switchId[nearest];
}

/// Bit n - 1 of `switches` is switch n, 1 to 32: on with n, off with -n.
inline void setSwitch(uint32_t &switches, int16_t number) noexcept {
  const int32_t index = number < 0 ? -number : number;
  if (index < 1 || index > 32)
    return;
  const uint32_t bit = 1U << static_cast<unsigned>(index - 1);
  switches = number > 0 ? switches | bit : switches & ~bit;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_SWITCH_POINTS_HPP
