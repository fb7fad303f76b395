#include "runtime/motion/modulo.hpp"

#include "runtime/axis/modulo_wrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using stride::axis::wrapPosition;
using stride::motion::Direction;
using stride::motion::ModuloRequest;
using stride::motion::resolveModulo;

double resolve(double position, double velocity, double target, Direction direction,
               Direction lastMotion = Direction::Positive) {
  const ModuloRequest request{position,  velocity,   target,         360.0,
                              direction, lastMotion, {100, 100, 100}};
  double resolved = 0;
  EXPECT_TRUE(resolveModulo(request, resolved));
  return resolved;
}

TEST(Wrap, ReducesToOnePeriod) {
  EXPECT_EQ(wrapPosition(0, 360), 0.0);
  EXPECT_EQ(wrapPosition(360, 360), 0.0);
  EXPECT_EQ(wrapPosition(-90, 360), 270.0);
  EXPECT_EQ(wrapPosition(725, 360), 5.0);
  EXPECT_EQ(wrapPosition(-1e-300, 360), 0.0);
  EXPECT_FALSE(std::signbit(wrapPosition(-720, 360)));
}

TEST(Modulo, FromRest) {
  EXPECT_EQ(resolve(10, 0, 90, Direction::Positive), 90.0);
  EXPECT_EQ(resolve(10, 0, 90, Direction::Negative), -270.0);
  EXPECT_EQ(resolve(10, 0, 90, Direction::Shortest), 90.0);
  EXPECT_EQ(resolve(10, 0, 300, Direction::Shortest), -60.0);
  EXPECT_EQ(resolve(10, 0, 190, Direction::Shortest), 190.0) << "half a turn goes positive";
  EXPECT_EQ(resolve(200, 0, 20, Direction::Shortest), 380.0);
  EXPECT_EQ(resolve(10, 0, 300, Direction::Fastest), -60.0);
  EXPECT_EQ(resolve(10, 0, 90, Direction::Current), 90.0);
  EXPECT_EQ(resolve(10, 0, 90, Direction::Current, Direction::Negative), -270.0);
}

TEST(Modulo, AtTheTargetAlready) {
  for (const auto direction : {Direction::Positive, Direction::Negative, Direction::Shortest,
                               Direction::Current, Direction::Fastest})
    EXPECT_EQ(resolve(90, 0, 90, direction), 90.0);
  // Rounding of the present position costs no turn.
  EXPECT_EQ(resolve(1e-13, 0, 0, Direction::Positive), 0.0);
  EXPECT_EQ(resolve(360 - 1e-11, 0, 0, Direction::Negative), 360.0);
}

TEST(Modulo, AnyNumberOfPeriodsInTheTarget) {
  EXPECT_EQ(resolve(10, 0, 90 + 720, Direction::Positive), 90.0);
  EXPECT_EQ(resolve(10, 0, 90 - 720, Direction::Negative), -270.0);
}

TEST(Modulo, SingleDirectionNeverReverses) {
  // 100 u/s with 100 u/s^2: stops 50 u ahead.
  EXPECT_EQ(resolve(10, 100, 50, Direction::Positive), 410.0);
  EXPECT_EQ(resolve(10, 100, 70, Direction::Positive), 70.0);
  EXPECT_EQ(resolve(10, -100, 350, Direction::Negative), -370.0);
  EXPECT_EQ(resolve(10, -100, 300, Direction::Negative), -60.0);
  // Moving the other way: brakes first, then goes the demanded way.
  EXPECT_EQ(resolve(10, -100, 330, Direction::Positive), -30.0);
  EXPECT_EQ(resolve(10, 100, 50, Direction::Negative), 50.0);
  EXPECT_EQ(resolve(10, 100, 50, Direction::Current), 410.0);
  EXPECT_EQ(resolve(10, -100, 350, Direction::Current), -370.0);
}

TEST(Modulo, ShortestLooksAtPositionsFastestAtTimes) {
  EXPECT_EQ(resolve(10, 100, 350, Direction::Shortest), -10.0);
  EXPECT_EQ(resolve(10, 100, 230, Direction::Shortest), -130.0);
  EXPECT_EQ(resolve(10, 100, 230, Direction::Fastest), 230.0);
}

TEST(Modulo, RejectsUnusableNumbers) {
  const double inf = std::numeric_limits<double>::infinity();
  double resolved = 0;
  ModuloRequest request{0, 0, 1, 360, Direction::Positive, Direction::Positive, {1, 1, 1}};
  request.period = 0;
  EXPECT_FALSE(resolveModulo(request, resolved));
  request.period = 360;
  request.target = inf;
  EXPECT_FALSE(resolveModulo(request, resolved));
  request.target = 1;
  request.limits.deceleration = 0;
  EXPECT_FALSE(resolveModulo(request, resolved));
  request.limits.deceleration = 1;
  request.direction = static_cast<Direction>(7);
  EXPECT_FALSE(resolveModulo(request, resolved));
}

} // namespace
