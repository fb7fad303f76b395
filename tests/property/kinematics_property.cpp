// Laws of all kinematics, with random measures and joints: the way there and back again in every
// posture, Jacobians and jets against differences, closed forms and distances as oracles.
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/motion_of_joints.hpp"
#include "runtime/numeric/kinematics/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <type_traits>

namespace stride::kinematics {
namespace {

/// Poses for each kinematics: 100,000, or STRIDE_KINEMATICS_POSES.
int posesToTry() {
  const char *asked = std::getenv("STRIDE_KINEMATICS_POSES");
  return asked == nullptr ? 100'000 : std::atoi(asked);
}

class Random {
public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  /// A length, or 0 in one of five.
  double offset(double most) { return between(0, 1) < 0.2 ? 0.0 : between(-most, most); }

private:
  std::mt19937_64 engine_{20261124};
};

Scara2 make(Random &random, const Scara2 *) {
  return {.firstArm = random.between(0.1, 1), .secondArm = random.between(0.1, 1)};
}
Scara2Z make(Random &random, const Scara2Z *) {
  return {make(random, static_cast<Scara2 *>(nullptr))};
}
Scara3 make(Random &random, const Scara3 *) {
  return {.arms = make(random, static_cast<Scara2 *>(nullptr)), .thirdArm = random.offset(0.3)};
}
Scara3Z make(Random &random, const Scara3Z *) {
  return {make(random, static_cast<Scara3 *>(nullptr))};
}
PolarZ make(Random &, const PolarZ *) { return {}; }
TurningAxis make(Random &random, const TurningAxis *) {
  return {.toolX = random.offset(0.2), .toolY = random.offset(0.2), .toolZ = random.offset(0.2)};
}
Wrist2 make(Random &random, const Wrist2 *) {
  return {.toolLength = random.offset(0.3),
          .rollX = random.offset(0.1),
          .rollY = random.offset(0.1),
          .rollZ = random.offset(0.1)};
}
Wrist3 make(Random &random, const Wrist3 *) {
  return {.toolX = random.offset(0.2), .toolY = random.offset(0.2), .toolZ = random.offset(0.2)};
}
Gantry2 make(Random &, const Gantry2 *) { return {}; }
Gantry3 make(Random &, const Gantry3 *) { return {}; }
ArmRrr make(Random &random, const ArmRrr *) {
  return {.d1 = random.offset(1),
          .a1 = random.offset(0.2),
          .a2 = random.between(0.2, 1),
          .d3 = random.offset(0.1),
          .a3 = random.offset(0.1),
          .d4 = random.between(0.2, 1)};
}
Palletiser make(Random &random, const Palletiser *) {
  return {.shoulderHeight = random.offset(1),
          .shoulderFront = random.offset(0.2),
          .upperArm = random.between(0.2, 1),
          .forearm = random.between(0.2, 1),
          .handFront = random.offset(0.2),
          .handDown = random.offset(0.2)};
}
OffsetWristArm make(Random &random, const OffsetWristArm *) {
  const double upper = random.between(0, 1) < 0.5 ? -1 : 1;
  const double fore = random.between(0, 1) < 0.5 ? -1 : 1;
  return {.d1 = random.offset(0.2),
          .a2 = upper * random.between(0.2, 0.6),
          .a3 = fore * random.between(0.2, 0.6),
          .d4 = random.offset(0.2),
          .d5 = random.offset(0.1),
          .d6 = random.offset(0.1)};
}
FiveAxisTable make(Random &random, const FiveAxisTable *) {
  return {.centreX = random.offset(0.3),
          .centreY = random.offset(0.3),
          .centreZ = random.offset(0.3),
          .tableHeight = random.offset(0.1)};
}
template <class Arm, class Hand>
Coupled<Arm, Hand> make(Random &random, const Coupled<Arm, Hand> *) {
  return {make(random, static_cast<Arm *>(nullptr)), make(random, static_cast<Hand *>(nullptr))};
}
BeltPortal make(Random &random, const BeltPortal *) {
  return random.between(0, 1) < 0.5 ? kHGantry2 : kTGantry2;
}
TripodLinear make(Random &random, const TripodLinear *) {
  return {.outerRadius = random.between(0.3, 0.5),
          .innerRadius = random.between(0, 0.2),
          .rod = random.between(0.9, 1.5),
          .lean = random.between(-0.2, 0.2),
          .firstAngle = random.between(-3, 3)};
}
TripodRotary make(Random &random, const TripodRotary *) {
  return {.upperArm = random.between(0.2, 0.4),
          .rod = random.between(0.9, 1.2),
          .motorRadius = random.between(0.1, 0.3),
          .plateRadius = random.between(0.03, 0.1),
          .firstAngle = random.between(-3, 3)};
}
BipodRotary make(Random &random, const BipodRotary *) {
  return {.motorDistance = random.between(0.1, 0.4),
          .upperArm = random.between(0.2, 0.4),
          .rod = random.between(0.9, 1.2),
          .plateDistance = random.between(0, 0.1)};
}

template <class Model> Model makeModel(Random &random) {
  return make(random, static_cast<Model *>(nullptr));
}

/// How many joints swing arms that rods hold together.
template <class Model> constexpr int kSwinging = 0;
template <> constexpr int kSwinging<TripodRotary> = 3;
template <> constexpr int kSwinging<BipodRotary> = 2;
template <class Hand> constexpr int kSwinging<Coupled<TripodRotary, Hand>> = 3;

/// Joints of parallel kinematics stay where their rods hold; others turn all the way round, and a
/// bit more.
template <class Model> void drawJoints(Random &random, double (&joint)[kMostJoints]) {
  for (int i = 0; i < Model::kJoints; ++i) {
    const bool turns = (Model::kTurning >> i & 1U) != 0;
    joint[i] = turns ? random.between(-4, 4) : random.between(-0.1, 0.1);
  }
  for (int i = 0; i < kSwinging<Model>; ++i)
    joint[i] = random.between(-0.6, 1.2);
  if (std::is_same_v<Model, PolarZ>)
    joint[1] = random.between(0.01, 1);
}

/// How far two poses are apart, as far as the model answers for them.
template <class Model>
double apart(const Frame<double> &a, const Frame<double> &b, const Model &model) {
  constexpr Task kTask = Model::kTask;
  Vector<double> way = a.place - b.place;
  if (kTask == Task::Plane || kTask == Task::PlaneTurn)
    way(2) = 0;
  double turn = 0;
  if (kTask == Task::Full || kTask == Task::PlaneTurn || kTask == Task::PlaceTurn)
    turn = (a.turn - b.turn).norm();
  if (kTask == Task::PlaceDirection)
    turn = (a.turn.col(2) - b.turn.col(2)).norm();
  return way.norm() / model.reach() + turn;
}

template <class Model> class EveryKinematics : public ::testing::Test {};

using Models =
    ::testing::Types<Gantry3, Gantry2Turn, Gantry3Turn, BeltPortal, PolarZ, Scara2, Scara2Z, Scara3,
                     Scara3Z, Scara2ZTurn, ArmRrr, Palletiser, ArticulatedArm, OffsetWristArm,
                     FiveAxisHead, FiveAxisTable, TripodLinear, TripodRotary, BipodRotary,
                     Coupled<TripodRotary, TurningAxis>>;
TYPED_TEST_SUITE(EveryKinematics, Models);

constexpr Posture postureNumber(int number) {
  return {.backwards = (number & 1) != 0, .elbow = (number & 2) != 0, .hand = (number & 4) != 0};
}

/// Poses near a singular one may be a billionth of the reach off, others a billionth of a
/// thousandth.
template <class Model>
void expectSame(const Frame<double> &pose, const Frame<double> &again, const Model &model,
                const double *joint) {
  const double error = apart(pose, again, model);
  if (error > 1e-12) {
    EXPECT_LT(error, 1e-9);
    EXPECT_LT(distanceFromSingular(model, joint), 1e-3) << "error " << error;
  }
}

TYPED_TEST(EveryKinematics, LeadsBackInEveryPosture) {
  Random random;
  int ways = 0;
  for (int i = 0; i < posesToTry() && !this->HasFailure(); ++i) {
    const TypeParam model = makeModel<TypeParam>(random);
    double joint[kMostJoints];
    drawJoints<TypeParam>(random, joint);
    Frame<double> pose;
    if (model.forward(joint, pose) != Outcome::Done)
      continue;
    const Posture own = model.postureOf(joint);
    for (int number = 0; number < 8; ++number) {
      const Posture posture = postureNumber(number);
      double found[kMostJoints];
      const Outcome outcome = model.inverse(pose, posture, joint, found);
      if (posture == own) {
        ASSERT_EQ(outcome, Outcome::Done);
        // Its own posture: the joints it came from, where nothing else leads there.
        if (i % 16 == 0 && distanceFromSingular(model, joint) > 1e-3) {
          for (int k = 0; k < TypeParam::kJoints; ++k)
            EXPECT_NEAR(found[k], joint[k], 1e-9) << "joint " << k;
        }
      }
      if (outcome != Outcome::Done)
        continue;
      ++ways;
      Frame<double> again;
      ASSERT_EQ(model.forward(found, again), Outcome::Done);
      expectSame(pose, again, model, found);
      for (int k = 0; k < TypeParam::kJoints; ++k) {
        const bool turns = (TypeParam::kTurning >> k & 1U) != 0;
        EXPECT_TRUE(!turns || std::abs(found[k] - joint[k]) <= kPi + 1e-12) << "joint " << k;
      }
    }
  }
  EXPECT_GT(ways, posesToTry() / 2);
}

TYPED_TEST(EveryKinematics, ItsJacobianIsThatOfDifferences) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const TypeParam model = makeModel<TypeParam>(random);
    double joint[kMostJoints];
    drawJoints<TypeParam>(random, joint);
    Jacobian<TypeParam> jacobian;
    if (jacobianOf(model, joint, jacobian) != Outcome::Done)
      continue;
    constexpr double kStep = 1e-6;
    for (int k = 0; k < TypeParam::kJoints; ++k) {
      Frame<double> before;
      Frame<double> after;
      const double middle = joint[k];
      joint[k] = middle - kStep;
      if (model.forward(joint, before) != Outcome::Done)
        continue;
      joint[k] = middle + kStep;
      if (model.forward(joint, after) != Outcome::Done)
        continue;
      joint[k] = middle;
      const Matrix<double> turn = after.turn * before.turn.transpose();
      const Vector<double> rate = Vector<double>(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0),
                                                 turn(1, 0) - turn(0, 1)) /
                                  (4 * kStep);
      const Vector<double> velocity = (after.place - before.place) / (2 * kStep);
      // Differences are bad where a parallel kinematics is nearly singular.
      const double tolerance = 1e-7 * (1 + jacobian.col(k).squaredNorm() * jacobian.norm());
      EXPECT_LT((velocity - jacobian.col(k).template head<3>()).norm(), tolerance);
      EXPECT_LT((rate - jacobian.col(k).template tail<3>()).norm(), tolerance);
    }
  }
}

