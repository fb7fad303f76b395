// SMC_MoveContinuousRelative.AdaptEndVelToAvoidOvershoot.
#include "tests/unit/axis/axis_rig.hpp"

#include "st/SM_PLCopen/SMC_MoveContinuousRelative.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using stride::test::AxisRig;
using stride::test::fresh;

/// What a move of 2 u with an end velocity of 30 u/s comes to, at 100 u/s^2.
struct Course {
  double lowest = 0;      ///< Least position.
  double endVelocity = 0; ///< [u/s]
};

Course courseOf(bool adapt, int16_t ramp) {
  AxisRig rig;
  EXPECT_GT(rig.powerUp(), 0);
  rig.axis.eRampType = ramp;
  rig.axis.fJerk = 4000;
  auto move = fresh<::st::SM_PLCopen::SMC_MoveContinuousRelative>();
  move.Axis = &rig.axis;
  move.Distance = 2;
  move.Velocity = 30;
  move.EndVelocity = 30;
  move.EndVelocityDirection = 1;
  move.Acceleration = move.Deceleration = 100;
  move.AdaptEndVelToAvoidOvershoot = adapt;
  Course course;
  for (int i = 0; i < 3000; ++i) {
    rig.cycle([&] { rig.call(move, true); });
    EXPECT_EQ(move.Error, 0);
    course.lowest = std::min(course.lowest, rig.axis.fSetPosition);
  }
  EXPECT_EQ(move.InEndVelocity, 1);
  course.endVelocity = rig.axis.fSetVelocity;
  return course;
}

TEST(EndVelocity, IsAdaptedWhereTheWayIsTooShort) {
  for (int16_t ramp = 0; ramp < 4; ++ramp) {
    SCOPED_TRACE(ramp);
    const Course backwards = courseOf(false, ramp);
    EXPECT_LT(backwards.lowest, -0.5);
    EXPECT_EQ(backwards.endVelocity, 30);
    const Course straight = courseOf(true, ramp);
    EXPECT_GE(straight.lowest, 0);
    EXPECT_GT(straight.endVelocity, 10);
    EXPECT_LE(straight.endVelocity, 20 * (1 + 1e-9)); // sqrt(2 * 100 * 2)
    EXPECT_TRUE(ramp != 0 || std::fabs(straight.endVelocity - 20) <= 1e-6);
  }
}

} // namespace
