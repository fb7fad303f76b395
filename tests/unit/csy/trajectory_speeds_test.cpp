// Speeds of the pieces of a path, by closed forms.
#include "runtime/numeric/csy/trajectory_speeds.hpp"

#include "path_words.hpp"

#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace {

using namespace stride::csy;
using stride::test::PathPoint;
using stride::test::pathWords;

struct Result {
  std::unique_ptr<TrajectoryTable> table = std::make_unique<TrajectoryTable>();
  std::unique_ptr<Trajectory> trajectory = std::make_unique<Trajectory>();
  std::unique_ptr<Speeds> speeds = std::make_unique<Speeds>();
};

Result resultOf(const std::vector<PathPoint> &points, const SlaveLimits &limits) {
  Result result;
  const std::vector<int16_t> words = pathWords(points);
  EXPECT_EQ(readTable(words.data(), static_cast<uint32_t>(words.size()), kMostPoints, *result.table)
                .error,
            PathError::None);
  EXPECT_EQ(computeTrajectory(*result.table, *result.trajectory).error, PathError::None);
  computeSpeeds(*result.table, *result.trajectory, limits, *result.speeds);
  return result;
}

TEST(CsySpeeds, FollowTheAxesOnLines) {
  const SlaveLimits limits{{300, 400, 0}, {0, 0, 0}};
  // 3, 4: both axes reach their limit at 500.
  Result result = resultOf({{}, {.x = 3, .y = 4, .speed = 80}}, limits);
  EXPECT_NEAR(result.speeds->allowed[0], 500, 1e-9);
  EXPECT_EQ(result.speeds->computed[0], 80.0);
  result = resultOf({{}, {.x = 0, .y = 4, .speed = 900}, {.x = -4, .y = 7}}, limits);
  EXPECT_NEAR(result.speeds->allowed[0], 400, 1e-9);
  EXPECT_NEAR(result.speeds->computed[0], 400, 1e-9);
  EXPECT_NEAR(result.speeds->computed[1], 375, 1e-9); // ParF0 = 0
  EXPECT_NEAR(constantSpeed(*result.trajectory, *result.speeds), 375, 1e-9);
}

TEST(CsySpeeds, FollowAccelerationsOnArcs) {
  // A circle of radius 2: v^2 / 2 within the lower acceleration.
  const PathPoint circle{.x = 2, .type = 12, .parW1 = 20};
  const SlaveLimits limits{{0, 0, 0}, {50, 18, 0}};
  EXPECT_NEAR(resultOf({{.x = 2}, circle}, limits).speeds->allowed[0], 6, 1e-9);
  // From -30 to 30 degrees y bends by sin 30 only.
  const float c = 2 * std::cos(0.5235987755982988F);
  PathPoint part{.x = c, .y = 1, .type = 12, .parW1 = 20};
  EXPECT_NEAR(resultOf({{.x = c, .y = -1}, part}, limits).speeds->allowed[0],
              std::sqrt(18 * 2 / 0.5), 1e-5);
  EXPECT_NEAR(resultOf({{.x = c, .y = -1}, part}, {{4, 9, 0}, {0, 0, 0}}).speeds->allowed[0], 8,
              1e-5);
}

TEST(CsySpeeds, FollowAccelerationsOnBlends) {
  // Right-angled cubic, 1 and 1: P'' over the way is greatest at the ends.
  const std::vector<PathPoint> points{{.x = -3}, {.type = 1, .parF1 = 1, .parF2 = 1}, {.y = 3}};
  const Result result = resultOf(points, {{0, 0, 0}, {0, 30, 0}});
  // Hermite's form of y, from 0 to 1 with slopes 0 and 2, bends by 6 - 4 at the start and 8 - 6 at
  // the end; the way of the master is 2.
  EXPECT_NEAR(result.speeds->allowed[1], std::sqrt(30.0 / (2.0 / 4.0)), 1e-9);
  EXPECT_TRUE(std::isinf(result.speeds->allowed[0]));
}

TEST(CsySpeeds, FillTablesWithTwoValuesAPoint) {
  const std::vector<PathPoint> points{
      {.x = -3}, {.type = 1, .parF1 = 1, .parF2 = 1, .speed = 3}, {.y = 3, .speed = 5}};
  const Result result = resultOf(points, {{12, 8, 0}, {0, 0, 0}});
  std::array<double, 6> values{};
  fillResults(*result.trajectory, *result.speeds, ResultTable::MasterPositions, values.data());
  EXPECT_EQ(values, (std::array<double, 6>{0, 0, 2, 4, 6, 6}));
  fillResults(*result.trajectory, *result.speeds, ResultTable::AllowedSpeeds, values.data());
  EXPECT_EQ(values, (std::array<double, 6>{0, 0, 12, 8, 8, 8}));
  fillResults(*result.trajectory, *result.speeds, ResultTable::ComputedSpeeds, values.data());
  EXPECT_EQ(values, (std::array<double, 6>{0, 0, 3, 3, 5, 5}));
}

} // namespace
