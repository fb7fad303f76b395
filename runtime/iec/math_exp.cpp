// Exponential, logarithms and powers. Table-driven; error bounds are checked in tests/unit/iec.
#include "runtime/iec/double_double.hpp"
#include "runtime/iec/math.h"

#include <bit>
#include <cmath>
#include <limits>

namespace stride {

namespace {

using detail::Pair;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// 2^n for a normal result.
double powerOfTwo(int n) { return std::bit_cast<double>(static_cast<uint64_t>(n + 1023) << 52); }

/// x * 2^n, rounding once where the result is subnormal. n in [-1100, 1030].
double scale(double x, int n) {
  if (n > 1023)
    return x * powerOfTwo(1023) * powerOfTwo(n - 1023);
  if (n < -1022)
    return x * powerOfTwo(n + 1022) * 0x1p-1022;
  return x * powerOfTwo(n);
}

/// exp(hi + lo) for a result that neither overflows nor vanishes.
double expOfSum(double hi, double lo) {
  // hi + lo = k ln 2 / 128 + r, |r| <= ln 2 / 256.
  const double scaled = hi * detail::k128ByLn2;
  const int k = static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5));
  const double kd = k;
  const double r = (hi - kd * detail::kLn2By128.hi) - (kd * detail::kLn2By128.lo - lo);
  const double r2 = r * r;
  const double p = r + r2 * (0.5 + r * (1.0 / 6)) + r2 * r2 * (1.0 / 24 + r * (1.0 / 120));
  const int place = k & 127;
  const Pair t = detail::kExp2[place];
  return scale(t.hi + (t.lo + t.hi * p), (k - place) / 128);
}

/// ln x as a sum for finite x > 0, with a relative error near 2^-70.
Pair lnAsSum(double x) {
  int e = 0;
  uint64_t bits = std::bit_cast<uint64_t>(x);
  if (bits < (uint64_t{1} << 52)) { // subnormal
    bits = std::bit_cast<uint64_t>(x * 0x1p54);
    e = -54;
  }
  e += static_cast<int>(bits >> 52) - 1023;
  const int place = static_cast<int>((bits >> 45) & 127);
  uint64_t exponentOne = uint64_t{1023} << 52;
  if (place >= detail::kLnHalfFrom) {
    exponentOne = uint64_t{1022} << 52;
    ++e;
  }
  const double m = std::bit_cast<double>((bits & ((uint64_t{1} << 52) - 1)) | exponentOne);
  const detail::LnEntry &entry = detail::kLn[place];
  // r = m c - 1 exactly as a sum: c is short, so both products are exact.
  const Pair half = detail::halves(m);
  const Pair r = detail::twoSum(half.hi * entry.c - 1.0, half.lo * entry.c);
  // ln x = e ln 2 - ln c + (r - r^2/2 + r^3/3 - ...)
  const double ed = e;
  const double z = r.hi * r.hi;
  const Pair square = detail::twoProduct(r.hi, r.hi);
  const double tail =
      z * r.hi *
      (1.0 / 3 +
       r.hi * (-1.0 / 4 +
               r.hi * (1.0 / 5 +
                       r.hi * (-1.0 / 6 +
                               r.hi * (1.0 / 7 + r.hi * (-1.0 / 8 +
                                                         r.hi * (1.0 / 9 - r.hi * (1.0 / 10))))))));
  const Pair first = detail::twoSum(ed * detail::kLn2.hi + entry.hi, r.hi);
  const Pair second = detail::twoSum(first.hi, -0.5 * square.hi);
  const double low = first.lo + second.lo + (r.lo - r.hi * r.lo) - 0.5 * square.lo +
                     (ed * detail::kLn2.lo + entry.lo);
  const Pair third = detail::twoSum(second.hi, tail);
  return detail::fastTwoSum(third.hi, third.lo + low);
}

bool isWhole(double y) {
  return std::fabs(y) >= 0x1p52 || y == static_cast<double>(static_cast<int64_t>(y));
}

