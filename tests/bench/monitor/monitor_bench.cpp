// What tracing and serving cost in a cycle: 10,000 symbols at 1 kHz leave 1 ms for everything.
#include "runtime/monitor/symbol_server.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace stride;

/// An application of one task with arrays of BOOL, INT, REAL and LREAL, a quarter of the symbols
/// each.
class Wide {
public:
  explicit Wide(uint64_t symbols) {
    const uint64_t each = symbols / 4;
    static constexpr Kind kKinds[] = {Kind::BOOL, Kind::INT, Kind::REAL, Kind::LREAL};
    static constexpr const char *kNames[] = {"b", "i", "r", "l"};
    static constexpr uint32_t kSizes[] = {1, 2, 4, 8};
    uint64_t offset = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      TypeDesc element{};
      element.kind = kKinds[i];
      element.name = kNames[i];
      element.size = kSizes[i];
      element.align = kSizes[i];
      element.element = kNoIndex;
      types_.push_back(element);
    }
    for (uint32_t i = 0; i < 4; ++i) {
      TypeDesc array{};
      array.kind = Kind::Array;
      array.name = "ARRAY";
      array.size = kSizes[i] * each;
      array.align = kSizes[i];
      array.element = i;
      array.elementCount = each;
      types_.push_back(array);
      offset = (offset + 7) / 8 * 8;
      RootDesc root{};
      root.name = kNames[i];
      root.offset = offset;
      root.type = 4 + i;
      roots_.push_back(root);
      offset += array.size;
    }
    task_.name = "T";
    task_.kind = TaskKind::Cyclic;
    task_.intervalNs = 1'000'000;
    task_.core = kNoIndex;
    task_.run = [](Ctx *) {};
    state_.resize(offset);
    app_.types = types_.data();
    app_.typeCount = 8;
    app_.roots = roots_.data();
    app_.rootCount = 4;
    app_.tasks = &task_;
    app_.taskCount = 1;
  }
  const StrideAppV1 &app() const { return app_; }
  std::byte *state() { return state_.data(); }

private:
  std::vector<TypeDesc> types_;
  std::vector<RootDesc> roots_;
  TaskDesc task_{};
  StrideAppV1 app_{};
  std::vector<std::byte> state_;
};

void sampleRow(benchmark::State &state) {
  Wide wide(static_cast<uint64_t>(state.range(0)));
  const app::SymbolTable symbols(wide.app());
  const app::TraceColumns columns(symbols, {"b", "i", "r", "l"});
  std::vector<std::byte> row(columns.rowSize());
  for (auto _ : state) {
    columns.sample(0, wide.state(), row.data());
    benchmark::DoNotOptimize(row.data());
  }
}
BENCHMARK(sampleRow)->Arg(100)->Arg(10'000)->Unit(benchmark::kMicrosecond);

void recorderCycle(benchmark::State &state) {
  Wide wide(10'000);
  task::TaskSet tasks(wide.app(), wide.state(), task::hostApi(), task::LoopLimit::Budget);
  monitor::SymbolServer server(tasks);
  server.addOuterHooks();
  server.addInnerHooks();
  monitor::RecorderSettings settings;
  settings.names = {"b", "i", "r", "l"};
  settings.trigger = monitor::TriggerSettings{"b[0]", monitor::TriggerEdge::High, ""};
  server.setRecorder(std::make_shared<monitor::Recorder>(server.symbols(), settings));
  int64_t time = 0;
  for (auto _ : state)
    tasks.runCycle(0, time += 1'000'000, 0);
}
BENCHMARK(recorderCycle)->Unit(benchmark::kMicrosecond);

/// A cycle in which nobody asks for anything, with the hooks (1) and without (0).
void idleCycle(benchmark::State &state) {
  Wide wide(4);
  task::TaskSet tasks(wide.app(), wide.state(), task::hostApi(), task::LoopLimit::Budget);
  monitor::SymbolServer server(tasks);
  if (state.range(0) != 0) {
    server.addOuterHooks();
    server.addInnerHooks();
  }
  int64_t time = 0;
  for (auto _ : state)
    tasks.runCycle(0, time += 1'000'000, 0);
}
BENCHMARK(idleCycle)->Arg(0)->Arg(1);

/// The largest request that there is: 2,000 values in one cycle.
void readCycle(benchmark::State &state) {
  Wide wide(8'000);
  task::TaskSet tasks(wide.app(), wide.state(), task::hostApi(), task::LoopLimit::Budget);
  monitor::SymbolServer server(tasks);
  server.addOuterHooks();
  server.addInnerHooks();
  const auto request = server.read({"l"});
  int64_t time = 0;
  tasks.runCycle(0, time, 0);
  for (auto _ : state) {
    server.again(request);
    tasks.runCycle(0, time += 1'000'000, 0);
  }
}
BENCHMARK(readCycle)->Unit(benchmark::kMicrosecond);

} // namespace
