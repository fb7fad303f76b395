// SMC_TrackAxis, SMC_TrackSetValues and SMC_BacklashCompensation on rotary and linear axes with
// periods of their own: where the slave is when it says so, and its limits on the way.
#include "tests/property/gear_scene.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"

#include "st/SM_PLCopen/SMC_BACKLASH_MODE.h"
#include "st/SM_PLCopen/SMC_BACKLASH_STARTSTATE.h"
#include "st/SM_PLCopen/SMC_BacklashCompensation.h"
#include "st/SM_PLCopen/SMC_TrackAxis.h"
#include "st/SM_PLCopen/SMC_TrackSetValues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using stride::test::fresh;
using stride::test::kGearCycle;
using stride::test::onCircle;
using stride::test::poweredAxis;
using stride::test::Random;
using stride::test::shortWay;
namespace state = stride::axis::state;
namespace pl = ::st::SM_PLCopen;
using stride::axis::AxisRef;

constexpr double kVelocity = 100;
constexpr double kAcceleration = 2000;
constexpr double kJerk = 60000;

/// A motion whose velocity changes with half of the limits, over any number of turns.
class Leader {
public:
  Leader(Random &random, double start) : position(start), random_(random) {}

  void next() {
    if (random_.chance(0.01))
      wanted_ = random_.chance(0.2) ? 0 : random_.uniform(-0.8, 0.8) * kVelocity;
    const double T = kGearCycle;
    const double aim =
        std::clamp((wanted_ - velocity) / (20 * T), -0.5 * kAcceleration, 0.5 * kAcceleration);
    const double before = acceleration;
    acceleration += std::clamp(aim - acceleration, -0.4 * kJerk * T, 0.4 * kJerk * T);
    const double last = velocity;
    velocity += 0.5 * (before + acceleration) * T;
    position += last * T + before * T * T / 3 + acceleration * T * T / 6;
  }

  double position;
  double velocity = 0;
  double acceleration = 0;

private:
  Random &random_;
  double wanted_ = 0;
};

double drawPeriod(Random &random) {
  return random.chance(0.4) ? 0 : random.chance(0.5) ? 360 : random.uniform(20, 50);
}

double shown(double position, double period) {
  return period > 0 ? onCircle(position, period) : position;
}

/// How far apart two positions are on an axis.
double apart(double a, double b, double period) {
  return period > 0 ? std::fabs(shortWay(a - b, period)) : std::fabs(a - b);
}

/// The axis in the cycle after (p, v, a) has kept to the limits.
void expectStep(const AxisRef &axis, double p, double v, double a, double velocity,
                double acceleration, double jerk, double period) {
  const double T = kGearCycle;
  ASSERT_LE(std::fabs(axis.fSetVelocity), velocity * (1 + 1e-6));
  ASSERT_LE(std::fabs(axis.fSetVelocity - v), acceleration * T * (1 + 1e-6) + 1e-9);
  if (axis.eRampType != 0) {
    ASSERT_LE(std::fabs(axis.fSetAcceleration - a), jerk * T * (1 + 1e-5) + 1e-6);
  }
  const double expected = 0.5 * (v + axis.fSetVelocity) * T;
  ASSERT_LE(apart(axis.fSetPosition, p + expected, period), 0.5 * acceleration * T * T + 1e-9);
  ASSERT_NEAR(axis.fTravel, expected, 0.5 * acceleration * T * T + 1e-9);
}

class Tracking : public ::testing::TestWithParam<int> {};

