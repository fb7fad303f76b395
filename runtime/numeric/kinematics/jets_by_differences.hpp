// Derivatives of what can only be asked for numbers: central differences over seven places. Free of
// the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_JETS_BY_DIFFERENCES_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_JETS_BY_DIFFERENCES_HPP

#include "runtime/numeric/kinematics/model.hpp"

namespace stride::kinematics {

/// A frame has twelve numbers.
inline constexpr int kMostFrameNumbers = 12;

/// A jet's polynomial at a place beside its own.
inline double valueAt(const Jet<3> &jet, double t) noexcept {
  return jet.c[0] + t * (jet.c[1] + t * (jet.c[2] + t * jet.c[3]));
}

/// Value and three derivatives at 0 of `evaluate(t, values)`, which says `count` numbers and
/// whether it can. `step`: so that the numbers change by about a hundredth of what bends them. The
/// errors are about 1e-13, 1e-11 and 1e-8 of the numbers by that.
template <class Evaluate>
Outcome jetsByDifferences(double step, int count, Evaluate evaluate, Jet<3> *jets) {
  double at[7][kMostFrameNumbers];
  for (int i = 0; i < 7; ++i) {
    const Outcome outcome = evaluate((i - 3) * step, at[i]);
    if (outcome != Outcome::Done)
      return outcome;
  }
  for (int n = 0; n < count; ++n) {
    const auto f = [&](int i) { return at[i + 3][n]; };
    const double odd1 = f(1) - f(-1);
    const double odd2 = f(2) - f(-2);
    const double odd3 = f(3) - f(-3);
    const double even1 = f(1) + f(-1) - 2 * f(0);
    const double even2 = f(2) + f(-2) - 2 * f(0);
    const double even3 = f(3) + f(-3) - 2 * f(0);
    jets[n].c[0] = f(0);
    jets[n].c[1] = (45 * odd1 - 9 * odd2 + odd3) / (60 * step);
    jets[n].c[2] = (270 * even1 - 27 * even2 + 2 * even3) / (180 * step * step) / 2;
    jets[n].c[3] = (-13 * odd1 + 8 * odd2 - odd3) / (8 * step * step * step) / 6;
  }
  return Outcome::Done;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_JETS_BY_DIFFERENCES_HPP
