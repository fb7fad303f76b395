#include "runtime/task/task_set.hpp"

#include "runtime/app/error.hpp"
#include "runtime/task/fatal.hpp"

#include <fmt/format.h>

#include <ctime>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

namespace stride::task {

namespace {

/// Loop iterations between two looks at the clock.
constexpr int64_t kLoopsPerLook = 20'000;
/// Loop iterations that one evaluation of an event may use.
constexpr int64_t kLoopsOfAnEvent = 1'000'000;
/// Ctx::cycle of an evaluation of an event.
constexpr uint64_t kNoCycle = std::numeric_limits<uint64_t>::max();

/// 0 counts as 1.
int64_t sensitivity(const TaskDesc &desc) { return std::max<int64_t>(desc.watchdogSensitivity, 1); }

void checkTask(const TaskDesc &desc) {
  const bool onEvent = desc.kind == TaskKind::Event || desc.kind == TaskKind::Status;
  if (onEvent && desc.event == nullptr)
    throw app::Error(fmt::format("task '{}' has no event that starts it", desc.name));
  if (desc.kind != TaskKind::Event && desc.intervalNs <= 0)
    throw app::Error(fmt::format("task '{}' has no interval", desc.name));
}

/// A status task rests while its event is FALSE: it comes last, whatever its interval.
uint32_t fastestOf(const StrideAppV1 &app) {
  const auto rank = [](const TaskDesc &desc) {
    if (desc.kind == TaskKind::Cyclic || desc.kind == TaskKind::Freewheeling)
      return 0;
    return desc.kind == TaskKind::Event && desc.intervalNs > 0 ? 1 : 2;
  };
  uint32_t best = 0;
  for (uint32_t i = 1; i < app.taskCount; ++i) {
    const TaskDesc &a = app.tasks[i];
    const TaskDesc &b = app.tasks[best];
    if (std::pair(rank(a), a.intervalNs) < std::pair(rank(b), b.intervalNs))
      best = i;
  }
  return best;
}

} // namespace

int64_t monotonicNs() noexcept {
  ::timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

TaskSet::TaskSet(const StrideAppV1 &app, std::byte *state, const HostApi &host, LoopLimit limit)
    : app_(&app), host_(host), limit_(limit) {
  if (app.taskCount == 0)
    throw app::Error("the application has no task; add one to stride.toml or a CONFIGURATION");
  host_.self = this;
  host_.refillLoopBudget = refill;
  if (host_.log == hostApi().log)
    host_.log = log;
  for (uint32_t i = 0; i < app.taskCount; ++i) {
    const TaskDesc &desc = app.tasks[i];
    checkTask(desc);
    hasEvents_ = hasEvents_ || desc.event != nullptr;
    auto task = std::make_unique<Task>();
    task->ctx.state = state;
    task->ctx.taskIntervalNs = desc.intervalNs;
    task->ctx.taskIndex = i;
    task->ctx.host = &host_;
    task->ctx.firstCycle = 1;
    task->comesAround = desc.kind == TaskKind::Cyclic || desc.kind == TaskKind::Freewheeling;
    task->isShort = desc.intervalNs <= kLongIntervalNs;
    tasks_.push_back(std::move(task));
    order_.push_back(i);
  }
  fastest_ = fastestOf(app);
  std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
    return app.tasks[a].priority < app.tasks[b].priority;
  });
}

TaskSet::~TaskSet() = default;

void TaskSet::addHook(uint32_t task, CycleHook &hook) { tasks_[task]->hooks.push_back(&hook); }

/// A loop that the watchdog has ended need not be endless.
StException TaskSet::watchdogIn(const StException &loop, const Task &task,
                                const TaskDesc &desc) noexcept {
  char detail[160];
  const auto end = fmt::format_to_n(
      detail, sizeof detail - 1, "{} us in this loop, allowed are {} us",
      (monotonicNs() - task.startedNs + 999) / 1000, desc.watchdogNs * sensitivity(desc) / 1000);
  *end.out = 0;
  StException watchdog(ExceptionCode::Watchdog, loop.file(), loop.line(), loop.column(), detail);
  watchdog.setCalls(loop.calls().data(), loop.calls().size());
  return watchdog;
}

void TaskSet::runCycle(uint32_t index, int64_t startNs, int64_t latencyNs) noexcept {
  cycle(index, startNs, latencyNs, false);
}

