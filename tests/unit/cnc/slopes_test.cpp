// A, B and C by slopes: how the interpolator drives them, what the axes' limits make of them, and
// what cuts do to them.
#include "tests/unit/cnc/interpolator_drive.hpp"

#include "runtime/numeric/cnc/object_cut.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace stride;
using namespace stride::test;

/// The cubic in Hermite's form.
struct Cubic {
  double from, to, first, last, length;

  double at(double way) const {
    const double u = way / length;
    const double h00 = (1 + 2 * u) * (1 - u) * (1 - u);
    const double h01 = u * u * (3 - 2 * u);
    const double h10 = u * (1 - u) * (1 - u);
    const double h11 = u * u * (u - 1);
    return from * h00 + to * h01 + length * (first * h10 + last * h11);
  }
};

/// A line along X in which an axis goes by slopes.
PathObject &bentLine(Drive &drive, double x, int axis, const Cubic &cubic) {
  PathObject o = drive.object(MoveType::Line);
  o.start.axes = o.end.axes = static_cast<uint16_t>(7U | 1U << static_cast<unsigned>(axis));
  o.end.coordinate[cnc::kAxisX] = x;
  o.length = cubic.length;
  o.start.coordinate[axis] = cubic.from;
  o.end.coordinate[axis] = cubic.to;
  o.slopes = static_cast<uint8_t>(1U << static_cast<unsigned>(axis - cnc::kAxisA));
  o.startSlope[axis - cnc::kAxisA] = cubic.first;
  o.endSlope[axis - cnc::kAxisA] = cubic.last;
  drive.add(o);
  return *cnc::objectFromEnd(&drive.queue, 0);
}

TEST(Slopes, EachOfTheAxesGoesByItsCubic) {
  for (int axis = cnc::kAxisA; axis <= cnc::kAxisC; ++axis) {
    Drive drive;
    const Cubic first{5, 35, -0.5, 2, 40};
    const Cubic second{35, 20, 2, 0, 25};
    bentLine(drive, 40, axis, first);
    bentLine(drive, 65, axis, second).velocityEnd = 0;
    drive.queue.endOfList = 1;
    drive.start();
    double greatest = 0;
    while (drive.interpolator->phase != Phase::Finished && drive.time < 10) {
      drive.step();
      const double x = drive.x();
      const double expected = x <= 40 ? first.at(x) : second.at(x - 40);
      greatest =
          std::max(greatest, std::abs(drive.interpolator->position.coordinate[axis] - expected));
    }
    EXPECT_LT(greatest, 1e-10) << axis;
    EXPECT_EQ(drive.x(), 65);
    EXPECT_EQ(drive.interpolator->position.coordinate[axis], 20);
  }
}

TEST(Slopes, SlopesOfALineAreALine) {
  Drive drive;
  const Cubic even{-3, 17, 0.4, 0.4, 50};
  bentLine(drive, 50, cnc::kAxisB, even);
  drive.queue.endOfList = 1;
  drive.start();
  while (drive.interpolator->phase != Phase::Finished && drive.time < 10) {
    drive.step();
    ASSERT_NEAR(drive.interpolator->position.coordinate[cnc::kAxisB], -3 + 0.4 * drive.x(), 1e-12);
  }
}

TEST(Slopes, LimitsOfTheAxisHold) {
  for (const LawKind law : {LawKind::Trapezoid, LawKind::Jerk}) {
    Drive drive(law);
    const Cubic cubic{0, 60, 0, 0, 80}; // steepest in the middle: 1.125
    bentLine(drive, 80, cnc::kAxisA, cubic);
    drive.queue.endOfList = 1;
    constexpr double kVelocity = 40;
    constexpr double kAcceleration = 150;
    drive.command.limits.velocity[cnc::kAxisA] = kVelocity;
    drive.command.limits.acceleration[cnc::kAxisA] = kAcceleration;
    drive.start();
    double before[2] = {0, 0};
    double fastest = 0;
    double sharpest = 0;
    for (int cycle = 0; drive.interpolator->phase != Phase::Finished && cycle < 10000; ++cycle) {
      drive.step();
      const double at = drive.interpolator->position.coordinate[cnc::kAxisA];
      fastest = std::max(fastest, std::abs(at - before[0]) / kCycle);
      if (cycle >= 1)
        sharpest = std::max(sharpest, std::abs(at - 2 * before[0] + before[1]) / (kCycle * kCycle));
      before[1] = before[0];
      before[0] = at;
    }
    EXPECT_EQ(drive.interpolator->phase, Phase::Finished);
    EXPECT_LE(fastest, kVelocity * (1 + 1e-6));
    EXPECT_GT(fastest, kVelocity * 0.9);
    EXPECT_LE(sharpest, kAcceleration * (1 + 1e-3));
    EXPECT_GT(sharpest, kAcceleration * 0.5);
  }
}

TEST(Slopes, NoNumbersAreAnError) {
  Drive drive;
  bentLine(drive, 80, cnc::kAxisC, {0, 60, NAN, 0, 80});
  drive.queue.endOfList = 1;
  drive.start();
  for (int cycle = 0; cycle < 10; ++cycle)
    drive.step();
  EXPECT_EQ(drive.interpolator->phase, Phase::Failed);
}

TEST(Slopes, PartsOfACutGoByTheSameCubic) {
  Drive drive;
  const Cubic cubic{7, -12, 1.5, -2.5, 30};
  const PathObject whole = bentLine(drive, 30, cnc::kAxisB, cubic);
  for (const double way : {0.01, 4.0, 15.0, 29.5}) {
    PathObject first;
    PathObject second;
    ASSERT_EQ(cnc::splitObject(whole, way, first, second), cnc::CutError::None);
    EXPECT_NEAR(first.end.coordinate[cnc::kAxisB], cubic.at(way), 1e-12);
    EXPECT_EQ(first.end.coordinate[cnc::kAxisB], second.start.coordinate[cnc::kAxisB]);
    const auto cubicOf = [](const PathObject &o) {
      return Cubic{o.start.coordinate[cnc::kAxisB], o.end.coordinate[cnc::kAxisB], o.startSlope[1],
                   o.endSlope[1], o.length};
    };
    for (int i = 0; i <= 10; ++i) {
      EXPECT_NEAR(cubicOf(first).at(way * i / 10), cubic.at(way * i / 10), 1e-11);
      EXPECT_NEAR(cubicOf(second).at((30 - way) * i / 10), cubic.at(way + (30 - way) * i / 10),
                  1e-11);
    }
  }
}

} // namespace
