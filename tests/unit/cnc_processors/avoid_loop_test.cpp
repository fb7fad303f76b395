// Paths without loops: by each piece against each, and together with the tool correction.
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "tests/unit/cnc_processors/contours.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <memory>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::contours;
using namespace stride::cnc::test;

Outcome avoid(const std::vector<PathObject> &path, const Rhythm &rhythm = {2000, 2000, 0, 0}) {
  const auto loops = std::make_unique<LoopAvoider>();
  return runPath(*loops, path, rhythm);
}

std::vector<PathObject> correct(const std::vector<PathObject> &path) {
  const auto tool = std::make_unique<ToolCorrection>();
  std::memset(static_cast<void *>(tool.get()), 0, sizeof *tool);
  std::vector<PathObject> result = runPath(*tool, path, {200, 5000, 0, 0}).objects;
  std::erase_if(result, [](const PathObject &o) { return o.moveType == MoveType::Positioning; });
  return result;
}

void mark(std::vector<PathObject> &path) {
  path.front().marks |= kAvoidLoops;
  path.back().marks |= kEndAvoidLoops;
}

void expectWhole(const std::vector<PathObject> &path) {
  EXPECT_LT(greatestGap(path), 1e-9);
  EXPECT_LT(greatestMisfit(path), 1e-8);
}

TEST(CncAvoidLoop, CutsAtTheFirstCrossing) {
  Drawing d;
  d.line(10, 0);
  d.line(10, 8);
  PathObject &m = d.add(MoveType::Function, {10, 8});
  m.switchId[0] = 5;
  d.line(4, 8).switchId[2] = -6;
  PathObject &down = d.line(4, -10);
  down.start.coordinate[kAxisA] = 3;
  down.end.coordinate[kAxisA] = 21;
  d.path[3].end.coordinate[kAxisA] = 3;
  mark(d.path);
  const Outcome run = avoid(d.path);
  ASSERT_EQ(run.stream.phase, StreamPhase::Done);
  ASSERT_EQ(run.objects.size(), 3U);
  expectWhole(run.objects);
  EXPECT_DOUBLE_EQ(endOf(run.objects[0]).x, 4);
  EXPECT_DOUBLE_EQ(run.objects[0].length, 4);
  EXPECT_EQ(run.objects[1].switchId[0], 5); // the function of the loop, at the crossing
  EXPECT_DOUBLE_EQ(startOf(run.objects[1]).x, 4);
  EXPECT_DOUBLE_EQ(startOf(run.objects[2]).y, 0);
  EXPECT_DOUBLE_EQ(run.objects[2].length, 10);
  EXPECT_EQ(run.objects[2].start.coordinate[kAxisA], 0); // goes on from there
  EXPECT_EQ(run.objects[2].end.coordinate[kAxisA], 21);
  EXPECT_EQ(run.objects[2].switchId[0], -6);
  EXPECT_EQ(run.objects[2].marks, kEndAvoidLoops);
}

TEST(CncAvoidLoop, MeasuresWhatClimbsFurtherAfterALoop) {
  Drawing d;
  d.line(10, 0);
  d.line(10, 20);
  d.line(4, 20);
  d.line(4, -8).end.coordinate[kAxisZ] = 6;
  mark(d.path);
  const Outcome run = avoid(d.path);
  ASSERT_EQ(run.objects.size(), 2U);
  EXPECT_EQ(run.objects[1].start.coordinate[kAxisZ], 0);
  EXPECT_DOUBLE_EQ(run.objects[1].length, 10); // 8 along -Y, 6 up
}

TEST(CncAvoidLoop, LeavesWhatIsNotMarkedOrOnlyTouches) {
  Drawing d;
  d.line(10, 0);
  d.line(10, 8);
  d.line(4, 8);
  d.line(4, -10);
  EXPECT_EQ(avoid(d.path).objects.size(), 4U);
  d.path[1].marks = kAvoidLoops;
  EXPECT_EQ(avoid(d.path).objects.size(), 4U);
  d.path[0].marks = kAvoidLoops;
  d.path[2].marks = kEndAvoidLoops;
  EXPECT_EQ(avoid(d.path).objects.size(), 4U);

  Drawing closed;
  closed.here = {-5, -5};
  closed.line(0, 0);
  closed.line(10, 0);
  closed.line(10, 10);
  closed.line(0, 10);
  closed.line(0, 0);
  closed.line(-5, -4); // comes and goes outside
  mark(closed.path);
  EXPECT_EQ(avoid(closed.path).objects.size(), 6U);
  closed.path.back().end.coordinate[kAxisX] = 5; // goes on at the other side of where it came from
  closed.path.back().end.coordinate[kAxisY] = -4;
  EXPECT_EQ(avoid(closed.path).objects.size(), 2U);

  Drawing touching;
  touching.line(20, 0);
  touching.line(20, 5);
  touching.arc({10, 5}, 0 - 90); // down to (10, -5): crosses
  mark(touching.path);
  EXPECT_EQ(avoid(touching.path).objects.size(), 2U);
}