TYPED_TEST(EveryKinematics, JointsMoveAsTheyDidWhenTheToolFollowsItsPath) {
  Random random;
  int tried = 0;
  for (int i = 0; i < 2000; ++i) {
    const TypeParam model = makeModel<TypeParam>(random);
    double joint[kMostJoints];
    drawJoints<TypeParam>(random, joint);
    Jet<3> moving[kMostJoints];
    for (int k = 0; k < TypeParam::kJoints; ++k) {
      moving[k] = Jet<3>(joint[k]);
      for (int order = 1; order <= 3; ++order)
        moving[k].c[order] = random.between(-1, 1);
    }
    const double singular = distanceFromSingular(model, joint);
    Frame<Jet<3>> path;
    if (singular < 1e-2 || model.forward(moving, path) != Outcome::Done)
      continue;
    Jet<3> found[kMostJoints];
    ASSERT_EQ(model.inverse(path, model.postureOf(joint), joint, found), Outcome::Done);
    ++tried;
    for (int k = 0; k < TypeParam::kJoints; ++k)
      for (int order = 1; order <= 3; ++order)
        EXPECT_NEAR(found[k].c[order], moving[k].c[order],
                    1e-10 * std::pow(singular, 1 - 2 * order))
            << "joint " << k << " order " << order << " from singular " << singular;
  }
  EXPECT_GT(tried, 500);
}

