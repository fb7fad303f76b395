// The path of a tool's centre against distances that are measured on samples.
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "tests/unit/cnc_processors/contours.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::contours;
using namespace stride::cnc::test;

Outcome correct(const std::vector<PathObject> &path, const ToolRules &rules = {},
                const Rhythm &rhythm = {}) {
  const auto tool = std::make_unique<ToolCorrection>();
  std::memset(static_cast<void *>(tool.get()), 0, sizeof *tool);
  tool->rules = rules;
  return runPath(*tool, path, rhythm);
}

/// A closed contour from the middle of its first side, without a corner where it begins.
Drawing rectangle(double width, double height, uint8_t mark, double radius) {
  Drawing d;
  d.radius = radius;
  d.here = {width / 2, -20};
  d.rapid(width / 2, 0);
  d.line(width, 0).marks = mark;
  d.line(width, height);
  d.line(0, height);
  d.line(0, 0);
  d.line(width / 2, 0).marks = kEndToolCorrection;
  d.rapid(width / 2, -20);
  return d;
}

std::vector<PathObject> without(const std::vector<PathObject> &path, MoveType type) {
  std::vector<PathObject> rest;
  for (const PathObject &o : path)
    if (o.moveType != type)
      rest.push_back(o);
  return rest;
}

void expectWhole(const std::vector<PathObject> &path) {
  EXPECT_EQ(greatestGap(path), 0.0);
  EXPECT_LT(greatestMisfit(path), 1e-9);
}

TEST(CncToolCorrection, GoesAroundOutsideCornersOnArcs) {
  // Counterclockwise with the tool on the right: outside.
  const Outcome run = correct(rectangle(40, 30, kToolRight, 3).path);
  ASSERT_EQ(run.stream.phase, StreamPhase::Done);
  expectWhole(run.objects);
  const std::vector<PathObject> &path = run.objects;
  ASSERT_EQ(path.size(), 11U); // two positionings, five lines, four arcs
  EXPECT_EQ(path[0].moveType, MoveType::Positioning);
  EXPECT_DOUBLE_EQ(endOf(path[0]).x, 20);
  EXPECT_DOUBLE_EQ(endOf(path[0]).y, -3);
  EXPECT_DOUBLE_EQ(endOf(path[1]).x, 40);
  EXPECT_EQ(path[2].moveType, MoveType::Counterclockwise);
  EXPECT_DOUBLE_EQ(path[2].shape[0], 40);
  EXPECT_DOUBLE_EQ(path[2].shape[1], 0);
  EXPECT_DOUBLE_EQ(path[2].shape[2], 3);
  EXPECT_NEAR(path[2].length, 3 * M_PI / 2, 1e-12);
  EXPECT_DOUBLE_EQ(startOf(path[10]).y, -3); // leaves from where the shifted path ends
  EXPECT_DOUBLE_EQ(endOf(path[10]).y, -20);
  const double area = areaOf(sampled(without(path, MoveType::Positioning), 4000));
  EXPECT_NEAR(area, 40 * 30 + 2 * 3 * 70 + M_PI * 9, 1e-4);
}

TEST(CncToolCorrection, CutsInsideCorners) {
  const Outcome run = correct(rectangle(40, 30, kToolLeft, 3).path);
  ASSERT_EQ(run.stream.phase, StreamPhase::Done);
  expectWhole(run.objects);
  ASSERT_EQ(run.objects.size(), 7U);
  EXPECT_DOUBLE_EQ(endOf(run.objects[1]).x, 37);
  EXPECT_DOUBLE_EQ(endOf(run.objects[1]).y, 3);
  EXPECT_DOUBLE_EQ(areaOf(sampled(without(run.objects, MoveType::Positioning), 1)), 34 * 24);
}

TEST(CncToolCorrection, AddsTheRadiusOfTheInput) {
  Drawing d = rectangle(40, 30, kToolLeft, 1);
  const Outcome run = correct(d.path, {2.0, 0.0, ToolEntry::Positioning});
  EXPECT_DOUBLE_EQ(areaOf(sampled(without(run.objects, MoveType::Positioning), 1)), 34 * 24);
}

