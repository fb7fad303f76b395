// Turns in space, and the angles A, B, C that mean them: SMC_ORI_CONVENTION. Free of the C++
// standard library: linked into every application. Source: SoftMotion 3's help on G54 to G56.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_ORIENTATION_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_ORIENTATION_HPP

#include "runtime/numeric/vector3.hpp"

#include <stdint.h>

namespace stride::cnc {

using numeric::Vector3;

/// What A, B and C of a program are: SMC_ORI_CONVENTION.
enum class Orientation : uint8_t {
  Axes, ///< Axes like others.
  Zyz,  ///< Angles of turns about Z, the turned Y, the turned Z. [degrees]
  Zyx,  ///< Likewise about Z, Y, X.
  Xyz,  ///< Likewise about X, Y, Z.
};

/// SMC_ORI_CONVENTION as a number; what is none of them counts as ADDAXES.
inline Orientation orientationOf(int16_t convention) noexcept {
  constexpr auto kLast = static_cast<int16_t>(Orientation::Xyz);
  return convention > 0 && convention <= kLast ? static_cast<Orientation>(convention)
                                               : Orientation::Axes;
}

/// A turn: where it brings X, Y and Z.
struct Turn {
  Vector3 x, y, z;
};
inline constexpr Turn kNoTurn{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline Vector3 apply(const Turn &turn, const Vector3 &v) noexcept {
  return turn.x * v.x + turn.y * v.y + turn.z * v.z;
}

/// First `b`, then `a`.
inline Turn operator*(const Turn &a, const Turn &b) noexcept {
  return {apply(a, b.x), apply(a, b.y), apply(a, b.z)};
}

inline Turn inverse(const Turn &t) noexcept {
  return {{t.x.x, t.y.x, t.z.x}, {t.x.y, t.y.y, t.z.y}, {t.x.z, t.y.z, t.z.z}};
}

/// The turn of three angles, which are some. [degrees] Quarters of a turn are exact.
Turn turnBy(Orientation orientation, const double (&angle)[3]) noexcept;

/// atan2. [degrees]
double degreesOf(double y, double x) noexcept;

/// The angles of a turn: of all that mean it, those that are closest to `near`. [degrees]
void anglesOf(Orientation orientation, const Turn &turn, const double (&near)[3],
              double (&angle)[3]) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_ORIENTATION_HPP
