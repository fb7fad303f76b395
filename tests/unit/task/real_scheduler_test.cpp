// The real clock. Nothing here depends on how fast the machine is.
#include "runtime/iec/ctx.h"
#include "runtime/task/real_scheduler.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace std::chrono_literals;
using stride::Ctx;
using stride::ExceptionCode;
using stride::StrideAppV1;
using stride::TaskDesc;
using stride::TaskKind;
using stride::task::CycleHook;
using stride::task::LoopLimit;
using stride::task::RealScheduler;
using stride::task::TaskSet;

constexpr int64_t kMs = 1000000;

/// What ctx.state points to.
struct Shared {
  std::atomic<int> fast{0};
  std::atomic<int> slow{0};
  std::atomic<int> events{0};
  std::atomic<int> status{0};
  std::atomic<bool> go{false};
  std::atomic<bool> open{false};
  std::atomic<int> inside{0};
  std::atomic<bool> overlap{false};
  std::atomic<bool> offGrid{false};
  std::atomic<bool> highData{false};
};

Shared &shared(Ctx *ctx) { return *static_cast<Shared *>(ctx->state); }

void fast(Ctx *ctx) {
  Shared &s = shared(ctx);
  if (ctx->dataTop == nullptr || reinterpret_cast<uintptr_t>(ctx->dataTop) >> 32 != 0)
    s.highData = true;
  if (s.inside.fetch_add(1) != 0)
    s.overlap = true;
  if (ctx->cycleStartNs % kMs != 0)
    s.offGrid = true;
  s.go = ++s.fast % 10 == 0;
  s.inside.fetch_sub(1);
}

void slow(Ctx *ctx) {
  Shared &s = shared(ctx);
  if (s.inside.fetch_add(1) != 0)
    s.overlap = true;
  ++s.slow;
  std::this_thread::sleep_for(2ms);
  s.inside.fetch_sub(1);
}

void event(Ctx *ctx) { ++shared(ctx).events; }
void status(Ctx *ctx) { ++shared(ctx).status; }
stride::BOOL goSet(Ctx *ctx) { return shared(ctx).go; }
stride::BOOL openSet(Ctx *ctx) { return shared(ctx).open; }

TaskDesc task(const char *name, TaskKind kind, uint32_t priority, int64_t ms, void (*run)(Ctx *),
              stride::BOOL (*raised)(Ctx *) = nullptr) {
  return {name, kind, priority, ms * kMs, 0, 0, stride::kNoIndex, run, raised};
}

StrideAppV1 appWith(const std::vector<TaskDesc> &tasks) {
  StrideAppV1 app{};
  app.tasks = tasks.data();
  app.taskCount = static_cast<uint32_t>(tasks.size());
  return app;
}

/// Tasks with their state.
struct Started {
  explicit Started(const std::vector<TaskDesc> &list)
      : app(appWith(list)), tasks(app, reinterpret_cast<std::byte *>(&state),
                                  stride::task::hostApi(), LoopLimit::Clock) {}

  StrideAppV1 app;
  Shared state;
  TaskSet tasks;
};
constexpr stride::task::RealOptions kInTurns = {.fifo = false, .turns = true, .core = {}};

template <class Condition> void waitUntil(Condition condition) {
  for (int i = 0; i < 20000 && !condition(); ++i)
    std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(condition());
}

TEST(RealSchedulerTest, AllKindsOfTasksInTurns) {
  const std::vector<TaskDesc> list = {task("Fast", TaskKind::Cyclic, 1, 1, fast),
                                      task("Slow", TaskKind::Cyclic, 9, 10, slow),
                                      task("Event", TaskKind::Event, 0, 0, event, goSet),
                                      task("Status", TaskKind::Status, 3, 2, status, openSet),
                                      task("Free", TaskKind::Freewheeling, 31, 10, slow)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  {
    RealScheduler scheduler(tasks, kInTurns);
    scheduler.start();
    waitUntil([&] { return state.fast > 60 && state.slow > 5 && state.events > 3; });
    EXPECT_EQ(state.status, 0);
    state.open = true;
    waitUntil([&] { return state.status > 3; });
    state.open = false;
    EXPECT_TRUE(scheduler.finish());
  }
  EXPECT_LE(state.events, state.fast / 10) << "it runs without its event";
  EXPECT_FALSE(state.overlap) << "in turns two tasks were in their cycles at once";
  EXPECT_FALSE(state.offGrid);
  EXPECT_FALSE(state.highData);
  EXPECT_FALSE(tasks.fault());
  EXPECT_GE(tasks.statistics(0).figures().cycles, 60U);
  EXPECT_GE(tasks.statistics(1).figures().maxRunNs, 2 * kMs);
  const int after = state.fast;
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(state.fast, after) << "it goes on behind its end";
}

TEST(RealSchedulerTest, CyclesThatTakeTooLongSkipOnesOnTheGrid) {
  const std::vector<TaskDesc> list = {task("Late", TaskKind::Cyclic, 1, 1, slow)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return state.slow > 10; });
  scheduler.finish();
  const auto figures = tasks.statistics(0).figures();
  EXPECT_GE(figures.overruns, figures.cycles) << "each cycle of 2 ms skips at least one of 1 ms";
}

