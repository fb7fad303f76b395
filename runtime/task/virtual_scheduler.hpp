// Tasks in virtual time: deterministic, one thread, no waiting.
#ifndef STRIDE_RUNTIME_TASK_VIRTUAL_SCHEDULER_HPP
#define STRIDE_RUNTIME_TASK_VIRTUAL_SCHEDULER_HPP

#include "runtime/task/pacer.hpp"
#include "runtime/task/task_set.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace stride::task {

/// Called at the instants at which tasks run. All calls are outside of the cycles.
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
  /// The next time at which it wants to be called even when no task is due.
  virtual int64_t nextNs() const { return std::numeric_limits<int64_t>::max(); }
};

/// How a run ended.
struct RunResult {
  int64_t timeNs = 0;         ///< Virtual time that has passed.
  std::optional<Fault> fault; ///< The exception that stopped the application, if one did.
  bool interrupted = false;   ///< The stop request ended it.
};

/// Decides in virtual time which task runs next. At each instant the due tasks run by (priority,
/// order of declaration), each at most once; then time jumps to the next instant. Cycle n of a
/// cyclic task starts at n * interval, that of a freewheeling one at n * its virtual period.
///
/// Events are looked at before the first task of an instant and after every cycle. A rising edge
/// makes an event task due at once, so that it runs next if its priority is the highest of those
/// that are due; one edge can be pending per task. A status task is due while its event is TRUE, at
/// once and then every interval. A task that has already run at this instant becomes due kAgainNs
/// later.
///
/// A task with a pacer runs when that says, or without it after TaskSet::paceLimitNs. A raised task
/// is due as after an edge of its event.
///
/// At the instant at which RUN becomes STOP, or STOP RUN, also tasks that are not due soon take
/// that over (TaskSet::takeModeOver). In STOP events are not looked at; one that has become TRUE
/// meanwhile starts its task at the start.
///
/// After an exception the hooks go on until all are at rest, at most TaskSet::kStopLimitNs.
class VirtualScheduler final : private TaskRaiser {
public:
  static constexpr int64_t kAgainNs = 1'000;

  explicit VirtualScheduler(TaskSet &tasks);
  ~VirtualScheduler() override { tasks_->setRaiser(nullptr); }

  /// The observer must live as long as the scheduler.
  void setObserver(InstantObserver *observer) { observer_ = observer; }
  /// Asked between instants; true ends the run.
  void setStopRequest(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Runs all cycles that start before `endNs`. Can be called again with a later end.
  RunResult runUntil(int64_t endNs);

private:
  static constexpr int64_t kNever = std::numeric_limits<int64_t>::max();
  struct Due {
    int64_t atNs = kNever;
    int64_t ranNs = -1; ///< When its last cycle was.
    bool level = false; ///< Of the event, when it was last looked at.
    bool raised = false;
  };

  int64_t nextInstant() const;
  void stopAt(int64_t nowNs);
  void lookAtEvents(int64_t nowNs);
  bool runDueTask(int64_t nowNs, bool &fastest);
  void takeModeOver(int64_t nowNs);
  int64_t nextOf(uint32_t task, int64_t nowNs) const;
  int64_t waitFor(uint32_t task, Pacer &pacer, int64_t afterNs) const;
  void raise(uint32_t task) noexcept override;

  TaskSet *tasks_;
  std::vector<Due> due_; // by task
  int64_t stoppedNs_ = -1;
  int64_t nowNs_ = 0;
  bool begun_ = false;
  InstantObserver *observer_ = nullptr;
  std::function<bool()> stop_;
};

} // namespace stride::task

#endif
