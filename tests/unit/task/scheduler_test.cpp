#include "runtime/task/virtual_scheduler.hpp"
#include "tests/unit/app/fixture.hpp"
#include "tests/unit/task/logged_tasks.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace stride::test;
using stride::Ctx;
using stride::ExceptionCode;
using stride::StrideAppV1;
using stride::TaskDesc;
using stride::TaskKind;
using stride::task::CycleHook;
using stride::task::LoopLimit;
using stride::task::RunResult;
using stride::task::TaskSet;
using stride::task::VirtualScheduler;
using ::testing::ElementsAre;

TEST(VirtualSchedulerTest, OrderIsTimePriorityDeclaration) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 5, 20, note<'a'>), cyclic("B", 1, 10, note<'b'>),
                                       cyclic("C", 5, 10, note<'c'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  EXPECT_EQ(run.tasks.fastest(), 1U);
  const RunResult result = run.scheduler.runUntil(30 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("b0!", "a0!", "c0!", "b10", "c10", "b20", "a20", "c20"));
  EXPECT_EQ(result.timeNs, 30 * kMs);
  EXPECT_EQ(run.tasks.statistics(0).figures().cycles, 2U);
  EXPECT_EQ(run.tasks.statistics(1).figures().cycles, 3U);
}

TEST(VirtualSchedulerTest, EndIsExclusiveAndContinues) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.scheduler.runUntil(100 * kMs);
  EXPECT_EQ(log.lines.size(), 10U);
  EXPECT_EQ(log.lines.back(), "a90");
  run.scheduler.runUntil(101 * kMs);
  EXPECT_EQ(log.lines.back(), "a100");
}

TEST(VirtualSchedulerTest, RefusesWhatItCannotRun) {
  Log log;
  const std::vector<TaskDesc> none;
  const StrideAppV1 empty = appWith(none);
  EXPECT_THROW(Scheduled(empty, log), stride::app::Error);
  std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  tasks[0].kind = TaskKind::Event;
  const StrideAppV1 event = appWith(tasks);
  EXPECT_THROW(Scheduled(event, log), stride::app::Error);
}

/// SYNCs at given times; what is missed is reported with the next one.
class ListedSync final : public stride::task::Pacer {
public:
  explicit ListedSync(std::vector<int64_t> timesMs, uint64_t missed = 0)
      : times_(std::move(timesMs)), missed_(missed) {}
  stride::task::Wake wait(int64_t afterNs, int64_t deadlineNs,
                          stride::task::TaskClock &clock) noexcept override {
    asked.push_back(afterNs < 0 ? -1 : afterNs / kMs);
    EXPECT_EQ(clock.nowNs(), std::max<int64_t>(afterNs, 0));
    for (const int64_t time : times_)
      if (time * kMs > afterNs && time * kMs <= deadlineNs) {
        clock.sleepUntil(time * kMs);
        return {clock.nowNs(), true, std::exchange(missed_, 0)};
      }
    return {deadlineNs};
  }
  std::vector<int64_t> asked;

private:
  std::vector<int64_t> times_;
  uint64_t missed_;
};

stride::BOOL never(Ctx *) { return 0; }

TaskDesc onSync(const char *name, uint32_t priority, int64_t ms, void (*run)(Ctx *)) {
  return {name, TaskKind::Event, priority, ms * kMs, 0, 0, stride::kNoIndex, run, never};
}

TEST(VirtualSchedulerTest, TheBusSaysWhenAPacedTaskRuns) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 1, 10, note<'a'>), onSync("S", 5, 4, note<'s'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  // 9 comes late, in time; 16 is more than 6 ms after it: the task runs without its SYNC at 15.
  ListedSync sync({3, 4, 9, 16, 20}, 2);
  run.tasks.setPacer(1, sync);
  run.scheduler.runUntil(12 * kMs);
  run.scheduler.runUntil(21 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "s3!", "s4", "s9", "a10", "s15", "s16", "a20", "s20"));
  EXPECT_THAT(sync.asked, ElementsAre(-1, 3, 4, 9, 15, 16, 20));
  EXPECT_EQ(run.tasks.statistics(1).figures().overruns, 2U);
  EXPECT_EQ(run.tasks.statistics(0).figures().overruns, 0U);
}

