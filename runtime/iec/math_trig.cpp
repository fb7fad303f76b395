// Trigonometric functions and their inverses. Error bounds are checked in tests/unit/iec.
#include "runtime/iec/double_double.hpp"
#include "runtime/iec/math.h"

#include <bit>
#include <cmath>
#include <limits>

namespace stride {

namespace {

using detail::Pair;

/// x = quadrant * pi/2 + rest, |rest| <= pi/4 (a little more at the seams).
struct Reduced {
  unsigned quadrant;
  Pair rest;
};

/// Reduction of huge arguments with the digits of 2/pi (after Payne and Hanek). x >= 2^20.
Reduced reduceHuge(double x) {
  const uint64_t bits = std::bit_cast<uint64_t>(x);
  const int e = static_cast<int>(bits >> 52) - 1075; // x = mantissa * 2^e
  const uint64_t mantissa = (bits & ((uint64_t{1} << 52) - 1)) | (uint64_t{1} << 52);
  // Digit i (from 1) of 2/pi has weight 2^-i; digits up to e - 2 only add multiples of 4.
  const int first = e > 2 ? e - 1 : 1;
  uint64_t window[3];
  for (int w = 0; w < 3; ++w) {
    const int bit = first - 1 + 64 * w;
    const int word = bit / 64;
    const int shift = bit % 64;
    window[w] = detail::kTwoByPiDigits[word] << shift;
    if (shift != 0)
      window[w] |= detail::kTwoByPiDigits[word + 1] >> (64 - shift);
  }
  // product = mantissa * window, 256 bits, least significant word first.
  __extension__ using Wide = unsigned __int128;
  uint64_t product[4];
  Wide carry = 0;
  for (int w = 0; w < 3; ++w) {
    carry += static_cast<Wide>(mantissa) * window[2 - w];
    product[w] = static_cast<uint64_t>(carry);
    carry >>= 64;
  }
  product[3] = static_cast<uint64_t>(carry);
  // Its last `fraction` bits are the fraction of x * 2/pi (190..245 of them).
  const int fraction = first + 191 - e;
  const auto bitsFrom = [&product](int low) { // 64 bits from bit `low` upwards
    const int word = low / 64;
    const int shift = low % 64;
    uint64_t value = word < 4 ? product[word] >> shift : 0;
    if (shift != 0 && word + 1 < 4)
      value |= product[word + 1] << (64 - shift);
    return value;
  };
  unsigned quadrant = static_cast<unsigned>(bitsFrom(fraction) & 3U);
  Wide rest = (static_cast<Wide>(bitsFrom(fraction - 64)) << 64) | bitsFrom(fraction - 128);
  const bool negative = (rest >> 127) != 0;
  if (negative) {
    rest = -rest;
    quadrant = (quadrant + 1) & 3U;
  }
  // rest * 2^-128 as a sum of two doubles.
  int zeros = 0;
  while (zeros < 127 && (rest >> 127) == 0) {
    rest <<= 1;
    ++zeros;
  }
  const double hi = static_cast<double>(static_cast<uint64_t>(rest >> 75)) * 0x1p-53;
  const double lo =
      static_cast<double>(static_cast<uint64_t>(rest >> 22) & ((uint64_t{1} << 53) - 1)) * 0x1p-106;
  const double unit = std::bit_cast<double>(static_cast<uint64_t>(1023 - zeros) << 52);
  Pair r = detail::multiply(Pair{hi * unit, lo * unit}, detail::kHalfPi);
  if (negative)
    r = {-r.hi, -r.lo};
  return {quadrant, r};
}

/// Reduction of any finite x.
Reduced reduce(double x) {
  const double a = std::fabs(x);
  if (a <= 0.7853981633974483)
    return {0, {x, 0.0}};
  if (a < 0x1p20) {
    const double scaled = x * detail::kTwoByPi;
    const int n = static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5));
    const double nd = n;
    const Pair s = detail::twoSum(x - nd * detail::kHalfPiPart1, -nd * detail::kHalfPiPart2);
    const Pair last = detail::twoProduct(-nd, detail::kHalfPiPart3.hi);
    const Pair t = detail::twoSum(s.hi, last.hi);
    const double low = s.lo + (last.lo - nd * detail::kHalfPiPart3.lo);
    const Pair u = detail::twoSum(t.hi, t.lo + low);
    return {static_cast<unsigned>(n) & 3U, u};
  }
  Reduced r = reduceHuge(a);
  if (x < 0) {
    r.quadrant = (4 - r.quadrant) & 3U;
    r.rest = {-r.rest.hi, -r.rest.lo};
  }
  return r;
}

