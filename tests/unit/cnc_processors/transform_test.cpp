// Turning, shifting and stretching against Eigen, place by place.
#include "tests/unit/cnc_processors/sampled_path.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include "runtime/numeric/cnc/processors/transform.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

Eigen::Vector3d eigen(const Point &p) { return {p[0], p[1], p[2]}; }

/// One of each kind, in the plane of X and Y and in others.
std::vector<PathObject> objects() {
  std::vector<PathObject> all{line({1, 2, 3}, {-4, 7, 11}), arc({3, -1, 2}, 2.5, 30, 200),
                              arc({-3, 1, 2}, 1.5, -70, -100)};
  PathObject ellipse = object(MoveType::EllipseCounterclockwise, {}, {});
  const double ofEllipse[] = {2, 3, std::cos(0.4), std::sin(0.4), 5, 2, 0.4 * 180 / M_PI, 0.4};
  std::memcpy(ellipse.shape, ofEllipse, sizeof ofEllipse);
  ellipse.parameterRange[0] = 25;
  ellipse.parameterRange[1] = -140;
  all.push_back(ellipse);
  PathObject spline = object(MoveType::Spline, {}, {});
  const double ofSpline[] = {1, 2, -0.5, 0.25, 3, -1, 2, 0.75};
  std::memcpy(spline.shape, ofSpline, sizeof ofSpline);
  all.push_back(spline);
  PathObject curve = object(MoveType::Spline3d, {}, {});
  for (int i = 0; i < 18; ++i)
    (i < 8 ? curve.shape[i] : curve.moreShape[i - 8]) = std::sin(1.7 * i + 0.3);
  all.push_back(curve);
  PathObject upright = arc({1, 2, 0}, 2, 10, 100);
  upright.planeX = {0, 0, 1};
  upright.planeY = {1, 0, 0};
  upright.normal = {0, 1, 0};
  upright.shape[3] = 4;
  all.push_back(upright);
  PathObject tilted = ellipse;
  tilted.planeX = {0.6, 0, 0.8};
  tilted.planeY = {0, 1, 0};
  tilted.normal = {-0.8, 0, 0.6};
  all.push_back(tilted);
  for (PathObject &o : all) {
    const Point from = placeAt(o, 0);
    const Point to = placeAt(o, 1);
    for (int i = 0; i < 3; ++i) {
      o.start.coordinate[i] = from[i];
      o.end.coordinate[i] = to[i];
    }
    o.start.coordinate[kAxisP] = 5;
    o.end.coordinate[kAxisP] = 6;
    o.length = lengthOf(o, 2000);
  }
  return all;
}

template <class Map>
void expectMoved(const PathObject &before, const PathObject &after, const Map &map) {
  EXPECT_LT((eigen(startOf(after)) - map(eigen(startOf(before)))).norm(), 1e-12);
  EXPECT_LT((eigen(endOf(after)) - map(eigen(endOf(before)))).norm(), 1e-12);
  for (int i = 0; i <= 20; ++i) {
    const double t = i / 20.0;
    EXPECT_LT((eigen(placeAt(after, t)) - map(eigen(placeAt(before, t)))).norm(), 1e-11)
        << static_cast<int>(before.moveType) << " at " << t;
  }
  EXPECT_EQ(after.start.coordinate[kAxisP], 5);
  EXPECT_EQ(after.end.coordinate[kAxisP], 6);
  EXPECT_EQ(after.velocity, before.velocity);
}

TEST(CncTransform, TurnsAroundZ) {
  for (const double degrees : {0.0, 90.0, -90.0, 30.0, 213.7, -725.0})
    for (const PathObject &before : objects()) {
      PathObject after = before;
      rotateObject(after, degrees);
      const Eigen::AngleAxisd turn(degrees * M_PI / 180, Eigen::Vector3d::UnitZ());
      expectMoved(before, after,
                  [&](const Eigen::Vector3d &p) -> Eigen::Vector3d { return turn * p; });
      EXPECT_EQ(after.length, before.length);
    }
  PathObject o = line({1, 2, 3}, {-4, 7, 11});
  rotateObject(o, 90);
  EXPECT_EQ(startOf(o), (Point{-2, 1, 3}));
  EXPECT_EQ(endOf(o), (Point{-7, -4, 11}));
  PathObject circle = arc({3, -1, 2}, 2.5, 30, 200);
  rotateObject(circle, 90); // V2.3's programs read centre and angles
  EXPECT_EQ(circle.shape[0], 1);
  EXPECT_EQ(circle.shape[1], 3);
  EXPECT_EQ(circle.parameterRange[0], 120);
}

