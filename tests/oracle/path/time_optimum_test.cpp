// The offline optimum against closed forms, against the passes that are exact without a limit of
// the jerk, and against itself on finer cells.
#include "tests/oracle/path/time_optimum.hpp"

#include "tests/oracle/path/barrier_problem.hpp"
#include "tests/oracle/path/s_curve.hpp"
#include "tests/support/random.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace stride::oracle;
using stride::test::Random;

constexpr double kVelocity = 250;
constexpr double kAcceleration = 1750;
constexpr double kJerk = 50000;
constexpr double kNoJerk = std::numeric_limits<double>::infinity();

std::vector<Cell> line(double length, size_t count) {
  return std::vector<Cell>(
      count, {length / static_cast<double>(count), 1 / kAcceleration, 0, kVelocity * kVelocity});
}

/// Lines and curves between them, with noise: nothing a closed form is known for.
std::vector<Cell> winding(uint64_t seed, size_t count) {
  Random random(seed);
  std::vector<Cell> cells;
  while (cells.size() < count) {
    const double curvature = random.chance(0.5) ? 0.0 : random.magnitude(-3, 1);
    const double tangential = random.uniform(0.7, 1.0) / kAcceleration;
    const int some = 1 + random.below(40);
    for (int i = 0; i < some; ++i) {
      const double here = curvature * std::sin(std::numbers::pi * (i + 0.5) / some);
      cells.push_back({random.uniform(0.01, 0.03), tangential, here / kAcceleration,
                       std::min(kVelocity * kVelocity, 0.9 * kAcceleration / (here + 1e-9))});
    }
  }
  return cells;
}

void expectKept(const std::vector<Cell> &cells, double jerk, const Optimum &optimum) {
  EXPECT_TRUE(optimum.solved);
  const Excess excess = excessOf(cells, jerk, optimum.squares);
  EXPECT_LT(excess.ceiling, 0.0);
  EXPECT_LT(excess.acceleration, 0.0);
  EXPECT_LT(excess.jerk, 0.0);
  EXPECT_EQ(optimum.squares.front(), 0.0);
  EXPECT_EQ(optimum.squares.back(), 0.0);
  EXPECT_DOUBLE_EQ(timeOf(cells, jerk, optimum.squares), optimum.time);
}

TEST(TimeOptimum, OfALineIsTheSCurve) {
  for (const double length : {1e-3, 1e-2, 0.1, 1.0, 4.2875, 10.0, 30.0, 44.46, 100.0, 1000.0}) {
    SCOPED_TRACE(length);
    const std::vector<Cell> cells = line(length, 1000);
    const Optimum optimum = timeOptimum(cells, kJerk);
    expectKept(cells, kJerk, optimum);
    const double best = restToRestTime(length, kVelocity, kAcceleration, kJerk);
    EXPECT_LT(optimum.time, best * 1.0002);
    EXPECT_GT(optimum.time, best * 0.999);
  }
}

TEST(TimeOptimum, ComesNearerOnFinerCells) {
  for (const double length : {0.01, 1.0, 10.0}) {
    const double best = restToRestTime(length, kVelocity, kAcceleration, kJerk);
    const auto error = [&](size_t count) {
      return std::fabs(timeOptimum(line(length, count), kJerk, {1e-6}).time / best - 1);
    };
    const double coarse = error(250);
    const double fine = error(4000);
    EXPECT_LT(coarse, 1e-3) << length;
    EXPECT_LT(fine, 0.6 * coarse) << length;
  }
}

TEST(TimeOptimum, OfALineReachesThePeakVelocity) {
  const double peak = 100;
  const std::vector<Cell> cells = line(peak * (peak / kAcceleration + 0.035), 1500);
  const Optimum optimum = timeOptimum(cells, kJerk);
  const double greatest = *std::max_element(optimum.squares.begin(), optimum.squares.end());
  EXPECT_NEAR(std::sqrt(greatest), peak, 0.3);
}

