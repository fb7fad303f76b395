// What starts tasks besides the clock and their events: a bus.
#ifndef STRIDE_RUNTIME_TASK_PACER_HPP
#define STRIDE_RUNTIME_TASK_PACER_HPP

#include <cstdint>

namespace stride::task {

/// The program's time, for whoever waits. Virtual time passes at once.
class TaskClock {
public:
  TaskClock() = default;
  TaskClock(const TaskClock &) = delete;
  TaskClock &operator=(const TaskClock &) = delete;
  virtual ~TaskClock() = default;

  /// [ns]
  [[nodiscard]] virtual int64_t nowNs() const noexcept = 0;
  /// Returns at that time, at once if it is over. [ns]
  virtual void sleepUntil(int64_t timeNs) noexcept = 0;
  /// That time by the system's monotonic clock, for waiting at something else; virtual time: no
  /// such time, INT64_MAX. [ns]
  [[nodiscard]] virtual int64_t monotonicNs(int64_t timeNs) const noexcept = 0;
};

/// How a wait has ended.
struct Wake {
  int64_t timeNs = 0;   ///< The task's cycle is for this time. [ns]
  bool arrived = false; ///< What was waited for has come; FALSE: the deadline has.
  uint64_t missed = 0;  ///< So many came before it, while the task could not wait for them.
};

/// Paces one task in place of the clock: the SYNC of its bus. In virtual time it is asked when the
/// cycle before is over, and answers when it will be.
class Pacer {
public:
  Pacer() = default;
  Pacer(const Pacer &) = delete;
  Pacer &operator=(const Pacer &) = delete;
  virtual ~Pacer() = default;

  /// Waits for the next one after `afterNs`, the time of the last cycle (-1: there was none), until
  /// the deadline. From the task's thread, between its cycles: neither allocates nor locks.
  virtual Wake wait(int64_t afterNs, int64_t deadlineNs, TaskClock &clock) noexcept = 0;
};

/// Lets event tasks run.
class TaskRaiser {
public:
  TaskRaiser() = default;
  TaskRaiser(const TaskRaiser &) = delete;
  TaskRaiser &operator=(const TaskRaiser &) = delete;
  virtual ~TaskRaiser() = default;

  virtual void raise(uint32_t task) noexcept = 0;
  /// TaskSet::setMode() has been called: tasks that do not run soon by themselves take it over.
  virtual void modeChanged() noexcept {}
};

} // namespace stride::task

#endif
