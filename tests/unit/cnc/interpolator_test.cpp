// The interpolator, cycle by cycle: what each object does, overrides, both ways, and what it says
// of paths that cannot be driven.
#include "tests/unit/cnc/interpolator_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace stride;
using namespace stride::test;

class EachLaw : public testing::TestWithParam<LawKind> {};
INSTANTIATE_TEST_SUITE_P(Interpolator, EachLaw,
                         testing::Values(LawKind::Trapezoid, LawKind::Sigmoid, LawKind::Jerk));

TEST(Interpolator, TakesTheTimeOfATrapezoid) {
  Drive drive;
  drive.line(50, 0);
  drive.queue.endOfList = 1;
  drive.start();
  // 100 / 1000 and 100 / 500 for 5 and 10, the rest with 100
  const double expected = 0.1 + 0.2 + 0.35;
  EXPECT_NEAR(drive.finish(), expected, 2 * kCycle);
  EXPECT_EQ(drive.x(), 50);
  EXPECT_NEAR(drive.fastest, 100, 1e-9);
}

TEST_P(EachLaw, WaitsForFunctions) {
  Drive drive(GetParam());
  drive.function(3);
  drive.line(30, 0);
  drive.function(10);
  drive.function(11);
  drive.line(60, 0);
  drive.queue.endOfList = 1;
  drive.start();
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(drive.step().function, 3);
  drive.command.acknowledge = true;
  drive.step();
  drive.command.acknowledge = false;
  drive.run([&] { return drive.progress().function != 0; });
  EXPECT_EQ(drive.progress().function, 10);
  EXPECT_EQ(drive.x(), 30);
  drive.command.acknowledge = true; // each shows for a cycle at least
  int cycles = 0;
  drive.run([&] {
    cycles += drive.progress().function == 11 ? 1 : 0;
    return drive.velocity() > 0;
  });
  EXPECT_EQ(cycles, 1);
  drive.finish();
  EXPECT_EQ(drive.x(), 60);
}

TEST(Interpolator, Dwells) {
  double time[2];
  for (const bool dwells : {false, true}) {
    Drive drive;
    drive.line(30, 0, 0);
    if (dwells)
      drive.function(cnc::kDwell, 0.25);
    drive.line(60, 0);
    drive.queue.endOfList = 1;
    drive.start();
    time[dwells ? 1 : 0] = drive.finish();
  }
  EXPECT_NEAR(time[1] - time[0], 0.25, 3 * kCycle);
}

/// As many cycles as a dwell has, also where the sum of cycles is rounded to less than it.
TEST(Interpolator, DwellsForWholeCycles) {
  for (const int cycles : {1, 7, 999, 1000, 1001, 3600}) {
    Drive drive;
    drive.line(30, 0, 0);
    drive.function(cnc::kDwell, kCycle * cycles);
    drive.line(60, 0);
    drive.queue.endOfList = 1;
    drive.start();
    drive.run([&] { return drive.x() == 30; });
    const double begin = drive.time;
    drive.run([&] { return drive.x() > 30; });
    EXPECT_NEAR((drive.time - begin) / kCycle, cycles, 1e-6) << cycles;
  }
}

TEST(Interpolator, DrivesUpToASynchronisationThatTheDecoderWaitsAt) {
  Drive drive;
  drive.line(30, 0, 0);
  drive.function(cnc::kSynchronise);
  drive.start();
  drive.run([&] { return cnc::countOf(&drive.queue) == 0; }, 5);
  EXPECT_EQ(drive.x(), 30);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(drive.step().motion.velocity, 0);
  EXPECT_EQ(drive.interpolator->warning, 0);
  drive.line(60, 0, 0);
  drive.queue.endOfList = 1;
  drive.finish();
  EXPECT_EQ(drive.x(), 60);
}