TEST(CncToolCorrection, InsertsPositionings) {
  Drawing d;
  d.radius = 2;
  d.line(10, 0);
  d.line(20, 0).marks = kToolLeft;
  d.line(30, 0).marks = kEndToolCorrection;
  d.line(30, 10);
  const Outcome run = correct(d.path);
  expectWhole(run.objects);
  ASSERT_EQ(run.objects.size(), 6U);
  EXPECT_EQ(run.objects[1].moveType, MoveType::Positioning);
  EXPECT_EQ(run.objects[4].moveType, MoveType::Positioning);
  EXPECT_DOUBLE_EQ(endOf(run.objects[1]).y, 2);
  EXPECT_DOUBLE_EQ(startOf(run.objects[4]).y, 2);
  EXPECT_DOUBLE_EQ(endOf(run.objects[4]).x, 30);
  EXPECT_DOUBLE_EQ(endOf(run.objects[4]).y, 0);
  // At the end of the path, too.
  d.path.pop_back();
  EXPECT_EQ(correct(d.path).objects.back().moveType, MoveType::Positioning);
}

/// The first example of SMC_ToolRadiusCorr's documentation: ramps.
TEST(CncToolCorrection, RampsInAndOut) {
  Drawing d;
  d.radius = 3;
  d.rapid(3, 10).marks = kToolLeft;
  d.line(7, 10);
  d.line(10, 0).marks = kEndToolCorrection;
  d.line(20, 0);
  const Outcome run = correct(d.path, {0.0, 0.0, ToolEntry::Ramp});
  ASSERT_EQ(run.stream.phase, StreamPhase::Done);
  expectWhole(run.objects);
  ASSERT_EQ(run.objects.size(), 5U); // the corner is outside
  EXPECT_DOUBLE_EQ(startOf(run.objects[0]).x, 0);
  EXPECT_DOUBLE_EQ(endOf(run.objects[0]).x, 3);
  EXPECT_DOUBLE_EQ(endOf(run.objects[0]).y, 13);
  EXPECT_EQ(run.objects[2].moveType, MoveType::Clockwise);
  EXPECT_NEAR(distanceToSegment(startOf(run.objects[4]), {7, 10}, {10, 0}), 3, 1e-12);
  EXPECT_DOUBLE_EQ(endOf(run.objects[4]).x, 20);
  EXPECT_DOUBLE_EQ(endOf(run.objects[4]).y, 0);
}

TEST(CncToolCorrection, LetsArcsVanishThatAreBentMoreThanTheTool) {
  for (const double r : {0.5, 1.9, 2.0, 2.1}) {
    Drawing d;
    d.radius = 2;
    d.here = {-20, 0};
    d.line(-r, 0).marks = kToolLeft;
    d.path.back().switchId[1] = 4;
    d.path.back().switchPosition[1] = 0.25;
    PathObject &arc = d.arc({-r, r}, 90);
    arc.switchId[0] = 7;
    arc.switchPosition[0] = 0.5;
    arc.marks = kAvoidLoops;
    d.line(0, 20).marks = kEndToolCorrection;
    const Outcome run = correct(d.path);
    expectWhole(run.objects);
    const bool vanishes = r <= 2;
    ASSERT_EQ(run.objects.size(), vanishes ? 4U : 5U) << r;
    EXPECT_NEAR(endOf(run.objects[1]).x, vanishes ? -2 : -r, 1e-12);
    if (vanishes) {
      EXPECT_EQ(run.objects[1].switchId[0], 7);
      EXPECT_EQ(run.objects[1].switchPosition[0], 1);
      EXPECT_NEAR(run.objects[1].switchPosition[1], 0.25 * (20 - r) / 18, 1e-12);
      EXPECT_EQ(run.objects[2].marks, kAvoidLoops);
    }
  }
}

TEST(CncToolCorrection, TakesWholeCircles) {
  for (const double turn : {360.0, -360.0}) {
    Drawing d;
    d.radius = 2;
    d.here = {10, 0};
    d.arc({0, 0}, turn).marks = kToolLeft | kEndToolCorrection;
    const Outcome run = correct(d.path);
    ASSERT_EQ(run.objects.size(), 3U);
    EXPECT_DOUBLE_EQ(run.objects[1].shape[2], turn > 0 ? 8 : 12);
    EXPECT_NEAR(run.objects[1].length, 2 * M_PI * (turn > 0 ? 8 : 12), 1e-9);
  }
}

/// The shifted circle is a place: its centre.
TEST(CncToolCorrection, GoesToTheCentreOfACircleAsLargeAsTheTool) {
  for (const bool leaves : {true, false}) {
    Drawing d;
    d.radius = 2;
    d.here = {-5, 1};
    d.rapid(2, 0);
    d.arc({0, 0}, 360).marks = kToolLeft | (leaves ? kEndToolCorrection : 0);
    if (leaves)
      d.rapid(30, 7);
    const Outcome run = correct(d.path);
    expectWhole(run.objects);
    ASSERT_EQ(run.objects.size(), leaves ? 3U : 2U);
    EXPECT_NEAR(gapOf(endOf(run.objects[0]), {0, 0}), 0, 1e-12);
    EXPECT_EQ(run.objects[1].length, 0);
    EXPECT_DOUBLE_EQ(endOf(run.objects.back()).x, leaves ? 30 : 0);
  }
}

