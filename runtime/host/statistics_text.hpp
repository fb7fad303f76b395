// The tasks' figures for people.
#ifndef STRIDE_RUNTIME_HOST_STATISTICS_TEXT_HPP
#define STRIDE_RUNTIME_HOST_STATISTICS_TEXT_HPP

#include "runtime/task/task_set.hpp"

#include <string>
#include <vector>

namespace stride::host {

/// A table with a row per task: cycles, overruns, watchdog violations, run time (min, mean, p99,
/// max), delay of the start (p50, p99, p99.9, max) and interval (min, max), in microseconds.
std::string statisticsTable(const task::TaskSet &tasks);

struct NamedTasks {
  std::string application;
  const task::TaskSet *tasks = nullptr;
};

/// The same for programs: by application where there are several, an object per task with cycles,
/// overruns, watchdogViolations, and runNs, lateNs and intervalNs with min, mean, p50, p99, p999,
/// max (where they are known).
std::string statisticsJson(const std::vector<NamedTasks> &applications);

/// The distribution of one task's run times and delays, a line per power of two that occurred.
std::string histogramText(const task::TaskStatistics &statistics);

} // namespace stride::host

#endif
