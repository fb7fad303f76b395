#include "runtime/task/virtual_scheduler.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace stride::task {

VirtualScheduler::VirtualScheduler(const StrideAppV1 &app, std::byte *state, const HostApi &host)
    : app_(&app), statistics_(app.taskCount) {
  if (app.taskCount == 0)
    throw app::Error("the application has no task; add one to stride.toml or a CONFIGURATION");
  for (uint32_t i = 0; i < app.taskCount; ++i) {
    const TaskDesc &desc = app.tasks[i];
    if (desc.kind != TaskKind::Cyclic && desc.kind != TaskKind::Freewheeling)
      throw app::Error(fmt::format("task '{}' is neither cyclic nor freewheeling; this runtime has "
                                   "no other kinds of tasks",
                                   desc.name));
    if (desc.intervalNs <= 0)
      throw app::Error(fmt::format("task '{}' has no interval", desc.name));
    Task task{i, desc.priority, 0, Ctx{}, {}};
    task.ctx.state = state;
    task.ctx.taskIntervalNs = desc.intervalNs;
    task.ctx.taskIndex = i;
    task.ctx.host = &host;
    task.ctx.firstCycle = 1;
    tasks_.push_back(std::move(task));
    if (desc.intervalNs < app.tasks[fastest_].intervalNs)
      fastest_ = i;
  }
  std::stable_sort(tasks_.begin(), tasks_.end(),
                   [](const Task &a, const Task &b) { return a.priority < b.priority; });
}

void VirtualScheduler::addHook(uint32_t task, CycleHook &hook) {
  for (Task &t : tasks_) {
    if (t.index == task)
      t.hooks.push_back(&hook);
  }
  hooks_.push_back(&hook);
}

RunResult VirtualScheduler::runUntil(int64_t endNs) {
  RunResult result;
  for (;;) {
    int64_t now = std::numeric_limits<int64_t>::max();
    for (const Task &task : tasks_)
      now = std::min(now, task.nextNs);
    if (now >= endNs) {
      result.timeNs = endNs;
      break;
    }
    result.timeNs = now;
    if (stop_ && stop_()) {
      result.interrupted = true;
      break;
    }
    if (fault_ && (allAtRest() || now - fault_->timeNs > kStopLimitNs))
      break;
    if (observer_ != nullptr && !fault_)
      observer_->beforeInstant(now);
    bool fastest = false;
    for (Task &task : tasks_) {
      if (task.nextNs != now)
        continue;
      runCycle(task);
      fastest = fastest || task.index == fastest_;
    }
    if (observer_ != nullptr)
      observer_->afterInstant(now, fastest);
  }
  result.fault = fault_;
  return result;
}

void VirtualScheduler::runCycle(Task &task) {
  const auto started = std::chrono::steady_clock::now();
  Ctx &ctx = task.ctx;
  TaskStatistics &statistics = statistics_[task.index];
  ctx.cycleStartNs = task.nextNs;
  ctx.cycle = statistics.cycles;
  ctx.loopBudget = loopBudget_;
  for (CycleHook *hook : task.hooks)
    hook->beforePous(ctx);
  if (!fault_) {
    const TaskDesc &desc = app_->tasks[task.index];
    if (std::optional<StException> exception = guardedCall(desc.run, ctx)) {
      fault_ = Fault{*exception, desc.name, ctx.cycle, ctx.cycleStartNs};
      for (CycleHook *hook : hooks_)
        hook->applicationStopped();
    }
  }
  for (auto hook = task.hooks.rbegin(); hook != task.hooks.rend(); ++hook)
    (*hook)->afterPous(ctx);
  ctx.firstCycle = 0;
  task.nextNs += ctx.taskIntervalNs;
  ++statistics.cycles;
  const int64_t run = std::chrono::duration_cast<std::chrono::nanoseconds>(
                          std::chrono::steady_clock::now() - started)
                          .count();
  statistics.minRunNs = std::min(statistics.minRunNs, run);
  statistics.maxRunNs = std::max(statistics.maxRunNs, run);
  statistics.totalRunNs += run;
}

bool VirtualScheduler::allAtRest() const {
  return std::all_of(hooks_.begin(), hooks_.end(),
                     [](const CycleHook *hook) { return hook->atRest(); });
}

} // namespace stride::task
