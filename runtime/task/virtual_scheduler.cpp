#include "runtime/task/virtual_scheduler.hpp"

#include <algorithm>
#include <limits>

namespace stride::task {

namespace {

/// Sleeping takes no time.
class VirtualClock final : public TaskClock {
public:
  explicit VirtualClock(int64_t nowNs) : nowNs_(nowNs) {}
  int64_t nowNs() const noexcept override { return nowNs_; }
  void sleepUntil(int64_t timeNs) noexcept override { nowNs_ = std::max(nowNs_, timeNs); }
  int64_t monotonicNs(int64_t) const noexcept override {
    return std::numeric_limits<int64_t>::max();
  }

private:
  int64_t nowNs_;
};

} // namespace

VirtualScheduler::VirtualScheduler(TaskSet &tasks) : tasks_(&tasks), due_(tasks.count()) {
  tasks.setRaiser(this);
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    const TaskDesc &desc = tasks.desc(i);
    if (desc.kind != TaskKind::Status && desc.intervalNs > 0)
      due_[i].atNs = 0;
  }
}

int64_t VirtualScheduler::nextInstant() const {
  int64_t next = observer_ != nullptr && !tasks_->stopped() ? observer_->nextNs() : kNever;
  for (const Due &due : due_)
    next = std::min(next, due.atNs);
  return next;
}

RunResult VirtualScheduler::runUntil(int64_t endNs) {
  RunResult result;
  for (uint32_t i = 0; i < due_.size() && !begun_; ++i)
    if (Pacer *pacer = tasks_->pacer(i))
      due_[i].atNs = waitFor(i, *pacer, -1);
  begun_ = true;
  for (;;) {
    const int64_t now = nextInstant();
    if (now >= endNs) {
      result.timeNs = endNs;
      break;
    }
    result.timeNs = nowNs_ = now;
    if (stop_ && stop_()) {
      result.interrupted = true;
      break;
    }
    if (tasks_->stopped() && stoppedNs_ < 0)
      stopAt(now);
    if (stoppedNs_ >= 0 && (tasks_->atRest() || now - stoppedNs_ > TaskSet::kStopLimitNs))
      break;
    if (observer_ != nullptr && stoppedNs_ < 0)
      observer_->beforeInstant(now);
    takeModeOver(now);
    lookAtEvents(now);
    bool fastest = false;
    while (runDueTask(now, fastest)) {
      takeModeOver(now);
      lookAtEvents(now);
    }
    if (tasks_->stopped() && stoppedNs_ < 0)
      stopAt(now);
    if (observer_ != nullptr)
      observer_->afterInstant(now, fastest);
  }
  result.fault = tasks_->fault();
  return result;
}

/// From now on every task goes on for its hooks, also without an event.
void VirtualScheduler::stopAt(int64_t nowNs) {
  stoppedNs_ = nowNs;
  for (uint32_t i = 0; i < due_.size(); ++i)
    if (due_[i].atNs == kNever || tasks_->desc(i).intervalNs > TaskSet::kLongIntervalNs)
      due_[i].atNs = std::min(due_[i].atNs, nowNs + kAgainNs);
}

void VirtualScheduler::lookAtEvents(int64_t nowNs) {
  if (!tasks_->hasEvents() || tasks_->stopped() || tasks_->mode() == OperatingMode::Stop)
    return;
  for (const uint32_t i : tasks_->order()) {
    const TaskDesc &desc = tasks_->desc(i);
    if (desc.event == nullptr || tasks_->pacer(i) != nullptr)
      continue;
    Due &due = due_[i];
    const bool level = tasks_->eventLevel(i, nowNs);
    const bool rising = level && !due.level;
    due.level = level;
    const int64_t soonest = due.ranNs == nowNs ? nowNs + kAgainNs : nowNs;
    if (desc.kind == TaskKind::Status) {
      if (rising)
        due.atNs = std::min(due.atNs, soonest);
      else if (!level)
        due.atNs = kNever;
    } else if (rising) {
      due.atNs = std::min(due.atNs, soonest);
    } else if (desc.intervalNs > 0 && level && due.atNs > soonest) {
      due.atNs = kNever; // the period of SINGLE's INTERVAL counts while the event is FALSE
    } else if (desc.intervalNs > 0 && !level && due.atNs == kNever) {
      due.atNs = nowNs + desc.intervalNs;
    }
  }
}

/// Tasks that wait for something else than a short interval do not wait with that.
void VirtualScheduler::takeModeOver(int64_t nowNs) {
  for (const uint32_t i : tasks_->order()) {
    const Due &due = due_[i];
    const bool soon = due.atNs <= nowNs || (due.atNs != kNever && tasks_->takesModeSoon(i));
    if (stoppedNs_ < 0 && !soon && tasks_->modeOf(i) != tasks_->mode())
      tasks_->takeModeOver(i, nowNs);
  }
}

/// Runs the first of the tasks that are due; false when there is none.
bool VirtualScheduler::runDueTask(int64_t nowNs, bool &fastest) {
  for (const uint32_t i : tasks_->order()) {
    Due &due = due_[i];
    if (due.atNs > nowNs)
      continue;
    due.ranNs = nowNs;
    due.raised = false;
    due.atNs = nextOf(i, nowNs);
    tasks_->runCycle(i, nowNs, 0);
    if (Pacer *pacer = tasks_->pacer(i)) {
      due.atNs = waitFor(i, *pacer, nowNs);
      if (stoppedNs_ >= 0)
        due.atNs = std::min(due.atNs, nowNs + TaskSet::kLongIntervalNs);
    }
    fastest = fastest || i == tasks_->fastest();
    return true;
  }
  return false;
}

/// When a task without a pacer runs again by itself.
int64_t VirtualScheduler::nextOf(uint32_t task, int64_t nowNs) const {
  const TaskDesc &desc = tasks_->desc(task);
  const bool waits = desc.kind == TaskKind::Event && due_[task].level && stoppedNs_ < 0;
  if (desc.intervalNs <= 0 || waits)
    return stoppedNs_ < 0 ? kNever : nowNs + TaskSet::kStoppedIntervalNs;
  return nowNs +
         (stoppedNs_ < 0 ? desc.intervalNs : std::min(desc.intervalNs, TaskSet::kLongIntervalNs));
}

int64_t VirtualScheduler::waitFor(uint32_t task, Pacer &pacer, int64_t afterNs) const {
  VirtualClock clock(std::max<int64_t>(afterNs, 0));
  const int64_t deadline = std::max<int64_t>(afterNs, 0) + tasks_->paceLimitNs(task);
  const Wake wake = pacer.wait(afterNs, deadline, clock);
  tasks_->addOverruns(task, wake.missed);
  return std::max(wake.timeNs, afterNs + 1); // time goes on, whatever the bus says
}

/// In the cycle of another task, at nowNs_.
void VirtualScheduler::raise(uint32_t task) noexcept {
  Due &due = due_[task];
  if (due.raised)
    tasks_->addOverruns(task, 1);
  due.raised = true;
  due.atNs = std::min(due.atNs, due.ranNs == nowNs_ ? nowNs_ + kAgainNs : nowNs_);
}

} // namespace stride::task
