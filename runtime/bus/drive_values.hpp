// Values between axes and drives that masters of all buses treat alike.
#ifndef STRIDE_RUNTIME_BUS_DRIVE_VALUES_HPP
#define STRIDE_RUNTIME_BUS_DRIVE_VALUES_HPP

#include "runtime/iec/math.h"

#include <algorithm>
#include <cstdint>

namespace stride::bus {

/// A drive is at rest: so little way in so many cycles.
inline constexpr int32_t kRestIncrements = 2;
inline constexpr uint32_t kRestCycles = 5;

/// The nearest whole number within -limit and limit; what is no number is 0.
inline int32_t saturated(double value, double limit) {
  const double whole = stride::floor(value + 0.5);
  if (!(whole >= -limit)) // NaN comes here, too
    return whole < 0 ? static_cast<int32_t>(-limit) : 0;
  return static_cast<int32_t>(std::min(whole, limit));
}

} // namespace stride::bus

#endif