bool isOdd(double y) {
  return std::fabs(y) < 0x1p53 && isWhole(y) && (static_cast<int64_t>(y) & 1) != 0;
}

} // namespace

LREAL exp(LREAL x) {
  if (x != x)
    return x;
  if (x > 709.782712893384)
    return kInfinity;
  if (x < -745.1332191019412)
    return 0.0;
  return expOfSum(x, 0.0);
}

LREAL ln(LREAL x) {
  if (x != x || x == kInfinity)
    return x;
  if (x == 0)
    return -kInfinity;
  if (x < 0)
    return detail::kNan;
  return lnAsSum(x).hi;
}

LREAL log10(LREAL x) {
  if (x != x || x == kInfinity)
    return x;
  if (x == 0)
    return -kInfinity;
  if (x < 0)
    return detail::kNan;
  return detail::multiply(lnAsSum(x), detail::kInvLn10).hi;
}

LREAL pow(LREAL x, LREAL y) {
  if (y == 0 || x == 1)
    return 1.0;
  if (x != x || y != y)
    return detail::kNan;
  const bool negative = std::signbit(x) && isOdd(y);
  const double sign = negative ? -1.0 : 1.0;
  const double a = std::fabs(x);
  if (std::fabs(y) == kInfinity) {
    if (a == 1)
      return 1.0;
    return (a > 1) == (y > 0) ? kInfinity : 0.0;
  }
  if (a == 0 || a == kInfinity)
    return (a == 0) == (y > 0) ? sign * 0.0 : sign * kInfinity;
  if (x < 0 && !isWhole(y))
    return detail::kNan;
  if (a == 1)
    return sign;
  const Pair l = lnAsSum(a);
  // |ln a| is at least 2^-53 and at most 745: decide the extremes before the exact product.
  const double rough = y * l.hi;
  if (rough > 710)
    return sign * kInfinity;
  if (rough < -746)
    return sign * 0.0;
  if (std::fabs(rough) < 0x1p-60)
    return sign * (1.0 + rough);
  const Pair p = detail::multiply(l, Pair{y, 0.0});
  if (p.hi > 709.782712893384 + 1e-13)
    return sign * kInfinity;
  if (p.hi < -745.1332191019412)
    return sign * 0.0;
  return sign * expOfSum(p.hi, p.lo);
}

LREAL fmod(LREAL x, LREAL y) { return std::fmod(x, y); } // exact, so the same everywhere

LREAL trunc(LREAL x) {
  if (!(std::fabs(x) < 0x1p52))
    return x;
  return std::copysign(static_cast<double>(static_cast<int64_t>(x)), x);
}

LREAL floor(LREAL x) {
  const double t = trunc(x);
  return t > x ? t - 1.0 : t;
}

LREAL ceil(LREAL x) {
  const double t = trunc(x);
  return t < x ? std::copysign(t + 1.0, x) : t;
}

LREAL round(LREAL x) {
  const double t = trunc(x);
  const double rest = std::fabs(x - t);
  return rest >= 0.5 ? t + std::copysign(1.0, x) : t;
}

REAL exp(REAL x) { return static_cast<REAL>(exp(LREAL{x})); }
REAL ln(REAL x) { return static_cast<REAL>(ln(LREAL{x})); }
REAL log10(REAL x) { return static_cast<REAL>(log10(LREAL{x})); }
REAL pow(REAL x, REAL y) { return static_cast<REAL>(pow(LREAL{x}, LREAL{y})); }
REAL fmod(REAL x, REAL y) { return static_cast<REAL>(fmod(LREAL{x}, LREAL{y})); }
REAL trunc(REAL x) { return static_cast<REAL>(trunc(LREAL{x})); }
REAL floor(REAL x) { return static_cast<REAL>(floor(LREAL{x})); }
REAL ceil(REAL x) { return static_cast<REAL>(ceil(LREAL{x})); }
REAL round(REAL x) { return static_cast<REAL>(round(LREAL{x})); }

} // namespace stride
