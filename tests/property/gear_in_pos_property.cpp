// MC_GearInPos and MC_Phasing with random data: the way to the place is smooth, and ends there.
#include "gear_blocks.hpp"
#include "gear_scene.hpp"
#include "motion_problems.hpp"

#include "st/SM_PLCopen/MC_GearInPos.h"
#include "st/SM_PLCopen/MC_Phasing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using stride::test::bind;
using stride::test::call;
using stride::test::casesOf;
using stride::test::poweredAxis;
using stride::test::Random;
using stride::test::RunningMaster;
using AxisRef = stride::axis::AxisRef;
using GearInPos = ::st::SM_PLCopen::MC_GearInPos;
using Phasing = ::st::SM_PLCopen::MC_Phasing;

/// The quintic over [0, h] through both ends, told anew in long double.
struct PlainQuintic {
  long double h, y0, v0, a0, y1, v1, a1;

  void at(long double x, long double &y, long double &v, long double &a) const {
    // Newton's divided differences with the places 0, 0, 0, h, h, h.
    const long double d = (y1 - y0) / h;
    const long double c2 = a0 / 2;
    const long double e1 = (d - v0) / h;
    const long double e2 = (v1 - d) / h;
    const long double f1 = (e1 - c2) / h;
    const long double f2 = (e2 - e1) / h;
    const long double f3 = (a1 / 2 - e2) / h;
    const long double g1 = (f2 - f1) / h;
    const long double g2 = (f3 - f2) / h;
    const long double k = (g2 - g1) / h;
    const long double z = x - h;
    y = y0 + x * (v0 + x * (c2 + x * (f1 + z * (g1 + z * k))));
    // y = p(x) + x^3 (f1 + z g1 + z^2 k)
    const long double q = f1 + z * (g1 + z * k);
    const long double dq = g1 + 2 * z * k;
    const long double ddq = 2 * k;
    v = v0 + 2 * c2 * x + 3 * x * x * q + x * x * x * dq;
    a = 2 * c2 + 6 * x * q + 6 * x * x * dq + x * x * x * ddq;
  }
};

struct PosSeen {
  int synced = 0, turned = 0, refused = 0, backwards = 0;
};

/// One random coupling with MC_GearInPos.
class Coupling {
public:
  Coupling(uint64_t seed, PosSeen &seen)
      : random_(seed), seen_(seen), masterPeriod_(random_.chance(0.5) ? 0 : 360),
        slavePeriod_(random_.chance(0.5) ? 0 : random_.uniform(20, 500)),
        slave_(poweredAxis(slavePeriod_)), gear_(bind<GearInPos>(master_.ref, slave_)) {
    master_.ref.iMovementType = masterPeriod_ > 0 ? 0 : 1;
    if (masterPeriod_ > 0)
      master_.ref.fPositionPeriod = masterPeriod_;
  }

  void run() {
    const double side = random_.sign();
    master_.ref.fSetVelocity = side * random_.uniform(20, 200);
    master_.rate = random_.chance(0.5) ? 0 : side * random_.uniform(0, 50);
    master_.ref.fSetPosition = random_.uniform(0, 359);
    slave_.fSetPosition =
        slavePeriod_ > 0 ? random_.uniform(0, slavePeriod_ * 0.999) : random_.uniform(-100, 100);
    if (random_.chance(0.6)) {
      slave_.fSetVelocity = random_.uniform(-100, 100);
      slave_.fSetAcceleration = random_.uniform(-100, 100);
    }
    gear_.RatioNumerator = static_cast<int32_t>(random_.sign() * (1 + random_.below(5)));
    gear_.RatioDenominator = 1 + random_.below(5);
    factor_ = static_cast<double>(gear_.RatioNumerator) / gear_.RatioDenominator;
    gear_.SlaveSyncPosition =
        slavePeriod_ > 0 ? random_.uniform(-2, 3) * slavePeriod_ : random_.uniform(-200, 200);
    gear_.MasterSyncPosition = masterPeriod_ > 0
                                   ? random_.uniform(0, 359.9)
                                   : master_.ref.fSetPosition + side * random_.uniform(30, 300);
    gear_.AvoidReversal = random_.chance(0.3);
    const auto from = state();
    masterTotal_ = master_.ref.fSetPosition;
    const long double before[] = {masterTotal_, master_.ref.fSetVelocity,
                                  master_.ref.fSetAcceleration = master_.rate};
    stepMaster();
    call(gear_, true, slave_);
    if (gear_.Error) {
      ASSERT_EQ(gear_.ErrorID, 776);
      ASSERT_TRUE(gear_.AvoidReversal);
      ++seen_.refused;
      return;
    }
    ASSERT_TRUE(gear_.StartSync || gear_.InSync);
    follow(from, before, side);
  }

private:
  struct State {
    double position, velocity, acceleration;
  };

