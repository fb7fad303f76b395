// Objects of no meaning: a processor ends, with an error or without, and puts out no more than a
// step may; what it holds stays within its memory (the sanitizers look).
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/limit_check.hpp"
#include "runtime/numeric/cnc/processors/abc_slopes.hpp"
#include "runtime/numeric/cnc/processors/axis_limits.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"
#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"
#include "runtime/numeric/cnc/processors/merge_path.hpp"
#include "runtime/numeric/cnc/processors/object_splitter.hpp"
#include "runtime/numeric/cnc/processors/smooth_add_axes.hpp"
#include "runtime/numeric/cnc/processors/smooth_bspline.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

/// Mostly a path, with numbers in it that are none.
std::vector<PathObject> garbage(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] {
    constexpr double kOdd[] = {0.0,
                               -0.0,
                               1e300,
                               -1e-300,
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()};
    return random() % 12 == 0 ? kOdd[random() % 6]
                              : static_cast<double>(random() % 2000) / 100.0 - 10.0;
  };
  std::vector<PathObject> path;
  Point here{0, 0, 0};
  for (int i = 0; i < 40; ++i) {
    constexpr int kTypes[] = {1, 1, 1, 2, 3, 5, 8, 9, 11, 100, 110, 120, 0, 77, -1};
    const Point to{number(), number(), random() % 2 == 0 ? here[2] : number()};
    PathObject o = object(static_cast<MoveType>(kTypes[random() % 15]), here, to);
    for (double &value : o.shape)
      value = number();
    for (double &value : o.moreShape)
      value = number();
    for (double &value : o.parameterRange)
      value = 30 * number();
    for (int k = 0; k <= kMostSwitches; ++k) {
      o.switchId[k] = static_cast<int16_t>(random() % 5 - 2);
      o.switchPosition[k] = number();
    }
    o.marks = static_cast<uint8_t>(random());
    o.velocity = number();
    o.toolRadius = o.cornerDistance = random() % 2 == 0 ? 0.5 : number();
    o.planar = random() % 2;
    o.length = number();
    o.start.sProfile = static_cast<uint16_t>(random() % 3 == 0 ? random() : 0);
    o.features = static_cast<uint32_t>(random() % 3);
    o.slopes = static_cast<uint8_t>(random() % 4 == 0 ? random() : 0);
    for (int k = 0; k < 3; ++k) {
      o.startSlope[k] = number();
      o.endSlope[k] = number();
      o.start.coordinate[kAxisA + k] = number();
      o.end.coordinate[kAxisA + k] = number();
    }
    o.start.axes = o.end.axes = static_cast<uint16_t>(random() % 2 == 0 ? 7 : random());
    o.smoothAxes = static_cast<uint16_t>(random() % 3 == 0 ? random() & random() & random() : 0);
    o.probe = random() % 40 == 0;
    if (random() % 8 == 0)
      o.planeX = {number(), number(), number()};
    path.push_back(o);
    here = random() % 5 == 0 ? Point{number(), number(), number()} : to;
  }
  return path;
}

template <class Processor> void expectAnEnd(Processor processor) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Outcome run = runPath(processor, garbage(seed), {6, 7, seed, 2000000});
    EXPECT_TRUE(run.ended) << seed;
    EXPECT_LE(run.most, kMostPerStep) << seed;
  }
}

TEST(Garbage, Corners) {
  for (const PieceKind kind : {PieceKind::Cubic, PieceKind::Quintic, PieceKind::Arc}) {
    SmoothPath smooth{};
    smooth.distance = 0.5;
    smooth.kind = kind;
    smooth.passesFunctions = kind == PieceKind::Cubic;
    expectAnEnd(smooth);
    RoundPath round{};
    round.kind = kind;
    round.rule = DistanceRule::CornerDistanceAdded;
    expectAnEnd(round);
  }
}

TEST(Garbage, Velocities) {
  LimitCircular limit{};
  limit.acceleration = limit.jump = limit.perRadius = 3;
  expectAnEnd(limit);
  expectAnEnd(LimitByAxes{});
}

TEST(Garbage, Others) {
  RotatePath rotate{};
  rotate.wanted = {TransformKind::Rotate, {30, 0, 0}};
  expectAnEnd(rotate);
  ScalePath scale{};
  scale.wanted = {TransformKind::Scale, {-2, 0, 0}};
  expectAnEnd(scale);
  MergePath merge{};
  merge.tolerance = 0.1;
  merge.features = 1;
  expectAnEnd(merge);
  ObjectSplitter splitter{};
  splitter.parameter = 3;
  splitter.byLength = false;
  expectAnEnd(splitter);
}

TEST(Garbage, Axes) {
  expectAnEnd(AbcSlopes{});
  SmoothAddAxes smooth{};
  smooth.part = 0.5;
  for (unsigned seed = 0; seed < 40; ++seed)
    EXPECT_TRUE(runPath(smooth, garbage(seed), {6, 7 + seed % 5, seed, 20000}).ended) << seed;
  for (const KnotSpacing spacing : {KnotSpacing::Uniform, KnotSpacing::ChordLength}) {
    SmoothBSpline spline{};
    spline.spacing = spacing;
    expectAnEnd(spline);
  }
  LimitDynamics limit{};
  limit.axes = 0x7FF;
  limit.velocity = 3;
  limit.acceleration = 20;
  expectAnEnd(limit);
}

TEST(Garbage, SplinesOfLines) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::vector<PathObject> path = garbage(seed);
    for (size_t i = 0; i < path.size(); ++i) {
      PathObject &o = path[i];
      if (i > 0)
        o.start = path[i - 1].end;
      o.moveType = MoveType::Line;
      o.planar = 0;
      for (int16_t &id : o.switchId)
        id = 0;
    }
    SmoothBSpline spline{};
    EXPECT_TRUE(runPath(spline, path, {6, 7, seed, 2000000}).ended) << seed;
  }
}

TEST(Garbage, BoxesAreLookedAt) {
  Position least{};
  Position most{};
  for (double &value : most.coordinate)
    value = 5;
  most.coordinate[kAxisB] = std::numeric_limits<double>::quiet_NaN();
  for (unsigned seed = 0; seed < 12; ++seed) {
    OwnedQueue queue(50);
    for (const PathObject &o : garbage(seed))
      append(&queue.queue, &o);
    uint32_t checked = UINT32_MAX;
    BoxFinding finding{0, -1};
    EXPECT_NE(checkBox(&queue.queue, checked, {&least, &most, 0xFFF, 0, 3, -1}, finding),
              BoxError::NoQueue);
  }
}

} // namespace
