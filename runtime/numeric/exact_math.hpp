// The mathematical functions that motion uses. All are exact or correctly rounded in IEEE 754, so
// that results are the same on every machine. Without <math.h>, which in C++ brings in half of the
// standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_EXACT_MATH_HPP
#define STRIDE_RUNTIME_NUMERIC_EXACT_MATH_HPP

#include <stdint.h>

namespace stride::exact {

inline bool isfinite(double x) noexcept { return __builtin_isfinite(x) != 0; }
inline double fabs(double x) noexcept { return __builtin_fabs(x); }
inline double sqrt(double x) noexcept { return __builtin_sqrt(x); }
inline double floor(double x) noexcept { return __builtin_floor(x); }
inline double ceil(double x) noexcept { return __builtin_ceil(x); }
inline double fmod(double x, double y) noexcept { return __builtin_fmod(x, y); }
inline double ldexp(double x, int exponent) noexcept {
  if (__builtin_expect(exponent < -1000 || exponent > 1000, 0))
    return __builtin_ldexp(x, exponent);
  return x * __builtin_bit_cast(double, static_cast<uint64_t>(exponent + 1023) << 52);
}
inline double frexp(double x, int *exponent) noexcept { return __builtin_frexp(x, exponent); }

/// The nearest whole number, halves away from 0, as llround: for |x| < 2^62. No call, which llround
/// is.
inline int64_t nearest(double x) noexcept {
  const auto whole = static_cast<int64_t>(x);
  const double rest = x - static_cast<double>(whole); // exact
  return whole + static_cast<int64_t>(rest >= 0.5) - static_cast<int64_t>(rest <= -0.5);
}

/// Not so with NaN.
inline bool isPositive(double x) noexcept { return isfinite(x) && x > 0.0; }
inline double smaller(double a, double b) noexcept { return a < b ? a : b; }
inline double larger(double a, double b) noexcept { return a > b ? a : b; }
/// x == 0 without a comparison of NaN, which costs two instructions more.
inline bool isZero(double x) noexcept { return __builtin_bit_cast(uint64_t, x) << 1 == 0; }
/// 1 or -1, also for 0: 1.
inline double signOf(double x) noexcept { return x < 0.0 ? -1.0 : 1.0; }

inline constexpr double kInfinity = __builtin_huge_val();

} // namespace stride::exact

#endif
