// Where a group is along its path: the tool in space, the axes, and series of both over the way.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_PLACE_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_PLACE_HPP

#include "runtime/numeric/kinematics/frame.hpp"
#include "runtime/numeric/vector3.hpp"

namespace stride::group {

using kinematics::Frame;
using kinematics::Matrix;
using kinematics::Vector;
using numeric::Vector3;

/// Axes of the kinematics, and axes that go along with them.
inline constexpr int32_t kArmAxes = 6;
inline constexpr int32_t kMoreAxes = 4;
inline constexpr int32_t kAxes = kArmAxes + kMoreAxes;

/// A number along a path as a power series in the way: c[k] is the k-th derivative over k!.
using Series = kinematics::Jet<3>;

/// The series of the way itself, at `way`, where it grows by `rate` per unit of another one.
inline Series growing(double way, double rate) noexcept {
  Series series(way);
  series.c[1] = rate;
  return series;
}

inline bool isGiven(uint8_t given, int32_t k) noexcept {
  return (static_cast<unsigned>(given) >> static_cast<unsigned>(k) & 1U) != 0;
}

inline bool isZero(const Series &series) noexcept {
  return series.c[0] == 0.0 && series.c[1] == 0.0 && series.c[2] == 0.0 && series.c[3] == 0.0;
}

/// The tool: where its point is [u] and how it is turned, by rows. Trivially copyable.
struct Pose {
  Vector3 place;
  double turn[9];
};

inline Vector<double> vectorOf(const Vector3 &v) noexcept { return {v.x, v.y, v.z}; }
inline Vector3 plain(const Vector<double> &v) noexcept { return {v(0), v(1), v(2)}; }

inline Matrix<double> matrixOf(const double (&rows)[9]) noexcept {
  Matrix<double> matrix;
  for (int i = 0; i < 9; ++i)
    matrix(i / 3, i % 3) = rows[i];
  return matrix;
}
inline void setRows(double (&rows)[9], const Matrix<double> &matrix) noexcept {
  for (int i = 0; i < 9; ++i)
    rows[i] = matrix(i / 3, i % 3);
}

inline Frame<double> frameOf(const Pose &pose) noexcept {
  return {matrixOf(pose.turn), vectorOf(pose.place)};
}
inline Pose poseOf(const Frame<double> &frame) noexcept {
  Pose pose;
  pose.place = plain(frame.place);
  setRows(pose.turn, frame.turn);
  return pose;
}

/// A frame that does not move, and where one is that does.
inline Frame<Series> seriesOf(const Frame<double> &frame) noexcept {
  return {frame.turn.cast<Series>(), frame.place.cast<Series>()};
}
inline Frame<double> valueOf(const Frame<Series> &frame) noexcept {
  Frame<double> value;
  for (int row = 0; row < 3; ++row) {
    value.place(row) = frame.place(row).c[0];
    for (int column = 0; column < 3; ++column)
      value.turn(row, column) = frame.turn(row, column).c[0];
  }
  return value;
}

/// A turn about a fixed axis by an angle [rad] that changes along the path, after Rodrigues: with
/// `cross` for the product with the axis, an orientation R becomes
/// R + sine * cross(R) + rest * cross(cross(R)). Both products do not change along the path.
struct Turning {
  Vector3 about;
  Series sine;
  Series rest; ///< 1 - cosine
};

inline Turning turning(const Vector3 &about, const Series &angle) noexcept {
  const kinematics::TurnOf<Series> turn = kinematics::turnBy(angle);
  return {about, turn.s, Series(1.0) - turn.c};
}

/// The cross products of an axis and the columns of a matrix.
inline Matrix<double> crossed(const Vector3 &axis, const Matrix<double> &columns) noexcept {
  Matrix<double> product;
  for (int i = 0; i < 3; ++i) {
    product(0, i) = axis.y * columns(2, i) - axis.z * columns(1, i);
    product(1, i) = axis.z * columns(0, i) - axis.x * columns(2, i);
    product(2, i) = axis.x * columns(1, i) - axis.y * columns(0, i);
  }
  return product;
}

/// An orientation, given by rows, as a series; no -0.
inline Matrix<Series> seriesOf(const double (&rows)[9]) noexcept {
  return (matrixOf(rows).array() + 0.0).matrix().cast<Series>();
}

/// The sum of matrices that do not change along the path times factors that do, and of one more.
template <int kTerms>
Matrix<Series> sumOf(const Series (&factors)[kTerms], const Matrix<double> (&shares)[kTerms],
                     const Matrix<double> &constant) noexcept {
  Matrix<Series> result;
  for (int i = 0; i < 9; ++i) {
    Series sum(constant.data()[i] + 0.0);
    for (int term = 0; term < kTerms; ++term)
      for (int k = 0; k < 4; ++k)
        sum.c[k] += factors[term].c[k] * shares[term].data()[i];
    result.data()[i] = sum;
  }
  return result;
}

/// An orientation, given by rows, turned on about an axis of the machine by an angle [rad]. As a
/// rule the tool does not turn: then it is the orientation itself.
inline Matrix<Series> turnedOn(const Vector3 &about, const Series &angle,
                               const double (&rows)[9]) noexcept {
  if (isZero(angle))
    return seriesOf(rows);
  const Turning by = turning(about, angle);
  const Matrix<double> start = matrixOf(rows);
  const Matrix<double> once = crossed(about, start);
  return sumOf({by.sine, by.rest}, {once, crossed(about, once)}, start);
}

/// A place of the path as series over the way. Either the tool or the axes of the kinematics lead;
/// the axes that go along are always said.
struct PathPlace {
  bool byTool;
  uint8_t given = 0;  ///< If byTool: tool axes that are said in `axes`, as bits, so that only
                      ///< the tool's point counts besides, and not how it is turned.
  bool alsoTurns;     ///< If byTool: its point stops or starts, so that the way and how the tool
                      ///< turns count besides how far the point goes. [°]
  Frame<Series> tool; ///< If byTool.
  Series axes[kAxes]; ///< The first kArmAxes unless byTool; those that are given. [u]
};

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_PLACE_HPP
