// How fast the place between two blended moves is passed when they speed up and brake with
// different rates: as fast as the first can get there and the second can still stop from.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/MC_BUFFER_MODE.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace {

using stride::test::AxisRig;
namespace buffer = ::st::SM_DriveBasic;

/// One of the two moves. [u, u/s, u/s²]
struct Leg {
  double way, velocity, acceleration, deceleration;
};

struct Case {
  Leg first, second;
  int16_t mode;
  double jerk;    ///< [u/s³] 0: trapezoids.
  double between; ///< The velocity with which the place between is passed.
};

std::ostream &operator<<(std::ostream &out, const Case &c) {
  return out << "mode " << c.mode << ", second " << c.second.way << " u with "
             << c.second.acceleration << '/' << c.second.deceleration << " u/s², jerk " << c.jerk;
}

/// What was seen from outside, in the direction of the moves.
struct Passage {
  double between = 0;  ///< Velocity at the end of the first move.
  double farthest = 0; ///< Place.
  double hardest = 0;  ///< How much the velocity fell per second in the second move.
  bool done = false;
};

constexpr double kCycle = 0.001;

TEST(BufferModes, ANumberThatIsNoneIsRefused) {
  AxisRig rig(kCycle);
  ASSERT_GT(rig.powerUp(), 0);
  auto first = rig.move(100);
  rig.cycle([&] { rig.call(first, true); });
  for (const int mode : {-32768, -1, 6, 32767}) {
    auto second = rig.move(-100);
    second.BufferMode = static_cast<int16_t>(mode);
    rig.cycle([&] {
      rig.call(first, true);
      rig.call(second, true);
    });
    EXPECT_EQ(second.ErrorID, stride::axis::error::kInvalidParameter) << mode;
    EXPECT_EQ(first.Busy, 1) << mode;
    EXPECT_EQ(rig.axis.stQueue.uiCount, 0) << mode;
  }
  auto last = rig.move(150);
  last.BufferMode = buffer::MC_BUFFER_MODE__BlendingHigh;
  rig.cycle([&] {
    rig.call(first, true);
    rig.call(last, true);
  });
  EXPECT_EQ(last.Error, 0);
}

Passage drive(const Case &c, double side) {
  AxisRig rig(kCycle);
  rig.axis.eRampType = c.jerk > 0 ? 2 : 0;
  rig.axis.fJerk = c.jerk;
  EXPECT_GT(rig.powerUp(), 0);
  auto first =
      rig.move(side * c.first.way, c.first.velocity, c.first.acceleration, c.first.deceleration);
  auto second = rig.move(side * (c.first.way + c.second.way), c.second.velocity,
                         c.second.acceleration, c.second.deceleration);
  second.BufferMode = c.mode;
  Passage seen;
  double place = 0;
  double velocity = 0;
  double acceleration = 0;
  for (int i = 0; i < 20000 && second.Done == 0; ++i) {
    rig.cycle([&] {
      rig.call(first, true);
      rig.call(second, i >= 3);
    });
    const double now = side * rig.axis.fSetPosition;
    const double speed = side * rig.axis.fSetVelocity;
    // Carried on from the cycle before with its acceleration.
    if (place < c.first.way && now >= c.first.way)
      seen.between =
          std::sqrt(std::max(0.0, velocity * velocity + 2 * acceleration * (c.first.way - place)));
    else if (place >= c.first.way)
      seen.hardest = std::max(seen.hardest, (velocity - speed) / kCycle);
    place = now;
    velocity = speed;
    acceleration = side * rig.axis.fSetAcceleration;
    seen.farthest = std::max(seen.farthest, place);
  }
  seen.done = second.Done != 0;
  return seen;
}

/// From which velocity a jerk-limited stop with `deceleration` takes `way`: v/2 * (v/d + d/j) =
/// way, where the deceleration is reached.
double stoppedWithin(double way, double deceleration, double jerk) {
  const double half = deceleration * deceleration / (2 * jerk);
  return std::sqrt(half * half + 2 * deceleration * way) - half;
}

class Blending : public ::testing::TestWithParam<Case> {};

TEST_P(Blending, PassesThePlaceBetweenAsFastAsBothMovesAllow) {
  const Case &c = GetParam();
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(side);
    const Passage seen = drive(c, side);
    EXPECT_TRUE(seen.done);
    EXPECT_NEAR(seen.between, c.between, (c.jerk > 0 ? 2e-3 : 1e-6) * c.between);
    EXPECT_LE(seen.farthest, (c.first.way + c.second.way) * (1 + 1e-12))
        << "passed the end and came back";
    EXPECT_LE(seen.hardest, c.second.deceleration * (1 + 1e-6)) << "braked harder than was allowed";
  }
}

constexpr int16_t kLow = buffer::MC_BUFFER_MODE__BlendingLow;
constexpr int16_t kPrevious = buffer::MC_BUFFER_MODE__BlendingPrevious;
constexpr int16_t kNext = buffer::MC_BUFFER_MODE__BlendingNext;
constexpr int16_t kHigh = buffer::MC_BUFFER_MODE__BlendingHigh;
constexpr Leg kFirst = {100, 500, 1000, 800};

INSTANTIATE_TEST_SUITE_P(
    UnequalRates, Blending,
    ::testing::Values(
        // The second must stop: its deceleration counts, not its acceleration.
        Case{kFirst, {20, 500, 4000, 250}, kNext, 0, 100},
        Case{kFirst, {20, 500, 250, 4000}, kNext, 0, 400},
        Case{kFirst, {20, 500, 4000, 1000}, kHigh, 0, 200},
        Case{kFirst, {20, 500, 1000, 250}, kPrevious, 0, 100},
        // The first must get there: its acceleration counts, not its deceleration.
        Case{{100, 500, 450, 4000}, {1000, 500, 100, 200}, kHigh, 0, 300},
        Case{{100, 500, 450, 50}, {1000, 500, 200, 100}, kHigh, 0, 300},
        // Below, at and above what the second can stop from: 200 u/s.
        Case{kFirst, {40, 199, 90, 500}, kLow, 0, 199},
        Case{kFirst, {40, 200, 90, 500}, kLow, 0, 200},
        Case{kFirst, {40, 201, 90, 500}, kLow, 0, 200},
        Case{kFirst, {40, 199, 2000, 500}, kNext, 0, 199},
        Case{kFirst, {40, 201, 2000, 500}, kNext, 0, 200}));

INSTANTIATE_TEST_SUITE_P(
    UnequalRatesWithJerk, Blending,
    ::testing::Values(
        Case{kFirst, {20, 500, 4000, 250}, kNext, 20000, stoppedWithin(20, 250, 20000)},
        Case{kFirst, {20, 500, 250, 2000}, kNext, 20000, stoppedWithin(20, 2000, 20000)},
        Case{kFirst, {15, 500, 300, 700}, kHigh, 30000, stoppedWithin(15, 700, 30000)}));

} // namespace