TEST(VirtualSchedulerTest, ABusWithoutTimeDoesNotStandStill) {
  struct Stuck final : stride::task::Pacer {
    stride::task::Wake wait(int64_t, int64_t, stride::task::TaskClock &) noexcept override {
      return {0, true};
    }
  } sync;
  const std::vector<TaskDesc> tasks = {onSync("S", 5, 4, note<'s'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.tasks.setPacer(0, sync);
  EXPECT_EQ(run.scheduler.runUntil(3).timeNs, 3);
  EXPECT_EQ(log.lines.size(), 3U);
}

/// Raises a task in its cycles.
class RaisingHook final : public CycleHook {
public:
  RaisingHook(TaskSet &tasks, uint32_t task, int times)
      : tasks_(&tasks), task_(task), times_(times) {}
  void beforePous(Ctx &) override {
    for (int i = 0; i < times_; ++i)
      tasks_->raise(task_);
  }
  void afterPous(Ctx &) override {}

private:
  TaskSet *tasks_;
  uint32_t task_;
  int times_;
};

TEST(VirtualSchedulerTest, ARaisedTaskRunsOnceAtTheSameInstant) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 3, 10, note<'a'>), onSync("R", 1, 0, note<'r'>),
                                       cyclic("B", 5, 10, note<'b'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  RaisingHook raises(run.tasks, 1, 1);
  run.tasks.addHook(0, raises);
  run.scheduler.runUntil(20 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "r0!", "b0!", "a10", "r10", "b10"));
  EXPECT_EQ(run.tasks.statistics(1).figures().overruns, 0U);
}

TEST(VirtualSchedulerTest, RaisesBesideOneThatWaitsAreOverruns) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 3, 10, note<'a'>), onSync("R", 1, 0, note<'r'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  RaisingHook raises(run.tasks, 1, 3);
  run.tasks.addHook(0, raises);
  run.scheduler.runUntil(20 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "r0!", "a10", "r10"));
  EXPECT_EQ(run.tasks.statistics(1).figures().overruns, 4U);
}

TEST(VirtualSchedulerTest, ATaskThatHasRunAtThisInstantIsRaisedALittleLater) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 3, 10, note<'a'>), onSync("R", 1, 0, note<'r'>),
                                       cyclic("B", 5, 10, note<'b'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  RaisingHook first(run.tasks, 1, 1);
  RaisingHook second(run.tasks, 1, 1);
  run.tasks.addHook(0, first);
  run.tasks.addHook(2, second);
  run.scheduler.runUntil(5 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "r0!", "b0!", "r0"));
  EXPECT_EQ(run.tasks.statistics(1).figures().maxIntervalNs, VirtualScheduler::kAgainNs);
  run.tasks.stop();
  run.tasks.raise(1); // nothing runs any more
  run.scheduler.runUntil(9 * kMs);
  EXPECT_EQ(log.lines.size(), 4U);
}

class NotingHook final : public CycleHook {
public:
  NotingHook(std::string name, Log &log, int cyclesToRest = 0)
      : name_(std::move(name)), log_(&log), cyclesToRest_(cyclesToRest) {}
  void beforePous(Ctx &) override { log_->lines.push_back("<" + name_); }
  void afterPous(Ctx &) override {
    log_->lines.push_back(name_ + ">");
    if (stopped_)
      --cyclesToRest_;
  }
  void applicationStopped() override { stopped_ = true; }
  bool atRest() const override { return cyclesToRest_ <= 0; }

private:
  std::string name_;
  Log *log_;
  int cyclesToRest_;
  bool stopped_ = false;
};

TEST(VirtualSchedulerTest, HooksEncloseThePous) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>),
                                       cyclic("B", 1, 10, note<'b'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  NotingHook x("x", log);
  NotingHook y("y", log);
  run.tasks.addHook(1, x);
  run.tasks.addHook(1, y);
  run.scheduler.runUntil(10 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "<x", "<y", "b0!", "y>", "x>"));
}

class Times final : public stride::task::InstantObserver {
public:
  void beforeInstant(int64_t timeNs) override {
    lines.push_back("-" + std::to_string(timeNs / kMs));
  }
  void afterInstant(int64_t timeNs, bool fastest) override {
    lines.push_back("+" + std::to_string(timeNs / kMs) + (fastest ? "f" : ""));
  }
  std::vector<std::string> lines;
};

TEST(VirtualSchedulerTest, ObserverSeesEachInstantOnce) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 15, note<'a'>),
                                       cyclic("B", 1, 10, note<'b'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  Times times;
  run.scheduler.setObserver(&times);
  run.scheduler.runUntil(20 * kMs);
  EXPECT_THAT(times.lines, ElementsAre("-0", "+0f", "-10", "+10f", "-15", "+15"));
}

void failAt20(Ctx *ctx) {
  note<'f'>(ctx);
  if (ctx->cycleStartNs == 20 * kMs)
    stride::raise(*ctx, ExceptionCode::DivisionByZero, "a.st", 3, 7);
}

