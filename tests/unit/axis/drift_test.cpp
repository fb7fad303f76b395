// Ten million cycles of rotary axes and encoders with awkward ratios against exact integers: no
// drift.
#include "runtime/axis/encoder.hpp"
#include "runtime/axis/increments.hpp"

#include "tests/unit/axis/axis_rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using stride::axis::AxisRef;
using stride::axis::EncoderRef;
using stride::test::fresh;

__extension__ using Wide = __int128;

constexpr int kCycles = 10'000'000;

/// The same numbers everywhere.
class Random {
public:
  uint32_t next() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<uint32_t>(state_ >> 33);
  }
  /// In [-size, size].
  int64_t within(int64_t size) {
    return static_cast<int64_t>(next() % static_cast<uint64_t>(2 * size + 1)) - size;
  }

private:
  uint64_t state_ = 1;
};

struct Ratio {
  const char *name;
  uint32_t denominator;
  int16_t numerator;
  int64_t period; // u
};

class RotaryAxis : public ::testing::TestWithParam<Ratio> {};

// Positions are multiples of 2^-20 u, so that doubles hold them exactly and the oracle is a
// fraction: increments = way * denominator / (numerator * 2^20).
TEST_P(RotaryAxis, DoesNotDrift) {
  constexpr int64_t kUnit = int64_t{1} << 20;
  const Ratio ratio = GetParam();
  AxisRef axis = fresh<AxisRef>();
  axis.dwRatioTechUnitsDenom = ratio.denominator;
  axis.iRatioTechUnitsNum = ratio.numerator;
  axis.iMovementType = 0;
  axis.fPositionPeriod = static_cast<double>(ratio.period);
  ASSERT_EQ(stride::axis::configureScaling(axis), stride::axis::ScalingError::None);
  stride::axis::synchronizePosition(axis, 0);

  const int64_t period = ratio.period * kUnit;
  const Wide divisor = Wide{ratio.numerator} * kUnit;
  Random random;
  int64_t way = 0; // since the start, in 2^-20 u
  for (int i = 0; i < kCycles; ++i) {
    // Mostly forwards, up to 0.45 of a turn in a cycle, then back.
    const int64_t step =
        random.within(period * 9 / 40) + (i < kCycles * 2 / 3 ? 1 : -1) * period / 5;
    way += step;
    int64_t place = way % period;
    if (place < 0)
      place += period;
    axis.fSetPosition = static_cast<double>(place) / kUnit;
    ASSERT_TRUE(stride::axis::updateSet(axis, static_cast<double>(step) / kUnit));
    // |set - exact| <= 1/2, but for the last bits of the product of a double
    const Wide off = Wide{axis.liSetIncrements} * divisor - Wide{way} * ratio.denominator;
    ASSERT_LE((off < 0 ? -off : off) * 2, divisor + divisor / (1 << 18)) << "cycle " << i;

    stride::axis::updateActual(axis, static_cast<uint32_t>(axis.liSetIncrements));
    ASSERT_EQ(axis.liActIncrements, axis.liSetIncrements);
    if (i % 1000 == 0) { // actual position = increments modulo the turn, exactly
      const Wide turn = Wide{period} * ratio.denominator; // in units of 1/divisor increments
      Wide rest = Wide{axis.liActIncrements} * divisor % turn;
      if (rest < 0)
        rest += turn;
      const double expected =
          static_cast<double>(rest) / static_cast<double>(turn) * static_cast<double>(ratio.period);
      const double apart = std::fabs(axis.fActPosition - expected);
      ASSERT_LT(std::min(apart, static_cast<double>(ratio.period) - apart), 1e-9) << "cycle " << i;
    }
  }
  EXPECT_GT(std::abs(way) / period, 100000) << "it has been far";

  // Back to the start: exactly the increments it started from.
  while (way != 0) {
    const int64_t step = std::clamp(-way, -period * 2 / 5, period * 2 / 5);
    way += step;
    int64_t place = way % period;
    if (place < 0)
      place += period;
    axis.fSetPosition = static_cast<double>(place) / kUnit;
    ASSERT_TRUE(stride::axis::updateSet(axis, static_cast<double>(step) / kUnit));
  }
  EXPECT_EQ(axis.liSetIncrements, 0);
}

