// Cams with fewer places, and tables of cams.
#include "runtime/numeric/cam/reduce.hpp"

#include "tests/support/random.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace stride::cam;
using stride::test::Random;

namespace {

Curve curveOf(const std::vector<Node> &nodes) {
  Curve curve;
  curve.form = Form::Nodes;
  curve.start = nodes.front().x;
  curve.end = nodes.back().x;
  curve.count = static_cast<int32_t>(nodes.size());
  curve.data = nodes.data();
  return curve;
}

Curve curveOf(const std::vector<XY> &pairs, bool cubic) {
  Curve curve;
  curve.form = Form::PairTable;
  curve.element = Element::Lreal;
  curve.cubic = cubic;
  curve.start = pairs.front().x;
  curve.end = pairs.back().x;
  curve.count = static_cast<int32_t>(pairs.size());
  curve.data = pairs.data();
  return curve;
}

double at(const Curve &curve, double x) {
  uint32_t index = 0;
  return evaluateCurve(curve, x, false, index).y;
}

double farthest(const Curve &a, const Curve &b) {
  double distance = 0.0;
  for (int i = 0; i <= 20000; ++i) {
    const double x = a.start + (a.end - a.start) * i / 20000;
    distance = std::fmax(distance, std::fabs(at(a, x) - at(b, x)));
  }
  return distance;
}

/// Every subset, to see that none is smaller.
size_t fewestByTrying(const std::vector<XY> &points, double tolerance) {
  const size_t inner = points.size() - 2;
  size_t best = points.size();
  for (unsigned mask = 0; mask < (1U << inner); ++mask) {
    std::vector<XY> kept{points.front()};
    for (size_t i = 0; i < inner; ++i)
      if ((mask >> i) & 1U)
        kept.push_back(points[i + 1]);
    kept.push_back(points.back());
    const bool good = std::all_of(points.begin(), points.end(), [&](const XY &point) {
      return std::fabs(at(curveOf(kept, false), point.x) - point.y) <= tolerance;
    });
    if (good)
      best = std::min(best, kept.size());
  }
  return best;
}

std::vector<Node> defaultCam() {
  return {{0, 0, 0, 0}, {120, 120, 1, 0}, {240, 240, 1, 0}, {360, 360, 0, 0}};
}

} // namespace

TEST(ReducePoints, KeepsTheFewestWithinTheTolerance) {
  Random random(1);
  size_t fewer = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<XY> points;
    double y = 0.0;
    for (int k = 0; k < 10; ++k)
      points.push_back({k + random.uniform(-0.3, 0.3), y += random.uniform(-1, 1)});
    const double tolerance = random.uniform(0.1, 1.0);
    const std::vector<XY> kept = reducePoints(points, tolerance);
    EXPECT_EQ(kept.front().x, points.front().x);
    EXPECT_EQ(kept.back().x, points.back().x);
    for (const XY &point : points)
      EXPECT_LE(std::fabs(at(curveOf(kept, false), point.x) - point.y), tolerance * (1 + 1e-12));
    EXPECT_EQ(kept.size(), fewestByTrying(points, tolerance));
    fewer += kept.size() < points.size() ? 1 : 0;
  }
  EXPECT_GT(fewer, 30U);
}

TEST(ReducePoints, KeepsTheCornersOfStraightLines) {
  std::vector<XY> points;
  for (int i = 0; i <= 3000; ++i)
    points.push_back({i / 8.0, i < 1000 ? i / 4.0 : 250.0});
  const std::vector<XY> kept = reducePoints(points, 1e-9);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[1].x, 125.0);
  EXPECT_EQ(kept[1].y, 250.0);
  EXPECT_EQ(reducePoints({}, 1.0).size(), 0U);
  EXPECT_EQ(reducePoints(std::vector<XY>{{0, 1}, {2, 3}}, 1.0).size(), 2U);
}

TEST(ReduceCurve, FindsTheQuinticsThatWereCutIntoPieces) {
  // The default cam, each third of it cut into 50.
  const std::vector<Node> made = defaultCam();
  std::vector<Node> many;
  for (int i = 0; i <= 150; ++i) {
    const double x = 360.0 * i / 150;
    uint32_t index = 0;
    const Point point = evaluateCurve(curveOf(made), x, false, index);
    many.push_back({x, point.y, point.v, point.a});
  }
  const std::vector<Node> few = reduceCurve(curveOf(many), false, 1e-9);
  ASSERT_EQ(few.size(), 4U);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(few[i].x, made[i].x, 1e-9);
    EXPECT_NEAR(few[i].y, made[i].y, 1e-9);
    EXPECT_NEAR(few[i].v, made[i].v, 1e-9);
  }
}

