// Groups that are interrupted anywhere on their path, moved in memory, and continued: they go along
// exactly the path of a group that is not interrupted, keep the limits, and end where it does. With
// overrides and allowances on the way, the path stays the same, too.
#include "group_jobs.hpp"

#include "runtime/numeric/group/kept_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using namespace stride::group;
using namespace stride::test;

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
  explicit Comparison(unsigned seed, bool givesAxes)
      : jobs_(seed, givesAxes), list_(jobs_.make(5)), arm_(jobs_.machine().arm()) {}

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

void interruptMany(unsigned seed, int cases, bool givesAxes) {
  int interrupts = 0;
  int followed = 0;
  for (int i = 0; i < cases && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    Comparison comparison(seed + static_cast<unsigned>(i), givesAxes);
    followed += comparison.run() ? 1 : 0;
    interrupts += comparison.interrupts();
  }
  printf("%d interrupts of %d paths\n", interrupts, followed);
  EXPECT_GT(followed, cases / 2);
  EXPECT_GT(interrupts, 2 * followed);
}

TEST(GroupInterrupt, ContinuesAlongTheSamePath) { interruptMany(70'000, casesOf(40), false); }
TEST(GroupInterrupt, ContinuesWhereToolAxesGoEvenly) { interruptMany(71'000, casesOf(16), true); }

} // namespace