TEST_P(Tracking, TheSlaveGetsToItsMasterAndStays) {
  int inSync = 0;
  for (uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed * 7 + 1);
    const double masterPeriod = drawPeriod(random);
    const double period = drawPeriod(random);
    auto master = poweredAxis(masterPeriod);
    auto slave = poweredAxis(period);
    slave.eRampType = static_cast<int16_t>(GetParam());
    slave.fJerk = kJerk;
    Leader leader(random, shown(random.uniform(-20, 20), masterPeriod));
    slave.fSetPosition = shown(leader.position + random.uniform(-10, 10), period);
    auto track = fresh<pl::SMC_TrackAxis>();
    track.Master = &master;
    track.Slave = &slave;
    track.bExecute = 1;
    track.Velocity = kVelocity;
    track.Acceleration = track.Deceleration = kAcceleration;
    stride::Ctx ctx{};
    for (int i = 0; i < 3000 && !HasFailure(); ++i) {
      master.fSetPosition = shown(leader.position, masterPeriod);
      master.fSetVelocity = leader.velocity;
      master.fSetAcceleration = leader.acceleration;
      const double p = slave.fSetPosition;
      const double v = slave.fSetVelocity;
      const double a = slave.fSetAcceleration;
      slave.bMovedInThisCycle = 0;
      track.body__(ctx);
      ASSERT_EQ(track.bBusy, 1) << track.iErrorID;
      ASSERT_EQ(slave.nAxisState, state::kSynchronized);
      expectStep(slave, p, v, a, kVelocity, kAcceleration, kJerk, period);
      if (track.bInSync != 0) {
        ++inSync;
        // From its place at the first look on the slave goes all of the master's ways.
        ASSERT_LE(apart(slave.fSetPosition, leader.position, period), 1e-8);
        ASSERT_EQ(slave.fSetVelocity, leader.velocity);
      } else {
        ASSERT_LT(i, 2000);
      }
      leader.next();
    }
  }
  EXPECT_GT(inSync, 40 * 1500);
}

TEST_P(Tracking, ASignalWithAPeriodOfItsOwn) {
  int inSync = 0;
  for (uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed * 11 + 3);
    const double signalPeriod = drawPeriod(random);
    const double period = drawPeriod(random);
    auto axis = poweredAxis(period);
    axis.eRampType = static_cast<int16_t>(GetParam());
    Leader leader(random, shown(random.uniform(-20, 20), signalPeriod));
    axis.fSetPosition = shown(leader.position + random.uniform(-10, 10), period);
    auto track = fresh<pl::SMC_TrackSetValues>();
    track.Axis = &axis;
    track.bExecute = 1;
    track.Velocity = kVelocity;
    track.Acceleration = track.Deceleration = kAcceleration;
    track.Jerk = kJerk;
    track.SignalModuloPeriod = signalPeriod;
    stride::Ctx ctx{};
    for (int i = 0; i < 3000 && !HasFailure(); ++i) {
      track.fSetPosition = shown(leader.position, signalPeriod);
      track.fSetVelocity = leader.velocity;
      track.fSetAcceleration = leader.acceleration;
      const double p = axis.fSetPosition;
      const double v = axis.fSetVelocity;
      const double a = axis.fSetAcceleration;
      axis.bMovedInThisCycle = 0;
      track.body__(ctx);
      ASSERT_EQ(track.bBusy, 1) << track.iErrorID;
      expectStep(axis, p, v, a, kVelocity, kAcceleration, kJerk, period);
      if (track.bInSync != 0) {
        ++inSync;
        // From the first place on the axis goes all of the signal's ways.
        ASSERT_LE(apart(axis.fSetPosition, leader.position, period), 1e-8);
      } else {
        ASSERT_LT(i, 2000);
      }
      leader.next();
    }
  }
  EXPECT_GT(inSync, 40 * 1500);
}

TEST_P(Tracking, LimitsMayChangeInEveryCall) {
  auto axis = poweredAxis(0);
  axis.eRampType = static_cast<int16_t>(GetParam());
  axis.fJerk = kJerk;
  auto track = fresh<pl::SMC_TrackSetValues>();
  track.Axis = &axis;
  track.bExecute = 1;
  track.Velocity = 20;
  track.Acceleration = track.Deceleration = 400;
  track.fSetPosition = 50;
  stride::Ctx ctx{};
  const auto cycles = [&](int count) {
    double fastest = 0;
    for (int i = 0; i < count; ++i) {
      axis.bMovedInThisCycle = 0;
      track.body__(ctx);
      fastest = std::max(fastest, axis.fSetVelocity);
    }
    return fastest;
  };
  EXPECT_NEAR(cycles(500), 20, 1e-9);
  track.Velocity = 5;
  cycles(200);
  EXPECT_NEAR(axis.fSetVelocity, 5, 1e-9);
  track.Velocity = 30;
  EXPECT_NEAR(cycles(500), 30, 1e-9);
  cycles(2000);
  EXPECT_EQ(axis.fSetPosition, 50);
  EXPECT_EQ(track.bInSync, 1);
  track.Velocity = 0;
  cycles(1);
  EXPECT_EQ(track.iErrorID, stride::axis::error::kInvalidParameter);
}

