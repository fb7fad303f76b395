// The laws of motion of VDI 2143, normalised: each rises from 0 to 1 while u goes from 0 to 1.
#ifndef STRIDE_RUNTIME_CAM_LAWS_HPP
#define STRIDE_RUNTIME_CAM_LAWS_HPP

#include <stdint.h>

namespace stride::cam {

/// The values are those of SMC_CAM_LAW.
enum class Law : int16_t {
  Polynomial = 0, ///< None; a polynomial does the work.
  Harmonic = 1,
  Cycloidal = 2,
  ModifiedSine = 3, ///< `parameter`: the part of the way that both ends take together, 0.25.
  ModifiedTrapezoid = 4,
};

/// A value and its first three derivatives.
struct Point {
  double y; ///< [slave u]
  double v; ///< [slave u/master u]
  double a; ///< [slave u/master u^2]
  double j; ///< [slave u/master u^3]
};

/// The law at `u`, 0 to 1, with derivatives with respect to u; zeros for Polynomial.
Point evaluateLaw(Law law, double parameter, double u) noexcept;

} // namespace stride::cam

#endif
