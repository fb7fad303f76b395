// Positions that run over any number of periods, without drift: whole periods are counted, what
// remains is exact to the last bit or two however many there are.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_PERIOD_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_PERIOD_HPP

#include "runtime/iec/double_double.hpp"
#include "runtime/numeric/exact_math.hpp"

#include <stdint.h>

namespace stride::cam {

/// An unevaluated sum of two doubles. [u]
using Total = ::stride::detail::Pair;

/// `count` periods and `position`.
inline Total totalOf(int64_t count, double period, double position) noexcept {
  if (count == 0)
    return {position, 0.0};
  return detail::add(detail::twoProduct(static_cast<double>(count), period), {position, 0.0});
}

/// `total` stretched, then shifted.
inline Total stretched(Total total, double factor, double shift) noexcept {
  return detail::add(detail::multiply(total, {factor, 0.0}), {shift, 0.0});
}

inline double toDouble(Total total) noexcept { return total.hi + total.lo; }

/// A position as a number of whole periods and what remains.
struct Place {
  int64_t period;
  double position; ///< In [start, start + length). [u]
};

/// Where `total` is on a scale that repeats itself every `length` > 0 from `start` on. Beyond 2^52
/// periods the place is `start`.
inline Place placeOf(Total total, double start, double length) noexcept {
  if (total.lo == 0.0 && total.hi >= start && total.hi < start + length)
    return {0, total.hi};
  const double count = (total.hi - start) / length;
  if (!(exact::fabs(count) < 4503599627370496.0))
    return {0, start};
  auto period = static_cast<int64_t>(count); // rounded towards 0: mended below
  if (count < static_cast<double>(period))
    --period;
  const auto rest = [&] {
    const Total begin = detail::twoProduct(static_cast<double>(period), length);
    return toDouble(detail::add(total, {-begin.hi, -begin.lo}));
  };
  double position = rest();
  // The quotient is rounded: one too many or too few.
  if (position < start) {
    --period;
    position = rest();
  } else if (position >= start + length) {
    ++period;
    position = rest();
  }
  if (position >= start + length)
    return {period + 1, start};
  return {period, position < start ? start : position};
}

} // namespace stride::cam

#endif