/// SYNC at 0.5 ms, 1.5 ms, 2.5 ms …; from `silentFrom` on none comes.
class HalfSync final : public stride::task::Pacer {
public:
  explicit HalfSync(int64_t silentFromNs) : silentFrom_(silentFromNs) {}
  stride::task::Wake wait(int64_t afterNs, int64_t deadlineNs,
                          stride::task::TaskClock &clock) noexcept override {
    const int64_t next = (afterNs + kMs / 2) / kMs * kMs + kMs / 2;
    const bool comes = next < silentFrom_ && next <= deadlineNs;
    clock.sleepUntil(comes ? next : deadlineNs);
    late = late || clock.nowNs() < (comes ? next : deadlineNs) ||
           clock.monotonicNs(clock.nowNs()) > stride::task::monotonicNs();
    return {comes ? next : deadlineNs, comes};
  }
  std::atomic<bool> late{false};

private:
  int64_t silentFrom_;
};

/// When the cycles of a task were.
class StartsHook final : public CycleHook {
public:
  void beforePous(Ctx &ctx) override {
    const int at = count.load();
    if (at < static_cast<int>(starts.size()))
      starts[static_cast<size_t>(at)] = ctx.cycleStartNs;
    count.store(at + 1);
  }
  void afterPous(Ctx &) override {}
  std::vector<int64_t> starts = std::vector<int64_t>(1000);
  std::atomic<int> count{0};
};

stride::BOOL noEvent(Ctx *) { return 0; }

TEST(RealSchedulerTest, ThePacerSaysWhenATaskRuns) {
  const std::vector<TaskDesc> list = {task("Sync", TaskKind::Event, 1, 1, event, noEvent)};
  Started started(list);
  TaskSet &tasks = started.tasks;
  constexpr int64_t kSilent = 20 * kMs;
  HalfSync sync(kSilent);
  StartsHook hook;
  tasks.addHook(0, hook);
  tasks.setPacer(0, sync);
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return hook.count > 40; });
  EXPECT_TRUE(scheduler.finish());
  EXPECT_FALSE(sync.late);
  constexpr int kWith = 20; // 0.5 ms to 19.5 ms
  for (int i = 0; i < kWith; ++i)
    EXPECT_EQ(hook.starts[static_cast<size_t>(i)], i * kMs + kMs / 2) << i;
  // Without SYNC the task runs 1.5 ms after its last cycle; a slow machine leaves some out.
  const int64_t lastSync = 19 * kMs + kMs / 2;
  for (size_t i = kWith; i < 40; ++i) {
    EXPECT_EQ((hook.starts[i] - lastSync) % (kMs * 3 / 2), 0) << i;
    EXPECT_GT(hook.starts[i], hook.starts[i - 1]) << i;
  }
}

