// What axis groups cost: a cycle while blended lines are driven, what a line costs in planning, and
// many groups at once. The issue asks for 2 us a cycle of a six-axis arm, 50 us for the planning of
// a blended line, and a fifth of a core for 100 Scaras at 1 ms. With a planning task: what is left
// for the axes' task, and what a call of the other one takes.
#include "runtime/numeric/group/planning.hpp"
#include "runtime/numeric/kinematics/orientation.hpp"
#include "tests/property/group_machines.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <numeric>
#include <vector>

namespace {

using namespace stride::group;
using stride::test::Machine;

constexpr GroupCommand kCommand{0.001, 1, false, 0, 64, 24};

/// Microseconds of a call.
template <class Call> double timeOf(Call call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
  return time.count();
}

/// A group that goes around a polygon of lines, with corners.
class Round {
public:
  /// `turns`: the tool turns on the lines, as far as the machine can. `givesAxes`: by tool axes
  /// that go evenly.
  Round(Machine machine, bool turns, bool givesAxes = false)
      : machine_(machine), turns_(turns), given_(givesAxes ? toolAxesOf(machine_) : 0U),
        group_(std::make_unique<GroupMotion>()), planning_(std::make_unique<GroupPlanning>()),
        configuration_(machine_.kinematics.ref().configurationOf(machine_.home)) {
    for (AxisLimits &limits : machine_.limits)
      limits = {300, 3000, 60000, -1e4, 1e4};
    reset(*group_, machine_.home);
    stride::kinematics::Frame<double> frame;
    (void)machine_.kinematics.forward(machine_.home, frame);
    last_ = poseOf(frame);
    middle_ = last_;
    std::copy(std::begin(machine_.home), std::end(machine_.home), lastAxes_);
    if (given_ != 0)
      configuration_ = machine_.kinematics.ref().placingConfigurationOf(machine_.home);
  }

  /// One cycle in two parts; there are always lines to go on with.
  void think() {
    while (group_->next - group_->first < 4)
      order();
    plan(*group_, arm(), kCommand);
  }
  void go() {
    goOn(*group_, arm(), kCommand);
    (void)rebase(*group_);
    note();
  }

  /// Likewise, where another task plans; the two parts are one cycle of the axes' task.
  void follow() {
    while (group_->next - group_->first < 4)
      order();
    (void)stride::group::follow(*group_, *planning_, arm(), kCommand);
  }
  void goAndPost() {
    goOn(*group_, *planning_, arm(), kCommand);
    (void)post(*group_, *planning_, arm(), machine_.kinematics, kCommand);
    note();
  }
  /// A call of the other task, as its block plans in so many milliseconds.
  void planNow(int milliseconds) {
    planAside(*planning_, {1e-3 * milliseconds, kCommand.steps * milliseconds,
                           kCommand.samples * milliseconds});
  }

  /// Those that have been begun, and how many of them by a corner.
  uint64_t lines() const { return seen_; }
  uint64_t corners() const { return corners_; }
  bool failed() const { return group_->obstacle != Obstacle::None; }

private:
  static unsigned toolAxesOf(const Machine &machine) {
    unsigned given = 0;
    (void)machine.kinematics.splits(given);
    return given;
  }

  Arm arm() const {
    return {machine_.kinematics.ref(), machine_.joints, 0, machine_.limits, configuration_};
  }

  /// Counts the lines that have been begun.
  void note() {
    const Movement *const active = activeOf(*group_);
    if (active == nullptr || active->id == seen_)
      return;
    seen_ = active->id;
    corners_ += active->corner.length > 0.0 ? 1 : 0;
  }

  void order() {
    angle_ += 1.3;
    Pose to = middle_;
    to.place.x += 60 * std::cos(angle_);
    to.place.y += 60 * std::sin(angle_);
    if (turns_) {
      stride::kinematics::Matrix<double> turn =
          matrixOf(middle_.turn) * stride::kinematics::aboutZ(0.2 * std::sin(angle_));
      if (machine_.joints == 6)
        turn = turn * stride::kinematics::aboutX(0.15 * std::cos(angle_));
      setRows(to.turn, turn);
    }
    Order order{};
    order.path = {400, 4000, 4000, 80000};
    order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
    order.configuration = configuration_;
    order.transition = Transition::Distance;
    order.transitionValue = 15;
    Leg leg = lineLeg(last_, to, {});
    if (given_ != 0)
      giveAxes(to, leg);
    append(*group_, drawId(*group_), leg, order);
    last_ = to;
  }

  /// The axes of the tool go to where they are in a pose.
  void giveAxes(const Pose &to, Leg &leg) {
    double axes[kAxes]{};
    (void)machine_.kinematics.ref().inverse(
        frameOf(to), machine_.kinematics.ref().configurationOf(machine_.home), lastAxes_, axes);
    giveToolAxes(leg, static_cast<uint8_t>(given_), lastAxes_, axes);
    std::copy(std::begin(axes), std::end(axes), lastAxes_);
  }

