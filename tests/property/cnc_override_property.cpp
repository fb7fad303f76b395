// A lower override and a feed hold while the path is gone over with limited jerk: the motion takes
// them over soon, whatever feed, accelerations and jerk are.
#include "tests/property/motion_problems.hpp"
#include "tests/unit/cnc/interpolator_drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using namespace stride::test;
using stride::path::LawKind;

struct Trial {
  double feed, acceleration, deceleration, jerk, override;
  int lines;
  double least = 0; ///< Least feed of a line. [u/s]

  /// Time of the slowest ramp between rest and feed. [s]
  double ramp() const {
    const double most = std::max(acceleration, deceleration);
    return feed / std::min(acceleration, deceleration) + most / jerk;
  }
  /// Time to fall to the least velocity of the override: first the acceleration ends, then a ramp
  /// of constant jerk. [s]
  double fall() const {
    const double lost = feed - least * override;
    const double time = deceleration * deceleration / jerk > lost
                            ? 2 * std::sqrt(lost / jerk)
                            : lost / deceleration + deceleration / jerk;
    return time + acceleration / jerk * (1 + acceleration / deceleration);
  }
};

Trial randomTrial(Random &random, int number) {
  Trial trial{};
  trial.feed = random.magnitude(0, 2.4);
  trial.acceleration = trial.feed * random.magnitude(0, 1.7);
  trial.deceleration = trial.feed * random.magnitude(0, 1.7);
  trial.jerk = std::max(trial.acceleration, trial.deceleration) * random.magnitude(0, 2.2);
  trial.override = number % 5 == 0 ? random.magnitude(-1.7, 0) : random.uniform(0.05, 1);
  trial.lines = number % 3 == 0 ? 1 : 1 + random.below(20);
  return trial;
}

void program(Drive &drive, Trial &trial, Random &random) {
  const double length = 12 * trial.feed * trial.ramp();
  trial.least = trial.feed;
  for (int i = 1; i <= trial.lines; ++i) {
    stride::cnc::PathObject &line = drive.line(length * i / trial.lines, 0);
    line.velocity = line.velocityEnd = trial.feed * random.uniform(0.5, 1);
    line.acceleration = trial.acceleration;
    line.deceleration = trial.deceleration;
    trial.least = std::min(trial.least, line.velocity);
  }
  drive.queue.endOfList = 1;
  drive.command.cycle = 0.002;
  drive.command.budget = 128;
  drive.command.jerk = trial.jerk;
  drive.command.limitKinks = true;
}

} // namespace

TEST(Override, ALowerOneIsTakenOverSoonAndWithoutRest) {
  constexpr double kPlanning = 0.25; // [s]
  Random random(11);
  int judged = 0;
  int dips = 0; // where more of the path was planned too late
  for (int i = 0; i < casesOf(1000); ++i) {
    Trial trial = randomTrial(random, i);
    SCOPED_TRACE(testing::Message()
                 << "trial " << i << ", feed " << trial.feed << ", override " << trial.override);
    Drive drive(LawKind::Jerk);
    program(drive, trial, random);
    drive.start();
    const double change = trial.ramp() * random.uniform(0.2, 4);
    while (drive.time < change)
      drive.step();
    const double before = drive.velocity();
    if (before <= trial.feed * trial.override)
      continue;
    drive.command.override = trial.override;
    const double begin = drive.time;
    double lowest = before;
    while (drive.velocity() > trial.feed * trial.override * (1 + 1e-6)) {
      ASSERT_LT(drive.time - begin, trial.fall() + kPlanning);
      drive.step();
    }
    for (const double time = drive.time; drive.time < time + 2 * trial.ramp(); drive.step())
      lowest = std::min(lowest, drive.velocity());
    dips += lowest < 0.95 * std::min(before, trial.least * trial.override) ? 1 : 0;
    ++judged;
  }
  EXPECT_GT(judged, casesOf(1000) / 2);
  EXPECT_LE(dips, 1 + judged / 100);
}

