// Directions on a rotary axis against a search over many turns, for every ramp type.
#include "motion_problems.hpp"

#include "runtime/numeric/profile/modulo.hpp"
#include "tests/support/kinematics.hpp"

#include <gtest/gtest.h>

namespace {

using stride::motion::Direction;
using stride::motion::ModuloRequest;
using stride::motion::PlanError;
using stride::motion::planMove;
using stride::motion::planStop;
using stride::motion::planVelocity;
using stride::motion::Profile;
using stride::motion::RampType;
using stride::motion::resolveModulo;
using stride::test::casesOf;
using stride::test::MotionProblem;
using stride::test::MotionRandom;
using stride::test::wayAgainst;

ModuloRequest randomRequest(MotionRandom &random, RampType ramp) {
  ModuloRequest r{};
  r.period = random.magnitude(-2, 4);
  r.dynamics = random.dynamics(ramp, r.period);
  r.start.position = random.uniform(0, 1) * r.period;
  r.target = random.chance(0.1) ? r.start.position : random.uniform(-3, 3) * r.period;
  if (random.chance(0.7))
    r.start.velocity =
        random.sign() * random.uniform(0, 2) * std::sqrt(r.period * r.dynamics.deceleration);
  if (random.chance(0.5)) // a few periods at most until it is gone
    r.start.acceleration = random.sign() * random.uniform(0, 2) *
                           std::cbrt(r.period * r.dynamics.jerk * r.dynamics.jerk);
  if (random.chance(0.4))
    r.endVelocity =
        random.sign() * random.uniform(0, 2) * std::sqrt(r.period * r.dynamics.acceleration);
  r.lastMotion = random.chance(0.5) ? Direction::Positive : Direction::Negative;
  return r;
}

Profile planTo(const ModuloRequest &r, double target) {
  Profile profile;
  EXPECT_EQ(planMove(profile, r.start, target, r.endVelocity, r.dynamics), PlanError::None);
  return profile;
}

class ModuloProperty : public testing::TestWithParam<RampType> {};

TEST_P(ModuloProperty, Directions) {
  MotionRandom random(5);
  for (int i = 0; i < casesOf(10000); ++i) {
    ModuloRequest r = randomRequest(random, GetParam());
    const double period = r.period;
    const double wanted = stride::test::onCircle(r.target, period);
    Profile stop;
    ASSERT_EQ(planStop(stop, r.start, r.dynamics), PlanError::None);
    const double slack = 1e-9 * (period + std::fabs(stop.end.position - r.start.position));
    Profile direct;
    ASSERT_EQ(planVelocity(direct, r.start, r.endVelocity, r.dynamics), PlanError::None);
    double fastest = HUGE_VAL;
    double nearest = HUGE_VAL;
    for (const double place : {r.start.position, stop.end.position, direct.end.position,
                               0.5 * (r.start.position + stop.end.position)}) {
      const double first = std::floor((place - wanted) / period);
      for (int k = -4; k <= 4; ++k) {
        const double candidate = wanted + (first + k) * period;
        fastest = std::min(fastest, planTo(r, candidate).duration);
        nearest = std::min(nearest, std::fabs(candidate - r.start.position));
      }
    }
    for (const auto direction : {Direction::Positive, Direction::Negative, Direction::Current,
                                 Direction::Shortest, Direction::Fastest}) {
      const MotionProblem problem = {r.start, r.target, r.endVelocity, r.dynamics};
      SCOPED_TRACE(testing::Message() << i << ": " << static_cast<int>(direction) << ' ' << problem
                                      << " period " << period);
      r.direction = direction;
      double target = 0;
      ASSERT_TRUE(resolveModulo(r, target));
      ASSERT_NEAR(stride::test::shortWay(target - wanted, period), 0.0, slack)
          << "not the demanded position";
      if (direction == Direction::Shortest) {
        ASSERT_NEAR(std::fabs(target - r.start.position), nearest, slack);
        continue;
      }
      if (direction == Direction::Fastest) {
        ASSERT_LE(planTo(r, target).duration, fastest * (1 + 1e-9));
        continue;
      }
      double side = direction == Direction::Positive ? 1 : -1;
      if (direction == Direction::Current) {
        side = r.lastMotion == Direction::Positive ? 1 : -1;
        if (r.start.velocity != 0)
          side = r.start.velocity > 0 ? 1 : -1;
        else if (r.start.acceleration != 0 && stride::test::hasAcceleration(r.dynamics))
          side = r.start.acceleration > 0 ? 1 : -1;
      }
      if (r.endVelocity * side < 0) {
        ASSERT_GE((target - stop.end.position) * side, -slack);
        ASSERT_LT((target - stop.end.position) * side, period + slack);
        continue;
      }
      // No more way against the direction than braking needs; with a turn less it would be.
      const double braking = wayAgainst(direct, side);
      ASSERT_LE(wayAgainst(planTo(r, target), side),
                std::max(braking, wayAgainst(stop, side)) + slack);
      ASSERT_GT(wayAgainst(planTo(r, target - side * period), side), braking - slack);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ModuloProperty, testing::ValuesIn(stride::test::kRampTypes),
                         stride::test::rampName);

} // namespace
