// The cube root, without <math.h>: the same on every machine. Free of the C++ standard library:
// linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CUBE_ROOT_HPP
#define STRIDE_RUNTIME_NUMERIC_CUBE_ROOT_HPP

#include "runtime/numeric/exact_math.hpp"

namespace stride::numeric {

/// Of x; 0 if x is not positive. To about an ulp.
inline double cubeRoot(double x) noexcept {
  if (!(x > 0.0))
    return 0.0;
  int exponent = 0;
  const double mantissa = exact::frexp(x, &exponent); // 0.5 to 1
  int third = exponent / 3;
  int rest = exponent % 3;
  if (rest < 0) {
    rest += 3;
    --third;
  }
  const double scaled = exact::ldexp(mantissa, rest); // 0.5 to 4
  double root = 0.6 + 0.3 * scaled;
  for (int i = 0; i < 6; ++i) // doubles its digits
    root -= (root - scaled / (root * root)) * (1.0 / 3.0);
  return exact::ldexp(root, third);
}

} // namespace stride::numeric

#endif // STRIDE_RUNTIME_NUMERIC_CUBE_ROOT_HPP
