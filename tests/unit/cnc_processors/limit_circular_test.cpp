// Velocities of arcs and of transitions to and from them.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/limit_circular.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

std::vector<PathObject> run(LimitCircular limit, const std::vector<PathObject> &path) {
  return runPath(limit, path, {5, 5, 2, 0}).objects;
}

LimitCircular limits(double acceleration, double jump, double perRadius) {
  LimitCircular limit{};
  limit.acceleration = acceleration;
  limit.jump = jump;
  limit.perRadius = perRadius;
  return limit;
}

/// A line, an arc to the left of radius 4, one to the right of radius 2, a line.
std::vector<PathObject> path() {
  std::vector<PathObject> all{line({-10, 0, 0}, {0, 0, 0}), arc({0, 4, 0}, 4, -90, 90),
                              arc({6, 4, 0}, 2, 180, -90), line({6, 6, 0}, {16, 6, 0})};
  for (PathObject &o : all)
    o.velocity = o.velocityEnd = 1000;
  return all;
}

TEST(LimitCircular, ZeroLimitsNothing) {
  for (const PathObject &o : run(limits(0, 0, 0), path())) {
    EXPECT_EQ(o.velocity, 1000);
    EXPECT_EQ(o.velocityEnd, 1000);
  }
}

TEST(LimitCircular, AccelerationOnTheArc) {
  // The manual's example: 200 and 50 give 100.
  std::vector<PathObject> one{arc({0, 0, 0}, 50, 0, 90)};
  one[0].velocity = one[0].velocityEnd = 1000;
  EXPECT_NEAR(run(limits(200, 0, 0), one)[0].velocity, 100, 1e-9);
  const auto all = run(limits(100, 0, 0), path());
  EXPECT_EQ(all[0].velocity, 1000);
  EXPECT_NEAR(all[0].velocityEnd, 20, 1e-9);
  EXPECT_NEAR(all[1].velocity, 20, 1e-9);
  EXPECT_NEAR(all[1].velocityEnd, std::sqrt(200), 1e-9);
  EXPECT_NEAR(all[2].velocity, std::sqrt(200), 1e-9);
  EXPECT_NEAR(all[2].velocityEnd, std::sqrt(200), 1e-9);
  EXPECT_EQ(all[3].velocity, 1000);
}

TEST(LimitCircular, JumpsOfTheAcceleration) {
  const auto all = run(limits(0, 90, 0), path());
  EXPECT_NEAR(all[0].velocityEnd, std::sqrt(90 * 4.0), 1e-9);
  EXPECT_NEAR(all[1].velocityEnd, std::sqrt(90 / (1.0 / 4 + 1.0 / 2)), 1e-9); // to the other side
  EXPECT_NEAR(all[2].velocityEnd, std::sqrt(90 * 2.0), 1e-9);
  EXPECT_EQ(all[3].velocityEnd, 1000);
  for (const PathObject &o : all)
    EXPECT_EQ(o.velocity, 1000);
  // To the same side only the difference counts.
  std::vector<PathObject> same{arc({0, 4, 0}, 4, -90, 90), arc({2, 4, 0}, 2, 0, 90)};
  same[0].velocityEnd = 1000;
  EXPECT_NEAR(run(limits(0, 90, 0), same)[0].velocityEnd, std::sqrt(90 * 4.0), 1e-9);
}

TEST(LimitCircular, VelocityOverTheRadius) {
  const auto all = run(limits(0, 0, 5), path());
  EXPECT_NEAR(all[1].velocity, 20, 1e-9);
  EXPECT_NEAR(all[2].velocity, 10, 1e-9);
}

TEST(LimitCircular, OnlyLowers) {
  std::vector<PathObject> slow = path();
  for (PathObject &o : slow) {
    o.velocity = 3;
    o.velocityEnd = 1;
  }
  for (const PathObject &o : run(limits(100, 90, 5), slow)) {
    EXPECT_EQ(o.velocity, 3);
    EXPECT_EQ(o.velocityEnd, 1);
  }
}

TEST(LimitCircular, AHelixTurnsLess) {
  PathObject helix = arc({0, 0, 0}, 4, 0, 90);
  const double slope = 4 * M_PI / 2;
  helix.end.coordinate[2] = slope; // as much up as around
  helix.velocity = 1000;
  EXPECT_NEAR(run(limits(100, 0, 0), {helix})[0].velocity, std::sqrt(100 * 8.0), 1e-6);
}

TEST(LimitCircular, SplinesAreNoArcs) {
  PathObject spline = object(MoveType::Spline, {0, 0, 0}, {1, 1, 0});
  spline.shape[1] = 1;
  spline.shape[6] = 1;
  const auto all = run(limits(1, 1, 1), {spline, arc({1, 5, 0}, 4, -90, 90)});
  EXPECT_EQ(all[0].velocity, 20);
  EXPECT_NEAR(all[0].velocityEnd, 2, 1e-9); // that of the arc, no jump
}

TEST(LimitCircular, NegativeLimitsAreErrors) {
  const auto error = [](LimitCircular limit) { return runPath(limit, path()).stream.error; };
  EXPECT_EQ(error(limits(-1, 0, 0)), StreamError::InvalidParameter);
  EXPECT_EQ(error(limits(0, std::nan(""), 0)), StreamError::InvalidParameter);
  EXPECT_EQ(error(limits(0, 0, -1)), StreamError::InvalidParameter);
}

} // namespace
