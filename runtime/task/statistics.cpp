#include "runtime/task/statistics.hpp"

namespace stride::task {

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;

void lower(std::atomic<int64_t> &least, int64_t value) noexcept {
  if (value < least.load(kRelaxed))
    least.store(value, kRelaxed);
}

void raise(std::atomic<int64_t> &most, int64_t value) noexcept {
  if (value > most.load(kRelaxed))
    most.store(value, kRelaxed);
}

} // namespace

void TaskStatistics::add(const CycleTimes &times) noexcept {
  const uint64_t before = cycles_.load(kRelaxed);
  if (before != 0) {
    const int64_t interval = times.startNs - lastStart_.load(kRelaxed);
    lower(minInterval_, interval);
    raise(maxInterval_, interval);
  }
  lastStart_.store(times.startNs, kRelaxed);
  lastRun_.store(times.runNs, kRelaxed);
  lower(minRun_, times.runNs);
  raise(maxRun_, times.runNs);
  totalRun_.store(totalRun_.load(kRelaxed) + times.runNs, kRelaxed);
  raise(maxLatency_, times.startNs - times.plannedNs);
  runTimes_.record(times.runNs);
  latencies_.record(times.startNs - times.plannedNs);
  cycles_.store(before + 1, kRelaxed);
}

TaskFigures TaskStatistics::figures() const noexcept {
  const auto known = [](const std::atomic<int64_t> &least) {
    const int64_t value = least.load(kRelaxed);
    return value == kNone ? 0 : value;
  };
  TaskFigures figures;
  figures.cycles = cycles_.load(kRelaxed);
  figures.overruns = overruns_.load(kRelaxed);
  figures.watchdogViolations = violations_.load(kRelaxed);
  figures.lastRunNs = lastRun_.load(kRelaxed);
  figures.minRunNs = known(minRun_);
  figures.maxRunNs = maxRun_.load(kRelaxed);
  figures.totalRunNs = totalRun_.load(kRelaxed);
  figures.minIntervalNs = known(minInterval_);
  figures.maxIntervalNs = maxInterval_.load(kRelaxed);
  figures.maxLatencyNs = maxLatency_.load(kRelaxed);
  return figures;
}

} // namespace stride::task
