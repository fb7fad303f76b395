// MC_GearIn against a plain model: within its limits until it is in gear, then the ratio of the
// positions in every cycle.
#include "cam_scene.hpp"

#include "st/SM_PLCopen/MC_GearIn.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <string>

namespace {

using namespace stride::test;
namespace pl = ::st::SM_PLCopen;
namespace state = stride::axis::state;

/// A slave, a master and MC_GearIn.
struct GearScene {
  AxisRig rig{kCamCycle};
  ModelMaster master;
  pl::MC_GearIn gear = fresh<pl::MC_GearIn>();

  GearScene(double masterPeriod, double slavePeriod) : master(kCamCycle, masterPeriod) {
    rig.axis.dwRatioTechUnitsDenom = 100;
    rig.axis.fSWMaxDeceleration = 1e6;
    if (slavePeriod > 0)
      rig.makeRotary(slavePeriod);
    gear.Master = &master.ref;
    gear.Slave = &rig.axis;
  }

  [[nodiscard]] long double wayFrom(long double position) const {
    const long double way = rig.axis.fSetPosition - position;
    if (rig.axis.iMovementType != 0)
      return way;
    const long double period = rig.axis.fPositionPeriod;
    return way - period * std::round(way / period);
  }
};

struct GearCounts {
  int engaged = 0, never = 0, inGear = 0, moving = 0, shifts = 0;
};

class GearCase {
public:
  GearCase(uint64_t seed, int16_t ramp, GearCounts &counts)
      : random_(seed), ramp_(ramp), counts_(counts),
        masterPeriod_(random_.chance(0.5) ? random_.magnitude(-1, 3) : 0),
        slavePeriod_(random_.chance(0.5) ? random_.magnitude(-1, 3) : 0),
        scene_(masterPeriod_, slavePeriod_) {}

