// End velocities along random chains of lines and arcs whose corners are chosen, so that the rule
// can be written down beside them; at once, or as objects come and go.
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace stride::cnc;
using stride::test::casesOf;
using stride::test::Random;

struct Chain {
  std::vector<PathObject> objects;
  std::vector<double> expected; ///< End velocities of all objects of the complete path.
  double tolerance = 0;         ///< [rad]
};

void copyPlace(double x, double y, double height, Position &to) {
  to.coordinate[kAxisX] = x;
  to.coordinate[kAxisY] = y;
  to.coordinate[kAxisZ] = height;
  to.axes = 7;
}

/// Makes chains: where the path is, and which way it goes.
class Maker {
public:
  explicit Maker(Random &random) : random_(random) {}

  Chain chain() {
    Chain chain;
    chain.tolerance = random_.chance(0.2) ? 0 : random_.uniform(0, 1.5);
    const int count = 2 + random_.below(12);
    bool stopped = true;
    for (int i = 0; i < count; ++i) {
      const double corner = nextCorner(chain.tolerance);
      heading_ += corner;
      const PathObject object = next();
      const bool stops = object.moveType == MoveType::Function ||
                         object.moveType == MoveType::Positioning || object.length == 0;
      if (i > 0) {
        const bool corners = std::fabs(std::remainder(corner, 2 * M_PI)) > chain.tolerance + 1e-9;
        const PathObject &before = chain.objects.back();
        chain.expected.push_back(
            stopped || stops || corners
                ? 0.0
                : std::min({before.velocityEnd, before.velocity, object.velocity}));
      }
      stopped = stops;
      chain.objects.push_back(object);
    }
    chain.expected.push_back(0);
    return chain;
  }

private:
  double nextCorner(double tolerance) {
    if (random_.chance(0.4))
      return 0;
    if (random_.chance(0.5)) // near the tolerance, at either side
      return random_.sign() * (tolerance + random_.sign() * tolerance * random_.magnitude(-5, -1));
    return random_.uniform(-3.1, 3.1);
  }

  PathObject next() {
    PathObject o{};
    o.planeX = {1, 0, 0};
    o.planeY = {0, 1, 0};
    o.normal = {0, 0, 1};
    o.velocity = random_.magnitude(-1, 3);
    o.velocityEnd = random_.chance(0.8) ? o.velocity : o.velocity * random_.uniform(0.1, 3);
    o.acceleration = o.deceleration = 100;
    copyPlace(x_, y_, 3, o.start);
    const int kind = random_.below(10);
    if (kind < 4)
      arc(o);
    else
      line(o, kind);
    copyPlace(x_, y_, 3, o.end);
    return o;
  }

  void line(PathObject &o, int kind) {
    o.moveType = kind == 7   ? MoveType::Positioning
                 : kind == 8 ? MoveType::Function
                             : MoveType::Line;
    o.length = kind == 8 || kind == 9 ? 0 : random_.uniform(1, 50);
    if (kind == 8)
      o.velocity = 0; // means nothing there
    x_ += o.length * std::cos(heading_);
    y_ += o.length * std::sin(heading_);
  }

  void arc(PathObject &o) {
    const double turn = random_.chance(0.5) ? 1 : -1;
    const double radius = random_.uniform(1, 30);
    const double sweep = random_.uniform(0.2, 6);
    o.moveType = turn > 0 ? MoveType::Counterclockwise : MoveType::Clockwise;
    o.shape[0] = x_ - turn * radius * std::sin(heading_);
    o.shape[1] = y_ + turn * radius * std::cos(heading_);
    o.shape[2] = radius;
    o.parameterRange[0] = (heading_ - turn * M_PI / 2) / M_PI * 180;
    o.parameterRange[1] = -turn * sweep / M_PI * 180;
    heading_ += turn * sweep;
    x_ = o.shape[0] + turn * radius * std::sin(heading_);
    y_ = o.shape[1] - turn * radius * std::cos(heading_);
    o.length = radius * sweep;
  }

  Random &random_;
  double x_ = 0;
  double y_ = 0;
  double heading_ = 0.3;
};

