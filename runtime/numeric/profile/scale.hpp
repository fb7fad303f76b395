// Units in which a problem's numbers are near 1.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_SCALE_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_SCALE_HPP

#include "runtime/numeric/exact_math.hpp"

namespace stride::motion {

/// Binary exponent of |x|, 0.5 <= |x| / 2^e < 1; far below every other for 0.
inline int exponentOf(double x) noexcept {
  const auto bits = static_cast<unsigned>(__builtin_bit_cast(uint64_t, x) >> 52) & 0x7ffU;
  if (__builtin_expect(bits - 1U < 0x7feU, 1))
    return static_cast<int>(bits) - 1022;
  if (x == 0.0)
    return -4000;
  int exponent = 0;
  (void)exact::frexp(x, &exponent);
  return exponent;
}

/// A power of two to multiply with: exact unless the result is too large or too small for all its
/// digits. Two factors, because its exponent may be that of a quotient or a product of numbers.
class PowerOfTwo {
public:
  explicit PowerOfTwo(int exponent) noexcept : first_(of(exponent)), second_(1.0) {
    if (__builtin_expect(exponent < -1000 || exponent > 1000, 0)) {
      const int middle = exponent < 0 ? -1000 : 1000;
      const int rest = exponent - middle;
      first_ = of(middle);
      second_ = of(rest < -1000 ? -1000 : rest > 1000 ? 1000 : rest);
    }
  }
  double operator()(double x) const noexcept { return x * first_ * second_; }

private:
  static double of(int exponent) noexcept {
    return __builtin_bit_cast(double, static_cast<uint64_t>(exponent + 1023) << 52);
  }
  double first_;
  double second_;
};

/// Units for a motion. All are powers of two, so that going to them and back is exact and a plan
/// does not depend on the user's units.
struct Scale {
  int length = 0;       ///< [u]
  int velocity = 0;     ///< [u/s]
  int acceleration = 0; ///< [u/s^2]
  int time = 0;         ///< [s]

  static Scale of(double distance, double velocity, double acceleration,
                  double deceleration) noexcept {
    Scale scale;
    const double weaker = acceleration < deceleration ? acceleration : deceleration;
    const int way = exponentOf(distance);
    const int braking = 2 * exponentOf(velocity) - exponentOf(deceleration);
    scale.acceleration = exponentOf(weaker);
    scale.length = way > braking ? way : braking;
    if (((scale.length - scale.acceleration) & 1) != 0)
      ++scale.acceleration;
    scale.time = (scale.length - scale.acceleration) / 2;
    scale.velocity = scale.length - scale.time;
    return scale;
  }
};

} // namespace stride::motion

#endif
