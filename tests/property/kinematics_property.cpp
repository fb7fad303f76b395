// Laws of all kinematics, with random measures and joints: the way there and back again in every
// posture, Jacobians and jets against differences, closed forms and distances as oracles.
#include "runtime/numeric/kinematics/motion_of_joints.hpp"

#include "tests/property/random_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace stride::kinematics {
namespace {

/// Poses for each kinematics: 100,000, or STRIDE_KINEMATICS_POSES.
int posesToTry() {
  const char *asked = std::getenv("STRIDE_KINEMATICS_POSES");
  return asked == nullptr ? 100'000 : std::atoi(asked);
}

using random::drawJoints;
using random::makeModel;
using random::Random;

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

TEST(Jets, TurnTowardsPointsAsByTheirAngles) {
  Random random;
  for (int i = 0; i < 3000; ++i) {
    // Also so small and so large that squares would not be numbers any more.
    const double size = std::pow(10, random.between(-290, 290));
    Jet<3> x(size * random.between(-2, 2));
    Jet<3> y(size * random.between(-2, 2));
    for (int order = 1; order <= 3; ++order) {
      x.c[order] = random.between(-1, 1);
      y.c[order] = random.between(-1, 1);
    }
    const double exact = std::atan2(y.c[0], x.c[0]);
    const Jet<3> angle = [&] {
      Jet<3> any(exact + 2 * kPi * (i % 3));
      for (int order = 1; order <= 3; ++order)
        any.c[order] = random.between(-1, 1);
      return any;
    }();
    const TurnOf<Jet<3>> turn = turnTowards(y, x, angle);
    EXPECT_NEAR(turn.c.c[0], std::cos(exact), 3e-15);
    EXPECT_NEAR(turn.s.c[0], std::sin(exact), 3e-15);
    EXPECT_NEAR(turn.c.c[1], -std::sin(exact) * angle.c[1], 3e-15);
    EXPECT_NEAR(turn.s.c[2],
                std::cos(exact) * angle.c[2] - std::sin(exact) * angle.c[1] * angle.c[1] / 2,
                1e-14);
  }
  const TurnOf<double> none = turnTowards(0.0, 0.0, 0.25);
  EXPECT_EQ(none.c, turnBy(0.25).c);
  EXPECT_EQ(none.s, turnBy(0.25).s);
}

TYPED_TEST(EveryKinematics, SeesTurnsFromItsFlange) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const TypeParam model = makeModel<TypeParam>(random);
    double joint[kMostJoints];
    drawJoints<TypeParam>(random, joint);
    Frame<double> flange;
    if (model.forward(joint, flange) != Outcome::Done)
      continue;
    const Matrix<double> turn = aboutZ(random.between(-3, 3)) * aboutX(random.between(-3, 3)) *
                                aboutZ(random.between(-3, 3));
    const Matrix<double> seen = seenFromFlange(model, joint, turn);
    EXPECT_LT((flange.turn.transpose() * turn - seen).norm(), 1e-14);
    if constexpr (kHasHeading<TypeParam, double>) {
      EXPECT_LT((flange.turn - aboutZ(model.heading(joint))).norm(), 1e-14);
    }
  }
}

} // namespace
} // namespace stride::kinematics
