#include "runtime/task/real_scheduler.hpp"

#include "runtime/app/error.hpp"
#include "runtime/task/realtime.hpp"

#include <ctime>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <limits>
#include <optional>
#include <thread>

namespace stride::task {

namespace {

constexpr int64_t kNever = std::numeric_limits<int64_t>::max();
/// A sleeping thread looks so often whether the end has come. [ns]
constexpr int64_t kLongestSleepNs = 100'000'000;
constexpr size_t kTouchedStack = size_t{512} << 10;

::timespec toTimespec(int64_t ns) {
  ::timespec time{};
  time.tv_sec = static_cast<time_t>(ns / 1'000'000'000);
  time.tv_nsec = static_cast<long>(ns % 1'000'000'000);
  return time;
}

/// Of each task, by priority and order of declaration.
std::vector<uint32_t> ranksOf(const TaskSet &tasks) {
  std::vector<uint32_t> ranks(tasks.count());
  uint32_t rank = 0;
  for (const uint32_t task : tasks.order())
    ranks[task] = rank++;
  return ranks;
}

} // namespace

class RealScheduler::Clock final : public TaskClock {
public:
  explicit Clock(int64_t originNs) : originNs_(originNs) {}
  int64_t nowNs() const noexcept override { return task::monotonicNs() - originNs_; }
  void sleepUntil(int64_t timeNs) noexcept override {
    const ::timespec until = toTimespec(originNs_ + timeNs);
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
  }
  int64_t monotonicNs(int64_t timeNs) const noexcept override { return originNs_ + timeNs; }

private:
  int64_t originNs_;
};

RealScheduler::RealScheduler(TaskSet &tasks, const RealOptions &options)
    : tasks_(&tasks), options_(options), gate_(ranksOf(tasks), options.turns || !options.fifo) {
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    auto worker = std::make_unique<Worker>();
    worker->task = i;
    ::sem_init(&worker->raised, 0, 0);
    workers_.push_back(std::move(worker));
  }
  tasks.setRaiser(this);
}

RealScheduler::~RealScheduler() {
  finish();
  tasks_->setRaiser(nullptr);
  for (const std::unique_ptr<Worker> &worker : workers_)
    ::sem_destroy(&worker->raised);
}

void RealScheduler::start() {
  try {
    for (const std::unique_ptr<Worker> &worker : workers_)
      worker->thread = std::make_unique<TaskThread>([this, w = worker.get()] { work(*w); });
  } catch (...) {
    end();
    throw;
  }
  // The threads set themselves up first, so that time 0 finds all of them waiting.
  for (uint32_t ready = ready_.load(); ready != workers_.size(); ready = ready_.load())
    ready_.wait(ready);
  if (failed_.load()) {
    end();
    throw app::Error("the system has not enough memory for the tasks");
  }
  started_ = true;
  originNs_ = monotonicNs() + 1'000'000;
  if (tasks_->hasEvents())
    lookAtEvents();
  go_.store(1);
  go_.notify_all();
}

void RealScheduler::prepareThread(const Worker &worker) const {
  const TaskDesc &desc = tasks_->desc(worker.task);
  if (desc.core != kNoIndex)
    pinTo(desc.core);
  else if (options_.core)
    pinTo(*options_.core);
  touchStack(kTouchedStack);
  touchDataStack(kTouchedStack);
  useExactTimers();
  if (options_.fifo)
    useFifo(desc.priority);
}

void RealScheduler::work(Worker &worker) {
  std::optional<MemoryGuard> guard;
  try {
    guard.emplace();
    prepareThread(worker);
  } catch (...) {
    failed_.store(true);
  }
  ready_.fetch_add(1);
  ready_.notify_all();
  go_.wait(0);
  if (!failed_.load())
    serve(worker);
}

void RealScheduler::serve(Worker &worker) {
  if (Pacer *pacer = tasks_->pacer(worker.task)) {
    runPaced(worker, *pacer);
    return;
  }
  switch (tasks_->desc(worker.task).kind) {
  case TaskKind::Cyclic:
    runCyclic(worker);
    break;
  case TaskKind::Freewheeling:
    runFreewheeling(worker);
    break;
  case TaskKind::Event:
  case TaskKind::Status:
    runOnEvent(worker);
    break;
  }
}

void RealScheduler::cycle(Worker &worker, int64_t plannedNs) {
  gate_.enter(worker.task);
  const int64_t latency = std::max<int64_t>(nowNs() - plannedNs, 0);
  tasks_->runCycle(worker.task, plannedNs, latency);
  if (tasks_->hasEvents())
    lookAtEvents();
  gate_.leave(worker.task);
}

/// One thread looks at a time, so that an edge counts once: it looks again for those who come
/// meanwhile and do not wait.
void RealScheduler::lookAtEvents() {
  if (looks_.fetch_add(1) != 0)
    return;
  for (uint32_t asked = 1; asked != 0; asked = looks_.fetch_sub(asked) - asked) {
    asked = looks_.load();
    lookOnce();
  }
}

void RealScheduler::lookOnce() {
  if (tasks_->stopped() || tasks_->mode() == OperatingMode::Stop)
    return;
  for (const std::unique_ptr<Worker> &worker : workers_) {
    const TaskDesc &desc = tasks_->desc(worker->task);
    if (desc.event == nullptr || tasks_->pacer(worker->task) != nullptr)
      continue;
    const bool level = tasks_->eventLevel(worker->task, nowNs());
    const bool rising = level && !worker->level.exchange(level);
    if (!level)
      worker->level.store(false);
    if (rising && !worker->pending.exchange(true))
      ::sem_post(&worker->raised);
  }
}

void RealScheduler::runCyclic(Worker &worker) {
  const int64_t interval = tasks_->desc(worker.task).intervalNs;
  const bool isLong = interval > TaskSet::kLongIntervalNs;
  for (int64_t planned = 0;;) {
    const Woken woken = sleepUntil(worker.task, planned);
    if (woken == Woken::End)
      return;
    if (woken == Woken::TakeModeOver) {
      takeModeOver(worker);
      continue;
    }
    const int64_t start = std::min(planned, nowNs()); // a stop does not wait for the plan
    cycle(worker, start);
    planned = start + (isLong && tasks_->stopped() ? TaskSet::kLongIntervalNs : interval);
    if (const int64_t late = nowNs() - planned; late > 0) {
      const int64_t missed = (late + interval - 1) / interval;
      tasks_->addOverruns(worker.task, static_cast<uint64_t>(missed));
      planned += missed * interval;
    }
  }
}

void RealScheduler::runFreewheeling(Worker &worker) {
  for (int64_t planned = 0; sleepUntil(worker.task, planned) != Woken::End;
       planned = nowNs() + kFreewheelingPauseNs)
    cycle(worker, planned);
}

void RealScheduler::runOnEvent(Worker &worker) {
  // Copies: an online change replaces the description.
  const bool isStatus = tasks_->desc(worker.task).kind == TaskKind::Status;
  const int64_t interval = tasks_->desc(worker.task).intervalNs;
  int64_t next = !isStatus && interval > 0 ? 0 : kNever;
  for (Woken woken = waitForEvent(worker, next); woken != Woken::End;
       woken = waitForEvent(worker, next)) {
    if (woken == Woken::TakeModeOver) {
      takeModeOver(worker);
      continue;
    }
    if (isStatus && !worker.level.load() && !tasks_->stopped()) {
      next = kNever; // it became FALSE before the next cycle
      continue;
    }
    if (worker.pending.exchange(false))
      ::sem_trywait(&worker.raised); // the event and the time have come together
    const int64_t now = nowNs();
    cycle(worker, next <= now ? next : now);
    const bool level = worker.level.load();
    if (tasks_->stopped())
      next = now + (interval > 0 ? interval : TaskSet::kStoppedIntervalNs);
    else if (isStatus)
      next = level ? now + interval : kNever;
    else
      next = interval > 0 && !level ? now + interval : kNever;
  }
}

/// Until the event is raised or the time has come.
RealScheduler::Woken RealScheduler::waitForEvent(Worker &worker, int64_t untilNs) {
  for (;;) {
    if (ending())
      return Woken::End;
    const bool stopped = tasks_->stopped();
    if (!stopped && tasks_->modeOf(worker.task) != tasks_->mode())
      return Woken::TakeModeOver;
    const int64_t now = nowNs();
    if (untilNs <= now)
      return Woken::Due;
    const ::timespec until = toTimespec(originNs_ + std::min(untilNs, now + kLongestSleepNs));
    if (::sem_clockwait(&worker.raised, CLOCK_MONOTONIC, &until) == 0) {
      // Also for a new mode, without an event.
      if (worker.pending.exchange(false) || tasks_->stopped())
        return ending() ? Woken::End : Woken::Due;
      continue;
    }
    if (tasks_->stopped() && untilNs == kNever)
      return ending() ? Woken::End : Woken::Due; // its hooks go on without events
  }
}

/// Also from a cycle.
void RealScheduler::modeChanged() noexcept {
  for (const std::unique_ptr<Worker> &worker : workers_)
    if (!tasks_->takesModeSoon(worker->task))
      ::sem_post(&worker->raised);
}

void RealScheduler::takeModeOver(const Worker &worker) {
  gate_.enter(worker.task);
  tasks_->takeModeOver(worker.task, nowNs());
  gate_.leave(worker.task);
}

void RealScheduler::runPaced(Worker &worker, Pacer &pacer) {
  const int64_t limit = tasks_->paceLimitNs(worker.task);
  int64_t last = -1;
  while (const std::optional<Wake> wake = waitPaced(worker.task, pacer, last, limit)) {
    tasks_->addOverruns(worker.task, wake->missed);
    cycle(worker, wake->timeNs);
    last = std::max(wake->timeNs, last + 1);
  }
}

/// Nothing: the end has come. When the application stops, the hooks do not wait for a slow bus.
std::optional<Wake> RealScheduler::waitPaced(uint32_t task, Pacer &pacer, int64_t afterNs,
                                             int64_t limitNs) {
  Clock clock(originNs_);
  while (!ending()) {
    const bool stopped = tasks_->stopped();
    if (stopped && !tasks_->told(task))
      return Wake{nowNs()};
    const int64_t limit = stopped ? std::min(limitNs, TaskSet::kLongIntervalNs) : limitNs;
    const int64_t deadline = std::max<int64_t>(afterNs, 0) + limit;
    Wake wake = pacer.wait(afterNs, std::min(deadline, nowNs() + kLongestSleepNs), clock);
    if (ending() || (!wake.arrived && wake.timeNs < deadline))
      continue;
    if (const int64_t late = nowNs() - wake.timeNs; !wake.arrived && late >= limit) {
      wake.missed += static_cast<uint64_t>(late / limit);
      wake.timeNs += late / limit * limit;
    }
    return wake;
  }
  return std::nullopt;
}

/// In a cycle of the task that raises it.
void RealScheduler::raise(uint32_t task) noexcept {
  Worker &worker = *workers_[task];
  if (worker.pending.exchange(true))
    tasks_->addOverruns(task, 1);
  else
    ::sem_post(&worker.raised);
}

/// A task of a long interval is also woken when the application stops, if it has not before, and by
/// another mode.
RealScheduler::Woken RealScheduler::sleepUntil(uint32_t task, int64_t timeNs) const {
  const bool isLong = !tasks_->takesModeSoon(task);
  const bool wasStopped = tasks_->stopped();
  for (;;) {
    if (ending())
      return Woken::End;
    const int64_t now = nowNs();
    const bool stopped = tasks_->stopped();
    if (now >= timeNs || (isLong && !wasStopped && stopped))
      return Woken::Due;
    if (isLong && !stopped && tasks_->modeOf(task) != tasks_->mode())
      return Woken::TakeModeOver;
    const ::timespec until = toTimespec(originNs_ + std::min(timeNs, now + kLongestSleepNs));
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
  }
}

bool RealScheduler::finish(const std::function<void()> &meanwhile) {
  if (!started_)
    return true;
  started_ = false;
  tasks_->stop();
  for (const std::unique_ptr<Worker> &worker : workers_)
    ::sem_post(&worker->raised); // the hooks of tasks that wait for an event go on without it
  const int64_t limit = monotonicNs() + TaskSet::kStopLimitNs;
  while (!tasks_->atRest() && monotonicNs() < limit) {
    if (meanwhile)
      meanwhile();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const bool cameToRest = tasks_->atRest();
  end();
  return cameToRest;
}

void RealScheduler::end() {
  ending_.store(true, std::memory_order_release);
  go_.store(1);
  go_.notify_all();
  for (const std::unique_ptr<Worker> &worker : workers_)
    ::sem_post(&worker->raised);
  for (const std::unique_ptr<Worker> &worker : workers_)
    if (worker->thread)
      worker->thread->join();
}

int64_t RealScheduler::betweenCycles(const std::function<void()> &change) {
  struct Hold {
    explicit Hold(CycleGate &held) : gate(held) { gate.hold(); }
    ~Hold() { gate.release(); }
    CycleGate &gate;
  };
  const int64_t begin = monotonicNs();
  {
    const Hold hold(gate_);
    change();
  }
  return monotonicNs() - begin;
}

} // namespace stride::task