/// A spindle that is switched on after G41 is the object with the mark.
TEST(CncToolCorrection, BeginsAfterFunctionsThatAreMarked) {
  for (const ToolEntry entry : {ToolEntry::Positioning, ToolEntry::Ramp}) {
    const bool isRamp = entry == ToolEntry::Ramp;
    Drawing d;
    d.radius = 3;
    d.rapid(0, 0);
    d.add(MoveType::Function, {0, 0}).marks = kToolLeft;
    d.add(MoveType::Function, {0, 0});
    if (isRamp)
      d.line(10, 0);
    d.line(20, 0);
    d.line(20, 20).marks = kEndToolCorrection;
    d.rapid(30, 20);
    const Outcome run = correct(d.path, {0.0, 0.0, entry});
    expectWhole(run.objects);
    ASSERT_EQ(run.objects.size(), isRamp ? 7U : 6U);
    EXPECT_DOUBLE_EQ(endOf(run.objects[isRamp ? 3 : 0]).y, 3);
    EXPECT_DOUBLE_EQ(endOf(run.objects[1]).y, isRamp ? 0 : 3); // the function stays at its place
    EXPECT_DOUBLE_EQ(endOf(run.objects[isRamp ? 4 : 3]).x, 17);
    for (const PathObject &o : run.objects)
      EXPECT_EQ(o.marks, 0);
  }
}

/// The contour before ends, and a function between both has the mark of the next.
TEST(CncToolCorrection, BeginsAfterMarkedFunctionsBetweenContours) {
  Drawing d;
  d.radius = 3;
  d.rapid(0, 0);
  d.line(20, 0).marks = kToolLeft | kEndToolCorrection;
  d.add(MoveType::Function, {20, 0}).marks = kToolRight;
  d.rapid(40, 0);
  d.line(60, 0).marks = kEndToolCorrection;
  d.rapid(60, 20);
  const Outcome run = correct(d.path);
  expectWhole(run.objects);
  ASSERT_EQ(run.objects.size(), 6U);
  EXPECT_DOUBLE_EQ(endOf(run.objects[1]).y, 3);
  EXPECT_DOUBLE_EQ(endOf(run.objects[3]).y, -3);
  EXPECT_DOUBLE_EQ(endOf(run.objects[4]).y, -3);
}

/// What ends before anything has moved in the plane does not shift what follows.
TEST(CncToolCorrection, EndsBeforeAnythingIsShifted) {
  for (const bool function : {false, true}) {
    Drawing d;
    d.radius = 3;
    d.rapid(10, 0);
    PathObject &first = function ? d.add(MoveType::Function, {10, 0}) : d.line(10, 0);
    if (!function)
      first.end.coordinate[kAxisZ] = first.length = 5;
    first.marks = kToolLeft | kEndToolCorrection;
    const double z = function ? 0 : 5;
    for (const Point to : {Point{20, 0}, Point{20, 20}}) {
      PathObject &o = d.line(to.x, to.y);
      o.start.coordinate[kAxisZ] = o.end.coordinate[kAxisZ] = z;
    }
    const Outcome run = correct(d.path);
    ASSERT_EQ(run.objects.size(), 4U);
    for (size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(gapOf(endOf(run.objects[i]), endOf(d.path[i])), 0);
      EXPECT_EQ(run.objects[i].marks, 0);
    }
  }
}