  State state() const {
    return {slave_.fSetPosition, slave_.fSetVelocity, slave_.fSetAcceleration};
  }

  void stepMaster() {
    const double at = master_.ref.fSetPosition;
    master_.step();
    masterTotal_ += static_cast<long double>(master_.ref.fSetPosition) - at;
    if (masterPeriod_ > 0)
      master_.ref.fSetPosition -=
          masterPeriod_ * std::floor(master_.ref.fSetPosition / masterPeriod_);
  }

  void follow(const State &from, const long double *before, double side) {
    // Where they meet.
    long double length = gear_.MasterSyncPosition - before[0];
    if (masterPeriod_ > 0) {
      length = std::fmod(side * length, static_cast<long double>(masterPeriod_));
      length = side * (length <= 0 ? length + masterPeriod_ : length);
    }
    PlainQuintic plain{};
    plain.h = length;
    plain.v0 = from.velocity / before[1];
    plain.a0 = (from.acceleration - plain.v0 * before[2]) / (before[1] * before[1]);
    plain.v1 = factor_;
    const double way = chooseWay(plain, gear_.SlaveSyncPosition - from.position);
    plain.y1 = way;
    long double travelled = slave_.fTravel;
    bool back = false;
    for (int i = 0; i < 100000; ++i) {
      const long double x = masterTotal_ - before[0];
      const bool synced = side * x >= side * length - 1e-9;
      long double y = 0, v = 0, a = 0;
      if (synced) {
        y = plain.y1 + factor_ * (x - length);
        v = factor_;
      } else {
        plain.at(x, y, v, a);
      }
      back = back || v * factor_ < -1e-9L * std::fabs(plain.v1);
      const double velocity = master_.ref.fSetVelocity;
      const double scale = 1 + std::fabs(way) + std::fabs(from.position) +
                           static_cast<double>(std::fabs(plain.v0 * plain.h) +
                                               std::fabs(plain.a0 * plain.h * plain.h));
      const double h = std::fabs(static_cast<double>(length));
      ASSERT_NEAR(static_cast<double>(travelled - y), 0, 1e-11 * scale) << "cycle " << i;
      ASSERT_NEAR(slave_.fSetVelocity, static_cast<double>(v) * velocity,
                  1e-10 * scale * (1 + std::fabs(velocity) / h));
      ASSERT_NEAR(slave_.fSetAcceleration,
                  static_cast<double>(a) * velocity * velocity +
                      static_cast<double>(v) * master_.rate,
                  1e-9 * scale * (1 + velocity * velocity / h / h + 50 / h));
      if (side * x > side * length + 1e-9) {
        ASSERT_TRUE(gear_.InSync && !gear_.StartSync);
        // The place, by the definition of the pins.
        double wrong = slave_.fSetPosition - gear_.SlaveSyncPosition -
                       static_cast<double>(factor_ * (x - length));
        if (slavePeriod_ > 0)
          wrong = std::remainder(wrong, slavePeriod_);
        ASSERT_NEAR(wrong, 0, 1e-11 * (1 + std::fabs(slave_.fSetPosition) + h));
        break;
      }
      ASSERT_TRUE(gear_.Busy && gear_.Active);
      if (random_.chance(0.0005)) {
        turnBack();
        return;
      }
      stepMaster();
      call(gear_, true, slave_);
      ASSERT_FALSE(gear_.Error) << gear_.ErrorID;
      travelled += slave_.fTravel;
    }
    ASSERT_TRUE(gear_.InSync);
    if (gear_.AvoidReversal) {
      ASSERT_FALSE(back);
    }
    seen_.backwards += back ? 1 : 0;
    ++seen_.synced;
  }

