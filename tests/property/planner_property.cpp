// Properties of every planner over random states, targets, end velocities and limits.
#include "motion_problems.hpp"

#include <gtest/gtest.h>

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
using stride::test::casesOf;
using stride::test::hasAcceleration;
using stride::test::lastDigit;
using stride::test::MotionProblem;
using stride::test::MotionRandom;
using stride::test::wayAgainst;
using stride::test::wrongIn;

PlanError planOf(Profile &profile, const MotionProblem &p) {
  return planMove(profile, p.start, p.target, p.endVelocity, p.dynamics);
}

class PlannerProperty : public testing::TestWithParam<RampType> {};

TEST_P(PlannerProperty, RandomMovesKeepTheirPromises) {
  MotionRandom random(20261123);
  for (int i = 0; i < casesOf(100000); ++i) {
    const MotionProblem p = random.problem(GetParam());
    Profile profile;
    ASSERT_EQ(planOf(profile, p), PlanError::None) << p;
    ASSERT_EQ(wrongIn(profile, p), "") << i << ": " << p;
  }
}

TEST_P(PlannerProperty, RandomVelocitiesAndStops) {
  MotionRandom random(8);
  for (int i = 0; i < casesOf(100000); ++i) {
    MotionProblem p = random.problem(GetParam());
    Profile profile;
    if (random.chance(0.5)) {
      p.dynamics.acceleration = p.dynamics.deceleration;
      p.endVelocity = 0;
      ASSERT_EQ(planStop(profile, p.start, p.dynamics), PlanError::None);
    } else {
      ASSERT_EQ(planVelocity(profile, p.start, p.endVelocity, p.dynamics), PlanError::None);
    }
    p.target = profile.end.position;
    // The limit of the velocity does not count: any will do.
    p.dynamics.velocity +=
        std::max(std::fabs(p.start.velocity), std::fabs(p.endVelocity)) + stride::test::swingOf(p);
    ASSERT_EQ(wrongIn(profile, p), "") << i << ": " << p;
    // The velocity is the same seen as a move to where it is reached.
    if (p.dynamics.acceleration == p.dynamics.deceleration && i % 4 == 0) {
      Profile move;
      ASSERT_EQ(planOf(move, p), PlanError::None);
      const double size = std::max(std::fabs(p.start.position), std::fabs(p.target));
      const double slack = 1e-9 * profile.duration + 3 * std::cbrt(1e-14 * size / p.dynamics.jerk);
      if (hasAcceleration(p.dynamics)) {
        ASSERT_NEAR(move.duration, profile.duration, slack) << i << ": " << p;
      }
    }
  }
}

TEST_P(PlannerProperty, OtherTargetsOnTheWay) {
  MotionRandom random(77);
  for (int i = 0; i < casesOf(30000); ++i) {
    MotionProblem p = random.problem(GetParam());
    Profile profile;
    ASSERT_EQ(planOf(profile, p), PlanError::None);
    for (int k = 0; k < 3; ++k) {
      MotionProblem next = random.problem(GetParam());
      next.start = profile.at(random.uniform(0, 1.05) * profile.duration);
      const double length = std::fabs(p.target - p.start.position) + 1e-9;
      next.target =
          random.chance(0.3) ? p.target : next.start.position + random.uniform(-1, 1) * length;
      next.dynamics = p.dynamics;
      if (random.chance(0.3)) {
        next.dynamics.velocity *= random.magnitude(-1, 1);
        next.dynamics.acceleration *= random.magnitude(-1, 1);
        next.dynamics.deceleration *= random.magnitude(-1, 1);
      }
      next.endVelocity = random.chance(0.3) ? random.velocity(next.dynamics) : 0.0;
      ASSERT_EQ(planOf(profile, next), PlanError::None) << i << ": " << next;
      ASSERT_EQ(wrongIn(profile, next), "") << i << ": " << next;
      p = next;
    }
  }
}

