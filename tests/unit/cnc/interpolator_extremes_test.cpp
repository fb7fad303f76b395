// Paths of sizes at both ends of what there is: one object of 10^9 u, and objects of a thousandth.
#include "tests/unit/cnc/interpolator_drive.hpp"

#include <random>

namespace stride::test {
namespace {

class EachLawExtremes : public ::testing::TestWithParam<LawKind> {};

INSTANTIATE_TEST_SUITE_P(Interpolator, EachLawExtremes,
                         ::testing::Values(LawKind::Trapezoid, LawKind::Sigmoid, LawKind::Jerk));

/// From rest to a velocity: with limited jerk, which never reaches the acceleration here, or
/// reaches it just so; else with the acceleration.
double rampTime(LawKind law, double velocity, double acceleration, double jerk) {
  if (law != LawKind::Jerk)
    return velocity / acceleration;
  return acceleration * acceleration > velocity * jerk
             ? 2 * std::sqrt(velocity / jerk)
             : velocity / acceleration + acceleration / jerk;
}

TEST_P(EachLawExtremes, DrivesOneObjectOfTenToTheNine) {
  Drive drive(GetParam());
  PathObject &object = drive.line(6e8, -8e8, 0);
  object.velocity = 1e7;
  object.acceleration = 1e6;
  object.deceleration = 5e5;
  drive.queue.endOfList = 1;
  drive.start();
  const double time = drive.finish(1000);
  EXPECT_EQ(drive.x(), 6e8);
  EXPECT_EQ(drive.y(), -8e8);
  EXPECT_NEAR(drive.fastest, 1e7, 1);
  const double ramps =
      rampTime(GetParam(), 1e7, 1e6, 20000) + rampTime(GetParam(), 1e7, 5e5, 20000);
  EXPECT_NEAR(time, 100 + ramps / 2, 1e-3 * time);
}

TEST_P(EachLawExtremes, LosesLittleOnShortObjects) {
  constexpr int kPoints = 20000;
  constexpr double kFeed = 20; // as many objects pass in a cycle
  Drive drive(GetParam(), 6000);
  int next = 1;
  const auto fill = [&] {
    for (; next <= kPoints && !cnc::isFull(&drive.queue); ++next) {
      PathObject &line = drive.line(6e-4 * next, -8e-4 * next, next == kPoints ? 0 : kFeed);
      line.velocity = kFeed;
    }
    drive.queue.endOfList = next > kPoints ? 1 : 0;
  };
  fill();
  drive.start();
  drive.run([&] {
    fill();
    return drive.interpolator->phase == Phase::Finished;
  });
  EXPECT_EQ(drive.x(), 6e-4 * kPoints);
  EXPECT_EQ(drive.y(), -8e-4 * kPoints);
  EXPECT_NEAR(drive.fastest, kFeed, 1e-6);
  const double ramps =
      rampTime(GetParam(), kFeed, 1000, 20000) + rampTime(GetParam(), kFeed, 500, 20000);
  EXPECT_LT(drive.time, (20 / kFeed + ramps / 2) * 1.2);
}

/// A winding path of more than 500,000 u, on which ways are made smaller several times: places to
/// rest and functions, which are passed at their places only. How many functions there are.
int16_t windingPath(Drive &drive, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<>(least, most)(random);
  };
  int16_t functions = 0;
  for (int i = 0; i < 400; ++i) {
    const double angle = between(-0.02, 0.02);
    const double length = between(100, 2500);
    PathObject &line =
        drive.line(drive.last.coordinate[0] + length * std::cos(angle),
                   drive.last.coordinate[1] + length * std::sin(angle), i % 7 == 5 ? 0 : 2e5);
    line.velocity = 2e5;
    line.acceleration = 7e6;
    line.deceleration = 5e6;
    if (i % 31 == 17) {
      line.velocityEnd = 0;
      drive.function(++functions);
    }
  }
  drive.queue.endOfList = 1;
  return functions;
}

TEST_P(EachLawExtremes, PassesAllPlacesOfLongPaths) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Drive drive(GetParam(), 500);
    drive.command.jerk = 1e9;
    drive.command.singleStep = seed % 4 == 3;
    drive.command.acknowledge = true;
    const int functions = windingPath(drive, seed);
    const cnc::Position end = drive.last;
    drive.start();
    int passed = 0;
    drive.run([&] {
      const int function = drive.progress().function;
      EXPECT_TRUE(function == 0 || function == passed || function == passed + 1);
      passed = std::max(passed, function);
      return drive.interpolator->phase == Phase::Finished;
    });
    EXPECT_EQ(passed, functions);
    EXPECT_EQ(drive.x(), end.coordinate[0]);
    EXPECT_EQ(drive.y(), end.coordinate[1]);
  }
}

/// To and fro, turning at any place, and to the end of it.
TEST_P(EachLawExtremes, GoesBackOnLongPaths) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Drive drive(GetParam(), 500);
    drive.command.jerk = 1e9;
    drive.command.twoWays = true;
    drive.command.acknowledge = true;
    (void)windingPath(drive, seed);
    const cnc::Position end = drive.last;
    drive.start();
    for (int turn = 0; turn < 10; ++turn) {
      drive.command.override = turn % 2 == 0 ? 1.0 : -0.7;
      const double until = drive.time + std::uniform_real_distribution<>(0.1, 1.5)(random);
      drive.run([&] { return drive.time >= until; });
    }
    const auto runToEnd = [&](double override) {
      drive.command.override = override;
      while (drive.interpolator->backwards != (override < 0)) // it brakes, and turns
        drive.step();
      drive.run([&] { return drive.progress().atEnd; });
    };
    runToEnd(1);
    EXPECT_EQ(drive.interpolator->phase, Phase::Moving);
    EXPECT_EQ(drive.x(), end.coordinate[0]);
    EXPECT_EQ(drive.y(), end.coordinate[1]);
    runToEnd(-1);
    EXPECT_EQ(drive.x(), 0);
    EXPECT_EQ(drive.y(), 0);
  }
}

/// Objects that are shorter than what a way far along can tell apart, among others of any length.
TEST_P(EachLawExtremes, PassesObjectsOfAnyLength) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Drive drive(GetParam(), 1100);
    drive.command.jerk = 1e9;
    drive.command.acknowledge = true;
    double y = 0;
    int16_t functions = 0;
    for (int i = 0; i < 1000; ++i) {
      const double length = std::pow(10, std::uniform_real_distribution<>(-14, 3.5)(random));
      y = i % 5 == 3 ? y + length : y;
      PathObject &line = drive.line(drive.last.coordinate[0] + (i % 5 == 3 ? 0 : length), y);
      line.length = length;
      line.velocity = 2e5;
      line.velocityEnd = i % 5 == 3 || i % 5 == 2 || i % 31 == 17 ? 0 : 2e5;
      line.acceleration = 7e6;
      line.deceleration = 5e6;
      if (i % 31 == 17)
        drive.function(++functions);
    }
    drive.queue.endOfList = 1;
    const cnc::Position end = drive.last;
    drive.start();
    int passed = 0;
    drive.run([&] {
      passed = std::max<int>(passed, drive.progress().function);
      return drive.interpolator->phase == Phase::Finished ||
             drive.interpolator->phase == Phase::Failed;
    });
    EXPECT_EQ(drive.interpolator->error, 0);
    EXPECT_EQ(passed, functions);
    EXPECT_EQ(drive.x(), end.coordinate[0]);
    EXPECT_EQ(drive.y(), end.coordinate[1]);
  }
}

} // namespace
} // namespace stride::test