struct Memory {
  std::vector<PathObject> places;
  Queue queue{};
  explicit Memory(size_t count) : places(count) {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(places.data());
    queue.size = static_cast<uint32_t>(count * sizeof(PathObject));
  }
};

TEST(CncVelocityCheck, StopsAtCornersAndNowhereElse) {
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Chain chain = Maker(random).chain();
    Memory memory(chain.objects.size() + 1);
    for (const PathObject &object : chain.objects)
      ASSERT_NE(append(&memory.queue, &object), nullptr);
    memory.queue.endOfList = 1;
    uint32_t checked = UINT32_MAX;
    ASSERT_EQ(checkVelocities(&memory.queue, checked, {chain.tolerance, -1}), VelocityError::None);
    for (size_t n = 0; n < chain.objects.size(); ++n)
      ASSERT_EQ(objectAt(&memory.queue, static_cast<uint32_t>(n))->velocityEnd, chain.expected[n])
          << n;
  }
}

TEST(CncVelocityCheck, SaysTheSameWhenObjectsComeAndGo) {
  for (int i = 0; i < casesOf(3000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    const Chain chain = Maker(random).chain();
    Memory memory(static_cast<size_t>(3 + random.below(5)));
    uint32_t checked = UINT32_MAX;
    size_t put = 0;
    size_t taken = 0;
    while (taken < chain.objects.size()) {
      for (int more = random.below(4); more > 0 && put < chain.objects.size(); --more)
        put += append(&memory.queue, &chain.objects[put]) != nullptr;
      memory.queue.endOfList = put == chain.objects.size() && random.chance(0.5);
      ASSERT_EQ(checkVelocities(&memory.queue, checked, {chain.tolerance, -1}),
                VelocityError::None);
      // All but the last one, whose end is open.
      const uint32_t closed = memory.queue.endOfList != 0 ? 0 : 1;
      for (int less = random.below(5); less > 0 && countOf(&memory.queue) > closed; --less) {
        ASSERT_EQ(objectAt(&memory.queue, 0)->velocityEnd, chain.expected[taken]) << taken;
        ASSERT_TRUE(removeAt(&memory.queue, 0));
        ++taken;
      }
    }
  }
}

TEST(CncVelocityCheck, OtherAxesDoNotJumpByMoreThanIsSaid) {
  for (int i = 0; i < casesOf(2000) && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    Random random(static_cast<uint64_t>(i));
    PathObject objects[2] = {};
    const double jump = random.magnitude(-2, 3);
    double slope[2][2];
    for (int n = 0; n < 2; ++n) {
      PathObject &o = objects[n];
      o.moveType = MoveType::Line;
      o.velocity = o.velocityEnd = random.magnitude(0, 3);
      o.start.axes = o.end.axes = 7 | 1 << kAxisA | 1 << kAxisQ;
      o.end.coordinate[kAxisX] = random.magnitude(-1, 2);
      for (const AxisBit axis : {kAxisA, kAxisQ}) {
        o.start.coordinate[axis] = random.uniform(-50, 50);
        o.end.coordinate[axis] = random.uniform(-50, 50);
        slope[n][axis == kAxisQ] =
            (o.end.coordinate[axis] - o.start.coordinate[axis]) / o.end.coordinate[kAxisX];
      }
      o.end.coordinate[kAxisW] = 1e6; // not interpolated
    }
    if (random.chance(0.3)) { // an S ends and begins at rest
      objects[0].start.sProfile = 1 << kAxisQ;
      slope[0][1] = 0;
    }
    if (random.chance(0.3)) {
      objects[1].slopes = 1;
      objects[1].startSlope[0] = slope[1][0] = random.uniform(-3, 3);
    }
    const double most =
        std::max(std::fabs(slope[0][0] - slope[1][0]), std::fabs(slope[0][1] - slope[1][1]));
    const double least = std::min(objects[0].velocity, objects[1].velocity);
    const double velocity = cornerVelocity(objects[0], objects[1], {0, jump});
    ASSERT_NEAR(velocity, std::min(least, jump / most), 1e-12 * least);
    ASSERT_EQ(cornerVelocity(objects[0], objects[1], {0, -1}), least);
  }
}

} // namespace