TEST(Interpolator, JumpsAndShowsPlacesThatAreNamedTwice) {
  Drive drive;
  PathObject jump = drive.object(MoveType::Jump);
  jump.end.coordinate[cnc::kAxisX] = 100;
  drive.add(jump);
  drive.line(100, 0);
  jump.end.coordinate[cnc::kAxisX] = 50;
  drive.add(jump);
  drive.line(40, 0);
  drive.queue.endOfList = 1;
  drive.start();
  int at100 = 0;
  drive.run([&] {
    at100 += drive.x() == 100 ? 1 : 0;
    return drive.interpolator->phase == Phase::Finished;
  });
  EXPECT_EQ(at100, 1);
  EXPECT_EQ(drive.x(), 40);
}

TEST_P(EachLaw, RestsAtPlacesThatAreNamedTwice) {
  Drive drive(GetParam());
  drive.line(7.3, 0);
  drive.line(7.3, 0);
  drive.line(20, 0);
  drive.queue.endOfList = 1;
  drive.start();
  double way = 0;
  drive.run([&] {
    way += drive.progress().length;
    EXPECT_NEAR(drive.x(), way, 1e-12); // no place but those that the motion passes
    return drive.interpolator->phase == Phase::Finished;
  });
}

TEST(Interpolator, SaysWhichObjectItWaitsAt) {
  Drive drive;
  drive.line(30, 0).sourceLine = 10;
  drive.function(7);
  cnc::objectFromEnd(&drive.queue, 0)->sourceLine = 20;
  drive.function(cnc::kDwell, 0.1);
  cnc::objectFromEnd(&drive.queue, 0)->sourceLine = 30;
  drive.line(60, 0).sourceLine = 40;
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.progress().function == 7; });
  EXPECT_EQ(drive.progress().source, 20);
  EXPECT_EQ(drive.step().source, 20);
  drive.command.acknowledge = true;
  EXPECT_EQ(drive.step().source, 30);
  EXPECT_EQ(drive.step().source, 30);
  drive.run([&] { return drive.velocity() > 0; });
  EXPECT_EQ(drive.progress().source, 40);
}

TEST(Interpolator, PassesSwitchesInTheOrderOfThePath) {
  Drive drive;
  PathObject &line = drive.line(40, 0);
  const double at[] = {0.75, 0.25, 0.5};
  const int16_t id[] = {-2, 2, 7};
  for (int i = 0; i < 3; ++i) {
    line.switchPosition[i] = at[i];
    line.switchId[i] = id[i];
  }
  drive.queue.endOfList = 1;
  drive.start();
  std::vector<std::pair<int16_t, double>> seen;
  drive.run([&] {
    if (drive.progress().lastSwitch != 0)
      seen.emplace_back(drive.progress().lastSwitch, drive.x());
    return drive.interpolator->phase == Phase::Finished;
  });
  ASSERT_EQ(seen.size(), 3U);
  const double places[] = {10, 20, 30};
  const int16_t order[] = {2, 7, -2};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(seen[i].first, order[i]);
    EXPECT_GE(seen[i].second, places[i]);
    EXPECT_LT(seen[i].second, places[i] + 100 * kCycle + 1e-9);
  }
  EXPECT_EQ(drive.interpolator->switches, 1U << 6U);
}

TEST_P(EachLaw, ComesToRestWhereThePathIsNotKnownAndGoesOn) {
  Drive drive(GetParam(), 8);
  for (int i = 1; i <= 5; ++i) // full: three places are free
    drive.line(10 * i, 0);
  drive.start();
  drive.run([&] { return cnc::countOf(&drive.queue) <= 1 && drive.velocity() == 0; });
  EXPECT_LE(drive.x(), 50);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(drive.step().motion.velocity, 0);
  for (int i = 6; i <= 9; ++i)
    drive.line(10 * i, 0);
  drive.run([&] { return drive.x() > 55; });
  drive.run([&] { return drive.velocity() == 0; });
  drive.queue.endOfList = 1;
  drive.finish();
  EXPECT_EQ(drive.x(), 90);
}

