// Who may be inside a cycle.
#ifndef STRIDE_RUNTIME_TASK_CYCLE_GATE_HPP
#define STRIDE_RUNTIME_TASK_CYCLE_GATE_HPP

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace stride::task {

/// Every task's thread passes it before and after a cycle. It lets all threads in, and the system
/// preempts them by priority; or, where the system gives no priorities, one at a time, the most
/// important of those that wait first. And it can be held, so that something is done between two
/// cycles of all tasks.
class CycleGate {
public:
  /// `ranks`: of each task, 0 the most important, all different. `turns`: one at a time.
  CycleGate(std::vector<uint32_t> ranks, bool turns);

  /// Waits until the task may begin a cycle.
  void enter(uint32_t task);
  void leave(uint32_t task);

  /// Returns when no task is inside a cycle; none begins one before release().
  void hold();
  void release();

private:
  void enterTurn(uint32_t rank);

  std::vector<uint32_t> ranks_;
  bool turns_;
  // Preemptive: a task says that it is inside and then looks whether the gate is held; who holds
  // it says so and then looks who is inside. One of the two sees the other.
  std::unique_ptr<std::atomic<uint32_t>[]> inside_;
  std::atomic<uint32_t> held_{0};
  // In turns.
  std::mutex mutex_;
  std::unique_ptr<std::condition_variable[]> wake_; // by rank + 1; 0: who holds the gate
  std::vector<bool> waiting_;                       // by rank + 1
  bool busy_ = false;
};

} // namespace stride::task

#endif
