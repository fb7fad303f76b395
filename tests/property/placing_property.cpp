// Kinematics that split: placing axes where the tool axes are given. The tool's point is where it
// was asked for, by the way forwards, which is tested by itself, with all derivatives.
#include "runtime/numeric/kinematics/any_kinematics.hpp"

#include "tests/property/random_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::kinematics {
namespace {

using random::makeModel;
using random::Random;

struct Split {
  AnyKinematics kinematics{};
  unsigned toolAxes; ///< As it should say.
};

template <class Model> AnyKinematics armOf(Random &random, ArmKind kind) {
  AnyKinematics any{};
  any.setArm(kind, makeModel<Model>(random));
  return any;
}

template <class Model> void addHand(Random &random, HandKind kind, AnyKinematics &any) {
  any.setHand(kind, makeModel<Model>(random));
}

constexpr int kKinds = 12;

Split draw(Random &random, int kind) {
  Split split{{}, 0};
  AnyKinematics &any = split.kinematics;
  switch (kind) {
  case 0:
    any = armOf<Gantry2>(random, ArmKind::Gantry2);
    addHand<TurningAxis>(random, HandKind::TurningAxis, any);
    split.toolAxes = 0b100;
    break;
  case 1:
    any = armOf<Scara2Z>(random, ArmKind::Scara2Z);
    addHand<TurningAxis>(random, HandKind::TurningAxis, any);
    split.toolAxes = 0b1000;
    break;
  case 2:
    any = armOf<Scara3>(random, ArmKind::Scara3);
    split.toolAxes = 0b100;
    break;
  case 3:
    any = armOf<Scara3Z>(random, ArmKind::Scara3Z);
    split.toolAxes = 0b100;
    break;
  case 4:
    any = armOf<ArmRrr>(random, ArmKind::ArmRrr);
    addHand<Wrist3>(random, HandKind::Wrist3, any);
    split.toolAxes = 0b111000;
    break;
  case 5:
    any = armOf<Palletiser>(random, ArmKind::Palletiser);
    split.toolAxes = 0b1000;
    break;
  case 6:
  case 7:
    any = armOf<OffsetWristArm>(random, ArmKind::OffsetWristArm);
    split.toolAxes = 0b111000;
    break;
  case 8:
    any = armOf<Gantry3>(random, ArmKind::Gantry3);
    addHand<Wrist2>(random, HandKind::Wrist2, any);
    split.toolAxes = 0b11000;
    break;
  case 9:
    any = armOf<FiveAxisTable>(random, ArmKind::FiveAxisTable);
    split.toolAxes = 0b11000;
    break;
  case 10:
    any = armOf<TripodRotary>(random, ArmKind::TripodRotary);
    addHand<Wrist3>(random, HandKind::Wrist3, any);
    split.toolAxes = 0b111000;
    break;
  default:
    any = armOf<Scara2>(random, ArmKind::Scara2);
    break;
  }
  return split;
}

/// A tool, if the kinematics may have one there.
void addTool(Random &random, AnyKinematics &any) {
  Frame<double> tool{aboutX(random.between(-3, 3)),
                     {random.offset(0.2), random.offset(0.2), random.offset(0.2)}};
  any.setTool(tool);
  if (any.check() != Outcome::Done)
    any.clearTool();
}

void drawAxes(Random &random, const AnyKinematics &any, double (&axes)[kMostJoints]) {
  for (int i = 0; i < any.joints(); ++i)
    axes[i] =
        (any.turning() >> i & 1U) != 0 ? random.between(-200, 200) : random.between(-0.1, 0.1);
  for (int i = 0; i < 3 && any.arm == ArmKind::TripodRotary; ++i)
    axes[i] = random.between(-30, 60);
}

bool isTool(const Split &split, int axis) { return (split.toolAxes >> axis & 1U) != 0; }

/// Both, as far as there are placing axes for it.
double apart(const Split &split, const Vector<double> &a, const Vector<double> &b) {
  const int placing = split.kinematics.joints() - __builtin_popcount(split.toolAxes);
  return placing == 2 ? std::hypot(a(0) - b(0), a(1) - b(1)) : (a - b).norm();
}

/// How well the placing axes move the point: the smallest singular value of what they do, by
/// differences. [u] per [°]
double steadiness(const Split &split, const double *axes) {
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> columns(3, 0);
  double moved[kMostJoints];
  std::copy(axes, axes + kMostJoints, moved);
  constexpr double kStep = 1e-4;
  for (int i = 0; i < split.kinematics.joints(); ++i) {
    if (isTool(split, i))
      continue;
    Frame<double> before;
    Frame<double> after;
    moved[i] = axes[i] - kStep;
    if (split.kinematics.forward(moved, before) != Outcome::Done)
      return 0;
    moved[i] = axes[i] + kStep;
    if (split.kinematics.forward(moved, after) != Outcome::Done)
      return 0;
    moved[i] = axes[i];
    columns.conservativeResize(3, columns.cols() + 1);
    columns.col(columns.cols() - 1) = (after.place - before.place) / (2 * kStep);
  }
  const Eigen::Index last = columns.cols() - 1;
  return Eigen::JacobiSVD<decltype(columns)>(columns).singularValues()(last);
}

TEST(Placing, LeadsToThePointWhateverTheToolAxesAre) {
  Random random;
  int steady = 0;
  int elsewhere = 0;
  for (int i = 0; i < 6000 && !testing::Test::HasFailure(); ++i) {
    Split split = draw(random, i % kKinds);
    addTool(random, split.kinematics);
    unsigned toolAxes = 0;
    ASSERT_TRUE(split.kinematics.splits(toolAxes));
    ASSERT_EQ(toolAxes, split.toolAxes);
    double axes[kMostJoints]{};
    drawAxes(random, split.kinematics, axes);
    Frame<double> pose;
    if (split.kinematics.forward(axes, pose) != Outcome::Done || steadiness(split, axes) < 1e-4)
      continue;
    ++steady;
    SCOPED_TRACE(testing::Message() << "case " << i);
    const Posture posture = split.kinematics.placingPostureOf(axes);
    double found[kMostJoints];
    std::copy(std::begin(axes), std::end(axes), found);
    ASSERT_EQ(split.kinematics.place(pose.place, posture, axes, found), Outcome::Done);
    for (int k = 0; k < split.kinematics.joints(); ++k)
      EXPECT_NEAR(found[k], axes[k], 1e-7) << k;
    // Other tool axes, the same point.
    for (int k = 0; k < split.kinematics.joints(); ++k)
      if (isTool(split, k))
        found[k] += random.between(-200, 200);
    if (split.kinematics.place(pose.place, posture, axes, found) != Outcome::Done)
      continue;
    ++elsewhere;
    Frame<double> again;
    ASSERT_EQ(split.kinematics.forward(found, again), Outcome::Done);
    EXPECT_LT(apart(split, again.place, pose.place), 1e-9);
    if (steadiness(split, found) > 1e-4 && split.kinematics.arm != ArmKind::TripodRotary) {
      EXPECT_TRUE(split.kinematics.placingPostureOf(found) == posture);
    }
  }
  EXPECT_GT(steady, 4000);
  EXPECT_GT(elsewhere, 3000);
}

TEST(Placing, FollowsWithAllDerivatives) {
  Random random;
  int looked = 0;
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    Split split = draw(random, i % kKinds);
    addTool(random, split.kinematics);
    double axes[kMostJoints]{};
    drawAxes(random, split.kinematics, axes);
    Frame<double> pose;
    if (split.kinematics.forward(axes, pose) != Outcome::Done || steadiness(split, axes) < 1e-3)
      continue;
    SCOPED_TRACE(testing::Message() << "case " << i);
    Vector<Jet<3>> point = pose.place.cast<Jet<3>>();
    Jet<3> found[kMostJoints];
    for (int order = 1; order <= 3; ++order)
      for (int row = 0; row < 3; ++row)
        point(row).c[order] = random.between(-0.1, 0.1);
    for (int k = 0; k < split.kinematics.joints(); ++k) {
      found[k] = Jet<3>(axes[k]);
      for (int order = 1; order <= 3 && isTool(split, k); ++order)
        found[k].c[order] = random.between(-30, 30);
    }
    ASSERT_EQ(split.kinematics.place(point, split.kinematics.placingPostureOf(axes), axes, found),
              Outcome::Done);
    ++looked;
    Frame<Jet<3>> again;
    ASSERT_EQ(split.kinematics.forward(found, again), Outcome::Done);
    const int rows = split.kinematics.joints() - __builtin_popcount(split.toolAxes);
    for (int row = 0; row < rows; ++row)
      for (int order = 0; order <= 3; ++order)
        EXPECT_NEAR(again.place(row).c[order], point(row).c[order], 1e-8) << order;
  }
  EXPECT_GT(looked, 1500);
}