TEST_P(EachLaw, FollowsTheOverride) {
  Drive drive(GetParam());
  drive.line(2000, 0);
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.x() > 50; });
  for (const double override : {0.5, 1.5, 0.1, 2.0, 1.0}) {
    drive.command.override = override;
    const double least = std::min(drive.velocity(), 100 * override);
    drive.run(
        [&] {
          EXPECT_GE(drive.velocity(), least - 1e-6);
          return std::fabs(drive.velocity() - 100 * override) < 1e-6;
        },
        2);
  }
  drive.command.override = 0;
  drive.run([&] { return drive.velocity() == 0; }, 1);
  drive.command.override = 1;
  drive.finish();
  EXPECT_EQ(drive.x(), 2000);
}

/// A plan for less feed begins above it: it brakes as quickly as it can, and does not come to rest.
TEST(Interpolator, SlowsDownToEachOverride) {
  for (const double length : {300.0, 20.0, 5.0})
    for (const double override : {0.05, 0.1, 0.3, 0.45, 0.7, 0.9, 0.99}) {
      SCOPED_TRACE(testing::Message() << "lines of " << length << ", override " << override);
      Drive drive(LawKind::Jerk);
      drive.command.jerk = 5000;
      for (double x = length; x < 300.1; x += length) {
        PathObject &line = drive.line(x, 0, 40);
        line.velocity = 40;
        line.acceleration = line.deceleration = 400;
      }
      drive.queue.endOfList = 1;
      drive.start();
      drive.run([&] { return drive.x() > 60; });
      ASSERT_NEAR(drive.velocity(), 40, 1e-6);
      drive.command.override = override;
      const double begin = drive.time;
      drive.run(
          [&] {
            EXPECT_GE(drive.velocity(), 40 * override - 1e-6);
            return drive.velocity() < 40 * override + 1e-6;
          },
          1);
      constexpr double kPlanning = 0.15;
      EXPECT_LT(drive.time - begin, 40.0 / 400 + 400.0 / 5000 + kPlanning);
    }
}

/// Two ways: the path is in the queue as a whole and stays there.
TEST_P(EachLaw, GoesBackWithNegativeOverrides) {
  Drive drive(GetParam());
  drive.line(40, 0);
  PathObject arc = drive.object(MoveType::Counterclockwise);
  arc.end.coordinate[0] = 60;
  arc.end.coordinate[1] = 20;
  arc.shape[0] = 40;
  arc.shape[1] = 20;
  arc.shape[2] = 20;
  arc.parameterRange[0] = 270;
  arc.parameterRange[1] = -90;
  arc.length = 10 * M_PI;
  drive.add(arc);
  drive.function(5);
  drive.line(60, 80);
  drive.queue.endOfList = 1;
  drive.command.twoWays = true;
  drive.command.acknowledge = true;
  drive.start();
  drive.run([&] { return drive.y() > 10; });
  drive.command.override = -0.5;
  drive.run([&] { return drive.velocity() > 0 && drive.y() == 0; }, 5);
  EXPECT_NEAR(drive.velocity(), 50, 1e-6);
  drive.run([&] { return drive.progress().atEnd; }, 5);
  EXPECT_EQ(drive.x(), 0);
  EXPECT_EQ(drive.velocity(), 0);
  for (int i = 0; i < 10; ++i)
    EXPECT_TRUE(drive.step().atEnd);
  drive.command.override = 1.2;
  drive.run([&] { return drive.velocity() > 0; }, 5);
  drive.run([&] { return drive.progress().atEnd; }, 5);
  EXPECT_EQ(drive.x(), 60);
  EXPECT_EQ(drive.y(), 80);
  drive.command.override = -2;
  drive.run([&] { return drive.progress().atEnd && drive.x() == 0; }, 5);
  EXPECT_EQ(cnc::countOf(&drive.queue), 4U);
}