TEST(CncToolCorrection, KeepsWhatElseThereIsInItsPlace) {
  Drawing d;
  d.radius = 2;
  d.rapid(0, 0);
  d.line(20, 0).marks = kToolLeft;
  d.add(MoveType::Function, {20, 0}).switchId[0] = 3; // at an inside corner
  PathObject &plunge = d.line(20, 0);
  plunge.end.coordinate[kAxisZ] = -5;
  plunge.length = 5;
  PathObject &up = d.line(20, 20);
  up.start.coordinate[kAxisZ] = up.end.coordinate[kAxisZ] = -5;
  up.end.coordinate[kAxisA] = 9;
  PathObject &m = d.add(MoveType::Function, {20, 20}); // at an outside corner
  m.switchId[0] = 4;
  m.end.coordinate[kAxisA] = m.start.coordinate[kAxisA] = 9;
  PathObject &last = d.line(40, 20);
  last.marks = kEndToolCorrection;
  last.start.coordinate[kAxisA] = last.end.coordinate[kAxisA] = 9;
  last.start.coordinate[kAxisZ] = last.end.coordinate[kAxisZ] = -5;
  const Outcome run = correct(d.path);
  std::vector<int> kinds;
  for (const PathObject &o : run.objects)
    kinds.push_back(static_cast<int>(o.moveType));
  EXPECT_EQ(kinds, (std::vector<int>{100, 1, 120, 1, 1, 120, 2, 1, 100}));
  expectWhole(run.objects);
  EXPECT_DOUBLE_EQ(endOf(run.objects[2]).x, 18);
  EXPECT_DOUBLE_EQ(endOf(run.objects[2]).y, 2);
  EXPECT_DOUBLE_EQ(endOf(run.objects[3]).x, 18);
  EXPECT_DOUBLE_EQ(run.objects[3].length, 5);
  EXPECT_DOUBLE_EQ(run.objects[4].end.coordinate[kAxisA], 9);
  EXPECT_DOUBLE_EQ(run.objects[4].end.coordinate[kAxisZ], -5);
}

TEST(CncToolCorrection, EndsWhereTheRadiusChanges) {
  Drawing d;
  d.radius = 2;
  d.line(10, 0).marks = kToolRight;
  d.radius = 3;
  d.line(20, 0);
  d.line(30, 0).marks = kToolLeft; // begins anew, since the first one has ended
  const Outcome run = correct(d.path);
  ASSERT_EQ(run.stream.phase, StreamPhase::Done);
  expectWhole(run.objects);
  ASSERT_EQ(run.objects.size(), 6U);
  EXPECT_DOUBLE_EQ(endOf(run.objects[1]).y, -2);
  EXPECT_DOUBLE_EQ(endOf(run.objects[3]).y, 0);
  EXPECT_DOUBLE_EQ(endOf(run.objects[5]).y, 3);
}

TEST(CncToolCorrection, ReportsWhatItCannotDo) {
  Drawing bad = rectangle(40, 30, kToolLeft, 3);
  bad.path[2].end.coordinate[kAxisX] = NAN;
  EXPECT_EQ(correct(bad.path).stream.error, StreamError::InvalidObject);
  Drawing negative = rectangle(40, 30, kToolLeft, -3);
  EXPECT_EQ(correct(negative.path).stream.error, StreamError::InvalidParameter);
  Drawing plane;
  plane.radius = 1;
  plane.line(10, 0).marks = kToolLeft;
  PathObject &arc = plane.arc({10, 10}, 90);
  arc.planeX = {0, 0, 1};
  arc.planeY = {1, 0, 0};
  arc.normal = {0, 1, 0};
  arc.end = arc.start;
  EXPECT_NE(correct(plane.path).stream.error, StreamError::None);
  Drawing ramp;
  ramp.radius = 1;
  ramp.here = {10, 0};
  ramp.arc({0, 0}, 90).marks = kToolLeft;
  EXPECT_EQ(correct(ramp.path, {0, 0, ToolEntry::Ramp}).stream.error, StreamError::InvalidObject);
}

/// Lines and arcs that turn little and are long beside the tool, so that nothing crosses.
Drawing smoothContour(std::mt19937 &random, uint8_t mark, double radius) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Drawing d;
  d.radius = radius;
  double heading = 0;
  for (int i = 0; i < 8; ++i) {
    if (random() % 2 != 0) {
      const double length = 8 + 20 * uniform(random);
      d.line(d.here.x + length * std::cos(heading), d.here.y + length * std::sin(heading));
    } else {
      const double r = 6 + 10 * uniform(random);
      const double turn = (random() % 2 != 0 ? 1 : -1) * (50 + 20 * uniform(random));
      const double side = heading + (turn > 0 ? M_PI / 2 : -M_PI / 2);
      d.arc({d.here.x + r * std::cos(side), d.here.y + r * std::sin(side)}, turn);
      heading += turn * M_PI / 180;
    }
    heading += (uniform(random) - 0.5) * 1.2;
  }
  d.path.front().marks = mark;
  d.path.back().marks |= kEndToolCorrection;
  return d;
}