/// At rest within 1.3 * (V / A + 2 * A / J), planning included; and at rest it stays.
TEST(FeedHold, RestsSoonWhereverItIs) {
  Random random(5);
  for (int i = 0; i < casesOf(1000); ++i) {
    Trial trial = randomTrial(random, i);
    trial.deceleration = trial.acceleration = trial.feed * random.magnitude(0, 2);
    trial.jerk = trial.acceleration * random.magnitude(0.43, 1.7);
    trial.lines = i % 3 == 0 ? 1 : 1 + random.below(40);
    SCOPED_TRACE(testing::Message()
                 << "trial " << i << ", feed " << trial.feed << ", lines " << trial.lines);
    Drive drive(LawKind::Jerk);
    program(drive, trial, random);
    drive.command.cycle = 0.001;
    drive.command.budget = 64;
    drive.start();
    const double hold = trial.ramp() * random.uniform(0.2, 6);
    while (drive.time < hold)
      drive.step();
    drive.command.slowStop = true;
    const double begin = drive.time;
    const double allowed =
        1.3 * (trial.feed / trial.acceleration + 2 * trial.acceleration / trial.jerk);
    while (drive.velocity() > 0) {
      ASSERT_LT(drive.time - begin, allowed);
      drive.step();
    }
    const double place = drive.x();
    for (int k = 0; k < 20; ++k)
      drive.step();
    ASSERT_EQ(drive.x(), place);
    drive.command.slowStop = false;
    drive.run([&] { return drive.velocity() > 0; }, 1);
    EXPECT_GT(drive.velocity(), 0);
  }
}

/// Lines with corners of any angle, which the axes' accelerations limit.
void cornerProgram(Drive &drive, Trial &trial, Random &random) {
  double x = 0;
  double y = 0;
  double direction = 0;
  const double length = trial.feed * trial.ramp() * random.magnitude(-1, 1);
  for (int i = 0; i < 60; ++i) {
    direction += random.chance(0.7) ? random.uniform(-2, 2) : random.uniform(-0.1, 0.1);
    const double way = length * random.magnitude(-0.7, 0.3);
    stride::cnc::PathObject &line =
        drive.line(x += way * std::cos(direction), y += way * std::sin(direction));
    line.velocity = line.velocityEnd =
        trial.feed * (random.chance(0.7) ? 1 : random.uniform(0.3, 1));
    line.acceleration = trial.acceleration;
    line.deceleration = trial.deceleration;
  }
  drive.queue.endOfList = 1;
  drive.command.cycle = 0.001;
  drive.command.budget = 64;
  drive.command.jerk = trial.jerk;
  drive.command.limitKinks = true;
  for (const int32_t axis : {stride::cnc::kAxisX, stride::cnc::kAxisY})
    drive.command.limits.acceleration[axis] = trial.acceleration * random.uniform(0.7, 2);
}

/// The same on paths with corners, which it has to pass slowly.
TEST(FeedHold, RestsSoonBetweenCorners) {
  Random random(6);
  double worst = 0;
  int judged = 0;
  for (int i = 0; i < casesOf(1000); ++i) {
    Trial trial = randomTrial(random, i);
    trial.deceleration = trial.acceleration = trial.feed * random.magnitude(0, 2);
    trial.jerk = trial.acceleration * random.magnitude(0.43, 1.7);
    SCOPED_TRACE(testing::Message() << "trial " << i << ", feed " << trial.feed);
    Drive drive(LawKind::Jerk);
    cornerProgram(drive, trial, random);
    drive.start();
    const double hold = trial.ramp() * random.uniform(0.2, 12);
    while (drive.time < hold && drive.interpolator->phase != Phase::Finished)
      drive.step();
    const double *axes = drive.command.limits.acceleration;
    const double braking = std::min({trial.acceleration, axes[0], axes[1]});
    const double allowed = 1.3 * (trial.feed / braking + 2 * braking / trial.jerk);
    const double begin = drive.time;
    judged += drive.velocity() > 0 ? 1 : 0;
    drive.command.slowStop = true;
    while (drive.velocity() > 0)
      drive.step();
    worst = std::max(worst, (drive.time - begin) / allowed);
    ASSERT_LT(drive.time - begin, allowed);
  }
  EXPECT_GT(judged, casesOf(1000) / 2);
  std::printf("%d stops between corners: %.2f of the time that they may take at most\n", judged,
              worst);
}

/// On a straight line it begins in the same call: the ramp takes no planning to speak of.
TEST(FeedHold, BeginsAtOnce) {
  Drive drive(LawKind::Jerk);
  drive.line(1000, 0);
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.velocity() >= 100 && drive.progress().motion.acceleration == 0; });
  drive.command.slowStop = true;
  drive.step();
  EXPECT_LT(drive.velocity(), 100);
  const double begin = drive.time - kCycle;
  drive.run([&] { return !(drive.velocity() > 0); });
  EXPECT_LE(drive.time - begin, 100.0 / 500 + 500.0 / drive.command.jerk + kCycle);
}