TEST(ReduceCurve, StaysWithinTheTolerance) {
  // A sampled sine, cubic in between, as an imported table is.
  std::vector<XY> points;
  for (int i = 0; i <= 1000; ++i)
    points.push_back({i * 0.36, 100 * std::sin(i * 0.002 * M_PI)});
  const Curve table = curveOf(points, true);
  size_t before = 2;
  for (const double tolerance : {1.0, 1e-2, 1e-4}) {
    const std::vector<Node> few = reduceCurve(table, false, tolerance);
    ASSERT_FALSE(few.empty());
    EXPECT_LE(farthest(table, curveOf(few)), tolerance);
    EXPECT_LT(few.size(), 40U);
    EXPECT_GT(few.size(), before);
    EXPECT_EQ(few.front().x, 0.0);
    EXPECT_EQ(few.back().x, 360.0);
    EXPECT_EQ(few.back().y, points.back().y);
    before = few.size();
  }
}

TEST(ReduceCurve, DividesLawsAndGivesUpAtJumps) {
  const Segment law = makeSegment({Law::ModifiedTrapezoid}, {0, 0, 0, 0}, {100, 50, 0, 0});
  Curve curve;
  curve.form = Form::Segments;
  curve.start = 0;
  curve.end = 100;
  curve.count = 1;
  curve.data = &law;
  const std::vector<Node> few = reduceCurve(curve, false, 1e-3);
  ASSERT_GT(few.size(), 2U);
  EXPECT_LT(few.size(), 20U);
  EXPECT_LE(farthest(curve, curveOf(few)), 1e-3);
  EXPECT_TRUE(reduceCurve(curve, false, 1e-9, 5).empty());
  Segment jump[2] = {law, makeSegment({}, {100, 60, 0, 0}, {200, 0, 0, 0})};
  curve.count = 2;
  curve.end = 200;
  curve.data = jump;
  EXPECT_TRUE(reduceCurve(curve, false, 1e-3).empty());
}

TEST(SampleEven, HasTheEndsOrLeavesOutTheLast) {
  const std::vector<Node> nodes = defaultCam();
  const std::vector<double> closed = sampleEven(curveOf(nodes), true, 4, false);
  ASSERT_EQ(closed.size(), 4U);
  EXPECT_EQ(closed[0], 0.0);
  EXPECT_NEAR(closed[1], 120.0, 1e-12);
  EXPECT_NEAR(closed[2], 240.0, 1e-12);
  EXPECT_NEAR(closed[3], 360.0, 1e-12);
  const std::vector<double> open = sampleEven(curveOf(nodes), true, 6, true);
  ASSERT_EQ(open.size(), 6U);
  EXPECT_EQ(open[0], 0.0);
  EXPECT_NEAR(open[3], 180.0, 1e-12);
  EXPECT_NEAR(open[5], at(curveOf(nodes), 300), 1e-12);
}

TEST(SampleElements, GivesLinesTheirEndsAndSharesOutTheRest) {
  // A line from 120 to 240, curves on both sides.
  const std::vector<Node> nodes = defaultCam();
  const Curve curve = curveOf(nodes);
  EXPECT_EQ(leastElements(curve), 4);
  EXPECT_TRUE(sampleElements(curve, false, 3).empty());
  const std::vector<XY> pairs = sampleElements(curve, false, 12);
  ASSERT_EQ(pairs.size(), 12U);
  EXPECT_EQ(pairs.front().x, 0.0);
  EXPECT_EQ(pairs.back().x, 360.0);
  int inLine = 0;
  double widest = 0.0;
  double narrowest = 360.0;
  for (size_t i = 1; i < pairs.size(); ++i) {
    const double way = pairs[i].x - pairs[i - 1].x;
    EXPECT_NEAR(pairs[i].y, at(curve, pairs[i].x), 1e-12);
    if (pairs[i].x > 120 && pairs[i].x < 240)
      ++inLine;
    if (pairs[i - 1].x == 120) {
      EXPECT_EQ(pairs[i].x, 240.0);
      continue;
    }
    widest = std::fmax(widest, way);
    narrowest = std::fmin(narrowest, way);
  }
  EXPECT_EQ(inLine, 0);
  EXPECT_NEAR(widest, 24.0, 1e-9);
  EXPECT_NEAR(narrowest, 24.0, 1e-9);
}

TEST(SampleElements, OfNothingButLinesFillsTheTableAnyway) {
  const std::vector<XY> corners{{0, 0}, {100, 50}, {200, 50}};
  const std::vector<XY> pairs = sampleElements(curveOf(corners, false), false, 9);
  ASSERT_EQ(pairs.size(), 9U);
  for (size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(pairs[i].x, 25.0 * static_cast<double>(i), 1e-12);
}
