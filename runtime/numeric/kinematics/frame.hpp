// Frames in space: where a tool is and how it is turned; for numbers and for jets. Free of the C++
// standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_FRAME_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_FRAME_HPP

#include "runtime/numeric/kinematics/jet.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

template <int kOrder>
struct Eigen::NumTraits<stride::kinematics::Jet<kOrder>> : Eigen::NumTraits<double> {
  using Real = stride::kinematics::Jet<kOrder>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    // NOLINTNEXTLINE(readability-identifier-naming): the name that Eigen asks for
    RequireInitialization = 0
  };
};

namespace stride::kinematics {

template <class Scalar> using Vector = Eigen::Matrix<Scalar, 3, 1>;
template <class Scalar> using Matrix = Eigen::Matrix<Scalar, 3, 3>;

/// A frame in another: its axes are the columns of `turn` (orthogonal, right-handed), its origin is
/// `place` [u].
template <class Scalar> struct Frame {
  Matrix<Scalar> turn;
  Vector<Scalar> place;
};

/// The products a * b and a^T * b, with the sums in Eigen's order: its own of jets are not inlined.
/// In a product `b` may be of numbers.
template <class Scalar, class Other>
Matrix<Scalar> times(const Matrix<Scalar> &a, const Matrix<Other> &b) {
  Matrix<Scalar> product;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      product(row, column) =
          a(row, 0) * b(0, column) + (a(row, 1) * b(1, column) + a(row, 2) * b(2, column));
  return product;
}
template <class Scalar>
Matrix<Scalar> transposedTimes(const Matrix<Scalar> &a, const Matrix<Scalar> &b) {
  Matrix<Scalar> product;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      product(row, column) =
          a(0, row) * b(0, column) + (a(1, row) * b(1, column) + a(2, row) * b(2, column));
  return product;
}
template <class Scalar, class Other>
Vector<Scalar> times(const Matrix<Scalar> &a, const Vector<Other> &b) {
  Vector<Scalar> product;
  for (int row = 0; row < 3; ++row)
    product(row) = a(row, 0) * b(0) + (a(row, 1) * b(1) + a(row, 2) * b(2));
  return product;
}

/// The frame `inner`, given in `outer`, in that in which `outer` is given.
template <class Scalar>
Frame<Scalar> operator*(const Frame<Scalar> &outer, const Frame<Scalar> &inner) {
  return {times(outer.turn, inner.turn), times(outer.turn, inner.place) + outer.place};
}

template <class Scalar> Frame<Scalar> unturned(const Vector<Scalar> &place) {
  return {Matrix<Scalar>::Identity(), place};
}

/// Turns about the axes of a frame by an angle [rad], right-handed.
template <class Scalar> Matrix<Scalar> aboutX(const Scalar &angle) {
  const TurnOf<Scalar> t = turnBy(angle);
  const Scalar zero(0.0);
  Matrix<Scalar> turn;
  turn << Scalar(1.0), zero, zero, zero, t.c, -t.s, zero, t.s, t.c;
  return turn;
}
template <class Scalar> Matrix<Scalar> aboutY(const Scalar &angle) {
  const TurnOf<Scalar> t = turnBy(angle);
  const Scalar zero(0.0);
  Matrix<Scalar> turn;
  turn << t.c, zero, t.s, zero, Scalar(1.0), zero, -t.s, zero, t.c;
  return turn;
}
template <class Scalar> Matrix<Scalar> turnAboutZBy(const TurnOf<Scalar> &t) {
  const Scalar zero(0.0);
  Matrix<Scalar> turn;
  turn << t.c, -t.s, zero, t.s, t.c, zero, zero, zero, Scalar(1.0);
  return turn;
}
template <class Scalar> Matrix<Scalar> aboutZ(const Scalar &angle) {
  return turnAboutZBy(turnBy(angle));
}

/// A turn about a unit vector by an angle [rad] (Rodrigues).
template <class Scalar> Matrix<Scalar> about(const Vector<double> &axis, const Scalar &angle) {
  const TurnOf<Scalar> t = turnBy(angle);
  const Scalar rest = Scalar(1.0) - t.c;
  Matrix<Scalar> turn;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      turn(row, column) = rest * (axis(row) * axis(column));
  for (int i = 0; i < 3; ++i) {
    turn(i, i) += t.c;
    turn((i + 2) % 3, (i + 1) % 3) += t.s * axis(i);
    turn((i + 1) % 3, (i + 2) % 3) -= t.s * axis(i);
  }
  return turn;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_FRAME_HPP