TEST(CncTransform, Shifts) {
  const Point way{-1.5, 4, 0.25};
  for (const PathObject &before : objects()) {
    PathObject after = before;
    translateObject(after, {way[0], way[1], way[2]});
    expectMoved(before, after,
                [&](const Eigen::Vector3d &p) -> Eigen::Vector3d { return p + eigen(way); });
    EXPECT_EQ(after.length, before.length);
  }
}

TEST(CncTransform, Stretches) {
  for (const double factor : {2.0, 0.125, 1.0, -3.0})
    for (PathObject before : objects()) {
      before.startSlope[1] = 6;
      PathObject after = before;
      scaleObject(after, factor);
      expectMoved(before, after,
                  [&](const Eigen::Vector3d &p) -> Eigen::Vector3d { return p * factor; });
      EXPECT_NEAR(after.length, before.length * std::abs(factor), 1e-12);
      EXPECT_NEAR(after.startSlope[1], 6 / std::abs(factor), 1e-12);
    }
  PathObject only = line({1, 2, 3}, {1, 2, 3}); // P alone moves: its length is not in space
  only.length = 7;
  scaleObject(only, 2);
  EXPECT_EQ(only.length, 7);
}

TEST(CncTransform, FunctionsKeepTheirParameters) {
  PathObject m = object(MoveType::Function, {1, 2, 3}, {1, 2, 3});
  m.shape[0] = 5;
  m.shape[1] = 6;
  m.switchId[0] = 3;
  rotateObject(m, 90);
  translateObject(m, {1, 1, 1});
  scaleObject(m, 2);
  EXPECT_EQ(startOf(m), (Point{-2, 4, 8}));
  EXPECT_EQ(m.shape[0], 5);
  EXPECT_EQ(m.shape[1], 6);
}

TEST(CncTransform, AnObjectOfZerosLiesInTheFirstPlane) {
  PathObject o = arc({3, -1, 0}, 2, 0, 90);
  o.planeX = o.planeY = o.normal = {0, 0, 0};
  rotateObject(o, 90);
  EXPECT_EQ(o.planeX.x, 1);
  EXPECT_EQ(o.normal.z, 1);
  EXPECT_EQ(o.shape[0], 1);
}

TEST(CncTransform, StreamsTakeTheValueOfTheStart) {
  const std::vector<PathObject> path = objects();
  TranslatePath p{};
  p.wanted = {TransformKind::Translate, {1, 2, 3}};
  const Outcome run = runPath(p, path, {5, 6, 3, 0});
  ASSERT_EQ(run.objects.size(), path.size());
  for (size_t i = 0; i < path.size(); ++i)
    EXPECT_EQ(startOf(run.objects[i]), startOf(path[i]) + (Point{1, 2, 3}));
  p.wanted.value.x = std::nan("");
  EXPECT_EQ(runPath(p, path).stream.error, StreamError::InvalidParameter);
  ScalePath zero{};
  zero.wanted.kind = TransformKind::Scale;
  EXPECT_EQ(runPath(zero, path).stream.error, StreamError::InvalidParameter);
}

TEST(CncTransform, InPlaceChangesEachObjectOnce) {
  OwnedQueue queue(6);
  uint32_t seen = queue.queue.writePosition;
  const Transform shift{TransformKind::Translate, {10, 0, 0}};
  double next = 0;
  std::vector<double> driven;
  for (int turn = 0; turn < 40; ++turn) {
    for (int i = 0; i < turn % 3; ++i) {
      const PathObject o = line({next, 0, 0}, {next + 1, 0, 0});
      if (append(&queue.queue, &o) != nullptr)
        ++next;
    }
    transformInPlace(&queue.queue, shift, seen);
    for (uint32_t i = 0; i < countOf(&queue.queue); ++i)
      EXPECT_GE(objectAt(&queue.queue, i)->start.coordinate[0], 10);
    if (turn % 2 == 1 && countOf(&queue.queue) > 0) {
      driven.push_back(objectAt(&queue.queue, 0)->start.coordinate[0]);
      removeAt(&queue.queue, 0);
    }
  }
  ASSERT_GT(driven.size(), 15U);
  for (size_t i = 0; i < driven.size(); ++i)
    EXPECT_EQ(driven[i], 10 + static_cast<double>(i));
}

} // namespace
