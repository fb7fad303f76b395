// The planner of single axes beside Ruckig (Lars Berscheid, MIT licence), which is no part of
// Stride: compare_planner.py builds this against a checkout of it.
#include "runtime/numeric/profile/planner.hpp"

#include <ruckig/ruckig.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

namespace motion = stride::motion;

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

[[noreturn]] void fail(const char *what) {
  std::fprintf(stderr, "compare_planner: %s\n", what);
  std::exit(1);
}

/// What the axis shall do.
struct Task {
  motion::State start;
  double target;
  double endVelocity;
  motion::Dynamics dynamics;
};

/// A family of tasks.
struct Kind {
  const char *name;
  bool moves;  ///< Else it starts at rest.
  bool passes; ///< Else it ends at rest.
  bool unlike; ///< Acceleration and deceleration differ.
  /// Only what turns: Ruckig has the weaker one of both for all, so that ours may be sooner.
  bool turns = false;
};

/// Limits of any proportion; a state from which, and a velocity with which, the limits can be kept.
Task taskOf(Random &random, const Kind &kind) {
  for (;;) {
    Task task{};
    motion::Dynamics &d = task.dynamics;
    d.ramp = motion::RampType::Parabolic;
    d.velocity = random.logIn(20, 400);
    d.acceleration = d.velocity * random.logIn(1, 20);
    d.deceleration = kind.unlike ? d.velocity * random.logIn(1, 20) : d.acceleration;
    d.jerk = d.acceleration * random.logIn(2, 50);
    task.start.position = random.in(-180, 180);
    task.target = task.start.position + random.logIn(0.01, 1) * random.in(-180, 180);
    if (kind.passes)
      task.endVelocity = random.in(-1, 1) * d.velocity;
    if (!kind.moves)
      return task;
    const double weaker = std::min(d.acceleration, d.deceleration);
    task.start.acceleration = random.in(-weaker, weaker);
    const double swing = 0.5 * task.start.acceleration * task.start.acceleration / d.jerk;
    if (!(d.velocity > swing))
      continue;
    task.start.velocity = random.in(-1, 1) * (d.velocity - swing);
    return task;
  }
}

using Input = ruckig::InputParameter<1>;
using Trajectory = ruckig::Trajectory<1>;

/// Ruckig's limits hold for rising and for falling velocities: ours for magnitudes. They mean the
/// same while the velocity has the sign `side`; 0: the weaker one of both holds for all.
Input inputOf(const Task &task, double side) {
  Input input;
  input.current_position[0] = task.start.position;
  input.current_velocity[0] = task.start.velocity;
  input.current_acceleration[0] = task.start.acceleration;
  input.target_position[0] = task.target;
  input.target_velocity[0] = task.endVelocity;
  input.max_velocity[0] = task.dynamics.velocity;
  input.max_acceleration[0] = task.dynamics.acceleration;
  input.max_jerk[0] = task.dynamics.jerk;
  if (side == 0) {
    input.max_acceleration[0] = std::min(task.dynamics.acceleration, task.dynamics.deceleration);
  } else if (task.dynamics.acceleration != task.dynamics.deceleration) {
    input.max_acceleration[0] = side > 0 ? task.dynamics.acceleration : task.dynamics.deceleration;
    input.min_acceleration = {side > 0 ? -task.dynamics.deceleration : -task.dynamics.acceleration};
  }
  return input;
}

/// Whether all of it goes one way.
bool staysOn(const Task &task, const Trajectory &trajectory, double side) {
  const double rate = task.start.acceleration;
  if ((task.start.velocity + rate * std::fabs(rate) / (2 * task.dynamics.jerk)) * side < 0)
    return false; // the acceleration at the start turns it
  const double duration = trajectory.get_duration();
  for (int i = 0; i <= 1000; ++i) {
    double position = 0;
    double velocity = 0;
    double acceleration = 0;
    trajectory.at_time(duration * i / 1000, position, velocity, acceleration);
    if (velocity * side < -1e-9)
      return false;
  }
  return true;
}

/// Times of single calls, of each task the shortest of several. [ns]
class Clock {
public:
  Clock() {
    for (int i = 0; i < 1000; ++i)
      own_ = std::min(own_, of([] {}));
  }
  template <class Call> double of(Call call) const {
    const auto begin = std::chrono::steady_clock::now();
    call();
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::nano>(end - begin).count() - own_;
  }

private:
  double own_ = 0;
};

struct Times {
  std::vector<double> all;
  double mean() const {
    double sum = 0;
    for (const double time : all)
      sum += time;
    return sum / static_cast<double>(all.size());
  }
  double at(double part) {
    const auto place = static_cast<int64_t>(part * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), all.begin() + place, all.end());
    return all[static_cast<size_t>(place)];
  }
};

