#include "runtime/numeric/profile/planner.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

using stride::motion::PlanError;
using stride::motion::Profile;
using stride::motion::RampType;
using stride::motion::State;

struct TrapezoidLimits {
  double velocity;
  double acceleration;
  double deceleration;
};

PlanError planTrapezoid(Profile &profile, double position, double velocity, double target,
                        const TrapezoidLimits &limits) {
  return stride::motion::planMove(
      profile, {position, velocity, 0}, target, 0,
      {RampType::Trapezoid, limits.velocity, limits.acceleration, limits.deceleration, 0});
}

PlanError planStop(Profile &profile, double position, double velocity, double deceleration) {
  return stride::motion::planStop(profile, {position, velocity, 0},
                                  {RampType::Trapezoid, 1, 1, deceleration, 0});
}

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Profile plan(double position, double velocity, double target, TrapezoidLimits limits) {
  Profile profile;
  EXPECT_EQ(planTrapezoid(profile, position, velocity, target, limits), PlanError::None);
  return profile;
}

TEST(Trapezoid, TriangleThatJustReachesTheLimit) {
  const Profile profile = plan(0, 0, 100, {100, 100, 100});
  EXPECT_EQ(profile.duration, 2.0);
  EXPECT_EQ(profile.at(0.5).position, 12.5);
  EXPECT_EQ(profile.at(1.0).position, 50.0);
  EXPECT_EQ(profile.at(1.0).velocity, 100.0);
  EXPECT_EQ(profile.at(1.5).velocity, 50.0);
  EXPECT_EQ(profile.at(1.5).acceleration, -100.0);
  EXPECT_EQ(profile.at(2.0).position, 100.0);
  EXPECT_EQ(profile.at(2.0).velocity, 0.0);
  EXPECT_EQ(profile.at(1e9).position, 100.0);
}

TEST(Trapezoid, CruisesWithDifferentRamps) {
  // Up in 1 s over 50, down in 2 s over 100, 850 at 100.
  const Profile profile = plan(0, 0, 1000, {100, 100, 50});
  EXPECT_EQ(profile.duration, 1.0 + 8.5 + 2.0);
  EXPECT_EQ(profile.count, 3);
  EXPECT_EQ(profile.at(5.0).velocity, 100.0);
  EXPECT_EQ(profile.at(5.0).acceleration, 0.0);
  EXPECT_EQ(profile.at(5.0).position, 450.0);
  EXPECT_EQ(profile.at(10.5).velocity, 50.0);
}

TEST(Trapezoid, NegativeDirectionIsTheMirrorImage) {
  const Profile there = plan(0, 10, 1000, {100, 70, 50});
  const Profile back = plan(0, -10, -1000, {100, 70, 50});
  EXPECT_EQ(there.duration, back.duration);
  for (double t = 0; t < there.duration; t += 0.01) {
    EXPECT_EQ(there.at(t).position, -back.at(t).position);
    EXPECT_EQ(there.at(t).velocity, -back.at(t).velocity);
  }
}

TEST(Trapezoid, StopsAndComesBackWhenTheTargetIsTooNear) {
  // From 100 u/s the axis needs 50 u to stop; 10 u are left.
  const Profile profile = plan(0, 100, 10, {100, 100, 100});
  EXPECT_EQ(profile.at(1.0).position, 50.0);
  EXPECT_EQ(profile.at(1.0).velocity, 0.0);
  EXPECT_DOUBLE_EQ(profile.duration, 1.0 + 2.0 * std::sqrt(40.0 / 100.0));
  EXPECT_EQ(profile.end.position, 10.0);
}

TEST(Trapezoid, TurnsRoundWhenMovingAway) {
  const Profile profile = plan(0, -100, 100, {1000, 100, 200});
  // Brakes 0.5 s over 25, then 125 from rest: peak^2 = 2 * 125 * 200 / 3.
  const double peak = std::sqrt(2.0 * 125.0 * 200.0 / 3.0);
  EXPECT_EQ(profile.at(0.5).position, -25.0);
  EXPECT_DOUBLE_EQ(profile.duration, 0.5 + peak / 100.0 + peak / 200.0);
  EXPECT_EQ(profile.end.position, 100.0);
}

TEST(Trapezoid, ReturnsToTheLimitMonotonically) {
  const Profile profile = plan(0, 300, 1000, {100, 500, 100});
  EXPECT_EQ(profile.at(0).velocity, 300.0);
  EXPECT_EQ(profile.at(1).velocity, 200.0);
  EXPECT_EQ(profile.at(2).velocity, 100.0);
  EXPECT_EQ(profile.at(2).position, 400.0);
  // 450 are needed to stop from 300, so 550 remain for the cruise.
  EXPECT_EQ(profile.duration, 2.0 + 5.5 + 1.0);
}

TEST(Trapezoid, ExactStopOnTheWay) {
  const Profile profile = plan(0, 100, 50, {100, 100, 100});
  EXPECT_EQ(profile.count, 1);
  EXPECT_EQ(profile.duration, 1.0);
  EXPECT_EQ(profile.at(0.5).position, 37.5);
}

TEST(Trapezoid, ReplanningOnTheBrakingRampDoesNotReverse) {
  const TrapezoidLimits limits{100, 100, 100};
  const Profile first = plan(0.1, 0, 333.3, limits);
  for (double t = first.duration - 0.999; t < first.duration - 0.01; t += 0.001) {
    const State state = first.at(t);
    const Profile second = plan(state.position, state.velocity, 333.3, limits);
    EXPECT_EQ(second.count, 1) << t;
    EXPECT_NEAR(second.duration, first.duration - t, 1e-9);
  }
}

