// End velocities where the rule is not only about angles of lines.
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace stride::cnc;

constexpr CornerRules kTight{0.1, -1.0};

PathObject line(double dx, double dy, double dz) {
  PathObject o{};
  o.moveType = MoveType::Line;
  o.start.axes = o.end.axes = 7;
  o.normal = {0, 0, 1};
  o.planeX = {1, 0, 0};
  o.planeY = {0, 1, 0};
  o.end.coordinate[kAxisX] = dx;
  o.end.coordinate[kAxisY] = dy;
  o.end.coordinate[kAxisZ] = dz;
  o.velocity = o.velocityEnd = 20;
  o.acceleration = 100;
  o.deceleration = 300;
  return o;
}

TEST(CncVelocityCheck, MeasuresSmallAndLargeAnglesAlike) {
  for (const double angle : {0.0, 1e-12, 1e-7, 0.3, 1.5, 3.0, 3.14159}) {
    const PathObject turned = line(5 * std::cos(angle), 5 * std::sin(angle), 0);
    EXPECT_NEAR(cornerAngle(line(2, 0, 0), turned), angle, 1e-15 + 1e-13 * angle);
  }
  EXPECT_EQ(cornerAngle(line(2, 1, 0), line(-2, -1, 0)), M_PI);
}

TEST(CncVelocityCheck, RoundingIsNoCorner) {
  const CornerRules none{0, -1};
  EXPECT_EQ(cornerVelocity(line(1, 0, 0), line(1, 0.9e-8, 0), none), 20);
  EXPECT_EQ(cornerVelocity(line(1, 0, 0), line(1, 1.1e-8, 0), none), 0);
  EXPECT_EQ(cornerVelocity(line(1, 0, 0), line(1, 0.9e-8, 0), {std::nan(""), -1}), 20);
  EXPECT_EQ(cornerVelocity(line(1, 0, 0), line(1, 1.1e-8, 0), {std::nan(""), -1}), 0);
}

TEST(CncVelocityCheck, StopsWhereTheLengthBecomesAnother) {
  PathObject planar = line(1, 0, 5);
  planar.planar = 1;
  EXPECT_EQ(cornerVelocity(line(1, 0, 0), planar, kTight), 0);
  EXPECT_EQ(cornerVelocity(planar, planar, kTight), 20); // what leaves the plane does not count
  PathObject down = line(0, 0, -4);
  down.planar = 1;
  PathObject up = line(0, 0, 4);
  up.planar = 1;
  EXPECT_EQ(cornerVelocity(planar, down, kTight), 0);
  EXPECT_EQ(cornerVelocity(down, down, kTight), 20);
  EXPECT_EQ(cornerVelocity(down, up, kTight), 0);
}

TEST(CncVelocityCheck, AxesWithoutAWayInSpaceHaveCornersToo) {
  const auto axes = [](double p, double q) {
    PathObject o = line(0, 0, 0);
    o.start.axes = o.end.axes = 7 | 1 << kAxisP | 1 << kAxisQ;
    o.end.coordinate[kAxisP] = p;
    o.end.coordinate[kAxisQ] = q;
    return o;
  };
  EXPECT_EQ(cornerVelocity(axes(3, 1), axes(6, 2), kTight), 20);
  EXPECT_EQ(cornerVelocity(axes(3, 1), axes(3, -1), kTight), 0);
  EXPECT_EQ(cornerVelocity(axes(3, 1), line(1, 0, 0), kTight), 0);
}

TEST(CncVelocityCheck, StopsAtWhatHasNoShape) {
  PathObject arc = line(1, 1, 0);
  arc.moveType = MoveType::Clockwise; // radius 0
  EXPECT_EQ(cornerVelocity(line(1, 0, 0), arc, {4, -1}), 0);
  EXPECT_EQ(cornerVelocity(line(0, 0, 0), line(0, 0, 0), kTight), 0); // nor has this a direction
}

