// Groups that are planned in another task, which is late, very late, or away for a while: they go
// along the path that they would go along without it, keep every limit in and between cycles, come
// to rest on their path when nothing is planned, and go on when it is. Stops and overrides act as
// soon as without it: at once, or when what has been promised is over.
#include "group_tasks.hpp"

#include "runtime/numeric/group/kept_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace {

using namespace stride::group;
using namespace stride::test;

/// How a task that plans behaves.
enum class Habit {
  Punctual, ///< Its answer is there in the next cycle.
  Late,     ///< It takes some cycles, or many.
  Moody,    ///< Now and then it is away.
};

/// One random job, planned in its own task and in another one.
class AsideComparison {
  static constexpr int kParts = 16; ///< Of a cycle, between which limits are looked at.

public:
  AsideComparison(unsigned seed, Habit habit, bool givesAxes)
      : jobs_(seed, givesAxes), list_(jobs_.make(5)), arm_(jobs_.machine().arm()), habit_(habit),
        cycle_(jobs_.random().magnitude(-3.3, -2.7)),
        every_(1 + jobs_.random().below(habit == Habit::Punctual ? 4 : 12)),
        keep_(seed % 3 == 0 ? 0.04 * (seed % 5) : 0),
        tasks_(begin(jobs_.machine(), list_), jobs_.machine(), cycle_) {}

  /// False: the arm cannot follow the path.
  bool run() {
    reference_ = begin(jobs_.machine(), list_);
    for (int n = 0; n < 400'000 && !isOver(*reference_); ++n) {
      cycle(*reference_, arm_, {cycle_, 1, false, 0, 64, 64});
      taken_ = n;
      if (reference_->obstacle != Obstacle::None)
        return false;
    }
    for (cycles_ = 0; cycles_ < 1'000'000 && !testing::Test::HasFailure(); ++cycles_) {
      if (isOver(tasks_.group())) {
        arrived();
        return true;
      }
      step();
    }
    const GroupMotion &group = tasks_.group();
    ADD_FAILURE() << "stuck at " << group.motion.way << " of " << reference_->motion.way
                  << ", movement " << group.first << " of " << group.next << ", looked at "
                  << group.looked << ", stops " << stopping_ << atOnce_ << ", holds "
                  << holds(group) << ", alone " << group.alone << ", law " << group.motion.law.first
                  << " to " << group.motion.law.next << ", course to "
                  << stride::path::endOf(group.motion.course) << ", override " << override_
                  << ", keep " << keep_ << ", dwells " << group.dwelling << group.motion.gate;
    return true;
  }

  int stops() const { return stops_; }
  int late() const { return lates_; }
  /// How much longer it took than planned in the axes' task.
  double slower() const { return static_cast<double>(cycles_) / static_cast<double>(taken_); }
  void disturbs(bool yes) { disturbs_ = yes; }
  void changes(bool yes) { changes_ = yes; }
  void slides(bool yes) { slides_ = yes; }

private:
  void step() {
    if (disturbs_)
      disturb();
    if (slides_)
      slide();
    GroupMotion &group = tasks_.group();
    const bool atOnce = stopping_ && atOnce_;
    const GroupCommand command = tasks_.command(override_, stopping_, keep_, atOnce, allowance_);
    tasks_.follow(command);
    ASSERT_EQ(group.obstacle, Obstacle::None);
    if (jobs_.random().chance(1.0 / 32))
      lookAtParts(command);
    double axes[3][kAxes];
    remember(group, axes);
    tasks_.goOnAndPost(command);
    lookAtAxes(group, axes, cycle_);
    lookAtPath(group);
    planNow();
    if (stopping_ && isAtRest(group) && (atOnce_ || jobs_.random().chance(0.2)))
      continueAfterStop();
    if (jobs_.random().chance(0.003) && !working_)
      tasks_.relocate();
    if (changes_ && !working_ && jobs_.random().chance(0.02))
      tasks_.changePlanner();
  }

  /// The other task, when it gets to run.
  void planNow() {
    Random &random = jobs_.random();
    if (away_ > 0) {
      --away_;
      return;
    }
    if (habit_ == Habit::Moody && random.chance(0.002))
      away_ = random.below(400);
    if (working_ > 0 && --working_ == 0)
      tasks_.answerJob();
    if (working_ > 0 || cycles_ % every_ != 0 || !tasks_.takeJob())
      return;
    tasks_.doJob(every_ * cycle_);
    working_ = habit_ == Habit::Punctual ? 0 : random.below(random.chance(0.1) ? 60 : 8);
    if (working_ == 0)
      tasks_.answerJob();
  }