/// Without a limit of the jerk: v = v1 tanh(A t / v1), v1^2 = A r.
TEST(TimeOptimum, OfAFullCircleIsKnownWithoutJerk) {
  const double radius = 10;
  const double length = 2 * std::numbers::pi * radius;
  const auto circle = [&](size_t count, double share) {
    return std::vector<Cell>(count, {length / static_cast<double>(count), 1 / kAcceleration,
                                     1 / (radius * kAcceleration), share * radius * kAcceleration});
  };
  const double best =
      2 * std::acosh(std::exp(std::numbers::pi)) * std::sqrt(radius / kAcceleration);
  const std::vector<Cell> cells = circle(4000, 1.0);
  EXPECT_NEAR(timeOptimum(cells, kNoJerk).time, best, 5e-4 * best);
  EXPECT_NEAR(accelerationOptimum(cells).time, best, 5e-4 * best);
  // With a limit of the jerk it takes longer, and goes as fast as the ceiling lets it.
  const std::vector<Cell> limited = circle(2000, 0.9);
  const Optimum optimum = timeOptimum(limited, kJerk);
  expectKept(limited, kJerk, optimum);
  EXPECT_GT(optimum.time, 1.02 * best);
  EXPECT_LT(optimum.time, best + 2 * kAcceleration / kJerk);
  EXPECT_NEAR(optimum.squares[1000], 0.9 * radius * kAcceleration, 1e-3 * radius * kAcceleration);
}

/// A narrow notch of the ceiling: the velocity has a minimum there, without acceleration.
TEST(TimeOptimum, PassesANotchWithoutAcceleration) {
  std::vector<Cell> cells = line(100, 2001);
  const double notch = 50;
  cells[1000].ceiling = notch * notch;
  const Optimum optimum = timeOptimum(cells, kJerk);
  expectKept(cells, kJerk, optimum);
  double low = notch;
  double high = kVelocity; // what half of the way is enough for
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    const double needed =
        changeWay(0, middle, kAcceleration, kJerk) + changeWay(middle, notch, kAcceleration, kJerk);
    (needed <= 50 ? low : high) = middle;
  }
  const double way =
      changeWay(0, low, kAcceleration, kJerk) + changeWay(low, notch, kAcceleration, kJerk);
  const double best = 2 * (changeTime(low, kAcceleration, kJerk) +
                           changeTime(low - notch, kAcceleration, kJerk) + (50 - way) / low);
  EXPECT_NEAR(optimum.time, best, 1.5e-3 * best);
  EXPECT_NEAR(optimum.squares[1000], notch * notch, 2e-3 * notch * notch);
}

TEST(TimeOptimum, IsThatOfThePassesWithoutAJerkLimit) {
  for (uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Cell> cells = winding(seed, 400);
    const double exact = accelerationOptimum(cells).time;
    for (const double jerk : {1e13, kNoJerk}) {
      const Optimum optimum = timeOptimum(cells, jerk);
      expectKept(cells, jerk, optimum);
      EXPECT_GT(optimum.time, exact * (1 - 1e-9));
      EXPECT_LT(optimum.time, exact * 1.0002);
    }
  }
}

TEST(TimeOptimum, KeepsTheLimitsAndIsNotQuickerThanWithoutJerk) {
  for (uint64_t seed = 10; seed < 16; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Cell> cells = winding(seed, 1000);
    const Optimum optimum = timeOptimum(cells, kJerk);
    expectKept(cells, kJerk, optimum);
    EXPECT_GT(optimum.time, accelerationOptimum(cells).time);
    // A better plan would have been found from a stricter gap, too.
    EXPECT_NEAR(timeOptimum(cells, kJerk, {1e-6}).time, optimum.time, 2e-4 * optimum.time);
    EXPECT_GT(optimum.time, timeOptimum(cells, 2 * kJerk).time);
  }
}

TEST(TimeOptimum, OfAPathAndOfItsReverseAreEqual) {
  std::vector<Cell> cells = winding(77, 700);
  const double forwards = timeOptimum(cells, kJerk).time;
  std::reverse(cells.begin(), cells.end());
  EXPECT_NEAR(timeOptimum(cells, kJerk).time, forwards, 2e-4 * forwards);
}

