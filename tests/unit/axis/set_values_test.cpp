// What is worked out for every axis in every cycle without branches or calls, against the plain
// way.
#include "runtime/axis/axis_cycle.hpp"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/modulo_wrap.hpp"

#include "tests/support/fresh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace {

using stride::axis::AxisRef;
using stride::test::fresh;
namespace axis = stride::axis;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Nearest, IsWhatLlroundGives) {
  std::vector<double> cases = {
      0.0,          -0.0,   0.5,          1.5,        2.5,        0.49999999999999994,
      0x1p46 - 0.5, 0x1p46, 0x1p51 + 0.5, 0x1p52 + 1, 0x1p53 + 2, 0x1p61,
      5e-324};
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> exponent(-3, 47);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::exp2(exponent(engine));
    const double half = std::floor(value) + 0.5;
    for (const double near : {value, half, std::nextafter(half, 0.0), std::nextafter(half, kInf)})
      cases.push_back(near);
  }
  for (const double value : cases) {
    EXPECT_EQ(stride::exact::nearest(value), std::llround(value)) << value;
    EXPECT_EQ(stride::exact::nearest(-value), std::llround(-value)) << -value;
  }
}

/// wrapPosition with fmod everywhere.
double wrapByDivision(double position, double period) {
  double wrapped = std::fmod(position, period);
  if (wrapped < 0.0)
    wrapped += period;
  return wrapped >= period ? 0.0 : wrapped + 0.0;
}

TEST(WrapPosition, IsTheSameWithoutADivision) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> periods(0.5, 1000);
  std::uniform_real_distribution<double> turns(-3, 3);
  for (int i = 0; i < 20000; ++i) {
    const double period = i % 2 == 0 ? 360.0 : periods(engine);
    std::vector<double> positions = {period * turns(engine), -5e-324, 5e-324};
    for (int turn = -3; turn <= 3; ++turn)
      for (const double beside : {-kInf, kInf})
        for (const double place : {turn * period, std::nextafter(turn * period, beside)})
          positions.push_back(place);
    for (const double position : positions) {
      const double wrapped = stride::numeric::wrapPosition(position, period);
      ASSERT_EQ(wrapped, wrapByDivision(position, period)) << position << " of " << period;
      ASSERT_FALSE(std::signbit(wrapped)) << position << " of " << period;
    }
  }
  EXPECT_EQ(stride::numeric::wrapPosition(1.5e308, 1e308), 1.5e308 - 1e308);
  EXPECT_TRUE(std::isnan(stride::numeric::wrapPosition(kNan, 360)));
  EXPECT_TRUE(std::isnan(stride::numeric::wrapPosition(kInf, 360)));
}

TEST(IsZero, IsTheComparison) {
  for (const double value : {0.0, -0.0, 5e-324, -5e-324, 1.0, -1.0, kInf, -kInf, kNan, -kNan})
    EXPECT_EQ(stride::exact::isZero(value), value == 0.0) << value;
}

TEST(SetValues, SaysHowTheAxisMoves) {
  const std::vector<double> values = {0.0, -0.0, 2.0, -2.0, 1e-200, -1e-200, kInf, -kInf, kNan};
  for (const double velocity : values)
    for (const double acceleration : values)
      for (const int16_t before : {int16_t{-1}, int16_t{1}}) {
        AxisRef ref = fresh<AxisRef>();
        ref.nDirection = before;
        axis::writeMotion(ref, velocity, acceleration);
        const double power = velocity * acceleration;
        const bool starts = velocity == 0.0 && acceleration != 0.0;
        EXPECT_EQ(ref.bConstantVelocity, velocity != 0.0 && acceleration == 0.0);
        EXPECT_EQ(ref.bAccelerating, power > 0.0 || starts) << velocity << " " << acceleration;
        EXPECT_EQ(ref.bDecelerating, power < 0.0) << velocity << " " << acceleration;
        EXPECT_EQ(ref.nDirection, velocity > 0.0 ? 1 : velocity < 0.0 ? -1 : before) << velocity;
        EXPECT_EQ(ref.fSetDeceleration, power < 0.0 ? std::fabs(acceleration) : 0.0);
        EXPECT_FALSE(velocity == 0.0 && std::signbit(ref.fSetVelocity));
        EXPECT_FALSE(acceleration == 0.0 && std::signbit(ref.fSetAcceleration));
      }
}