  void disturb() {
    Random &random = jobs_.random();
    if (!stopping_ && random.chance(0.001)) {
      stopping_ = true;
      atOnce_ = random.chance(0.5);
      ++stops_;
    }
    if (random.chance(0.003)) {
      override_ = random.chance(0.4) ? 1 : random.chance(0.1) ? 0 : random.uniform(0.1, 1);
      allowance_ = kAllAllowed;
      allowance_.axisAcceleration = random.uniform(0.2, 1);
      allowance_.axisJerk = random.uniform(0.2, 1);
      allowance_.pathAcceleration = random.uniform(0.2, 1);
      allowance_.pathJerk = random.uniform(0.2, 1);
    }
  }

  /// A program changes the override in every cycle, or in one of a few: by little, or to anything.
  void slide() {
    Random &random = jobs_.random();
    if (random.chance(0.003))
      slideEvery_ = random.chance(0.5) ? 1 : 1 + random.below(12);
    if (random.chance(0.003))
      leaps_ = random.chance(0.3);
    if (cycles_ % slideEvery_ != 0)
      return;
    const double next =
        leaps_ ? random.uniform(0.02, 1) : override_ * (1 + 0.05 * random.uniform(-1, 1.02));
    override_ = std::clamp(next, 0.02, 1.0);
  }

  /// What has been stopped goes on in other memory, as MC_GroupContinue does.
  void continueAfterStop() {
    auto kept = std::make_unique<KeptPath>();
    keepPath(tasks_.group(), *kept);
    suspend(tasks_.group());
    resume(tasks_.group(), *kept);
    stopping_ = false;
    if (jobs_.random().chance(0.5))
      override_ = 1;
  }

  static void remember(const GroupMotion &group, double (&axes)[3][kAxes]) {
    std::copy(std::begin(group.axes), std::end(group.axes), axes[0]);
    std::copy(std::begin(group.velocity), std::end(group.velocity), axes[1]);
    std::copy(std::begin(group.acceleration), std::end(group.acceleration), axes[2]);
  }

  void lookAtParts(GroupCommand command) {
    auto copy = std::make_unique<GroupMotion>();
    std::memcpy(copy.get(), &tasks_.group(), sizeof(GroupMotion));
    command.cycle = cycle_ / kParts;
    for (int part = 0; part < kParts; ++part) {
      double axes[3][kAxes];
      remember(*copy, axes);
      goOn(*copy, arm_, command);
      lookAtAxes(*copy, axes, command.cycle);
      lookAtPath(*copy);
    }
  }

  /// Limits of each axis; nothing jumps.
  void lookAtAxes(const GroupMotion &group, const double (&before)[3][kAxes], double t) {
    for (int k = 0; k < kAxes; ++k) {
      if (!isOfMachine(jobs_.machine(), k))
        continue;
      const AxisLimits &limits = jobs_.machine().limits[k];
      const double change = group.acceleration[k] - before[2][k];
      const double moved = group.axes[k] - before[0][k];
      const double by = 0.5 * t * (before[1][k] + group.velocity[k]);
      const bool good =
          std::fabs(group.velocity[k]) <= limits.velocity * (1 + 1e-6) &&
          std::fabs(group.acceleration[k]) <= limits.acceleration * (1 + 1e-6) &&
          std::fabs(change) <= limits.jerk * t * (1 + 1e-4) + 1e-6 * limits.acceleration &&
          std::fabs(moved - by) <= limits.jerk * t * t * t / 6 + 1e-9;
      if (!good)
        ADD_FAILURE() << "axis " << k << " at way " << group.motion.way << ", movement "
                      << group.first << ": velocity " << group.velocity[k] << " of "
                      << limits.velocity << ", acceleration " << group.acceleration[k] << " of "
                      << limits.acceleration << ", jerk " << change / t << " of " << limits.jerk
                      << ", moved " << moved << " instead of " << by;
    }
  }