TEST_P(PlannerProperty, ScalesBitForBit) {
  MotionRandom random(3);
  for (int i = 0; i < casesOf(20000); ++i) {
    const MotionProblem p = random.problem(GetParam());
    const int length = static_cast<int>(random.uniform(-60, 60));
    const int time = static_cast<int>(random.uniform(-40, 40));
    const auto scaled = [&](double x, int times) { return std::ldexp(x, length - times * time); };
    const MotionProblem q = {
        {scaled(p.start.position, 0), scaled(p.start.velocity, 1), scaled(p.start.acceleration, 2)},
        scaled(p.target, 0),
        scaled(p.endVelocity, 1),
        {p.dynamics.ramp, scaled(p.dynamics.velocity, 1), scaled(p.dynamics.acceleration, 2),
         scaled(p.dynamics.deceleration, 2), scaled(p.dynamics.jerk, 3)}};
    Profile one;
    Profile two;
    ASSERT_EQ(planOf(one, p), PlanError::None);
    ASSERT_EQ(planOf(two, q), PlanError::None);
    ASSERT_EQ(two.count, one.count);
    ASSERT_EQ(two.duration, std::ldexp(one.duration, time)) << i << ": " << p;
    for (int k = 0; k < 4; ++k) {
      const double t = random.uniform(0, 1) * one.duration;
      const State a = one.at(t);
      const State b = two.at(std::ldexp(t, time));
      ASSERT_EQ(b.position, scaled(a.position, 0)) << i << ": " << p;
      ASSERT_EQ(b.velocity, scaled(a.velocity, 1)) << i << ": " << p;
      ASSERT_EQ(b.acceleration, scaled(a.acceleration, 2)) << i << ": " << p;
    }
    ASSERT_EQ(reachableEndVelocity(q.start, q.target, q.endVelocity, q.dynamics),
              scaled(reachableEndVelocity(p.start, p.target, p.endVelocity, p.dynamics), 1));
  }
}

TEST_P(PlannerProperty, MirrorsBitForBit) {
  MotionRandom random(4);
  for (int i = 0; i < casesOf(20000); ++i) {
    const MotionProblem p = random.problem(GetParam());
    const MotionProblem q = {{-p.start.position, -p.start.velocity, -p.start.acceleration},
                             -p.target,
                             -p.endVelocity,
                             p.dynamics};
    Profile one;
    Profile two;
    ASSERT_EQ(planOf(one, p), PlanError::None);
    ASSERT_EQ(planOf(two, q), PlanError::None);
    ASSERT_EQ(two.duration, one.duration) << i << ": " << p;
    for (int k = 0; k < 4; ++k) {
      const double t = random.uniform(0, 1) * one.duration;
      const State a = one.at(t);
      const State b = two.at(t);
      ASSERT_EQ(b.position, -a.position) << i << ": " << p;
      ASSERT_EQ(b.velocity, -a.velocity) << i << ": " << p;
      ASSERT_EQ(b.acceleration, -a.acceleration) << i << ": " << p;
    }
    ASSERT_EQ(reachableEndVelocity(q.start, q.target, q.endVelocity, q.dynamics),
              -reachableEndVelocity(p.start, p.target, p.endVelocity, p.dynamics));
  }
}

// Numbers of very different sizes: hardly any jerk, hardly any deceleration, and the like.
TEST_P(PlannerProperty, UnevenProblems) {
  MotionRandom random(21);
  for (int i = 0; i < casesOf(50000); ++i) {
    const double span = random.uniform(0, 8);
    const auto any = [&] { return random.magnitude(-span, span); };
    const auto maybe = [&] { return random.chance(0.3) ? 0.0 : random.sign() * any(); };
    MotionProblem p{};
    p.start = {maybe(), maybe(), maybe()};
    p.target = p.start.position + maybe();
    p.endVelocity = random.chance(0.6) ? 0.0 : maybe();
    p.dynamics = {GetParam(), any(), any(), any(), any()};
    Profile profile;
    ASSERT_EQ(planOf(profile, p), PlanError::None) << p;
    ASSERT_EQ(wrongIn(profile, p, lastDigit(p)), "") << i << ": " << p;
  }
}