  void run() {
    AxisRig &rig = scene_.rig;
    auto &gear = scene_.gear;
    // Velocities of the slave so that the way of a cycle can be told on a rotary one.
    top_ = (slavePeriod_ > 0 ? slavePeriod_ : random_.magnitude(-1, 3)) / kCamCycle *
           random_.magnitude(-4, -1);
    const double seconds = kCamCycle * random_.magnitude(0.5, 2.5);
    acceleration_ = top_ / seconds;
    deceleration_ = random_.chance(0.3) ? acceleration_ : acceleration_ * random_.magnitude(-1, 1);
    jerk_ = std::max(acceleration_, deceleration_) / seconds * random_.magnitude(-0.5, 1);
    gear.RatioNumerator = random_.below(2001) - 1000;
    gear.RatioDenominator = static_cast<uint32_t>(1 + random_.below(1000));
    if (random_.chance(0.2))
      gear.RatioNumerator = 1, gear.RatioDenominator = 1;
    ratio_ = static_cast<long double>(gear.RatioNumerator) / gear.RatioDenominator;
    gear.Acceleration = acceleration_;
    gear.Deceleration = deceleration_;
    rig.axis.eRampType = ramp_;
    gear.Jerk = jerk_;
    ASSERT_GT(rig.powerUp(), 0);
    const long double masterTop =
        gear.RatioNumerator == 0 ? 1 : std::fabs(top_ / ratio_) * random_.uniform(0, 1);
    const bool even = random_.chance(0.5); // the master, until the slave is in gear
    MasterCourse course(random_, 1);
    double velocity = static_cast<double>(masterTop) * random_.uniform(-1, 1);
    double rate = static_cast<double>(masterTop) * random_.magnitude(-3, -0.5);
    masterA_ = std::fabs(ratio_) * rate / kCamCycle;
    double wanted = velocity;
    const auto pace = [&](bool held) {
      if (!held) {
        if (random_.chance(0.03))
          wanted =
              random_.chance(0.2) ? 0 : static_cast<double>(masterTop) * random_.uniform(-1, 1);
        velocity += std::clamp(wanted - velocity, -rate, rate);
      }
      scene_.master.step(velocity);
    };
    scene_.master.place(random_.uniform(-100, 100));
    auto move = fresh<pl::MC_MoveVelocity>();
    move.Axis = &rig.axis;
    move.Velocity = top_ * random_.uniform(0, 1);
    move.Acceleration = move.Deceleration = acceleration_;
    move.Jerk = jerk_;
    move.Direction = random_.chance(0.5) ? 1 : -1;
    const bool moves = random_.chance(0.5);
    counts_.moving += moves;
    for (int i = 0; i < 20; ++i)
      rig.cycle([&] {
        pace(true);
        if (moves)
          rig.call(move, true);
      });
    note_ = "ratio " + std::to_string(gear.RatioNumerator) + "/" +
            std::to_string(gear.RatioDenominator) + " A " + std::to_string(acceleration_) + " D " +
            std::to_string(deceleration_) + " J " + std::to_string(jerk_) + " v0 " +
            std::to_string(rig.axis.fSetVelocity) + " master " + std::to_string(velocity) +
            (even ? " even" : " varying") + " periods " + std::to_string(masterPeriod_) + " " +
            std::to_string(slavePeriod_) + (moves ? " moving" : "");
    SCOPED_TRACE(note_);
    const double change = 2 * top_;
    const int longest = static_cast<int>((change / acceleration_ + change / deceleration_ +
                                          4 * (acceleration_ + deceleration_) / jerk_ +
                                          4 * std::sqrt(change / jerk_)) /
                                         kCamCycle) +
                        20;
    const int cycles = std::min(longest, 5000) + 60;
    p_ = rig.axis.fSetPosition;
    v_ = rig.axis.fSetVelocity;
    a_ = rig.axis.fSetAcceleration;
    int in = 0;
    for (int cycle = 0; cycle < cycles && in < 60 && !testing::Test::HasFatalFailure(); ++cycle) {
      SCOPED_TRACE("cycle " + std::to_string(cycle));
      rig.cycle([&] {
        pace(even && in == 0);
        if (random_.chance(0.02)) {
          scene_.master.setPosition(random_.uniform(-100, 100), random_.chance(0.5));
          ++counts_.shifts;
        }
        rig.call(gear, true);
        step(in > 0, even);
      });
      in += gear.InGear ? 1 : 0;
    }
    counts_.engaged += in > 0;
    counts_.never += in == 0;
    counts_.inGear += in;
    if (even && cycles > longest) {
      ASSERT_GT(in, 0) << "not in gear after " << longest << " cycles";
    }
  }

private:
  void step(bool wasIn, bool even) {
    const auto &axis = scene_.rig.axis;
    const auto &gear = scene_.gear;
    const auto &master = scene_.master;
    const long double T = kCamCycle;
    ASSERT_EQ(gear.ErrorID, 0);
    ASSERT_TRUE(gear.Busy);
    ASSERT_TRUE(gear.Active);
    ASSERT_EQ(axis.nAxisState, state::kSynchronized);
    const long double demanded = ratio_ * master.velocity();
    const long double slackV = 1e-9L * (top_ + std::fabs(demanded));
    if (wasIn) {
      ASSERT_TRUE(gear.InGear) << "out of gear";
      const long double wanted = slave0_ + ratio_ * (master.total() - master0_);
      const long double tolerance =
          1e-9L * (top_ * T * 100 + axis.fPositionPeriod * (slavePeriod_ > 0)) +
          std::fabs(ratio_) * master.haze() + 1e-14L * std::fabs(wanted);
      ASSERT_LE(std::fabs(scene_.wayFrom(wanted)), tolerance) << "off the ratio";
      ASSERT_LE(std::fabs(axis.fSetVelocity - demanded), slackV);
      ASSERT_LE(std::fabs(axis.fSetAcceleration - ratio_ * master.acceleration()),
                1e-6L * std::fabs(ratio_ * master.acceleration()) + slackV / T);
      return;
    }
    // Until then, and in the cycle in which it gets into gear: smooth and within the limits.
    const long double v = axis.fSetVelocity;
    const long double a = (std::fabs(v) - std::fabs(v_)) / T;
    const long double sine = (ramp_ == 1 ? 1.5708L : 1) * (1 + 1e-6L);
    // In the cycle in which it gets into gear it follows the master's acceleration for a part; with
    // a limited jerk it ramps in relation to the master.
    const long double masters = std::fabs(ratio_ * master.acceleration()) * (1 + 1e-6L);
    long double most = std::max(acceleration_, deceleration_) * sine;
    if (gear.InGear)
      most = std::max(most, masters);
    const long double way = scene_.wayFrom(p_);
    if (v * v_ >= 0 && ramp_ == 0 && !gear.InGear) {
      ASSERT_LE(a, acceleration_ * sine + slackV / T) << "accelerates too much";
      ASSERT_GE(a, -deceleration_ * sine - slackV / T) << "brakes too much";
    }
    if (v * v_ < 0 && ramp_ == 0 && !gear.InGear) { // it brakes to 0 and accelerates from there
      ASSERT_LE(std::fabs(v_) / deceleration_ + std::fabs(v) / acceleration_,
                T * (1 + 1e-6L) + slackV / std::min(acceleration_, deceleration_))
          << "turns round too quickly";
    }
    ASSERT_LE(std::fabs(v - v_), most * T + slackV) << "velocity jumps";
    ASSERT_LE(std::fabs(way - T * (v + v_) / 2),
              most * T * T / 2 + 1e-12L * axis.fPositionPeriod +
                  1e-14L * std::fabs(static_cast<long double>(axis.fSetPosition)) + slackV * T)
        << "position jumps";
    if (ramp_ == 2 && even && !gear.InGear) {
      ASSERT_LE(std::fabs(axis.fSetAcceleration - a_), jerk_ * T * (1 + 1e-6L) + 1e-6L * most)
          << "acceleration jumps";
    }
    if (gear.InGear) {
      ASSERT_LE(std::fabs(v - demanded), slackV);
      master0_ = master.total();
      slave0_ = axis.fSetPosition;
    } else if (even) {
      ASSERT_GT(
          std::fabs(v - demanded) + std::fabs(static_cast<long double>(axis.fSetAcceleration)), 0)
          << "in gear, but does not say so";
    }
    p_ = axis.fSetPosition;
    v_ = v;
    a_ = axis.fSetAcceleration;
  }

