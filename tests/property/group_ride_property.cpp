// Groups that follow belts, tables and other tools: the tool gets to a place on them and stays
// there, goes along lines on them, and back to a place of the machine; axes keep their limits and
// nothing jumps.
#include "group_machines.hpp"
#include "motion_problems.hpp"

#include "runtime/numeric/group/planning.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace {

using namespace stride::group;
namespace kinematics = stride::kinematics;
namespace motion = stride::motion;
using namespace stride::test;

constexpr double kPi = 3.14159265358979323846;

Eigen::Isometry3d isometryOf(const Pose &pose) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 9; ++i)
    frame.linear()(i / 3, i % 3) = pose.turn[i];
  frame.translation() << pose.place.x, pose.place.y, pose.place.z;
  return frame;
}

Pose poseFrom(const Eigen::Isometry3d &frame) {
  Pose pose;
  for (int i = 0; i < 9; ++i)
    pose.turn[i] = frame.linear()(i / 3, i % 3);
  pose.place = {frame.translation().x(), frame.translation().y(), frame.translation().z()};
  return pose;
}

Eigen::Isometry3d aboutZ(double angle, double x, double y, double z) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  frame.translation() << x, y, z;
  return frame;
}

/// A swing to and fro, from 0 on.
struct Swing {
  double amplitude, rate, phase;

  double at(double t) const { return amplitude * (std::sin(rate * t + phase) - std::sin(phase)); }
  double velocity(double t) const { return amplitude * rate * std::cos(rate * t + phase); }
  double acceleration(double t) const {
    return -amplitude * rate * rate * std::sin(rate * t + phase);
  }
};

/// A belt or table that changes its velocity now and then, with a limited acceleration; or a tool
/// that swings and turns.
class Carrier {
public:
  Carrier(Random &random, CarrierKind kind, const Eigen::Vector3d &near)
      : kind_(kind), speed_(kind == CarrierKind::Belt ? 40 : 15) {
    const double angle = random.uniform(-kPi, kPi);
    if (kind == CarrierKind::Belt) {
      origin_ = aboutZ(angle, near.x(), near.y(), near.z());
    } else { // the place goes about the table's middle
      const double far = random.uniform(50, 150);
      origin_ = aboutZ(angle, near.x() + far * std::cos(angle), near.y() + far * std::sin(angle),
                       near.z());
    }
    state_ = {random.uniform(-1, 1), random.uniform(-1, 1) * speed_, 0};
    if (kind == CarrierKind::Tool) {
      state_ = {random.uniform(0, 100), 1, 0};
      for (Swing &swing : swing_)
        swing = {random.uniform(-20, 20), random.uniform(0.5, 2), random.uniform(0, 6)};
      swing_[3].amplitude *= 0.01; // an angle
    }
    const Eigen::Isometry3d now = Eigen::Translation3d(near + Eigen::Vector3d(5, -3, 4)) *
                                  aboutZ(random.uniform(-0.3, 0.3), 0, 0, 0);
    object_ = (origin_ * moved()).inverse() * now;
  }

  MovingSystem system() const {
    if (kind_ != CarrierKind::Tool)
      return {poseFrom(origin_), poseFrom(object_), kind_, {}};
    const double t = state_.position;
    const Eigen::Vector3d v = swung(&Swing::velocity);
    const Eigen::Vector3d a = swung(&Swing::acceleration);
    return {poseFrom(origin_ * moved()),
            poseFrom(object_),
            kind_,
            {t,
             {v.x(), v.y(), v.z()},
             {a.x(), a.y(), a.z()},
             {0, 0, swing_[3].velocity(t)},
             {0, 0, swing_[3].acceleration(t)}}};
  }
  const motion::State &state() const { return state_; }

  /// Where the system is in the machine.
  Eigen::Isometry3d systemNow() const { return origin_ * moved() * object_; }

  void step(double cycle, bool steady, Random &random) {
    if (!steady && random.chance(0.002))
      wanted_ = random.uniform(-1, 1) * speed_;
    if (kind_ == CarrierKind::Tool) {
      state_.position += cycle;
      return;
    }
    const double most = 0.5 * speed_;
    const double change = steady ? 0 : std::clamp((wanted_ - state_.velocity) / cycle, -most, most);
    // One cycle of constant acceleration.
    state_.position += state_.velocity * cycle + 0.5 * change * cycle * cycle;
    state_.velocity += change * cycle;
    state_.acceleration = change;
  }

private:
  /// What the swings are in the machine.
  Eigen::Vector3d swung(double (Swing::*of)(double) const) const {
    const double t = state_.position;
    return origin_.linear() *
           Eigen::Vector3d((swing_[0].*of)(t), (swing_[1].*of)(t), (swing_[2].*of)(t));
  }

  Eigen::Isometry3d moved() const {
    const double t = state_.position;
    if (kind_ == CarrierKind::Tool)
      return aboutZ(swing_[3].at(t), swing_[0].at(t), swing_[1].at(t), swing_[2].at(t));
    return kind_ == CarrierKind::Belt ? aboutZ(0, state_.position, 0, 0)
                                      : aboutZ(state_.position * kPi / 180, 0, 0, 0);
  }