TEST(RealSchedulerTest, AStopDoesNotWaitForALongPace) {
  const std::vector<TaskDesc> list = {task("Sync", TaskKind::Event, 1, 3'600'000, event, noEvent)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  HalfSync sync(0);
  tasks.setPacer(0, sync);
  StartsHook hook;
  tasks.addHook(0, hook);
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  EXPECT_TRUE(scheduler.finish());
  EXPECT_EQ(state.events, 0) << "its POUs do not run, its hooks do";
  EXPECT_GE(hook.count, 1);
}

/// Raises a task in each cycle.
class RaisingHook final : public CycleHook {
public:
  RaisingHook(TaskSet &tasks, uint32_t task) : tasks_(&tasks), task_(task) {}
  void beforePous(Ctx &) override {
    tasks_->raise(task_);
    ++raised;
  }
  void afterPous(Ctx &) override {}
  std::atomic<uint64_t> raised{0};

private:
  TaskSet *tasks_;
  uint32_t task_;
};

TEST(RealSchedulerTest, RaisedTasksRunAndWhatIsTooMuchIsCounted) {
  const std::vector<TaskDesc> list = {task("Fast", TaskKind::Cyclic, 1, 1, fast),
                                      task("Raised", TaskKind::Event, 9, 0, slow, noEvent)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  RaisingHook hook(tasks, 1);
  tasks.addHook(0, hook);
  {
    RealScheduler scheduler(tasks, kInTurns);
    tasks.raise(1); // before the start: kept
    scheduler.start();
    waitUntil([&] { return state.slow > 5; });
    EXPECT_TRUE(scheduler.finish());
  }
  const auto figures = tasks.statistics(1).figures();
  // Cycles of 2 ms, raised every ms; the last raise may have come too late, and cycles after the
  // stop are nobody's.
  EXPECT_LE(static_cast<uint64_t>(state.slow.load()) + figures.overruns, hook.raised + 1);
  EXPECT_GE(static_cast<uint64_t>(state.slow.load()) + figures.overruns + 2, hook.raised / 2);
  tasks.raise(1); // nobody is there to do it
}

constexpr int64_t kInterval = 10 * kMs;

/// Cycles that take longer than one interval, or two.
struct Overrunning {
  TaskSet *tasks = nullptr;
  std::vector<int64_t> starts;
  std::vector<uint64_t> overruns; ///< Before the cycle.
};

void overrun(Ctx *ctx) {
  auto &s = *static_cast<Overrunning *>(ctx->state);
  s.overruns.push_back(s.tasks->statistics(0).figures().overruns);
  const bool twice = s.starts.size() % 2 == 1;
  s.starts.push_back(ctx->cycleStartNs);
  std::this_thread::sleep_for(twice ? 21ms : 12ms);
  if (s.starts.size() == 8)
    s.tasks->stop();
}

/// A place on the grid that has passed while the task was busy is skipped and counted, also when it
/// has passed by less than an interval: the cycle that follows starts on the first place that is
/// still to come.
TEST(RealSchedulerTest, ACycleNeverStartsForAPlaceOnTheGridThatHasPassed) {
  const std::vector<TaskDesc> list = {task("Late", TaskKind::Cyclic, 1, 10, overrun)};
  StrideAppV1 app = appWith(list);
  Overrunning state;
  TaskSet tasks(app, reinterpret_cast<std::byte *>(&state), stride::task::hostApi(),
                LoopLimit::Clock);
  state.tasks = &tasks;
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return tasks.stopped(); });
  scheduler.finish();
  ASSERT_EQ(state.starts.size(), 8U);
  for (size_t i = 0; i < state.starts.size(); ++i) {
    SCOPED_TRACE(i);
    // A slow machine skips more of them, but counts each.
    EXPECT_EQ(state.starts[i], kInterval * static_cast<int64_t>(i + state.overruns[i]));
    if (i == 0)
      continue;
    const int64_t least = i % 2 == 1 ? 2 : 3; // after 12 ms and after 21 ms
    EXPECT_GE(state.starts[i] - state.starts[i - 1], least * kInterval);
  }
}

