// What motion costs: planning a move, and one cycle of many axes with everything around them.
#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/bus/drive_group.hpp"
#include "runtime/numeric/profile/planner.hpp"

#include "st/SM_PLCopen/MC_MoveAbsolute.h"
#include "st/SM_PLCopen/MC_Power.h"

#include "runtime/app/ctx.h"

#include "tests/bench/motion/echo_driver.hpp"
#include "tests/support/fresh.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace {

using stride::motion::Dynamics;
using stride::motion::Profile;
using stride::motion::RampType;
using stride::motion::State;
using stride::test::fresh;

struct Problem {
  State start;
  double target;
  double endVelocity;
  Dynamics dynamics;
};

std::vector<Problem> randomProblems(RampType ramp) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> exponent(-2, 2);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Problem> problems(4096);
  for (Problem &p : problems) {
    p.dynamics = {ramp, 100 * std::pow(10, exponent(engine)), 100 * std::pow(10, exponent(engine)),
                  100 * std::pow(10, exponent(engine)), 1000 * std::pow(10, exponent(engine))};
    if (unit(engine) < 0)
      p.dynamics.deceleration = p.dynamics.acceleration;
    p.start = {1000 * unit(engine), 2 * p.dynamics.velocity * unit(engine),
               p.dynamics.acceleration * unit(engine)};
    p.target = 1000 * unit(engine);
    p.endVelocity = unit(engine) < 0 ? 0.0 : p.dynamics.velocity * unit(engine);
  }
  return problems;
}

/// Planning a move from a random state, in the mean; and how long the slowest of 1000 states takes:
/// of each state the shortest of several runs, the clock's own time included.
void planMove(benchmark::State &state) {
  const auto problems = randomProblems(static_cast<RampType>(state.range(0)));
  const auto plan = [](const Problem &p) {
    Profile profile;
    benchmark::DoNotOptimize(
        stride::motion::planMove(profile, p.start, p.target, p.endVelocity, p.dynamics));
    benchmark::DoNotOptimize(profile.duration);
  };
  size_t i = 0;
  for (auto _ : state)
    plan(problems[i++ & 4095]);
  using Clock = std::chrono::steady_clock;
  std::vector<double> times(problems.size(), HUGE_VAL);
  for (int run = 0; run < 7; ++run)
    for (size_t k = 0; k < problems.size(); ++k) {
      const auto start = Clock::now();
      plan(problems[k]);
      times[k] = std::min(times[k], std::chrono::duration<double>(Clock::now() - start).count());
    }
  std::sort(times.begin(), times.end());
  state.counters["p99.9"] = times[times.size() - 1 - times.size() / 1000];
}
BENCHMARK(planMove)->ArgName("ramp")->DenseRange(0, 3);

/// One cycle of `axes` axes that move to and fro: power, block, ownership, limits, conversion; with
/// drives that cost nothing, or with the simulated ones.
void movingAxes(benchmark::State &state) {
  const auto count = static_cast<size_t>(state.range(0));
  const bool rotary = state.range(1) != 0;
  const bool simulated = state.range(2) != 0;
  std::vector<stride::axis::AxisRef> axes(count, fresh<stride::axis::AxisRef>());
  std::vector<st::SM_PLCopen::MC_Power> powers(count, fresh<st::SM_PLCopen::MC_Power>());
  std::vector<st::SM_PLCopen::MC_MoveAbsolute> moves(count,
                                                     fresh<st::SM_PLCopen::MC_MoveAbsolute>());
  std::vector<stride::axis::AxisRef *> pointers;
  for (size_t i = 0; i < count; ++i) {
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
  auto group = fresh<stride::bus::AxisGroupRef>();
  auto driver = simulated ? stride::dummy::makeDriver(stride::dummy::plainSetup(count))
                          : std::unique_ptr<stride::bus::AxisDriver>(
                                std::make_unique<stride::bench::EchoDriver>(count));
  stride::bus::DriveGroup axisGroup(std::move(driver), group, pointers, 0.001);
  stride::Ctx ctx{};
  const auto cycle = [&] {
    axisGroup.executeStart();
    for (size_t i = 0; i < count; ++i) {
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
    ->ArgNames({"axes", "rotary", "simulated"})
    ->Args({1, 0, 0})
    ->Args({1000, 0, 0})
    ->Args({1000, 1, 0})
    ->Args({1000, 0, 1})
    ->Args({10000, 0, 0})
    ->Unit(benchmark::kMicrosecond);

} // namespace
