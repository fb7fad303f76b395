// The laws of motion of VDI 2143, normalised: each rises from 0 to 1 while u goes from 0 to 1.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_LAWS_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_LAWS_HPP

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

/// What a law needs besides its name.
struct LawShape {
  Law law = Law::Polynomial;
  double parameter = 0.25; ///< ModifiedSine: 0 (harmonic) to below 1; 0.5 is Cycloidal.
  double inflexion = 0.5;  ///< Where the velocity is greatest, between 0 and 1; 0.5: symmetric.
};

/// Whether the parameters are numbers that the law can do with.
bool isUsable(const LawShape &shape) noexcept;

/// The law at `u`, 0 to 1, with derivatives with respect to u; zeros for Polynomial. 0 at 0 and 1
/// at 1, exactly. Beyond that its outermost piece goes on. Where the jerk jumps it is that of one
/// side. Source: VDI 2143 sheet 1; R. L. Norton, Cam Design and Manufacturing Handbook, chapter 3.
Point evaluateLaw(const LawShape &shape, double u) noexcept;

} // namespace stride::cam

#endif
