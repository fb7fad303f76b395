// Random programs through objects, corner blends, velocity check, queue and interpolator with each
// law, sampled 16 times per cycle and judged by an independent checker: within all limits, without
// a jump, never back, to the very end, and not sooner than limits permit. Says every seed that
// fails, and goes on.
#include "tests/property/cnc_course_judge.hpp"

#include <gtest/gtest-spi.h>

#include <fmt/core.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace stride::test;
using stride::path::LawKind;

constexpr int kParts = 16;
constexpr const char *kLaws[] = {"TRAPEZOID", "SIGMOID", "QUADRATIC"};

struct Settings {
  uint64_t first = 0;
  uint64_t cases = 1000;
  int law = -1;               ///< -1: each.
  std::vector<uint64_t> more; ///< Seeds of a file.
};

/// What a case says when it fails; empty: it does not.
std::string drive(const Problem &problem, LawKind law, Figures &figures) {
  testing::TestPartResultArray results;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(
        testing::ScopedFakeTestPartResultReporter::INTERCEPT_ALL_THREADS, &results);
    Drive drive(problem, law, problem.cycle);
    drive.parts = kParts;
    drive.fill();
    drive.begin();
    const double time = drive.finish();
    EXPECT_GE(time, leastTime(problem, law) * (1 - 1e-9) - problem.cycle);
    judge(problem, drive, figures);
  }
  std::string text;
  for (int i = 0; i < results.size() && i < 3; ++i)
    text += results.GetTestPartResult(i).message() + std::string("\n");
  return text;
}

/// With every law that is asked for; how many of these drives fail.
int driveAll(const Settings &settings, uint64_t seed, Figures (&figures)[3]) {
  const Problem problem = randomCourse(seed);
  int failed = testing::Test::HasFailure() ? 1 : 0; // which says where
  for (int law = 0; law < 3; ++law) {
    if (settings.law >= 0 && settings.law != law)
      continue;
    const std::string text = drive(problem, static_cast<LawKind>(law), figures[law]);
    if (text.empty())
      continue;
    ++failed;
    fmt::print("seed {}, {}: {}", seed, kLaws[law], text);
    std::fflush(stdout);
  }
  return failed;
}

/// The seeds of a file: the first word of each line that is no comment.
std::vector<uint64_t> seedsOf(const std::string &name) {
  std::vector<uint64_t> seeds;
  std::ifstream file(name);
  if (!file)
    throw std::runtime_error("cannot read " + name);
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#')
      seeds.push_back(std::stoull(line));
  return seeds;
}

Settings settingsOf(int argc, char **argv) {
  Settings settings;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    const std::string value = argv[i + 1];
    if (option == "--cases")
      settings.cases = std::stoull(value);
    else if (option == "--first-seed")
      settings.first = std::stoull(value);
    else if (option == "--law")
      settings.law = std::stoi(value);
    else if (option == "--seeds")
      settings.more = seedsOf(value);
    else
      throw std::runtime_error("unknown option " + option);
  }
  return settings;
}

/// The exit code.
int run(const Settings &settings) {
  Figures figures[3];
  const auto begin = std::chrono::steady_clock::now();
  int failed = 0;
  for (uint64_t i = 0; i < settings.cases; ++i)
    failed += driveAll(settings, settings.first + i, figures);
  for (const uint64_t seed : settings.more)
    failed += driveAll(settings, seed, figures);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  fmt::print(
      "| law | programs | velocity | acceleration | jerk | axes' velocity | axes' acceleration |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n");
  for (int law = 0; law < 3; ++law) {
    const Figures &worst = figures[law];
    if (worst.cases > 0)
      fmt::print("| {} | {} | {:.7f} | {:.7f} | {:.7f} | {:.7f} | {:.7f} |\n", kLaws[law],
                 worst.cases, worst.velocity, worst.acceleration, worst.jerk, worst.axisVelocity,
                 worst.axisAcceleration);
  }
  if (settings.cases > 0)
    fmt::print("\nSeeds from {} to {}.", settings.first, settings.first + settings.cases - 1);
  if (!settings.more.empty())
    fmt::print("\n{} seeds that once failed.", settings.more.size());
  fmt::print("\n{} drives failed. {:.0f} s.\n", failed, time.count());
  return failed > 0 ? 1 : 0;
}

} // namespace

int main(int argc, char **argv) {
  testing::InitGoogleTest(&argc, argv);
  try {
    return run(settingsOf(argc, argv));
  } catch (const std::exception &error) {
    fmt::print(stderr, "path_random: {}\n{}\n", error.what(),
               "path_random [--cases N] [--first-seed N] [--law 0|1|2] [--seeds FILE]");
  }
  return 2;
}
