// What path_optimum and path_motion have in common: their options, and the cells of a run.
#ifndef STRIDE_TESTS_BENCH_PATH_SETTINGS_HPP
#define STRIDE_TESTS_BENCH_PATH_SETTINGS_HPP

#include "tests/oracle/path/blended_path.hpp"

#include <map>
#include <string>
#include <vector>

namespace stride::oracle {

inline constexpr const char *kOptions =
    "[--tolerance U] [--velocity V] [--acceleration A] [--jerk J] [--step S]";

struct Settings {
  std::map<std::string, double> values = {{"--tolerance", 0.1},     {"--velocity", 250},
                                          {"--acceleration", 1750}, {"--jerk", 50000},
                                          {"--step", 0.001},        {"--budget", 64}};
  std::string file;
};

inline Settings settingsOf(int argc, char **argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto found = settings.values.find(word);
    if (found == settings.values.end())
      settings.file = word;
    else if (i + 1 < argc)
      found->second = std::stod(argv[++i]);
  }
  return settings;
}

/// Cells of even time along a run between two stops.
inline std::vector<Cell> cellsOfRun(const BlendedPath &run, const CurveLimits &limits,
                                    const Settings &settings) {
  const size_t places = 100 + 40 * run.pieces() + static_cast<size_t>(20 * run.length());
  const std::vector<double> knots =
      timeKnots(run.curve(), run.length(), limits, settings.values.at("--step"), places);
  return cellsOf(run.curve(), knots, limits, 9);
}

} // namespace stride::oracle

#endif // STRIDE_TESTS_BENCH_PATH_SETTINGS_HPP