/// Quotients of durations, ours over Ruckig's.
struct Ratios {
  size_t number = 0;
  size_t refused = 0;
  size_t longer = 0;
  double most = 0;
  double least = HUGE_VAL;

  void add(const Task &task, double ours, double theirs) {
    const double ratio = ours / theirs;
    ++number;
    most = std::max(most, ratio);
    least = std::min(least, ratio);
    if (!(ratio > 1 + 1e-9))
      return;
    if (++longer <= 5)
      std::fprintf(
          stderr,
          "longer by %.3g: {%.17g, %.17g, %.17g} to %.17g with %.17g; %.17g %.17g %.17g %.17g\n",
          ratio - 1, task.start.position, task.start.velocity, task.start.acceleration, task.target,
          task.endVelocity, task.dynamics.velocity, task.dynamics.acceleration,
          task.dynamics.deceleration, task.dynamics.jerk);
  }
};

/// Whether ours is never longer.
bool compare(const Kind &kind, int count, uint64_t seed) {
  constexpr int kBlock = 500;
  constexpr int kRuns = 9;
  Random random(seed);
  const Clock clock;
  ruckig::Ruckig<1> generator;
  Trajectory trajectory;
  motion::Profile profile{};
  Ratios ratios;
  Times ours;
  Times theirs;
  std::vector<Task> tasks(kBlock);
  std::vector<Input> inputs(kBlock);
  for (int done = 0; done < count; done += kBlock) {
    std::vector<double> our(kBlock, HUGE_VAL);
    std::vector<double> their(kBlock, HUGE_VAL);
    size_t compared = 0;
    for (size_t i = 0; i < kBlock; ++i) {
      const Task task = taskOf(random, kind);
      const double side =
          task.start.velocity != 0 ? task.start.velocity : task.target - task.start.position;
      const Input input = inputOf(task, kind.turns ? 0 : side);
      if (planMove(profile, task.start, task.target, task.endVelocity, task.dynamics) !=
          motion::PlanError::None)
        fail("there is no profile");
      if (profile.end.position != task.target || profile.end.velocity != task.endVelocity ||
          profile.end.acceleration != 0)
        fail("a profile does not end at its target");
      if (generator.calculate(input, trajectory) < 0) {
        ++ratios.refused;
        continue;
      }
      if (kind.unlike && staysOn(task, trajectory, side) == kind.turns)
        continue;
      ratios.add(task, profile.duration, trajectory.get_duration());
      tasks[compared] = task;
      inputs[compared++] = input;
    }
    for (int run = 0; run < kRuns; ++run) {
      for (size_t i = 0; i < compared; ++i) {
        const Task &task = tasks[i];
        our[i] = std::min(our[i], clock.of([&] {
          (void)planMove(profile, task.start, task.target, task.endVelocity, task.dynamics);
        }));
      }
      for (size_t i = 0; i < compared; ++i)
        their[i] =
            std::min(their[i], clock.of([&] { (void)generator.calculate(inputs[i], trajectory); }));
    }
    our.resize(compared);
    their.resize(compared);
    ours.all.insert(ours.all.end(), our.begin(), our.end());
    theirs.all.insert(theirs.all.end(), their.begin(), their.end());
  }
  std::printf("| %s | %zu | %.9f | %.9f | %zu | %zu | %.0f / %.0f = %.2f | %.0f / %.0f = %.2f |\n",
              kind.name, ratios.number, ratios.least, ratios.most, ratios.longer, ratios.refused,
              ours.mean(), theirs.mean(), ours.mean() / theirs.mean(), ours.at(0.999),
              theirs.at(0.999), ours.at(0.999) / theirs.at(0.999));
  std::fflush(stdout);
  return ratios.longer == 0;
}

constexpr Kind kKinds[] = {
    {"rest to rest", false, false, false},
    {"any state to rest", true, false, false},
    {"any state to any velocity", true, true, false},
    {"rest to rest, A ≠ D", false, false, true},
    {"any state to rest, A ≠ D", true, false, true},
    {"any state to any velocity, A ≠ D", true, true, true},
    {"turning to rest, A ≠ D, Ruckig with the weaker", true, false, true, true},
    {"turning to any velocity, A ≠ D, Ruckig with the weaker", true, true, true, true},
};

} // namespace

int main(int argc, char **argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 100000;
  if (count < 1000)
    fail("at least 1000 moves");
  std::puts("| moves | number | least | most | longer | refused | mean [ns] | p99.9 [ns] |");
  std::puts("|---|---:|---:|---:|---:|---:|---:|---:|");
  uint64_t seed = 1;
  bool good = true;
  for (const Kind &kind : kKinds)
    good = compare(kind, count, seed++) && good;
  return good ? 0 : 1;
}
