// Gears: exact in any number of turns, back on the same way, limits of the ramp.
#include "gear_blocks.hpp"
#include "gear_scene.hpp"
#include "motion_problems.hpp"

#include "st/SM_PLCopen/MC_GearIn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace {

using stride::test::bind;
using stride::test::call;
using stride::test::casesOf;
using stride::test::kGearCycle;
using stride::test::kTick;
using stride::test::positiveRest;
using stride::test::poweredAxis;
using stride::test::Random;
using stride::test::RunningMaster;
using stride::test::TickMaster;
using stride::test::Wide;
using AxisRef = stride::axis::AxisRef;
using GearIn = ::st::SM_PLCopen::MC_GearIn;

int64_t randomPeriod(Random &random) {
  return random.chance(0.3) ? 0 : static_cast<int64_t>(random.magnitude(2, 6));
}

/// What a slave in gear must show: whole ticks, exactly, then rounded once.
struct ExactGear {
  Wide numerator, denominator;
  int64_t slavePeriod;
  Wide start; ///< Of the slave, in ticks.

  [[nodiscard]] double position(Wide driven) const {
    Wide total = start * denominator + driven * numerator;
    if (slavePeriod > 0)
      total = positiveRest(total, slavePeriod * denominator);
    return static_cast<double>(static_cast<long double>(total) /
                               static_cast<long double>(denominator)) *
           kTick;
  }
};

double off(double is, double should, int64_t period) {
  double difference = is - should;
  if (period > 0)
    difference = std::remainder(difference, static_cast<double>(period) * kTick);
  return std::fabs(difference);
}

struct Course {
  Random random;
  TickMaster master;
  int64_t slavePeriod;
  AxisRef slave;
  GearIn gear;
  ExactGear exact;

  explicit Course(uint64_t seed)
      : random(seed), master(randomPeriod(random)), slavePeriod(randomPeriod(random)),
        slave(poweredAxis(static_cast<double>(slavePeriod) * kTick)),
        gear(bind<GearIn>(master.ref, slave)) {
    const int64_t range = slavePeriod > 0 ? slavePeriod : 1000000;
    exact.start = static_cast<int64_t>(random.uniform(0, 1) * static_cast<double>(range - 1));
    exact.slavePeriod = slavePeriod;
    slave.fSetPosition = static_cast<double>(exact.start) * kTick;
    master.ticks = static_cast<int64_t>(random.uniform(-1, 1) * 100000);
    master.show();
    gear.RatioNumerator = static_cast<int32_t>(random.sign() * random.magnitude(0, 6));
    gear.RatioDenominator = static_cast<uint32_t>(random.magnitude(0, 6));
    gear.Acceleration = gear.Deceleration = 100;
    exact.numerator = gear.RatioNumerator;
    exact.denominator = gear.RatioDenominator;
  }

  /// Some ticks, up to several turns, near enough to the last ones for the turns to be counted.
  int64_t way(int64_t last) {
    if (master.period == 0)
      return static_cast<int64_t>(random.sign() * random.magnitude(0, 7));
    const auto change =
        static_cast<int64_t>(random.uniform(-0.95, 0.95) * static_cast<double>(master.period));
    const int64_t most = 2000 * master.period;
    return std::clamp(last + change, -most, most);
  }
};

TEST(GearProperty, ExactInAllPairsOfAxes) {
  for (int seed = 0; seed < casesOf(400); ++seed) {
    Course c(static_cast<uint64_t>(seed));
    SCOPED_TRACE(seed);
    const Wide begin = c.master.ticks;
    call(c.gear, true, c.slave);
    ASSERT_TRUE(c.gear.InGear) << c.gear.ErrorID;
    int64_t last = 0;
    double before = c.slave.fSetPosition;
    for (int i = 0; i < 200; ++i) {
      last = c.way(last);
      c.master.step(last);
      call(c.gear, true, c.slave);
      ASSERT_TRUE(c.gear.InGear && c.gear.Busy && c.gear.Active);
      const double should = c.exact.position(c.master.ticks - begin);
      const double size =
          c.slavePeriod > 0 ? static_cast<double>(c.slavePeriod) * kTick : std::fabs(should) + 1;
      ASSERT_LE(off(c.slave.fSetPosition, should, c.slavePeriod), 4e-16 * size) << "cycle " << i;
      const double ratio = static_cast<double>(c.gear.RatioNumerator) / c.gear.RatioDenominator;
      const double way = static_cast<double>(last) * kTick * ratio;
      ASSERT_NEAR(c.slave.fTravel, way, 1e-15 * (std::fabs(way) + std::fabs(before)) + 1e-18);
      ASSERT_NEAR(c.slave.fSetVelocity, way / kGearCycle, 4e-16 * std::fabs(way) / kGearCycle);
      before = c.slave.fSetPosition;
    }
  }
}

TEST(GearProperty, NoDriftOverAHundredMillionTurns) {
  // 360 u behind 360 u with 1 : 7 and a third one with 100 u: no sum of doubles would stand this.
  for (const int64_t slavePeriod : {int64_t{360 * 1024}, int64_t{100 * 1024}, int64_t{0}}) {
    TickMaster master(360 * 1024);
    AxisRef slave = poweredAxis(static_cast<double>(slavePeriod) * kTick);
    auto gear = bind<GearIn>(master.ref, slave);
    gear.RatioNumerator = 1;
    gear.RatioDenominator = 7;
    gear.Acceleration = gear.Deceleration = 100;
    call(gear, true, slave);
    const ExactGear exact{1, 7, slavePeriod, 0};
    const int64_t way = 100 * master.period + 12345;
    for (int i = 0; i < 1010000; ++i) {
      master.step(std::min(way, i * master.period / 2));
      call(gear, true, slave);
    }
    EXPECT_GT(master.ticks / master.period, 100000000);
    const double should = exact.position(master.ticks);
    const double size = slavePeriod > 0 ? static_cast<double>(slavePeriod) * kTick : should;
    EXPECT_LE(off(slave.fSetPosition, should, slavePeriod), 4e-16 * size);
  }
}

