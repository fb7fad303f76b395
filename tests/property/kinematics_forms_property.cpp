// Kinematics beside closed forms: makers' tables, lengths of rods, limits of reach.
#include "tests/property/random_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::kinematics {
namespace {

using random::drawJoints;
using random::makeModel;
using random::Random;

TEST(ArmOfSixAxes, StandsAsItsMakersSay) {
  const ArticulatedArm arm{{.d1 = 0.5, .a1 = 0.1, .a2 = 0.4, .d3 = 0.05, .a3 = 0.06, .d4 = 0.35},
                           {{.toolX = 0, .toolY = 0, .toolZ = 0.12}}};
  const double zero[6] = {};
  Frame<double> pose;
  ASSERT_EQ(arm.forward(zero, pose), Outcome::Done);
  // Kin_ArticulatedRobot_6DOF: (a1 + d4 + d6, -d3, d1 + a2 + a3), the tool's axes +z, -y, +x
  EXPECT_LT((pose.place - Vector<double>(0.1 + 0.35 + 0.12, -0.05, 0.5 + 0.4 + 0.06)).norm(),
            1e-15);
  EXPECT_LT((pose.turn.col(0) - Vector<double>(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((pose.turn.col(1) - Vector<double>(0, -1, 0)).norm(), 1e-15);
  EXPECT_LT((pose.turn.col(2) - Vector<double>(1, 0, 0)).norm(), 1e-15);
  const Posture posture = arm.postureOf(zero);
  EXPECT_FALSE(posture.backwards);
  EXPECT_FALSE(posture.elbow);
}

/// Denavit and Hartenberg's step by Eigen's own turns.
Eigen::Isometry3d step(double theta, double d, double a, double alpha) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(theta, Eigen::Vector3d::UnitZ())) *
         Eigen::Translation3d(a, 0, d) * Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitX());
}

TEST(ArmOfSixAxes, IsTheProductOfItsTable) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto arm = makeModel<ArticulatedArm>(random);
    double q[kMostJoints];
    drawJoints<ArticulatedArm>(random, q);
    const Eigen::Isometry3d wanted =
        step(q[0], arm.arm.d1, arm.arm.a1, kPi / 2) * step(q[1] + kPi / 2, 0, arm.arm.a2, 0) *
        step(q[2], arm.arm.d3, arm.arm.a3, kPi / 2) * step(q[3], arm.arm.d4, 0, kPi / 2) *
        step(q[4], 0, 0, -kPi / 2) * step(q[5], 0, 0, 0) * Eigen::Translation3d(arm.hand.offset());
    Frame<double> pose;
    ASSERT_EQ(arm.forward(q, pose), Outcome::Done);
    EXPECT_LT((wanted.linear() - pose.turn).norm() + (wanted.translation() - pose.place).norm(),
              1e-14);
  }
}

TEST(ArmWithOffsetWrist, IsTheProductOfItsTable) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto arm = makeModel<OffsetWristArm>(random);
    double q[kMostJoints];
    drawJoints<OffsetWristArm>(random, q);
    const Eigen::Isometry3d wanted = step(q[0], arm.d1, 0, kPi / 2) * step(q[1], 0, arm.a2, 0) *
                                     step(q[2], 0, arm.a3, 0) * step(q[3], arm.d4, 0, kPi / 2) *
                                     step(q[4], arm.d5, 0, -kPi / 2) * step(q[5], arm.d6, 0, 0);
    Frame<double> pose;
    ASSERT_EQ(arm.forward(q, pose), Outcome::Done);
    EXPECT_LT((wanted.linear() - pose.turn).norm() + (wanted.translation() - pose.place).norm(),
              1e-14);
  }
}

