#include "runtime/axis/increments.hpp"

#include "tests/support/kinematics.hpp"
#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using stride::axis::AxisRef;
using stride::axis::configureScaling;
using stride::axis::ScalingError;
using stride::axis::synchronizePosition;
using stride::axis::updateActual;
using stride::axis::updateSet;
using stride::test::fresh;

AxisRef linear(uint32_t denominator, int16_t numerator) {
  AxisRef axis = fresh<AxisRef>();
  axis.dwRatioTechUnitsDenom = denominator;
  axis.iRatioTechUnitsNum = numerator;
  EXPECT_EQ(configureScaling(axis), ScalingError::None);
  return axis;
}

AxisRef rotary(uint32_t denominator, int16_t numerator, double period) {
  AxisRef axis = fresh<AxisRef>();
  axis.dwRatioTechUnitsDenom = denominator;
  axis.iRatioTechUnitsNum = numerator;
  axis.iMovementType = 0;
  axis.fPositionPeriod = period;
  EXPECT_EQ(configureScaling(axis), ScalingError::None);
  return axis;
}

// Values of the manual's drive configuration example (section 11.2).
TEST(Increments, LinearExample) {
  AxisRef axis = linear(10000, 1);
  axis.fSetPosition = 1.0;
  EXPECT_TRUE(updateSet(axis, 0));
  EXPECT_EQ(axis.liSetIncrements, 10000);
  axis.fSetPosition = -500.0;
  EXPECT_TRUE(updateSet(axis, 0));
  EXPECT_EQ(axis.liSetIncrements, -5000000);
  updateActual(axis, 5000000);
  EXPECT_EQ(axis.fActPosition, 500.0);
}

TEST(Increments, RotaryExample) {
  AxisRef axis = rotary(65536, 360, 360);
  EXPECT_EQ(axis.liTurnIncrements, 65536);
  EXPECT_EQ(axis.liTurnRest, 0);
  EXPECT_EQ(axis.dwOneTurn, 65536U);
  synchronizePosition(axis, 0);
  updateActual(axis, 16384);
  EXPECT_EQ(axis.fActPosition, 90.0);
  updateActual(axis, 1);
  EXPECT_EQ(axis.fActPosition, 0.0054931640625);
  updateActual(axis, 65536 + 32768);
  EXPECT_EQ(axis.fActPosition, 180.0);
  updateActual(axis, static_cast<uint32_t>(-16384));
  EXPECT_EQ(axis.fActPosition, 270.0);
}

TEST(Increments, ScalingErrors) {
  AxisRef axis = fresh<AxisRef>();
  axis.dwRatioTechUnitsDenom = 0;
  EXPECT_EQ(configureScaling(axis), ScalingError::ZeroRatio);
  axis.dwRatioTechUnitsDenom = 1;
  axis.iRatioTechUnitsNum = 0;
  EXPECT_EQ(configureScaling(axis), ScalingError::ZeroRatio);
  axis.iRatioTechUnitsNum = 1;
  axis.iMovementType = 0;
  axis.fPositionPeriod = 0x1p31;
  EXPECT_EQ(configureScaling(axis), ScalingError::None);
  axis.fPositionPeriod = 0x1p31 + 1;
  EXPECT_EQ(configureScaling(axis), ScalingError::PeriodTooLarge);
  axis.fPositionPeriod = 0;
  EXPECT_EQ(configureScaling(axis), ScalingError::BadPeriod);
  axis.fPositionPeriod = std::nan("");
  EXPECT_EQ(configureScaling(axis), ScalingError::BadPeriod);
}

TEST(Increments, LinearRange) {
  AxisRef axis = linear(10000, 1);
  axis.fSetPosition = 7e9;
  EXPECT_TRUE(updateSet(axis, 0));
  EXPECT_EQ(axis.liSetIncrements, 70000000000000);
  axis.fSetPosition = 8e9;
  EXPECT_FALSE(updateSet(axis, 0));
  EXPECT_EQ(axis.liSetIncrements, 70000000000000);
}

TEST(Increments, CounterWrapsOnALinearAxis) {
  AxisRef axis = linear(1, 1);
  synchronizePosition(axis, 0x7FFFFFF0);
  updateActual(axis, 0x80000010);
  EXPECT_EQ(axis.fActPosition, 2147483664.0);
}

// A turn that is not a whole number of increments: after any number of turns the position is still
// that of exact arithmetic.
TEST(Increments, ResidualsAreExactOverManyTurns) {
  struct Case {
    uint32_t denominator;
    int16_t numerator;
    double period;
  };
  for (const Case c : {Case{10000, 3, 100}, Case{65536, 7, 360}, Case{1, 3, 10}, Case{1000, 1, 0.1},
                       Case{4000000000U, 32767, 1e-3}, Case{4000000000U, 1, 1e-7}}) {
    AxisRef axis = rotary(c.denominator, c.numerator, c.period);
    synchronizePosition(axis, 0);
    const long double perTurn = static_cast<long double>(c.period) * c.denominator / c.numerator;
    double place = 0;
    int64_t turns = 0;
    const double step = 0.377 * c.period;
    for (int i = 0; i < 300000; ++i) {
      const double travel = i < 200000 ? step : -1.3 * step;
      place += travel;
      const auto passed = static_cast<int64_t>(std::floor(place / c.period));
      turns += passed;
      place -= static_cast<double>(passed) * c.period;
      if (place < 0 || place >= c.period)
        place = 0;
      axis.fSetPosition = place;
      ASSERT_TRUE(updateSet(axis, travel));
      const long double exact = static_cast<long double>(turns) * perTurn +
                                static_cast<long double>(place) * c.denominator / c.numerator;
      ASSERT_LE(std::fabs(static_cast<long double>(axis.liSetIncrements) - exact), 0.5001L)
          << "period " << c.period << " turn " << turns;
      updateActual(axis, static_cast<uint32_t>(axis.liSetIncrements));
      ASSERT_EQ(axis.liActIncrements, axis.liSetIncrements);
      // Half an increment, and modulo the period.
      ASSERT_NEAR(stride::test::shortWay(axis.fActPosition - place, c.period), 0.0,
                  0.5001 * c.numerator / c.denominator);
    }
  }
}

} // namespace
