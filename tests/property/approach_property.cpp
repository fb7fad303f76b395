// The way onto a curve: chain rule there and back, and whether it goes backwards, against a walk in
// small steps.
#include "runtime/numeric/cam/approach.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace cam = stride::cam;
using stride::numeric::MotionState;
using stride::test::casesOf;
using stride::test::Random;

TEST(ApproachProperty, TheChainRuleLeadsThereAndBack) {
  Random random(1);
  for (int i = 0; i < casesOf(20000); ++i) {
    const MotionState slave{random.uniform(-100, 100), random.sign() * random.magnitude(-3, 3),
                            random.chance(0.3) ? 0 : random.sign() * random.magnitude(-3, 4)};
    const double velocity = random.sign() * random.magnitude(-2, 4);
    const double acceleration = random.chance(0.3) ? 0 : random.sign() * random.magnitude(-2, 4);
    cam::Node place{};
    ASSERT_TRUE(cam::placeOver(slave, 7, velocity, acceleration, place));
    EXPECT_EQ(place.x, 7);
    EXPECT_EQ(place.y, slave.position);
    const MotionState back =
        cam::motionOver({place.y, place.v, place.a, 0}, velocity, acceleration);
    EXPECT_EQ(back.position, slave.position);
    EXPECT_NEAR(back.velocity, slave.velocity, 1e-15 * std::fabs(slave.velocity));
    EXPECT_NEAR(back.acceleration, slave.acceleration,
                1e-14 * (std::fabs(slave.acceleration) + std::fabs(place.v * acceleration)));
  }
}

TEST(ApproachProperty, AMovingSlaveHasNoPlaceOverAMasterAtRest) {
  cam::Node place{};
  EXPECT_TRUE(cam::placeOver({3, 0, 0}, 1, 0, 0, place));
  EXPECT_EQ(place.v, 0);
  EXPECT_EQ(place.a, 0);
  EXPECT_FALSE(cam::placeOver({3, 1, 0}, 1, 0, 5, place));
  EXPECT_FALSE(cam::placeOver({3, 0, 1}, 1, 0, 0, place));
  EXPECT_FALSE(cam::placeOver({3, 1, 0}, 1, 1e-200, 0, place));
}

TEST(ApproachProperty, SaysWhetherItGoesBackwards) {
  int there = 0, back = 0;
  for (int seed = 0; seed < casesOf(5000); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<uint64_t>(seed));
    const double h = random.sign() * random.magnitude(-1, 3);
    cam::Approach approach{};
    approach.begin = {random.uniform(-100, 100), random.uniform(-100, 100), 0, 0};
    if (random.chance(0.7)) {
      approach.begin.v = random.uniform(-1, 3);
      approach.begin.a = random.uniform(-5, 5) / std::fabs(h);
    }
    approach.end = {approach.begin.x + h, 0, random.chance(0.9) ? random.uniform(0.1, 3) : 0.0, 0};
    if (random.chance(0.2))
      approach.end.a = random.uniform(-5, 5) / std::fabs(h);
    if (random.chance(0.5)) { // the other way round
      approach.begin.v *= -1;
      approach.end.v *= -1;
    }
    approach.end.y = approach.begin.y + cam::evenWay(approach) +
                     h * (random.chance(0.5) ? random.uniform(-1, 1) : 0);
    const double side =
        approach.end.v != 0 ? approach.end.v * h : approach.end.y - approach.begin.y;
    double least = 0, size = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double x = approach.begin.x + h * i / 4000;
      const double v = cam::evaluateQuintic(approach.begin, approach.end, x).v * h;
      least = std::fmin(least, side < 0 ? -v : v);
      size = std::fmax(size, std::fabs(v));
    }
    // Between two steps it can go back by what the curvature makes of it.
    if (cam::reverses(approach)) {
      EXPECT_LT(least, 1e-6 * size);
      ++back;
    } else {
      EXPECT_GE(least, -1e-9 * size);
      ++there;
    }
    if (least < -1e-6 * size) {
      EXPECT_TRUE(cam::reverses(approach));
    }
  }
  EXPECT_GT(there, casesOf(1000));
  EXPECT_GT(back, casesOf(1000));
}

TEST(ApproachProperty, TheEvenWayGoesBackOnlyWithAnEnd) {
  // Both ends in the same direction and no accelerations: never.
  Random random(2);
  for (int i = 0; i < casesOf(5000); ++i) {
    cam::Approach approach{};
    approach.begin.v = random.uniform(0, 3);
    approach.end = {random.magnitude(-2, 3), 0, random.uniform(0.01, 3), 0};
    approach.end.y = cam::evenWay(approach);
    EXPECT_NEAR(approach.end.y, 0.5 * (approach.begin.v + approach.end.v) * approach.end.x,
                1e-14 * approach.end.x * 3);
    EXPECT_FALSE(cam::reverses(approach));
  }
}

} // namespace