  Machine machine_;
  bool turns_;
  unsigned given_;
  std::unique_ptr<GroupMotion> group_;
  std::unique_ptr<GroupPlanning> planning_;
  stride::kinematics::Configuration configuration_;
  Pose last_{};
  Pose middle_{};
  double lastAxes_[kAxes]{};
  double angle_ = 0;
  uint64_t seen_ = 0;
  uint64_t corners_ = 0;
};

Machine machineOf(int64_t kind) {
  switch (kind) {
  case 0:
    return stride::test::gantry();
  case 1:
    return stride::test::scara();
  case 2:
    return stride::test::articulated();
  default:
    return stride::test::offsetWrist();
  }
}

constexpr size_t kCycles = 20000;

/// The shortest times of each cycle.
using Times = std::vector<double>;
double sumOf(const Times &times) { return std::accumulate(times.begin(), times.end(), 0.0); }
/// Of sorted ones.
double quantile(const Times &times, double part) {
  return times[static_cast<size_t>(part * static_cast<double>(times.size()))];
}

/// What the cycles took, which are sorted, and what was done in them. [us]
void countCycles(benchmark::State &state, const Times &cycles, uint64_t lines, uint64_t corners) {
  state.counters["mean_us"] = sumOf(cycles) / kCycles;
  state.counters["lines"] = static_cast<double>(lines);
  state.counters["corners"] = static_cast<double>(corners);
  state.counters["median_us"] = quantile(cycles, 0.5);
  state.counters["p99_us"] = quantile(cycles, 0.99);
  state.counters["p999_us"] = quantile(cycles, 0.999);
  state.counters["p9999_us"] = quantile(cycles, 0.9999);
}

/// Of each cycle the shortest of all iterations counts, so that what else the machine does does
/// not.
void cyclesOfAGroup(benchmark::State &state) {
  Times thinking(kCycles, HUGE_VAL);
  Times going(kCycles, HUGE_VAL);
  uint64_t lines = 0;
  uint64_t corners = 0;
  for (auto _ : state) {
    Round round(machineOf(state.range(0)), state.range(1) != 0, state.range(1) == 2);
    double total = 0;
    for (size_t i = 0; i < kCycles; ++i) {
      const double thought = timeOf([&] { round.think(); });
      const double gone = timeOf([&] { round.go(); });
      thinking[i] = std::min(thinking[i], thought);
      going[i] = std::min(going[i], gone);
      total += thought + gone;
    }
    lines = round.lines();
    corners = round.corners();
    if (round.failed())
      state.SkipWithError("the group has failed");
    state.SetIterationTime(total * 1e-6);
  }
  Times cycles(kCycles);
  for (size_t i = 0; i < kCycles; ++i)
    cycles[i] = thinking[i] + going[i];
  std::sort(cycles.begin(), cycles.end());
  std::sort(thinking.begin(), thinking.end());
  countCycles(state, cycles, lines, corners);
  // What is beyond the cheapest calls, which find nothing to plan.
  const double idle = quantile(thinking, 0.1);
  state.counters["planning_us_per_line"] =
      (sumOf(thinking) - idle * kCycles) / static_cast<double>(lines);
}
BENCHMARK(cyclesOfAGroup)
    ->ArgsProduct({{0, 1, 2, 3}, {0, 1}})
    ->ArgsProduct({{1, 2, 3}, {2}}) // by tool axes that go evenly
    ->ArgNames({"machine", "turns"})
    ->UseManualTime()
    ->Iterations(5);

/// The same with a task that plans in every so many cycles; each of its calls is over before the
/// next cycle.
void cyclesBesideAPlanner(benchmark::State &state) {
  const auto every = static_cast<int>(state.range(1));
  Times cycles(kCycles, HUGE_VAL);
  Times calls(kCycles / static_cast<size_t>(every), HUGE_VAL);
  uint64_t lines = 0;
  uint64_t corners = 0;
  for (auto _ : state) {
    Round round(machineOf(state.range(0)), false);
    double total = 0;
    for (size_t i = 0; i < kCycles; ++i) {
      const double time = timeOf([&] {
        round.follow();
        round.goAndPost();
      });
      cycles[i] = std::min(cycles[i], time);
      total += time;
      if (i % static_cast<size_t>(every) != 0)
        continue;
      double &call = calls[i / static_cast<size_t>(every)];
      call = std::min(call, timeOf([&] { round.planNow(every); }));
    }
    lines = round.lines();
    corners = round.corners();
    if (round.failed())
      state.SkipWithError("the group has failed");
    state.SetIterationTime(total * 1e-6);
  }
  std::sort(cycles.begin(), cycles.end());
  std::sort(calls.begin(), calls.end());
  countCycles(state, cycles, lines, corners);
  state.counters["call_mean_us"] = sumOf(calls) / static_cast<double>(calls.size());
  state.counters["call_p999_us"] = quantile(calls, 0.999);
}
BENCHMARK(cyclesBesideAPlanner)
    ->ArgsProduct({{2, 3}, {1, 4}})
    ->ArgNames({"machine", "every"})
    ->UseManualTime()
    ->Iterations(5);

/// A cycle of 100 groups of Scaras.
void hundredScaras(benchmark::State &state) {
  std::vector<std::unique_ptr<Round>> rounds;
  for (int i = 0; i < 100; ++i)
    rounds.push_back(std::make_unique<Round>(stride::test::scara(), false));
  for (auto _ : state)
    for (const std::unique_ptr<Round> &round : rounds) {
      round->think();
      round->go();
    }
  state.counters["groups"] = 100;
}
BENCHMARK(hundredScaras)->Unit(benchmark::kMicrosecond)->Iterations(2000);

} // namespace
