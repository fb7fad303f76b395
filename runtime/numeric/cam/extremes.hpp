// Where the pieces of a cam have their extremes: roots of derivatives, found one below the other.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_EXTREMES_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_EXTREMES_HPP

#include "runtime/numeric/cam/curve.hpp"

#include <stdint.h>

namespace stride::cam {

/// A polynomial plus a sine: c[0] + … + c[7] u^7 + sine * sin(omega u) + cosine * cos(omega u). On
/// its range the sine has no more than half a period.
struct Smooth {
  double c[8] = {};
  int degree = 7; ///< Coefficients beyond are 0.
  double sine = 0.0;
  double cosine = 0.0;
  double omega = 0.0;
  double low = 0.0; ///< Range of u.
  double high = 1.0;
};

double valueOf(const Smooth &f, double u) noexcept;
Smooth derivativeOf(const Smooth &f) noexcept;

/// f * factor + g * factorG; both have the same range and omega.
Smooth combined(const Smooth &f, double factor, const Smooth &g, double factorG) noexcept;

/// Room for the roots of any Smooth.
inline constexpr int kMostRoots = 16;

/// Where `f` changes its sign inside of its range, in ascending order, within 2^-34 of the range;
/// returns how many. Two roots that lie closer than that may be missing.
int rootsOf(const Smooth &f, double (&roots)[kMostRoots]) noexcept;

/// Room for the parts of any segment.
inline constexpr int kMostParts = 8;

/// A segment's parts, between which the third derivative may jump, over u = (x - start) / (end -
/// start), in ascending order; returns how many.
int partsOf(const Segment &segment, Smooth (&parts)[kMostParts]) noexcept;

} // namespace stride::cam

#endif
