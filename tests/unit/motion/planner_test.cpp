// Plans of every ramp type against numbers worked out by hand.
#include "runtime/numeric/profile/planner.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace {

using stride::motion::Dynamics;
using stride::motion::PlanError;
using stride::motion::planMove;
using stride::motion::planStop;
using stride::motion::planVelocity;
using stride::motion::Profile;
using stride::motion::RampType;
using stride::motion::reachableEndVelocity;
using stride::motion::State;

constexpr double kPi = 3.14159265358979323846;

Profile move(const State &start, double target, double endVelocity, const Dynamics &dynamics) {
  Profile profile;
  EXPECT_EQ(planMove(profile, start, target, endVelocity, dynamics), PlanError::None);
  EXPECT_EQ(profile.end.position, target);
  EXPECT_EQ(profile.end.velocity, endVelocity);
  EXPECT_EQ(profile.end.acceleration, 0.0);
  return profile;
}

void expectState(const Profile &profile, double t, const State &expected) {
  const State state = profile.at(t);
  EXPECT_NEAR(state.position, expected.position, 1e-9) << "at " << t;
  EXPECT_NEAR(state.velocity, expected.velocity, 1e-9) << "at " << t;
  EXPECT_NEAR(state.acceleration, expected.acceleration, 1e-9) << "at " << t;
}

/// Whether the pieces meet.
void expectSteady(const Profile &profile, const State &start) {
  State last = start;
  for (int32_t i = 0; i <= profile.count; ++i) {
    const double t = i < profile.count ? profile.segments[i].start : profile.duration;
    if (i > 0)
      last = profile.segments[i - 1].at(t);
    const State next = i < profile.count ? profile.segments[i].at(t) : profile.end;
    EXPECT_NEAR(next.position, last.position, 1e-9 * (1 + std::fabs(last.position))) << i;
    EXPECT_NEAR(next.velocity, last.velocity, 1e-9 * (1 + std::fabs(last.velocity))) << i;
  }
}

TEST(Sine, PiecesAreSinesAndTheirIntegrals) {
  const State origin = {3, -2, 0.5};
  for (const double t : {-2.0, -1e-3, 0.0, 1e-9, 1e-4, 0.1, 0.7, 2.5}) {
    const State s = stride::numeric::evaluatePiece(origin, 1.5, 1.25, t);
    const double x = 1.25 * t;
    EXPECT_NEAR(s.acceleration, 0.5 + 1.2 * std::sin(x), 1e-15);
    EXPECT_NEAR(s.velocity, -2 + 0.5 * t + 0.96 * (1 - std::cos(x)), 2e-15);
    EXPECT_NEAR(s.position, 3 - 2 * t + 0.25 * t * t + 0.96 * t - 0.768 * std::sin(x), 4e-15);
  }
  // Where differences of sines would be rounding, it is the cubic.
  const State tiny = stride::numeric::evaluatePiece({0, 0, 0}, 6, 1e-3, 1e-3);
  EXPECT_NEAR(tiny.position, 1e-9, 1e-21);
  EXPECT_NEAR(tiny.velocity, 3e-6, 1e-18);
  EXPECT_EQ(stride::numeric::evaluatePiece(origin, 1.5, 0, 2).position, 3 - 4 + 1 + 2);
}

// Up in 0.5 s (25 u), down in 1 s (50 u): as the trapezoid. The acceleration peaks at pi/2 times.
TEST(Sigmoid, KeepsTheTrapezoidsTime) {
  const Profile profile = move({0, 0, 0}, 1000, 0, {RampType::Sigmoid, 100, 200, 100, 1});
  EXPECT_NEAR(profile.duration, 0.5 + 9.25 + 1, 1e-12);
  EXPECT_EQ(profile.count, 3);
  expectState(profile, 0.25, {12.5 - 25 / kPi, 50, 100 * kPi});
  expectState(profile, 0.5, {25, 100, 0});
  expectState(profile, 9.75, {950, 100, 0});
  expectState(profile, 10.25, {975 + 50 / kPi, 50, -50 * kPi});
}

