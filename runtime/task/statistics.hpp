// What is measured about a task.
#ifndef STRIDE_RUNTIME_TASK_STATISTICS_HPP
#define STRIDE_RUNTIME_TASK_STATISTICS_HPP

#include "runtime/task/histogram.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace stride::task {

/// Figures of one task at some moment. Durations in nanoseconds; without a cycle the minima are 0.
struct TaskFigures {
  uint64_t cycles = 0;
  uint64_t overruns = 0;           ///< Activations that were skipped because a cycle took too long.
  uint64_t watchdogViolations = 0; ///< Cycles that ran longer than the watchdog allows.
  int64_t lastRunNs = 0;           ///< Run time of the last cycle, hooks included.
  int64_t minRunNs = 0;
  int64_t maxRunNs = 0;
  int64_t totalRunNs = 0;
  int64_t minIntervalNs = 0; ///< Between the starts of two cycles.
  int64_t maxIntervalNs = 0;
  int64_t maxLatencyNs = 0; ///< From the planned to the actual start.

  int64_t meanRunNs() const { return cycles == 0 ? 0 : totalRunNs / static_cast<int64_t>(cycles); }
};

/// One cycle, as a scheduler has seen it. [ns] `plannedNs` and `startNs` have the same origin.
struct CycleTimes {
  int64_t plannedNs;
  int64_t startNs;
  int64_t runNs;
};

/// Collects the figures of one task. The task's thread writes; any thread reads.
class TaskStatistics {
public:
  void add(const CycleTimes &times) noexcept;
  void addOverruns(uint64_t count) noexcept { bump(overruns_, count); }
  void addWatchdogViolation() noexcept { bump(violations_, 1); }

  TaskFigures figures() const noexcept;
  const Histogram &runTimes() const noexcept { return runTimes_; }
  /// From the planned to the actual start.
  const Histogram &latencies() const noexcept { return latencies_; }

private:
  static void bump(std::atomic<uint64_t> &value, uint64_t by) noexcept {
    value.store(value.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
  }

  static constexpr int64_t kNone = std::numeric_limits<int64_t>::max();
  std::atomic<uint64_t> cycles_{0};
  std::atomic<uint64_t> overruns_{0};
  std::atomic<uint64_t> violations_{0};
  std::atomic<int64_t> lastRun_{0};
  std::atomic<int64_t> minRun_{kNone};
  std::atomic<int64_t> maxRun_{0};
  std::atomic<int64_t> totalRun_{0};
  std::atomic<int64_t> lastStart_{0};
  std::atomic<int64_t> minInterval_{kNone};
  std::atomic<int64_t> maxInterval_{0};
  std::atomic<int64_t> maxLatency_{0};
  Histogram runTimes_;
  Histogram latencies_;
};

} // namespace stride::task

#endif