TEST(VirtualSchedulerTest, AnExceptionStopsThePousAndTheHooksGoOnUntilRest) {
  const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, failAt20),
                                       cyclic("Other", 1, 10, note<'o'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  NotingHook hook("x", log, 2);
  run.tasks.addHook(0, hook);
  const RunResult result = run.scheduler.runUntil(1000 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_EQ(stride::task::describe(*result.fault),
            "division by zero at a.st:3:7 (task Main, cycle 2, at T#20ms); stride explain SR0001");
  EXPECT_EQ(result.timeNs, 40 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("<x", "f0!", "x>", "o0!", "<x", "f10", "x>", "o10", "<x",
                                     "f20", "x>", "<x", "x>"));
}

void endless(Ctx *ctx) {
  for (;;)
    stride::loopTick(*ctx, "a.st", 9, 1);
}

TEST(VirtualSchedulerTest, EndlessLoopsEnd) {
  const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, endless)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.tasks.setLoopBudget(1000);
  const RunResult result = run.scheduler.runUntil(100 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_EQ(result.fault->exception.code(), ExceptionCode::EndlessLoop);
}

TEST(VirtualSchedulerTest, AStopRequestEndsTheRun) {
  const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.scheduler.setStopRequest([&log] { return log.lines.size() == 3; });
  const RunResult result = run.scheduler.runUntil(1000 * kMs);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(log.lines.size(), 3U);
}

#if !defined(__SANITIZE_ADDRESS__) // ASan has handlers of its own
void wildPointer(Ctx *) {
  volatile auto *place = reinterpret_cast<volatile int *>(uintptr_t{0x10});
  *place = 1;
}

__attribute__((noinline)) int recurse(volatile int *depth) {
  volatile char frame[1024];
  frame[0] = static_cast<char>(*depth);
  *depth = *depth + 1;
  return *depth < 0 ? 0 : recurse(depth) + frame[0];
}

void deepRecursion(Ctx *) {
  volatile int depth = 0;
  recurse(&depth);
}

TEST(VirtualSchedulerTest, BadMemoryAccessesAreExceptions) {
  using Case = std::pair<void (*)(Ctx *), ExceptionCode>;
  for (const auto &[body, code] : {Case{wildPointer, ExceptionCode::AccessViolation},
                                   Case{deepRecursion, ExceptionCode::StackOverflow},
                                   Case{wildPointer, ExceptionCode::AccessViolation}}) {
    const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, body)};
    const StrideAppV1 app = appWith(tasks);
    Log log;
    Scheduled run(app, log);
    const stride::task::MemoryGuard guard;
    const RunResult result = run.scheduler.runUntil(100 * kMs);
    ASSERT_TRUE(result.fault);
    EXPECT_EQ(result.fault->exception.code(), code);
  }
}
#endif

// The events of these tests are parts of the log's state.
stride::BOOL goSet(Ctx *ctx) { return logOf(ctx).go; }
stride::BOOL openSet(Ctx *ctx) { return logOf(ctx).open; }

TaskDesc onEvent(const char *name, uint32_t priority, TaskKind kind, int64_t ms, void (*run)(Ctx *),
                 stride::BOOL (*event)(Ctx *)) {
  return {name, kind, priority, ms * kMs, 0, 0, stride::kNoIndex, run, event};
}

void raiseAt10And30(Ctx *ctx) {
  note<'a'>(ctx);
  logOf(ctx).go = ctx->cycleStartNs == 10 * kMs || ctx->cycleStartNs == 30 * kMs;
}

TEST(VirtualSchedulerTest, AnEventTaskRunsAtOnceByItsPriority) {
  // An edge inside a cycle of A: E runs at the same instant, before B (lower priority), and only
  // once although the event stays TRUE for a while.
  const std::vector<TaskDesc> tasks = {cyclic("A", 1, 10, raiseAt10And30),
                                       cyclic("B", 5, 10, note<'b'>),
                                       onEvent("E", 0, TaskKind::Event, 0, note<'e'>, goSet)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  EXPECT_EQ(run.tasks.fastest(), 0U);
  run.scheduler.runUntil(40 * kMs);
  EXPECT_THAT(log.lines,
              ElementsAre("a0!", "b0!", "a10", "e10!", "b10", "a20", "b20", "a30", "e30", "b30"));
}

TEST(VirtualSchedulerTest, AnEventThatIsTrueFromTheBeginningIsAnEdge) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 1, 10, note<'a'>),
                                       onEvent("E", 3, TaskKind::Event, 0, note<'e'>, goSet)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  log.go = true;
  Scheduled run(app, log);
  run.scheduler.runUntil(30 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "e0!", "a10", "a20"));
}

void openFrom10To30(Ctx *ctx) {
  note<'a'>(ctx);
  logOf(ctx).open = ctx->cycleStartNs >= 10 * kMs && ctx->cycleStartNs < 30 * kMs;
}

