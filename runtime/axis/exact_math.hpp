// The mathematical functions that motion uses. All are exact or correctly rounded in IEEE 754, so
// that results are the same on every machine. Without <math.h>, which in C++ brings in half of the
// standard library.
#ifndef STRIDE_RUNTIME_AXIS_EXACT_MATH_HPP
#define STRIDE_RUNTIME_AXIS_EXACT_MATH_HPP

namespace stride::exact {

inline bool isfinite(double x) noexcept { return __builtin_isfinite(x) != 0; }
inline double fabs(double x) noexcept { return __builtin_fabs(x); }
inline double sqrt(double x) noexcept { return __builtin_sqrt(x); }
inline double floor(double x) noexcept { return __builtin_floor(x); }
inline double ceil(double x) noexcept { return __builtin_ceil(x); }
inline double fmod(double x, double y) noexcept { return __builtin_fmod(x, y); }
inline double ldexp(double x, int exponent) noexcept { return __builtin_ldexp(x, exponent); }
inline double frexp(double x, int *exponent) noexcept { return __builtin_frexp(x, exponent); }

inline constexpr double kInfinity = __builtin_huge_val();

} // namespace stride::exact

#endif