// At the target but for rounding: no long way round, and no failure.
TEST_P(PlannerProperty, NearlyThere) {
  MotionRandom random(160);
  for (int i = 0; i < casesOf(50000); ++i) {
    const auto tiny = [&] {
      return random.chance(0.3) ? 0.0 : random.sign() * random.magnitude(-18, -11);
    };
    MotionProblem p{};
    p.dynamics = random.dynamics(GetParam(), 1);
    p.target = random.chance(0.3) ? 0.0 : random.uniform(-10, 10);
    p.start = {p.target + tiny(), tiny() * p.dynamics.velocity, tiny() * p.dynamics.acceleration};
    if (random.chance(0.3)) { // on the way with the end velocity
      p.endVelocity = random.uniform(-1, 1) * p.dynamics.velocity;
      p.start.velocity = p.endVelocity * (random.chance(0.5) ? 1.0 : 1.0 + tiny());
    }
    Profile profile;
    ASSERT_EQ(planOf(profile, p), PlanError::None) << p;
    ASSERT_EQ(wrongIn(profile, p, lastDigit(p)), "") << i << ": " << p;
    if (p.endVelocity == 0) {
      // A way of 1e-11 at this jerk and acceleration, and velocities and accelerations like that.
      const double weaker = std::min(p.dynamics.acceleration, p.dynamics.deceleration);
      const double jerk = hasAcceleration(p.dynamics) ? p.dynamics.jerk : HUGE_VAL;
      const double time = 1e-3 * std::cbrt(100 / jerk) + 1e-4 / std::sqrt(weaker) +
                          1e-10 * (1 + p.dynamics.velocity / weaker + weaker / jerk) +
                          1e-4 * std::sqrt(p.dynamics.velocity / jerk) +
                          1e-10 / p.dynamics.velocity;
      ASSERT_LE(profile.duration, 10 * time) << i << ": " << p;
    }
  }
}

TEST_P(PlannerProperty, AnyNumberIsPlannedOrRefused) {
  MotionRandom random(13);
  int planned = 0;
  const int cases = casesOf(50000);
  for (int i = 0; i < cases; ++i) {
    const double span = random.chance(0.5) ? 60 : 300;
    const auto any = [&] { return random.magnitude(-span, span); };
    MotionProblem p{};
    p.start = {random.sign() * any(), random.sign() * any(), random.sign() * any()};
    p.target = random.sign() * any();
    p.dynamics = {GetParam(), any(), any(), any(), any()};
    p.endVelocity = random.chance(0.5) ? 0.0 : random.sign() * any();
    Profile profile;
    const PlanError error = planOf(profile, p);
    ASSERT_TRUE(error == PlanError::None || error == PlanError::Unrepresentable) << p;
    planned += error == PlanError::None ? 1 : 0;
    if (error == PlanError::None) {
      ASSERT_EQ(profile.end.position, p.target);
      ASSERT_EQ(profile.end.velocity, p.endVelocity);
    } else {
      ASSERT_EQ(profile.count, 0);
    }
    for (int k = 0; k <= 16; ++k) {
      const State state = profile.at(profile.duration * k / 16);
      ASSERT_FALSE(std::isnan(state.position) || std::isnan(state.velocity)) << i << ": " << p;
    }
    const double reachable = reachableEndVelocity(p.start, p.target, p.endVelocity, p.dynamics);
    ASSERT_LE(std::fabs(reachable), std::fabs(p.endVelocity)) << i << ": " << p;
    ASSERT_GE(reachable * p.endVelocity, 0.0) << i << ": " << p;
  }
  EXPECT_GT(planned, cases / 4);
}

TEST_P(PlannerProperty, NothingUnusableIsPlanned) {
  const MotionProblem good = {{1, 2, 3}, 10, 1, {GetParam(), 4, 5, 6, 7}};
  Profile profile;
  ASSERT_EQ(planOf(profile, good), PlanError::None);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const auto state = [&](auto change) {
      MotionProblem p = good;
      change(p);
      EXPECT_EQ(planOf(profile, p), PlanError::InvalidState) << p;
      EXPECT_EQ(profile.count, 0);
      EXPECT_EQ(reachableEndVelocity(p.start, p.target, p.endVelocity, p.dynamics), 0.0);
    };
    state([&](MotionProblem &p) { p.start.position = bad; });
    state([&](MotionProblem &p) { p.start.velocity = bad; });
    state([&](MotionProblem &p) { p.target = bad; });
    state([&](MotionProblem &p) { p.endVelocity = bad; });
    if (GetParam() != RampType::Trapezoid)
      state([&](MotionProblem &p) { p.start.acceleration = bad; });
  }
  for (const double bad : {std::nan(""), HUGE_VAL, 0.0, -1.0}) {
    for (int field = 0; field < 4; ++field) {
      MotionProblem p = good;
      double *const fields[4] = {&p.dynamics.velocity, &p.dynamics.acceleration,
                                 &p.dynamics.deceleration, &p.dynamics.jerk};
      *fields[field] = bad;
      const bool counts = field != 3 || GetParam() != RampType::Trapezoid;
      EXPECT_EQ(planOf(profile, p), counts ? PlanError::InvalidLimit : PlanError::None) << p;
      const bool also = counts && field != 0;
      EXPECT_EQ(planVelocity(profile, p.start, 3, p.dynamics),
                also ? PlanError::InvalidLimit : PlanError::None);
      EXPECT_EQ(planStop(profile, p.start, p.dynamics),
                also && field != 1 ? PlanError::InvalidLimit : PlanError::None);
    }
  }
  MotionProblem p = good;
  p.dynamics.ramp = static_cast<RampType>(9);
  EXPECT_EQ(planOf(profile, p), PlanError::InvalidLimit);
  EXPECT_EQ(planVelocity(profile, p.start, 3, p.dynamics), PlanError::InvalidLimit);
  EXPECT_EQ(reachableEndVelocity(p.start, p.target, 3, p.dynamics), 0.0);
}