/// Each place of the result is as far from the contour as the tool is thick.
TEST(CncToolCorrection, KeepsItsDistance) {
  std::mt19937 random(20181123);
  int looked = 0;
  for (int round = 0; round < 50; ++round) {
    const double r = 0.3 + 0.1 * (round % 9);
    const Drawing d = smoothContour(random, round % 2 != 0 ? kToolLeft : kToolRight, r);
    const Outcome run = correct(d.path);
    ASSERT_EQ(run.stream.phase, StreamPhase::Done);
    expectWhole(run.objects);
    const std::vector<Point> contour = sampled(d.path, 200);
    if (crossingsIn(contour) != 0)
      continue; // it comes near to itself
    ++looked;
    double least = 1e300;
    double most = 0;
    for (const Point &p : sampled(without(run.objects, MoveType::Positioning), 8)) {
      const double distance = distanceTo(p, contour);
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
    EXPECT_LE(most, r + 1e-3) << round;
    if (least < r - 1e-3)
      --looked; // two parts of the contour are near to each other
  }
  EXPECT_GT(looked, 25);
}

TEST(CncToolCorrection, ShiftsEllipsesAndSplinesWithinTheTolerance) {
  double worst = 0;
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    for (const double r : {0.5, 2.0, -1.0}) {
      Drawing d;
      d.radius = std::fabs(r);
      d.ellipse({0, 0}, 20, 8, -90, 180);
      d.spline({-20, 30}, {-40, 0}, {-10, 30});
      d.path.front().marks = r > 0 ? kToolRight : kToolLeft;
      d.path.back().marks |= kEndToolCorrection;
      const Outcome run = correct(d.path, {0, tolerance, ToolEntry::Positioning});
      ASSERT_EQ(run.stream.phase, StreamPhase::Done);
      expectWhole(run.objects);
      const std::vector<Point> contour = sampled(d.path, 1500);
      double most = 0;
      for (const Point &p : sampled(without(run.objects, MoveType::Positioning), 11))
        most = std::max(most, std::fabs(distanceTo(p, contour) - std::fabs(r)));
      EXPECT_LE(most, tolerance + 1e-5) << tolerance << ' ' << r;
      if (tolerance == 1e-3)
        worst = std::max(worst, most);
    }
  }
  EXPECT_LE(worst, 1e-3);
}

/// Of a curve by a quarter turn to (0, 0), and a line that turns away by some degrees.
Outcome cornerOfCurve(MoveType type, double turn, double radius) {
  Drawing d;
  d.radius = radius;
  d.here = {-18, 18};
  if (type == MoveType::Spline)
    d.spline({0, 0}, {0, -30}, {30, 0});
  else
    d.ellipse({0, 18}, 18, 12, 180, 90);
  const Point corner = d.here;
  const double phi = turn * M_PI / 180;
  d.line(corner.x + 20 * std::cos(phi), corner.y - 20 * std::sin(phi));
  d.path.front().marks = kToolRight;
  d.path.back().marks = kEndToolCorrection;
  return correct(d.path);
}

/// Curves that meet at a small angle are cut as others are: there was a line back from the end of
/// the one to the start of the other, at which the path stopped twice.
TEST(CncToolCorrection, CutsInsideCornersOfCurvesThatTurnLittle) {
  for (const MoveType type : {MoveType::Spline, MoveType::EllipseCounterclockwise})
    for (const double radius : {0.7, 5.0})
      for (double turn = 1e-5; turn < 20; turn *= 2) {
        const std::vector<PathObject> path =
            without(cornerOfCurve(type, turn, radius).objects, MoveType::Positioning);
        expectWhole(path);
        for (const PathObject &o : path)
          EXPECT_GT(gapOf(startOf(o), endOf(o)), 0.1) << turn << " " << radius;
        const double last = gapOf(startOf(path.back()), endOf(path.back()));
        EXPECT_NEAR(last, 20 - radius * std::tan(turn * M_PI / 360), radius * turn * 1e-3) << turn;
      }
}

TEST(CncToolCorrection, IsTheSameInAnyRhythm) {
  std::mt19937 random(7);
  for (uint32_t round = 0; round < 20; ++round) {
    Drawing d = smoothContour(random, kToolLeft, 3); // with arcs that vanish
    d.ellipse({0, 0}, 20, 8, -90, 180).marks = kToolRight;
    std::vector<PathObject> path = d.path;
    for (size_t i = 1; i < 6; i += 2) {
      PathObject m = path[i];
      m.moveType = MoveType::Function;
      m.end = m.start = path[i].start;
      m.marks = 0;
      path.insert(path.begin() + static_cast<ptrdiff_t>(i), m);
    }
    const std::vector<PathObject> once = correct(path, {}, {200, 500, 0, 0}).objects;
    for (uint32_t seed = 1; seed < 6; ++seed) {
      const Outcome run = correct(path, {}, {5 + seed, 5 + seed % 3, seed, 100000});
      ASSERT_EQ(run.objects.size(), once.size());
      EXPECT_EQ(std::memcmp(run.objects.data(), once.data(), once.size() * sizeof(PathObject)), 0);
    }
  }
}

} // namespace
