// Kinematics of measures that are none (zero, negative, huge, tiny, no numbers), at joints and
// poses that are none: what is not refused has an answer of numbers, and the way back leads to
// where it came from.
#include "runtime/numeric/kinematics/any_kinematics.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include "tests/property/random_kinematics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride::kinematics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kMeasures[] = {0.0,  -1.0, 0.3,   1.0, 2.5,  400.0,  1e-200, 1e-40, 1e40,  1e308,
                                kNaN, kInf, -kInf, 0.7, 0.25, -400.0, 0.01,   0.05,  0.125, 1.75};
constexpr double kWild[] = {kNaN, kInf, -kInf, 1e300, -1e17, 0.0};

class Wild {
public:
  double measure(bool sane) {
    constexpr int kCount = static_cast<int>(std::size(kMeasures));
    const int which = static_cast<int>(random_.between(0, kCount));
    const double value = kMeasures[which < kCount ? which : 0];
    return sane && !(std::fabs(value) > 1e-3 && std::fabs(value) < 3) ? 0.6 : value;
  }
  double joint(bool wild) {
    if (wild && random_.between(0, 1) < 0.3)
      return kWild[static_cast<int>(random_.between(0, 5.999))];
    return random_.between(-200, 200);
  }
  bool chance(double part) { return random_.between(0, 1) < part; }

  AnyKinematics kinematics() {
    AnyKinematics any{};
    any.arm = static_cast<ArmKind>(
        1 + static_cast<int>(random_.between(0, static_cast<int>(ArmKind::Count) - 1.001)));
    if (chance(0.4))
      any.hand = static_cast<HandKind>(
          static_cast<int>(random_.between(0, static_cast<int>(HandKind::Count) - 0.001)));
    const bool sane = chance(0.5);
    for (double &measure : any.armMeasure)
      measure = this->measure(sane && !chance(0.15));
    if (any.arm == ArmKind::BeltPortal) // its measures are nobody's inputs
      any.setArm(ArmKind::BeltPortal, kHGantry2);
    for (double &measure : any.handMeasure)
      measure = this->measure(sane && !chance(0.15));
    return any;
  }

private:
  random::Random random_;
};

bool isPose(const Frame<double> &pose) {
  const Matrix<double> product = pose.turn * pose.turn.transpose();
  return pose.place.allFinite() && pose.turn.allFinite() &&
         (product - Matrix<double>::Identity()).norm() < 1e-9;
}

/// Whether the measures are of one order, so that sums of them keep digits.
bool areOfOneOrder(const AnyKinematics &any) {
  double least = kInf;
  double most = 0;
  const auto look = [&](const double *measures, int count) {
    for (int i = 0; i < count; ++i)
      if (measures[i] != 0) {
        least = std::min(least, std::fabs(measures[i]));
        most = std::max(most, std::fabs(measures[i]));
      }
  };
  look(any.armMeasure, tableOf(any.arm).measures);
  if (any.hand != HandKind::None)
    look(any.handMeasure, tableOf(any.hand).measures);
  return most <= 1e6 * least;
}

void expectWayBack(const AnyKinematics &any, const double *joints, const Frame<double> &pose) {
  double back[kMostJoints] = {};
  const Outcome outcome = any.inverse(pose, any.postureOf(joints), joints, back);
  if (outcome != Outcome::Done)
    return;
  for (int i = 0; i < any.joints(); ++i)
    ASSERT_TRUE(std::isfinite(back[i])) << "arm " << static_cast<int>(any.arm) << " joint " << i;
  if (!areOfOneOrder(any))
    return;
  Frame<double> again;
  const Outcome forth = any.forward(back, again);
  if (forth == Outcome::Unreachable && any.arm >= ArmKind::TripodLinear)
    return; // rods that lie flat, but for rounding
  ASSERT_EQ(forth, Outcome::Done) << "arm " << static_cast<int>(any.arm);
  const double size = any.reach() + pose.place.norm();
  EXPECT_LE((again.place - pose.place).norm(), 1e-6 * size)
      << "arm " << static_cast<int>(any.arm) << " hand " << static_cast<int>(any.hand)
      << " measures " << any.armMeasure[0] << ' ' << any.armMeasure[1] << ' ' << any.armMeasure[2]
      << ' ' << any.armMeasure[3] << ' ' << any.armMeasure[4] << ' ' << any.armMeasure[5];
}

TEST(NonsenseProperty, MeasuresAreRefusedOrGiveNumbers) {
  Wild wild;
  int refused = 0;
  int driven = 0;
  for (int n = 0; n < 20000 && !::testing::Test::HasFailure(); ++n) {
    const AnyKinematics any = wild.kinematics();
    if (any.joints() > kMostJoints) {
      EXPECT_EQ(any.check(), Outcome::WrongCoupling);
    }
    if (any.check() != Outcome::Done) {
      ++refused;
      continue;
    }
    for (int k = 0; k < 5; ++k) {
      double joints[kMostJoints];
      for (double &joint : joints)
        joint = wild.joint(false);
      Frame<double> pose;
      if (any.forward(joints, pose) != Outcome::Done)
        continue;
      ASSERT_TRUE(isPose(pose)) << "arm " << static_cast<int>(any.arm) << " hand "
                                << static_cast<int>(any.hand) << " measures " << any.armMeasure[0]
                                << ' ' << any.armMeasure[1] << ' ' << any.armMeasure[2] << ' '
                                << any.armMeasure[3] << ' ' << any.armMeasure[4];
      expectWayBack(any, joints, pose);
      ++driven;
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(driven, 5000);
}

TEST(NonsenseProperty, PosesThatAreNoneAreUnreachable) {
  Wild wild;
  int asked = 0;
  for (int n = 0; n < 20000 && !::testing::Test::HasFailure(); ++n) {
    const AnyKinematics any = wild.kinematics();
    if (any.check() != Outcome::Done)
      continue;
    double reference[kMostJoints];
    for (double &joint : reference)
      joint = wild.joint(false);
    Frame<double> pose{turnFrom(Convention::Zyz, {wild.joint(false), 20, 30}),
                       {wild.joint(false), wild.joint(false), wild.joint(false)}};
    pose.place(static_cast<int>(n % 3)) = n % 2 == 0 ? kNaN : kInf;
    double joints[kMostJoints] = {};
    const Outcome outcome = any.inverse(pose, {}, reference, joints);
    const Task task = any.task();
    const bool flat = task == Task::Plane || task == Task::PlaneTurn;
    if (flat && n % 3 == 2)
      continue; // it does not look at z
    ++asked;
    EXPECT_NE(outcome, Outcome::Done)
        << "arm " << static_cast<int>(any.arm) << " hand " << static_cast<int>(any.hand);
  }
  EXPECT_GT(asked, 2000);
}

} // namespace
} // namespace stride::kinematics
