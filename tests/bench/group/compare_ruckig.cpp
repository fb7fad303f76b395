// Movements of seven axes beside those of Ruckig (Lars Berscheid, MIT licence), which is no part of
// Stride: compare_ruckig.py builds this against a checkout of it.
#include "runtime/numeric/group/group_motion.hpp"
#include "runtime/numeric/kinematics/any_kinematics.hpp"

#include <ruckig/ruckig.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

namespace {

namespace group = stride::group;
namespace path = stride::path;
using group::kAxes;

constexpr int kJoints = 7;
constexpr double kCycle = 0.001; // [s]

/// The same numbers everywhere.
class Random {
public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double logIn(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }

private:
  std::mt19937_64 engine_;
};

/// Limits of the axes, and where they go. [°]
struct Problem {
  group::AxisLimits limits[kAxes]{};
  double from[kAxes]{}, to[kAxes]{};
};

/// `alike`: of axes as robots have them; else any limits beside each other.
Problem problemOf(Random &random, bool alike) {
  Problem problem;
  const double scale = random.logIn(0.01, 1);
  for (int k = 0; k < kJoints; ++k) {
    group::AxisLimits &axis = problem.limits[k];
    axis.velocity = alike ? random.in(100, 200) : random.logIn(20, 400);
    axis.acceleration = axis.velocity * (alike ? random.in(4, 8) : random.logIn(1, 20));
    axis.jerk = axis.acceleration * (alike ? random.in(8, 16) : random.logIn(2, 50));
    axis.low = -1e4;
    axis.high = 1e4;
    problem.from[k] = random.in(-180, 180);
    problem.to[k] = problem.from[k] + scale * random.in(-180, 180);
  }
  return problem;
}

using Clock = std::chrono::steady_clock;
double microsecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

/// Of many calls the median, so that what else the machine does does not count.
class Cost {
public:
  template <class Call> auto of(Call call) {
    const auto begin = Clock::now();
    auto result = call();
    times_.push_back(microsecondsSince(begin));
    return result;
  }
  double median() {
    const auto middle = times_.begin() + static_cast<int64_t>(times_.size() / 2);
    std::nth_element(times_.begin(), middle, times_.end());
    return *middle;
  }

private:
  std::vector<double> times_;
};

[[noreturn]] void fail(const char *what) {
  std::fprintf(stderr, "compare_ruckig: %s\n", what);
  std::exit(1);
}

struct Machine {
  stride::kinematics::AnyKinematics none{};
  group::Arm arm(const Problem &problem) const {
    return {none.ref(), group::kArmAxes, kJoints - group::kArmAxes, problem.limits, {}};
  }
};
const Machine kMachine;

group::Leg legOf(const Problem &problem, const double (&from)[kAxes], const double (&to)[kAxes]) {
  double perTime[kAxes];
  for (int k = 0; k < kAxes; ++k)
    perTime[k] = k < kJoints ? problem.limits[k].velocity : 1.0;
  return group::axesLeg(from, to, perTime, 1.0);
}

/// How long a movement takes that is known as a whole. [s]
double lawOf(const Problem &problem, path::Course &course, path::Plan &plan) {
  const group::Leg leg = legOf(problem, problem.from, problem.to);
  const group::Track track{&leg,
                           [](const void *it, const group::Series &way, group::PathPlace &place) {
                             placeAt(*static_cast<const group::Leg *>(it), way, place);
                           }};
  group::Look look{};
  look.to = leg.length;
  look.least = leg.length;
  path::Strip strip{};
  if (limitStrip(kMachine.arm(problem), track, {1, 1, 1, 1}, look, strip) != group::Obstacle::None)
    fail("a straight leg cannot be driven");
  strip.end = leg.length;
  strip.stop = true;
  course.first = course.next = 0;
  course.begin = 0;
  (void)append(course, strip, 0);
  path::PlanTask task{};
  task.end = task.limit = stride::exact::kInfinity;
  task.jerk = 1e30;
  task.cellTime = 0.002;
  task.share = task.override = task.before = task.rampPart = 1;
  task.cells = path::kCells;
  begin(plan, course, task);
  while (plan.state == path::PlanState::Working)
    (void)work(plan, course, 1000);
  if (plan.state != path::PlanState::Done)
    fail("there is no plan");
  double time = 0;
  for (int32_t i = 0; i < pieceCount(plan); ++i)
    time += pieceOf(plan, i).duration;
  return time;
}

/// A group that is driven in cycles, as an application does.
class Driven {
public:
  explicit Driven(const Problem &problem)
      : problem_(problem), group_(std::make_unique<group::GroupMotion>()) {
    reset(*group_, problem.from);
  }
  void add(const double (&from)[kAxes], const double (&to)[kAxes], double corner) {
    group::Order order{};
    order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1;
    order.transition = corner > 0 ? group::Transition::Distance : group::Transition::None;
    order.transitionValue = corner;
    append(*group_, drawId(*group_), legOf(problem_, from, to), order);
  }
  /// Until rest, or for at most `most`; how long that took. [s]
  double run(bool stop, double most = 1000) {
    int64_t cycles = 0;
    do {
      cycle(*group_, kMachine.arm(problem_), {kCycle, 1, stop, 0, 64, 24});
      ++cycles;
      judge();
    } while (static_cast<double>(cycles) * kCycle < most && !isOver(stop));
    return static_cast<double>(cycles) * kCycle;
  }
  void forget() { clear(*group_); }
  const group::GroupMotion &state() const { return *group_; }
  static double worst() { return worst_; }

private:
  bool isOver(bool stop) const {
    return isAtRest(*group_) && (stop || group_->first == group_->next);
  }
  void judge() {
    if (group_->obstacle != group::Obstacle::None)
      fail("a movement has failed");
    for (int k = 0; k < kJoints; ++k)
      worst_ = std::max({worst_, std::fabs(group_->velocity[k]) / problem_.limits[k].velocity,
                         std::fabs(group_->acceleration[k]) / problem_.limits[k].acceleration});
  }
  const Problem &problem_;
  std::unique_ptr<group::GroupMotion> group_;
  static inline double worst_ = 0; ///< Use of limits, of all that have been driven.
};

using Input = ruckig::InputParameter<kJoints>;

Input inputOf(const Problem &problem, ruckig::Synchronization synchronization) {
  Input input;
  for (int k = 0; k < kJoints; ++k) {
    const auto i = static_cast<size_t>(k);
    input.current_position[i] = problem.from[k];
    input.target_position[i] = problem.to[k];
    input.max_velocity[i] = problem.limits[k].velocity;
    input.max_acceleration[i] = problem.limits[k].acceleration;
    input.max_jerk[i] = problem.limits[k].jerk;
  }
  input.synchronization = synchronization;
  return input;
}

/// Ruckig's, with what it costs.
struct Peer {
  ruckig::Ruckig<kJoints> generator;
  ruckig::Trajectory<kJoints> trajectory;
  Cost cost;
  int refused = 0;

