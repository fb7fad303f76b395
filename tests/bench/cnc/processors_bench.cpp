// How many objects a second path processors take. The issue asks for a million for lines and arcs.
#include "tests/unit/cnc_processors/sampled_path.hpp"

#include "runtime/numeric/cnc/processors/abc_slopes.hpp"
#include "runtime/numeric/cnc/processors/corner_path.hpp"
#include "runtime/numeric/cnc/processors/limit_circular.hpp"
#include "runtime/numeric/cnc/processors/limit_dynamics.hpp"
#include "runtime/numeric/cnc/processors/smooth_add_axes.hpp"
#include "runtime/numeric/cnc/processors/smooth_bspline.hpp"
#include "runtime/numeric/cnc/processors/transform.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace stride::cnc;
using namespace stride::cnc::test;

constexpr int kRepeated = 4; ///< How often a path is processed at a time.
constexpr uint32_t kPlaces = 300;

/// A zigzag of lines, or of lines and arcs, whose every corner is to be changed.
std::vector<PathObject> pathOf(bool arcs) {
  std::vector<PathObject> path;
  Point here{0, 0, 0};
  for (int i = 0; i < 30; ++i) {
    if (arcs && i % 2 == 1)
      path.push_back(arc(here + Point{0, 3, 0}, 3, -90, 60));
    else
      path.push_back(line(here, here + Point{4, i % 4 == 0 ? 2.0 : -2.0, 0}));
    path.back().marks = i == 0 ? kSmooth | kRound : 0;
    here = endOf(path.back());
  }
  return path;
}

struct Memory {
  std::vector<PathObject> objects = std::vector<PathObject>(kPlaces);
  Queue queue{};
  Memory() {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(objects.data());
    queue.size = kPlaces * sizeof(PathObject);
  }
};

template <class Processor>
void run(benchmark::State &state, Processor processor, const std::vector<PathObject> &path) {
  Memory input;
  Memory output;
  StreamState stream{};
  startStream(stream, &output.queue, Processor::kGenerator, false);
  start(processor);
  for (auto _ : state) {
    state.PauseTiming(); // filling and emptying queues is not the processor's
    while (countOf(&output.queue) != 0)
      removeAt(&output.queue, 0);
    for (int i = 0; i < kRepeated; ++i)
      for (const PathObject &object : path)
        append(&input.queue, &object);
    state.ResumeTiming();
    while (countOf(&input.queue) != 0)
      stepStream(stream, processor, &input.queue, &output.queue);
  }
  state.SetItemsProcessed(state.iterations() * kRepeated * static_cast<int64_t>(path.size()));
}

template <class Processor> Processor corners(PieceKind kind) {
  Processor processor{};
  processor.distance = 0.5;
  processor.kind = kind;
  processor.passesFunctions = true;
  return processor;
}

void smoothCubic(benchmark::State &state) {
  run(state, corners<SmoothPath>(PieceKind::Cubic), pathOf(state.range(0) != 0));
}
void smoothQuintic(benchmark::State &state) {
  run(state, corners<SmoothPath>(PieceKind::Quintic), pathOf(state.range(0) != 0));
}
void roundLines(benchmark::State &state) {
  run(state, corners<RoundPath>(PieceKind::Arc), pathOf(state.range(0) != 0));
}
void limitCircular(benchmark::State &state) {
  LimitCircular limit{};
  limit.acceleration = 100;
  limit.jump = 50;
  run(state, limit, pathOf(state.range(0) != 0));
}
void rotate(benchmark::State &state) {
  RotatePath path{};
  path.wanted = {TransformKind::Rotate, {30, 0, 0}};
  run(state, path, pathOf(state.range(0) != 0));
}

void limitDynamics(benchmark::State &state) {
  LimitDynamics limit{};
  limit.axes = 7;
  limit.velocity = 10;
  limit.acceleration = 50;
  run(state, limit, pathOf(state.range(0) != 0));
}
void splines(benchmark::State &state) {
  SmoothBSpline spline{};
  spline.spacing = KnotSpacing::Centripetal;
  run(state, spline, pathOf(false));
}
/// A and P, in ranges of 30 objects.
void additionalAxes(benchmark::State &state) {
  std::vector<PathObject> path = pathOf(state.range(0) != 0);
  for (PathObject &object : path)
    object.smoothAxes = 0x9;
  path[0].smoothAxes = 0x909;
  SmoothAddAxes smooth{};
  smooth.part = 0.5;
  run(state, smooth, path);
}
void slopes(benchmark::State &state) {
  AbcSlopes processor{};
  processor.angle = 1;
  run(state, processor, pathOf(state.range(0) != 0));
}

BENCHMARK(smoothCubic)->Arg(0)->Arg(1);
BENCHMARK(smoothQuintic)->Arg(0)->Arg(1);
BENCHMARK(roundLines)->Arg(0)->Arg(1);
BENCHMARK(limitCircular)->Arg(0)->Arg(1);
BENCHMARK(rotate)->Arg(0)->Arg(1);
BENCHMARK(limitDynamics)->Arg(0)->Arg(1);
BENCHMARK(splines);
BENCHMARK(additionalAxes)->Arg(0)->Arg(1);
BENCHMARK(slopes)->Arg(0)->Arg(1);

} // namespace
