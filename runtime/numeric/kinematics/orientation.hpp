// Orientations: as three angles in the conventions that programs write, as an axis with an angle,
// and on the way from one to another. Free of the C++ standard library: linked into every
// application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_ORIENTATION_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_ORIENTATION_HPP

#include "runtime/numeric/kinematics/frame.hpp"
#include "runtime/numeric/quarter_turns.hpp"

namespace stride::kinematics {

/// About which axes the angles A, B and C turn, one after the other, each about an axis that those
/// before have turned along.
enum class Convention : uint8_t {
  Zyz, ///< z, y', z'': what MC_COORD_REF holds
  Zyx, ///< z, y', x'': yaw, pitch, roll
  Xyz  ///< x, y', z''
};

/// [°]
struct Angles {
  double a, b, c;
};

/// Exact where all angles are multiples of 90 degrees.
inline Matrix<double> turnFrom(Convention convention, const Angles &angles) {
  const auto about = [](int axis, double degrees) {
    const numeric::Turn turn = numeric::turnOf(degrees);
    const int from = (axis + 1) % 3;
    const int to = (axis + 2) % 3;
    Matrix<double> matrix = Matrix<double>::Identity();
    matrix(from, from) = turn.c;
    matrix(to, to) = turn.c;
    matrix(to, from) = turn.s;
    matrix(from, to) = -turn.s;
    return matrix;
  };
  constexpr int kX = 0;
  constexpr int kY = 1;
  constexpr int kZ = 2;
  const int first = convention == Convention::Xyz ? kX : kZ;
  const int last = convention == Convention::Zyx ? kX : kZ;
  return about(first, angles.a) * about(kY, angles.b) * about(last, angles.c);
}

/// Its angles: A and C above -180 up to 180, B from 0 to 180 (Zyz) or from -90 to 90. Where the
/// first and the last axis lie in one line (gimbal lock), C is 0.
inline Angles anglesOf(Convention convention, const Matrix<double> &r) {
  // The first angle leads the y axis to where the second one turns about it. What is left of the
  // matrix without the first turn has the other two: so their errors even out near gimbal lock.
  double s = 0;
  double c = 0;
  constexpr double kLocked = 1e-12; // a sine below is what rounding leaves of 0
  switch (convention) {
  case Convention::Zyz:
    s = r(1, 2);
    c = r(0, 2);
    break;
  case Convention::Zyx:
    s = r(1, 0);
    c = r(0, 0);
    break;
  case Convention::Xyz:
    s = -r(1, 2);
    c = r(2, 2);
    break;
  }
  const bool locked = ::stride::sqrt(s * s + c * c) < kLocked;
  if (locked) { // with C = 0 the y axis shows the first angle
    s = convention == Convention::Xyz ? r(2, 1) : -r(0, 1);
    c = r(1, 1);
  }
  const double first = angleOf(s, c);
  const TurnOf<double> t = turnBy(first);
  double second = 0;
  double third = 0;
  switch (convention) {
  case Convention::Zyz:
    second = angleOf(t.c * r(0, 2) + t.s * r(1, 2), r(2, 2));
    third = angleOf(t.c * r(1, 0) - t.s * r(0, 0), t.c * r(1, 1) - t.s * r(0, 1));
    break;
  case Convention::Zyx:
    second = angleOf(-r(2, 0), t.c * r(0, 0) + t.s * r(1, 0));
    third = angleOf(t.s * r(0, 2) - t.c * r(1, 2), t.c * r(1, 1) - t.s * r(0, 1));
    break;
  case Convention::Xyz:
    second = angleOf(r(0, 2), t.c * r(2, 2) - t.s * r(1, 2));
    third = angleOf(t.c * r(1, 0) + t.s * r(2, 0), t.c * r(1, 1) + t.s * r(2, 1));
    break;
  }
  const auto degrees = [](double angle) {
    const double value = angle / numeric::kDegree;
    return value <= -180 ? value + 360 : value + 0.0; // no -0
  };
  const double middle = second / numeric::kDegree + 0.0;
  if (convention == Convention::Zyz) // rounding may leave a bit less than 0
    return {degrees(first), exact::fabs(middle), locked ? 0.0 : degrees(third)};
  const double within = middle > 90 ? 90.0 : (middle < -90 ? -90.0 : middle);
  return {degrees(first), within, locked ? 0.0 : degrees(third)};
}

/// An orientation as a unit quaternion with w >= 0.
struct Quaternion {
  double w, x, y, z;
};

inline Quaternion quaternionOf(const Matrix<double> &r) {
  // The largest of the four squares is never small: divided by it, the others lose nothing.
  const double square[4] = {1 + r(0, 0) + r(1, 1) + r(2, 2), 1 + r(0, 0) - r(1, 1) - r(2, 2),
                            1 - r(0, 0) + r(1, 1) - r(2, 2), 1 - r(0, 0) - r(1, 1) + r(2, 2)};
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (square[i] > square[largest])
      largest = i;
  const double twice = ::stride::sqrt(square[largest]); // of the largest part
  const double other = 0.5 / twice;
  const double skew[3] = {r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  double part[4];
  part[largest] = 0.5 * twice;
  if (largest == 0) {
    for (int i = 0; i < 3; ++i)
      part[1 + i] = skew[i] * other;
  } else {
    const int i = largest - 1;
    part[0] = skew[i] * other;
    for (int k = 0; k < 3; ++k)
      if (k != i)
        part[1 + k] = (r(k, i) + r(i, k)) * other;
  }
  const double sign = part[0] < 0 ? -1.0 : 1.0;
  return {sign * part[0], sign * part[1], sign * part[2], sign * part[3]};
}

/// The shortest turn from one orientation to another: about one axis with an angle that grows
/// evenly (slerp). Half a turn goes about the axis that `quaternionOf` finds.
struct GreatCircle {
  Matrix<double> start;
  Vector<double> axis; ///< in the base's axes; not of use where `angle` is 0
  double angle;        ///< [rad], from 0 to pi

  /// After a part of the way, 0 to 1.
  template <class Scalar> Matrix<Scalar> at(const Scalar &part) const {
    return about(axis, part * Scalar(angle)) * start.cast<Scalar>();
  }
};

inline GreatCircle greatCircle(const Matrix<double> &from, const Matrix<double> &to) {
  const Quaternion q = quaternionOf(to * from.transpose());
  const double half = ::stride::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(half > 0))
    return {from, {0, 0, 1}, 0};
  return {from, Vector<double>(q.x, q.y, q.z) / half, 2 * angleOf(half, q.w)};
}

/// The frame in which the base of `frame` stands.
template <class Scalar> Frame<Scalar> inverted(const Frame<Scalar> &frame) {
  Frame<Scalar> result;
  result.turn = frame.turn.transpose();
  result.place = -(result.turn * frame.place);
  return result;
}

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_ORIENTATION_HPP
