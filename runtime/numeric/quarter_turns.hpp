// Cosine and sine of angles in degrees, exact for multiples of 90. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_QUARTER_TURNS_HPP
#define STRIDE_RUNTIME_NUMERIC_QUARTER_TURNS_HPP

#include "runtime/numeric/exact_math.hpp"

#include "runtime/iec/math.h"

namespace stride::numeric {

inline constexpr double kDegree = 0.017453292519943295; ///< [rad]

/// (cos, sin) of an angle.
struct Turn {
  double c, s;
};

/// That of an angle in degrees; exact for multiples of 90. [deg] in
inline Turn turnOf(double degrees) noexcept {
  const double within = exact::fabs(degrees) < 360.0 ? degrees : exact::fmod(degrees, 360.0);
  const double quarters = exact::floor(within / 90.0 + 0.5);
  const auto [s, c] = ::stride::sineCosine((within - 90.0 * quarters) * kDegree);
  switch ((static_cast<int>(quarters) + 8) % 4) {
  case 1:
    return {-s, c};
  case 2:
    return {-c, -s};
  case 3:
    return {s, -c};
  default:
    return {c, s};
  }
}

} // namespace stride::numeric

#endif // STRIDE_RUNTIME_NUMERIC_QUARTER_TURNS_HPP