  /// The axes are where they would be if all were planned in their task.
  void lookAtPath(const GroupMotion &group) {
    double axes[kAxes];
    if (!(group.motion.way > 0))
      return;
    ASSERT_TRUE(axesOn(*reference_, arm_, group.motion.way, group.axes, axes));
    for (int k = 0; k < kAxes; ++k)
      if (isOfMachine(jobs_.machine(), k) && !(std::fabs(group.axes[k] - axes[k]) <= 1e-9))
        ADD_FAILURE() << "axis " << k << " at " << group.motion.way << " is " << group.axes[k]
                      << " instead of " << axes[k];
  }

  void arrived() {
    for (int k = 0; k < kAxes; ++k) {
      if (isOfMachine(jobs_.machine(), k)) {
        EXPECT_NEAR(tasks_.group().axes[k], jobs_.end()[k], 1e-9);
      }
    }
    for (uint64_t id = 1; id <= tasks_.group().lastId; ++id)
      EXPECT_EQ(outcomeOf(tasks_.group(), id), Outcome::Done) << id;
    EXPECT_NEAR(tasks_.group().motion.way, reference_->motion.way, 1e-9);
  }

  Jobs jobs_;
  std::vector<Job> list_;
  Arm arm_;
  Habit habit_;
  double cycle_;
  int every_; ///< The other task runs in one cycle of so many.
  double keep_;
  Tasks tasks_;
  std::unique_ptr<GroupMotion> reference_;
  double override_ = 1;
  Allowance allowance_ = kAllAllowed;
  bool disturbs_ = true;
  bool changes_ = false; ///< Who plans changes now and then.
  bool slides_ = false;  ///< The override changes all the time.
  bool leaps_ = false;
  int slideEvery_ = 1; ///< In one cycle of so many.
  bool stopping_ = false;
  bool atOnce_ = false;
  int working_ = 0; ///< Cycles until the other task has answered.
  int away_ = 0;    ///< Cycles in which it does nothing.
  int stops_ = 0;
  int lates_ = 0;
  int64_t cycles_ = 0;
  int64_t taken_ = 1;
};

void compare(Habit habit, bool disturbs, unsigned seed, int cases, double &slower,
             bool changes = false, bool slides = false, bool givesAxes = false) {
  const char *const only = std::getenv("STRIDE_GROUP_CASE");
  int stops = 0;
  int followed = 0;
  slower = 0;
  for (int i = only != nullptr ? std::atoi(only) : 0; i < cases && !testing::Test::HasFailure();
       ++i) {
    SCOPED_TRACE(testing::Message() << "case " << i);
    AsideComparison comparison(seed + static_cast<unsigned>(i), habit, givesAxes);
    comparison.disturbs(disturbs);
    comparison.changes(changes);
    comparison.slides(slides);
    if (!comparison.run())
      continue;
    ++followed;
    stops += comparison.stops();
    slower += comparison.slower();
  }
  slower /= followed;
  printf("%d stops of %d paths, %.3f times as long\n", stops, followed, slower);
  EXPECT_GT(followed, cases / 2);
  if (disturbs) {
    EXPECT_GT(stops, followed);
  }
}

TEST(GroupPlanning, GoesAsPlannedInItsOwnTask) {
  double slower = 0;
  compare(Habit::Punctual, false, 80'000, wanted(40), slower);
  EXPECT_LE(slower, 1.1);
}

TEST(GroupPlanning, KeepsPathAndLimitsWhereItIsLate) {
  double slower = 0;
  compare(Habit::Late, true, 81'000, wanted(40), slower);
}

TEST(GroupPlanning, RestsWhereNothingIsPlannedAndGoesOn) {
  double slower = 0;
  compare(Habit::Moody, true, 82'000, wanted(40), slower);
}

/// As online changes do that give a group a planning task, or take it away.
TEST(GroupPlanning, GoesOnWhoeverPlansFromNowOn) {
  double slower = 0;
  compare(Habit::Late, true, 83'000, wanted(40), slower, true);
}

/// As online changes do, where tool axes go evenly.
TEST(GroupPlanning, GoesOnWhereToolAxesGoEvenly) {
  double slower = 0;
  compare(Habit::Late, true, 86'000, wanted(16), slower, true, false, true);
}

/// An override that changes all the time, with stops, whoever plans.
TEST(GroupPlanning, KeepsPathAndLimitsWhileTheOverrideChanges) {
  double slower = 0;
  compare(Habit::Late, true, 84'000, wanted(20), slower, true, true);
  compare(Habit::Punctual, false, 85'000, wanted(20), slower, false, true);
}

} // namespace