TEST(Delta, ItsRodsKeepTheirLengths) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto delta = makeModel<TripodRotary>(random);
    double q[kMostJoints];
    drawJoints<TripodRotary>(random, q);
    Frame<double> pose;
    if (delta.forward(q, pose) != Outcome::Done)
      continue;
    for (int k = 0; k < 3; ++k) {
      const Eigen::AngleAxisd around(delta.firstAngle + 2 * kPi / 3 * k, Eigen::Vector3d::UnitZ());
      const Eigen::Vector3d elbow =
          around * Eigen::Vector3d(delta.motorRadius + delta.upperArm * std::cos(q[k]), 0,
                                   delta.motorHeight() - delta.upperArm * std::sin(q[k]));
      const Eigen::Vector3d joint = pose.place + around * Eigen::Vector3d(delta.plateRadius, 0, 0);
      EXPECT_NEAR((elbow - joint).norm(), delta.rod, 1e-13);
      EXPECT_LT(pose.place(2), elbow(2));
    }
  }
  // Level arms: the plate is at the origin.
  const TripodRotary delta{0.2, 0.9, 0.15, 0.05, 0.3};
  const double zero[3] = {};
  Frame<double> pose;
  ASSERT_EQ(delta.forward(zero, pose), Outcome::Done);
  EXPECT_LT(pose.place.norm(), 1e-15);
}

TEST(LinearTripod, ItsRodsKeepTheirLengthsAndPositiveIsDown) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto tripod = makeModel<TripodLinear>(random);
    double q[kMostJoints];
    drawJoints<TripodLinear>(random, q);
    Frame<double> pose;
    ASSERT_EQ(tripod.forward(q, pose), Outcome::Done);
    for (int k = 0; k < 3; ++k) {
      const Eigen::AngleAxisd around(tripod.firstAngle + 2 * kPi / 3 * k, Eigen::Vector3d::UnitZ());
      const Eigen::Vector3d slide =
          around * Eigen::Vector3d(tripod.outerRadius - q[k] * std::sin(tripod.lean), 0,
                                   -q[k] * std::cos(tripod.lean));
      const Eigen::Vector3d joint = pose.place + around * Eigen::Vector3d(tripod.innerRadius, 0, 0);
      EXPECT_NEAR((slide - joint).norm(), tripod.rod, 1e-13);
      EXPECT_LT(joint(2), slide(2));
    }
  }
}

TEST(Bipod, ItsRodsKeepTheirLengths) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto bipod = makeModel<BipodRotary>(random);
    double q[kMostJoints];
    drawJoints<BipodRotary>(random, q);
    Frame<double> pose;
    if (bipod.forward(q, pose) != Outcome::Done)
      continue;
    for (int k = 0; k < 2; ++k) {
      const double side = k == 0 ? -1 : 1;
      const double x = side * (bipod.motorDistance / 2 + bipod.upperArm * std::cos(q[k]));
      const double y = -bipod.upperArm * std::sin(q[k]);
      EXPECT_NEAR(std::hypot(pose.place(0) + side * bipod.plateDistance / 2 - x, pose.place(1) - y),
                  bipod.rod, 1e-13);
      EXPECT_LT(pose.place(1), y);
    }
  }
}

TEST(BeltPortals, MoveAsTheirMakersSay) {
  Frame<double> pose;
  const double apart[] = {3.0, -3.0};
  ASSERT_EQ(kHGantry2.forward(apart, pose), Outcome::Done);
  EXPECT_GT(pose.place(0), 0);
  EXPECT_EQ(pose.place(1), 0);
  const double backwards[] = {-3.0, -3.0};
  ASSERT_EQ(kHGantry2.forward(backwards, pose), Outcome::Done);
  EXPECT_EQ(pose.place(0), 0);
  EXPECT_GT(pose.place(1), 0);
  const double forwards[] = {3.0, 3.0};
  ASSERT_EQ(kTGantry2.forward(forwards, pose), Outcome::Done);
  EXPECT_GT(pose.place(0), 0);
  EXPECT_EQ(pose.place(1), 0);
  const double crossed[] = {-3.0, 3.0};
  ASSERT_EQ(kTGantry2.forward(crossed, pose), Outcome::Done);
  EXPECT_EQ(pose.place(0), 0);
  EXPECT_GT(pose.place(1), 0);
}

