// Set values of any kind, with jumps, through SMC_ControlAxisByPos and its like; windows of
// captured positions.
#include "runtime/axis/capture_window.hpp"

#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_DriveBasic/SMC_ControlAxisByPos.h"
#include "st/SM_DriveBasic/SMC_ControlAxisByVel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
using stride::test::Random;
namespace drive = ::st::SM_DriveBasic;
namespace state = stride::axis::state;

constexpr double kCycle = 0.002;
constexpr double kMaxVelocity = 100;
constexpr double kGapVelocity = 60;
constexpr double kGapAcceleration = 2000;
constexpr double kGapDeceleration = 3000;

/// How the set values go on, as an interpolator gives them: it stops at once when it is told to.
class Interpolator {
public:
  explicit Interpolator(Random &random) : random_(random) {}

  void next(bool stop) {
    jumped = false;
    if (stop) {
      velocity = 0;
      return;
    }
    if (random_.chance(0.01)) {
      position += random_.uniform(-50, 50);
      jumped = true;
      return;
    }
    if (random_.chance(0.02))
      wanted_ = random_.chance(0.2) ? 0 : random_.uniform(-90, 90);
    velocity += std::clamp(wanted_ - velocity, -1.5, 1.5);
    position += velocity * kCycle;
  }

  double position = 0;
  double velocity = 0;
  bool jumped = false;

private:
  Random &random_;
  double wanted_ = 0;
};

TEST(SetValuesProperty, GapsInPositionsAreBridged) {
  int bridges = 0;
  for (uint64_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    Random random(seed);
    AxisRig rig(kCycle);
    const bool rotary = random.chance(0.5);
    if (rotary)
      rig.makeRotary(360);
    rig.axis.eRampType = static_cast<int16_t>(random.below(4));
    rig.axis.fJerk = 100000;
    rig.axis.fSWMaxVelocity = kMaxVelocity;
    ASSERT_GT(rig.powerUp(), 0);
    auto block = fresh<drive::SMC_ControlAxisByPos>();
    block.Axis = &rig.axis;
    block.bEnable = 1;
    block.fGapVelocity = kGapVelocity;
    block.fGapAcceleration = kGapAcceleration;
    block.fGapDeceleration = kGapDeceleration;
    Interpolator path(random);
    path.position = random.uniform(-20, 20);
    double before = 0;
    double velocityBefore = 0;
    int bridging = 0;
    for (int cycle = 0; cycle < 3000; ++cycle) {
      path.next(block.bStopIpo != 0);
      rig.cycle([&] {
        block.fSetPosition = path.position;
        block.body__(rig.ctx);
      });
      ASSERT_EQ(rig.axis.nAxisState, state::kSynchronized);
      ASSERT_EQ(block.bBusy, 1);
      const double set = rig.axis.fSetPosition;
      double way = set - before;
      if (rotary)
        way = stride::test::shortWay(way, 360);
      // Whatever comes in, the axis is never faster than allowed; the sets are what they seem.
      ASSERT_LE(std::fabs(way), kMaxVelocity * kCycle * (1 + 1e-6)) << seed << " " << cycle;
      ASSERT_NEAR(way, 0.5 * (velocityBefore + rig.axis.fSetVelocity) * kCycle,
                  kMaxVelocity * kCycle);
      before = set;
      velocityBefore = rig.axis.fSetVelocity;
      if (block.bStopIpo != 0) {
        bridges += bridging == 0 ? 1 : 0;
        // It brakes from what it had, then goes at most 180 u.
        ASSERT_LE(++bridging, 2500) << seed;
        continue;
      }
      bridging = 0;
      const double shown = rotary ? stride::test::onCircle(path.position, 360) : path.position;
      ASSERT_EQ(set, shown) << seed << " " << cycle;
    }
    ASSERT_EQ(rig.axis.wFBErrorID, 0);
    // The drive has gone the same way.
    rig.cycle([&] {
      block.fSetPosition = path.position;
      block.body__(rig.ctx);
    });
    ASSERT_NEAR(rotary ? stride::test::shortWay(rig.axis.fActPosition - before, 360)
                       : rig.axis.fActPosition - before,
                0.0, 1e-4);
  }
  EXPECT_GE(bridges, 1500);
}

