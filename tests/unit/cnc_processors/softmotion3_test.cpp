// SMC_ObjectSplitter, SMC_ExtendedVelocityChecks, SMC_SmoothMerge.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/axis_limits.hpp"
#include "runtime/numeric/cnc/processors/merge_path.hpp"
#include "runtime/numeric/cnc/processors/object_splitter.hpp"

#include <gtest/gtest.h>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

using Path = std::vector<PathObject>;

ObjectSplitter splitter(double parameter, bool byLength) {
  ObjectSplitter s{};
  s.parameter = parameter;
  s.byLength = byLength;
  return s;
}

TEST(ObjectSplitter, CutsCurvesIntoEqualParts) {
  PathObject round = arc({3, -1, 2}, 2.5, 30, 200);
  round.start.axes = round.end.axes = 7 | 1 << kAxisP;
  round.end.coordinate[kAxisP] = 10;
  round.switchId[0] = 4;
  round.switchPosition[0] = 0.55;
  round.velocityEnd = 7;
  const Path path{line({0, 0, 0}, startOf(round)), round};
  ObjectSplitter s = splitter(5, false);
  const Outcome run = runPath(s, path, {5, 5, 3, 0});
  ASSERT_EQ(run.objects.size(), 6U);
  for (size_t i = 1; i < 6; ++i) {
    const PathObject &o = run.objects[i];
    EXPECT_NEAR(o.length, round.length / 5, 1e-12);
    EXPECT_EQ(startOf(o), endOf(run.objects[i - 1]));
    EXPECT_LT(sizeOf(placeAt(o, 0.5) - placeAt(round, (static_cast<double>(i) - 0.5) / 5)), 1e-12);
    EXPECT_NEAR(o.end.coordinate[kAxisP], 2.0 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(o.switchId[0], i == 3 ? 4 : 0);
    EXPECT_EQ(o.velocityEnd, i == 5 ? 7 : 20);
  }
  EXPECT_NEAR(run.objects[3].switchPosition[0], 0.75, 1e-12);
}

TEST(ObjectSplitter, ByLengthNoPartIsLonger) {
  const PathObject round = arc({0, 0, 0}, 2, 0, 90); // length pi
  const auto parts = [&](double length) {
    ObjectSplitter s = splitter(length, true);
    const Path objects = runPath(s, {round}).objects;
    for (const PathObject &o : objects)
      EXPECT_LE(o.length, length * (1 + 1e-12));
    return objects.size();
  };
  EXPECT_EQ(parts(4), 1U);
  EXPECT_EQ(parts(3), 2U);
  EXPECT_EQ(parts(1), 4U);
  EXPECT_EQ(parts(0.1), 32U);
}

TEST(ObjectSplitter, LinesStayAndBadParametersAreErrors) {
  const auto run = [](double parameter, bool byLength) {
    ObjectSplitter s = splitter(parameter, byLength);
    return runPath(s, {line({0, 0, 0}, {9, 0, 0}), arc({9, 1, 0}, 1, -90, 90)});
  };
  EXPECT_EQ(run(3, false).objects.size(), 4U);
  EXPECT_EQ(run(0.5, false).objects.size(), 2U);
  EXPECT_EQ(run(0, true).stream.error, StreamError::InvalidParameter);
  EXPECT_EQ(run(-1, false).stream.error, StreamError::InvalidParameter);
  EXPECT_EQ(run(std::nan(""), false).stream.error, StreamError::InvalidParameter);
}

PathObject withAxis(int axis, double way) {
  PathObject o = line({0, 0, 0}, {8, 6, 0});
  o.start.axes = o.end.axes = static_cast<uint16_t>(7 | 1 << axis);
  o.end.coordinate[axis] = way;
  return o;
}

TEST(AxisLimits, BecomeLimitsOfThePath) {
  PathObject o = withAxis(kAxisP, -40); // four times the way
  o.limits[kAxisP - kAxisZ] = {10, 12, 0};
  limitByAxes(o);
  EXPECT_NEAR(o.velocity, 2.5, 1e-12);
  EXPECT_NEAR(o.velocityEnd, 2.5, 1e-12);
  EXPECT_NEAR(o.acceleration, 3, 1e-12);
  EXPECT_EQ(o.deceleration, 300);
  PathObject slow = withAxis(kAxisP, 1);
  slow.limits[kAxisP - kAxisZ] = {10, 12, 20};
  limitByAxes(slow);
  EXPECT_EQ(slow.velocity, 20);
  EXPECT_EQ(slow.acceleration, 100);
  EXPECT_NEAR(slow.deceleration, 200, 1e-12);
}

TEST(AxisLimits, OfZOnlyInThePlane) {
  PathObject o = line({0, 0, 0}, {8, 6, 40});
  o.limits[0] = {10, 0, 0};
  limitByAxes(o);
  EXPECT_EQ(o.velocity, 20);
  o.planar = 1;
  limitByAxes(o);
  EXPECT_NEAR(o.velocity, 2.5, 1e-12);
}

TEST(AxisLimits, HoldOnAnSProfile) {
  PathObject o = withAxis(kAxisQ, 40);
  o.start.sProfile = o.end.sProfile = 1 << kAxisQ;
  o.acceleration = o.deceleration = 1000;
  o.limits[kAxisQ - kAxisZ] = {10, 12, 15};
  limitByAxes(o);
  // q(s) = 40 * S(s / 10): its velocity and acceleration with any v, a within the new limits.
  for (int i = 0; i <= 1000; ++i) {
    const double u = i / 1000.0;
    const double d1 = 4 * (30 * u * u - 60 * u * u * u + 30 * u * u * u * u);
    const double d2 = 0.4 * (60 * u - 180 * u * u + 120 * u * u * u);
    const double v = o.velocity;
    EXPECT_LE(d1 * v, 10 * (1 + 1e-12));
    EXPECT_LE(std::abs(d2) * v * v + d1 * o.acceleration, 12 * (1 + 1e-12));
    EXPECT_LE(std::abs(d2) * v * v + d1 * o.deceleration, 15 * (1 + 1e-12));
  }
}

TEST(AxisLimits, HoldOnSlopes) {
  for (const double last : {0.0, 2.0, -3.0}) {
    PathObject o = withAxis(kAxisB, 40);
    o.slopes = 2;
    o.startSlope[1] = 1;
    o.endSlope[1] = last;
    o.acceleration = o.deceleration = 1000;
    o.limits[kAxisB - kAxisZ] = {10, 12, 15};
    limitByAxes(o);
    double most = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double u = i / 1000.0;
      const double d1 = 4 * 6 * u * (1 - u) + 1 - 4 * u + 3 * u * u + last * (3 * u * u - 2 * u);
      const double d2 = (4 * (6 - 12 * u) - 4 + 6 * u + last * (6 * u - 2)) / 10;
      const double v = o.velocity;
      EXPECT_LE(std::abs(d1) * v, 10 * (1 + 1e-12));
      EXPECT_LE(std::abs(d2) * v * v + std::abs(d1) * o.acceleration, 12 * (1 + 1e-12));
      EXPECT_LE(std::abs(d2) * v * v + std::abs(d1) * o.deceleration, 15 * (1 + 1e-12));
      most = std::max(most, std::abs(d1) * o.acceleration);
    }
    EXPECT_GT(most, 5.9); // half of the acceleration is for the way
  }
}

