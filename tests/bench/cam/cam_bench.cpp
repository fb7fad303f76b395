// What the curve of a cam costs: one look per cycle, with a master that moves on or jumps about,
// and its bounds per piece.
#include "runtime/numeric/cam/bounds.hpp"
#include "runtime/numeric/cam/curve.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace {

namespace cam = stride::cam;

/// The forms that are measured.
enum Kind : int { kLines, kCubicEven, kPairs, kCubicPairs, kNodes, kPolynomials, kLaws };
constexpr const char *kNames[] = {"even lines", "even cubic",  "pairs lines",  "pairs cubic",
                                  "XYVA",       "polynomials", "modified sine"};

struct Made {
  cam::Curve curve;
  std::vector<double> memory;

  template <class T> void put(const std::vector<T> &values) {
    memory.resize(values.size() * sizeof(T) / sizeof(double));
    std::memcpy(memory.data(), values.data(), values.size() * sizeof(T));
    curve.data = memory.data();
  }
};

Made make(int kind, int count) {
  Made made;
  made.curve.start = 0.0;
  made.curve.end = 360.0;
  made.curve.count = count;
  made.curve.element = cam::Element::Lreal;
  made.curve.cubic = kind == kCubicEven || kind == kCubicPairs;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  std::vector<cam::Node> nodes;
  std::vector<double> even;
  std::vector<double> pairs;
  std::vector<cam::Segment> segments;
  const int places = kind >= kPolynomials ? count + 1 : count;
  for (int i = 0; i < places; ++i) {
    const bool inside = i > 0 && i + 1 < places;
    const double x = 360.0 * (i + (inside ? jitter(engine) : 0.0)) / (places - 1);
    const double y = 100 * std::sin(x * M_PI / 180);
    nodes.push_back({x, y, 0.0, 0.0});
    even.push_back(y);
    pairs.insert(pairs.end(), {x, y});
    if (i > 0)
      segments.push_back(
          cam::makeSegment({kind == kLaws ? cam::Law::ModifiedSine : cam::Law::Polynomial},
                           nodes[nodes.size() - 2], nodes.back()));
  }
  switch (kind) {
  case kLines:
  case kCubicEven:
    made.curve.form = cam::Form::EvenTable;
    made.put(even);
    break;
  case kPairs:
  case kCubicPairs:
    made.curve.form = cam::Form::PairTable;
    made.put(pairs);
    break;
  case kNodes:
    made.curve.form = cam::Form::Nodes;
    made.put(nodes);
    break;
  default:
    made.curve.form = cam::Form::Segments;
    made.put(segments);
  }
  return made;
}

/// The master moves on, 1000 cycles a turn.
void sequential(benchmark::State &state) {
  const Made made = make(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  state.SetLabel(kNames[state.range(0)]);
  uint32_t index = 0;
  double x = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cam::evaluateCurve(made.curve, x, true, index));
    x += 0.360001;
    if (x >= 360.0)
      x -= 360.0;
  }
}

/// The master is anywhere in each cycle.
void randomPlaces(benchmark::State &state) {
  const Made made = make(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  state.SetLabel(kNames[state.range(0)]);
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> place(0.0, 360.0);
  std::vector<double> places(4096);
  for (double &x : places)
    x = place(engine);
  uint32_t index = 0;
  size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(cam::evaluateCurve(made.curve, places[i++ & 4095], true, index));
}

/// One piece of a cam, with a master that accelerates.
void boundsPerPiece(benchmark::State &state) {
  const Made made = make(static_cast<int>(state.range(0)), 1000);
  state.SetLabel(kNames[state.range(0)]);
  const uint32_t pieces = cam::pieceCount(made.curve);
  for (auto _ : state)
    benchmark::DoNotOptimize(cam::boundsOf(made.curve, {10.0, 100.0}));
  state.counters["per_piece"] = benchmark::Counter(static_cast<double>(pieces),
                                                   benchmark::Counter::kIsIterationInvariantRate |
                                                       benchmark::Counter::kInvert);
}

/// What MC_CamTableSelect does with a big table.
void check(benchmark::State &state) {
  const Made made = make(static_cast<int>(state.range(0)), 32000);
  state.SetLabel(kNames[state.range(0)]);
  for (auto _ : state)
    benchmark::DoNotOptimize(cam::checkCurve(made.curve));
}

void kindsAndSizes(benchmark::internal::Benchmark *benchmark) {
  for (int kind = kLines; kind <= kLaws; ++kind)
    for (const int count : {10, 1000, 32000})
      benchmark->Args({kind, count});
}

} // namespace

BENCHMARK(sequential)->Apply(kindsAndSizes);
BENCHMARK(randomPlaces)->Apply(kindsAndSizes);
BENCHMARK(boundsPerPiece)->DenseRange(kLines, kLaws)->Unit(benchmark::kMicrosecond);
BENCHMARK(check)->Arg(kLines)->Arg(kPairs)->Arg(kNodes)->Unit(benchmark::kMicrosecond);

BENCHMARK_MAIN();
