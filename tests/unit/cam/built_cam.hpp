// Pieces in few words, and the cam they make.
#ifndef STRIDE_TESTS_UNIT_CAM_BUILT_CAM_HPP
#define STRIDE_TESTS_UNIT_CAM_BUILT_CAM_HPP

#include "runtime/numeric/cam/builder.hpp"

#include <cstddef>
#include <gtest/gtest.h>
#include <initializer_list>
#include <utility>
#include <vector>

namespace stride::test {

inline cam::Boundary bound(double x, double y, double v = 0, double a = 0, double j = 0) {
  return {x, y, v, a, j, 5};
}
inline cam::Boundary implicit() { return {0, 0, 0, 0, 0, 0}; }
inline cam::Boundary place(double x, double y) { return {x, y, 0, 0, 0, 2}; }

inline cam::Piece pieceOf(cam::PieceKind kind, cam::Boundary left, cam::Boundary right) {
  return {kind, left, right, {}, 0.0, 0.5, cam::Law::Polynomial};
}
inline cam::Piece line(cam::Boundary left, cam::Boundary right) {
  return pieceOf(cam::PieceKind::Line, left, right);
}
inline cam::Piece poly5(cam::Boundary left, cam::Boundary right) {
  return pieceOf(cam::PieceKind::Poly5, left, right);
}
inline cam::Piece poly7(cam::Boundary left, cam::Boundary right) {
  return pieceOf(cam::PieceKind::Poly7, left, right);
}

/// A cam, built.
struct BuiltCam {
  explicit BuiltCam(std::vector<cam::Piece> from, bool closed = false)
      : pieces(std::move(from)), work(pieces.size() + 1) {
    cam::Builder builder(pieces.data(), static_cast<int32_t>(pieces.size()), closed, work.data());
    error = builder.solve();
    for (int32_t i = 0; error == cam::BuildError::None && i < static_cast<int32_t>(pieces.size());
         ++i) {
      cam::Segment result[2];
      int32_t count = 0;
      error = builder.segments(i, result, count);
      if (error == cam::BuildError::None)
        segments.insert(segments.end(), result, result + count);
    }
  }

  [[nodiscard]] cam::Point at(double x) const {
    size_t i = segments.size() - 1;
    while (i > 0 && x < segments[i].start)
      --i;
    return cam::evaluateSegment(segments[i], x);
  }
  [[nodiscard]] cam::Point start(size_t i) const {
    return cam::evaluateSegment(segments[i], segments[i].start);
  }
  [[nodiscard]] cam::Point end(size_t i) const {
    return cam::evaluateSegment(segments[i], segments[i].end);
  }

  std::vector<cam::Piece> pieces;
  std::vector<cam::JointWork> work;
  std::vector<cam::Segment> segments;
  cam::BuildError error = cam::BuildError::None;
};

/// The first `count` of y, v, a, j.
inline void expectPoint(const cam::Point &is, const cam::Point &want, size_t count,
                        double tolerance) {
  const double a[] = {is.y, is.v, is.a, is.j};
  const double b[] = {want.y, want.v, want.a, want.j};
  for (size_t i = 0; i < count; ++i)
    EXPECT_NEAR(a[i], b[i], tolerance) << "derivative " << i;
}

inline void expectPoint(const cam::Point &is, std::initializer_list<double> want,
                        double tolerance) {
  const double a[] = {is.y, is.v, is.a, is.j};
  size_t i = 0;
  for (const double value : want) {
    EXPECT_NEAR(a[i], value, tolerance) << "derivative " << i;
    ++i;
  }
}
inline void expectPoint(const cam::Point &is, const cam::Point &want, double tolerance) {
  expectPoint(is, want, 4, tolerance);
}

} // namespace stride::test

#endif
