// SMC_RecomputeABCSlopes, SMC_SmoothAddAxes, SMC_LimitDynamics.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/abc_slopes.hpp"
#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"
#include "runtime/numeric/cnc/processors/smooth_add_axes.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

using Path = std::vector<PathObject>;

constexpr double kDegree = M_PI / 180;

/// Lines along X of these lengths, in which an axis has these values at their ends.
Path withAxis(int axis, const std::vector<double> &lengths, const std::vector<double> &values) {
  Path path;
  double x = 0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    PathObject o = line({x, 1, 2}, {x + lengths[i], 1, 2});
    o.start.axes = o.end.axes = static_cast<uint16_t>(7 | 1 << axis);
    o.start.coordinate[axis] = values[i];
    o.end.coordinate[axis] = values[i + 1];
    path.push_back(o);
    x += lengths[i];
  }
  return path;
}

PathObject functionAt(const PathObject &before) {
  PathObject o = before;
  o.moveType = MoveType::Function;
  o.start = o.end = before.end;
  o.length = 0;
  o.switchId[0] = 7;
  return o;
}

// ---- SMC_RecomputeABCSlopes

Path slopesOf(const Path &path, bool linear = false, double angle = 0.001 * kDegree) {
  AbcSlopes slopes{};
  slopes.angle = angle;
  slopes.linearAtStops = linear;
  return runPath(slopes, path).objects;
}

TEST(AbcSlopes, AreThoseOfTheNeighbours) {
  const Path path = withAxis(kAxisB, {10, 20, 5}, {0, 4, 34, 30});
  const Path out = slopesOf(path);
  ASSERT_EQ(out.size(), 3U);
  const double expected[] = {0, 34.0 / 30, 26.0 / 25, 0};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(out[i].slopes, 2);
    EXPECT_NEAR(out[i].startSlope[1], expected[i], 1e-12);
    EXPECT_NEAR(out[i].endSlope[1], expected[i + 1], 1e-12);
    EXPECT_EQ(out[i].startSlope[0], 0);
    EXPECT_EQ(out[i].end.coordinate[kAxisB], path[i].end.coordinate[kAxisB]);
  }
}

TEST(AbcSlopes, StopsAreZeroOrLinear) {
  Path path = withAxis(kAxisA, {10, 20}, {0, 4, 34});
  path.insert(path.begin() + 1, functionAt(path[0]));
  for (const bool linear : {false, true}) {
    const Path out = slopesOf(path, linear);
    ASSERT_EQ(out.size(), 3U);
    EXPECT_EQ(out[1].moveType, MoveType::Function);
    const double first = linear ? 0.4 : 0;
    const double second = linear ? 1.5 : 0;
    EXPECT_NEAR(out[0].startSlope[0], first, 1e-12);
    EXPECT_NEAR(out[0].endSlope[0], first, 1e-12);
    EXPECT_NEAR(out[2].startSlope[0], second, 1e-12);
    EXPECT_NEAR(out[2].endSlope[0], second, 1e-12);
  }
}

TEST(AbcSlopes, CornersAreStopsAboveTheTolerance) {
  Path path = withAxis(kAxisC, {10, 10}, {0, 5, 25});
  path[1].end.coordinate[1] = 1 + 10 * std::tan(2 * kDegree);
  EXPECT_NEAR(slopesOf(path, false, 2.01 * kDegree)[0].endSlope[2],
              25 / (10 + 10 / std::cos(2 * kDegree)), 1e-12);
  EXPECT_EQ(slopesOf(path, false, 1.99 * kDegree)[0].endSlope[2], 0);
  AbcSlopes bad{};
  bad.angle = -1;
  EXPECT_EQ(runPath(bad, path).stream.error, StreamError::InvalidParameter);
}

TEST(AbcSlopes, AnAxisThatDoesNotMoveYetBeginsAtRest) {
  Path path = withAxis(kAxisA, {10, 10, 10}, {0, 0, 8, 16});
  path[0].start.axes = path[0].end.axes = 7;
  const Path out = slopesOf(path);
  EXPECT_EQ(out[0].slopes, 0);
  EXPECT_EQ(out[1].startSlope[0], 0);
  EXPECT_NEAR(out[1].endSlope[0], 0.8, 1e-12);
}

// ---- SMC_SmoothAddAxes

void smoothBetween(Path &path, int bit, size_t first, size_t last) {
  for (size_t i = first; i <= last; ++i)
    path[i].smoothAxes = static_cast<uint16_t>(path[i].smoothAxes | 1 << bit);
  path[first].smoothAxes = static_cast<uint16_t>(path[first].smoothAxes | 1 << (8 + bit));
}

Outcome smoothed(const Path &path, double part = 0.5, const Rhythm &rhythm = {5, 20, 0, 0}) {
  SmoothAddAxes smooth{};
  smooth.part = part;
  return runPath(smooth, path, rhythm);
}

