#include "runtime/numeric/profile/modulo.hpp"

#include "runtime/numeric/modulo_wrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using stride::motion::Direction;
using stride::motion::ModuloRequest;
using stride::motion::RampType;
using stride::motion::resolveModulo;
using stride::numeric::wrapPosition;

double resolve(double position, double velocity, double target, Direction direction,
               Direction lastMotion = Direction::Positive) {
  const ModuloRequest request{{position, velocity, 0},
                              target,
                              0,
                              360,
                              direction,
                              lastMotion,
                              {RampType::Trapezoid, 100, 100, 100, 0}};
  double resolved = 0;
  EXPECT_TRUE(resolveModulo(request, resolved));
  return resolved;
}

/// With an end velocity, from 10.
double resolveTo(double velocity, double target, double endVelocity, Direction direction) {
  const ModuloRequest request{{10, velocity, 0},
                              target,
                              endVelocity,
                              360,
                              direction,
                              Direction::Positive,
                              {RampType::Trapezoid, 100, 100, 100, 0}};
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

// 100 u/s with 100 u/s^2 takes 50 u.
TEST(Modulo, EndVelocitiesNeedTheirRunUp) {
  EXPECT_EQ(resolveTo(0, 60, 100, Direction::Positive), 60.0);
  EXPECT_EQ(resolveTo(0, 59, 100, Direction::Positive), 419.0);
  EXPECT_EQ(resolveTo(0, 320, -100, Direction::Negative), -40.0);
  EXPECT_EQ(resolveTo(0, 321, -100, Direction::Negative), -399.0);
  // On the way already: it need not stop before.
  EXPECT_EQ(resolveTo(100, 20, 100, Direction::Positive), 20.0);
  EXPECT_EQ(resolveTo(100, 20, 0, Direction::Positive), 380.0);
  // Half the velocity is there after 37.5 u.
  EXPECT_EQ(resolveTo(100, 48, 50, Direction::Current), 48.0);
  EXPECT_EQ(resolveTo(100, 47, 50, Direction::Current), 407.0);
  // Against the direction: it turns behind the target.
  EXPECT_EQ(resolveTo(0, 60, -100, Direction::Positive), 60.0);
  // Going back for the run-up takes 2.1 s, the turn 4.3 s.
  EXPECT_EQ(resolveTo(0, 30, 100, Direction::Fastest), 30.0);
  EXPECT_EQ(resolveTo(100, 30, 0, Direction::Shortest), 30.0);
}

TEST(Modulo, JerkMovesTheStop) {
  ModuloRequest request{{0, 100, 0},
                        50 + 1e-9,
                        0,
                        360,
                        Direction::Positive,
                        Direction::Positive,
                        {RampType::Parabolic, 100, 100, 100, 100}};
  double resolved = 0;
  ASSERT_TRUE(resolveModulo(request, resolved));
  EXPECT_EQ(resolved, 410 + 1e-9) << "the stop takes 2 s and 100 u";
  request.target = 100;
  ASSERT_TRUE(resolveModulo(request, resolved));
  EXPECT_EQ(resolved, 100.0);
  request.dynamics.ramp = RampType::Sigmoid; // the trapezoid's time
  request.target = 50 + 1e-9;
  ASSERT_TRUE(resolveModulo(request, resolved));
  EXPECT_EQ(resolved, 50 + 1e-9);
  // At a standstill, but on the way.
  request.start = {0, 0, -10};
  request.direction = Direction::Current;
  ASSERT_TRUE(resolveModulo(request, resolved));
  EXPECT_EQ(resolved, -310 + 1e-9);
}

TEST(Modulo, RejectsUnusableNumbers) {
  const double inf = std::numeric_limits<double>::infinity();
  double resolved = 0;
  ModuloRequest request{{0, 0, 0},
                        1,
                        0,
                        360,
                        Direction::Positive,
                        Direction::Positive,
                        {RampType::Trapezoid, 1, 1, 1, 0}};
  request.period = 0;
  EXPECT_FALSE(resolveModulo(request, resolved));
  request.period = 360;
  request.target = inf;
  EXPECT_FALSE(resolveModulo(request, resolved));
  request.target = 1;
  request.dynamics.deceleration = 0;
  EXPECT_FALSE(resolveModulo(request, resolved));
  request.dynamics.deceleration = 1;
  request.direction = static_cast<Direction>(7);
  EXPECT_FALSE(resolveModulo(request, resolved));
}

} // namespace