/// Random walks of lines and arcs: nothing crosses any more, and what is left is of the path.
TEST(CncAvoidLoop, LeavesNoCrossing) {
  std::mt19937 random(99);
  std::uniform_real_distribution<double> uniform(0, 1);
  int cut = 0;
  for (int round = 0; round < 60; ++round) {
    Drawing d;
    double heading = 0;
    for (int i = 0; i < 30; ++i) {
      heading += (uniform(random) - 0.5) * 3;
      if (random() % 3 == 0) {
        const double r = 2 + 5 * uniform(random);
        const double turn = (random() % 2 != 0 ? 1 : -1) * (20 + 250 * uniform(random));
        d.arc({d.here.x + r * std::cos(heading), d.here.y + r * std::sin(heading)}, turn);
      } else if (round % 3 == 0 && random() % 3 == 0) {
        const Point from = d.here;
        d.spline({from.x + 8, from.y + 20 * (uniform(random) - 0.5)}, {12, 10}, {12, -8});
      } else {
        const double length = 2 + 12 * uniform(random);
        d.line(d.here.x + length * std::cos(heading), d.here.y + length * std::sin(heading));
      }
    }
    mark(d.path);
    const Outcome run = avoid(d.path);
    ASSERT_EQ(run.stream.phase, StreamPhase::Done);
    expectWhole(run.objects);
    cut += run.objects.size() < d.path.size() ? 1 : 0;
    EXPECT_EQ(crossingsIn(sampled(run.objects, 60)), 0) << round;
    const std::vector<Point> all = sampled(d.path, 200);
    for (const Point &p : sampled(run.objects, 3))
      ASSERT_LT(distanceTo(p, all), 0.01);
    const Outcome other = avoid(d.path, {50, 5, static_cast<uint32_t>(round) + 1, 100000});
    ASSERT_EQ(other.objects.size(), run.objects.size());
    for (size_t i = 0; i < run.objects.size(); ++i)
      EXPECT_LT(gapOf(endOf(other.objects[i]), endOf(run.objects[i])), 1e-12);
  }
  EXPECT_GT(cut, 30);
}

/// A polygon around 0 whose corners point in and out, with a thin slot; from the middle of a side.
Drawing star(std::mt19937 &random, int corners, double deep) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double phi = 2 * M_PI * i / corners;
    const double r = 40 * (i % 2 != 0 ? 1 - deep * uniform(random) : 1.0);
    points.push_back({r * std::cos(phi), r * std::sin(phi)});
  }
  Drawing d;
  d.here = {(points[0].x + points[1].x) / 2, (points[0].y + points[1].y) / 2};
  for (int i = 1; i <= corners; ++i) {
    const Point &p = points[static_cast<size_t>(i % corners)];
    if (i % 3 == 1 && gapOf(d.here, p) > 8) { // a short object before the corner
      d.line(d.here.x + 0.99 * (p.x - d.here.x), d.here.y + 0.99 * (p.y - d.here.y));
    }
    d.line(p.x, p.y);
  }
  d.line((points[0].x + points[1].x) / 2, (points[0].y + points[1].y) / 2);
  return d;
}