/// The cubic of an object's slopes.
double valueAt(const PathObject &o, int axis, double way) {
  const double u = way / o.length;
  const int n = axis - kAxisA;
  const double from = o.start.coordinate[axis];
  const double to = o.end.coordinate[axis];
  return from * (1 + 2 * u) * (1 - u) * (1 - u) + to * u * u * (3 - 2 * u) +
         o.length * u * (1 - u) * (o.startSlope[n] * (1 - u) - o.endSlope[n] * u);
}

TEST(SmoothAddAxes, EvenlyOverTheWay) {
  Path path = withAxis(kAxisQ, {10, 20, 5, 15, 8}, {100, 100, 100, 40, 0, 9});
  smoothBetween(path, 4, 1, 3);
  path[2].start.axes = path[2].end.axes = 7;
  path[3].start.sProfile = 1 << kAxisQ;
  const Path out = smoothed(path).objects;
  ASSERT_EQ(out.size(), 5U);
  const double expected[] = {100, 100, 50, 37.5, 0, 9};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(out[i].start.coordinate[kAxisQ], expected[i], 1e-12);
    EXPECT_NEAR(out[i].end.coordinate[kAxisQ], expected[i + 1], 1e-12);
    EXPECT_EQ(out[i].end.axes, 7 | 1 << kAxisQ);
    EXPECT_EQ(out[i].start.sProfile, 0);
    EXPECT_EQ(out[i].slopes, 0);
    EXPECT_EQ(out[i].end.coordinate[0], path[i].end.coordinate[0]);
  }
}

TEST(SmoothAddAxes, AnglesGoByRamps) {
  constexpr double kLength = 100;
  const std::vector<double> lengths(20, kLength / 20);
  std::vector<double> values(21, 0);
  values.back() = -60;
  for (const double part : {0.0, 0.4, 1.0}) {
    Path path = withAxis(kAxisA, lengths, values);
    smoothBetween(path, 0, 0, 19);
    const Path out = smoothed(path, part, {5, 23, 0, 0}).objects;
    ASSERT_EQ(out.size(), 20U);
    // By integrating the slope: ramps of part / 2, exactly in parts that end with objects.
    const double ramp = 0.5 * part * kLength;
    const double steepest = -60 / (kLength - ramp);
    const auto slope = [&](double s) {
      const double near = std::min(s, kLength - s);
      return ramp > 0 && near < ramp ? steepest * near / ramp : steepest;
    };
    double value = 0;
    for (size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(out[i].slopes, 1);
      for (int k = 0; k < 100; ++k) {
        const double way = 0.05 * k;
        EXPECT_NEAR(valueAt(out[i], kAxisA, way), value, 1e-10);
        const double s = 5.0 * static_cast<double>(i) + way;
        value += 0.05 * 0.5 * (slope(s) + slope(s + 0.05));
      }
    }
    EXPECT_EQ(out[19].end.coordinate[kAxisA], -60);
    EXPECT_NEAR(out[0].startSlope[0], slope(0), 1e-12);
  }
}

TEST(SmoothAddAxes, RangesOverlapAndFollowEachOther) {
  Path path = withAxis(kAxisP, {10, 10, 10, 10}, {0, 30, 30, 30, 50});
  for (PathObject &o : path) {
    o.start.axes = o.end.axes = 7 | 1 << kAxisP | 1 << kAxisW;
    o.start.coordinate[kAxisW] = o.start.coordinate[0] * o.start.coordinate[0];
    o.end.coordinate[kAxisW] = o.end.coordinate[0] * o.end.coordinate[0];
  }
  smoothBetween(path, 3, 0, 1);
  smoothBetween(path, 3, 2, 3); // G70 and G71 without a motion between them
  smoothBetween(path, 7, 1, 2);
  const Path out = smoothed(path).objects;
  const double p[] = {0, 15, 30, 40, 50};
  const double w[] = {0, 100, 500, 900, 1600};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(out[i].end.coordinate[kAxisP], p[i + 1], 1e-12);
    EXPECT_NEAR(out[i].start.coordinate[kAxisP], p[i], 1e-12);
    EXPECT_NEAR(out[i].end.coordinate[kAxisW], w[i + 1], 1e-12);
  }
}

