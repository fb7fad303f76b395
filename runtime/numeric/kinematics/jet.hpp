// Numbers that carry their derivatives: truncated Taylor series in one variable. A function written
// for any scalar gives velocity, acceleration and jerk of its result when it is called with jets.
// Free of the C++ standard library: linked into every application.
//
// Source: the rules for the coefficients of products, quotients, roots and circular functions of
// power series, as in A. Griewank, A. Walther, Evaluating Derivatives, 2nd edition, chapter 13.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_JET_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_JET_HPP

#include "runtime/iec/math.h"

namespace stride::kinematics {

/// c[k] is the k-th derivative divided by k!.
template <int kOrder> struct Jet {
  double c[kOrder + 1];

  Jet() noexcept = default;
  /// A constant. Implicit, so that formulas for numbers are formulas for jets.
  constexpr Jet(double value) noexcept : c{value} {} // NOLINT(google-explicit-constructor)

  Jet &operator+=(const Jet &other) noexcept { return *this = *this + other; }
  Jet &operator-=(const Jet &other) noexcept { return *this = *this - other; }
  Jet &operator*=(const Jet &other) noexcept { return *this = *this * other; }
  Jet &operator/=(const Jet &other) noexcept { return *this = *this / other; }

  friend Jet operator+(const Jet &a, const Jet &b) noexcept {
    Jet sum = a;
    for (int k = 0; k <= kOrder; ++k)
      sum.c[k] += b.c[k];
    return sum;
  }
  friend Jet operator-(const Jet &a, const Jet &b) noexcept {
    Jet difference = a;
    for (int k = 0; k <= kOrder; ++k)
      difference.c[k] -= b.c[k];
    return difference;
  }
  friend Jet operator-(const Jet &a) noexcept { return Jet(0.0) - a; }
  friend Jet operator*(const Jet &a, const Jet &b) noexcept {
    // Written out: compilers leave a loop over the terms a loop. 0 makes -0 a 0.
    Jet product;
    product.c[0] = 0.0 + a.c[0] * b.c[0];
    if constexpr (kOrder >= 1)
      product.c[1] = 0.0 + a.c[0] * b.c[1] + a.c[1] * b.c[0];
    if constexpr (kOrder >= 2)
      product.c[2] = 0.0 + a.c[0] * b.c[2] + a.c[1] * b.c[1] + a.c[2] * b.c[0];
    if constexpr (kOrder >= 3)
      product.c[3] = 0.0 + a.c[0] * b.c[3] + a.c[1] * b.c[2] + a.c[2] * b.c[1] + a.c[3] * b.c[0];
    static_assert(kOrder <= 3);
    return product;
  }
  friend Jet operator/(const Jet &a, const Jet &b) noexcept {
    Jet quotient;
    const double *const q = quotient.c;
    quotient.c[0] = a.c[0] / b.c[0];
    if constexpr (kOrder >= 1)
      quotient.c[1] = (a.c[1] - q[0] * b.c[1]) / b.c[0];
    if constexpr (kOrder >= 2)
      quotient.c[2] = (a.c[2] - q[0] * b.c[2] - q[1] * b.c[1]) / b.c[0];
    if constexpr (kOrder >= 3)
      quotient.c[3] = (a.c[3] - q[0] * b.c[3] - q[1] * b.c[2] - q[2] * b.c[1]) / b.c[0];
    return quotient;
  }

  // With a constant, the same numbers as with a jet of it.
  friend Jet operator*(const Jet &a, double b) noexcept {
    Jet product;
    for (int k = 0; k <= kOrder; ++k)
      product.c[k] = 0.0 + a.c[k] * b;
    return product;
  }
  friend Jet operator*(double a, const Jet &b) noexcept { return b * a; }
  friend Jet operator/(const Jet &a, double b) noexcept {
    Jet quotient;
    for (int k = 0; k <= kOrder; ++k)
      quotient.c[k] = a.c[k] / b;
    return quotient;
  }
};

inline double valueOf(double number) noexcept { return number; }
template <int kOrder> double valueOf(const Jet<kOrder> &number) noexcept { return number.c[0]; }

/// The same number, but 0 for -0. Products of jets have none.
inline double withoutMinus0(double number) noexcept { return 0.0 + number; }
template <int kOrder> const Jet<kOrder> &withoutMinus0(const Jet<kOrder> &number) noexcept {
  return number;
}

inline double rootOf(double number) noexcept { return ::stride::sqrt(number); }
/// The square root; its derivatives are infinite or NaN at 0.
template <int kOrder> Jet<kOrder> rootOf(const Jet<kOrder> &square) noexcept {
  Jet<kOrder> root;
  const double *const r = root.c;
  root.c[0] = ::stride::sqrt(square.c[0]);
  const double twice = 2 * r[0];
  if constexpr (kOrder >= 1)
    root.c[1] = square.c[1] / twice;
  if constexpr (kOrder >= 2)
    root.c[2] = (square.c[2] - r[1] * r[1]) / twice;
  if constexpr (kOrder >= 3)
    root.c[3] = (square.c[3] - r[1] * r[2] - r[2] * r[1]) / twice;
  return root;
}

/// Cosine and sine of the same angle.
template <class Scalar> struct TurnOf { Scalar c, s; };

/// [rad] in
inline TurnOf<double> turnBy(double angle) noexcept {
  const SineCosine turn = sineCosine(angle);
  return {turn.c, turn.s};
}
/// Where cosine and sine of the angle itself are known.
template <int kOrder>
TurnOf<Jet<kOrder>> turnBy(const Jet<kOrder> &angle, const TurnOf<double> &first) noexcept {
  TurnOf<Jet<kOrder>> turn;
  double *const c = turn.c.c;
  double *const s = turn.s.c;
  c[0] = first.c;
  s[0] = first.s;
  const double *const a = angle.c;
  if constexpr (kOrder >= 1) {
    c[1] = 0.0 - a[1] * s[0];
    s[1] = 0.0 + a[1] * c[0];
  }
  if constexpr (kOrder >= 2) {
    c[2] = (0.0 - a[1] * s[1] - 2 * a[2] * s[0]) / 2;
    s[2] = (0.0 + a[1] * c[1] + 2 * a[2] * c[0]) / 2;
  }
  if constexpr (kOrder >= 3) {
    c[3] = (0.0 - a[1] * s[2] - 2 * a[2] * s[1] - 3 * a[3] * s[0]) / 3;
    s[3] = (0.0 + a[1] * c[2] + 2 * a[2] * c[1] + 3 * a[3] * c[0]) / 3;
  }
  return turn;
}
template <int kOrder> TurnOf<Jet<kOrder>> turnBy(const Jet<kOrder> &angle) noexcept {
  return turnBy(angle, turnBy(angle.c[0]));
}

/// Angle of the point (x, y), from -pi to pi. [rad]
inline double angleOf(double y, double x) noexcept { return ::stride::atan2(y, x); }
/// Its derivatives are NaN at (0, 0).
template <int kOrder> Jet<kOrder> angleOf(const Jet<kOrder> &y, const Jet<kOrder> &x) noexcept {
  // (x^2 + y^2) angle' = x y' - y x', coefficient by coefficient; of the first two products of
  // coefficients of the same order nothing is left.
  const auto across = [&x, &y](int i, int k) { return x.c[i] * y.c[k] - y.c[i] * x.c[k]; };
  Jet<kOrder> angle;
  double *const a = angle.c;
  a[0] = ::stride::atan2(y.c[0], x.c[0]);
  const double square = x.c[0] * x.c[0] + y.c[0] * y.c[0];
  if constexpr (kOrder >= 1)
    a[1] = (0.0 + across(0, 1)) / square;
  if constexpr (kOrder >= 2) {
    const double slope = (x.c[0] * x.c[1] + x.c[1] * x.c[0]) + (y.c[0] * y.c[1] + y.c[1] * y.c[0]);
    a[2] = (0.0 + 2 * across(0, 2) - a[1] * slope) / (2 * square);
    if constexpr (kOrder >= 3) {
      const double bend = (x.c[0] * x.c[2] + x.c[1] * x.c[1] + x.c[2] * x.c[0]) +
                          (y.c[0] * y.c[2] + y.c[1] * y.c[1] + y.c[2] * y.c[0]);
      a[3] = (across(2, 1) + 2 * across(1, 2) + 3 * across(0, 3) - a[1] * bend - 2 * a[2] * slope) /
             (3 * square);
    }
  }
  return angle;
}

/// turnBy(angle) where `angle` is angleOf(y, x), whole turns aside: by a root instead of series,
/// unless squares would lose digits.
inline TurnOf<double> turnTowards(double y, double x, double angle) noexcept {
  constexpr double kLeast = 1e-200;
  constexpr double kMost = 1e200;
  const double square = x * x + y * y;
  if (!(square > kLeast && square < kMost))
    return turnBy(angle);
  const double distance = ::stride::sqrt(square);
  return {x / distance, y / distance};
}
template <int kOrder>
TurnOf<Jet<kOrder>> turnTowards(const Jet<kOrder> &y, const Jet<kOrder> &x,
                                const Jet<kOrder> &angle) noexcept {
  return turnBy(angle, turnTowards(y.c[0], x.c[0], angle.c[0]));
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_JET_HPP