TEST(Trapezoid, NothingToDo) {
  const Profile profile = plan(7.25, 0, 7.25, {1, 1, 1});
  EXPECT_EQ(profile.count, 0);
  EXPECT_EQ(profile.duration, 0.0);
  EXPECT_EQ(profile.at(0).position, 7.25);
  EXPECT_EQ(profile.at(-1).position, 7.25);
}

TEST(Trapezoid, NearRest) {
  for (const double offset : {1e-14, -1e-14, 1e-300, -5e-324}) {
    const Profile profile = plan(offset, 0, 0, {100, 100, 100});
    EXPECT_EQ(profile.end.position, 0.0);
    EXPECT_LE(profile.duration, 1e-7);
  }
  const Profile drifting = plan(0, 1e-14, 0, {100, 100, 100});
  EXPECT_LE(drifting.duration, 1e-15);
  EXPECT_EQ(drifting.at(1).position, 0.0);
}

TEST(Trapezoid, ScalesByPowersOfTwoBitForBit) {
  const Profile plain = plan(1.5, -20, 333.3, {100, 70, 55});
  const double k = std::ldexp(1.0, -400);
  const Profile tiny = plan(1.5 * k, -20 * k, 333.3 * k, {100 * k, 70 * k, 55 * k});
  EXPECT_EQ(plain.duration, tiny.duration);
  for (double t = 0; t < plain.duration; t += 0.0625) {
    EXPECT_EQ(plain.at(t).position * k, tiny.at(t).position);
    EXPECT_EQ(plain.at(t).velocity * k, tiny.at(t).velocity);
  }
}

TEST(Trapezoid, ExtremeButValidInputPlans) {
  EXPECT_EQ(plan(0, 0, 1e300, {1e300, 1e300, 1e300}).end.position, 1e300);
  EXPECT_EQ(plan(0, 0, 1e-300, {1e-300, 1e-300, 1e-300}).end.position, 1e-300);
  EXPECT_EQ(plan(0, 1e200, 1, {1, 1e200, 1e200}).end.position, 1.0);
  EXPECT_EQ(plan(0, 0, 1, {1e300, 1e-200, 1e50}).end.position, 1.0);
}

TEST(Trapezoid, InvalidInputIsReported) {
  Profile profile;
  for (const double bad : {kInf, -kInf, kNan}) {
    EXPECT_EQ(planTrapezoid(profile, bad, 0, 1, {1, 1, 1}), PlanError::InvalidState);
    EXPECT_EQ(planTrapezoid(profile, 0, bad, 1, {1, 1, 1}), PlanError::InvalidState);
    EXPECT_EQ(planTrapezoid(profile, 0, 0, bad, {1, 1, 1}), PlanError::InvalidState);
  }
  for (const double bad : {kInf, kNan, 0.0, -0.0, -1.0}) {
    EXPECT_EQ(planTrapezoid(profile, 0, 0, 1, {bad, 1, 1}), PlanError::InvalidLimit);
    EXPECT_EQ(planTrapezoid(profile, 0, 0, 1, {1, bad, 1}), PlanError::InvalidLimit);
    EXPECT_EQ(planTrapezoid(profile, 0, 0, 1, {1, 1, bad}), PlanError::InvalidLimit);
    EXPECT_EQ(profile.count, 0);
    EXPECT_EQ(planStop(profile, 0, 1, bad), PlanError::InvalidLimit);
  }
  EXPECT_EQ(planTrapezoid(profile, -1.7e308, 0, 1.7e308, {1, 1, 1}), PlanError::Unrepresentable);
  EXPECT_EQ(planTrapezoid(profile, 0, 0, 1e300, {1e-300, 1, 1}), PlanError::Unrepresentable);
}

// The bits do not depend on compiler, optimisation or machine.
TEST(Trapezoid, SameBitsEverywhere) {
  uint64_t seed = 1;
  const auto next = [&seed](double lo, double hi) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return lo + (hi - lo) * static_cast<double>(seed >> 11) * 0x1p-53;
  };
  uint64_t hash = 14695981039346656037U;
  const auto mix = [&hash](double x) {
    hash = (hash ^ std::bit_cast<uint64_t>(x)) * 1099511628211U;
  };
  for (int i = 0; i < 2000; ++i) {
    const double position = next(-1e3, 1e3);
    const double velocity = next(-300, 300);
    const double target = next(-1e3, 1e3);
    const TrapezoidLimits limits{next(1, 200), next(1, 2000), next(1, 2000)};
    const Profile profile = plan(position, velocity, target, limits);
    mix(profile.duration);
    for (int k = 0; k < 20; ++k) {
      const State state = profile.at(next(0, 1) * profile.duration);
      mix(state.position);
      mix(state.velocity);
    }
  }
  EXPECT_EQ(hash, 17550672269126823474U);
}

TEST(Stop, BrakesToRest) {
  Profile profile;
  ASSERT_EQ(planStop(profile, 10, -100, 200), PlanError::None);
  EXPECT_EQ(profile.duration, 0.5);
  EXPECT_EQ(profile.at(0).position, 10.0);
  EXPECT_EQ(profile.at(0.25).velocity, -50.0);
  EXPECT_EQ(profile.end.position, -15.0);
  ASSERT_EQ(planStop(profile, 10, 0, 200), PlanError::None);
  EXPECT_EQ(profile.duration, 0.0);
  EXPECT_EQ(profile.at(0).position, 10.0);
}

} // namespace
