// Properties of the trapezoid planner over random states, targets and limits.
#include "runtime/numeric/profile/planner.hpp"

#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

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

struct Problem {
  double position;
  double velocity;
  double target;
  TrapezoidLimits limits;
};

std::ostream &operator<<(std::ostream &out, const Problem &p) {
  out.precision(17);
  return out << "s0=" << p.position << " v0=" << p.velocity << " target=" << p.target
             << " v=" << p.limits.velocity << " a=" << p.limits.acceleration
             << " d=" << p.limits.deceleration;
}

class Random : public stride::test::Random {
public:
  using stride::test::Random::Random;

  Problem problem() {
    const double length = magnitude(-6, 6);
    Problem p{};
    p.position = chance(0.2) ? 0.0 : sign() * length * magnitude(-3, 1);
    p.target = chance(0.05) ? p.position : p.position + sign() * length;
    p.limits.velocity = length * magnitude(-2, 2);
    p.limits.acceleration = length * magnitude(-2, 2);
    p.limits.deceleration = chance(0.3) ? p.limits.acceleration : length * magnitude(-2, 2);
    if (chance(0.7)) // up to 3 times the limit
      p.velocity = sign() * p.limits.velocity * uniform(0, 3);
    return p;
  }
};

/// Checks a profile by sampling; false with a message in `why`.
bool follows(const Profile &profile, const Problem &p, double target, std::string &why) {
  const double scale = std::max(
      {1.0, std::fabs(p.position), std::fabs(target), std::fabs(p.velocity) * profile.duration});
  const double start = std::fabs(p.velocity);
  const double vMax = std::max(start, p.limits.velocity) * (1 + 1e-9);
  const double aMax = std::max(p.limits.acceleration, p.limits.deceleration) * (1 + 1e-9);
  if (profile.end.position != target || profile.end.velocity != 0.0) {
    why = "end state is not exact";
    return false;
  }
  if (profile.at(profile.duration).position != target) {
    why = "position at the end is not exact";
    return false;
  }
  const State first = profile.at(0);
  if (std::fabs(first.position - p.position) > 1e-12 * scale ||
      std::fabs(first.velocity - p.velocity) > 1e-9 * std::max(start, 1e-300)) {
    why = "does not start at the initial state";
    return false;
  }
  const int steps = 400;
  const double dt = profile.duration / steps;
  State last = first;
  bool inside = start <= p.limits.velocity;
  for (int i = 1; i <= steps; ++i) {
    const double t = i == steps ? profile.duration : i * dt;
    const State now = profile.at(t);
    if (!std::isfinite(now.position) || !std::isfinite(now.velocity)) {
      why = "not finite";
      return false;
    }
    if (std::fabs(now.velocity) > vMax) {
      why = "velocity limit";
      return false;
    }
    if (std::fabs(now.acceleration) > aMax) {
      why = "acceleration limit";
      return false;
    }
    // Speeding up obeys the acceleration, slowing down the deceleration.
    const double speedUp = now.velocity * now.acceleration;
    const double bound = (speedUp > 0 ? p.limits.acceleration : p.limits.deceleration) * (1 + 1e-9);
    if (speedUp != 0 && std::fabs(now.acceleration) > bound) {
      why = "acceleration limit for its direction";
      return false;
    }
    if (!inside && std::fabs(now.velocity) > std::fabs(last.velocity) * (1 + 1e-12)) {
      why = "does not return to the velocity limit monotonically";
      return false;
    }
    inside = inside || std::fabs(now.velocity) <= p.limits.velocity;
    if (std::fabs(now.velocity - last.velocity) > aMax * dt * (1 + 1e-6) + 1e-12 * vMax) {
      why = "velocity jumps";
      return false;
    }
    const double way =
        std::max(std::fabs(now.velocity), std::fabs(last.velocity)) * dt + 0.5 * aMax * dt * dt;
    if (std::fabs(now.position - last.position) > way * (1 + 1e-9) + 1e-12 * scale) {
      why = "position jumps";
      return false;
    }
    last = now;
  }
  // Position is the integral of velocity: Simpson's rule is exact inside every segment.
  double integral = p.position;
  for (int32_t i = 0; i < profile.count; ++i) {
    const double from = profile.segments[i].start;
    const double to = i + 1 < profile.count ? profile.segments[i + 1].start : profile.duration;
    const auto velocityAt = [&](double t) {
      const auto &s = profile.segments[i];
      return stride::test::movedOn(s.origin, s.jerk, t - s.reference).velocity;
    };
    integral +=
        (to - from) / 6 * (velocityAt(from) + 4 * velocityAt(0.5 * (from + to)) + velocityAt(to));
  }
  if (std::fabs(integral - target) > 1e-9 * scale) {
    why = "velocity does not integrate to the target";
    return false;
  }
  return true;
}

/// Time and way of a change of velocity at full acceleration, through zero if need be.
struct Ramp {
  double time;
  double way;
};

Ramp ramp(double from, double to, const TrapezoidLimits &limits) {
  if (from * to < 0) {
    const Ramp down = ramp(from, 0, limits);
    const Ramp up = ramp(0, to, limits);
    return {down.time + up.time, down.way + up.way};
  }
  const double a = std::fabs(to) > std::fabs(from) ? limits.acceleration : limits.deceleration;
  const double time = std::fabs(to - from) / a;
  return {time, 0.5 * (from + to) * time};
}