  Random random_;
  int16_t ramp_;
  GearCounts &counts_;
  double masterPeriod_, slavePeriod_;
  GearScene scene_;
  double top_ = 0, acceleration_ = 0, deceleration_ = 0, jerk_ = 0;
  long double masterA_ = 0, ratio_ = 1, p_ = 0, v_ = 0, a_ = 0, master0_ = 0, slave0_ = 0;
  std::string note_;
};

class GearModelRamps : public testing::TestWithParam<int> {};

TEST_P(GearModelRamps, LeadIntoGearAndThePositionsKeepTheRatio) {
  GearCounts counts;
  const int cases = casesOf(1500);
  for (int i = 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(i));
    GearCase(static_cast<uint64_t>(i), static_cast<int16_t>(GetParam()), counts).run();
  }
  std::cout << counts.engaged << " in gear, " << counts.never << " never, " << counts.inGear
            << " cycles in gear, " << counts.moving << " of a moving slave, " << counts.shifts
            << " shifts\n";
  EXPECT_GT(counts.engaged, cases / 2);
}

INSTANTIATE_TEST_SUITE_P(Ramps, GearModelRamps, testing::Values(0, 1, 2, 3),
                         [](const auto &info) { return "Ramp" + std::to_string(info.param); });

TEST(GearModel, HundredMillionTurnsDoNotDrift) {
  GearScene scene(360, 270);
  scene.gear.RatioNumerator = 355;
  scene.gear.RatioDenominator = 113;
  scene.gear.Acceleration = scene.gear.Deceleration = 1e12;
  ASSERT_GT(scene.rig.powerUp(), 0);
  ModelMaster &master = scene.master;
  long double master0 = 0;
  long double slave0 = 0;
  for (int k = 0; k < 12000 && !HasFailure(); ++k)
    scene.rig.cycle([&] {
      const double part = k < 10     ? 0
                          : k < 6000 ? std::min({k - 10, 500, 6000 - k}) / 500.0
                                     : -std::min({k - 6000, 500, 12000 - k}) / 500.0;
      master.step(part * 20000.3 * 360 / kCamCycle);
      scene.rig.call(scene.gear, true);
      ASSERT_EQ(scene.gear.InGear != 0, k >= 0) << k;
      if (k == 0) {
        master0 = master.total();
        slave0 = scene.rig.axis.fSetPosition;
      }
      // Modulo 270 in whole numbers: 355/113 * m; 113 * 270 divides what is left out.
      long double m = std::fmod(master.total() - master0, 113 * 270.0L);
      const long double wanted = slave0 + std::fmod(m * 355, 113 * 270.0L) / 113;
      ASSERT_LE(std::fabs(scene.wayFrom(wanted)), 1e-6L) << k;
    });
}

TEST(GearModel, RefusesWrongInputs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  struct Wrong {
    uint32_t denominator;
    double acceleration, deceleration;
    int error;
  };
  for (const Wrong &wrong : {Wrong{0, 10, 10, 675},
                             {1, 0, 10, 676},
                             {1, -1, 10, 676},
                             {1, nan, 10, 676},
                             {1, inf, 10, 676},
                             {1, 10, 0, 677},
                             {1, 10, -5, 677},
                             {1, 10, nan, 677},
                             {1, 10, inf, 677}}) {
    GearScene scene(0, 0);
    ASSERT_GT(scene.rig.powerUp(), 0);
    scene.gear.RatioDenominator = wrong.denominator;
    scene.gear.Acceleration = wrong.acceleration;
    scene.gear.Deceleration = wrong.deceleration;
    scene.rig.cycle([&] {
      scene.master.step(10);
      scene.rig.call(scene.gear, true);
    });
    EXPECT_EQ(scene.gear.ErrorID, wrong.error);
    EXPECT_FALSE(scene.gear.Busy);
    EXPECT_EQ(scene.rig.axis.nAxisState, state::kStandstill);
    EXPECT_EQ(scene.rig.axis.fSetPosition, 0);
  }
}

} // namespace