/// sin(x.hi + x.lo) as an unevaluated sum, |x| <= 0.79. Taylor: the next term is below 2^-63.
Pair sinNear0(Pair x) {
  const double z = x.hi * x.hi;
  const double p =
      -1.0 / 6 +
      z * (1.0 / 120 +
           z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                       z * (1.0 / 6227020800 +
                                                            z * (-1.0 / 1307674368000 +
                                                                 z * (1.0 / 355687428096000)))))));
  return {x.hi, x.hi * z * p + x.lo * (1.0 - 0.5 * z)};
}

/// cos(x.hi + x.lo) as an unevaluated sum, |x| <= 0.79.
Pair cosNear0(Pair x) {
  const Pair square = detail::twoProduct(x.hi, x.hi);
  const double z = square.hi;
  const double p =
      1.0 / 24 + z * (-1.0 / 720 +
                      z * (1.0 / 40320 +
                           z * (-1.0 / 3628800 +
                                z * (1.0 / 479001600 + z * (-1.0 / 87178291200 +
                                                            z * (1.0 / 20922789888000 -
                                                                 z * (1.0 / 6402373705728000)))))));
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return {w, ((1.0 - w) - half) + (z * z * p - x.hi * x.lo - 0.5 * square.lo)};
}

double sum(Pair p) { return p.hi + p.lo; }

/// atan(y / x) as a sum for y >= 0, x >= 0, not both 0, neither huge nor tiny: in [0, pi/2].
Pair atanOfRatio(Pair y, Pair x) {
  const bool steep = y.hi > x.hi;
  const Pair t = steep ? detail::divide(x, y) : detail::divide(y, x);
  // atan t = atan c + atan u, u = (t - c) / (1 + t c), |u| <= 1/128.
  const int place = static_cast<int>(t.hi * 64.0 + 0.5);
  const double c = place / 64.0;
  Pair u = t;
  if (place != 0) {
    const Pair numerator = detail::add(t, Pair{-c, 0.0});
    const Pair product = detail::multiply(t, Pair{c, 0.0});
    u = detail::divide(numerator, detail::add(Pair{1.0, 0.0}, product));
  }
  const double z = u.hi * u.hi;
  const double tail =
      u.hi * z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 - z * (1.0 / 11)))));
  const Pair small = detail::fastTwoSum(u.hi, u.lo + tail);
  const Pair angle = detail::add(detail::kAtan[place], small);
  if (!steep)
    return angle;
  return detail::add(detail::kHalfPi, Pair{-angle.hi, -angle.lo});
}

/// Whether a number is finite and far from where products overflow or lose digits; its exponent.
bool isModerate(double x, int &exponent) {
  constexpr int kMost = 300;
  exponent = static_cast<int>(std::bit_cast<uint64_t>(x) >> 52 & 0x7FFU) - 1023;
  return exponent > -kMost && exponent < kMost;
}

/// How far the sums that are rounded below, and those of atanOfRatio, may be from the angle, as a
/// part of it; both are at least 8 times better.
constexpr double kAngleError = 0x1p-63;

