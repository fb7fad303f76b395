// What building a cam costs: SMCB.CamBuilder as a program calls it, from Init to Write.
#include "st/SM3_CamBuilder/CAM_REF_MULTICORE_SAFE.h"
#include "st/SM3_CamBuilder/CamBuilder.h"
#include "st/SM_DriveBasic/MC_CAM_REF.h"

#include "runtime/iec/ctx.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

namespace {

using Builder = st::SM3_CamBuilder::CamBuilder;
using Segment = st::SM3_CamBuilder::CAM_SEGMENT;

/// What leaves more or less to the builder.
enum Kind : int { kGiven, kPlaces, kPlacesClosed };

struct Case {
  stride::Ctx ctx = {};
  std::unique_ptr<Builder> builder = std::make_unique<Builder>();
  std::vector<Segment> segments;
  std::vector<st::SM_DriveBasic::SMC_CAM_SEGMENT> memory;
  st::SM_DriveBasic::MC_CAM_REF cam = {};

  Case(Kind kind, int count) : memory(static_cast<size_t>(count)) {
    builder->init__(ctx);
    for (int i = 0; i < count; ++i) {
      Segment segment = {};
      segment.eType = 1; // Poly5 from BoundImplicit to Bound or BoundPosition
      const double x = (i + 1.0) / count;
      segment.right = {x * 360.0,
                       std::sin(x * 6.0),
                       6.0 / 360.0 * std::cos(x * 6.0),
                       0.0,
                       0.0,
                       static_cast<int16_t>(kind == kGiven ? 5 : 2)};
      segments.push_back(segment);
    }
    cam.pce = reinterpret_cast<decltype(cam.pce)>(memory.data());
    cam.nMaxElements = static_cast<int16_t>(count);
  }

  bool build(bool closed) {
    builder->Init(ctx);
    for (const Segment &segment : segments)
      builder->Append(ctx, segment);
    return builder->Write(ctx, cam, static_cast<stride::BOOL>(closed)) == 0;
  }
};

void buildCam(benchmark::State &state) {
  const auto kind = static_cast<Kind>(state.range(0));
  Case test(kind, static_cast<int>(state.range(1)));
  for (auto _ : state)
    if (!test.build(kind == kPlacesClosed))
      state.SkipWithError("no cam");
  state.SetLabel(kind == kGiven ? "all given" : kind == kPlaces ? "places" : "places, closed");
}
BENCHMARK(buildCam)
    ->ArgsProduct({{kGiven, kPlaces, kPlacesClosed}, {10, 1000}})
    ->Unit(benchmark::kMicrosecond);

/// A copy of a cam of 1,000 segments from another task.
void getCopy(benchmark::State &state) {
  Case test(kGiven, 1000);
  auto safe = std::make_unique<st::SM3_CamBuilder::CAM_REF_MULTICORE_SAFE>();
  safe->init__(test.ctx);
  if (!test.build(false) || safe->SetCamRef(test.ctx, test.cam) != 0)
    state.SkipWithError("no cam");
  for (auto _ : state)
    benchmark::DoNotOptimize(safe->GetCopy(test.ctx, test.cam, test.memory.data(),
                                           test.memory.size() * sizeof test.memory[0]));
}
BENCHMARK(getCopy)->Unit(benchmark::kMicrosecond);

} // namespace
