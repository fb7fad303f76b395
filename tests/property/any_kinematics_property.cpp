// Kinematics chosen at run time against those chosen when the test is compiled (the same bits),
// turns within limits against a search, tools, and what does not fit.
#include "runtime/numeric/kinematics/any_kinematics.hpp"
#include "runtime/numeric/kinematics/motion_of_joints.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "tests/property/random_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace stride::kinematics {
namespace {

using random::drawJoints;
using random::makeModel;
using random::Random;

static_assert(std::is_trivially_copyable_v<AnyKinematics> &&
              std::is_standard_layout_v<AnyKinematics>);

template <class Model> constexpr ArmKind kArmKind = ArmKind::None;
template <> constexpr ArmKind kArmKind<Gantry2> = ArmKind::Gantry2;
template <> constexpr ArmKind kArmKind<Gantry3> = ArmKind::Gantry3;
template <> constexpr ArmKind kArmKind<BeltPortal> = ArmKind::BeltPortal;
template <> constexpr ArmKind kArmKind<Polar> = ArmKind::Polar;
template <> constexpr ArmKind kArmKind<PolarZ> = ArmKind::PolarZ;
template <> constexpr ArmKind kArmKind<Scara2> = ArmKind::Scara2;
template <> constexpr ArmKind kArmKind<Scara2Z> = ArmKind::Scara2Z;
template <> constexpr ArmKind kArmKind<Scara3> = ArmKind::Scara3;
template <> constexpr ArmKind kArmKind<Scara3Z> = ArmKind::Scara3Z;
template <> constexpr ArmKind kArmKind<ArmRrr> = ArmKind::ArmRrr;
template <> constexpr ArmKind kArmKind<Palletiser> = ArmKind::Palletiser;
template <> constexpr ArmKind kArmKind<OffsetWristArm> = ArmKind::OffsetWristArm;
template <> constexpr ArmKind kArmKind<FiveAxisTable> = ArmKind::FiveAxisTable;
template <> constexpr ArmKind kArmKind<TripodLinear> = ArmKind::TripodLinear;
template <> constexpr ArmKind kArmKind<TripodRotary> = ArmKind::TripodRotary;
template <> constexpr ArmKind kArmKind<BipodRotary> = ArmKind::BipodRotary;
template <class Hand> constexpr HandKind kHandKind = HandKind::None;
template <> constexpr HandKind kHandKind<TurningAxis> = HandKind::TurningAxis;
template <> constexpr HandKind kHandKind<Wrist2> = HandKind::Wrist2;
template <> constexpr HandKind kHandKind<Wrist3> = HandKind::Wrist3;

template <class Model> AnyKinematics anyOf(const Model &model) {
  AnyKinematics any{};
  any.setArm(kArmKind<Model>, model);
  return any;
}
template <class Arm, class Hand> AnyKinematics anyOf(const Coupled<Arm, Hand> &model) {
  AnyKinematics any{};
  any.setArm(kArmKind<Arm>, model.arm);
  any.setHand(kHandKind<Hand>, model.hand);
  return any;
}

inline Polar makePolar() { return {}; }
template <class Model> Model drawModel(Random &random) { return makeModel<Model>(random); }
template <> Polar drawModel<Polar>(Random &) { return makePolar(); }

template <class Model> class AnyOfThem : public ::testing::Test {};
using Models = ::testing::Types<Gantry2, Gantry3, Gantry2Turn, Gantry3Turn, BeltPortal, Polar,
                                PolarZ, Scara2, Scara2Z, Scara3, Scara3Z, Scara2ZTurn, ArmRrr,
                                Palletiser, ArticulatedArm, OffsetWristArm, FiveAxisHead,
                                FiveAxisTable, TripodLinear, TripodRotary, BipodRotary,
                                Coupled<TripodRotary, TurningAxis>, Coupled<TripodLinear, Wrist3>>;
TYPED_TEST_SUITE(AnyOfThem, Models);

constexpr double kDegrees = 0.017453292519943295; // [rad]

template <class Model, class Scalar>
void inRadians(const Scalar *axes, Scalar (&joints)[kMostJoints]) {
  for (int i = 0; i < Model::kJoints; ++i)
    joints[i] = (Model::kTurning >> i & 1U) != 0 ? axes[i] * Scalar(kDegrees) : axes[i];
}

/// The same bits; -0 is 0.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
bool same(const Jet<3> &a, const Jet<3> &b) {
  bool all = true;
  for (int k = 0; k <= 3; ++k)
    all = all && same(a.c[k], b.c[k]);
  return all;
}
template <class Scalar> bool same(const Frame<Scalar> &a, const Frame<Scalar> &b) {
  bool all = true;
  for (int row = 0; row < 3; ++row) {
    all = all && same(a.place(row), b.place(row));
    for (int column = 0; column < 3; ++column)
      all = all && same(a.turn(row, column), b.turn(row, column));
  }
  return all;
}

/// Both ways, in all postures.
template <class Model, class Scalar>
void expectTheSame(const Model &model, const AnyKinematics &any, const Scalar *axes) {
  Scalar joints[kMostJoints];
  inRadians<Model>(axes, joints);
  double reference[kMostJoints];
  double referenceJoints[kMostJoints];
  for (int i = 0; i < Model::kJoints; ++i)
    reference[i] = valueOf(axes[i]);
  inRadians<Model>(reference, referenceJoints);
  const KinematicsRef ref = any.ref();
  Frame<Scalar> wanted;
  Frame<Scalar> found;
  const Outcome outcome = model.forward(joints, wanted);
  ASSERT_EQ(ref.forward(axes, found), outcome);
  if (outcome != Outcome::Done)
    return;
  EXPECT_TRUE(same(wanted, found));
  EXPECT_EQ(postureOf(ref.configurationOf(reference)), model.postureOf(referenceJoints));
  for (unsigned bits = 0; bits < 8; ++bits) {
    const Posture posture{
        .backwards = (bits & 1U) != 0, .elbow = (bits & 2U) != 0, .hand = (bits & 4U) != 0};
    Scalar direct[kMostJoints];
    Scalar byTable[kMostJoints];
    const Outcome back = model.inverse(wanted, posture, referenceJoints, direct);
    ASSERT_EQ(ref.inverse(wanted, configurationOf(posture), reference, byTable), back);
    for (int i = 0; back == Outcome::Done && i < Model::kJoints; ++i) {
      const bool turns = (Model::kTurning >> i & 1U) != 0;
      EXPECT_TRUE(same(turns ? direct[i] / Scalar(kDegrees) : direct[i], byTable[i]));
      EXPECT_EQ(ref.turns(i), turns);
    }
  }
}

TYPED_TEST(AnyOfThem, DoTheSameAsTheirModels) {
  Random random;
  for (int i = 0; i < 300 && !this->HasFailure(); ++i) {
    const TypeParam model = drawModel<TypeParam>(random);
    AnyKinematics kept = anyOf(model);
    AnyKinematics any; // NOLINT(cppcoreguidelines-pro-type-member-init): copied byte by byte
    std::memcpy(&any, &kept, sizeof any);
    std::memset(&kept, 0xff, sizeof kept);
    ASSERT_EQ(any.check(), Outcome::Done);
    ASSERT_EQ(any.joints(), TypeParam::kJoints);
    ASSERT_EQ(any.task(), TypeParam::kTask);
    ASSERT_EQ(any.reach(), model.reach());
    double joints[kMostJoints];
    drawJoints<TypeParam>(random, joints);
    double axes[kMostJoints];
    Jet<3> moving[kMostJoints];
    for (int k = 0; k < TypeParam::kJoints; ++k) {
      axes[k] = any.ref().turns(k) ? joints[k] / kDegrees : joints[k];
      moving[k] = Jet<3>(axes[k]);
      for (int order = 1; order <= 3; ++order)
        moving[k].c[order] = random.between(-1, 1);
    }
    expectTheSame<TypeParam>(model, any, axes);
    expectTheSame<TypeParam>(model, any, moving);
    double inRad[kMostJoints];
    inRadians<TypeParam>(axes, inRad);
    const double wanted = distanceFromSingular(model, inRad);
    EXPECT_NEAR(any.distanceFromSingular(axes), wanted, 1e-12 * (1 + wanted));
  }
}

// ---- limits

TEST(Turns, AreTheNearestWithinTheLimits) {
  Random random;
  int found = 0;
  int none = 0;
  for (int i = 0; i < 20'000; ++i) {
    AnyKinematics polar{};
    polar.setArm(ArmKind::Polar, Polar{});
    const double lower = std::round(random.between(-600, 300));
    const double upper = lower + std::round(random.between(0, 700));
    polar.range[0] = {true, lower, upper};
    polar.offset[0] = random.offset(50);
    polar.offset[1] = 0.25;
    const double angle = random.between(-180, 180);
    const double reference[2] = {random.between(-900, 900), 0};
    double axes[2];
    const Outcome outcome = polar.inverse(
        {Matrix<double>::Identity(), aboutZ(angle * kDegrees).col(0)}, {}, reference, axes);
    double best = std::numeric_limits<double>::infinity();
    for (int turn = -6; turn <= 6; ++turn) {
      const double candidate = angle + polar.offset[0] + 360 * turn;
      if (candidate >= lower && candidate <= upper &&
          std::abs(candidate - reference[0]) < std::abs(best - reference[0]))
        best = candidate;
    }
    if (std::isinf(best)) {
      ++none;
      EXPECT_EQ(outcome, Outcome::OutOfLimits);
      continue;
    }
    ++found;
    ASSERT_EQ(outcome, Outcome::Done);
    EXPECT_NEAR(axes[0], best, 1e-9);
    EXPECT_NEAR(axes[1], 1.25, 1e-15);
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(none, 1000);
}

TEST(Limits, HoldForSlidesAtBelowAndAbove) {
  AnyKinematics gantry{};
  gantry.setArm(ArmKind::Gantry2, Gantry2{});
  gantry.range[1] = {true, -2, 3};
  const double reference[2] = {};
  double axes[2];
  const auto outcomeAt = [&](double y) {
    return gantry.inverse(unturned<double>({1e6, y, 0}), {}, reference, axes);
  };
  EXPECT_EQ(outcomeAt(-2), Outcome::Done);
  EXPECT_EQ(outcomeAt(3), Outcome::Done);
  EXPECT_EQ(outcomeAt(-2.001), Outcome::OutOfLimits);
  EXPECT_EQ(outcomeAt(3.001), Outcome::OutOfLimits);
  EXPECT_EQ(outcomeAt(3 + 1e-12), Outcome::Done); // rounding
  EXPECT_EQ(axes[1], 3);
}

// ---- tools

/// How far the tool is from where it was sent, as far as the kinematics answers for it.
template <class Model>
void expectToolComesThere(const Model &model, Random &random, const Frame<double> &offset) {
  AnyKinematics any = anyOf(model);
  any.setTool(offset);
  ASSERT_EQ(any.check(), Outcome::Done);
  double joints[kMostJoints];
  drawJoints<Model>(random, joints);
  for (int i = 0; i < Model::kJoints; ++i)
    joints[i] = any.ref().turns(i) ? joints[i] / kDegrees : joints[i];
  Frame<double> tool;
  if (any.forward(joints, tool) != Outcome::Done)
    return;
  AnyKinematics bare = any;
  bare.clearTool();
  Frame<double> end;
  ASSERT_EQ(bare.forward(joints, end), Outcome::Done);
  EXPECT_TRUE(same(end * offset, tool));
  double found[kMostJoints];
  ASSERT_EQ(any.inverse(tool, any.postureOf(joints), joints, found), Outcome::Done);
  Frame<double> again;
  ASSERT_EQ(any.forward(found, again), Outcome::Done);
  EXPECT_LT((again.place - tool.place).norm(), 1e-9 * (1 + model.reach()));
}

TEST(Tools, ComeWhereTheyAreSent) {
  Random random;
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    const Frame<double> offset{
        turnFrom(Convention::Zyz,
                 {random.between(-180, 180), random.between(0, 180), random.between(-180, 180)}),
        {random.offset(0.1), random.offset(0.1), random.offset(0.1)}};
    expectToolComesThere(drawModel<Gantry3>(random), random, offset);
    expectToolComesThere(drawModel<Gantry3Turn>(random), random, offset);
    expectToolComesThere(drawModel<Scara2ZTurn>(random), random, offset);
    expectToolComesThere(drawModel<Scara3Z>(random), random, offset);
    expectToolComesThere(drawModel<Palletiser>(random), random, offset);
    expectToolComesThere(drawModel<FiveAxisHead>(random), random, offset);
    expectToolComesThere(drawModel<FiveAxisTable>(random), random, offset);
    expectToolComesThere(drawModel<ArticulatedArm>(random), random, offset);
    expectToolComesThere(drawModel<OffsetWristArm>(random), random, offset);
    expectToolComesThere(drawModel<TripodRotary>(random), random, offset);
    const Frame<double> along{offset.turn, {0, 0, offset.place(2)}};
    expectToolComesThere(drawModel<Scara2Z>(random), random, along);
    expectToolComesThere(drawModel<PolarZ>(random), random, along);
    expectToolComesThere(drawModel<ArmRrr>(random), random, {offset.turn, {0, 0, 0}});
  }
}

TEST(Tools, ThatNobodyCanPlaceAreRefused) {
  Random random;
  AnyKinematics scara = anyOf(makeModel<Scara2Z>(random));
  scara.setTool(unturned<double>({0.1, 0, 0}));
  EXPECT_EQ(scara.check(), Outcome::WrongTool);
  scara.setTool(unturned<double>({0, 0, 0.1}));
  EXPECT_EQ(scara.check(), Outcome::Done);
  AnyKinematics arm = anyOf(makeModel<ArmRrr>(random));
  arm.setTool(unturned<double>({0, 0, 0.1}));
  EXPECT_EQ(arm.check(), Outcome::WrongTool);
}

// ---- what does not fit

TEST(Checks, SayWhatIsWrong) {
  Random random;
  AnyKinematics none{};
  EXPECT_EQ(none.check(), Outcome::NotSet);
  Frame<double> pose;
  double axes[kMostJoints] = {};
  EXPECT_EQ(none.forward(axes, pose), Outcome::NotSet);
  EXPECT_EQ(none.inverse(unturned<double>({0, 0, 0}), {}, axes, axes), Outcome::NotSet);
  EXPECT_EQ(none.joints(), 0);

  for (const double wrong : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
    AnyKinematics scara{};
    scara.setArm(ArmKind::Scara2Z, Scara2Z{{.firstArm = 0.3, .secondArm = wrong}});
    EXPECT_EQ(scara.check(), Outcome::WrongMeasures) << wrong;
  }
  AnyKinematics arm = anyOf(makeModel<ArticulatedArm>(random));
  arm.handMeasure[1] = std::nan("");
  EXPECT_EQ(arm.check(), Outcome::WrongMeasures);
  arm.handMeasure[1] = 0;
  arm.offset[5] = HUGE_VAL;
  EXPECT_EQ(arm.check(), Outcome::WrongMeasures);
  arm.offset[5] = 0;
  arm.range[2] = {true, 10, 5};
  EXPECT_EQ(arm.check(), Outcome::WrongLimits);

  // A yaw that nobody turns upright, an arm that turns by itself, a roll axis beside a turning
  // flange.
  AnyKinematics coupled{};
  coupled.setArm(ArmKind::ArmRrr, makeModel<ArmRrr>(random));
  coupled.setHand(HandKind::TurningAxis, TurningAxis{});
  EXPECT_EQ(coupled.check(), Outcome::WrongCoupling);
  coupled.setArm(ArmKind::Scara3Z, makeModel<Scara3Z>(random));
  EXPECT_EQ(coupled.check(), Outcome::WrongCoupling);
  coupled.setArm(ArmKind::Scara2Z, makeModel<Scara2Z>(random));
  EXPECT_EQ(coupled.check(), Outcome::Done);
  coupled.setHand(HandKind::Wrist2,
                  Wrist2{.toolLength = 0.1, .rollX = 0.1, .rollY = 0, .rollZ = 0});
  EXPECT_EQ(coupled.check(), Outcome::WrongCoupling);
  coupled.setHand(HandKind::Wrist2, Wrist2{.toolLength = 0.1, .rollX = 0, .rollY = 0, .rollZ = 0});
  EXPECT_EQ(coupled.check(), Outcome::Done);
}

/// The head of two axes on an arm whose flange turns: a coupling that no model has.
TEST(Checks, AHeadOfTwoAxesOnAnArmPointsItsToolWhereItShall) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    AnyKinematics any{};
    if (i % 2 == 0)
      any.setArm(ArmKind::ArmRrr, makeModel<ArmRrr>(random));
    else
      any.setArm(ArmKind::Scara2Z, makeModel<Scara2Z>(random));
    any.setHand(HandKind::Wrist2,
                Wrist2{.toolLength = random.offset(0.2), .rollX = 0, .rollY = 0, .rollZ = 0});
    ASSERT_EQ(any.check(), Outcome::Done);
    double axes[kMostJoints];
    for (double &axis : axes)
      axis = random.between(-170, 170);
    Frame<double> pose;
    ASSERT_EQ(any.forward(axes, pose), Outcome::Done);
    double found[kMostJoints];
    ASSERT_EQ(any.inverse(pose, any.postureOf(axes), axes, found), Outcome::Done);
    Frame<double> again;
    ASSERT_EQ(any.forward(found, again), Outcome::Done);
    EXPECT_LT((again.place - pose.place).norm() + (again.turn.col(2) - pose.turn.col(2)).norm(),
              1e-9);
  }
}

} // namespace
} // namespace stride::kinematics