TEST(FiveAxes, TheHeadSwingsTheToolTowardsX) {
  const FiveAxisHead head{{}, {.toolLength = 0.2, .rollX = 0, .rollY = 0, .rollZ = 0}};
  const double zero[5] = {};
  Frame<double> pose;
  ASSERT_EQ(head.forward(zero, pose), Outcome::Done);
  EXPECT_LT((pose.place - Vector<double>(0, 0, 0.2)).norm(), 1e-16);
  const double tilted[] = {0, 0, 0, 0, kPi / 6};
  ASSERT_EQ(head.forward(tilted, pose), Outcome::Done);
  EXPECT_LT((pose.place - Vector<double>(0.1, 0, 0.2 * std::sqrt(0.75))).norm(), 1e-15);
}

TEST(FiveAxes, ThePointOnTheTableStaysUnderTheToolThatFollowsIt) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto table = makeModel<FiveAxisTable>(random);
    double q[kMostJoints];
    drawJoints<FiveAxisTable>(random, q);
    Frame<double> pose;
    ASSERT_EQ(table.forward(q, pose), Outcome::Done);
    // The workpiece's point carried into the machine: swivel about x, on it the turn about z.
    const Eigen::Vector3d inMachine = Eigen::Vector3d(table.centreX, table.centreY, table.centreZ) +
                                      Eigen::AngleAxisd(q[3], Eigen::Vector3d::UnitX()) *
                                          (Eigen::AngleAxisd(q[4], Eigen::Vector3d::UnitZ()) *
                                           (pose.place + Eigen::Vector3d(0, 0, table.tableHeight)));
    EXPECT_LT((inMachine - Eigen::Vector3d(q[0], q[1], q[2])).norm(), 1e-14);
  }
}

// ---- limits of reach

TEST(Reach, EndsWhereTheArmIsStretchedOrFolded) {
  const Scara2 arms{.firstArm = 0.4, .secondArm = 0.3};
  const double reference[2] = {};
  double joint[2];
  const auto reaches = [&](double x, double y) {
    return arms.inverse(unturned<double>({x, y, 0.0}), {}, reference, joint) == Outcome::Done;
  };
  EXPECT_TRUE(reaches(0.7, 0));
  EXPECT_NEAR(joint[1], 0, 1e-7);
  EXPECT_FALSE(reaches(0.7000001, 0));
  EXPECT_TRUE(reaches(0.6999999, 0));
  EXPECT_FALSE(reaches(0, -0.0999999));
  EXPECT_TRUE(reaches(0, -0.1000001));
  EXPECT_FALSE(reaches(std::nan(""), 0));
}

TEST(Reach, WrongMeasuresAreSaid) {
  const double reference[6] = {};
  double joint[6];
  const Frame<double> pose = unturned<double>({0.3, 0.1, 0.0});
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    const Scara2 arms{.firstArm = wrong, .secondArm = 0.3};
    EXPECT_EQ(arms.inverse(pose, {}, reference, joint), Outcome::WrongMeasures) << wrong;
    const TripodLinear tripod{0.5, 0.1, -std::abs(wrong), 0, 0};
    EXPECT_EQ(tripod.inverse(pose, {}, reference, joint), Outcome::WrongMeasures) << wrong;
  }
  const TripodRotary tooShort{0.5, 0.4, 0.2, 0.05,
                              0}; // level arms are further out than the rods reach
  EXPECT_EQ(tooShort.inverse(pose, {}, reference, joint), Outcome::WrongMeasures);
}

TEST(Reach, SingularPlacesKeepTheJointsOfBefore) {
  const Polar polar;
  const double reference[2] = {2.5, 0};
  double joint[2];
  ASSERT_EQ(polar.inverse(unturned<double>({0, 0, 0}), {}, reference, joint), Outcome::Done);
  EXPECT_EQ(joint[0], 2.5);
  const Wrist3 wrist{};
  const double last[3] = {0.7, 0, 0};
  double hand[3];
  wrist.turnTo(aboutZ(1.2), {}, last, hand);
  EXPECT_EQ(hand[0], 0.7);
  EXPECT_NEAR(hand[1], 0, 1e-15);
  EXPECT_NEAR(hand[2], 0.5, 1e-15);
}

} // namespace
} // namespace stride::kinematics
