// MC_Jog under keys that are pressed and released at random: the limits of the pressed key,
// steadiness, rest after the release.
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/MC_Jog.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;
using stride::test::Random;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;

constexpr double kPeriod = 37;

/// What the block may ask for; its inputs change only while no key is pressed.
struct Limits {
  double velocity, acceleration, deceleration, jerk;
};

class Hand {
public:
  Hand(uint64_t seed, int16_t ramp)
      : random(seed), rig(random.magnitude(-3.3, -2)), rotary(random.chance(0.4)), ramp_(ramp) {
    rig.axis.dwRatioTechUnitsDenom = 1000000;
    if (rotary)
      rig.makeRotary(kPeriod);
    rig.axis.eRampType = ramp;
    rig.axis.fJerk = 3000;
    limits = {random.uniform(5, 80), random.uniform(50, 400), random.uniform(50, 400),
              random.chance(0.3) ? 0 : random.uniform(1000, 9000)};
  }

  template <class Block> void bind(Block &block) {
    block.Axis = &rig.axis;
    block.Velocity = limits.velocity;
    block.Acceleration = limits.acceleration;
    block.Deceleration = limits.deceleration;
    block.Jerk = limits.jerk;
    ASSERT_GT(rig.powerUp(), 0);
  }

  /// One cycle, whose motion is judged.
  template <class Block> void cycle(Block &block) {
    const auto &axis = rig.axis;
    const double s0 = axis.fSetPosition;
    const double v0 = axis.fSetVelocity;
    const double a0 = axis.fSetAcceleration;
    rig.cycle([&] { block.body__(rig.ctx); });
    const double T = rig.cycleSeconds;
    const double v1 = axis.fSetVelocity;
    const double a1 = axis.fSetAcceleration;
    const double most = std::max(limits.acceleration, limits.deceleration);
    const double peak = (ramp_ == 1 ? M_PI / 2 : 1.0) * most * (1 + 1e-9);
    // The manual's sine takes an acceleration away with the jerk before it does what is asked of
    // it.
    const double jerk = limits.jerk > 0 ? limits.jerk : axis.fJerk;
    const double swing = ramp_ == 1 ? peak * peak / (2 * jerk) : 0;
    ASSERT_LE(std::fabs(v1), limits.velocity * (1 + 1e-9) + swing);
    ASSERT_LE(std::fabs(a1), peak);
    ASSERT_LE(std::fabs(v1 - v0), peak * T + 1e-9);
    double way = axis.fSetPosition - s0;
    const double expected = 0.5 * (v0 + v1) * T;
    if (rotary)
      way = expected + stride::test::shortWay(way - expected, kPeriod);
    ASSERT_LE(std::fabs(way - expected), 0.5 * peak * T * T + 1e-9);
    if (ramp_ == 2) {
      ASSERT_LE(std::fabs(a1 - a0), jerk * T * (1 + 1e-9) + 1e-6);
    }
    ASSERT_EQ(block.Error, 0) << block.ErrorId;
    ASSERT_EQ(block.CommandAborted, 0);
    ASSERT_EQ(block.Busy != 0, axis.iOwner != 0) << "who is busy owns the axis";
    if (block.Busy == 0) {
      ASSERT_EQ(v1, 0);
      ASSERT_EQ(axis.nAxisState, state::kStandstill);
    }
  }

  Random random;
  AxisRig rig;
  bool rotary;
  Limits limits{};

private:
  int16_t ramp_;
};

class Keys : public ::testing::TestWithParam<int> {};

TEST_P(Keys, JogKeepsItsLimitsAndComesToRest) {
  int atSpeed = 0;
  int turned = 0;
  for (uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Hand hand(seed * 31 + 7, static_cast<int16_t>(GetParam()));
    auto jog = fresh<pl::MC_Jog>();
    hand.bind(jog);
    for (int press = 0; press < 12 && !HasFailure(); ++press) {
      const int forward = jog.JogForward;
      jog.JogForward = hand.random.chance(0.5);
      jog.JogBackward = hand.random.chance(0.5);
      turned += forward != 0 && jog.JogForward == 0 && jog.JogBackward != 0 ? 1 : 0;
      const bool held = jog.JogForward != jog.JogBackward;
      const double wanted = !held ? 0 : jog.JogForward != 0 ? jog.Velocity : -jog.Velocity;
      const int cycles = static_cast<int>(hand.random.magnitude(0, 2.5));
      for (int i = 0; i < cycles && !HasFailure(); ++i) {
        hand.cycle(jog);
        if (held) {
          ASSERT_EQ(jog.Busy, 1);
        }
        if (held && hand.rig.axis.fSetVelocity == wanted)
          ++atSpeed;
      }
    }
    jog.JogForward = jog.JogBackward = 1; // both: as none
    for (int i = 0; i < 20000 && jog.Busy != 0 && !HasFailure(); ++i)
      hand.cycle(jog);
    ASSERT_EQ(jog.Busy, 0);
  }
  EXPECT_GT(atSpeed, 1000);
  EXPECT_GT(turned, 20);
}

INSTANTIATE_TEST_SUITE_P(Ramps, Keys, ::testing::Range(0, 4));

} // namespace