void TaskSet::takeModeOver(uint32_t index, int64_t startNs) noexcept {
  cycle(index, startNs, 0, true);
}

void TaskSet::cycle(uint32_t index, int64_t startNs, int64_t latencyNs, bool hooksAlone) noexcept {
  Task &task = *tasks_[index];
  Ctx &ctx = task.ctx;
  noteCycle(app_->tasks[index].name, ctx.cycle);
  task.startedNs = monotonicNs();
  ctx.cycleStartNs = startNs;
  task.looks = 0;
  ctx.loopBudget = limit_ == LoopLimit::Clock || repeated_ ? kLoopsPerLook : loopBudget_;
  // Asked once: hooks see in told() what the cycle does.
  if (stopped())
    tellHooks(task);
  takeMode(task);
  task.takesOver = hooksAlone;
  const bool inRun = task.mode.load(std::memory_order_relaxed) == OperatingMode::Run;
  const bool runs = !task.told && !hooksAlone;
  for (CycleHook *hook : task.hooks)
    hook->beforePous(ctx);
  if (const TaskDesc &desc = app_->tasks[index]; runs)
    runPous(index, inRun ? desc.run : desc.runInStop, startNs);
  for (auto hook = task.hooks.rbegin(); hook != task.hooks.rend(); ++hook)
    (*hook)->afterPous(ctx);
  if (task.told)
    task.rest.store(std::all_of(task.hooks.begin(), task.hooks.end(),
                                [](const CycleHook *hook) { return hook->atRest(); }),
                    std::memory_order_release);
  const int64_t run = monotonicNs() - task.startedNs;
  task.statistics.add({startNs, startNs + latencyNs, run});
  if (limit_ == LoopLimit::Clock)
    watch(index, run);
  noteCycle(nullptr, 0);
  if (runs && inRun)
    ctx.firstCycle = 0;
  ++ctx.cycle;
}

/// `run`: null for none.
void TaskSet::runPous(uint32_t index, void (*run)(Ctx *), int64_t startNs) noexcept {
  Task &task = *tasks_[index];
  if (run == nullptr)
    return;
  const std::optional<StException> exception = guardedCall(run, task.ctx);
  if (!exception)
    return;
  const TaskDesc &desc = app_->tasks[index];
  const bool endless = exception->code() == ExceptionCode::EndlessLoop;
  const bool late = limit_ == LoopLimit::Clock && desc.watchdogNs > 0 && endless;
  const bool again = repeats(index, startNs) && endless;
  fail(again  ? repeated_->exception
       : late ? watchdogIn(*exception, task, desc)
              : *exception,
       index, task.ctx.cycle, startNs);
  tellHooks(task);
}

void TaskSet::setMode(OperatingMode mode) noexcept {
  if (mode_.exchange(mode, std::memory_order_acq_rel) != mode && raiser_ != nullptr)
    raiser_->modeChanged();
}

bool TaskSet::modeTaken() const noexcept {
  return std::all_of(tasks_.begin(), tasks_.end(), [this](const auto &task) {
    return task->mode.load(std::memory_order_acquire) == mode();
  });
}

/// An application that has ended has no mode any more.
void TaskSet::takeMode(Task &task) noexcept {
  const OperatingMode asked = mode();
  if (task.told || task.mode.load(std::memory_order_relaxed) == asked)
    return;
  for (CycleHook *hook : task.hooks)
    hook->modeChanged(asked);
  task.mode.store(asked, std::memory_order_release);
}

void TaskSet::addOverruns(uint32_t task, uint64_t count) noexcept {
  tasks_[task]->statistics.addOverruns(count);
}

/// A cycle beyond the watchdog's time counts; so many in a row as the sensitivity says, or one that
/// lasts so many times as long, stop the application.
void TaskSet::watch(uint32_t index, int64_t runNs) noexcept {
  Task &task = *tasks_[index];
  const TaskDesc &desc = app_->tasks[index];
  if (desc.watchdogNs <= 0 || runNs <= desc.watchdogNs) {
    task.violations = 0;
    return;
  }
  task.statistics.addWatchdogViolation();
  ++task.violations;
  if (stopped() ||
      (task.violations < sensitivity(desc) && runNs / sensitivity(desc) <= desc.watchdogNs))
    return;
  char detail[160];
  const auto end = fmt::format_to_n(detail, sizeof detail - 1, "{} us, allowed are {} us",
                                    (runNs + 999) / 1000, desc.watchdogNs / 1000);
  *end.out = 0;
  fail(StException(ExceptionCode::Watchdog, nullptr, 0, 0, detail), index, task.ctx.cycle,
       task.ctx.cycleStartNs);
}