TEST(Sigmoid, TakesAwayTheAccelerationFirst) {
  // 0.5 s at 20 u/s^3: the velocity rises from 10 to 12.5 u/s, over 5 + 10 / 12 u.
  const Dynamics dynamics = {RampType::Sigmoid, 50, 100, 25, 20};
  Profile profile;
  ASSERT_EQ(planVelocity(profile, {0, 10, 10}, 37.5, dynamics), PlanError::None);
  EXPECT_NEAR(profile.duration, 0.5 + 0.25, 1e-12);
  expectState(profile, 0.25, {2.5 + 0.3125 - 20 * 0.015625 / 6, 10 + 2.5 - 0.625, 5});
  expectState(profile, 0.5, {5 + 10.0 / 12, 12.5, 0});
  EXPECT_NEAR(profile.end.position, 5 + 10.0 / 12 + 6.25, 1e-12);
  ASSERT_EQ(planStop(profile, {0, 10, 10}, dynamics), PlanError::None);
  EXPECT_NEAR(profile.duration, 0.5 + 0.5, 1e-12);
  EXPECT_NEAR(profile.end.position, 5 + 10.0 / 12 + 3.125, 1e-12);
}

TEST(Sigmoid, LimitedKeepsBothLimits) {
  Profile profile;
  // By the acceleration: T = pi * 100 / (2 * 200).
  ASSERT_EQ(planVelocity(profile, {0, 0, 0}, 100, {RampType::SigmoidLimited, 1, 200, 1, 1e6}),
            PlanError::None);
  EXPECT_NEAR(profile.duration, kPi / 4, 1e-12);
  expectState(profile, kPi / 8, {100 * kPi / 16 - 12.5, 50, 200});
  // By the jerk: T = pi * sqrt(100 / (2 * 400)), which starts with 400 u/s^3.
  ASSERT_EQ(planVelocity(profile, {0, 0, 0}, 100, {RampType::SigmoidLimited, 1, 200, 1, 400}),
            PlanError::None);
  EXPECT_NEAR(profile.duration, kPi * std::sqrt(0.125), 1e-12);
  EXPECT_NEAR(profile.segments[0].jerk, -400, 1e-9) << "anchored at its end";
  EXPECT_NEAR(profile.at(profile.duration / 2).acceleration, 50 * std::sqrt(8.0), 1e-9);
}

// With a limited jerk a small change of velocity takes so much time that a stop may be possible
// where a mere slowing down is not.
TEST(Sigmoid, LimitedFindsDetoursThroughLowerSpeeds) {
  const Dynamics dynamics = {RampType::SigmoidLimited, 3.6191258383943201, 145.67812425973295,
                             743.88741584840966, 2.8671814997466005};
  const State start = {0, -0.21082472011932823, 14.378759125390788};
  expectSteady(move(start, 264.927478765437, 3.1010827589714447, dynamics), start);
  const double reachable = reachableEndVelocity(start, 264.927478765437, 3.1, dynamics);
  EXPECT_GT(reachable, 0.0);
  EXPECT_LT(reachable, 3.1);
  Profile profile;
  ASSERT_EQ(planVelocity(profile, start, reachable, dynamics), PlanError::None);
  EXPECT_NEAR(profile.end.position, 264.927478765437, 1e-6);
}

TEST(Parabolic, BlendsNoFasterThanItCanSlowDown) {
  const Dynamics dynamics = {RampType::Parabolic, 6344.6288463991432, 33732.133100020736,
                             33732.133100020736, 9650.4718950228544};
  const State start = {1284.8833607315182, -5332.6597367688, 7102.8183650884339};
  const double target = -1179.4337857886981;
  const double reachable = reachableEndVelocity(start, target, -5000, dynamics);
  EXPECT_LT(reachable, 0.0);
  const Profile profile = move(start, target, reachable, dynamics);
  expectSteady(profile, start);
  for (int i = 0; i <= 100; ++i)
    EXPECT_LE(profile.at(profile.duration * i / 100).velocity, 0.0);
}

