// Groups that drive random movements with random arms: every axis keeps its limits in every cycle,
// nothing jumps, lines are straight, movements end where they should, and all of them end.
#include "runtime/numeric/group/group_motion.hpp"
#include "runtime/numeric/kinematics/any_kinematics.hpp"
#include "runtime/numeric/kinematics/hands.hpp"
#include "runtime/numeric/kinematics/planar_arms.hpp"
#include "runtime/numeric/kinematics/portals.hpp"

#include "motion_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using namespace stride::group;
namespace kinematics = stride::kinematics;
using stride::test::casesOf;
using stride::test::Random;

/// A machine: its kinematics, its axes' limits, and where it is at first.
struct Machine {
  kinematics::AnyKinematics kinematics{};
  AxisLimits limits[kAxes]{};
  int joints = 0;
  int more = 0;
  double home[kAxes]{};
  double spread = 0; ///< How far from home the axes of targets are. [u]

  Arm arm() const {
    return {kinematics.ref(), joints, more, limits, kinematics.ref().configurationOf(home)};
  }
};

Machine gantry() {
  Machine machine;
  machine.kinematics.setArm(kinematics::ArmKind::Gantry3, kinematics::Gantry3{});
  machine.joints = 3;
  machine.spread = 200;
  return machine;
}

Machine scara() {
  Machine machine;
  machine.kinematics.setArm(kinematics::ArmKind::Scara2Z, kinematics::Scara2Z{{400, 300}});
  machine.kinematics.setHand(kinematics::HandKind::TurningAxis, kinematics::TurningAxis{});
  machine.joints = 4;
  const double home[] = {10, 80, 20, -30};
  std::copy(std::begin(home), std::end(home), machine.home);
  machine.spread = 25;
  return machine;
}

Machine articulated() {
  Machine machine;
  kinematics::ArmRrr arm{};
  arm.d1 = 400;
  arm.a1 = 100;
  arm.a2 = 500;
  arm.a3 = 50;
  arm.d4 = 450;
  machine.kinematics.setArm(kinematics::ArmKind::ArmRrr, arm);
  machine.kinematics.setHand(kinematics::HandKind::Wrist3, kinematics::Wrist3{{0, 0, 80}});
  machine.joints = 6;
  const double home[] = {5, -60, 30, 12, 60, -20};
  std::copy(std::begin(home), std::end(home), machine.home);
  machine.spread = 12;
  return machine;
}

Machine randomMachine(Random &random) {
  const int kind = random.below(3);
  Machine machine = kind == 0 ? gantry() : (kind == 1 ? scara() : articulated());
  machine.more = random.below(3);
  for (int k = 0; k < kAxes; ++k) {
    AxisLimits &limits = machine.limits[k];
    limits.velocity = random.uniform(100, 500);
    limits.acceleration = limits.velocity * random.magnitude(0, 1);
    limits.jerk = limits.acceleration * random.magnitude(0.5, 2);
    limits.low = -1e4;
    limits.high = 1e4;
  }
  return machine;
}

bool isOfMachine(const Machine &machine, int k) {
  return k < machine.joints || (k >= kArmAxes && k < kArmAxes + machine.more);
}

/// Drives random movements.
class Drive {
public:
  explicit Drive(unsigned seed)
      : random_(seed), machine_(randomMachine(random_)), group_(std::make_unique<GroupMotion>()),
        cycle_(random_.magnitude(-3.3, -2.7)), arm_(machine_.arm()) {
    reset(*group_, machine_.home);
    std::copy(std::begin(machine_.home), std::end(machine_.home), planned_);
  }

  /// Movements that are commanded all at once, or one by one.
  void run(int movements) {
    left_ = movements;
    const bool atOnce = random_.chance(0.5);
    if (atOnce)
      while (left_ > 0)
        order();
    for (int64_t n = 0; n < 400'000; ++n) {
      if (!atOnce && left_ > 0 && hasRoom(*group_) && random_.chance(0.005))
        order();
      if (left_ == 0 && group_->first == group_->next && isAtRest(*group_)) {
        arrived();
        return;
      }
      step();
      if (testing::Test::HasFailure() || failed_)
        return;
    }
    ADD_FAILURE() << "stuck at " << group_->motion.way << ", movement " << group_->first << " of "
                  << group_->next;
  }

  bool hasFailed() const { return failed_; }

private:
  void randomAxes(double (&axes)[kAxes]) {
    for (int k = 0; k < kAxes; ++k)
      axes[k] =
          !isOfMachine(machine_, k)
              ? 0
              : machine_.home[k] + random_.uniform(-1, 1) * (k < kArmAxes ? machine_.spread : 100);
  }

  Pose poseAt(const double (&axes)[kAxes]) {
    Frame<double> frame;
    EXPECT_EQ(arm_.kinematics.forward(axes, frame), kinematics::Outcome::Done);
    return poseOf(frame);
  }

