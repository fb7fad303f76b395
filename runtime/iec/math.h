// Mathematics with the same bits on every machine.
//
// Own implementations, compiled without contraction to fused multiply-add: the C library picks
// variants by CPU, whose last bits differ. Errors stay below 1 ulp (tests/unit/iec). The compiler's
// constant folder calls the same functions. Free of the C++ standard library; see types.h.
//
// Domain errors give NaN, poles give infinities, as IEEE 754 says; nothing raises.
#ifndef STRIDE_RUNTIME_IEC_MATH_H
#define STRIDE_RUNTIME_IEC_MATH_H

#include "runtime/iec/types.h"

namespace stride {

/// Angles in radians.
LREAL sin(LREAL x);
LREAL cos(LREAL x);
LREAL tan(LREAL x);
/// Both of one angle, with the same bits as sin and cos.
struct SineCosine {
  LREAL s, c;
};
SineCosine sineCosine(LREAL x);
LREAL asin(LREAL x);
LREAL acos(LREAL x);
LREAL atan(LREAL x);
/// Angle of the point (x, y), in (-pi, pi].
LREAL atan2(LREAL y, LREAL x);
LREAL exp(LREAL x);
/// Natural logarithm (LN) and logarithm to base 10 (LOG).
LREAL ln(LREAL x);
LREAL log10(LREAL x);
/// x raised to y (EXPT on reals).
LREAL pow(LREAL x, LREAL y);
/// Exact remainder of x / y with the sign of x.
LREAL fmod(LREAL x, LREAL y);
/// Correctly rounded (the hardware's).
inline LREAL sqrt(LREAL x) { return __builtin_sqrt(x); }
/// Whole numbers below, above, towards zero, and nearest (halves away from zero). Exact.
LREAL floor(LREAL x);
LREAL ceil(LREAL x);
LREAL trunc(LREAL x);
LREAL round(LREAL x);

REAL sin(REAL x);
REAL cos(REAL x);
REAL tan(REAL x);
REAL asin(REAL x);
REAL acos(REAL x);
REAL atan(REAL x);
REAL atan2(REAL y, REAL x);
REAL exp(REAL x);
REAL ln(REAL x);
REAL log10(REAL x);
REAL pow(REAL x, REAL y);
REAL fmod(REAL x, REAL y);
inline REAL sqrt(REAL x) { return __builtin_sqrtf(x); }
REAL floor(REAL x);
REAL ceil(REAL x);
REAL trunc(REAL x);
REAL round(REAL x);

} // namespace stride

#endif
