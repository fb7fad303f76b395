// The oracle's own geometry: derivatives by differences, lengths, corners within their tolerance.
#include "tests/oracle/path/blended_path.hpp"

#include "tests/oracle/path/time_optimum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace stride::oracle;

double apart(const Point &a, const Point &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

ProgramMove line(const Point &start, const Point &end, double feed = 100) {
  return {MoveKind::Line, start, end, {}, {}, feed, 1000, 1000};
}

CurveLimits limitsOf(double velocity, double acceleration) {
  CurveLimits limits;
  limits.velocity = velocity;
  limits.axisAcceleration.fill(acceleration);
  return limits;
}

/// Tangent and curvature are the derivatives of the place, and the way is the arc length.
TEST(BlendedPath, DerivativesAreThoseOfItsPlaces) {
  size_t looked = 0;
  for (uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    ProgramOptions options;
    options.leastScale = options.greatestScale = 1;
    options.passages = 2;
    options.mostMoves = 20;
    const RandomProgram program = randomProgram(seed, options);
    const std::vector<BlendedPath> paths = blendedPaths(program.moves, 0.05, limitsOf(50, 1000));
    for (const BlendedPath &path : paths)
      for (int i = 1; i < 40; ++i) {
        const double way = path.length() * (i - 0.37) / 40;
        const double step = 1e-5 * std::min(1.0, path.length());
        const CurvePoint here = path.pointAt(way);
        const Point place = path.placeAt(way);
        const Point before = path.placeAt(way - step);
        const Point after = path.placeAt(way + step);
        const double bend = std::hypot(here.curvature[0], here.curvature[1], here.curvature[2]);
        if (bend * step > 1e-3) // too tight for this step
          continue;
        ASSERT_NEAR(apart(after, before) / (2 * step), 1, 2e-5);
        for (size_t axis = 0; axis < 3; ++axis)
          ASSERT_NEAR((after[axis] - before[axis]) / (2 * step), here.tangent[axis],
                      2e-5 + 20 * step * bend);
        const CurvePoint ahead = path.pointAt(way + step);
        const CurvePoint back = path.pointAt(way - step);
        const double change = apart({ahead.tangent[0], ahead.tangent[1], ahead.tangent[2]},
                                    {back.tangent[0], back.tangent[1], back.tangent[2]});
        ASSERT_LT(change, 1e-3 + 3 * step * (bend + 1e3)) << place[0];
        ++looked;
      }
  }
  EXPECT_GT(looked, 1500U);
}

TEST(BlendedPath, QuinticsHaveTheirEnds) {
  const std::array<Point, 3> start = {Point{1, 2, 3}, {4, -5, 6}, {-7, 8, 9}};
  const std::array<Point, 3> end = {Point{2, -1, 0.5}, {3, 3, -2}, {1, 0, 4}};
  const QuinticElement quintic = quinticBetween(start, end);
  for (size_t axis = 0; axis < 3; ++axis) {
    double place = 0;
    double slope = 0;
    double second = 0;
    for (size_t k = 0; k < 6; ++k) {
      const auto power = static_cast<double>(k);
      place += quintic.coefficients[k][axis];
      slope += power * quintic.coefficients[k][axis];
      second += power * (power - 1) * quintic.coefficients[k][axis];
    }
    EXPECT_NEAR(place, end[0][axis], 1e-13);
    EXPECT_NEAR(slope, end[1][axis], 1e-13);
    EXPECT_NEAR(second, end[2][axis], 1e-12);
    EXPECT_EQ(quintic.coefficients[1][axis], start[1][axis]);
    EXPECT_EQ(2 * quintic.coefficients[2][axis], start[2][axis]);
  }
  // The chord, if it is one.
  const QuinticElement straight =
      quinticBetween({Point{0, 0, 0}, {3, 4, 0}, {}}, {Point{3, 4, 0}, {3, 4, 0}, {}});
  EXPECT_NEAR(straight.ways.back(), 5, 1e-14);
}

/// How far a corner of 90 degrees is left, and how tightly it bends.
TEST(BlendedPath, KeepsItsTolerance) {
  for (const double degrees : {5.0, 37.0, 90.0, 140.0, 168.0}) {
    SCOPED_TRACE(degrees);
    const double turn = degrees * std::numbers::pi / 180;
    const std::vector<ProgramMove> moves = {
        line({-10, 0, 0}, {0, 0, 0}, 1e4),
        line({0, 0, 0}, {10 * std::cos(turn), 0, 10 * std::sin(turn)}, 1e4)};
    const std::vector<BlendedPath> paths = blendedPaths(moves, 0.1, limitsOf(1e4, 1000));
    ASSERT_EQ(paths.size(), 1U);
    EXPECT_EQ(paths[0].pieces(), 3U);
    double least = 1;
    for (int i = 0; i <= 20000; ++i)
      least = std::min(least, apart(paths[0].placeAt(paths[0].length() * i / 20000), {0, 0, 0}));
    EXPECT_LT(least, 0.1002);
    EXPECT_GT(least, 0.07);
  }
}

TEST(BlendedPath, CutsNoMoreThanTheVelocityNeeds) {
  const std::vector<ProgramMove> moves = {line({-10, 0, 0}, {0, 0, 0}),
                                          line({0, 0, 0}, {0, 10, 0})};
  // At 10 u/s and 0.9 * 1000 a curvature of 9 does: a cut of 0.13.
  const std::vector<BlendedPath> paths = blendedPaths(moves, 1, limitsOf(10, 1000));
  double greatest = 0;
  for (int i = 0; i <= 4000; ++i) {
    const CurvePoint point = paths[0].pointAt(9.5 + i / 4000.0);
    greatest = std::max(greatest, std::hypot(point.curvature[0], point.curvature[1]));
  }
  EXPECT_NEAR(greatest, 9, 0.1);
  EXPECT_NEAR(paths[0].length(), 20 - 0.13 * 0.45, 0.02);
}

TEST(BlendedPath, StopsWhereItCannotBlend) {
  const std::vector<ProgramMove> moves = {line({0, 0, 0}, {10, 0, 0}), line({10, 0, 0}, {20, 0, 0}),
                                          line({20, 0, 0}, {5, 0.1, 0}),
                                          line({5, 0.1, 0}, {5, 9, 0})};
  const std::vector<BlendedPath> some = blendedPaths(moves, 0.1, limitsOf(50, 1000));
  ASSERT_EQ(some.size(), 2U);
  EXPECT_NEAR(some[0].length(), 20, 1e-12);
  EXPECT_EQ(some[0].pieces(), 2U);
  EXPECT_EQ(some[1].pieces(), 3U);
  EXPECT_EQ(blendedPaths(moves, 0, limitsOf(50, 1000)).size(), 3U);
}

/// A blend is quicker than a stop, and a wider one is quicker than a narrow one.
TEST(BlendedPath, LeadsToAnOptimum) {
  const std::vector<ProgramMove> moves = {line({0, 0, 0}, {10, 0, 0}),
                                          line({10, 0, 0}, {10, 15, 0})};
  const CurveLimits limits = limitsOf(100, 1000);
  double before = 1e9;
  for (const double tolerance : {0.0, 0.01, 0.1, 0.5}) {
    double time = 0;
    for (const BlendedPath &path : blendedPaths(moves, tolerance, limits)) {
      const std::vector<double> knots = timeKnots(path.curve(), path.length(), limits, 0.002, 2000);
      const Optimum optimum = timeOptimum(cellsOf(path.curve(), knots, limits), 30000);
      EXPECT_TRUE(optimum.solved);
      time += optimum.time;
    }
    EXPECT_LT(time, before - 0.001);
    before = time;
  }
}

} // namespace
