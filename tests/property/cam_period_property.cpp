// Counting periods, against whole numbers of 128 bits, in which everything is exact: no drift after
// 10^12 periods that have nothing in common.
#include "runtime/numeric/cam/period.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

namespace cam = stride::cam;
using stride::test::casesOf;
using stride::test::Random;

__extension__ using Whole = __int128;

/// The unit: 2^-50, so that a double between 4 and 2^13 is a whole number of it, and any place.
constexpr int kUnit = 50;

Whole wholeOf(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  const auto digits = static_cast<Whole>(std::ldexp(mantissa, 53));
  const int shift = exponent - 53 + kUnit;
  EXPECT_TRUE(shift >= 0 || (digits & ((Whole{1} << -shift) - 1)) == 0);
  return shift >= 0 ? digits << shift : digits >> -shift;
}

long double inUnits(Whole whole) { return std::ldexp(static_cast<long double>(whole), -kUnit); }

Whole floorDivide(Whole a, Whole b) { return a / b - (a % b < 0 ? 1 : 0); }

/// A number with all of its 53 digits, of a size the unit can hold.
double period(Random &random) { return random.uniform(4.0, 4000.0); }

/// Rounded to the unit.
double place(Random &random, double low, double high) {
  return std::ldexp(std::floor(std::ldexp(random.uniform(low, high), 40)), -40);
}

int64_t turns(Random &random) {
  return static_cast<int64_t>(random.sign() * random.magnitude(0, 12));
}

void expectPlace(const cam::Place &found, Whole total, double start, double length) {
  const Whole exactStart = wholeOf(start);
  const Whole exactLength = wholeOf(length);
  const Whole exactPeriod = floorDivide(total - exactStart, exactLength);
  const Whole rest = total - exactPeriod * exactLength; // where it is, in [start, start + length)
  const double scale = std::fabs(start) + length;
  const double slack = 4 * 0x1p-53 * scale;
  EXPECT_GE(found.position, start);
  EXPECT_LT(found.position, start + length);
  // At the very end of a period the next one may have begun, and the other way round.
  const auto periods = static_cast<long double>(found.period - static_cast<int64_t>(exactPeriod));
  EXPECT_LE(std::fabs(periods), 1.0L);
  const long double away = found.position - inUnits(rest) + periods * length;
  EXPECT_LE(std::fabs(away), slack) << found.period << " " << found.position;
  if (std::fabs(inUnits(rest) - start) > slack &&
      std::fabs(inUnits(rest) - start - length) > slack) {
    EXPECT_EQ(found.period, static_cast<int64_t>(exactPeriod));
    EXPECT_LE(std::fabs(found.position - inUnits(rest)),
              2 * 0x1p-53L * (std::fabs(inUnits(rest)) + 0x1p-40L * scale));
  }
}

} // namespace

TEST(CamPeriods, OfMasterAndCamNeedNothingInCommon) {
  Random random(21);
  for (int i = 0; i < casesOf(200000); ++i) {
    const double masterPeriod = period(random);
    const double length = period(random);
    const double start = place(random, -1000, 1000);
    const double position = place(random, 0, masterPeriod);
    const int64_t count = turns(random);
    const cam::Total total = cam::totalOf(count, masterPeriod, position);
    expectPlace(cam::placeOf(total, start, length),
                Whole{count} * wholeOf(masterPeriod) + wholeOf(position), start, length);
  }
}

TEST(CamPeriods, ScaledAndShiftedMastersDoNotDriftEither) {
  Random random(22);
  for (int i = 0; i < casesOf(100000); ++i) {
    const double masterPeriod = period(random);
    const double length = period(random);
    const double start = place(random, -1000, 1000);
    const double position = place(random, 0, masterPeriod);
    const auto count = static_cast<int64_t>(random.sign() * random.magnitude(0, 8));
    const int factor = 1 + random.below(4096);
    const bool negative = random.chance(0.5);
    const double shift = place(random, -1000, 1000);
    const cam::Total total = cam::stretched(cam::totalOf(count, masterPeriod, position),
                                            (negative ? -factor : factor) / 1024.0, shift);
    // In units of 2^-10 of the unit it is exact: all else as much bigger.
    const Whole exact =
        (Whole{count} * wholeOf(masterPeriod) + wholeOf(position)) * (negative ? -factor : factor) +
        wholeOf(shift) * 1024;
    const cam::Place found = cam::placeOf(total, start, length);
    const Whole period = floorDivide(exact - wholeOf(start) * 1024, wholeOf(length) * 1024);
    const Whole rest = exact - period * wholeOf(length) * 1024;
    const long double away =
        found.position - inUnits(rest) / 1024 +
        static_cast<long double>(found.period - static_cast<int64_t>(period)) * length;
    EXPECT_LE(std::fabs(away), 4 * 0x1p-53L * (std::fabs(start) + length)) << i;
  }
}

TEST(CamPeriods, TenToTheEightTurnsLaterThePlaceIsTheSame) {
  // Periods that are commensurable after all: 10^8 turns of 360 are 8 * 10^7 cams of 450.
  const cam::Place first = cam::placeOf(cam::totalOf(0, 360.0, 123.456), 0.0, 450.0);
  for (const int64_t count :
       {int64_t{100'000'000}, int64_t{-100'000'000}, int64_t{1'000'000'000'000}}) {
    const cam::Place later = cam::placeOf(cam::totalOf(count, 360.0, 123.456), 0.0, 450.0);
    EXPECT_EQ(later.position, first.position);
    EXPECT_EQ(later.period, first.period + count / 5 * 4);
  }
}

TEST(CamPeriods, WhatBelongsToThePeriodIsTakenAsItIs) {
  Random random(23);
  for (int i = 0; i < casesOf(10000); ++i) {
    const double length = period(random);
    const double start = random.uniform(-1000, 1000);
    const double position = random.uniform(start, start + length);
    const cam::Place found = cam::placeOf(cam::totalOf(0, 360.0, position), start, length);
    EXPECT_EQ(found.period, 0);
    EXPECT_EQ(found.position, position);
  }
}

TEST(CamPeriods, BeginAtTheirStartAndEndBeforeTheNextOne) {
  Random random(24);
  for (int i = 0; i < casesOf(10000); ++i) {
    const double length = place(random, 4, 4000);
    const double start = place(random, -1000, 1000);
    const int64_t count = static_cast<int64_t>(random.sign() * random.magnitude(0, 9));
    // Exactly at the joint: the period that begins there.
    const cam::Place joint = cam::placeOf(cam::totalOf(count, length, start), start, length);
    EXPECT_EQ(joint.period, count);
    EXPECT_EQ(joint.position, start);
    // As little before it as a double-double can say.
    const cam::Total total = cam::totalOf(count, length, start);
    const cam::Place before = cam::placeOf({total.hi, total.lo - 0x1p-40}, start, length);
    EXPECT_EQ(before.period, count - 1);
    EXPECT_NEAR(before.position, start + length - 0x1p-40, 0x1p-40);
  }
}

TEST(CamPeriods, BeyondAllMeaningThereIsTheStart) {
  const cam::Place far = cam::placeOf({1e300, 0.0}, 5.0, 10.0);
  EXPECT_EQ(far.position, 5.0);
  const cam::Place never = cam::placeOf({std::nan(""), 0.0}, 5.0, 10.0);
  EXPECT_EQ(never.position, 5.0);
  const cam::Place endless = cam::placeOf({INFINITY, 0.0}, 5.0, 10.0);
  EXPECT_EQ(endless.position, 5.0);
}
