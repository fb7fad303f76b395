// RUN and STOP of the tasks of an application.
#include "runtime/task/real_scheduler.hpp"
#include "tests/unit/app/fixture.hpp"
#include "tests/unit/task/logged_tasks.hpp"

#include <gmock/gmock-matchers.h>

#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace stride::test;
using stride::BOOL;
using stride::Ctx;
using stride::StrideAppV1;
using stride::TaskDesc;
using stride::TaskKind;
using stride::task::CycleHook;
using stride::task::InstantObserver;
using stride::task::OperatingMode;
using stride::task::RealScheduler;
using ::testing::ElementsAre;

/// Switches at given times, as a script does.
class Switch final : public InstantObserver {
public:
  Switch(TaskSet &tasks, std::map<int64_t, OperatingMode> plan)
      : tasks_(&tasks), plan_(std::move(plan)) {}
  void beforeInstant(int64_t timeNs) override {
    for (; !plan_.empty() && plan_.begin()->first * kMs <= timeNs; plan_.erase(plan_.begin()))
      tasks_->setMode(plan_.begin()->second);
  }
  void afterInstant(int64_t, bool) override {}
  int64_t nextNs() const override {
    return plan_.empty() ? std::numeric_limits<int64_t>::max() : plan_.begin()->first * kMs;
  }

private:
  TaskSet *tasks_;
  std::map<int64_t, OperatingMode> plan_;
};

/// Notes what a hook is told, with the time.
class Told final : public CycleHook {
public:
  explicit Told(std::string name, Log &log) : name_(std::move(name)), log_(&log) {}
  void beforePous(Ctx &ctx) override { put(word_ + std::to_string(ctx.cycleStartNs / kMs)); }
  void afterPous(Ctx &) override { ++cycles; }
  void modeChanged(OperatingMode mode) override {
    word_ = mode == OperatingMode::Stop ? "stop" : "run";
  }
  void applicationStopped() override { put("end"); }

  int cycles = 0;

private:
  void put(const std::string &what) {
    if (!word_.empty())
      log_->lines.push_back(name_ + ":" + what);
    if (word_ != "end")
      word_.clear();
  }
  std::string name_;
  std::string word_; ///< What has been told since the last cycle.
  Log *log_;
};

TEST(OperatingModeTest, PousRestAndHooksGoOn) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>),
                                       cyclic("B", 1, 30, note<'b'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  Told hook("A", log);
  run.tasks.addHook(0, hook);
  Switch operated(run.tasks, {{20, OperatingMode::Stop}, {45, OperatingMode::Run}});
  run.scheduler.setObserver(&operated);
  run.scheduler.runUntil(25 * kMs);
  EXPECT_EQ(run.tasks.mode(), OperatingMode::Stop);
  EXPECT_EQ(run.tasks.modeOf(0), OperatingMode::Stop);
  EXPECT_EQ(run.tasks.modeOf(1), OperatingMode::Run) << "it is due at 30 ms";
  EXPECT_FALSE(run.tasks.modeTaken());
  run.scheduler.runUntil(31 * kMs);
  EXPECT_TRUE(run.tasks.modeTaken());
  run.scheduler.runUntil(70 * kMs);
  EXPECT_THAT(log.lines,
              ElementsAre("a0!", "b0!", "a10", "A:stop20", "A:run50", "a50", "a60", "b60"));
  EXPECT_EQ(hook.cycles, 7);
  EXPECT_EQ(run.tasks.statistics(0).figures().cycles, 7U) << "cycles of STOP count";
}

TEST(OperatingModeTest, TheSameModeAgainIsNothingNew) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  Told hook("A", log);
  run.tasks.addHook(0, hook);
  Switch operated(run.tasks, {{5, OperatingMode::Run},
                              {15, OperatingMode::Stop},
                              {25, OperatingMode::Stop},
                              {35, OperatingMode::Run},
                              {36, OperatingMode::Stop},
                              {37, OperatingMode::Run}});
  run.scheduler.setObserver(&operated);
  run.scheduler.runUntil(50 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "a10", "A:stop20", "A:run40", "a40"));
}

TEST(OperatingModeTest, TheFirstCycleOfThePousIsTheirFirst) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.tasks.setMode(OperatingMode::Stop);
  run.scheduler.runUntil(30 * kMs);
  EXPECT_TRUE(log.lines.empty());
  run.tasks.setMode(OperatingMode::Run);
  run.scheduler.runUntil(50 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a30!", "a40"));
}

BOOL going(Ctx *ctx) { return logOf(ctx).go; }