TEST(Jets, HoldTheDerivativesOfClosedForms) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const double a = random.between(-3, 3);
    const double b = random.between(0.2, 2);
    const Jet<3> x = [&] {
      Jet<3> line(a);
      line.c[1] = b;
      return line;
    }();
    const TurnOf<Jet<3>> turn = turnBy(x);
    EXPECT_NEAR(turn.s.c[3], -b * b * b * std::cos(a) / 6, 1e-14);
    EXPECT_NEAR(turn.c.c[2], -b * b * std::cos(a) / 2, 1e-14);
    const Jet<3> angle = angleOf(turn.s, turn.c);
    EXPECT_NEAR(angle.c[1], b, 1e-14);
    EXPECT_NEAR(angle.c[2], 0, 1e-13);
    EXPECT_NEAR(angle.c[3], 0, 1e-12);
    const Jet<3> root = rootOf(x * x + Jet<3>(1.0));
    const double r = std::sqrt(a * a + 1);
    EXPECT_NEAR(root.c[1], a * b / r, 1e-14);
    EXPECT_NEAR(root.c[2], b * b / (2 * r * r * r), 1e-14);
    EXPECT_NEAR(root.c[3], -a * b * b * b / (2 * std::pow(r, 5)), 1e-13);
    const Jet<3> quotient = Jet<3>(1.0) / (x * x + Jet<3>(1.0));
    EXPECT_NEAR(quotient.c[1], -2 * a * b / std::pow(r, 4), 1e-13);
  }
}

// ---- forms of their own, beside which the models stand

TEST(ArmOfSixAxes, StandsAsItsMakersSay) {
  const ArticulatedArm arm{{.d1 = 0.5, .a1 = 0.1, .a2 = 0.4, .d3 = 0.05, .a3 = 0.06, .d4 = 0.35},
                           {.toolX = 0, .toolY = 0, .toolZ = 0.12}};
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
