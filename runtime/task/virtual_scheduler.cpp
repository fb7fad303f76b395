#include "runtime/task/virtual_scheduler.hpp"

#include <algorithm>

namespace stride::task {

VirtualScheduler::VirtualScheduler(TaskSet &tasks) : tasks_(&tasks), due_(tasks.count()) {
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
  for (;;) {
    const int64_t now = nextInstant();
    if (now >= endNs) {
      result.timeNs = endNs;
      break;
    }
    result.timeNs = now;
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
    lookAtEvents(now);
    bool fastest = false;
    while (runDueTask(now, fastest))
      lookAtEvents(now);
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
  if (!tasks_->hasEvents() || tasks_->stopped())
    return;
  for (const uint32_t i : tasks_->order()) {
    const TaskDesc &desc = tasks_->desc(i);
    if (desc.event == nullptr)
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

/// Runs the first of the tasks that are due; false when there is none.
bool VirtualScheduler::runDueTask(int64_t nowNs, bool &fastest) {
  for (const uint32_t i : tasks_->order()) {
    Due &due = due_[i];
    if (due.atNs > nowNs)
      continue;
    const TaskDesc &desc = tasks_->desc(i);
    const bool periodic =
        desc.intervalNs > 0 && !(desc.kind == TaskKind::Event && due.level && stoppedNs_ < 0);
    due.ranNs = nowNs;
    if (periodic)
      due.atNs = nowNs + (stoppedNs_ < 0 ? desc.intervalNs
                                         : std::min(desc.intervalNs, TaskSet::kLongIntervalNs));
    else
      due.atNs = stoppedNs_ < 0 ? kNever : nowNs + TaskSet::kStoppedIntervalNs;
    tasks_->runCycle(i, nowNs, 0);
    fastest = fastest || i == tasks_->fastest();
    return true;
  }
  return false;
}

} // namespace stride::task