/// atan2 for y and x that are not 0, if it is certain to be what the sums of atanOfRatio are
/// rounded to: it is all but once in some hundred times. That takes two divisions one after the
/// other instead of six.
bool quickAngle(double y, double x, double &angle) {
  int ey = 0;
  int ex = 0;
  if (!isModerate(y, ey) || !isModerate(x, ex) || ey - ex > 60 || ex - ey > 60)
    return false;
  const double ay = std::fabs(y);
  const double ax = std::fabs(x);
  const bool steep = ay > ax;
  const double n = steep ? ax : ay;
  const double d = steep ? ay : ax;
  // atan(n / d) = atan c + atan u, u = (n - c d) / (d + c n), |u| <= 1/128; c has 7 bits.
  const int place = static_cast<int>(n / d * 64.0 + 0.5);
  const double c = place / 64.0;
  const Pair dh = detail::halves(d);
  const Pair nh = detail::halves(n);
  const Pair far = detail::twoSum(n, -(c * dh.hi));
  const Pair near = detail::twoSum(far.hi, -(c * dh.lo));
  const double above = near.lo + far.lo;
  const double product = c * n;
  const Pair below = detail::twoSum(d, product);
  const double rest = below.lo + ((c * nh.hi - product) + c * nh.lo);
  const double inverse = 1.0 / below.hi;
  const double u = near.hi / below.hi;
  const Pair back = detail::twoProduct(u, below.hi);
  const double more = ((((near.hi - back.hi) - back.lo) + above) - u * rest) * inverse;
  const double z = u * u;
  const double tail =
      u * z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 - z * (1.0 / 11)))));
  // The angle is that one, or what it leaves of a quarter or a half turn, or more than a quarter.
  const bool left = std::signbit(x);
  const double side = steep != left ? -1.0 : 1.0;
  Pair start{0.0, 0.0};
  if (steep || left)
    start = steep ? detail::kHalfPi : detail::kPi;
  const Pair base = detail::twoSum(start.hi, side * detail::kAtan[place].hi);
  const double baseLow = base.lo + (start.lo + side * detail::kAtan[place].lo);
  const Pair total = detail::twoSum(base.hi, side * u);
  const double low = total.lo + (baseLow + side * (more + tail));
  const double error = kAngleError * total.hi;
  const double value = total.hi + (low - error);
  angle = std::copysign(value, y);
  return value == total.hi + (low + error);
}

/// sin of what is left of an argument that is not tiny, and cos of it.
double sineOf(const Reduced &r) {
  const double value = (r.quadrant & 1U) != 0 ? sum(cosNear0(r.rest)) : sum(sinNear0(r.rest));
  return (r.quadrant & 2U) != 0 ? -value : value;
}
double cosineOf(const Reduced &r) {
  const double value = (r.quadrant & 1U) != 0 ? sum(sinNear0(r.rest)) : sum(cosNear0(r.rest));
  return r.quadrant == 1 || r.quadrant == 2 ? -value : value;
}

} // namespace

LREAL sin(LREAL x) {
  const double a = std::fabs(x);
  if (!(a <= std::numeric_limits<double>::max()))
    return detail::kNan;
  if (a < 0x1p-27)
    return x;
  return sineOf(reduce(x));
}

LREAL cos(LREAL x) {
  if (!(std::fabs(x) <= std::numeric_limits<double>::max()))
    return detail::kNan;
  return cosineOf(reduce(x));
}

SineCosine sineCosine(LREAL x) {
  const double a = std::fabs(x);
  if (!(a <= std::numeric_limits<double>::max()))
    return {detail::kNan, detail::kNan};
  const Reduced r = reduce(x);
  return {a < 0x1p-27 ? x : sineOf(r), cosineOf(r)};
}

