// path_optimum FILE.cnc: the shortest time that a program can take with blended corners, by the
// oracle of tests/oracle/path alone. The program is one of programs.py or from_linuxcnc.py.
#include "tests/bench/path/settings.hpp"
#include "tests/oracle/path/blended_path.hpp"
#include "tests/oracle/path/time_optimum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace stride::oracle;

int run(const Settings &settings) {
  const std::vector<ProgramMove> moves = movesOf(settings.file);
  CurveLimits limits;
  limits.velocity = settings.values.at("--velocity");
  limits.axisAcceleration.fill(settings.values.at("--acceleration"));
  const double jerk = settings.values.at("--jerk");
  double best = 0;
  double passes = 0;
  double bound = 0;
  size_t cellCount = 0;
  double excess = -1;
  const std::vector<BlendedPath> paths =
      blendedPaths(moves, settings.values.at("--tolerance"), limits);
  for (const BlendedPath &path : paths) {
    const std::vector<Cell> cells = cellsOfRun(path, limits, settings);
    const Optimum optimum = timeOptimum(cells, jerk);
    if (!optimum.solved)
      fmt::print(stderr, "a part of {} cells is not solved\n", cells.size());
    best += optimum.time;
    passes += accelerationOptimum(cells).time;
    bound += lowerBound(cells, jerk);
    cellCount += cells.size();
    const Excess over = excessOf(cells, jerk, optimum.squares);
    excess = std::max({excess, over.ceiling, over.acceleration, over.jerk});
  }
  fmt::print("{} moves, {} parts, {} cells: optimum {:.3f} s, without jerk {:.3f} s, lower bound "
             "{:.3f} s, excess {:.1e}\n",
             moves.size(), paths.size(), cellCount, best, passes, bound, excess);
  return 0;
}

} // namespace

int main(int argc, char **argv) {
  try {
    const Settings settings = settingsOf(argc, argv);
    if (!settings.file.empty())
      return run(settings);
    fmt::print(stderr, "path_optimum FILE.cnc {}\n", kOptions);
  } catch (const std::exception &error) {
    fmt::print(stderr, "path_optimum: {}\n", error.what());
  }
  return 2;
}
