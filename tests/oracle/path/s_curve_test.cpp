// The textbook's formulas against numeric integration.
#include "tests/oracle/path/s_curve.hpp"

#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace stride::oracle;
using stride::test::Random;

TEST(SCurve, PhasesLeadFromVelocityToVelocityWithinTheLimits) {
  for (uint64_t seed = 0; seed < 300 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double from = random.chance(0.2) ? 0.0 : random.magnitude(-3, 3);
    const double to = random.chance(0.2) ? 0.0 : random.magnitude(-3, 3);
    const double acceleration = random.magnitude(-1, 4);
    const double jerk = random.magnitude(0, 6);
    const double start = random.uniform(-5, 5);
    double time = 0;
    double greatest = 0;
    Phase state{0, 0, start, from, 0};
    for (const Phase &phase : changePhases(start, from, to, acceleration, jerk)) {
      const double size = from + to;
      EXPECT_NEAR(phase.velocity, state.velocity, 1e-12 * size);
      EXPECT_NEAR(phase.way, state.way, 1e-12 * (std::fabs(state.way) + std::fabs(start)));
      EXPECT_LE(std::fabs(phase.jerk), jerk);
      state = after(phase, phase.duration);
      greatest = std::max(greatest, std::fabs(state.acceleration));
      time += phase.duration;
    }
    EXPECT_LE(greatest, acceleration * (1 + 1e-12));
    EXPECT_NEAR(state.acceleration, 0, 1e-9 * acceleration);
    EXPECT_NEAR(state.velocity, to, 1e-10 * (from + to));
    const double way = changeWay(from, to, acceleration, jerk);
    EXPECT_NEAR(state.way - start, way, 1e-10 * (way + 5));
    EXPECT_NEAR(time, changeTime(to - from, acceleration, jerk), 1e-12 * time);
  }
}

TEST(SCurve, StateAfterATimeIsWhatIntegrationGives) {
  const Phase phase{2.0, -3.0, 7.0, 11.0, 5.0};
  double way = phase.way;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) * phase.duration / kSteps;
    way += (11.0 + 5.0 * t - 1.5 * t * t) * phase.duration / kSteps;
  }
  const Phase end = after(phase, phase.duration);
  EXPECT_NEAR(end.way, way, 1e-6);
  EXPECT_DOUBLE_EQ(end.velocity, 15.0);
  EXPECT_DOUBLE_EQ(end.acceleration, -1.0);
}

/// V = 250, A = 1750, J = 50000: the acceleration is reached from 61.25 u/s on.
TEST(SCurve, RestToRestHasThreeCases) {
  const double ramp = 61.25 * (2 * 1750.0 / 50000.0); // = 4.2875: just no constant acceleration
  EXPECT_NEAR(restToRestTime(ramp, 250, 1750, 50000), 4 * 0.035, 1e-14);
  EXPECT_NEAR(restToRestTime(ramp / 8, 250, 1750, 50000), 2 * 0.035, 1e-14);
  EXPECT_NEAR(restToRestTime(ramp * 1.000001, 250, 1750, 50000), 0.14, 1e-6);
  const double full = 250 * (250 / 1750.0 + 1750 / 50000.0); // just reaches the velocity
  EXPECT_NEAR(restToRestTime(full, 250, 1750, 50000), 2 * (250 / 1750.0 + 0.035), 1e-14);
  EXPECT_NEAR(restToRestTime(full + 25, 250, 1750, 50000), 2 * (250 / 1750.0 + 0.035) + 0.1, 1e-14);
  EXPECT_NEAR(restToRestTime(full * 0.999999, 250, 1750, 50000), 2 * (250 / 1750.0 + 0.035), 1e-6);
  const double peak = 100; // in between: 100 u/s
  EXPECT_NEAR(restToRestTime(peak * (peak / 1750 + 0.035), 250, 1750, 50000),
              2 * (peak / 1750 + 0.035), 1e-14);
  // The velocity is reached before the acceleration is.
  EXPECT_NEAR(restToRestTime(10, 2, 1750, 50), 2 * 2 * 0.2 + (10 - 2 * 0.4) / 2, 1e-14);
}

} // namespace
