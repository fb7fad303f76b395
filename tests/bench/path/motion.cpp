// path_motion FILE.cnc: drives a program by the motion of runtime/numeric/path, cycle by cycle,
// with the geometry of tests/oracle/path, and compares its time with the shortest there is.
#include "runtime/numeric/path/motion.hpp"
#include "tests/bench/path/settings.hpp"
#include "tests/oracle/path/blended_path.hpp"
#include "tests/oracle/path/path_check.hpp"
#include "tests/oracle/path/reference_planner.hpp"
#include "tests/oracle/path/time_optimum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace stride::oracle;
namespace path = stride::path;
using stride::exact::kInfinity;

struct Outcome {
  double time = 0;
  int rests = 0;                          ///< Cycles in which it stood still on the way.
  double ceiling = 0, axes = 0, jerk = 0; ///< The worst uses of limits.
  bool arrived = true;
};

std::vector<path::Strip> stripsOf(const std::vector<Cell> &fields) {
  std::vector<path::Strip> strips;
  double way = 0;
  for (const Cell &field : fields) {
    way += field.length;
    strips.push_back({way, kInfinity, kInfinity, field.ceiling, kInfinity, kInfinity, kInfinity,
                      field.tangential, field.curvature, 0.0F, 0, false, false});
  }
  strips.back().stop = true;
  return strips;
}

/// Goes over one run between two stops, a new motion in cycles of 1 ms.
void drive(const std::vector<path::Strip> &strips, double jerk, int32_t budget, Outcome &outcome) {
  constexpr double kCycle = 0.001;
  constexpr int kPatience = 5000; // cycles at rest
  const auto motion = std::make_unique<path::Motion>();
  path::reset(*motion, {path::LawKind::Jerk, jerk, 1, false});
  std::vector<Sample> samples;
  size_t known = 0;
  size_t at = 0;
  double time = 0;
  for (int patience = kPatience; patience > 0;) {
    while (known < strips.size() && path::extend(*motion, strips[known]))
      ++known;
    path::think(*motion, budget);
    const path::WayState state = path::move(*motion, kCycle, true);
    if (state.way > 0.0)
      samples.push_back({time += kCycle, state.way, {state.way}});
    while (at + 1 < strips.size() && state.way > strips[at].end)
      ++at;
    const double square = state.velocity * state.velocity;
    outcome.ceiling = std::max(outcome.ceiling, square / strips[at].ceiling);
    outcome.axes = std::max(outcome.axes, strips[at].along * std::fabs(state.acceleration) +
                                              strips[at].across * square);
    if (!path::isAtRest(*motion))
      patience = kPatience;
    else if (state.way >= strips.back().end)
      break;
    else {
      --patience;
      ++outcome.rests;
    }
  }
  MotionLimits limits;
  limits.jerk = jerk;
  outcome.jerk = std::max(outcome.jerk, checkMotion(samples, limits).jerk.use);
  outcome.time += time;
  outcome.arrived = outcome.arrived && motion->way == strips.back().end;
}

int run(const Settings &settings) {
  CurveLimits limits;
  limits.velocity = settings.values.at("--velocity");
  limits.axisAcceleration.fill(settings.values.at("--acceleration"));
  const double jerk = settings.values.at("--jerk");
  const std::vector<ProgramMove> moves = movesOf(settings.file);
  Outcome outcome;
  double best = 0;
  for (const BlendedPath &run : blendedPaths(moves, settings.values.at("--tolerance"), limits)) {
    const std::vector<Cell> cells = cellsOfRun(run, limits, settings);
    best += timeOptimum(cells, jerk).time;
    drive(stripsOf(fieldsOf(cells, 1.1)), jerk,
          static_cast<int32_t>(settings.values.at("--budget")), outcome);
  }
  fmt::print(
      "{:.3f} s, {:.3f} of the optimum; {} cycles at rest on the way{}; uses: ceiling {:.7f}, "
      "axes {:.7f}, jerk {:.7f}\n",
      outcome.time, outcome.time / best, outcome.rests, outcome.arrived ? "" : ", NOT ARRIVED",
      outcome.ceiling, outcome.axes, outcome.jerk);
  return outcome.arrived ? 0 : 1;
}

} // namespace

int main(int argc, char **argv) {
  try {
    const Settings settings = settingsOf(argc, argv);
    if (!settings.file.empty())
      return run(settings);
    fmt::print(stderr, "path_motion FILE.cnc [--budget STEPS] {}\n", kOptions);
  } catch (const std::exception &error) {
    fmt::print(stderr, "path_motion: {}\n", error.what());
  }
  return 2;
}
