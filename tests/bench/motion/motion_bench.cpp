// What motion costs: planning a move, and one cycle of many axes with everything around them.
#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/axis/axis_group.hpp"
#include "runtime/motion/trapezoid.hpp"

#include "st/SM_PLCopen/MC_MoveAbsolute.h"
#include "st/SM_PLCopen/MC_Power.h"

#include "runtime/app/ctx.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using stride::motion::Profile;
using stride::motion::TrapezoidLimits;

template <class T> T fresh() {
  T value{};
  stride::Ctx ctx{};
  value.init__(ctx);
  return value;
}

struct Problem {
  double position, velocity, target;
  TrapezoidLimits limits;
};

std::vector<Problem> randomProblems() {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> exponent(-2, 2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Problem> problems(4096);
  for (Problem &p : problems) {
    p.limits = {100 * std::pow(10, exponent(engine)), 100 * std::pow(10, exponent(engine)),
                100 * std::pow(10, exponent(engine))};
    p.position = 1000 * unit(engine);
    p.target = 1000 * unit(engine);
    p.velocity = 2 * p.limits.velocity * unit(engine);
  }
  return problems;
}

void planTrapezoid(benchmark::State &state) {
  const auto problems = randomProblems();
  std::size_t i = 0;
  for (auto _ : state) {
    const Problem &p = problems[i++ & 4095];
    Profile profile;
    benchmark::DoNotOptimize(
        stride::motion::planTrapezoid(profile, p.position, p.velocity, p.target, p.limits));
    benchmark::DoNotOptimize(profile.duration);
  }
}
BENCHMARK(planTrapezoid);

/// One cycle of `axes` axes that move to and fro: drive, power, block, supervision, conversion.
void movingAxes(benchmark::State &state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const bool rotary = state.range(1) != 0;
  std::vector<stride::axis::AxisRef> axes(count, fresh<stride::axis::AxisRef>());
  std::vector<st::SM_PLCopen::MC_Power> powers(count, fresh<st::SM_PLCopen::MC_Power>());
  std::vector<st::SM_PLCopen::MC_MoveAbsolute> moves(count,
                                                     fresh<st::SM_PLCopen::MC_MoveAbsolute>());
  std::vector<stride::axis::AxisRef *> pointers;
  for (std::size_t i = 0; i < count; ++i) {
    axes[i].dwRatioTechUnitsDenom = 10000;
    axes[i].bSWLimitEnable = 1;
    axes[i].fSWLimitNegative = -1e6;
    axes[i].fSWLimitPositive = 1e6;
    if (rotary) {
      axes[i].iMovementType = 0;
      axes[i].fPositionPeriod = 360;
      axes[i].iRatioTechUnitsNum = 7;
    }
    powers[i].Enable = powers[i].bRegulatorOn = powers[i].bDriveStart = 1;
    powers[i].Axis = &axes[i];
    moves[i].Axis = &axes[i];
    moves[i].Velocity = 100 + static_cast<double>(i % 17);
    moves[i].Acceleration = moves[i].Deceleration = 1000;
    pointers.push_back(&axes[i]);
  }
  auto group = fresh<stride::axis::AxisGroupRef>();
  stride::axis::AxisGroup axisGroup(stride::dummy::makeDummyDriver(count), group, pointers, 0.001);
  stride::Ctx ctx{};
  const auto cycle = [&] {
    axisGroup.executeStart();
    for (std::size_t i = 0; i < count; ++i) {
      powers[i].body__(ctx);
      auto &move = moves[i];
      move.Execute = powers[i].Status != 0 && move.Done == 0 && move.Error == 0;
      if (move.Execute == 0)
        move.Position = move.Position > 50 ? 10 : 300;
      move.body__(ctx);
    }
    axisGroup.executeEnd();
  };
  for (int i = 0; i < 50; ++i)
    cycle();
  for (auto _ : state)
    cycle();
  state.counters["per axis"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(count),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(movingAxes)
    ->ArgNames({"axes", "rotary"})
    ->Args({1, 0})
    ->Args({1000, 0})
    ->Args({1000, 1})
    ->Unit(benchmark::kMicrosecond);

} // namespace
