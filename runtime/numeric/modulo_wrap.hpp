// Reduction of a position to the modulo period. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_NUMERIC_MODULO_WRAP_HPP
#define STRIDE_RUNTIME_NUMERIC_MODULO_WRAP_HPP

#include "runtime/numeric/exact_math.hpp"

namespace stride::numeric {

/// `position` reduced to [0, period). `period` must be finite and > 0.
inline double wrapPosition(double position, double period) noexcept {
  if (position >= 0.0 && position < period)
    return position;
  // One period away there is nothing to divide; fmod is a call.
  double wrapped = position;
  if (position >= period && position <= 2.0 * period)
    wrapped -= period; // exact: the numbers differ by a factor of two at most
  else if (!(position < 0.0 && position >= -period))
    wrapped = exact::fmod(position, period); // exact
  if (wrapped < 0.0)
    wrapped += period;
  return wrapped >= period ? 0.0 : wrapped + 0.0; // -0 becomes 0
}

} // namespace stride::numeric

#endif
