// What courses over time and looking ahead cost.
#include "runtime/axis/axis_ref.hpp"
#include "runtime/axis/forecast.hpp"
#include "runtime/numeric/profile/time_profile.hpp"

#include "st/SM_DriveBasic/SMC_GetTravelTime.h"
#include "st/SM_DriveBasic/SMC_ReadSetValues.h"
#include "st/SM_PLCopen/MC_MoveVelocity.h"
#include "st/SM_PLCopen/MC_PositionProfile.h"
#include "st/SM_PLCopen/MC_TP_REF.h"

#include "runtime/app/ctx.h"

#include "tests/support/fresh.hpp"

#include <benchmark/benchmark.h>

namespace {

using stride::axis::AxisRef;
using stride::test::fresh;

/// An axis in power at rest.
AxisRef readyAxis() {
  AxisRef axis = fresh<AxisRef>();
  axis.fTaskCycle = 0.001;
  axis.bRegulatorOn = axis.bDriveStart = 1;
  axis.bRegulatorRealState = axis.bDriveStartRealState = 1;
  return axis;
}

/// The rising edge of MC_PositionProfile with so many points: the whole course is computed.
void startCourse(benchmark::State &state) {
  auto axis = readyAxis();
  auto course = fresh<st::SM_PLCopen::MC_TP_REF>();
  for (int i = 0; i < 100; ++i)
    course.MC_TP_Array.v[i] = {100, i % 7 * 10.0};
  auto block = fresh<st::SM_PLCopen::MC_PositionProfile>();
  block.Axis = &axis;
  block.TimePosition = &course;
  block.ArraySize = static_cast<int16_t>(state.range(0));
  stride::Ctx ctx{};
  for (auto _ : state) {
    block.Execute = 0;
    block.body__(ctx);
    block.Execute = 1;
    block.body__(ctx);
    axis.bMovedInThisCycle = 0;
    benchmark::DoNotOptimize(axis.fSetPosition);
  }
}
BENCHMARK(startCourse)->ArgName("points")->Arg(1)->Arg(10)->Arg(100);

/// One cycle of a running course.
void followCourse(benchmark::State &state) {
  auto axis = readyAxis();
  auto course = fresh<st::SM_PLCopen::MC_TP_REF>();
  for (int i = 0; i < 100; ++i)
    course.MC_TP_Array.v[i] = {4000000000U, i % 7 * 10.0};
  auto block = fresh<st::SM_PLCopen::MC_PositionProfile>();
  block.Axis = &axis;
  block.TimePosition = &course;
  block.ArraySize = 100;
  block.Execute = 1;
  stride::Ctx ctx{};
  for (auto _ : state) {
    block.body__(ctx);
    axis.bMovedInThisCycle = 0;
    benchmark::DoNotOptimize(axis.fSetPosition);
  }
}
BENCHMARK(followCourse);

/// SMC_GetTravelTime for a place that is not reached within the forecast: the longest search.
void travelTime(benchmark::State &state) {
  auto axis = readyAxis();
  axis.fForecast = static_cast<double>(state.range(0)) * axis.fTaskCycle;
  stride::Ctx ctx{};
  auto move = fresh<st::SM_PLCopen::MC_MoveVelocity>();
  move.Axis = &axis;
  move.Velocity = 10;
  move.Acceleration = move.Deceleration = 100;
  move.Execute = 1;
  move.body__(ctx);
  auto travel = fresh<st::SM_DriveBasic::SMC_GetTravelTime>();
  travel.Axis = &axis;
  travel.Enable = 1;
  travel.Position = 1e6;
  for (auto _ : state) {
    travel.body__(ctx);
    benchmark::DoNotOptimize(travel.Valid);
  }
}
BENCHMARK(travelTime)->ArgName("cycles")->Arg(1)->Arg(100)->Arg(512);

/// SMC_ReadSetValues.
void readSetValues(benchmark::State &state) {
  auto axis = readyAxis();
  axis.fForecast = 0.5;
  stride::Ctx ctx{};
  auto move = fresh<st::SM_PLCopen::MC_MoveVelocity>();
  move.Axis = &axis;
  move.Velocity = 10;
  move.Acceleration = move.Deceleration = 100;
  move.Execute = 1;
  move.body__(ctx);
  auto read = fresh<st::SM_DriveBasic::SMC_ReadSetValues>();
  read.Axis = &axis;
  read.Enable = 1;
  read.TimeOffset = 0.3;
  for (auto _ : state) {
    read.body__(ctx);
    benchmark::DoNotOptimize(read.Position);
  }
}
BENCHMARK(readSetValues);

} // namespace
