// The root of a function between two arguments.
#ifndef STRIDE_RUNTIME_NUMERIC_PROFILE_BRACKETED_ROOT_HPP
#define STRIDE_RUNTIME_NUMERIC_PROFILE_BRACKETED_ROOT_HPP

#include "runtime/numeric/exact_math.hpp"

namespace stride::motion {

/// Where `function` changes its sign between `low` (there it is below 0) and `high` (at least 0),
/// to the last digits. Bounded time; of a function that is not steady, one of its sign changes.
/// Source: T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a
/// nonlinear function without using derivatives, 1997.
template <class Function>
double bracketedRoot(const Function &function, double low, double high) noexcept {
  double a = high; // the newest argument; the root is between a and b
  double b = low;
  double c = low; // the one before
  double fa = function(a);
  double fb = function(b);
  double fc = fb;
  double part = 0.5;
  for (int i = 0; i < 200; ++i) {
    const double argument = a + part * (b - a);
    const double value = function(argument);
    if ((value < 0.0) == (fa < 0.0)) {
      c = a;
      fc = fa;
    } else {
      c = b;
      fc = fb;
      b = a;
      fb = fa;
    }
    a = argument;
    fa = value;
    const double best = exact::fabs(fa) < exact::fabs(fb) ? a : b;
    const double tolerance = 0x1p-52 * exact::fabs(best);
    const double width = exact::fabs(b - a);
    if (fa == 0.0 || !(width > 2.0 * tolerance))
      return best;
    // Quadratic interpolation of the inverse where it is safe, else halves.
    const double xi = (a - b) / (c - b);
    const double phi = (fa - fb) / (fc - fb);
    part = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
      part = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    const double edge = tolerance / width;
    part = part < edge ? edge : part > 1.0 - edge ? 1.0 - edge : part;
  }
  return exact::fabs(fa) < exact::fabs(fb) ? a : b;
}

} // namespace stride::motion

#endif
