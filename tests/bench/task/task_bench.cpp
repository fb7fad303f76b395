// What a cycle costs besides its POUs and its sleep.
#include "runtime/task/cycle_gate.hpp"
#include "runtime/task/task_set.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace stride;

void nothing(Ctx *) {}
BOOL never(Ctx *) { return 0; }

StrideAppV1 appWith(const std::vector<TaskDesc> &tasks) {
  StrideAppV1 app{};
  app.tasks = tasks.data();
  app.taskCount = static_cast<uint32_t>(tasks.size());
  return app;
}

TaskDesc cyclicTask() {
  return {"Task", TaskKind::Cyclic, 1, 1'000'000, 500'000, 1, kNoIndex, nothing, nullptr};
}

class EmptyHook final : public task::CycleHook {
public:
  void beforePous(Ctx &) override {}
  void afterPous(Ctx &) override {}
};

/// As the real clock runs it: guard, watchdog, statistics; with `hooks` hooks around the POUs.
void emptyCycle(benchmark::State &state) {
  const std::vector<TaskDesc> list = {cyclicTask()};
  const StrideAppV1 app = appWith(list);
  alignas(16) std::byte memory[64]{};
  task::TaskSet tasks(app, memory, task::hostApi(), task::LoopLimit::Clock);
  std::vector<EmptyHook> hooks(static_cast<size_t>(state.range(0)));
  for (EmptyHook &hook : hooks)
    tasks.addHook(0, hook);
  int64_t time = 0;
  for (auto _ : state) {
    tasks.runCycle(0, time, 50'000);
    time += 1'000'000;
  }
}
BENCHMARK(emptyCycle)->Arg(0)->Arg(8);

/// In and out of the gate, as before and after each cycle.
void gate(benchmark::State &state) {
  task::CycleGate gate({0}, state.range(0) != 0);
  for (auto _ : state) {
    gate.enter(0);
    gate.leave(0);
  }
}
BENCHMARK(gate)->ArgName("turns")->Arg(0)->Arg(1);

/// A look at the event of one task.
void eventLook(benchmark::State &state) {
  const std::vector<TaskDesc> list = {
      cyclicTask(), {"Event", TaskKind::Event, 0, 0, 0, 0, kNoIndex, nothing, never}};
  const StrideAppV1 app = appWith(list);
  alignas(16) std::byte memory[64]{};
  task::TaskSet tasks(app, memory, task::hostApi(), task::LoopLimit::Clock);
  for (auto _ : state)
    benchmark::DoNotOptimize(tasks.eventLevel(1, 0));
}
BENCHMARK(eventLook);

} // namespace