void TaskSet::log(Ctx *ctx, uint32_t, const char *text) {
  static_cast<TaskSet *>(ctx->host->self)->log_.put(text);
}

int64_t TaskSet::refill(Ctx *ctx) {
  const auto *self = static_cast<const TaskSet *>(ctx->host->self);
  if ((self->limit_ == LoopLimit::Budget && !self->repeated_) || ctx->cycle == kNoCycle)
    return 0;
  Task &task = *self->tasks_[ctx->taskIndex];
  bool ends = false;
  if (self->repeats(ctx->taskIndex, ctx->cycleStartNs)) {
    ends = task.looks == self->repeated_->looks;
  } else if (self->repeated_) {
    ends = task.looks > kDefaultLoopBudget / kLoopsPerLook;
  } else {
    const TaskDesc &desc = self->app_->tasks[ctx->taskIndex];
    const int64_t allowed =
        desc.watchdogNs > 0 ? desc.watchdogNs * sensitivity(desc) : kDefaultCycleLimitNs;
    ends = monotonicNs() - task.startedNs > allowed;
  }
  if (ends)
    return 0;
  ++task.looks;
  return kLoopsPerLook;
}

bool TaskSet::repeats(uint32_t task, int64_t startNs) const noexcept {
  return repeated_ && repeated_->timeNs == startNs && repeated_->task == app_->tasks[task].name;
}

bool TaskSet::eventLevel(uint32_t index, int64_t nowNs) noexcept {
  struct Question {
    Ctx ctx;
    BOOL (*event)(Ctx *);
    BOOL answer;
  };
  static_assert(std::is_standard_layout_v<Question>);
  const TaskDesc &desc = app_->tasks[index];
  Question question{};
  question.ctx.state = tasks_[index]->ctx.state;
  question.ctx.host = &host_;
  question.ctx.taskIndex = index;
  question.ctx.cycle = kNoCycle;
  question.ctx.loopBudget = kLoopsOfAnEvent;
  question.event = desc.event;
  const auto ask = [](Ctx *ctx) {
    auto *asked = reinterpret_cast<Question *>(ctx);
    asked->answer = asked->event(ctx);
  };
  if (const std::optional<StException> exception = guardedCall(ask, question.ctx)) {
    // The cycle that it would have started.
    fail(*exception, index, tasks_[index]->statistics.figures().cycles, nowNs);
    return false;
  }
  return question.answer != 0;
}

void TaskSet::fail(const StException &exception, uint32_t task, uint64_t cycle,
                   int64_t timeNs) noexcept {
  Fault fault{exception, {}, cycle, timeNs, tasks_[task]->looks};
  try {
    fault.task = app_->tasks[task].name;
  } catch (const std::bad_alloc &) { // without it then
  }
  fail(std::move(fault));
}

void TaskSet::fail(Fault fault) noexcept {
  const std::lock_guard lock(faultMutex_);
  if (!fault_)
    fault_ = std::move(fault);
  stop();
}

void TaskSet::tellHooks(Task &task) noexcept {
  if (task.told)
    return;
  task.told = true;
  for (CycleHook *hook : task.hooks)
    hook->applicationStopped();
}

bool TaskSet::atRest() const noexcept {
  return std::all_of(tasks_.begin(), tasks_.end(), [](const auto &task) {
    return task->hooks.empty() || task->rest.load(std::memory_order_acquire);
  });
}

std::optional<Fault> TaskSet::fault() const {
  const std::lock_guard lock(faultMutex_);
  return fault_;
}

bool TaskSet::failed() const noexcept {
  const std::lock_guard lock(faultMutex_);
  return fault_.has_value();
}

void TaskSet::prepareRebind(const StrideAppV1 &app) {
  for (const std::unique_ptr<Task> &task : tasks_)
    for (CycleHook *hook : task->hooks)
      hook->prepareRebind(app);
}

void TaskSet::rebind(const StrideAppV1 &app, std::byte *state) noexcept {
  app_ = &app;
  for (const std::unique_ptr<Task> &task : tasks_) {
    task->ctx.state = state;
    for (CycleHook *hook : task->hooks)
      hook->rebind(app, state);
  }
}

} // namespace stride::task