/// Distance of the corrected path to the contour, and its area against a count of small squares.
void judge(const Drawing &d, double r, bool outside, bool areas, int round) {
  std::vector<PathObject> path = correct(d.path);
  mark(path);
  const Outcome run = avoid(path);
  ASSERT_EQ(run.stream.phase, StreamPhase::Done);
  expectWhole(run.objects);
  const std::vector<Point> contour = sampled(d.path, 40);
  const std::vector<Point> result = sampled(run.objects, 24);
  EXPECT_EQ(crossingsIn(result), 0) << round;
  std::vector<PathObject> places = run.objects;
  double least = 1e300;
  double most = 0;
  for (const PathObject &o : places)
    for (int i = 0; i <= 8; ++i) {
      const double distance = distanceTo(placeOfObject(o, i / 8.0), contour);
      least = std::min(least, distance);
      most = std::max(most, distance);
    }
  EXPECT_GE(least, r - 1e-3) << round;
  EXPECT_LE(most, r + 1e-3) << round;
  if (!areas)
    return;
  const double step = 0.4;
  double area = 0;
  for (double x = -45; x < 45; x += step)
    for (double y = -45; y < 45; y += step) {
      bool inside = false;
      for (size_t i = 1; i < contour.size(); ++i) {
        const Point &a = contour[i - 1];
        const Point &b = contour[i];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
          inside = !inside;
      }
      const bool isNear = distanceTo({x, y}, contour) < r;
      area += (outside ? inside || isNear : inside && !isNear) ? step * step : 0;
    }
  EXPECT_NEAR(std::fabs(areaOf(result)), area, 0.01 * area) << round;
}

TEST(CncAvoidLoop, MakesCorrectedContoursRight) {
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    Drawing d = star(random, 8 + 2 * (round % 5), 0.4);
    const bool outside = round % 2 != 0;
    const double r = 0.6 + 0.15 * (round % 7);
    for (PathObject &o : d.path)
      o.toolRadius = r;
    d.path.front().marks = outside ? kToolRight : kToolLeft;
    d.path.back().marks = kEndToolCorrection;
    judge(d, r, outside, round % 8 < 2, round);
  }
}

TEST(CncAvoidLoop, LeavesOutSlotsThatAreThinnerThanTheTool) {
  for (const double width : {1.0, 3.9, 4.1}) {
    Drawing d;
    d.radius = 2;
    d.here = {0, 0};
    d.line(20, 0).marks = kToolRight; // the tool is below, the slot goes up
    d.line(20, 15);
    d.line(20 + width, 15);
    d.line(20 + width, 0);
    d.line(50, 0).marks = kEndToolCorrection;
    std::vector<PathObject> path = correct(d.path);
    mark(path);
    const Outcome run = avoid(path);
    const std::vector<Point> result = sampled(run.objects, 30);
    EXPECT_EQ(crossingsIn(result), 0) << width;
    double high = -100;
    for (const Point &p : result)
      high = std::max(high, p.y);
    if (width < 4)
      EXPECT_LT(high, 0) << width;
    else
      EXPECT_NEAR(high, 13, 1e-9);
    for (const Point &p : result)
      EXPECT_GE(distanceTo(p, sampled(d.path, 2)), 2 - 1e-3) << width;
  }
}

/// The way back is the way there.
TEST(CncAvoidLoop, AndToolCorrectionAreSymmetric) {
  std::mt19937 random(11);
  for (int round = 0; round < 10; ++round) {
    Drawing d = star(random, 10, 0.3);
    Drawing back;
    back.here = d.here;
    for (size_t i = d.path.size(); i-- > 0;)
      back.line(startOf(d.path[i]).x, startOf(d.path[i]).y);
    double areas[2];
    for (Drawing *one : {&d, &back}) {
      for (PathObject &o : one->path)
        o.toolRadius = 1.3;
      one->path.front().marks = one == &d ? kToolLeft : kToolRight;
      one->path.back().marks = kEndToolCorrection;
      std::vector<PathObject> path = correct(one->path);
      mark(path);
      areas[one == &d ? 0 : 1] = areaOf(sampled(avoid(path).objects, 50));
    }
    EXPECT_NEAR(areas[0], -areas[1], 1e-6);
  }
}

TEST(CncAvoidLoop, IsQuickWithManyObjects) {
  constexpr int kObjects = 20000;
  Drawing d;
  for (int i = 0; i < kObjects; ++i) { // a spiral of short lines
    const double phi = i * 0.02;
    d.line((10 + 0.05 * phi) * std::cos(phi), (10 + 0.05 * phi) * std::sin(phi));
  }
  mark(d.path);
  const auto begin = std::chrono::steady_clock::now();
  const Outcome run = avoid(d.path, {kObjects + 5, kObjects + 5, 0, 10 * kObjects});
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(run.objects.size(), static_cast<size_t>(kObjects));
  EXPECT_LT(time.count(), 3.0); // of each against each it would be minutes
}

} // namespace
