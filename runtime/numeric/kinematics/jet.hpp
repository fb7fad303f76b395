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
    Jet quotient(0.0);
    for (int k = 0; k <= kOrder; ++k) {
      double rest = a.c[k];
      for (int i = 0; i < k; ++i)
        rest -= quotient.c[i] * b.c[k - i];
      quotient.c[k] = rest / b.c[0];
    }
    return quotient;
  }
};

inline double valueOf(double number) noexcept { return number; }
template <int kOrder> double valueOf(const Jet<kOrder> &number) noexcept { return number.c[0]; }

inline double rootOf(double number) noexcept { return ::stride::sqrt(number); }
/// The square root; its derivatives are infinite or NaN at 0.
template <int kOrder> Jet<kOrder> rootOf(const Jet<kOrder> &square) noexcept {
  Jet<kOrder> root(::stride::sqrt(square.c[0]));
  for (int k = 1; k <= kOrder; ++k) {
    double rest = square.c[k];
    for (int i = 1; i < k; ++i)
      rest -= root.c[i] * root.c[k - i];
    root.c[k] = rest / (2 * root.c[0]);
  }
  return root;
}

/// Cosine and sine of the same angle.
template <class Scalar> struct TurnOf { Scalar c, s; };

/// [rad] in
inline TurnOf<double> turnBy(double angle) noexcept {
  return {::stride::cos(angle), ::stride::sin(angle)};
}
template <int kOrder> TurnOf<Jet<kOrder>> turnBy(const Jet<kOrder> &angle) noexcept {
  TurnOf<Jet<kOrder>> turn{::stride::cos(angle.c[0]), ::stride::sin(angle.c[0])};
  for (int k = 1; k <= kOrder; ++k) {
    double c = 0;
    double s = 0;
    for (int i = 1; i <= k; ++i) {
      c -= i * angle.c[i] * turn.s.c[k - i];
      s += i * angle.c[i] * turn.c.c[k - i];
    }
    turn.c.c[k] = c / k;
    turn.s.c[k] = s / k;
  }
  return turn;
}

/// Angle of the point (x, y), from -pi to pi. [rad]
inline double angleOf(double y, double x) noexcept { return ::stride::atan2(y, x); }
/// Its derivatives are NaN at (0, 0).
template <int kOrder> Jet<kOrder> angleOf(const Jet<kOrder> &y, const Jet<kOrder> &x) noexcept {
  const Jet<kOrder> square = x * x + y * y;
  Jet<kOrder> angle(::stride::atan2(y.c[0], x.c[0]));
  // (x^2 + y^2) angle' = x y' - y x', coefficient by coefficient
  for (int k = 1; k <= kOrder; ++k) {
    double rest = 0;
    for (int i = 1; i <= k; ++i)
      rest += i * (x.c[k - i] * y.c[i] - y.c[k - i] * x.c[i]);
    for (int i = 1; i < k; ++i)
      rest -= i * angle.c[i] * square.c[k - i];
    angle.c[k] = rest / (k * square.c[0]);
  }
  return angle;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_JET_HPP