  CarrierKind kind_;
  double speed_; ///< [u/s] or [°/s]
  double wanted_ = 0;
  Eigen::Isometry3d origin_;
  Eigen::Isometry3d object_ = Eigen::Isometry3d::Identity();
  motion::State state_;
  Swing swing_[4]{};
};

struct Worst {
  double velocity = 0, acceleration = 0, jerk = 0, step = 0;
};

class RideDrive {
public:
  /// `aside`: another task plans.
  RideDrive(unsigned seed, bool nonlinear, CarrierKind kind, bool aside)
      : random_(seed), machine_(nonlinear ? scara() : gantry()),
        group_(std::make_unique<GroupMotion>()),
        planning_(aside ? std::make_unique<GroupPlanning>() : nullptr),
        every_(1 + static_cast<int>(seed % 7)), cycle_(0.002), arm_(machine_.arm()) {
    for (int k = 0; k < kAxes; ++k)
      machine_.limits[k] = {random_.uniform(120, 500), random_.uniform(500, 5000),
                            random_.uniform(8000, 90000), -1e4, 1e4};
    reset(*group_, machine_.home);
    carrier_ = std::make_unique<Carrier>(random_, kind, toolNow().translation());
  }

  void run(bool steady) {
    steady_ = steady;
    const PathLimits path{random_.uniform(100, 200), random_.uniform(800, 1500),
                          random_.uniform(800, 1500), random_.uniform(8000, 20000)};
    const MovingSystem system = carrier_->system();
    board(*group_, arm_, system, carrier_->state(),
          boardingDynamics(*group_, arm_, system, carrier_->state(), path));
    const Eigen::Isometry3d first = aboutZ(0.2, 10, -5, 8);
    const Eigen::Isometry3d second = aboutZ(-0.1, -15, 12, 2);
    go(path, first);
    stayOn(first, "at the first place");
    go(path, second);
    stayOn(second, "at the second place");
    if (testing::Test::HasFailure())
      return;
    // Back to where a place of the machine was.
    const Eigen::Isometry3d home = toolNow() * Eigen::Translation3d(-10, 20, 5);
    alight(*group_, arm_);
    go(path, home);
    EXPECT_TRUE(isStill(group_->left));
    EXPECT_LE((toolNow().translation() - home.translation()).norm(), 1e-9);
  }

  const Worst &worst() const { return worst_; }

private:
  Eigen::Isometry3d toolNow() const {
    Frame<double> tool;
    EXPECT_EQ(arm_.kinematics.forward(group_->axes, tool), kinematics::Outcome::Done);
    return isometryOf(poseOf(tool));
  }

  /// Goes straight to a pose in the system of the path, and on until nothing more moves in it.
  void go(const PathLimits &path, const Eigen::Isometry3d &to) {
    Order order{};
    order.path = path;
    order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
    order.configuration = arm_.kinematics.configurationOf(group_->axes);
    append(*group_, drawId(*group_), lineLeg(poseInPath(*group_, arm_), poseFrom(to), {}), order);
    for (int i = 0; i < 20000; ++i) {
      step();
      if (testing::Test::HasFailure())
        return;
      const bool there = group_->first == group_->next && isAtRest(*group_);
      if (there && isStill(group_->left) && (!group_->ride.follows || group_->ride.inSync)) {
        clear(*group_);
        return;
      }
    }
    ADD_FAILURE() << "stuck at " << group_->motion.way << ", in sync " << group_->ride.inSync;
  }

  void stayOn(const Eigen::Isometry3d &place, const char *what) {
    for (int i = 0; i < 100 && !testing::Test::HasFailure(); ++i) {
      step();
      if (!group_->ride.inSync)
        continue;
      const Eigen::Vector3d apart =
          toolNow().translation() - (carrier_->systemNow() * place).translation();
      EXPECT_LE(apart.norm(), 1e-9) << what;
    }
  }

  void step() {
    double axes[kAxes];
    double velocity[kAxes];
    double acceleration[kAxes];
    std::copy(std::begin(group_->axes), std::end(group_->axes), axes);
    std::copy(std::begin(group_->velocity), std::end(group_->velocity), velocity);
    std::copy(std::begin(group_->acceleration), std::end(group_->acceleration), acceleration);
    carrier_->step(cycle_, steady_, random_);
    GroupCommand command{cycle_, 1, false, 0, 128, 64};
    command.carrier = carrier_->state();
    if (group_->ride.follows && group_->ride.system.kind == CarrierKind::Tool)
      group_->ride.system = carrier_->system();
    if (planning_ != nullptr)
      cycleBesidePlanner(command);
    else
      cycle(*group_, arm_, command);
    ASSERT_EQ(group_->obstacle, Obstacle::None);
    for (int k = 0; k < machine_.joints; ++k) {
      const AxisLimits &limits = machine_.limits[k];
      const double by = 0.5 * cycle_ * (velocity[k] + group_->velocity[k]);
      worst_.velocity = std::max(worst_.velocity, std::fabs(group_->velocity[k]) / limits.velocity);
      worst_.acceleration =
          std::max(worst_.acceleration, std::fabs(group_->acceleration[k]) / limits.acceleration);
      worst_.jerk = std::max(worst_.jerk, std::fabs(group_->acceleration[k] - acceleration[k]) /
                                              (limits.jerk * cycle_));
      worst_.step = std::max(worst_.step, std::fabs(group_->axes[k] - axes[k] - by));
    }
  }