AxisRef powered() {
  AxisRef ref = fresh<AxisRef>();
  ref.bRegulatorOn = ref.bDriveStart = ref.bRegulatorRealState = ref.bDriveStartRealState = 1;
  ref.fTaskCycle = 0.001;
  ref.nAxisState = axis::state::kStandstill;
  return ref;
}

bool same(const AxisRef &a, const AxisRef &b) {
  return a.nAxisState == b.nAxisState && a.iOwner == b.iOwner && a.wFBErrorID == b.wFBErrorID &&
         a.bSWEndSwitchActive == b.bSWEndSwitchActive && a.fSetPosition == b.fSetPosition &&
         a.fSetVelocity == b.fSetVelocity && a.fSetTorque == b.fSetTorque &&
         a.stPlanner.bActive == b.stPlanner.bActive && a.stPlanner.ulCycle == b.stPlanner.ulCycle &&
         a.stPlanner.wStopReason == b.stPlanner.wStopReason &&
         a.stSuperimposed.ulOwner == b.stSuperimposed.ulOwner;
}

// One look decides whether an axis is supervised thoroughly: never wrongly that it is not.
TEST(Supervise, LeavesNothingOut) {
  std::mt19937 engine(5);
  const auto draw = [&engine](int of) {
    return static_cast<int>(engine() % static_cast<uint32_t>(of));
  };
  int quick = 0;
  for (int i = 0; i < 200000; ++i) {
    AxisRef ref = powered();
    ref.bDriveStartRealState = draw(8) != 0;
    ref.nAxisState = static_cast<int16_t>(draw(8));
    ref.iOwner = static_cast<int16_t>(draw(2));
    ref.bMovedInThisCycle = static_cast<uint8_t>(draw(4) != 0);
    ref.stSuperimposed.ulOwner = draw(4) == 0 ? 7 : 0;
    ref.stSuperimposed.bMovedInThisCycle = static_cast<uint8_t>(draw(2));
    ref.iMovementType = static_cast<int16_t>(draw(2));
    ref.bSWLimitEnable = static_cast<uint8_t>(draw(4) != 0);
    ref.bSWEndSwitchActive = static_cast<uint8_t>(draw(2));
    ref.fSWLimitPositive = draw(2) == 0 ? 10 : 100;
    ref.fSWLimitNegative = draw(2) == 0 ? -10 : -100;
    ref.bHWLimitEnable = static_cast<uint8_t>(draw(2));
    ref.bHWLimitIgnored = draw(8) == 0;
    ref.bLimitSwitchPositive = draw(4) == 0;
    ref.bLimitSwitchNegative = draw(4) == 0;
    ref.fSetPosition = draw(41) - 20;
    ref.fSavePosition = ref.fSetPosition + draw(3) - 1;
    ref.fSetVelocity = draw(3) - 1;
    ref.fSetTorque = draw(2);
    ref.stPlanner.bActive = static_cast<uint8_t>(draw(2));
    ref.stPlanner.fCycle = 0.001;
    ref.stPlanner.fDuration = draw(2);
    ref.stPlanner.uiSegmentCount = 1;
    AxisRef thorough = ref;
    quick += axis::isServedByOwner(ref) ? 1 : 0;
    axis::supervise(ref);
    axis::superviseThoroughly(thorough);
    ASSERT_TRUE(same(ref, thorough)) << i;
  }
  EXPECT_GT(quick, 10000);
}

} // namespace