TEST(GearProperty, AMasterThatComesBackLeadsTheSlaveBack) {
  for (int seed = 0; seed < casesOf(200); ++seed) {
    Course c(static_cast<uint64_t>(1000 + seed));
    call(c.gear, true, c.slave);
    std::vector<int64_t> ways;
    std::vector<double> places;
    int64_t last = 0;
    for (int i = 0; i < 100; ++i) {
      places.push_back(c.slave.fSetPosition);
      last = c.way(last);
      // There and back with one reversal, at which the turns can still be counted.
      ways.push_back(i < 99 || c.master.period == 0 ? last : 0);
      c.master.step(ways.back());
      call(c.gear, true, c.slave);
    }
    if (c.master.period > 0 && std::abs(ways[98]) > c.master.period / 3)
      continue; // too fast to turn within a cycle
    for (int i = 99; i >= 0; --i) {
      c.master.step(-ways[static_cast<size_t>(i)]);
      call(c.gear, true, c.slave);
      ASSERT_EQ(c.slave.fSetPosition, places[static_cast<size_t>(i)]) << seed << ", " << i;
    }
  }
}

class GearRamps : public testing::TestWithParam<stride::motion::RampType> {};

TEST_P(GearRamps, KeepTheLimitsAndArrive) {
  const bool smooth = GetParam() != stride::motion::RampType::Trapezoid;
  int arrived = 0;
  for (int seed = 0; seed < casesOf(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<uint64_t>(seed));
    RunningMaster master;
    AxisRef slave = poweredAxis(random.chance(0.5) ? 0 : 100);
    slave.eRampType = static_cast<int8_t>(GetParam());
    auto gear = bind<GearIn>(master.ref, slave);
    gear.RatioNumerator = 1 + random.below(3);
    gear.RatioDenominator = static_cast<uint32_t>(1 + random.below(3));
    const double factor = static_cast<double>(gear.RatioNumerator) / gear.RatioDenominator;
    gear.Acceleration = random.magnitude(1, 3);
    gear.Deceleration = random.chance(0.3) ? gear.Acceleration : random.magnitude(1, 3);
    gear.Jerk = random.magnitude(2, 5);
    const double most = std::max(gear.Acceleration, gear.Deceleration) *
                        (GetParam() == stride::motion::RampType::Sigmoid ? M_PI / 2 : 1.0);
    master.ref.fSetVelocity = random.uniform(-100, 100);
    const bool changing = random.chance(0.5);
    slave.fSetVelocity = random.uniform(-100, 100);
    const double gap = std::fabs(slave.fSetVelocity - factor * master.ref.fSetVelocity);
    int cycles = 0;
    for (; cycles < 100000 && !gear.InGear; ++cycles) {
      const double velocity = slave.fSetVelocity;
      const double acceleration = slave.fSetAcceleration;
      if (changing && random.chance(0.02)) // mostly slower than the slave can, but not always
        master.rate = cycles < 50000 ? random.uniform(-1.2, 1.2) * most / factor : 0;
      master.step();
      call(gear, true, slave);
      ASSERT_FALSE(gear.Error) << gear.ErrorID;
      if (gear.InGear && (changing || smooth))
        break;
      ASSERT_LE(std::fabs(slave.fSetVelocity - velocity), most * kGearCycle * (1 + 1e-9) + 1e-9)
          << "cycle " << cycles;
      if (!changing) {
        ASSERT_LE(std::fabs(slave.fSetAcceleration), most * (1 + 1e-9) + 1e-9);
        if (smooth && GetParam() == stride::motion::RampType::Parabolic) {
          ASSERT_LE(std::fabs(slave.fSetAcceleration - acceleration),
                    gear.Jerk * kGearCycle * (1 + 1e-6) + 1e-9);
        }
      }
    }
    ASSERT_TRUE(gear.InGear);
    ++arrived;
    if (!smooth && !changing && gear.Acceleration == gear.Deceleration) {
      EXPECT_NEAR(cycles, gap / gear.Acceleration / kGearCycle, 1.01);
    }
    EXPECT_EQ(slave.fSetVelocity, factor * master.ref.fSetVelocity);
    // From here on the ways are in the ratio.
    const double slaveAt = slave.fSetPosition;
    const double masterAt = master.ref.fSetPosition;
    for (int i = 0; i < 100; ++i) {
      master.step();
      call(gear, true, slave);
    }
    const double way = slave.fSetPosition - slaveAt;
    EXPECT_LE(std::fabs(std::remainder(way - factor * (master.ref.fSetPosition - masterAt),
                                       slave.iMovementType == 0 ? 100.0 : 1e9)),
              1e-12 * (std::fabs(slaveAt) + std::fabs(way) + std::fabs(factor * masterAt) + 100));
  }
  EXPECT_EQ(arrived, casesOf(300));
}

INSTANTIATE_TEST_SUITE_P(Ramps, GearRamps, testing::ValuesIn(stride::test::kRampTypes),
                         stride::test::rampName);

} // namespace