TEST(SmoothAddAxes, FunctionsGoAlongAndJumpsEndRanges) {
  Path path = withAxis(kAxisU, {10, 30, 10, 10}, {0, 0, 40, 40, 60});
  smoothBetween(path, 5, 0, 3);
  PathObject function = functionAt(path[0]);
  PathObject jump = functionAt(path[1]);
  jump.moveType = MoveType::Jump;
  function.smoothAxes = jump.smoothAxes = 1 << 5;
  path.insert(path.begin() + 2, jump);
  path.insert(path.begin() + 1, function);
  const Path out = smoothed(path).objects;
  ASSERT_EQ(out.size(), 6U);
  EXPECT_NEAR(out[0].end.coordinate[kAxisU], 10, 1e-12);
  EXPECT_NEAR(out[1].start.coordinate[kAxisU], 10, 1e-12);
  EXPECT_NEAR(out[1].end.coordinate[kAxisU], 10, 1e-12);
  EXPECT_EQ(out[2].end.coordinate[kAxisU], 40);
  EXPECT_EQ(out[3].moveType, MoveType::Jump);
  EXPECT_NEAR(out[4].end.coordinate[kAxisU], 50, 1e-12);
}

TEST(SmoothAddAxes, WhereNothingMovesInSpaceNothingChanges) {
  Path path = withAxis(kAxisV, {0, 0}, {0, 5, 30});
  smoothBetween(path, 6, 0, 1);
  const Path out = smoothed(path).objects;
  EXPECT_EQ(out[0].end.coordinate[kAxisV], 5);
  EXPECT_EQ(out[0].length, 5);
  Path mixed = withAxis(kAxisV, {10, 0, 10}, {0, 0, 30, 40});
  smoothBetween(mixed, 6, 0, 2);
  const Path evenly = smoothed(mixed).objects;
  EXPECT_NEAR(evenly[0].end.coordinate[kAxisV], 20, 1e-12);
  EXPECT_NEAR(evenly[1].end.coordinate[kAxisV], 20, 1e-12);
  EXPECT_EQ(evenly[1].length, 0);
}

TEST(SmoothAddAxes, AnyQueueAndRhythmGivesTheSame) {
  std::vector<double> lengths(60);
  std::vector<double> values(61);
  for (size_t i = 0; i < 60; ++i) {
    lengths[i] = 1 + static_cast<double>(i * 7 % 11);
    values[i + 1] = static_cast<double>(i * i % 17);
  }
  Path path = withAxis(kAxisA, lengths, values);
  smoothBetween(path, 0, 3, 9); // 7 objects: 10 places
  smoothBetween(path, 0, 10, 14);
  smoothBetween(path, 0, 30, 36);
  const Path expected = smoothed(path, 0.3, {50, 70, 0, 0}).objects;
  ASSERT_EQ(expected.size(), 60U);
  for (uint32_t seed = 0; seed < 30; ++seed) {
    const Outcome run = smoothed(path, 0.3, {5 + seed % 3, 10 + seed % 4, seed, 1000000});
    EXPECT_EQ(run.stream.phase, StreamPhase::Done);
    ASSERT_EQ(run.objects.size(), 60U) << seed;
    for (size_t i = 0; i < 60; ++i) {
      EXPECT_EQ(run.objects[i].end.coordinate[kAxisA], expected[i].end.coordinate[kAxisA]);
      EXPECT_EQ(run.objects[i].endSlope[0], expected[i].endSlope[0]);
    }
  }
}

TEST(SmoothAddAxes, TheMemoryHoldsThreeMoreThanARange) {
  const std::vector<double> ones(12, 1);
  std::vector<double> values(13);
  std::iota(values.begin(), values.end(), 0);
  Path path = withAxis(kAxisP, ones, values);
  smoothBetween(path, 3, 2, 8); // 7
  EXPECT_EQ(smoothed(path, 0.5, {5, 10, 0, 0}).stream.phase, StreamPhase::Done);
  const Outcome run = smoothed(path, 0.5, {5, 9, 0, 0});
  EXPECT_EQ(run.stream.error, StreamError::RangeTooLong);
  EXPECT_EQ(run.objects.size(), 2U);
}

TEST(SmoothAddAxes, Refuses) {
  Path path = withAxis(kAxisP, {1, 1, 1}, {0, 1, 2, 3});
  EXPECT_EQ(smoothed(path, -0.01).stream.error, StreamError::SmoothingPart);
  EXPECT_EQ(smoothed(path, 1.01).stream.error, StreamError::SmoothingPart);
  EXPECT_EQ(smoothed(path, std::nan("")).stream.error, StreamError::SmoothingPart);
  path[1].probe = 1;
  EXPECT_EQ(smoothed(path).stream.phase, StreamPhase::Done);
  smoothBetween(path, 0, 1, 1);
  EXPECT_EQ(smoothed(path).stream.error, StreamError::ProbeInRange);
}