/// A circle of short lines, whose places have four digits.
Path polygon(int count) {
  Path path;
  const auto at = [count](int i) {
    const double angle = 2 * M_PI * i / count;
    return Point{std::round(50e4 * std::cos(angle)) / 1e4, std::round(50e4 * std::sin(angle)) / 1e4,
                 0};
  };
  for (int i = 0; i < count; ++i)
    path.push_back(line(at(i), at(i + 1)));
  return path;
}

double distance(const PathObject &o, const Point &p) {
  const Point way = endOf(o) - startOf(o);
  const double part = inner(p - startOf(o), way) / inner(way, way);
  return sizeOf(p - startOf(o) - way * std::min(1.0, std::max(0.0, part)));
}

TEST(MergePath, FewerLinesWithinTheTolerance) {
  const Path path = polygon(2000);
  MergePath merge{};
  merge.tolerance = 0.01;
  const Path objects = runPath(merge, path, {7, 9, 5, 1000000}).objects;
  EXPECT_LT(objects.size(), 200U);
  for (size_t i = 1; i < objects.size(); ++i)
    EXPECT_EQ(startOf(objects[i]), endOf(objects[i - 1]));
  for (const PathObject &o : path) {
    double best = 1e300;
    for (const PathObject &m : objects)
      best = std::min(best, distance(m, endOf(o)));
    EXPECT_LE(best, 0.01 * (1 + 1e-9));
  }
}

TEST(MergePath, OnlyWhereTheFeatureIsOn) {
  Path path = polygon(2000);
  path.resize(30);
  for (size_t i = 10; i < 20; ++i)
    path[i].features = 1U << 3;
  MergePath merge{};
  merge.tolerance = 0.5;
  merge.features = 1U << 3;
  EXPECT_EQ(runPath(merge, path).objects.size(), 21U);
  merge.features = 0;
  EXPECT_EQ(runPath(merge, path).objects.size(), 3U); // other features are not merged with them
  merge.tolerance = -1;
  EXPECT_EQ(runPath(merge, path).stream.error, StreamError::InvalidParameter);
}

} // namespace
