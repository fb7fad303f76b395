#include "runtime/task/virtual_scheduler.hpp"
#include "tests/unit/app/fixture.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace {

using stride::Ctx;
using stride::ExceptionCode;
using stride::StrideAppV1;
using stride::TaskDesc;
using stride::TaskKind;
using stride::task::CycleHook;
using stride::task::RunResult;
using stride::task::VirtualScheduler;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int64_t kMs = 1000000;

/// An application without types: its tasks write to a log that ctx.state points to.
struct Log {
  std::vector<std::string> lines;
};

Log &logOf(Ctx *ctx) { return *static_cast<Log *>(ctx->state); }

template <char Name> void note(Ctx *ctx) {
  logOf(ctx).lines.push_back(std::string(1, Name) + std::to_string(ctx->cycleStartNs / kMs) +
                             (ctx->firstCycle != 0 ? "!" : ""));
}

StrideAppV1 appWith(const std::vector<TaskDesc> &tasks) {
  StrideAppV1 app{};
  app.tasks = tasks.data();
  app.taskCount = static_cast<uint32_t>(tasks.size());
  return app;
}

TaskDesc cyclic(const char *name, uint32_t priority, int64_t ms, void (*run)(Ctx *)) {
  return {name, TaskKind::Cyclic, priority, ms * kMs, 0, 0, 0, run};
}

VirtualScheduler schedulerFor(const StrideAppV1 &app, Log &log) {
  return VirtualScheduler(app, reinterpret_cast<std::byte *>(&log), stride::task::hostApi());
}

TEST(VirtualSchedulerTest, OrderIsTimePriorityDeclaration) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 5, 20, note<'a'>), cyclic("B", 1, 10, note<'b'>),
                                       cyclic("C", 5, 10, note<'c'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  VirtualScheduler scheduler = schedulerFor(app, log);
  EXPECT_EQ(scheduler.fastestTask(), 1U);
  const RunResult result = scheduler.runUntil(30 * kMs);
  EXPECT_THAT(log.lines, ElementsAre("b0!", "a0!", "c0!", "b10", "c10", "b20", "a20", "c20"));
  EXPECT_EQ(result.timeNs, 30 * kMs);
  EXPECT_EQ(scheduler.statistics()[0].cycles, 2U);
  EXPECT_EQ(scheduler.statistics()[1].cycles, 3U);
}

TEST(VirtualSchedulerTest, EndIsExclusiveAndContinues) {
  const std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  VirtualScheduler scheduler = schedulerFor(app, log);
  scheduler.runUntil(100 * kMs);
  EXPECT_EQ(log.lines.size(), 10U);
  EXPECT_EQ(log.lines.back(), "a90");
  scheduler.runUntil(101 * kMs);
  EXPECT_EQ(log.lines.back(), "a100");
}

TEST(VirtualSchedulerTest, RefusesWhatItCannotRun) {
  Log log;
  const std::vector<TaskDesc> none;
  const StrideAppV1 empty = appWith(none);
  EXPECT_THROW(schedulerFor(empty, log), stride::app::Error);
  std::vector<TaskDesc> tasks = {cyclic("A", 0, 10, note<'a'>)};
  tasks[0].kind = TaskKind::Event;
  const StrideAppV1 event = appWith(tasks);
  EXPECT_THROW(schedulerFor(event, log), stride::app::Error);
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
  VirtualScheduler scheduler = schedulerFor(app, log);
  NotingHook x("x", log);
  NotingHook y("y", log);
  scheduler.addHook(1, x);
  scheduler.addHook(1, y);
  scheduler.runUntil(10 * kMs);
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
  VirtualScheduler scheduler = schedulerFor(app, log);
  Times times;
  scheduler.setObserver(&times);
  scheduler.runUntil(20 * kMs);
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
  VirtualScheduler scheduler = schedulerFor(app, log);
  NotingHook hook("x", log, 2);
  scheduler.addHook(0, hook);
  const RunResult result = scheduler.runUntil(1000 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_EQ(stride::task::describe(*result.fault),
            "division by zero at a.st:3:7 (task Main, cycle 2, at T#20ms)");
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
  VirtualScheduler scheduler = schedulerFor(app, log);
  scheduler.setLoopBudget(1000);
  const RunResult result = scheduler.runUntil(100 * kMs);
  ASSERT_TRUE(result.fault);
  EXPECT_EQ(result.fault->exception.code(), ExceptionCode::EndlessLoop);
}

TEST(VirtualSchedulerTest, AStopRequestEndsTheRun) {
  const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, note<'a'>)};
  const StrideAppV1 app = appWith(tasks);
  Log log;
  VirtualScheduler scheduler = schedulerFor(app, log);
  scheduler.setStopRequest([&log] { return log.lines.size() == 3; });
  const RunResult result = scheduler.runUntil(1000 * kMs);
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
  for (const auto &[run, code] : {Case{wildPointer, ExceptionCode::AccessViolation},
                                  Case{deepRecursion, ExceptionCode::StackOverflow},
                                  Case{wildPointer, ExceptionCode::AccessViolation}}) {
    const std::vector<TaskDesc> tasks = {cyclic("Main", 0, 10, run)};
    const StrideAppV1 app = appWith(tasks);
    Log log;
    VirtualScheduler scheduler = schedulerFor(app, log);
    const stride::task::MemoryGuard guard;
    const RunResult result = scheduler.runUntil(100 * kMs);
    ASSERT_TRUE(result.fault);
    EXPECT_EQ(result.fault->exception.code(), code);
  }
}
#endif

class HandmadeRun : public stride::test::HandmadeApp {};

TEST_F(HandmadeRun, TasksShareTheState) {
  VirtualScheduler scheduler(application.description(), application.state(),
                             stride::task::hostApi());
  scheduler.runUntil(100 * kMs);
  EXPECT_EQ(read("PLC_PRG.count"), "10");
  EXPECT_EQ(read("PLC_PRG.fb.count"), "20");
  EXPECT_EQ(read("total"), "20");
  EXPECT_EQ(read("Slow.runs"), "4");
}

} // namespace
