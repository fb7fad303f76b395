// Groups that are interrupted anywhere on their path, moved in memory, and continued: they go along
// exactly the path of a group that is not interrupted, keep the limits, and end where it does. With
// overrides and allowances on the way, the path stays the same, too.
#include "group_problems.hpp"

#include "runtime/numeric/group/kept_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using namespace stride::group;
using namespace stride::test;
namespace kinematics = stride::kinematics;

struct Job {
  Leg leg;
  Order order;
};

class Jobs {
public:
  explicit Jobs(unsigned seed) : random_(seed), machine_(randomMachine(random_)) {
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
      const double spread = k < kArmAxes ? machine_.spread : 100;
      to[k] = isOfMachine(machine_, k) ? machine_.home[k] + random_.uniform(-1, 1) * spread : 0;
      perTime[k] = machine_.limits[k].velocity;
    }
    MoreAxes more{};
    for (int k = 0; k < kMoreAxes; ++k) {
      more.from[k] = planned_[kArmAxes + k];
      more.to[k] = to[kArmAxes + k];
    }
    job.leg = random_.chance(0.6) ? lineLeg(poseAt(planned_), poseAt(to), more)
                                  : axesLeg(planned_, to, perTime, 300);
    std::copy(std::begin(to), std::end(to), planned_);
    return job;
  }

  Random random_;
  Machine machine_;
  double planned_[kAxes];
};

std::unique_ptr<GroupMotion> begin(const Machine &machine, const std::vector<Job> &jobs) {
  auto group = std::make_unique<GroupMotion>();
  reset(*group, machine.home);
  for (const Job &job : jobs)
    append(*group, drawId(*group), job.leg, job.order);
  return group;
}

bool isOver(const GroupMotion &group) { return group.first == group.next && isAtRest(group); }

/// Where a group with such movements is at a way of its path.
bool axesOn(const GroupMotion &group, const Arm &arm, double way, const double (&near)[kAxes],
            double (&result)[kAxes]) {
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
    if (axesAt(arm, place, near, axes) != Obstacle::None)
      return false;
    for (int i = 0; i < kAxes; ++i)
      result[i] = axes[i].c[0];
    return true;
  }
  return false;
}

/// Interrupts a group at rest and continues it in other memory.
void interrupt(std::unique_ptr<GroupMotion> &group) {
  auto kept = std::make_unique<KeptPath>();
  keepPath(*group, *kept);
  const uint64_t id = keptMovement(*kept);
  suspend(*group);
  EXPECT_EQ(group->first, group->next);
  if (id != 0) {
    EXPECT_EQ(outcomeOf(*group, id), Outcome::Interrupted);
  }
  auto copy = std::make_unique<KeptPath>();
  std::memcpy(copy.get(), kept.get(), sizeof(KeptPath));
  std::memset(kept.get(), 0xA5, sizeof(KeptPath));
  auto other = std::make_unique<GroupMotion>();
  std::memcpy(other.get(), group.get(), sizeof(GroupMotion));
  std::memset(group.get(), 0xA5, sizeof(GroupMotion));
  group = std::move(other);
  resume(*group, *copy);
  if (id != 0) {
    EXPECT_EQ(outcomeOf(*group, id), Outcome::Queued);
  }
}

/// One random job, as it goes without interruption, and with.
class Comparison {
public:
  explicit Comparison(unsigned seed)
      : jobs_(seed), list_(jobs_.make(5)), arm_(jobs_.machine().arm()) {}

  /// False: the arm cannot follow the path.
  bool run() {
    reference_ = begin(jobs_.machine(), list_);
    for (int n = 0; n < 400'000 && !isOver(*reference_); ++n) {
      cycle(*reference_, arm_, {kCycle, 1, false, 0, 64, 64});
      if (reference_->obstacle != Obstacle::None)
        return false;
    }
    group_ = begin(jobs_.machine(), list_);
    for (int n = 0; n < 400'000 && !testing::Test::HasFailure(); ++n) {
      if (isOver(*group_)) {
        arrived();
        return true;
      }
      step();
    }
    ADD_FAILURE() << "stuck at " << group_->motion.way;
    return true;
  }

private:
  static constexpr double kCycle = 0.001;