/// What waits for an event or a long time learns of it at once, and keeps its time.
TEST(OperatingModeTest, RareTasksTakeItOverAtOnce) {
  std::vector<TaskDesc> tasks = {
      cyclic("A", 0, 10, note<'a'>),
      cyclic("Long", 1, 2000, note<'l'>),
      {"Event", TaskKind::Event, 2, 0, 0, 0, stride::kNoIndex, note<'e'>, going}};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  Told onLong("L", log);
  Told onEvent("E", log);
  run.tasks.addHook(1, onLong);
  run.tasks.addHook(2, onEvent);
  Switch operated(run.tasks, {{1005, OperatingMode::Stop}, {1025, OperatingMode::Run}});
  run.scheduler.setObserver(&operated);
  run.scheduler.runUntil(1000 * kMs);
  log.lines.clear();
  run.scheduler.runUntil(1015 * kMs);
  EXPECT_TRUE(run.tasks.modeTaken());
  log.go = true; // becomes TRUE in STOP
  run.scheduler.runUntil(1045 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a1000", "L:stop1005", "E:stop1005", "L:run1025", "E:run1025",
                                     "e1025!", "a1030", "a1040"));
  log.lines.clear();
  run.scheduler.runUntil(2001 * kMs);
  EXPECT_EQ(log.lines.back(), "l2000") << "its time is the old one";
  EXPECT_EQ(std::count(log.lines.begin(), log.lines.end(), "L:run2000"), 0) << "it is told once";
}

TEST(OperatingModeTest, AnotherFunctionRunsInStop) {
  std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  tasks[0].runInStop = note<'s'>;
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  Switch operated(run.tasks, {{10, OperatingMode::Stop}, {30, OperatingMode::Run}});
  run.scheduler.setObserver(&operated);
  run.scheduler.runUntil(40 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!", "s10", "s20", "a30"));
}

void fails(Ctx *ctx) {
  stride::raise(*ctx, stride::ExceptionCode::DivisionByZero, "stopped.st", 4, 13);
}

TEST(OperatingModeTest, AnExceptionInStopEndsTheApplication) {
  std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  tasks[0].runInStop = fails;
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  Told hook("A", log);
  run.tasks.addHook(0, hook);
  Switch operated(run.tasks, {{10, OperatingMode::Stop}});
  run.scheduler.setObserver(&operated);
  const stride::task::RunResult result = run.scheduler.runUntil(100 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_EQ(result.fault->timeNs, 10 * kMs);
  EXPECT_TRUE(run.tasks.stopped());
  EXPECT_TRUE(run.tasks.told(0));
}

TEST(OperatingModeTest, TheEndComesInStopToo) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  Scheduled run(app, log);
  run.scheduler.runUntil(10 * kMs);
  run.tasks.setMode(OperatingMode::Stop);
  run.scheduler.runUntil(20 * kMs);
  run.tasks.stop();
  run.tasks.setMode(OperatingMode::Run); // too late
  run.scheduler.runUntil(60 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("a0!"));
  EXPECT_TRUE(run.tasks.atRest());
  EXPECT_EQ(run.tasks.modeOf(0), OperatingMode::Stop) << "what has ended takes nothing over";
}

/// Counters that ctx.state points to.
struct Counts {
  std::atomic<int> fast{0};
  std::atomic<int> event{0};
};

bool comes(const std::function<bool()> &condition) {
  for (int i = 0; i < 5000 && !condition(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return condition();
}

TEST(OperatingModeTest, ByTheRealClock) {
  const auto countFast = [](Ctx *ctx) { ++static_cast<Counts *>(ctx->state)->fast; };
  const auto countEvent = [](Ctx *ctx) { ++static_cast<Counts *>(ctx->state)->event; };
  const auto never = [](Ctx *) -> BOOL { return 0; };
  const std::vector<TaskDesc> tasks = {
      cyclic("Fast", 0, 1, countFast),
      cyclic("Hourly", 1, 3'600'000, countEvent),
      {"Event", TaskKind::Event, 2, 0, 0, 0, stride::kNoIndex, countEvent, never}};
  const StrideAppV1 app = appWith(tasks);
  Counts counts;
  TaskSet set(app, reinterpret_cast<std::byte *>(&counts), stride::task::hostApi(),
              LoopLimit::Clock);
  RealScheduler scheduler(set, {});
  scheduler.start();
  ASSERT_TRUE(comes([&] { return counts.fast > 5 && counts.event == 1; }));
  for (int round = 0; round < 3; ++round) {
    set.setMode(OperatingMode::Stop);
    ASSERT_TRUE(comes([&] { return set.modeTaken(); })) << "also who waits for an hour";
    const int before = counts.fast;
    const uint64_t cycles = set.statistics(0).figures().cycles;
    ASSERT_TRUE(comes([&] { return set.statistics(0).figures().cycles > cycles + 5; }));
    EXPECT_EQ(counts.fast, before);
    set.setMode(OperatingMode::Run);
    ASSERT_TRUE(comes([&] { return set.modeTaken() && counts.fast > before + 5; }));
  }
  EXPECT_EQ(counts.event, 1) << "neither the end of the hour nor an event has come";
  set.setMode(OperatingMode::Stop);
  EXPECT_TRUE(scheduler.finish());
}

} // namespace
