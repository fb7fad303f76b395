// Arithmetic on unevaluated sums of two doubles (about 106 bits), without fused multiply-add.
// Only for finite arguments well inside the exponent range. After T. J. Dekker and D. E. Knuth.
#ifndef STRIDE_RUNTIME_IEC_DOUBLE_DOUBLE_HPP
#define STRIDE_RUNTIME_IEC_DOUBLE_DOUBLE_HPP

#include "runtime/iec/math_tables.hpp"

#include <limits>

namespace stride::detail {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// a + b exactly, for |a| >= |b|.
inline Pair fastTwoSum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a + b exactly.
inline Pair twoSum(double a, double b) {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

/// x in two halves of at most 26 bits each.
inline Pair halves(double x) {
  const double t = 134217729.0 * x; // 2^27 + 1
  const double hi = t - (t - x);
  return {hi, x - hi};
}

/// a * b exactly.
inline Pair twoProduct(double a, double b) {
  const double p = a * b;
  const Pair x = halves(a);
  const Pair y = halves(b);
  return {p, ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

inline Pair add(Pair a, Pair b) {
  Pair s = twoSum(a.hi, b.hi);
  s.lo += a.lo + b.lo;
  return fastTwoSum(s.hi, s.lo);
}

inline Pair multiply(Pair a, Pair b) {
  Pair p = twoProduct(a.hi, b.hi);
  p.lo += a.hi * b.lo + a.lo * b.hi;
  return fastTwoSum(p.hi, p.lo);
}

inline Pair divide(Pair a, Pair b) {
  const double q = a.hi / b.hi;
  const Pair p = twoProduct(q, b.hi);
  const double rest = ((a.hi - p.hi) - p.lo) + a.lo - q * b.lo;
  return fastTwoSum(q, rest / b.hi);
}

/// Square root of a positive sum.
inline Pair squareRoot(Pair a) {
  const double s = __builtin_sqrt(a.hi);
  const Pair p = twoProduct(s, s);
  const double rest = ((a.hi - p.hi) - p.lo) + a.lo;
  return fastTwoSum(s, rest / (2.0 * s));
}

} // namespace stride::detail

#endif