TEST_P(PlannerProperty, BlendingVelocitiesAreReachableAndTheGreatest) {
  MotionRandom random(501);
  int limited = 0;
  int opposite = 0;
  const int cases = casesOf(50000);
  for (int i = 0; i < cases; ++i) {
    MotionProblem p = random.problem(GetParam());
    const double wanted = random.velocity(p.dynamics) * random.magnitude(-1, 1);
    Profile stop;
    ASSERT_EQ(planStop(stop, p.start, p.dynamics), PlanError::None);
    const double rest = p.target - stop.end.position;
    p.endVelocity = reachableEndVelocity(p.start, p.target, wanted, p.dynamics);
    ASSERT_LE(std::fabs(p.endVelocity), std::fabs(wanted)) << i << ": " << p;
    const stride::test::MotionSizes stopSizes = stride::test::sizesOf(stop, p);
    const double size = std::max({stopSizes.position, std::fabs(p.target), std::fabs(rest)});
    if (std::fabs(rest) < 1e-9 * size)
      continue; // either direction is right
    if (rest * wanted <= 0) {
      ASSERT_EQ(p.endVelocity, 0.0) << i << ": " << p;
      ++opposite;
      continue;
    }
    ASSERT_GT(p.endVelocity * wanted, 0.0) << i << ": " << p << ' ' << wanted;
    const double direction = wanted > 0 ? 1 : -1;
    Profile move;
    ASSERT_EQ(planOf(move, p), PlanError::None);
    ASSERT_EQ(wrongIn(move, p), "") << i << ": " << p;
    // It covers no more way against the direction than a stop has to.
    const double needed = wayAgainst(stop, direction);
    ASSERT_LE(wayAgainst(move, direction), needed * (1 + 1e-9) + 1e-9 * size) << i << ": " << p;
    if (p.endVelocity == wanted)
      continue;
    ++limited;
    Profile faster;
    const double more = p.endVelocity * (1 + 1e-6);
    ASSERT_EQ(planVelocity(faster, p.start, more, p.dynamics), PlanError::None);
    ASSERT_GT((faster.end.position - p.target) * direction, -1e-12 * size)
        << i << ": " << p << ": faster is possible";
  }
  EXPECT_GT(limited, cases / 10);
  EXPECT_GT(opposite, cases / 10);
}

// A public example of blending: asked for 500 u/s, 447 u/s are possible.
TEST(Blending, Example) {
  const Dynamics dynamics = {RampType::Trapezoid, 1000, 1000, 1000, 0};
  EXPECT_NEAR(reachableEndVelocity({0, 0, 0}, 100, 500, dynamics), std::sqrt(200000.0), 1e-9);
  EXPECT_EQ(reachableEndVelocity({0, 0, 0}, 100, 300, dynamics), 300.0);
  EXPECT_EQ(reachableEndVelocity({0, 0, 0}, 100, -300, dynamics), 0.0);
  EXPECT_EQ(reachableEndVelocity({0, 400, 0}, 80, 0, dynamics), 0.0);
  EXPECT_EQ(reachableEndVelocity({0, 400, 0}, 90, 100, dynamics), 100.0);
  // 400 u/s stop after 80 u: the way back from there is 30 u.
  EXPECT_EQ(reachableEndVelocity({0, 400, 0}, 50, 300, dynamics), 0.0);
  EXPECT_NEAR(reachableEndVelocity({0, 400, 0}, 50, -300, dynamics), -std::sqrt(60000.0), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, PlannerProperty, testing::ValuesIn(stride::test::kRampTypes),
                         stride::test::rampName);

} // namespace
