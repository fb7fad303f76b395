// Cells of curves against what is known of circles and lines.
#include "tests/oracle/path/curve_cells.hpp"

#include "tests/oracle/path/reference_planner.hpp"
#include "tests/oracle/path/s_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace stride::oracle;

constexpr double kAny = std::numeric_limits<double>::infinity();

CurvePoint circle(double way) {
  const double radius = 5;
  const double angle = way / radius;
  CurvePoint point{{}, {}, kAny};
  point.tangent[0] = -std::sin(angle);
  point.tangent[1] = std::cos(angle);
  point.curvature[0] = -std::cos(angle) / radius;
  point.curvature[1] = -std::sin(angle) / radius;
  return point;
}

CurveLimits limitsOfAxes() {
  CurveLimits limits;
  limits.velocity = 40;
  limits.axisAcceleration.fill(700);
  limits.axisVelocity[1] = 30;
  return limits;
}

TEST(CurveCells, HaveTheStrictestLimitsOfTheirAxes) {
  // Around 45 degrees, 1.2 u long.
  const double middle = 5 * std::numbers::pi / 4;
  const std::vector<double> knots = {middle - 0.6, middle + 0.6};
  const std::vector<Cell> cells = cellsOf(circle, knots, limitsOfAxes(), 3);
  ASSERT_EQ(cells.size(), 1U);
  const double off = 0.4 / 5; // of the outer samples
  const double greatest = std::cos(std::numbers::pi / 4 - off);
  EXPECT_DOUBLE_EQ(cells[0].length, 1.2);
  EXPECT_NEAR(cells[0].tangential, greatest / 700, 1e-12);
  EXPECT_NEAR(cells[0].curvature, greatest / 5 / 700, 1e-12);
  EXPECT_NEAR(cells[0].ceiling, 900 / (greatest * greatest), 1e-9); // Y; 40 along the path is more
}

TEST(CurveCells, CeilingsAreThoseOfVelocitiesAndCurves) {
  CurveLimits limits;
  limits.axisAcceleration.fill(700);
  const std::vector<double> knots = {0, 1e-6};
  EXPECT_NEAR(cellsOf(circle, knots, limits)[0].ceiling, 0.9 * 700 * 5, 1e-3);
  limits.curveShare = 0.5;
  EXPECT_NEAR(cellsOf(circle, knots, limits)[0].ceiling, 0.5 * 700 * 5, 1e-3);
  limits.axisVelocity[1] = 30;
  EXPECT_NEAR(cellsOf(circle, knots, limits)[0].ceiling, 900, 1e-3);
  limits.velocity = 20;
  EXPECT_NEAR(cellsOf(circle, knots, limits)[0].ceiling, 400, 1e-3);
  const Curve slow = [](double way) {
    CurvePoint point = circle(way);
    point.feed = 10;
    return point;
  };
  EXPECT_NEAR(cellsOf(slow, knots, limits)[0].ceiling, 100, 1e-3);
  limits.acceleration = 350;
  EXPECT_NEAR(cellsOf(slow, knots, limits)[0].tangential, 1 / 350.0, 1e-12);
}

Curve lineWithNotch() {
  return [](double way) {
    CurvePoint point{{1}, {}, way > 30 && way < 31 ? 5.0 : kAny};
    return point;
  };
}

TEST(CurveCells, KnotsFollowEachOtherInEvenTime) {
  CurveLimits limits;
  limits.velocity = 40;
  limits.axisAcceleration.fill(700);
  const double step = 0.002;
  const std::vector<double> knots = timeKnots(lineWithNotch(), 50, limits, step, 2000);
  EXPECT_EQ(knots.front(), 0);
  EXPECT_EQ(knots.back(), 50);
  for (size_t i = 2; i + 1 < knots.size(); ++i) {
    const double ratio = (knots[i] - knots[i - 1]) / (knots[i - 1] - knots[i - 2]);
    ASSERT_GT(ratio, 0.7) << i;
    ASSERT_LT(ratio, 1.4) << i;
  }
  const auto spacingAt = [&](double way) {
    const auto next = std::upper_bound(knots.begin(), knots.end(), way);
    return *next - *(next - 1);
  };
  EXPECT_NEAR(spacingAt(15), 40 * step, 1e-12);
  EXPECT_NEAR(spacingAt(30.5), 5 * step, 1e-3);
  EXPECT_LT(knots[1], 0.002); // 700 * 0.002^2 / 2
}

/// From the curve to the optimum: a circle, whose axes have their limits in other places.
TEST(CurveCells, LeadToTheOptimum) {
  const CurveLimits limits = limitsOfAxes();
  const double length = 10 * std::numbers::pi;
  const auto solve = [&](double step) {
    const std::vector<Cell> cells =
        cellsOf(circle, timeKnots(circle, length, limits, step, 1000), limits);
    const Optimum optimum = timeOptimum(cells, 30000);
    EXPECT_TRUE(optimum.solved);
    EXPECT_GT(optimum.time, lowerBound(cells, 30000));
    EXPECT_LE(optimum.time, referencePlan(fieldsOf(cells), 30000).time);
    return optimum.time;
  };
  const double fine = solve(0.001);
  EXPECT_NEAR(solve(0.002), fine, 0.01 * fine);
  EXPECT_GT(fine, length / 40);
}

TEST(CurveCells, LowerBoundIsSharpForLines) {
  const std::vector<Cell> line(100, {0.3, 1 / 700.0, 0, 1600});
  EXPECT_NEAR(lowerBound(line, 30000), restToRestTime(30, 40, 700, 30000), 1e-12);
  // The curvature is left out: what is slow by it alone is not bounded.
  std::vector<Cell> curved = line;
  for (Cell &cell : curved)
    cell.curvature = 1e-4;
  EXPECT_DOUBLE_EQ(lowerBound(curved, 30000), lowerBound(line, 30000));
  std::vector<Cell> two = line;
  two[30].ceiling = 0;
  EXPECT_NEAR(lowerBound(two, 30000),
              restToRestTime(9, 40, 700, 30000) + restToRestTime(20.7, 40, 700, 30000), 1e-12);
  std::vector<Cell> slow = line;
  for (size_t i = 40; i < 60; ++i)
    slow[i].ceiling = 4;
  EXPECT_GT(lowerBound(slow, 30000), 3.0); // 6 u at 2 u/s
}

} // namespace