TEST(TimeOptimum, StopsInBetween) {
  const std::vector<Cell> one = line(3, 300);
  const std::vector<Cell> other = line(20, 500);
  std::vector<Cell> both = one;
  both.push_back({1e-6, 1 / kAcceleration, 0, 0});
  both.insert(both.end(), other.begin(), other.end());
  const Optimum optimum = timeOptimum(both, kJerk);
  EXPECT_TRUE(optimum.solved);
  EXPECT_DOUBLE_EQ(optimum.time, timeOptimum(one, kJerk).time + timeOptimum(other, kJerk).time);
  EXPECT_EQ(optimum.squares[300], 0.0);
  EXPECT_EQ(optimum.squares[301], 0.0);
  EXPECT_EQ(optimum.squares.size(), 802U);
}

TEST(TimeOptimum, NeedsThreeCells) {
  EXPECT_FALSE(timeOptimum(line(3, 2), kJerk).solved);
  EXPECT_FALSE(accelerationOptimum(line(3, 2)).solved);
  EXPECT_TRUE(timeOptimum(line(3, 3), kJerk).solved);
}

TEST(TimeOptimum, ExcessNamesWhatIsExceeded) {
  const std::vector<Cell> cells = line(30, 300);
  std::vector<double> squares = timeOptimum(cells, kJerk).squares;
  for (double &square : squares)
    square *= 1.01;
  // b enters the acceleration once, the jerk one and a half times.
  const Excess excess = excessOf(cells, kJerk, squares);
  EXPECT_NEAR(excess.acceleration, 0.01, 1e-4);
  EXPECT_NEAR(excess.jerk, std::pow(1.01, 1.5) - 1, 1e-4);
  for (double &square : squares)
    square *= 0.5;
  squares[150] = 1.002 * kVelocity * kVelocity;
  EXPECT_NEAR(excessOf(cells, kJerk, squares).ceiling, 0.002, 1e-12);
}

TEST(BandedSystem, IsSolvedAsADenseOneIs) {
  Random random(4);
  for (const int size : {1, 2, 3, 9}) {
    Eigen::MatrixXd half = Eigen::MatrixXd::Zero(size, size);
    for (int row = 0; row < size; ++row)
      for (int column = std::max(0, row - 2); column <= row; ++column)
        half(row, column) = random.uniform(row == column ? 0.5 : -1, 1);
    const Eigen::MatrixXd matrix = half * half.transpose();
    BandedSystem system(static_cast<size_t>(size));
    Eigen::VectorXd right(size);
    for (int i = 0; i < size; ++i) {
      const auto at = static_cast<size_t>(i);
      right(i) = random.uniform(-1, 1);
      system.rightSide[at] = right(i);
      system.diagonal[at] = matrix(i, i);
      system.first[at] = i + 1 < size ? matrix(i + 1, i) : 0;
      system.second[at] = i + 2 < size ? matrix(i + 2, i) : 0;
    }
    const Eigen::VectorXd expected = matrix.ldlt().solve(right);
    ASSERT_TRUE(system.solve());
    for (int i = 0; i < size; ++i)
      EXPECT_NEAR(static_cast<double>(system.rightSide[static_cast<size_t>(i)]), expected(i), 1e-9);
  }
  BandedSystem indefinite(2);
  indefinite.diagonal = {1, 1};
  indefinite.first = {2, 0};
  EXPECT_FALSE(indefinite.solve());
}

/// The gradient and the matrix are the barrier function's derivatives.
TEST(BarrierProblem, EquationsAreItsDerivatives) {
  const std::vector<Cell> cells = winding(3, 30);
  const BarrierProblem problem(cells, kJerk);
  std::vector<double> squares = timeOptimum(cells, kJerk).squares;
  for (double &square : squares)
    square *= 0.7; // well inside
  constexpr double kWeight = 1e-4;
  BandedSystem system(cells.size() - 1);
  problem.assemble(squares, kWeight, system);
  for (size_t node = 1; node < cells.size(); ++node) {
    const double step = 1e-7 * squares[node];
    std::vector<double> moved = squares;
    moved[node] += step;
    const double above = problem.barrier(moved, kWeight);
    moved[node] -= 2 * step;
    const double below = problem.barrier(moved, kWeight);
    const double slope = (above - below) / (2 * step);
    EXPECT_NEAR(static_cast<double>(-system.rightSide[node - 1]), slope,
                1e-5 * (std::fabs(slope) + 1e-6))
        << node;
  }
}

} // namespace
