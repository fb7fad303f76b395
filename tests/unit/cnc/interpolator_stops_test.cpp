// The interpolator, cycle by cycle: each way to stop it.
#include "tests/unit/cnc/interpolator_drive.hpp"

#include "runtime/numeric/cnc/velocity_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace stride;
using namespace stride::test;

class EachLawStops : public testing::TestWithParam<LawKind> {};
INSTANTIATE_TEST_SUITE_P(Interpolator, EachLawStops,
                         testing::Values(LawKind::Trapezoid, LawKind::Sigmoid, LawKind::Jerk));

TEST_P(EachLawStops, StopsOnThePathAndGoesOn) {
  Drive drive(GetParam());
  drive.line(60, 0);
  drive.line(120, 30);
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.x() > 40; });
  drive.command.slowStop = true;
  const double begin = drive.time;
  drive.run([&] { return drive.velocity() == 0; }, 1);
  EXPECT_LE(drive.time - begin, 1.3 * (100.0 / 500 + 2 * 500.0 / 20000));
  const double held = drive.x();
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(drive.step().waits);
    EXPECT_EQ(drive.x(), held);
  }
  EXPECT_NEAR(drive.y(), held <= 60 ? 0 : (held - 60) / 2, 1e-9);
  drive.command.slowStop = false;
  drive.finish();
  EXPECT_EQ(drive.x(), 120);
  EXPECT_EQ(drive.y(), 30);
}

TEST_P(EachLawStops, StopsSoonerWithMoreDeceleration) {
  double way[2];
  for (const bool quick : {false, true}) {
    Drive drive(GetParam());
    drive.line(100, 0);
    drive.queue.endOfList = 1;
    drive.command.quickDeceleration = 2000;
    drive.command.jerk = 200'000;
    drive.start();
    drive.run([&] { return drive.x() > 40; });
    (quick ? drive.command.quickStop : drive.command.slowStop) = true;
    drive.run([&] { return drive.velocity() == 0; }, 1);
    way[quick ? 1 : 0] = drive.x() - 40;
  }
  EXPECT_LT(way[1], 0.7 * way[0]);
}

TEST_P(EachLawStops, StandsStillAtOnceAndGoesOn) {
  Drive drive(GetParam());
  drive.line(100, 0);
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.x() > 40; });
  const double held = drive.x();
  drive.command.emergencyStop = true;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(drive.step().motion.velocity, 0);
    EXPECT_EQ(drive.x(), held);
    EXPECT_TRUE(drive.progress().waits);
  }
  drive.command.emergencyStop = false;
  drive.finish();
  EXPECT_EQ(drive.x(), 100);
}

TEST_P(EachLawStops, WaitsWhereThePathRests) {
  Drive drive(GetParam());
  drive.line(30, 0, 0);
  drive.line(30, 40, 0);
  drive.queue.endOfList = 1;
  drive.command.waitAtNextStop = true;
  drive.start();
  drive.run([&] { return drive.x() == 30; });
  for (int i = 0; i < 200; ++i)
    EXPECT_EQ(drive.step().motion.velocity, 0);
  EXPECT_EQ(drive.y(), 0);
  drive.command.waitAtNextStop = false;
  drive.finish();
  EXPECT_EQ(drive.y(), 40);
}

TEST_P(EachLawStops, RestsAtTheEndOfEachObjectInSingleSteps) {
  Drive drive(GetParam());
  for (int i = 1; i <= 5; ++i)
    drive.line(20 * i, 0);
  drive.queue.endOfList = 1;
  drive.command.singleStep = true;
  drive.start();
  for (int i = 1; i <= 5; ++i) {
    drive.run([&] { return drive.x() >= 20 * i; }, 5);
    EXPECT_EQ(drive.x(), 20 * i);
    EXPECT_EQ(drive.velocity(), 0);
  }
  drive.finish();
}

TEST_P(EachLawStops, StepsOnFromWhereItCanStop) {
  Drive drive(GetParam());
  for (int i = 1; i <= 12; ++i)
    drive.line(5 * i, 0);
  drive.queue.endOfList = 1;
  drive.start();
  drive.run([&] { return drive.x() > 21; });
  drive.command.singleStep = true;
  drive.run([&] { return drive.velocity() == 0; }, 5);
  EXPECT_NEAR(std::fmod(drive.x() + 1e-9, 5), 0, 1e-6);
  EXPECT_GT(drive.x(), 25);
  EXPECT_LT(drive.x(), 55);
  drive.command.singleStep = false;
  drive.finish();
}

/// A corner whose velocity SMC_CheckVelocities has still to lower, in another task.
TEST_P(EachLawStops, WaitsForObjectsToBeChecked) {
  Drive drive(GetParam(), 6);
  const cnc::CornerRules rules{1e-3, -1};
  uint32_t checked = UINT32_MAX;
  drive.line(30, 0);
  drive.line(30, 40);
  ASSERT_EQ(cnc::checkVelocities(&drive.queue, checked, rules), cnc::VelocityError::None);
  drive.line(80, 40); // fills the queue
  EXPECT_EQ(cnc::uncheckedOf(&drive.queue), 1U);
  drive.start();
  drive.run([&] { return drive.x() == 30; });
  for (int i = 0; i < 100; ++i)
    drive.step();
  EXPECT_EQ(drive.x(), 30);
  EXPECT_EQ(drive.y(), 0);
  EXPECT_EQ(drive.interpolator->warning, 0);
  ASSERT_EQ(cnc::checkVelocities(&drive.queue, checked, rules), cnc::VelocityError::None);
  EXPECT_EQ(cnc::uncheckedOf(&drive.queue), 0U);
  drive.run([&] { return drive.y() == 40; });
  EXPECT_EQ(drive.x(), 30);
  EXPECT_EQ(drive.velocity(), 0);
  drive.queue.endOfList = 1;
  // The end may be known before the last object has been checked: it is not the end yet.
  cnc::tellChecked(&drive.queue, cnc::objectAt(&drive.queue, 0) == nullptr ? 0 : UINT32_MAX - 1);
  for (int i = 0; i < 100; ++i)
    drive.step();
  EXPECT_EQ(drive.x(), 30);
  cnc::tellNobodyChecks(&drive.queue);
  drive.finish();
  EXPECT_EQ(drive.x(), 80);
}

} // namespace
