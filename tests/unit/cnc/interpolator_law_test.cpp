// Another law while the path is gone over: it begins when the present ramp has ended.
#include "interpolator_drive.hpp"

namespace {

using namespace stride;
using namespace stride::test;

/// One line, gone over in half a second and more, with ramps of 0.1 and 0.2 s.
Drive onALine(LawKind law) {
  Drive drive(law);
  drive.line(120, 0);
  drive.queue.endOfList = 1;
  drive.start();
  return drive;
}

/// The greatest change of the velocity's change from call to call until the end: of the jerk.
double greatestJerk(Drive &drive) {
  double greatest = 0;
  double velocity = drive.velocity();
  double before = drive.progress().motion.acceleration;
  while (drive.interpolator->phase != Phase::Finished && drive.time < 10) {
    drive.step();
    const double acceleration = (drive.velocity() - velocity) / kCycle;
    greatest = std::max(greatest, std::fabs(acceleration - before) / kCycle);
    velocity = drive.velocity();
    before = acceleration;
  }
  EXPECT_EQ(drive.x(), 120);
  return greatest;
}

TEST(InterpolatorLaw, LimitsTheJerkAfterTheRampOfATrapezoid) {
  Drive drive = onALine(LawKind::Trapezoid);
  drive.run([&] { return drive.velocity() > 40; });
  drive.command.law = LawKind::Jerk;
  while (drive.velocity() < 100 - 1) { // it accelerates on as it did
    const double before = drive.velocity();
    drive.step();
    EXPECT_NEAR(drive.velocity() - before, 1000 * kCycle, 1e-9);
  }
  drive.run([&] { return drive.progress().motion.acceleration == 0; });
  EXPECT_LE(greatestJerk(drive), drive.command.jerk * (1 + 1e-6));
}

TEST(InterpolatorLaw, BrakesByATrapezoidAfterTheRampWithLimitedJerk) {
  Drive drive = onALine(LawKind::Jerk);
  drive.run([&] { return drive.velocity() > 40; });
  drive.command.law = LawKind::Trapezoid;
  double least = 0;
  double before = drive.velocity();
  while (drive.interpolator->phase != Phase::Finished) {
    drive.step();
    least = std::min(least, drive.velocity() - before);
    before = drive.velocity();
  }
  EXPECT_EQ(drive.x(), 120);
  EXPECT_NEAR(least, -500 * kCycle, 1e-6);
  EXPECT_EQ(drive.interpolator->motion.planned.settings.kind, LawKind::Trapezoid);
}

TEST(InterpolatorLaw, TakesAnotherJerkOverWhereTheVelocityIsConstant) {
  Drive drive = onALine(LawKind::Jerk);
  drive.run([&] { return drive.velocity() > 100 - 1e-9; });
  drive.command.jerk = 4000;
  EXPECT_LE(greatestJerk(drive), 4000 * (1 + 1e-6));
}

/// A sine within its limits needs pi / 2 times the way of the one that exceeds them.
TEST(InterpolatorLaw, KeepsTheShareOfASineFromThenOn) {
  Drive drive = onALine(LawKind::Trapezoid);
  drive.run([&] { return drive.velocity() == 100; });
  drive.command.law = LawKind::Sigmoid;
  drive.command.share = 2 / M_PI;
  drive.run([&] { return drive.velocity() < 100; });
  const double begin = drive.x();
  drive.finish();
  EXPECT_NEAR(120 - begin, 0.5 * 100 * 100 / (500 * 2 / M_PI), 0.2);
}

TEST(InterpolatorLaw, StopsAtOnceByTheOldOne) {
  Drive drive = onALine(LawKind::Trapezoid);
  drive.run([&] { return drive.velocity() > 40; });
  drive.command.law = LawKind::Jerk;
  drive.command.slowStop = true;
  const double begin = drive.time;
  drive.run([&] { return drive.velocity() == 0; });
  EXPECT_LE(drive.time - begin, 50.0 / 500 + 6 * kCycle);
  drive.command.slowStop = false;
  drive.run([&] { return drive.velocity() > 0; });
  EXPECT_EQ(drive.interpolator->motion.planned.settings.kind, LawKind::Jerk);
  EXPECT_LE(greatestJerk(drive), drive.command.jerk * (1 + 1e-6));
}

/// Through a corner, whose ramps follow each other: the new law begins between them.
TEST(InterpolatorLaw, BeginsBetweenRampsThatFollowEachOther) {
  Drive drive(LawKind::Trapezoid);
  for (int i = 1; i <= 20; ++i)
    drive.line(6 * i, 0, 20);
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.x() > 8; });
  drive.command.law = LawKind::Jerk;
  drive.run([&] { return drive.interpolator->motion.planned.settings.kind == LawKind::Jerk; }, 2);
  drive.finish();
  EXPECT_EQ(drive.x(), 120);
}

} // namespace
