// Both tasks of a group that is planned in another task, for tests.
#ifndef STRIDE_TESTS_PROPERTY_GROUP_TASKS_HPP
#define STRIDE_TESTS_PROPERTY_GROUP_TASKS_HPP

#include "group_jobs.hpp"

#include "runtime/numeric/group/planning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

namespace stride::test {

/// Both tasks of a group.
class Tasks {
public:
  Tasks(std::unique_ptr<GroupMotion> group, const Machine &machine, double cycle)
      : group_(std::move(group)), planning_(std::make_unique<GroupPlanning>()), machine_(machine),
        arm_(machine_.arm()), cycle_(cycle) {}

  GroupMotion &group() { return *group_; }
  std::unique_ptr<GroupMotion> &owner() { return group_; }
  const Arm &arm() const { return arm_; }

  GroupCommand command(double override, bool stop, double keep, bool atOnce,
                       const Allowance &allowance) const {
    GroupCommand command{cycle_, override, stop, 0, steps(cycle_), 64, allowance};
    command.keep = keep;
    command.atOnce = atOnce;
    return command;
  }

  void follow(const GroupCommand &command) {
    if (aside_)
      (void)stride::group::follow(*group_, *planning_, arm_, command);
    else
      plan(*group_, arm_, command);
  }
  void goOnAndPost(const GroupCommand &command) {
    if (!aside_) {
      goOn(*group_, arm_, command);
      (void)rebase(*group_);
      return;
    }
    goOn(*group_, *planning_, arm_, command);
    (void)post(*group_, *planning_, arm_, machine_.kinematics, command);
    if (command.stop && command.atOnce) {
      EXPECT_TRUE(group_->alone);
    }
  }

  /// An online change makes another task plan, or none.
  void changePlanner() {
    aside_ = !aside_;
    if (aside_)
      planning_ = std::make_unique<GroupPlanning>();
    else
      std::memset(static_cast<void *>(planning_.get()), 0xA5, sizeof(GroupPlanning));
  }

  bool takeJob() { return aside_ && stride::group::takeJob(*planning_); }
  /// The result is not seen before answerJob.
  void doJob(double interval) {
    stride::group::doJob(*planning_, {interval, steps(interval), 24 * milliseconds(interval)});
  }
  void answerJob() { stride::group::answerJob(*planning_); }

  /// Everything is elsewhere in memory.
  void relocate() {
    auto group = std::make_unique<GroupMotion>();
    std::memcpy(group.get(), group_.get(), sizeof(GroupMotion));
    std::memset(group_.get(), 0xA5, sizeof(GroupMotion));
    group_ = std::move(group);
    auto planning = std::make_unique<GroupPlanning>();
    std::memcpy(planning.get(), planning_.get(), sizeof(GroupPlanning));
    std::memset(static_cast<void *>(planning_.get()), 0xA5, sizeof(GroupPlanning));
    planning_ = std::move(planning);
  }

private:
  static int milliseconds(double time) { return std::clamp(static_cast<int>(time * 1e3), 1, 100); }
  static int steps(double time) { return 64 * milliseconds(time); }

  std::unique_ptr<GroupMotion> group_;
  std::unique_ptr<GroupPlanning> planning_;
  Machine machine_;
  Arm arm_;
  double cycle_;
  bool aside_ = true;
};

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_GROUP_TASKS_HPP