struct Path {
  std::vector<PathObject> memory = std::vector<PathObject>(8);
  Queue queue{};
  uint32_t checked = UINT32_MAX;
  Path() {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(memory.data());
    queue.size = static_cast<uint32_t>(memory.size() * sizeof(PathObject));
  }
  VelocityError check() { return checkVelocities(&queue, checked, kTight); }
  double endOf(uint32_t n) { return objectAt(&queue, n)->velocityEnd; }
};

TEST(CncVelocityCheck, LeavesTheLastObjectOpenUntilThePathIsComplete) {
  Path path;
  const PathObject object = line(1, 0, 0);
  append(&path.queue, &object);
  ASSERT_EQ(path.check(), VelocityError::None);
  EXPECT_EQ(path.endOf(0), 20);
  append(&path.queue, &object);
  ASSERT_EQ(path.check(), VelocityError::None);
  EXPECT_EQ(path.endOf(0), 20);
  EXPECT_EQ(path.endOf(1), 20);
  path.queue.endOfList = 1;
  ASSERT_EQ(path.check(), VelocityError::None);
  EXPECT_EQ(path.endOf(0), 20);
  EXPECT_EQ(path.endOf(1), 0);
}

TEST(CncVelocityCheck, OnlyLowersVelocities) {
  Path path;
  PathObject object = line(1, 0, 0);
  for (const double end : {3.0, -5.0, std::nan(""), 50.0}) {
    object.velocityEnd = end;
    append(&path.queue, &object);
  }
  object.velocityEnd = 20;
  object.velocity = 7;
  append(&path.queue, &object);
  ASSERT_EQ(path.check(), VelocityError::None);
  EXPECT_EQ(path.endOf(0), 3);
  EXPECT_EQ(path.endOf(1), 0);
  EXPECT_EQ(path.endOf(2), 0);
  EXPECT_EQ(path.endOf(3), 7);
}

TEST(CncVelocityCheck, ReadsAQueueThatSomebodyFilledUpToTheEndOfTheMemory) {
  Path path;
  for (PathObject &place : path.memory)
    place = line(1, 0, 0);
  path.memory[3] = line(0, 1, 0);
  path.queue.writePosition = path.queue.size;
  path.queue.endOfList = 1;
  path.checked = 0;
  ASSERT_EQ(path.check(), VelocityError::None);
  const double expected[] = {20, 20, 0, 0, 20, 20, 20, 0};
  for (uint32_t n = 0; n < 8; ++n)
    EXPECT_EQ(path.endOf(n), expected[n]) << n;
  EXPECT_EQ(appendedSince(&path.queue, path.checked), 0U);
}

TEST(CncVelocityCheck, RefusesNumbersThatDoNotMove) {
  const auto errorWith = [](auto change) {
    Path path;
    const PathObject good = line(1, 0, 0);
    append(&path.queue, &good);
    PathObject bad = good;
    change(bad);
    append(&path.queue, &bad);
    const VelocityError error = path.check();
    EXPECT_EQ(path.check(), error); // again and again
    return error;
  };
  const double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(errorWith([](PathObject &o) { o.velocity = 0; }), VelocityError::NotPositive);
  EXPECT_EQ(errorWith([](PathObject &o) { o.velocity = std::nan(""); }),
            VelocityError::NotPositive);
  EXPECT_EQ(errorWith([&](PathObject &o) { o.velocity = kInfinite; }), VelocityError::NotPositive);
  EXPECT_EQ(errorWith([](PathObject &o) { o.acceleration = -1; }), VelocityError::NotPositive);
  EXPECT_EQ(errorWith([](PathObject &o) { o.deceleration = 0; }), VelocityError::NotPositive);
  EXPECT_EQ(errorWith([](PathObject &o) {
              o.moveType = MoveType::Function;
              o.velocity = o.acceleration = 0;
            }),
            VelocityError::None);
  Path none;
  none.queue.structId = 0;
  EXPECT_EQ(none.check(), VelocityError::NoQueue);
}

} // namespace