TEST(Placing, TurnsStayWithinLimits) {
  AnyKinematics any{};
  any.setArm(ArmKind::Scara2Z, Scara2Z{{0.4, 0.3}});
  any.setHand(HandKind::TurningAxis, TurningAxis{{0.1, 0, 0}});
  const double axes[] = {170, 60, 0, 20, 0, 0};
  Frame<double> pose;
  ASSERT_EQ(any.forward(axes, pose), Outcome::Done);
  const Posture posture = any.placingPostureOf(axes);
  double found[] = {0, 0, 0, 20, 0, 0};
  any.range[0] = {true, -200, 160};
  ASSERT_EQ(any.place(pose.place, posture, axes, found), Outcome::Done);
  EXPECT_NEAR(found[0], -190, 1e-9);
  any.range[0] = {true, -180, 160};
  EXPECT_EQ(any.place(pose.place, posture, axes, found), Outcome::OutOfLimits);
  const Vector<double> far{1, 0, 0};
  EXPECT_EQ(any.place(far, posture, axes, found), Outcome::Unreachable);
}

TEST(Placing, APolarArmDoesNotSplit) {
  AnyKinematics any{};
  unsigned toolAxes = 7;
  EXPECT_FALSE(any.splits(toolAxes));
  any.setArm(ArmKind::Polar, Polar{});
  any.setHand(HandKind::TurningAxis, TurningAxis{});
  EXPECT_FALSE(any.splits(toolAxes));
  EXPECT_EQ(toolAxes, 0U);
}

} // namespace
} // namespace stride::kinematics
