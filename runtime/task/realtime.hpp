// What the operating system gives to tasks of the real clock.
#ifndef STRIDE_RUNTIME_TASK_REALTIME_HPP
#define STRIDE_RUNTIME_TASK_REALTIME_HPP

#include <cstdint>
#include <string>
#include <vector>

namespace stride::task {

/// What was obtained, and what not with the remedy.
struct RealtimeReport {
  bool fifo = false; ///< Threads get SCHED_FIFO by the priority of their task.
  std::vector<std::string> warnings;
};

/// Keeps the processors out of sleep states from which they wake up late, while it lives; where the
/// system does not let it, that is all the same (virtual machines have none).
class NoDeepSleep {
public:
  NoDeepSleep() noexcept;
  ~NoDeepSleep();
  NoDeepSleep(const NoDeepSleep &) = delete;
  NoDeepSleep &operator=(const NoDeepSleep &) = delete;

private:
  int file_;
};

/// Locks the process's memory and finds out whether SCHED_FIFO is permitted. Once per process.
RealtimeReport prepareRealtime();

/// SCHED_FIFO for the calling thread: 80 for task priority 0 down to 49 for 31, so that the tasks
/// are before the kernel's interrupt threads (50) down to priority 29. False: not permitted.
bool useFifo(uint32_t taskPriority) noexcept;

/// The processors the process may use, in ascending order.
std::vector<uint32_t> allowedCores();

/// Pins the calling thread; false when the system refuses.
bool pinTo(uint32_t core) noexcept;

/// Touches `bytes` of the calling thread's stack below the current frame, so that later calls find
/// the pages there.
void touchStack(size_t bytes) noexcept;

/// For threads without SCHED_FIFO: timers as exact as the kernel can.
void useExactTimers() noexcept;

} // namespace stride::task

#endif
