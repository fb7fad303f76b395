// Small arithmetic that simulated drives of all buses share.
#ifndef STRIDE_DRIVERS_DUMMY_SIGNALS_HPP
#define STRIDE_DRIVERS_DUMMY_SIGNALS_HPP

#include "runtime/iec/math.h"
#include "runtime/iec/types.h"

#include <algorithm>
#include <cstdint>

namespace stride::dummy {

/// The nearest whole number.
inline int64_t rounded(double value) { return static_cast<int64_t>(stride::floor(value + 0.5)); }
/// The same within -most and most.
inline int64_t rounded(double value, double most) {
  return rounded(std::clamp(value, -most, most));
}
/// As far as 32 and 16 bits reach.
inline int64_t rounded32(double value) { return rounded(value, 2147483647.0); }
inline int64_t rounded16(double value) { return rounded(value, 32767.0); }

/// From one value to another one, by no more than `most`.
inline double towards(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

/// Whether `now` has changed from FALSE to TRUE; `old` follows.
inline bool rising(BOOL now, BOOL &old) {
  const bool edge = now != 0 && old == 0;
  old = now;
  return edge;
}

} // namespace stride::dummy

#endif