TEST_P(Tracking, TheBacklashIsMadeUpForOnTheSideOfTheMotion) {
  int settled = 0;
  int reversals = 0;
  for (uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed * 5 + 2);
    const double period = drawPeriod(random);
    auto master = poweredAxis(period);
    auto slave = poweredAxis(period);
    slave.eRampType = static_cast<int16_t>(GetParam());
    slave.fJerk = 200000;
    Leader leader(random, random.uniform(-20, 20));
    slave.fSetPosition = shown(leader.position, period);
    auto block = fresh<pl::SMC_BacklashCompensation>();
    block.Master = &master;
    block.Slave = &slave;
    block.bExecute = 1;
    block.fBacklash = random.uniform(0.1, 0.7);
    block.fCompensationVel = random.uniform(5, 20);
    block.fCompensationAcc = random.uniform(500, 900);
    block.fCompensationDec = random.uniform(500, 900);
    block.eBacklashMode = static_cast<int16_t>(random.below(4) - 1);
    block.eBacklashStartState = static_cast<int16_t>(random.below(3) - 1);
    stride::Ctx ctx{};
    int direction = 0;
    double relative = 0;
    for (int i = 0; i < 3000 && !HasFailure(); ++i) {
      leader.next();
      master.fSetPosition = shown(leader.position, period);
      master.fSetVelocity = leader.velocity;
      master.fSetAcceleration = leader.acceleration;
      const int before = direction;
      if (leader.velocity != 0)
        direction = leader.velocity > 0 ? 1 : -1;
      reversals += before * direction < 0 ? 1 : 0;
      slave.bMovedInThisCycle = 0;
      block.body__(ctx);
      ASSERT_EQ(block.stBlock.bRunning, 1) << block.stBlock.iError;
      const double velocity = slave.fSetVelocity - leader.velocity;
      const double swing = GetParam() == 1 ? 900 * 900 * M_PI * M_PI / 8 / 200000 : 0;
      ASSERT_LE(std::fabs(velocity), block.fCompensationVel * (1 + 1e-9) + swing);
      ASSERT_LE(std::fabs(velocity - relative),
                900 * kGearCycle * (GetParam() == 1 ? M_PI / 2 : 1) + 1e-9);
      relative = velocity;
      if (block.bCompensating != 0)
        continue;
      ++settled;
      const int mode = block.eBacklashMode;
      const int wanted = mode == pl::SMC_BACKLASH_MODE__SMC_BL_AUTO ? direction : mode;
      const int side = wanted == 0 ? 0 : wanted - block.eBacklashStartState;
      ASSERT_LE(apart(slave.fSetPosition, leader.position + side * block.fBacklash, period), 1e-9)
          << "mode " << mode << " direction " << direction << " start "
          << block.eBacklashStartState;
      ASSERT_EQ(slave.fSetVelocity, leader.velocity);
    }
  }
  EXPECT_GT(settled, 40 * 1000);
  EXPECT_GT(reversals, 100);
}

TEST(Backlash, WrongInputsAreRefusedAndASlaveElsewhereGoesToItsMaster) {
  auto master = poweredAxis(0);
  auto slave = poweredAxis(0);
  slave.fSetPosition = 3;
  auto block = fresh<pl::SMC_BacklashCompensation>();
  block.Master = &master;
  block.Slave = &slave;
  block.fBacklash = 0.25;
  block.fCompensationVel = 10;
  block.fCompensationAcc = block.fCompensationDec = 100;
  stride::Ctx ctx{};
  const auto edge = [&] {
    block.bExecute = 0;
    block.body__(ctx);
    block.bExecute = 1;
    slave.bMovedInThisCycle = 0;
    block.body__(ctx);
  };
  for (double *input : {&block.fBacklash, &block.fCompensationVel, &block.fCompensationAcc,
                        &block.fCompensationDec})
    for (const double bad : {-1.0, static_cast<double>(NAN)}) {
      const double good = *input;
      *input = bad;
      edge();
      EXPECT_EQ(block.stBlock.iError, stride::axis::error::kInvalidParameter);
      *input = good;
    }
  edge();
  EXPECT_EQ(block.bCompensating, 1);
  for (int i = 0; i < 1000; ++i) {
    slave.bMovedInThisCycle = 0;
    block.body__(ctx);
  }
  EXPECT_EQ(block.bCompensating, 0);
  EXPECT_EQ(slave.fSetPosition, 0);
}

INSTANTIATE_TEST_SUITE_P(Ramps, Tracking, ::testing::Range(0, 4));

} // namespace
