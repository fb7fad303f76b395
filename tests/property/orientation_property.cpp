// Orientations against Eigen's products of turns, at gimbal lock, too; the way between two of them.
#include "runtime/numeric/kinematics/motion_of_joints.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stride::kinematics {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// The product of turns that the convention names.
Eigen::Matrix3d product(Convention convention, const Angles &angles) {
  const auto turn = [](double degrees, const Vector3d &axis) {
    return AngleAxisd(degrees * M_PI / 180, axis);
  };
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  switch (convention) {
  case Convention::Zyz:
    return (turn(angles.a, z) * turn(angles.b, y) * turn(angles.c, z)).toRotationMatrix();
  case Convention::Zyx:
    return (turn(angles.a, z) * turn(angles.b, y) * turn(angles.c, x)).toRotationMatrix();
  case Convention::Xyz:
    break;
  }
  return (turn(angles.a, x) * turn(angles.b, y) * turn(angles.c, z)).toRotationMatrix();
}

constexpr Convention kConventions[] = {Convention::Zyz, Convention::Zyx, Convention::Xyz};

/// Angles all over, and near and at multiples of 90 degrees.
double drawAngle(std::mt19937_64 &random) {
  const double anywhere = std::uniform_real_distribution<double>(-400, 400)(random);
  const auto kind = random() % 4;
  if (kind == 0)
    return 90 * std::round(anywhere / 90);
  if (kind == 1)
    return 90 * std::round(anywhere / 90) +
           std::pow(10, std::uniform_real_distribution<double>(-18, -3)(random));
  return anywhere;
}

TEST(Orientation, AnglesLeadThereAndBack) {
  std::mt19937_64 random{7};
  for (int i = 0; i < 100'000 && !testing::Test::HasFailure(); ++i)
    for (const Convention convention : kConventions) {
      const Angles angles{drawAngle(random), drawAngle(random), drawAngle(random)};
      const Matrix<double> turn = turnFrom(convention, angles);
      EXPECT_LT((turn - product(convention, angles)).norm(), 2e-14);
      const Angles found = anglesOf(convention, turn);
      EXPECT_LT((turnFrom(convention, found) - turn).norm(), 3e-12);
      EXPECT_TRUE(found.a > -180 && found.a <= 180 && found.c > -180 && found.c <= 180);
      EXPECT_TRUE(convention == Convention::Zyz ? found.b >= 0 && found.b <= 180
                                                : std::abs(found.b) <= 90)
          << found.b;
    }
}

TEST(Orientation, AtGimbalLockTheLastAngleIsNought) {
  for (const double b : {0.0, 180.0}) {
    const Angles found = anglesOf(Convention::Zyz, turnFrom(Convention::Zyz, {50, b, 20}));
    EXPECT_NEAR(found.a, b == 0 ? 70 : 30, 1e-13);
    EXPECT_EQ(found.b, b);
    EXPECT_EQ(found.c, 0);
  }
  for (const Convention convention : {Convention::Zyx, Convention::Xyz})
    for (const double b : {90.0, -90.0}) {
      const Angles found = anglesOf(convention, turnFrom(convention, {50, b, 20}));
      EXPECT_EQ(found.b, b);
      EXPECT_EQ(found.c, 0);
    }
  // The largest angle is 180, never -180.
  const Angles back = anglesOf(Convention::Zyz, turnFrom(Convention::Zyz, {-180, 30, -180}));
  EXPECT_EQ(back.a, 180);
  EXPECT_EQ(back.c, 180);
}

TEST(Orientation, QuarterTurnsAreExact) {
  const Matrix<double> turn = turnFrom(Convention::Zyz, {90, 90, -90});
  for (int i = 0; i < 9; ++i)
    EXPECT_TRUE(turn.data()[i] == 0 || std::abs(turn.data()[i]) == 1);
}

Eigen::Matrix3d drawTurn(std::mt19937_64 &random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

TEST(GreatCircles, AreSlerp) {
  std::mt19937_64 random{8};
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Matrix3d from = drawTurn(random);
    const Eigen::Matrix3d to = drawTurn(random);
    const GreatCircle way = greatCircle(from, to);
    const double part = std::uniform_real_distribution<double>(0, 1)(random);
    const Eigen::Quaterniond wanted = Eigen::Quaterniond(from).slerp(part, Eigen::Quaterniond(to));
    // Eigen's slerp loses digits with turns of nearly half a turn.
    const double tolerance = 1e-13 / std::max(1e-4, 3.15 - way.angle);
    EXPECT_LT((way.at(part) - wanted.toRotationMatrix()).norm(), tolerance);
    EXPECT_LT((way.at(0.0) - from).norm() + (way.at(1.0) - to).norm(), 1e-14);
    EXPECT_TRUE(way.angle >= 0 && way.angle <= M_PI);
  }
}

TEST(GreatCircles, TurnEvenlyInAllDerivatives) {
  std::mt19937_64 random{9};
  for (int i = 0; i < 1000; ++i) {
    const GreatCircle way = greatCircle(drawTurn(random), drawTurn(random));
    Jet<3> part(0.3);
    part.c[1] = 1;
    const Matrix<Jet<3>> turn = way.at(part);
    const Eigen::Vector3d rate = turnRateOf(turn);
    EXPECT_LT((rate - way.axis * way.angle).norm(), 1e-13);
    // With a constant rate: R'' = W W R, R''' = W W W R.
    Eigen::Matrix3d value;
    Eigen::Matrix3d third;
    for (int k = 0; k < 9; ++k) {
      value.data()[k] = turn.data()[k].c[0];
      third.data()[k] = turn.data()[k].c[3] * 6;
    }
    Eigen::Matrix3d w;
    w << 0, -rate(2), rate(1), rate(2), 0, -rate(0), -rate(1), rate(0), 0;
    EXPECT_LT((third - w * w * w * value).norm(), 1e-12);
  }
}

TEST(GreatCircles, SmallAndHalfTurnsAreExact) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-3, M_PI - 1e-9, M_PI}) {
    const Matrix<double> from = turnFrom(Convention::Zyx, {20, -30, 140});
    const Matrix<double> to = AngleAxisd(angle, axis).toRotationMatrix() * from;
    const GreatCircle way = greatCircle(from, to);
    EXPECT_NEAR(way.angle, angle, 1e-15);
    EXPECT_LT((way.at(1.0) - to).norm(), 1e-15) << angle;
  }
}

TEST(Frames, InvertedTheyLeadBack) {
  std::mt19937_64 random{10};
  for (int i = 0; i < 1000; ++i) {
    const Frame<double> frame{drawTurn(random), Eigen::Vector3d::Random()};
    const Frame<double> same = inverted(frame) * frame;
    EXPECT_LT((same.turn - Eigen::Matrix3d::Identity()).norm() + same.place.norm(), 1e-14);
  }
}

} // namespace
} // namespace stride::kinematics