  /// The other task runs in one cycle of so many, and takes up to six.
  void cycleBesidePlanner(const GroupCommand &command) {
    (void)follow(*group_, *planning_, arm_, command);
    goOn(*group_, *planning_, arm_, command);
    (void)post(*group_, *planning_, arm_, machine_.kinematics, command);
    if (working_ > 0 && --working_ == 0)
      answerJob(*planning_);
    if (working_ > 0 || ++cycles_ % every_ != 0 || !takeJob(*planning_))
      return;
    doJob(*planning_, {every_ * cycle_, every_ * command.steps, every_ * command.samples});
    working_ = 1 + (cycles_ / every_) % 6;
  }

  Random random_;
  Machine machine_;
  std::unique_ptr<GroupMotion> group_;
  std::unique_ptr<GroupPlanning> planning_;
  int every_;
  int working_ = 0; ///< Cycles until the other task has answered.
  int cycles_ = 0;
  double cycle_;
  Arm arm_;
  std::unique_ptr<Carrier> carrier_;
  Worst worst_;
  bool steady_ = true;
};

Worst driveAll(bool nonlinear, CarrierKind kind, bool steady, bool aside) {
  Worst worst;
  for (int i = 0; i < wanted(60) && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    RideDrive drive(3000U + static_cast<unsigned>(i), nonlinear, kind, aside);
    drive.run(steady);
    worst.velocity = std::max(worst.velocity, drive.worst().velocity);
    worst.acceleration = std::max(worst.acceleration, drive.worst().acceleration);
    worst.jerk = std::max(worst.jerk, drive.worst().jerk);
    worst.step = std::max(worst.step, drive.worst().step);
  }
  printf("velocity %.4f, acceleration %.4f, jerk %.4f of the limits, step %.2g\n", worst.velocity,
         worst.acceleration, worst.jerk, worst.step);
  return worst;
}

/// With a belt whose velocity does not change, axes keep their limits; on a table, nearly so.
/// Changes that nobody could know of come on top.
void expectWithinLimits(bool nonlinear, CarrierKind kind, bool aside = false) {
  const Worst steady = driveAll(nonlinear, kind, true, aside);
  const double more = kind == CarrierKind::Belt ? 1e-6 : 0.03;
  EXPECT_LE(steady.velocity, 1 + more);
  EXPECT_LE(steady.acceleration, 1 + more);
  EXPECT_LE(steady.jerk, 1.0001 + more);
  const Worst any = driveAll(nonlinear, kind, false, aside);
  EXPECT_LE(any.velocity, 1.05);
  EXPECT_LE(any.acceleration, 1.15);
  EXPECT_LE(any.jerk, 1.51);
  EXPECT_LE(std::max(steady.step, any.step), 90000.0 * 0.002 * 0.002 * 0.002 / 6);
}

/// How a tool goes on nobody knows: what it changes comes on top. Getting there and leaving it is
/// known, and takes half of what axes can do. Up to 1.1 times an axis's velocity is no error.
void expectOnTool(bool nonlinear, bool aside = false) {
  const Worst any = driveAll(nonlinear, CarrierKind::Tool, true, aside);
  EXPECT_LE(any.velocity, 1.05);
  EXPECT_LE(any.acceleration, 1.05);
  EXPECT_LE(any.jerk, 1.05);
  EXPECT_LE(any.step, 90000.0 * 0.002 * 0.002 * 0.002 / 6);
}

TEST(GroupRide, PortalOnTool) { expectOnTool(false); }
TEST(GroupRide, ScaraOnTool) { expectOnTool(true); }
TEST(GroupRide, PortalOnBelt) { expectWithinLimits(false, CarrierKind::Belt); }
TEST(GroupRide, PortalOnTable) { expectWithinLimits(false, CarrierKind::Table); }
TEST(GroupRide, ScaraOnBelt) { expectWithinLimits(true, CarrierKind::Belt); }
TEST(GroupRide, ScaraOnTable) { expectWithinLimits(true, CarrierKind::Table); }

// The same with a planning task.
TEST(GroupRide, PortalOnToolPlannedAside) { expectOnTool(false, true); }
TEST(GroupRide, ScaraOnToolPlannedAside) { expectOnTool(true, true); }
TEST(GroupRide, PortalOnBeltPlannedAside) { expectWithinLimits(false, CarrierKind::Belt, true); }
TEST(GroupRide, PortalOnTablePlannedAside) { expectWithinLimits(false, CarrierKind::Table, true); }
TEST(GroupRide, ScaraOnBeltPlannedAside) { expectWithinLimits(true, CarrierKind::Belt, true); }
TEST(GroupRide, ScaraOnTablePlannedAside) { expectWithinLimits(true, CarrierKind::Table, true); }

} // namespace
