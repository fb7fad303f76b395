// An axis after signals of any kind: its limits, steadiness, that it gets to what keeps to the
// limits and stays there, and that to a signal of constant velocity it takes no longer than the
// time that a planner needs.
#include "runtime/numeric/profile/pursuit.hpp"

#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using stride::motion::Dynamics;
using stride::motion::planMove;
using stride::motion::Profile;
using stride::motion::pursue;
using stride::motion::Pursued;
using stride::motion::RampType;
using stride::motion::State;
using stride::test::Random;

/// A signal of constant accelerations that change at random, with leaps now and then.
class Signal {
public:
  Signal(Random &random, double cycle, const Dynamics &most, bool leaps, bool rests)
      : random_(random), cycle_(cycle), most_(most), leaps_(leaps), rests_(rests) {
    state = {random.uniform(-5, 5), 0, 0};
  }

  void next() {
    const double T = cycle_;
    if (leaps_ && random_.chance(0.003))
      state.position += random_.uniform(-3, 3);
    if (random_.chance(rests_ ? 0 : 0.01))
      wanted_ = random_.chance(0.3) ? 0 : random_.uniform(-1, 1) * most_.velocity * 0.9;
    const double a = std::min(most_.acceleration, most_.deceleration) * 0.5;
    const double j = most_.jerk * 0.4;
    // Towards the wanted velocity with limited jerk.
    const double gap = wanted_ - state.velocity;
    const double aim = std::clamp(gap / (20 * T), -a, a);
    const double acceleration =
        state.acceleration + std::clamp(aim - state.acceleration, -j * T, j * T);
    const double velocity = state.velocity + 0.5 * (state.acceleration + acceleration) * T;
    const double jerk = (acceleration - state.acceleration) / T;
    state.position += state.velocity * T + state.acceleration * T * T / 2 + jerk * T * T * T / 6;
    state.velocity = velocity;
    state.acceleration = acceleration;
  }

  void rest() { rests_ = true; }

  State state{};

private:
  Random &random_;
  double cycle_;
  Dynamics most_;
  bool leaps_;
  bool rests_;
  double wanted_ = 0;
};

Dynamics drawLimits(Random &random, RampType ramp) {
  Dynamics most{ramp, random.uniform(10, 100), random.uniform(100, 900), 0, 0};
  most.deceleration = random.chance(0.5) ? most.acceleration : random.uniform(100, 900);
  most.jerk = random.uniform(20, 200) * std::min(most.acceleration, most.deceleration);
  return most;
}

/// The step from one state of the axis to the next keeps to the limits.
void expectStep(const State &from, const State &to, const Dynamics &most, double T) {
  const double largest = std::max(most.acceleration, most.deceleration);
  ASSERT_LE(std::fabs(to.velocity), std::max(most.velocity, std::fabs(from.velocity)) * (1 + 1e-6));
  const double change = to.velocity - from.velocity;
  double limit = from.velocity * change >= 0 ? most.acceleration : most.deceleration;
  if (from.velocity * to.velocity < 0)
    limit = largest;
  if (most.ramp == RampType::Trapezoid) {
    ASSERT_LE(std::fabs(change), limit * T * (1 + 1e-6) + 1e-9);
  } else {
    ASSERT_LE(std::fabs(to.acceleration),
              std::max(largest, std::fabs(from.acceleration)) * (1 + 1e-6));
    ASSERT_LE(std::fabs(to.acceleration - from.acceleration), most.jerk * T * (1 + 1e-5) + 1e-6);
    ASSERT_LE(std::fabs(change), largest * T * (1 + 1e-6) + 1e-9);
  }
  const double expected = 0.5 * (from.velocity + to.velocity) * T;
  ASSERT_LE(std::fabs(to.position - from.position - expected), 0.5 * largest * T * T + 1e-9);
}

class Pursuits : public ::testing::TestWithParam<RampType> {};

TEST_P(Pursuits, KeepToTheLimitsAndGetThere) {
  int inSync = 0;
  int leftAgain = 0;
  for (uint64_t seed = 0; seed < 150 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed * 13 + 5);
    const double T = random.magnitude(-3.3, -2.2);
    const Dynamics most = drawLimits(random, GetParam());
    Signal signal(random, T, most, seed % 3 == 0, false);
    State axis{random.uniform(-5, 5), 0, 0};
    bool reached = false;
    for (int i = 0; (i < 2500 || !reached) && i < 100000 && !HasFailure(); ++i) {
      if (i == 2000)
        signal.rest(); // it goes on to its last velocity
      const State before = signal.state;
      signal.next();
      const Pursued now = pursue({axis, before, signal.state, T, most});
      expectStep(axis, now.axis, most, T);
      if (now.reached) {
        ASSERT_EQ(now.axis.position, signal.state.position);
        ASSERT_EQ(now.axis.velocity, signal.state.velocity);
        ++inSync;
      } else if (reached) {
        ++leftAgain;
        ASSERT_EQ(seed % 3, 0U) << "cycle " << i << ": a signal within the limits is not lost";
      }
      reached = now.reached;
      axis = now.axis;
    }
    ASSERT_TRUE(reached);
  }
  EXPECT_GT(inSync, 100000);
  EXPECT_GT(leftAgain, 50);
}

TEST_P(Pursuits, TakeNoLongerThanNecessaryToAConstantVelocity) {
  for (uint64_t seed = 0; seed < 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed * 29 + 1);
    const double T = 0.001;
    Dynamics most = drawLimits(random, GetParam());
    const double speed = random.chance(0.3) ? 0 : random.uniform(-0.7, 0.7) * most.velocity;
    if (speed != 0)
      most.deceleration = most.acceleration;
    State axis{random.uniform(-20, 20), random.uniform(-0.7, 0.7) * most.velocity, 0};
    // The planner that comes nearest: in the frame of the signal, with the velocity that is left.
    Dynamics relative = most;
    relative.ramp = most.ramp == RampType::Trapezoid ? most.ramp : RampType::Parabolic;
    relative.velocity = most.velocity - std::fabs(speed);
    Profile profile;
    ASSERT_EQ(planMove(profile, {axis.position, axis.velocity - speed, 0}, 0, 0, relative),
              stride::motion::PlanError::None);
    State signal{0, speed, 0};
    int cycles = 0;
    bool reached = false;
    while (!reached && cycles < 100000 && !HasFailure()) {
      const State before = signal;
      signal.position = speed * T * (cycles + 1);
      const Pursued now = pursue({axis, before, signal, T, most});
      expectStep(axis, now.axis, most, T);
      axis = now.axis;
      reached = now.reached;
      ++cycles;
    }
    EXPECT_LE(cycles, profile.duration / T * (1 + 1e-6) + 2) << "speed " << speed;
  }
}

TEST_P(Pursuits, ATooFastSignalGetsAway) {
  const Dynamics most{GetParam(), 10, 100, 100, 2000};
  State axis{};
  State signal{};
  for (int i = 0; i < 2000; ++i) {
    const State before = signal;
    signal = {before.position + 0.02, 20, 0};
    const Pursued now = pursue({axis, before, signal, 0.001, most});
    expectStep(axis, now.axis, most, 0.001);
    EXPECT_FALSE(now.reached);
    axis = now.axis;
  }
  EXPECT_NEAR(axis.velocity, 10, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Ramps, Pursuits,
                         ::testing::Values(RampType::Trapezoid, RampType::Sigmoid,
                                           RampType::Parabolic, RampType::SigmoidLimited));

} // namespace
