// What axes cost that follow a master by a cam.
#include "runtime/app/ctx.h"
#include "runtime/bus/drive_group.hpp"
#include "tests/bench/motion/echo_driver.hpp"
#include "tests/support/fresh.hpp"

#include "st/SM_DriveBasic/MC_CAM_REF.h"
#include "st/SM_DriveBasic/SMC_CAMXYVA.h"
#include "st/SM_PLCopen/MC_CamIn.h"
#include "st/SM_PLCopen/MC_CamTableSelect.h"
#include "st/SM_PLCopen/MC_Power.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace {

using stride::axis::AxisRef;
using stride::test::fresh;

/// A master at 360 degrees per second, as SMC_TimeAxisFB would move it.
void turn(AxisRef &master, double cycle) {
  master.fSetPosition = std::fmod(master.fSetPosition + 360 * cycle, 360.0);
  master.fSetVelocity = 360;
  master.bMovedInThisCycle = 1;
}

/// One cycle of `slaves` axes on one rotary master, each with its MC_CamIn on a periodic cam of 20
/// points: power, block, ownership, limits, conversion.
void camSlaves(benchmark::State &state) {
  const auto count = static_cast<size_t>(state.range(0));
  const bool rotary = state.range(1) != 0;
  constexpr double kCycle = 0.001;
  AxisRef master = fresh<AxisRef>();
  master.iMovementType = 0;
  master.fPositionPeriod = 360;
  master.fTaskCycle = kCycle;
  master.bRegulatorOn = 1;

  std::vector<st::SM_DriveBasic::SMC_CAMXYVA> points;
  for (int i = 0; i < 20; ++i) {
    const double x = i * 360.0 / 19;
    points.push_back({x, rotary ? x : 50 - 50 * std::cos(x * 3.14159265358979 / 180),
                      rotary ? 1.0 : 0.87 * std::sin(x * 3.14159265358979 / 180), 0.0});
  }
  auto cam = fresh<st::SM_DriveBasic::MC_CAM_REF>();
  cam.byType = 3;
  cam.nElements = static_cast<int16_t>(points.size());
  cam.xStart = 0;
  cam.xEnd = 360;
  cam.pce = reinterpret_cast<decltype(cam.pce)>(points.data());

  std::vector<AxisRef> axes(count, fresh<AxisRef>());
  std::vector<st::SM_PLCopen::MC_Power> powers(count, fresh<st::SM_PLCopen::MC_Power>());
  std::vector<st::SM_PLCopen::MC_CamIn> blocks(count, fresh<st::SM_PLCopen::MC_CamIn>());
  auto select = fresh<st::SM_PLCopen::MC_CamTableSelect>();
  std::vector<AxisRef *> pointers;
  for (size_t i = 0; i < count; ++i) {
    axes[i].dwRatioTechUnitsDenom = 10000;
    if (rotary) {
      axes[i].iMovementType = 0;
      axes[i].fPositionPeriod = 360;
    }
    powers[i].Enable = powers[i].bRegulatorOn = powers[i].bDriveStart = 1;
    powers[i].Axis = &axes[i];
    blocks[i].Master = &master;
    blocks[i].Slave = &axes[i];
    pointers.push_back(&axes[i]);
  }
  auto group = fresh<stride::bus::AxisGroupRef>();
  stride::bus::DriveGroup axisGroup(std::make_unique<stride::bench::EchoDriver>(count), group,
                                    pointers, kCycle);
  stride::Ctx ctx{};
  select.Execute = 1;
  select.Master = &master;
  select.Slave = &axes[0];
  select.CamTable = &cam;
  select.body__(ctx);
  const auto cycle = [&] {
    axisGroup.executeStart();
    turn(master, kCycle);
    for (size_t i = 0; i < count; ++i) {
      powers[i].body__(ctx);
      auto &block = blocks[i];
      block.CamTableID = select.CamTableID;
      block.Execute = powers[i].Status;
      block.body__(ctx);
    }
    axisGroup.executeEnd();
  };
  for (int i = 0; i < 50; ++i)
    cycle();
  for (auto _ : state)
    cycle();
  if (blocks[count - 1].InSync == 0)
    state.SkipWithError("the slaves do not follow");
  state.counters["per axis"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(count),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(camSlaves)
    ->ArgNames({"slaves", "rotary"})
    ->Args({1, 0})
    ->Args({1000, 0})
    ->Args({1000, 1})
    ->Unit(benchmark::kMicrosecond);

} // namespace
