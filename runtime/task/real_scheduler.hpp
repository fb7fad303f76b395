// Tasks by the real clock: a thread for each.
#ifndef STRIDE_RUNTIME_TASK_REAL_SCHEDULER_HPP
#define STRIDE_RUNTIME_TASK_REAL_SCHEDULER_HPP

#include "runtime/task/cycle_gate.hpp"
#include "runtime/task/pacer.hpp"
#include "runtime/task/task_set.hpp"
#include "runtime/task/task_thread.hpp"

#include <semaphore.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace stride::task {

struct RealOptions {
  bool fifo = false; ///< SCHED_FIFO by task priority; else the tasks take turns.
  bool turns = true; ///< One cycle at a time, also with SCHED_FIFO.
  /// Processor of the tasks that choose none; none: wherever the system puts them.
  std::optional<uint32_t> core;
};

/// Runs the tasks of one application by the monotonic clock. Every task has a thread of its own
/// with its stack below 4 GiB, sleeps until absolute times and looks at nothing but the clock.
///
/// A cyclic task whose cycle is not over at its next planned start skips what it has missed, so
/// that it stays on the grid of its interval (an overrun each). A freewheeling task pauses
/// kFreewheelingPauseNs after each cycle. Events are looked at after every cycle of every task; see
/// VirtualScheduler for what they and STOP do, with the actual time for the virtual one. The thread
/// of a task with a pacer waits in that.
class RealScheduler final : private TaskRaiser {
public:
  static constexpr int64_t kFreewheelingPauseNs = 1'000'000;

  RealScheduler(TaskSet &tasks, const RealOptions &options);
  RealScheduler(const RealScheduler &) = delete;
  RealScheduler &operator=(const RealScheduler &) = delete;
  /// Stops as finish() does.
  ~RealScheduler() override;

  /// Starts the threads; time 0 of the program is when this returns. Throws app::Error when the
  /// system has no threads or no memory for them.
  void start();

  const RealOptions &options() const { return options_; }
  /// What the program sees as the time now. [ns]
  int64_t nowNs() const { return monotonicNs() - originNs_; }

  /// Ends: no POU runs any more, the hooks go on until all are at rest (at most
  /// TaskSet::kStopLimitNs), then the threads end. Meanwhile calls `meanwhile`, again and again.
  /// False: something did not come to rest.
  bool finish(const std::function<void()> &meanwhile = {});

  /// Calls `change` while no task is inside a cycle. Returns for how long no cycle could begin.
  /// [ns] From one thread at a time, not from a task's.
  int64_t betweenCycles(const std::function<void()> &change);

private:
  class Clock;
  struct Worker {
    uint32_t task = 0;
    ::sem_t raised{};               ///< An event, or the end.
    std::atomic<bool> level{false}; ///< Of the event, when it was last looked at.
    std::atomic<bool> pending{false};
    std::unique_ptr<TaskThread> thread;
  };

  void work(Worker &worker);
  void serve(Worker &worker);
  void end();
  void prepareThread(const Worker &worker) const;
  void cycle(Worker &worker, int64_t plannedNs);
  void lookAtEvents();
  void lookOnce();
  void runCyclic(Worker &worker);
  void runFreewheeling(Worker &worker);
  void runOnEvent(Worker &worker);
  void runPaced(Worker &worker, Pacer &pacer);
  std::optional<Wake> waitPaced(uint32_t task, Pacer &pacer, int64_t afterNs, int64_t limitNs);
  void raise(uint32_t task) noexcept override;
  void modeChanged() noexcept override;
  /// What a wait has ended with.
  enum class Woken : uint8_t { Due, TakeModeOver, End };
  Woken waitForEvent(Worker &worker, int64_t untilNs);
  Woken sleepUntil(uint32_t task, int64_t timeNs) const;
  void takeModeOver(const Worker &worker);
  bool ending() const { return ending_.load(std::memory_order_acquire); }

  TaskSet *tasks_;
  RealOptions options_;
  CycleGate gate_;
  std::vector<std::unique_ptr<Worker>> workers_; // by task
  int64_t originNs_ = 0;
  std::atomic<uint32_t> ready_{0};
  std::atomic<uint32_t> go_{0};
  std::atomic<bool> failed_{false}; ///< A thread could not get ready.
  std::atomic<bool> ending_{false};
  std::atomic<uint32_t> looks_{0}; ///< At the events, that have been asked for.
  bool started_ = false;
};

} // namespace stride::task

#endif