  void step() {
    Random &random = jobs_.random();
    if (!stopping_ && random.chance(0.003)) {
      stopping_ = true;
      moving_ = random.chance(0.3); // it is kept while it moves, and stands still at once
    }
    if (random.chance(0.005)) {
      override_ = random.chance(0.4) ? 1 : random.uniform(0.1, 1);
      allowance_ = kAllAllowed;
      allowance_.axisAcceleration = random.uniform(0.2, 1);
      allowance_.axisJerk = random.uniform(0.2, 1);
      allowance_.pathAcceleration = random.uniform(0.2, 1);
      allowance_.pathJerk = random.uniform(0.2, 1);
    }
    double before[kAxes];
    std::copy(std::begin(group_->velocity), std::end(group_->velocity), before);
    cycle(*group_, arm_, {kCycle, override_, stopping_, 0, 64, 64, allowance_});
    ASSERT_EQ(group_->obstacle, Obstacle::None);
    lookAt(before);
    if (stopping_ && (moving_ || isAtRest(*group_))) {
      interrupt(group_);
      stopping_ = false;
      interrupts_ += 1;
      for (int k = 0; k < kAxes; ++k) // as far as the group is concerned, it stands now
        EXPECT_EQ(group_->velocity[k], 0);
    }
  }

  void lookAt(const double (&before)[kAxes]) {
    double axes[kAxes];
    if (group_->motion.way > 0 && group_->next == 5) {
      ASSERT_TRUE(axesOn(*reference_, arm_, group_->motion.way, group_->axes, axes));
      for (int k = 0; k < kAxes; ++k) {
        if (isOfMachine(jobs_.machine(), k)) {
          EXPECT_NEAR(group_->axes[k], axes[k], 1e-9)
              << "axis " << k << " at " << group_->motion.way;
        }
      }
    }
    for (int k = 0; k < kAxes; ++k) {
      if (!isOfMachine(jobs_.machine(), k))
        continue;
      const AxisLimits &limits = jobs_.machine().limits[k];
      const double change = std::fabs(group_->velocity[k] - before[k]);
      EXPECT_LE(std::fabs(group_->velocity[k]), limits.velocity * (1 + 1e-6));
      EXPECT_LE(change, limits.acceleration * kCycle * (1 + 1e-6) + 1e-9);
    }
  }

  void arrived() {
    for (int k = 0; k < kAxes; ++k) {
      if (isOfMachine(jobs_.machine(), k)) {
        EXPECT_NEAR(group_->axes[k], jobs_.end()[k], 1e-9);
      }
    }
    for (uint64_t id = 1; id <= group_->lastId; ++id)
      EXPECT_EQ(outcomeOf(*group_, id), Outcome::Done) << id;
    EXPECT_NEAR(group_->motion.way, reference_->motion.way, 1e-9);
  }

  Jobs jobs_;
  std::vector<Job> list_;
  Arm arm_;
  std::unique_ptr<GroupMotion> reference_;
  std::unique_ptr<GroupMotion> group_;
  double override_ = 1;
  Allowance allowance_ = kAllAllowed;
  bool stopping_ = false;
  bool moving_ = false;
  int interrupts_ = 0;

public:
  int interrupts() const { return interrupts_; }
};

TEST(GroupInterrupt, ContinuesAlongTheSamePath) {
  int interrupts = 0;
  int followed = 0;
  for (int i = 0; i < casesOf(40) && !HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    Comparison comparison(70'000U + static_cast<unsigned>(i));
    followed += comparison.run() ? 1 : 0;
    interrupts += comparison.interrupts();
  }
  printf("%d interrupts of %d paths\n", interrupts, followed);
  EXPECT_GT(followed, casesOf(40) / 2);
  EXPECT_GT(interrupts, 2 * followed);
}

} // namespace