TEST(Interpolator, TurnsRoundAtTheBorderOfTwoObjects) {
  Drive drive;
  drive.line(30, 0, 0);
  drive.line(70, 0, 0);
  drive.queue.endOfList = 1;
  drive.command.twoWays = true;
  drive.command.waitAtNextStop = true;
  drive.start();
  drive.run([&] { return drive.x() == 30 && drive.progress().waits; });
  drive.command.override = -1;
  drive.command.waitAtNextStop = false;
  double way = -drive.progress().length;
  drive.run(
      [&] {
        way += drive.progress().length;
        return drive.progress().atEnd && drive.interpolator->backwards;
      },
      5);
  EXPECT_EQ(drive.x(), 0);
  EXPECT_NEAR(way, 30, 1e-9);
  drive.command.override = 1;
  drive.run([&] { return drive.progress().atEnd && drive.x() == 70; }, 5);
  EXPECT_EQ(drive.x(), 70);
}

TEST(Interpolator, ADryRunIsNotFasterWhateverTheOverrideIs) {
  Drive drive;
  drive.line(1000, 0);
  drive.line(2000, 0, 0);
  drive.queue.endOfList = 1;
  drive.queue.dryRunVelocity = 40;
  drive.start();
  for (const double override : {3.0, 0.5, 1.0}) {
    drive.command.override = override;
    drive.run([&] { return std::fabs(drive.velocity() - 40 * std::min(override, 1.0)) < 1e-6; }, 2);
  }
  drive.finish();
  EXPECT_NEAR(drive.fastest, 40, 1e-6);
}

TEST(Interpolator, PassesSwitchesOnTheWayThereOnly) {
  Drive drive;
  drive.command.twoWays = true;
  PathObject &line = drive.line(100, 0);
  const int16_t id[] = {1, 2, 3};
  for (int i = 0; i < 3; ++i) {
    line.switchPosition[i] = 0.25 * (i + 1);
    line.switchId[i] = id[i];
  }
  drive.line(200, 0);
  drive.queue.endOfList = 1;
  drive.start();
  std::vector<int16_t> seen[2]; // there, back
  const auto until = [&](auto done) {
    drive.run([&] {
      if (drive.progress().lastSwitch != 0)
        seen[drive.interpolator->backwards ? 1 : 0].push_back(drive.progress().lastSwitch);
      return done();
    });
  };
  until([&] { return drive.x() > 30; });
  drive.command.override = -1; // between the first and the second one
  until([&] { return drive.velocity() > 0 && drive.x() < 15; });
  drive.command.override = 1;
  until([&] { return drive.x() > 120; });
  drive.command.override = -1; // from the second object back over all
  until([&] { return drive.progress().atEnd; });
  EXPECT_EQ(seen[0], (std::vector<int16_t>{1, 1, 2, 3})); // the first one twice
  EXPECT_TRUE(seen[1].empty());
}

TEST(Interpolator, RefusesWhatCannotBeDriven) {
  struct Case {
    int16_t error;
    void (*spoil)(Drive &, PathObject &);
  };
  const Case cases[] = {
      {1001, [](Drive &, PathObject &line) { line.velocity = 0; }},
      {1008, [](Drive &, PathObject &line) { line.acceleration = 0; }},
      {1008, [](Drive &, PathObject &line) { line.deceleration = -1; }},
      {1006, [](Drive &drive, PathObject &) { drive.queue.generator = cnc::kByDecoder; }},
      {1007,
       [](Drive &, PathObject &line) {
         line.end.coordinate[1] = std::numeric_limits<double>::quiet_NaN();
       }},
      {1007, [](Drive &, PathObject &line) { line.moveType = static_cast<MoveType>(77); }},
      {1501, [](Drive &drive, PathObject &) { drive.command.queue = nullptr; }},
      {1501, [](Drive &drive, PathObject &) { drive.queue.structId = 1; }},
      {1501, [](Drive &drive, PathObject &) { drive.queue.buffer = nullptr; }},
  };
  for (const Case &one : cases) {
    Drive drive;
    PathObject &line = drive.line(30, 0);
    drive.line(60, 10);
    drive.queue.endOfList = 1;
    one.spoil(drive, line);
    drive.start();
    drive.step();
    EXPECT_EQ(drive.interpolator->phase, Phase::Failed) << one.error;
    EXPECT_EQ(drive.interpolator->error, one.error);
    EXPECT_EQ(drive.step().motion.velocity, 0);
  }
}