INSTANTIATE_TEST_SUITE_P(Ratios, RotaryAxis,
                         ::testing::Values(Ratio{"Inc65536To360", 65536, 360, 360},
                                           Ratio{"Inc3600000To7", 3600000, 7, 360},
                                           Ratio{"Inc4096To17", 4096, 17, 1000}),
                         [](const auto &info) { return std::string(info.param.name); });

struct EncoderCase {
  const char *name;
  uint32_t modulo;
  Ratio ratio;
};

class RotaryEncoder : public ::testing::TestWithParam<EncoderCase> {};

TEST_P(RotaryEncoder, DoesNotDrift) {
  const EncoderCase one = GetParam();
  EncoderRef encoder = fresh<EncoderRef>();
  encoder.dwEncoderModulo = one.modulo;
  encoder.dwRatioTechUnitsDenom = one.ratio.denominator;
  encoder.iRatioTechUnitsNum = one.ratio.numerator;
  encoder.iMovementType = 0;
  encoder.fPositionPeriod = static_cast<double>(one.ratio.period);
  stride::axis::synchronizeEncoder(encoder, 0);

  const int64_t modulo = one.modulo == 0 ? int64_t{1} << 32 : int64_t{one.modulo};
  const int64_t fastest = std::min<int64_t>((modulo - 1) / 2, INT32_MAX / 4);
  const Wide turn = Wide{one.ratio.period} * one.ratio.denominator; // in 1/numerator increments
  Random random;
  int64_t count = 0;
  for (int i = 0; i < kCycles; ++i) {
    const int64_t drift = (i < kCycles / 2 ? 1 : -1) * fastest / 3;
    count += random.within(fastest * 2 / 3) + drift;
    int64_t shown = count % modulo;
    if (shown < 0)
      shown += modulo;
    stride::axis::updateEncoder(encoder, static_cast<uint32_t>(shown));
    ASSERT_EQ(encoder.liActIncrements, count) << "cycle " << i;
    if (i % 100 == 0) {
      Wide place = Wide{count} * one.ratio.numerator % turn;
      if (place < 0)
        place += turn;
      const double expected = static_cast<double>(place) / one.ratio.denominator;
      ASSERT_NEAR(stride::axis::encoderPosition(encoder), expected, 1e-9) << "cycle " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Counters, RotaryEncoder,
                         ::testing::Values(EncoderCase{"Bits12", 4096, {"", 4096, 360, 360}},
                                           EncoderCase{"Bits12Awkward", 4096, {"", 4096, 7, 360}},
                                           EncoderCase{"Bits16", 65536, {"", 3600000, 7, 360}},
                                           EncoderCase{"Bits32", 0, {"", 65536, 360, 360}},
                                           EncoderCase{"Odd", 10007, {"", 10007, 13, 100}}),
                         [](const auto &info) { return std::string(info.param.name); });

TEST(Encoder, TheShorterWayRound) {
  EncoderRef encoder = fresh<EncoderRef>();
  encoder.dwEncoderModulo = 4096;
  stride::axis::synchronizeEncoder(encoder, 4000);
  EXPECT_EQ(encoder.liActIncrements, 4000);
  stride::axis::updateEncoder(encoder, 10);
  EXPECT_EQ(encoder.liActIncrements, 4106);
  stride::axis::updateEncoder(encoder, 4090);
  EXPECT_EQ(encoder.liActIncrements, 4090);
  stride::axis::updateEncoder(encoder, 4090 + 2047);
  EXPECT_EQ(encoder.liActIncrements, 4090 + 2047) << "beyond the modulo it is the rest that counts";
  stride::axis::updateEncoder(encoder, 4090 + 2047 + 2048);
  EXPECT_EQ(encoder.liActIncrements, 4090 + 2047 - 2048) << "half a turn counts as backwards";
}

TEST(Encoder, LinearPosition) {
  EncoderRef encoder = fresh<EncoderRef>();
  encoder.dwRatioTechUnitsDenom = 10000;
  encoder.iRatioTechUnitsNum = 1;
  stride::axis::synchronizeEncoder(encoder, 25000);
  EXPECT_EQ(stride::axis::encoderPosition(encoder), 2.5);
  stride::axis::updateEncoder(encoder, static_cast<uint32_t>(-5000));
  EXPECT_EQ(stride::axis::encoderPosition(encoder), -0.5);
  encoder.dwRatioTechUnitsDenom = 0;
  EXPECT_EQ(stride::axis::encoderPosition(encoder), 0) << "no ratio, no position";
}

} // namespace
