// The root of a function between two arguments: where it is, and with how many looks at the
// function, which is in the cyclic path.
#include "runtime/numeric/profile/bracketed_root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

using stride::motion::bracketedRoot;

struct Problem {
  const char *name;
  std::function<double(double)> function; ///< Rises.
  double low, high, root;
};

const Problem kProblems[] = {
    {"line", [](double x) { return 3 * x - 1; }, -4, 9, 1.0 / 3},
    {"cube", [](double x) { return x * x * x - 2; }, 0, 5, 1.2599210498948732},
    {"square root", [](double x) { return std::sqrt(x) - 1.5; }, 0, 100, 2.25},
    {"square", [](double x) { return x * x + 3 * x - 40; }, 1, 70, 5},
    {"exponential", [](double x) { return std::exp(x) - 20; }, -3, 8, 2.995732273553991},
    {"at its upper end", [](double x) { return x - 7; }, 2, 7, 7},
};

TEST(BracketedRoot, IsFoundToTheLastDigitsWithFewLooks) {
  for (const Problem &p : kProblems)
    // The values may be small or large: millimetres, increments, light years.
    for (const double scale : {1e-9, 1e-3, 1.0, 1e4, 1e12}) {
      int looks = 0;
      const auto look = [&](double x) {
        ++looks;
        return scale * p.function(x);
      };
      EXPECT_NEAR(bracketedRoot(look, p.low, p.high), p.root, 4e-16 * std::fabs(p.root))
          << p.name << ' ' << scale;
      EXPECT_LE(looks, 16) << p.name << ' ' << scale << ": halving would take 53";
    }
}

TEST(BracketedRoot, OfAJumpIsWhereItJumps) {
  for (const double jump : {0.1, 0.5, 0.93}) {
    const double found = bracketedRoot([&](double x) { return x < jump ? -1.0 : 3.0; }, 0.0, 1.0);
    EXPECT_NEAR(found, jump, 1e-15);
  }
}

} // namespace