TEST(VirtualSchedulerTest, AStatusTaskRunsWhileItsEventIsTrue) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 1, 10, openFrom10To30),
                                       onEvent("S", 5, TaskKind::Status, 5, note<'s'>, openSet)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.scheduler.runUntil(50 * kMs);
  EXPECT_THAT(log.lines,
              ElementsAre("a0!", "a10", "s10!", "s15", "a20", "s20", "s25", "a30", "a40"));
}

void pingPong(Ctx *ctx) {
  logOf(ctx).lines.push_back(std::string(1, ctx->taskIndex == 1 ? 'g' : 'o') +
                             std::to_string(ctx->cycleStartNs / 1000 % 10000));
  logOf(ctx).go = ctx->taskIndex == 2;
  logOf(ctx).open = ctx->taskIndex == 1;
}

TEST(VirtualSchedulerTest, TasksThatRaiseEachOtherLeaveTimeGoing) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 1, 10, note<'a'>),
                                       onEvent("G", 5, TaskKind::Event, 0, pingPong, goSet),
                                       onEvent("O", 5, TaskKind::Event, 0, pingPong, openSet)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  log.go = true;
  Scheduled run(app, log);
  run.scheduler.runUntil(2100);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "g0", "o0", "g1", "o1", "g2", "o2"));
}

TEST(VirtualSchedulerTest, IntervalBesideSingleCountsWhileItIsFalse) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 1, 10, raiseAt10And30),
                                       onEvent("E", 2, TaskKind::Event, 4, note<'e'>, goSet)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.scheduler.runUntil(32 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "e0!", "e4", "e8", "a10", "e10", "a20", "e24", "e28",
                                     "a30", "e30"));
}

stride::BOOL loopingEvent(Ctx *ctx) {
  for (int i = 0; i < 1000; ++i)
    stride::loopTick(*ctx, "e.st", 4, 2);
  return logOf(ctx).go;
}

TEST(VirtualSchedulerTest, AnEventMayContainLoops) {
  const std::vector<TaskDesc> tasks = {
      cyclic("A", 1, 10, raiseAt10And30),
      onEvent("E", 0, TaskKind::Event, 0, note<'e'>, loopingEvent)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  EXPECT_FALSE(run.scheduler.runUntil(20 * kMs).fault);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "a10", "e10!"));
}

TEST(VirtualSchedulerTest, AStopDoesNotWaitForALongInterval) {
  const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, failAt20),
                                       cyclic("Hourly", 1, 3600000, note<'h'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  NotingHook hook("x", log, 2);
  run.tasks.addHook(1, hook);
  const RunResult result = run.scheduler.runUntil(7200000 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_TRUE(hook.atRest());
  EXPECT_LT(result.timeNs, 2000 * kMs);
}

void zeroEvent(Ctx *) {}
stride::BOOL failingEvent(Ctx *ctx) {
  stride::raise(*ctx, ExceptionCode::DivisionByZero, "e.st", 4, 2);
}

TEST(VirtualSchedulerTest, AnEventThatFailsStopsTheApplication) {
  const std::vector<TaskDesc> tasks = {
      cyclic("A", 1, 10, zeroEvent), onEvent("E", 2, TaskKind::Event, 0, note<'e'>, failingEvent)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  const RunResult result = run.scheduler.runUntil(100 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_EQ(result.fault->task, "E");
  EXPECT_THAT(log.lines, ElementsAre());
}

void sleepFor2Ms(Ctx *) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

/// What the message says is never less than the time that the cycle took.
TEST(TaskSetTest, TheWatchdogSaysHowLongTheCycleTookRoundedUp) {
  std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, sleepFor2Ms)};
  tasks[0].watchdogNs = 1'500'000;
  const StrideAppV1 app = appWith(tasks);
  Log log;
  TaskSet set(app, reinterpret_cast<std::byte *>(&log), stride::task::hostApi(), LoopLimit::Clock);
  set.runCycle(0, 0, 0);
  ASSERT_TRUE(set.fault());
  const int64_t ran = set.statistics(0).figures().lastRunNs;
  EXPECT_EQ(std::string(set.fault()->exception.detail()),
            std::to_string(ran / 1000 + (ran % 1000 != 0 ? 1 : 0)) + " us, allowed are 1500 us");
}

class HandmadeRun : public stride::test::HandmadeApp {};

TEST_F(HandmadeRun, TasksShareTheState) {
  Scheduled run(application.description(), application.state());
  run.scheduler.runUntil(100 * kMs);
  EXPECT_EQ(read("PLC_PRG.count"), "10");
  EXPECT_EQ(read("PLC_PRG.fb.count"), "20");
  EXPECT_EQ(read("total"), "20");
  EXPECT_EQ(read("Slow.runs"), "4");
}

} // namespace