// The trapezoid: 100 u/s^2 up and 200 down, at most 50 u/s.
TEST(EndVelocity, OfTheTrapezoid) {
  const Dynamics dynamics = {RampType::Trapezoid, 50, 100, 200, 0};
  Profile profile = move({0, 0, 0}, 100, 30, dynamics);
  // 12.5 u up, 4 u down to 30 u/s, 83.5 u between.
  EXPECT_NEAR(profile.duration, 0.5 + 83.5 / 50 + 0.1, 1e-12);
  // Above the limit only in the final run-up: 12.5 u to the limit, then 55 more to 120 u/s.
  profile = move({0, 0, 0}, 100, 120, dynamics);
  EXPECT_NEAR(profile.duration, 0.5 + (100 - 72) / 50.0 + 0.7, 1e-12);
  expectState(profile, 1.0, {37.5, 50, 0});
  expectState(profile, profile.duration - 0.35, {100 - 0.35 * (120 - 17.5), 85, 100});
  // Against the way: beyond the target and back. 10 u/s take 0.5 u.
  profile = move({0, 0, 0}, 4, -10, dynamics);
  // From 0 to 4.5: up to 24.49 u/s (3 u), down (1.5 u); then 0.5 u back.
  const double peak = std::sqrt(2 * 4.5 * 200 / 3.0);
  EXPECT_NEAR(profile.duration, peak / 100 + peak / 200 + 0.1, 1e-12);
  expectSteady(profile, {0, 0, 0});
  // Standing on the target with a velocity to reach: back for the run-up of 4.5 u.
  profile = move({7, 0, 0}, 7, 30, dynamics);
  EXPECT_NEAR(profile.duration, peak / 100 + peak / 200 + 0.3, 1e-12);
  // Nothing to do.
  EXPECT_EQ(move({7, 30, 0}, 7, 30, dynamics).count, 0);
}

// Beyond its end a profile goes on with the velocity of its end.
TEST(EndVelocity, GoesOnBeyondTheEnd) {
  for (const RampType ramp : {RampType::Trapezoid, RampType::Sigmoid, RampType::Parabolic}) {
    const Profile profile = move({2, 0, 0}, 100, 30, {ramp, 50, 100, 200, 1000});
    EXPECT_EQ(profile.at(profile.duration).position, 100.0);
    EXPECT_NEAR(profile.at(profile.duration + 0.25).position, 107.5, 1e-12);
    EXPECT_NEAR(profile.at(profile.duration + 2).position, 160, 1e-12);
    EXPECT_EQ(profile.at(profile.duration + 2).velocity, 30.0);
    EXPECT_EQ(profile.at(-1).position, 2.0);
    EXPECT_EQ(move({2, 0, 0}, 100, 0, {ramp, 50, 100, 200, 1000}).at(1e6).position, 100.0);
  }
}

// The bits do not depend on compiler, optimisation or machine.
TEST(Planner, SameBitsEverywhere) {
  uint64_t seed = 1;
  const auto next = [&seed](double lo, double hi) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return lo + (hi - lo) * static_cast<double>(seed >> 11) * 0x1p-53;
  };
  uint64_t hash = 14695981039346656037U;
  const auto mix = [&hash](double x) {
    hash = (hash ^ std::bit_cast<uint64_t>(x)) * 1099511628211U;
  };
  for (int i = 0; i < 4000; ++i) {
    const auto ramp = static_cast<RampType>(i % 4);
    const State start = {next(-1e3, 1e3), next(-300, 300), next(-1000, 1000)};
    const double target = next(-1e3, 1e3);
    const double endVelocity = i % 3 == 0 ? next(-300, 300) : 0.0;
    const Profile profile = move(start, target, endVelocity,
                                 {ramp, next(1, 200), next(1, 2000), next(1, 2000), next(1, 9e4)});
    mix(profile.duration);
    for (int k = 0; k < 10; ++k) {
      const State state = profile.at(next(0, 1) * profile.duration);
      mix(state.position);
      mix(state.velocity);
      mix(state.acceleration);
    }
  }
  EXPECT_EQ(hash, 2800861869550632286U);
}

} // namespace