  void order() {
    --left_;
    double to[kAxes];
    randomAxes(to);
    Order order{};
    const double speed = random_.magnitude(1.7, 3);
    order.path = {speed, speed * random_.magnitude(0, 1.5), speed * random_.magnitude(0, 1.5), 0};
    order.path.jerk = order.path.acceleration * random_.magnitude(0.5, 2);
    order.velocityFactor = random_.chance(0.5) ? 1 : random_.uniform(0.3, 1);
    order.accelerationFactor = random_.chance(0.5) ? 1 : random_.uniform(0.3, 1);
    order.jerkFactor = random_.chance(0.5) ? 1 : random_.uniform(0.3, 1);
    order.configuration = arm_.configuration;
    order.transition = static_cast<Transition>(random_.below(3));
    order.transitionValue = order.transition == Transition::Distance ? random_.magnitude(0, 2)
                                                                     : random_.uniform(0.1, 2);
    order.cornerSpeed = static_cast<CornerSpeed>(random_.below(4));
    if (random_.chance(0.1)) {
      order.dwell = random_.uniform(0.001, 0.1);
      append(*group_, drawId(*group_), Leg{}, order);
      return;
    }
    Leg leg{};
    if (random_.chance(0.6)) {
      MoreAxes more{};
      for (int k = 0; k < kMoreAxes; ++k) {
        more.from[k] = planned_[kArmAxes + k];
        more.to[k] = to[kArmAxes + k];
      }
      leg = lineLeg(poseAt(planned_), poseAt(to), more);
    } else {
      double perTime[kAxes];
      for (int k = 0; k < kAxes; ++k)
        perTime[k] = machine_.limits[k].velocity;
      leg = axesLeg(planned_, to, perTime, 300);
    }
    if (!(leg.length > 0))
      return;
    append(*group_, drawId(*group_), leg, order);
    std::copy(std::begin(to), std::end(to), planned_);
    factors_.push_back(order);
  }

  void step() {
    double axes[kAxes];
    double velocity[kAxes];
    double acceleration[kAxes];
    std::copy(std::begin(group_->axes), std::end(group_->axes), axes);
    std::copy(std::begin(group_->velocity), std::end(group_->velocity), velocity);
    std::copy(std::begin(group_->acceleration), std::end(group_->acceleration), acceleration);
    disturb();
    cycle(*group_, arm_,
          {cycle_, override_, stopped_ > 0, 0, std::max(1, static_cast<int>(cycle_ * 64000)), 64});
    relocate();
    if (group_->obstacle != Obstacle::None) { // a line that the arm cannot follow
      failed_ = true;
      return;
    }
    for (int k = 0; k < kAxes; ++k) {
      if (!isOfMachine(machine_, k))
        continue;
      const AxisLimits &limits = machine_.limits[k];
      const double t = cycle_;
      const double change = group_->acceleration[k] - acceleration[k];
      const double moved = group_->axes[k] - axes[k];
      const double by = 0.5 * t * (velocity[k] + group_->velocity[k]);
      const bool good =
          std::fabs(group_->velocity[k]) <= limits.velocity * (1 + 1e-6) &&
          std::fabs(group_->acceleration[k]) <= limits.acceleration * (1 + 1e-6) &&
          std::fabs(change) <= limits.jerk * t * (1 + 1e-4) + 1e-6 * limits.acceleration &&
          std::fabs(moved - by) <= limits.jerk * t * t * t / 6 + 1e-9;
      if (!good) // texts are dear
        ADD_FAILURE() << "axis " << k << " at way " << group_->motion.way << ", movement "
                      << group_->first << ": velocity " << group_->velocity[k] << " of "
                      << limits.velocity << ", acceleration " << group_->acceleration[k] << " of "
                      << limits.acceleration << ", jerk " << change / t << " of " << limits.jerk
                      << ", moved " << moved << " instead of " << by;
    }
  }

  void disturb() {
    if (random_.chance(0.002))
      override_ = random_.chance(0.3) ? 1 : random_.uniform(0.3, 1);
    if (stopped_ > 0)
      --stopped_;
    else if (random_.chance(0.001))
      stopped_ = 300;
  }

  /// Moves everything to other memory.
  void relocate() {
    if (!random_.chance(0.01))
      return;
    auto copy = std::make_unique<GroupMotion>();
    std::memcpy(copy.get(), group_.get(), sizeof(GroupMotion));
    std::memset(group_.get(), 0xA5, sizeof(GroupMotion));
    group_ = std::move(copy);
  }

  void arrived() {
    for (int k = 0; k < kAxes; ++k) {
      if (isOfMachine(machine_, k)) {
        EXPECT_NEAR(group_->axes[k], planned_[k], 1e-9) << "axis " << k;
      }
    }
    for (uint64_t id = 1; id <= group_->lastId; ++id)
      EXPECT_EQ(outcomeOf(*group_, id), Outcome::Done) << id;
  }

  Random random_;
  Machine machine_;
  std::unique_ptr<GroupMotion> group_;
  double cycle_;
  Arm arm_;
  double planned_[kAxes];
  std::vector<Order> factors_;
  double override_ = 1;
  int stopped_ = 0;
  int left_ = 0;
  bool failed_ = false;
};

/// More cases by hand: STRIDE_GROUP_CASES=10000.
int wanted(int cases) {
  const char *const more = std::getenv("STRIDE_GROUP_CASES");
  return more != nullptr ? std::atoi(more) : casesOf(cases);
}

TEST(GroupMotion, KeepsLimitsAndArrives) {
  const char *const only = std::getenv("STRIDE_GROUP_CASE");
  const int cases = wanted(100);
  int failed = 0;
  for (int i = only != nullptr ? std::atoi(only) : 0; i < cases && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    Drive drive(1000U + static_cast<unsigned>(i));
    drive.run(6);
    failed += drive.hasFailed() ? 1 : 0;
  }
  printf("%d of %d met an obstacle\n", failed, cases);
  EXPECT_LE(failed, cases / 5);
}

} // namespace