  /// [s]; negative: it has found none.
  double plan(const Input &input) {
    const ruckig::Result result = cost.of([&] { return generator.calculate(input, trajectory); });
    if (result >= 0)
      return trajectory.get_duration();
    ++refused;
    return -1;
  }
};

/// Quotients of durations.
class Ratios {
public:
  void add(double ours, double theirs) {
    if (theirs > 0)
      ratios_.push_back(ours / theirs);
  }
  void print(const char *what) {
    std::sort(ratios_.begin(), ratios_.end());
    double sum = 0;
    for (const double ratio : ratios_)
      sum += ratio;
    const auto at = [this](double part) {
      return ratios_[static_cast<size_t>(part * static_cast<double>(ratios_.size() - 1))];
    };
    const auto equal = std::upper_bound(ratios_.begin(), ratios_.end(), 1.0001) - ratios_.begin();
    std::printf("| %s | %zu | %.4f | %.4f | %.3f | %.3f | %.3f | %.1f %% |\n", what, ratios_.size(),
                sum / static_cast<double>(ratios_.size()), at(0.0), at(0.5), at(0.99), at(1.0),
                100.0 * static_cast<double>(equal) / static_cast<double>(ratios_.size()));
  }

private:
  std::vector<double> ratios_;
};

void fromRestToRest(int moves, bool alike) {
  Random random(alike ? 1 : 2);
  const auto course = std::make_unique<path::Course>();
  const auto plan = std::make_unique<path::Plan>();
  Peer byTime;
  Peer byPhase;
  Ratios toTime;
  Ratios toPhase;
  Ratios driven;
  Cost cost;
  for (int i = 0; i < moves; ++i) {
    const Problem problem = problemOf(random, alike);
    const double ours = cost.of([&] { return lawOf(problem, *course, *plan); });
    const double time = byTime.plan(inputOf(problem, ruckig::Synchronization::Time));
    toTime.add(ours, time);
    toPhase.add(ours, byPhase.plan(inputOf(problem, ruckig::Synchronization::Phase)));
    if (i % 20 != 0)
      continue;
    Driven group(problem);
    group.add(problem.from, problem.to, 0);
    driven.add(group.run(false), time);
  }
  const char *const kind = alike ? "limits alike" : "any limits";
  std::printf("| rest to rest, %s | | | | | | | |\n", kind);
  toTime.print("- to Ruckig, synchronised in time");
  toPhase.print("- to Ruckig, in phase where it can");
  driven.print("- driven in cycles of 1 ms, to the first");
  std::fprintf(
      stderr, "%s: us per plan %.2f, Ruckig %.2f in time, %.2f in phase (refused %d, %d)\n", kind,
      cost.median(), byTime.cost.median(), byPhase.cost.median(), byTime.refused, byPhase.refused);
}

/// Another target while the axes move: ours come to rest on their path, and go from there.
void anotherTarget(int moves) {
  Random random(3);
  Peer peer;
  Ratios ratios;
  for (int i = 0; i < moves; ++i) {
    Problem problem = problemOf(random, true);
    Driven group(problem);
    group.add(problem.from, problem.to, 0);
    const double whole = peer.plan(inputOf(problem, ruckig::Synchronization::Time));
    (void)group.run(false, random.in(0.1, 0.7) * whole);
    if (isAtRest(group.state()))
      continue;
    Input input = inputOf(problem, ruckig::Synchronization::Time);
    double to[kAxes]{};
    for (int k = 0; k < kJoints; ++k) {
      const auto n = static_cast<size_t>(k);
      to[k] = problem.to[k] + random.in(-60, 60);
      input.current_position[n] = group.state().axes[k];
      input.current_velocity[n] = group.state().velocity[k];
      input.current_acceleration[n] = group.state().acceleration[k];
      input.target_position[n] = to[k];
    }
    double time = group.run(true);
    double from[kAxes];
    std::copy(group.state().axes, group.state().axes + kAxes, from);
    group.forget();
    group.add(from, to, 0);
    time += group.run(false);
    ratios.add(time, peer.plan(input));
  }
  ratios.print("another target on the way, driven");
}

/// Over places in between: ours through corners, Ruckig from rest to rest.
void overPlaces(int moves) {
  constexpr int kPlaces = 6;
  Random random(4);
  Peer peer;
  Ratios ratios;
  for (int i = 0; i < moves; ++i) {
    Problem problem = problemOf(random, true);
    Driven group(problem);
    double theirs = 0;
    double last[kAxes];
    std::copy(problem.from, problem.from + kAxes, last);
    for (int n = 0; n < kPlaces; ++n) {
      double to[kAxes]{};
      for (int k = 0; k < kJoints; ++k)
        to[k] = last[k] + random.in(-60, 60);
      group.add(last, to, n > 0 ? 15 : 0);
      Problem one = problem;
      std::copy(last, last + kAxes, one.from);
      std::copy(to, to + kAxes, one.to);
      theirs += peer.plan(inputOf(one, ruckig::Synchronization::Time));
      std::copy(to, to + kAxes, last);
    }
    ratios.add(group.run(false), theirs);
  }
  ratios.print("six places with corners of 15, to Ruckig with rests");
}

} // namespace

int main(int argc, char **argv) {
  const int moves = argc > 1 ? std::atoi(argv[1]) : 100000;
  if (moves < 1000)
    fail("at least 1000 movements");
  std::puts("| movements | number | mean | least | median | p99 | most | not longer |");
  std::puts("|---|---:|---:|---:|---:|---:|---:|---:|");
  fromRestToRest(moves, true);
  fromRestToRest(moves, false);
  anotherTarget(moves / 50);
  overPlaces(moves / 50);
  std::fprintf(stderr, "greatest use of limits of velocity and acceleration in cycles: %.9f\n",
               Driven::worst());
}