  /// A rotary slave turns so that it is nearest to the even way, unless it must not go back.
  double chooseWay(const PlainQuintic &plain, double direct) const {
    if (slavePeriod_ == 0)
      return direct;
    const auto even = static_cast<double>(0.5L * (plain.v0 + plain.v1) * plain.h +
                                          0.075L * plain.a0 * plain.h * plain.h);
    const double found = gear_.stSync.fWay;
    const double turns = (found - direct) / slavePeriod_;
    EXPECT_NEAR(turns, std::round(turns), 1e-9);
    const double nearest = direct + slavePeriod_ * std::round((even - direct) / slavePeriod_);
    if (!gear_.AvoidReversal) {
      EXPECT_NEAR(std::fabs(found - even), std::fabs(nearest - even), 1e-9 * (1 + std::fabs(even)));
    }
    return found;
  }

  void turnBack() {
    master_.ref.fSetVelocity *= -1;
    master_.rate = 0;
    const double at = slave_.fSetPosition;
    stepMaster();
    call(gear_, true, slave_);
    ASSERT_EQ(gear_.ErrorID, 775);
    ASSERT_FALSE(gear_.Busy || gear_.StartSync || gear_.InSync);
    ASSERT_EQ(slave_.fSetPosition, at);
    ASSERT_EQ(slave_.stPlanner.wStopReason, 775);
    ++seen_.turned;
  }

  Random random_;
  PosSeen &seen_;
  RunningMaster master_;
  double masterPeriod_, slavePeriod_;
  AxisRef slave_;
  GearInPos gear_;
  double factor_ = 1;
  long double masterTotal_ = 0;
};

TEST(GearInPosProperty, MeetsThePlaceSmoothly) {
  PosSeen seen;
  for (int seed = 0; seed < casesOf(2000) && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Coupling(static_cast<uint64_t>(seed), seen).run();
  }
  EXPECT_GT(seen.synced, casesOf(500));
  EXPECT_GT(seen.turned, casesOf(50));
  EXPECT_GT(seen.refused, casesOf(50));
  EXPECT_GT(seen.backwards, casesOf(50));
}

TEST(PhasingProperty, ShiftsByWhatItIsTold) {
  for (int seed = 0; seed < casesOf(500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<uint64_t>(seed));
    RunningMaster master;
    const double period = random.chance(0.5) ? 0 : random.uniform(10, 400);
    AxisRef slave = poweredAxis(period);
    slave.eRampType =
        static_cast<int8_t>(stride::test::kRampTypes[static_cast<size_t>(random.below(4))]);
    auto phase = bind<Phasing>(master.ref, slave);
    phase.Velocity = random.magnitude(0, 2);
    phase.Acceleration = random.magnitude(1, 3);
    phase.Deceleration = random.magnitude(1, 3);
    phase.Jerk = random.magnitude(2, 4);
    phase.PhaseShift = random.uniform(-50, 50);
    master.ref.fSetVelocity = random.uniform(-100, 100);
    slave.fSetVelocity = random.uniform(-100, 100);
    int cycles = 0;
    long double lead = 0; // of the slave, since it has the master's velocity
    for (int shift = 0; shift < 2; ++shift) {
      lead = 0;
      for (; cycles < 200000 && !phase.Done; ++cycles) {
        const double at = master.ref.fSetPosition;
        if (random.chance(0.01))
          master.rate = phase.stGear.bEngaged != 0 ? random.uniform(-100, 100) : 0;
        const bool engaged = phase.stGear.bEngaged != 0;
        master.step();
        call(phase, true, slave);
        ASSERT_FALSE(phase.Error) << phase.ErrorID;
        if (engaged) {
          lead += static_cast<long double>(slave.fTravel) - (master.ref.fSetPosition - at);
          ASSERT_LE(std::fabs(slave.fSetVelocity - master.ref.fSetVelocity),
                    phase.Velocity * (1 + 1e-9));
        }
      }
      ASSERT_TRUE(phase.Done);
      EXPECT_NEAR(static_cast<double>(lead), phase.PhaseShift,
                  1e-11 * (100 + std::fabs(master.ref.fSetPosition)));
      EXPECT_NEAR(slave.fSetVelocity, master.ref.fSetVelocity, 1e-10);
      EXPECT_TRUE(phase.Busy);
      // The same again: no ramp is needed.
      master.step();
      call(phase, false, slave);
      EXPECT_FALSE(phase.Done);
    }
  }
}

} // namespace