TEST(SmoothAddAxes, GivesPlacesBackWhenItIsBegunAnew) {
  Path path = withAxis(kAxisP, {1, 1, 1, 1, 1}, {0, 1, 2, 3, 4, 5});
  smoothBetween(path, 3, 0, 4);
  OwnedQueue input(9);
  OwnedQueue output(9);
  SmoothAddAxes smooth{};
  smooth.part = 0.5;
  StreamState stream{};
  for (int run = 0; run < 3; ++run) {
    startStream(stream, &output.queue, kByNobody, false);
    start(smooth);
    settle(smooth, &output.queue, true);
    (void)clear(&input.queue);
    for (const PathObject &o : path)
      append(&input.queue, &o);
    for (int i = 0; i < 4; ++i)
      stepStream(stream, smooth, &input.queue, &output.queue);
    EXPECT_EQ(smooth.waiting, 4);
    EXPECT_EQ(countOf(&output.queue), 0U);
  }
  settle(smooth, &output.queue, false);
  EXPECT_FALSE(isFull(&output.queue));
  EXPECT_EQ(output.queue.reserved, kReservedPlaces);
}

// ---- SMC_LimitDynamics

PathObject limited(const PathObject &object, int axes, double velocity, double acceleration) {
  LimitDynamics limit{};
  limit.axes = static_cast<uint16_t>(axes);
  limit.velocity = velocity;
  limit.acceleration = acceleration;
  return runPath(limit, {object}).objects.at(0);
}

TEST(LimitDynamics, OfALine) {
  PathObject o = line({0, 0, 0}, {8, 6, 0}); // 20, 100, 300
  PathObject l = limited(o, 1, 4, 0);
  EXPECT_NEAR(l.velocity, 5, 1e-12);
  EXPECT_NEAR(l.velocityEnd, 5, 1e-12);
  EXPECT_EQ(l.acceleration, 100);
  l = limited(o, 2, 0, 30);
  EXPECT_EQ(l.velocity, 20);
  EXPECT_NEAR(l.acceleration, 50, 1e-12);
  EXPECT_NEAR(l.deceleration, 50, 1e-12);
  EXPECT_EQ(limited(o, 4, 1, 1).velocity, 20);
  o.start.axes = o.end.axes = 7 | 1 << kAxisU;
  o.end.coordinate[kAxisU] = 50;
  EXPECT_NEAR(limited(o, 1 << kAxisU, 10, 0).velocity, 2, 1e-12);
}

TEST(LimitDynamics, HoldOnACircle) {
  PathObject o = arc({1, 2, 3}, 5, 20, 250);
  o.acceleration = o.deceleration = 1e6;
  const PathObject l = limited(o, 3, 12, 40);
  EXPECT_LE(l.velocity, 12 * (1 + 1e-9));
  // x = r cos(s / r): |x''| <= v^2 / r * |cos| + a * |sin|
  const double across = l.velocity * l.velocity / 5;
  double most = 0;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * kDegree;
    most = std::max(most, across * std::abs(std::cos(angle)) +
                              l.acceleration * std::abs(std::sin(angle)));
  }
  EXPECT_LE(most, 40 * (1 + 1e-9));
  EXPECT_GT(most, 20);
  EXPECT_GT(l.acceleration, 15);
}

/// A bend much shorter than a 32nd of the curve counts, too.
TEST(LimitDynamics, HoldInASharpBend) {
  for (const double width : {1.0, 0.3, 0.1, 0.03}) {
    // x = 3 (t - 1/2)^2 - 6 (t - 1/2)^3, y = width (t - 1/2): nearly a cusp in the middle.
    PathObject o = object(MoveType::Spline, {1.5, -0.5 * width, 0}, {0, 0.5 * width, 0});
    const double c[8] = {1.5, -7.5, 12, -6, -0.5 * width, width, 0, 0};
    std::copy(std::begin(c), std::end(c), std::begin(o.shape));
    o.acceleration = o.deceleration = 1e6;
    const PathObject l = limited(o, 3, 0, 40);
    double most = 0;
    for (int i = 1; i < 100000; ++i) {
      const double t = i / 1e5;
      const Point d{c[1] + t * (2 * c[2] + t * 3 * c[3]), width, 0};
      const Point dd{2 * c[2] + t * 6 * c[3], 0, 0};
      const double speed = sizeOf(d);
      const Point tangent = d * (1 / speed);
      const Point bend = (dd - tangent * inner(dd, tangent)) * (1 / (speed * speed));
      for (size_t axis = 0; axis < 2; ++axis)
        most = std::max(most, std::abs(bend[axis]) * l.velocity * l.velocity +
                                  std::abs(tangent[axis]) * l.acceleration);
    }
    EXPECT_LE(most, 40 * (1 + 1e-3)) << width;
    EXPECT_GT(most, 20) << width;
  }
}

TEST(LimitDynamics, RefusesWhatIsNoLimit) {
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    LimitDynamics limit{};
    limit.velocity = bad;
    EXPECT_EQ(runPath(limit, {line({0, 0, 0}, {1, 0, 0})}).stream.error,
              StreamError::InvalidParameter);
  }
}

} // namespace