TEST(SetValuesProperty, GapsInVelocitiesAreBridged) {
  int bridges = 0;
  for (uint64_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    Random random(seed + 1000);
    AxisRig rig(kCycle);
    rig.axis.eRampType = static_cast<int16_t>(random.below(4));
    rig.axis.fJerk = 100000;
    rig.axis.fSWMaxAcceleration = 500;
    rig.axis.fSWMaxDeceleration = 800;
    ASSERT_GT(rig.powerUp(), 0);
    auto block = fresh<drive::SMC_ControlAxisByVel>();
    block.Axis = &rig.axis;
    block.bEnable = 1;
    block.fGapAcceleration = 300;
    block.fGapDeceleration = 300;
    double wanted = 0;
    double given = 0;
    double before = 0;
    int bridging = 0;
    for (int cycle = 0; cycle < 3000; ++cycle) {
      if (block.bStopIpo == 0 && random.chance(0.01))
        wanted = random.uniform(-50, 50);
      if (random.chance(0.005) && block.bStopIpo == 0)
        given = random.uniform(-50, 50);
      given += std::clamp(wanted - given, -0.9, 0.9);
      if (block.bStopIpo != 0)
        given = wanted;
      rig.cycle([&] {
        block.fSetVelocity = given;
        block.body__(rig.ctx);
      });
      const double set = rig.axis.fSetVelocity;
      ASSERT_LE(std::fabs(set - before), 800 * kCycle * (1 + 1e-6)) << seed << " " << cycle;
      if (std::fabs(set) > std::fabs(before) && set * before >= 0) {
        ASSERT_LE(std::fabs(set - before), 500 * kCycle * (1 + 1e-6)) << seed << " " << cycle;
      }
      before = set;
      if (block.bStopIpo != 0) {
        bridges += bridging == 0 ? 1 : 0;
        ASSERT_LE(++bridging, 2000) << seed;
      } else {
        bridging = 0;
        ASSERT_NEAR(set, given, 1e-9) << seed << " " << cycle;
      }
    }
    ASSERT_EQ(rig.axis.wFBErrorID, 0);
  }
  EXPECT_GE(bridges, 1000);
}

TEST(SetValuesProperty, WindowsAreTheWayFromFirstToLast) {
  Random random(3);
  for (int round = 0; round < 100000; ++round) {
    auto axis = fresh<stride::axis::AxisRef>();
    const bool rotary = random.chance(0.7);
    const double period = random.uniform(1, 1000);
    axis.iMovementType = rotary ? 0 : 1;
    axis.fPositionPeriod = period;
    const double first = random.uniform(-2, 2) * period;
    const double last = random.chance(0.5) ? first + random.uniform(0, 1.2) * period
                                           : random.uniform(-2, 2) * period;
    const double place = random.uniform(rotary ? 0 : -2, rotary ? 1 : 2) * period;
    ASSERT_EQ(stride::axis::isCaptureWindow(axis, first, last), rotary || first <= last);
    bool expected = first <= place && place <= last;
    if (rotary) {
      // In positive direction from `first`, does `place` come before `last`?
      const double toPlace = stride::test::onCircle(place - first, period);
      const double toLast =
          last >= first + period ? period : stride::test::onCircle(last - first, period);
      if (std::fabs(toPlace - toLast) < 1e-9 * period)
        continue;
      expected = toPlace <= toLast;
    }
    ASSERT_EQ(stride::axis::inCaptureWindow(axis, first, last, place), expected)
        << first << " " << last << " " << place << " " << period;
  }
}

} // namespace