TEST(RealSchedulerTest, BetweenCyclesNoTaskIsInside) {
  const std::vector<TaskDesc> list = {task("Fast", TaskKind::Cyclic, 1, 1, fast),
                                      task("Slow", TaskKind::Cyclic, 9, 3, slow)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  RealScheduler scheduler(tasks, {.fifo = false, .turns = false, .core = {}});
  scheduler.start();
  for (int i = 0; i < 50; ++i) {
    bool none = false;
    EXPECT_GE(scheduler.betweenCycles([&] { none = state.inside == 0; }), 0);
    EXPECT_TRUE(none);
    std::this_thread::sleep_for(500us);
  }
}

class BrakingHook final : public CycleHook {
public:
  void beforePous(Ctx &) override {}
  void afterPous(Ctx &) override {
    if (stopped)
      --cycles;
  }
  void applicationStopped() override {
    stopped = true;
    stoppedBy = std::this_thread::get_id();
  }
  bool atRest() const override { return cycles <= 0; }
  bool stopped = false;
  int cycles = 5;
  std::thread::id stoppedBy;
};

void failing(Ctx *ctx) {
  if (++shared(ctx).events == 3)
    stride::raise(*ctx, ExceptionCode::DivisionByZero, "a.st", 3, 7);
}

TEST(RealSchedulerTest, AFaultStopsThePousAndTheHooksGoOnUntilRest) {
  const std::vector<TaskDesc> list = {task("Main", TaskKind::Cyclic, 1, 1, failing),
                                      task("Fast", TaskKind::Cyclic, 2, 1, fast),
                                      task("Event", TaskKind::Event, 2, 0, event, openSet)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  BrakingHook mine;
  BrakingHook others;
  BrakingHook ofTheEvent;
  tasks.addHook(0, mine);
  tasks.addHook(1, others);
  tasks.addHook(2, ofTheEvent);
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return tasks.fault().has_value(); });
  EXPECT_TRUE(scheduler.finish());
  EXPECT_EQ(stride::task::describe(*tasks.fault()).substr(0, 38),
            "division by zero at a.st:3:7 (task Mai");
  EXPECT_EQ(state.events, 3);
  for (const BrakingHook *hook : {&mine, &others, &ofTheEvent}) {
    EXPECT_TRUE(hook->stopped);
    EXPECT_LE(hook->cycles, 0);
    EXPECT_NE(hook->stoppedBy, std::this_thread::get_id()) << "each is told in its own task";
  }
}

stride::BOOL loopingEvent(Ctx *ctx) {
  for (int i = 0; i < 100000; ++i)
    stride::loopTick(*ctx, "e.st", 4, 2);
  return shared(ctx).go;
}

TEST(RealSchedulerTest, AnEventMayContainLoopsAndAStopDoesNotWaitForALongInterval) {
  const std::vector<TaskDesc> list = {task("Fast", TaskKind::Cyclic, 1, 2, fast),
                                      task("Event", TaskKind::Event, 0, 0, event, loopingEvent),
                                      task("Hourly", TaskKind::Cyclic, 9, 3600000, slow)};
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  BrakingHook hourly;
  hourly.cycles = 2;
  tasks.addHook(2, hourly);
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return state.events > 2; });
  EXPECT_EQ(state.slow, 1) << "the next one comes in an hour";
  int meanwhile = 0;
  EXPECT_TRUE(scheduler.finish([&] { ++meanwhile; }));
  EXPECT_GT(meanwhile, 0);
  EXPECT_LE(hourly.cycles, 0);
  EXPECT_FALSE(tasks.fault());
}

void endless(Ctx *ctx) {
  for (;;)
    stride::loopTick(*ctx, "a.st", 9, 1);
}

TEST(RealSchedulerTest, TheWatchdogEndsAnEndlessLoop) {
  std::vector<TaskDesc> list = {task("Main", TaskKind::Cyclic, 1, 10, endless)};
  list[0].watchdogNs = 20 * kMs;
  Started started(list);
  TaskSet &tasks = started.tasks;
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return tasks.fault().has_value(); });
  EXPECT_EQ(tasks.fault()->exception.code(), ExceptionCode::Watchdog);
  EXPECT_EQ(tasks.fault()->exception.line(), 9U);
}

TEST(RealSchedulerTest, TheWatchdogCountsViolationsInARow) {
  std::vector<TaskDesc> list = {task("Main", TaskKind::Cyclic, 1, 5, slow)};
  list[0].watchdogNs = kMs * 3 / 2; // the cycle sleeps 2 ms
  list[0].watchdogSensitivity = 4;
  Started started(list);
  Shared &state = started.state;
  TaskSet &tasks = started.tasks;
  RealScheduler scheduler(tasks, kInTurns);
  scheduler.start();
  waitUntil([&] { return tasks.fault().has_value(); });
  scheduler.finish();
  EXPECT_EQ(tasks.fault()->exception.code(), ExceptionCode::Watchdog);
  EXPECT_THAT(stride::task::describe(*tasks.fault()),
              ::testing::HasSubstr("cycle longer than the watchdog allows: "));
  EXPECT_LE(state.slow, 4) << "four in a row, or one that was four times as long";
}

} // namespace
