// Tasks in virtual time: deterministic, one thread, no waiting.
#ifndef STRIDE_RUNTIME_TASK_VIRTUAL_SCHEDULER_HPP
#define STRIDE_RUNTIME_TASK_VIRTUAL_SCHEDULER_HPP

#include "runtime/app/abi.h"
#include "runtime/task/cycle_hook.hpp"
#include "runtime/task/fault.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace stride::task {

/// What a task has done so far.
struct TaskStatistics {
  uint64_t cycles = 0;
  /// Run times of one cycle in real time, hooks included. [ns] They never reach the program.
  int64_t minRunNs = std::numeric_limits<int64_t>::max();
  int64_t maxRunNs = 0;
  int64_t totalRunNs = 0;
};

/// Called at the instants at which tasks run. Both calls are outside of the cycles.
class InstantObserver {
public:
  InstantObserver() = default;
  InstantObserver(const InstantObserver &) = delete;
  InstantObserver &operator=(const InstantObserver &) = delete;
  virtual ~InstantObserver() = default;

  /// Before the first task of the instant.
  virtual void beforeInstant(int64_t timeNs) = 0;
  /// After the last task of the instant. `fastest`: the fastest task was among them.
  virtual void afterInstant(int64_t timeNs, bool fastest) = 0;
};

/// How a run ended.
struct RunResult {
  int64_t timeNs = 0;         ///< Virtual time that has passed.
  std::optional<Fault> fault; ///< The exception that stopped the application, if one did.
  bool interrupted = false;   ///< The stop request ended it.
};

/// Runs the tasks of one application. At each instant the due tasks run by (priority, order of
/// declaration); then time jumps to the next instant. Task i's cycle n starts at n * interval.
/// The hooks of a task run around its POUs, before in the order of adding, after in reverse.
///
/// When a task's cycle ends with an exception, no POU runs any more; the hooks go on until all are
/// at rest, at most kStopLimitNs.
class VirtualScheduler {
public:
  static constexpr int64_t kStopLimitNs = 60'000'000'000;
  static constexpr int64_t kDefaultLoopBudget = 1'000'000'000;

  /// `state` is initialised. Throws app::Error for tasks that cannot run in virtual time.
  VirtualScheduler(const StrideAppV1 &app, std::byte *state, const HostApi &host);

  /// Loop iterations that one cycle may use.
  void setLoopBudget(int64_t budget) { loopBudget_ = budget; }
  /// The hook and the observer must live as long as the scheduler.
  void addHook(uint32_t task, CycleHook &hook);
  void setObserver(InstantObserver *observer) { observer_ = observer; }
  /// Asked between instants; true ends the run.
  void setStopRequest(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Runs all cycles that start before `endNs`. Can be called again with a later end.
  RunResult runUntil(int64_t endNs);

  const std::vector<TaskStatistics> &statistics() const { return statistics_; }
  /// Index of the task with the shortest interval, the first one of several.
  uint32_t fastestTask() const { return fastest_; }

private:
  struct Task {
    uint32_t index;
    uint32_t priority;
    int64_t nextNs;
    Ctx ctx;
    std::vector<CycleHook *> hooks;
  };

  void runCycle(Task &task);
  bool allAtRest() const;

  const StrideAppV1 *app_;
  std::vector<Task> tasks_; // by priority, then declaration
  std::vector<TaskStatistics> statistics_;
  std::vector<CycleHook *> hooks_;
  InstantObserver *observer_ = nullptr;
  std::function<bool()> stop_;
  std::optional<Fault> fault_;
  int64_t loopBudget_ = kDefaultLoopBudget;
  uint32_t fastest_ = 0;
};

} // namespace stride::task

#endif
