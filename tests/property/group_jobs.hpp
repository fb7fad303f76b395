// Random movements of random machines, for tests of axis groups, and where their path is.
#ifndef STRIDE_TESTS_PROPERTY_GROUP_JOBS_HPP
#define STRIDE_TESTS_PROPERTY_GROUP_JOBS_HPP

#include "group_problems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace stride::test {

using namespace stride::group;

struct Job {
  Leg leg;
  Order order;
};

class Jobs {
public:
  /// `givesAxes`: on lines the tool axes go evenly.
  explicit Jobs(unsigned seed, bool givesAxes = false)
      : random_(seed),
        machine_(givesAxes ? randomMachineWithToolAxes(random_) : randomMachine(random_)),
        given_(givesAxes ? toolAxesOf(machine_) : uint8_t{0}) {
    std::copy(std::begin(machine_.home), std::end(machine_.home), planned_);
  }

  const Machine &machine() const { return machine_; }
  Random &random() { return random_; }
  const double (&end() const)[kAxes] { return planned_; }

  std::vector<Job> make(int count) {
    std::vector<Job> jobs;
    while (static_cast<int>(jobs.size()) < count) {
      const Job job = next();
      if (job.leg.length > 0 || job.order.dwell > 0)
        jobs.push_back(job);
    }
    return jobs;
  }

private:
  Pose poseAt(const double (&axes)[kAxes]) {
    Frame<double> frame;
    EXPECT_EQ(machine_.arm().kinematics.forward(axes, frame), kinematics::Outcome::Done);
    return poseOf(frame);
  }

  Job next() {
    Job job{};
    const double speed = random_.magnitude(1.7, 3);
    job.order.path = {speed, speed * random_.magnitude(0.3, 1.5),
                      speed * random_.magnitude(0.3, 1.5), 0};
    job.order.path.jerk = job.order.path.acceleration * random_.magnitude(0.5, 2);
    job.order.velocityFactor = job.order.accelerationFactor = job.order.jerkFactor = 1;
    job.order.configuration = machine_.arm().configuration;
    job.order.transition = static_cast<Transition>(random_.below(3));
    job.order.transitionValue = job.order.transition == Transition::Distance
                                    ? random_.magnitude(0, 2)
                                    : random_.uniform(0.1, 2);
    if (random_.chance(0.1)) {
      job.order.dwell = random_.uniform(0.001, 0.1);
      return job;
    }
    double to[kAxes];
    double perTime[kAxes];
    for (int k = 0; k < kAxes; ++k) {
      const double spread = k < kArmAxes && !isGiven(given_, k) ? machine_.spread : 100;
      to[k] = isOfMachine(machine_, k) ? machine_.home[k] + random_.uniform(-1, 1) * spread : 0;
      perTime[k] = machine_.limits[k].velocity;
    }
    MoreAxes more{};
    for (int k = 0; k < kMoreAxes; ++k) {
      more.from[k] = planned_[kArmAxes + k];
      more.to[k] = to[kArmAxes + k];
    }
    const kinematics::KinematicsRef kinematics = machine_.arm().kinematics;
    const bool led = random_.chance(0.6);
    const bool placed = given_ == 0 || kinematics.placingConfigurationOf(to) ==
                                           kinematics.placingConfigurationOf(planned_);
    job.leg = led && placed ? lineLeg(poseAt(planned_), poseAt(to), more)
                            : axesLeg(planned_, to, perTime, 300);
    if (given_ != 0 && leadsTool(job.leg)) {
      giveToolAxes(job.leg, given_, planned_, to);
      job.order.configuration = kinematics.placingConfigurationOf(planned_);
    }
    std::copy(std::begin(to), std::end(to), planned_);
    return job;
  }

  Random random_;
  Machine machine_;
  uint8_t given_;
  double planned_[kAxes];
};

inline std::unique_ptr<GroupMotion> begin(const Machine &machine, const std::vector<Job> &jobs) {
  auto group = std::make_unique<GroupMotion>();
  reset(*group, machine.home);
  for (const Job &job : jobs)
    append(*group, drawId(*group), job.leg, job.order);
  return group;
}

inline bool isOver(const GroupMotion &group) {
  return group.first == group.next && isAtRest(group);
}

/// Where a group with such movements is at a way of its path.
inline bool axesOn(const GroupMotion &group, const Arm &arm, double way,
                   const double (&near)[kAxes], double (&result)[kAxes]) {
  for (int64_t k = group.next - 1; k >= 0; --k) {
    const Movement &movement = group.movement[k];
    if (movement.order.dwell > 0 || !(movement.leg.length > 0) || way < movement.begin)
      continue;
    PathPlace place;
    const double along = way - movement.begin - movement.corner.length;
    if (along < 0)
      placeAt(movement.corner, Series(way - movement.begin), place);
    else
      placeAt(movement.leg, Series(std::fmin(movement.entry + along, movement.leg.length)), place);
    Series axes[kAxes];
    const Arm ordered{arm.kinematics, arm.joints, arm.more, arm.limits,
                      movement.order.configuration};
    if (axesAt(ordered, place, near, axes) != Obstacle::None)
      return false;
    for (int i = 0; i < kAxes; ++i)
      result[i] = axes[i].c[0];
    return true;
  }
  return false;
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GROUP_JOBS_HPP
