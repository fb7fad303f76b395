// Objects a second of tool correction and loops, with queues that hold the whole path. The issue
// asks for a million, and of SMC_AvoidLoop for 100,000 objects in a second.
#include "runtime/numeric/cnc/processors/avoid_loop.hpp"
#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "tests/unit/cnc_processors/contours.hpp"
#include "tests/unit/cnc_processors/stream_harness.hpp"

#include <benchmark/benchmark.h>

#include <cstring>
#include <memory>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::contours;
using namespace stride::cnc::test;

/// A spiral of short lines, of lines and half circles, or of lines that go back and forth.
std::vector<PathObject> spiral(int kind, int objects) {
  Drawing d;
  d.radius = 0.01;
  for (int i = 0; i < objects; ++i) {
    const double phi = i * 0.02;
    const double r = 10 + 0.05 * phi;
    const Point to{r * std::cos(phi), r * std::sin(phi)};
    if (kind == 1 && i % 2 != 0)
      d.arc({(d.here.x + to.x) / 2, (d.here.y + to.y) / 2}, i % 4 == 1 ? 180 : -180);
    else
      d.line(to.x + (kind == 2 ? i % 2 * 0.03 : 0), to.y);
  }
  d.path.front().marks = kAvoidLoops | kToolLeft;
  d.path.back().marks = kEndAvoidLoops | kEndToolCorrection;
  return d.path;
}

template <class Processor> void process(benchmark::State &state) {
  const std::vector<PathObject> path =
      spiral(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const auto processor = std::make_unique<Processor>();
  std::memset(static_cast<void *>(processor.get()), 0, sizeof *processor);
  OwnedQueue input(static_cast<uint32_t>(path.size()) + 5);
  OwnedQueue output(static_cast<uint32_t>(path.size()) * 2 + 10);
  for (auto _ : state) {
    state.PauseTiming();
    clear(&input.queue);
    for (const PathObject &object : path)
      append(&input.queue, &object);
    input.queue.endOfList = 1;
    StreamState stream{};
    startStream(stream, &output.queue, Processor::kGenerator, false);
    start(*processor);
    state.ResumeTiming();
    while (stream.phase == StreamPhase::Running)
      stepStream(stream, *processor, &input.queue, &output.queue);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(path.size()));
}

BENCHMARK(process<ToolCorrection>)
    ->ArgNames({"kind", "objects"})
    ->ArgsProduct({{0, 1, 2}, {20000}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(process<LoopAvoider>)
    ->ArgNames({"kind", "objects"})
    ->ArgsProduct({{0, 1, 2}, {20000, 100000}})
    ->Unit(benchmark::kMillisecond);

} // namespace