TEST(Interpolator, DrivesShortLinesAsFastAsALongOne) {
  Drive drive(LawKind::Jerk, 4000);
  drive.command.cycle = 0.002;
  drive.command.budget = 128;
  constexpr int kLines = 100'000;
  int lines = 0;
  const auto fill = [&] {
    while (lines < kLines && !cnc::isFull(&drive.queue))
      drive.line(0.001 * ++lines, 0).velocity = 20;
    drive.queue.endOfList = lines == kLines ? 1 : 0;
  };
  fill();
  drive.start();
  drive.run([&] {
    fill();
    return drive.interpolator->phase == Phase::Finished;
  });
  EXPECT_EQ(drive.x(), 0.001 * kLines);
  EXPECT_NEAR(drive.fastest, 20, 1e-6);
  EXPECT_LT(drive.time, 100.0 / 20 + 0.3);
}

TEST_P(EachLaw, DrivesALineOfAThousandKilometres) {
  Drive drive(GetParam());
  drive.command.cycle = 0.01;
  drive.command.jerk = 1e7;
  PathObject &line = drive.line(-6e8, 8e8);
  line.velocity = 1e7;
  line.acceleration = 2e6;
  line.deceleration = 1e6;
  drive.queue.endOfList = 1;
  drive.start();
  const double ramps = 0.5 * 1e7 * (1 / 2e6 + 1 / 1e6);
  const double jerks = GetParam() == LawKind::Jerk ? 0.5 * (2e6 + 1e6) / 1e7 : 0;
  EXPECT_NEAR(drive.finish(200), 1e9 / 1e7 + ramps + jerks, 0.1);
  EXPECT_EQ(drive.x(), -6e8);
  EXPECT_EQ(drive.y(), 8e8);
}

/// The plan reaches the end of all that fits into a course before the motion does.
TEST_P(EachLaw, GoesOnWhereMoreObjectsFollowThanItCanKnow) {
  Drive drive(GetParam(), 700);
  for (int i = 1; i <= 600; ++i) {
    drive.line(0.06 * i, 0);
    cnc::objectFromEnd(&drive.queue, 0)->velocity = i % 2 == 0 ? 100 : 30; // strips of 0.6 ms
  }
  drive.queue.endOfList = 1;
  drive.start();
  const double time = drive.finish(10);
  EXPECT_EQ(drive.x(), 0.06 * 600);
  EXPECT_LT(time, 2);
}

TEST(Interpolator, FailsWhenSomebodyElseTakesTheObjectsOfItsPath) {
  for (const uint32_t taken : {1U, 2U, 3U}) {
    Drive drive;
    drive.line(30, 0);
    drive.line(60, 10);
    drive.line(70, -10);
    drive.queue.endOfList = 1;
    drive.start();
    for (int i = 0; i < 20; ++i)
      drive.step();
    ASSERT_EQ(drive.interpolator->phase, Phase::Moving);
    for (uint32_t i = 0; i < taken; ++i)
      removeAt(&drive.queue, 0);
    drive.step();
    EXPECT_EQ(drive.interpolator->phase, Phase::Failed) << taken;
    EXPECT_EQ(drive.interpolator->error, 1007);
    EXPECT_EQ(drive.step().motion.velocity, 0);
  }
}

} // namespace
