// What a cycle of SMC_Interpolator costs while a path of short lines flows through its queue: with
// limited jerk, and at most 64 steps of planning for a cycle of 1 ms. The issue asks for 0.5 us in
// the mean and 5 us at p99.99.
#include "tests/unit/cnc/interpolator_drive.hpp"

#include <benchmark/benchmark.h>

#include <chrono>

namespace {

using namespace stride::test;

/// A winding path of lines of 0.5: a circle whose radius changes from 15 to 60.
class Winding {
public:
  explicit Winding(Drive &drive) : drive_(drive) {}

  /// Fills the queue.
  void refill() {
    while (!stride::cnc::isFull(&drive_.queue)) {
      angle_ += kLength / (37.5 + 22.5 * std::sin(0.37 * angle_));
      stride::cnc::PathObject &line =
          drive_.line(drive_.last.coordinate[0] + kLength * std::cos(angle_),
                      drive_.last.coordinate[1] + kLength * std::sin(angle_));
      line.velocity = line.velocityEnd = 250;
      line.acceleration = line.deceleration = 1750;
    }
  }

private:
  static constexpr double kLength = 0.5;
  Drive &drive_;
  double angle_ = 0;
};

/// Of each cycle the shortest of all iterations counts, so that what else the machine does does
/// not.
void cyclesOfAPath(benchmark::State &state) {
  constexpr size_t kCycles = 60000;
  std::vector<double> microseconds(kCycles, HUGE_VAL);
  for (auto _ : state) {
    Drive drive(LawKind::Jerk, static_cast<size_t>(state.range(0)));
    drive.command.jerk = 50000;
    drive.command.limitKinks = true;
    drive.command.limits.acceleration[0] = drive.command.limits.acceleration[1] = 1750;
    Winding path(drive);
    path.refill();
    drive.start();
    double total = 0;
    for (double &least : microseconds) {
      const auto begin = std::chrono::steady_clock::now();
      cycle(*drive.interpolator, drive.command);
      const std::chrono::duration<double, std::micro> time =
          std::chrono::steady_clock::now() - begin;
      least = std::min(least, time.count());
      total += time.count();
      path.refill();
    }
    state.SetIterationTime(total * 1e-6);
    benchmark::DoNotOptimize(drive.interpolator->progress);
    state.counters["v"] = drive.interpolator->progress.motion.velocity;
  }
  std::sort(microseconds.begin(), microseconds.end());
  const auto part = [&microseconds](double p) {
    return microseconds[static_cast<size_t>(p * static_cast<double>(kCycles - 1))];
  };
  double sum = 0;
  for (const double time : microseconds)
    sum += time;
  state.counters["mean_us"] = sum / static_cast<double>(kCycles);
  state.counters["p99_us"] = part(0.99);
  state.counters["p99.99_us"] = part(0.9999);
  state.counters["max_us"] = microseconds.back();
}

BENCHMARK(cyclesOfAPath)
    ->ArgName("places")
    ->Arg(200)
    ->Arg(1000)
    ->Iterations(9)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