/// The shortest time over a grid of motions v0 -> v1 (held for as long as needed) -> 0 and
/// v0 -> v1 -> v2 (held) -> 0: an independent search that knows nothing of the planner's cases.
double bruteForce(const Problem &p, int grid) {
  const double distance = p.target - p.position;
  double best = HUGE_VAL;
  const double vTop = std::max(std::fabs(p.velocity), p.limits.velocity);
  const auto consider = [&](double first, double held) {
    const Ramp a = ramp(p.velocity, first, p.limits);
    const Ramp b = ramp(first, held, p.limits);
    const Ramp c = ramp(held, 0, p.limits);
    const double missing = distance - a.way - b.way - c.way;
    const double hold = held != 0 ? missing / held : -1;
    if (hold >= 0)
      best = std::min(best, a.time + b.time + c.time + hold);
  };
  for (int i = -grid; i <= grid; ++i) {
    const double held = p.limits.velocity * i / grid;
    if (i == 0)
      continue;
    consider(p.velocity, held);
    for (int k = -8; k <= 8; ++k) {
      const double first = vTop * k / 8;
      // Above the limit only on the way down from the initial velocity.
      if (std::fabs(first) <= p.limits.velocity ||
          (first * p.velocity > 0 && std::fabs(first) <= std::fabs(p.velocity)))
        consider(first, held);
    }
  }
  return best;
}

TEST(TrapezoidProperty, RandomMovesKeepTheirPromises) {
  Random random(20240607);
  for (int i = 0; i < 100000; ++i) {
    const Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planTrapezoid(profile, p.position, p.velocity, p.target, p.limits), PlanError::None)
        << p;
    std::string why;
    ASSERT_TRUE(follows(profile, p, p.target, why)) << why << ": " << p;
  }
}

TEST(TrapezoidProperty, RandomInterrupts) {
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planTrapezoid(profile, p.position, p.velocity, p.target, p.limits), PlanError::None);
    for (int k = 0; k < 3; ++k) {
      const State state = profile.at(random.uniform(0, 1.05) * profile.duration);
      Problem next = random.problem();
      const double length = std::fabs(p.target - p.position) + 1e-9;
      next.position = state.position;
      next.velocity = state.velocity;
      next.target = random.chance(0.3) ? p.target : state.position + random.uniform(-1, 1) * length;
      next.limits = p.limits;
      if (random.chance(0.5)) {
        next.limits.velocity *= random.magnitude(-1, 1);
        next.limits.acceleration *= random.magnitude(-1, 1);
        next.limits.deceleration *= random.magnitude(-1, 1);
      }
      ASSERT_EQ(planTrapezoid(profile, next.position, next.velocity, next.target, next.limits),
                PlanError::None)
          << next;
      std::string why;
      ASSERT_TRUE(follows(profile, next, next.target, why)) << why << ": " << next;
      p = next;
    }
  }
}

TEST(TrapezoidProperty, RandomStops) {
  Random random(99);
  for (int i = 0; i < 20000; ++i) {
    Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planStop(profile, p.position, p.velocity, p.limits.deceleration), PlanError::None);
    const double halt =
        p.position + p.velocity * std::fabs(p.velocity) / (2 * p.limits.deceleration);
    EXPECT_NEAR(profile.end.position, halt, 1e-12 * std::max(1.0, std::fabs(halt)));
    std::string why;
    ASSERT_TRUE(follows(profile, p, profile.end.position, why)) << why << ": " << p;
  }
}

TEST(TrapezoidProperty, NoSearchFindsAFasterMotion) {
  Random random(4711);
  int near = 0;
  const int cases = 3000;
  for (int i = 0; i < cases; ++i) {
    const Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planTrapezoid(profile, p.position, p.velocity, p.target, p.limits), PlanError::None);
    const double searched = bruteForce(p, 400);
    ASSERT_LE(profile.duration, searched * (1 + 1e-9) + 1e-12) << p;
    near += searched <= profile.duration * 1.05 ? 1 : 0;
  }
  // The search must be good enough to mean something.
  EXPECT_GT(near, cases * 8 / 10);
}

TEST(TrapezoidProperty, AllScales) {
  Random random(31);
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] { return random.magnitude(-60, 60); };
    Problem p{};
    p.position = random.chance(0.3) ? 0 : random.sign() * any();
    p.target = random.chance(0.1) ? p.position : random.sign() * any();
    p.velocity = random.chance(0.3) ? 0 : random.sign() * any();
    p.limits = {any(), any(), any()};
    Profile profile;
    const PlanError error = planTrapezoid(profile, p.position, p.velocity, p.target, p.limits);
    ASSERT_EQ(error, PlanError::None) << p;
    ASSERT_TRUE(std::isfinite(profile.duration)) << p;
    ASSERT_EQ(profile.end.position, p.target) << p;
    for (int k = 0; k <= 16; ++k) {
      const State state = profile.at(profile.duration * k / 16);
      ASSERT_TRUE(std::isfinite(state.position) && std::isfinite(state.velocity)) << p;
      ASSERT_LE(std::fabs(state.velocity),
                std::max(std::fabs(p.velocity), p.limits.velocity) * (1 + 1e-9))
          << p;
    }
  }
}

// The same with RapidCheck's generators, which shrink a counterexample to its simplest form.
RC_GTEST_PROP(TrapezoidProperty, WholeNumbers, ()) {
  Problem p{};
  p.position = *rc::gen::inRange(-1000, 1000);
  p.target = *rc::gen::inRange(-1000, 1000);
  p.velocity = *rc::gen::inRange(-300, 300);
  p.limits.velocity = *rc::gen::inRange(1, 200);
  p.limits.acceleration = *rc::gen::inRange(1, 1000);
  p.limits.deceleration = *rc::gen::inRange(1, 1000);
  Profile profile;
  RC_ASSERT(planTrapezoid(profile, p.position, p.velocity, p.target, p.limits) == PlanError::None);
  std::string why;
  RC_ASSERT(follows(profile, p, p.target, why));
  RC_ASSERT(profile.duration <= bruteForce(p, 50) * (1 + 1e-9));
}

} // namespace