LREAL tan(LREAL x) {
  const double a = std::fabs(x);
  if (!(a <= std::numeric_limits<double>::max()))
    return detail::kNan;
  if (a < 0x1p-27)
    return x;
  const Reduced r = reduce(x);
  const Pair s = sinNear0(r.rest);
  const Pair c = cosNear0(r.rest);
  const Pair sine = detail::fastTwoSum(s.hi, s.lo);
  const Pair cosine = detail::fastTwoSum(c.hi, c.lo);
  if ((r.quadrant & 1U) == 0)
    return detail::divide(sine, cosine).hi;
  return -detail::divide(cosine, sine).hi;
}

LREAL atan2(LREAL y, LREAL x) {
  if (x != x || y != y)
    return detail::kNan;
  double quick = 0;
  if (quickAngle(y, x, quick))
    return quick;
  const double infinity = std::numeric_limits<double>::infinity();
  double ay = std::fabs(y);
  double ax = std::fabs(x);
  Pair angle{0.0, 0.0};
  if (ay == 0) {
    // angle 0
  } else if (ax == 0) {
    angle = detail::kHalfPi;
  } else if (ay == infinity && ax == infinity) {
    angle = {0.5 * detail::kHalfPi.hi, 0.5 * detail::kHalfPi.lo};
  } else if (ay == infinity) {
    angle = detail::kHalfPi;
  } else if (ax == infinity) {
    // angle 0
  } else {
    int ey = 0;
    int ex = 0;
    std::frexp(ay, &ey);
    std::frexp(ax, &ex);
    if (ey - ex > 64) {
      angle = detail::kHalfPi;
    } else if (ey - ex < -64) {
      // The angle is the ratio itself; it counts only on the side of positive x.
      if (!std::signbit(x))
        return y / ax;
    } else {
      ay = std::ldexp(ay, -ex);
      ax = std::ldexp(ax, -ex);
      angle = atanOfRatio(Pair{ay, 0.0}, Pair{ax, 0.0});
    }
  }
  if (std::signbit(x))
    angle = detail::add(detail::kPi, Pair{-angle.hi, -angle.lo});
  return std::copysign(sum(angle), y);
}

LREAL atan(LREAL x) {
  if (std::fabs(x) < 0x1p-27)
    return x;
  return atan2(x, 1.0);
}

LREAL asin(LREAL x) {
  const double a = std::fabs(x);
  if (!(a <= 1.0))
    return detail::kNan;
  if (a < 0x1p-27)
    return x;
  if (a == 1.0)
    return std::copysign(detail::kHalfPi.hi, x);
  const Pair other =
      detail::squareRoot(detail::multiply(detail::twoSum(1.0, -a), detail::twoSum(1.0, a)));
  return std::copysign(sum(atanOfRatio(Pair{a, 0.0}, other)), x);
}

LREAL acos(LREAL x) {
  const double a = std::fabs(x);
  if (!(a <= 1.0))
    return detail::kNan;
  if (a == 1.0)
    return x > 0 ? 0.0 : detail::kPi.hi;
  if (a < 0x1p-60)
    return detail::kHalfPi.hi;
  const Pair other =
      detail::squareRoot(detail::multiply(detail::twoSum(1.0, -a), detail::twoSum(1.0, a)));
  Pair angle = atanOfRatio(other, Pair{a, 0.0});
  if (x < 0)
    angle = detail::add(detail::kPi, Pair{-angle.hi, -angle.lo});
  return sum(angle);
}

REAL sin(REAL x) { return static_cast<REAL>(sin(LREAL{x})); }
REAL cos(REAL x) { return static_cast<REAL>(cos(LREAL{x})); }
REAL tan(REAL x) { return static_cast<REAL>(tan(LREAL{x})); }
REAL asin(REAL x) { return static_cast<REAL>(asin(LREAL{x})); }
REAL acos(REAL x) { return static_cast<REAL>(acos(LREAL{x})); }
REAL atan(REAL x) { return static_cast<REAL>(atan(LREAL{x})); }
REAL atan2(REAL y, REAL x) { return static_cast<REAL>(atan2(LREAL{y}, LREAL{x})); }

} // namespace stride
