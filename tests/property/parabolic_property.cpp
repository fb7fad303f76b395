// Properties of the jerk-limited planner over random states, targets and limits.
#include "runtime/numeric/profile/parabolic.hpp"

#include "tests/property/move_problem.hpp"
#include "tests/support/cases.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace {

using stride::motion::PlanError;
using stride::motion::planParabolic;
using stride::motion::planParabolicStop;
using stride::motion::planParabolicVelocity;
using stride::motion::Profile;
using stride::motion::Segment;
using stride::motion::State;
using Problem = stride::test::MoveProblem;
using stride::test::casesOf;

class Random : public stride::test::Random {
public:
  using stride::test::Random::Random;

  Problem problem() {
    const double length = magnitude(-6, 6);
    Problem p{};
    p.start.position = chance(0.2) ? 0.0 : sign() * length * magnitude(-3, 1);
    p.target = chance(0.05) ? p.start.position : p.start.position + sign() * length;
    p.limits.velocity = length * magnitude(-2, 2);
    p.limits.acceleration = length * magnitude(-2, 2);
    p.limits.deceleration = chance(0.5) ? p.limits.acceleration : length * magnitude(-2, 2);
    p.limits.jerk = length * magnitude(-2, 4);
    if (chance(0.7))
      p.start.velocity = sign() * p.limits.velocity * (chance(0.7) ? uniform(0, 1) : uniform(0, 3));
    if (chance(0.6))
      p.start.acceleration = sign() * std::max(p.limits.acceleration, p.limits.deceleration) *
                             (chance(0.8) ? uniform(0, 1) : uniform(0, 2));
    if (chance(0.3))
      p.endVelocity = sign() * p.limits.velocity * uniform(0, 1);
    return p;
  }
};

State at(const Segment &segment, double t) {
  return stride::test::movedOn(segment.origin, segment.jerk, t - segment.reference);
}

/// Sizes of the numbers of a profile, for tolerances.
struct Sizes {
  double position;
  double velocity;
  double acceleration;
};

Sizes sizesOf(const Profile &profile, const Problem &p) {
  Sizes sizes = {std::max(std::fabs(p.start.position), std::fabs(profile.end.position)),
                 std::max(std::fabs(p.start.velocity), std::fabs(profile.end.velocity)),
                 std::fabs(p.start.acceleration)};
  for (int32_t i = 0; i < profile.count; ++i) {
    const Segment &segment = profile.segments[i];
    const double end = i + 1 < profile.count ? profile.segments[i + 1].start : profile.duration;
    for (const double t : {segment.start, end}) {
      const State s = at(segment, t);
      sizes.position = std::max(sizes.position, std::fabs(s.position));
      sizes.velocity = std::max(sizes.velocity, std::fabs(s.velocity));
      sizes.acceleration = std::max(sizes.acceleration, std::fabs(s.acceleration));
    }
  }
  return sizes;
}

/// Empty when the profile is steady from the start to its end; else what is wrong.
std::string broken(const Profile &profile, const Problem &p) {
  const Sizes sizes = sizesOf(profile, p);
  const double tick = 1e-15 * profile.duration; // finer a double does not know the time
  const double jerk = p.limits.jerk * tick;
  const double acceleration = 1e-11 * sizes.acceleration + jerk;
  const double velocity = 1e-11 * sizes.velocity + (sizes.acceleration + jerk) * tick;
  const double position = 1e-11 * sizes.position + (sizes.velocity + jerk * tick) * tick;
  State last = p.start;
  double time = 0;
  for (int32_t i = 0; i <= profile.count; ++i) {
    const bool end = i == profile.count;
    const double t = end ? profile.duration : profile.segments[i].start;
    if (!(t >= time))
      return "times fall";
    if (i > 0)
      last = at(profile.segments[i - 1], t);
    const State next = end ? profile.end : at(profile.segments[i], t);
    if (!(std::fabs(next.position - last.position) <= position))
      return "position jumps by " + std::to_string(next.position - last.position);
    if (!(std::fabs(next.velocity - last.velocity) <= velocity))
      return "velocity jumps by " + std::to_string(next.velocity - last.velocity);
    if (!(std::fabs(next.acceleration - last.acceleration) <= acceleration))
      return "acceleration jumps by " + std::to_string(next.acceleration - last.acceleration);
    time = t;
  }
  return "";
}

/// Empty when the profile keeps the limits wherever the start allows; else what is wrong.
std::string beyond(const Profile &profile, const Problem &p) {
  const double slack = 1 + 1e-9;
  const Sizes sizes = sizesOf(profile, p);
  const double start = std::fabs(p.start.acceleration);
  // What the acceleration at the start makes of the velocity before it is gone.
  const double swing = start * start / (2 * p.limits.jerk);
  const double fastest = std::max(p.limits.velocity, std::fabs(p.start.velocity) + swing) * slack +
                         sizes.acceleration * 1e-15 * profile.duration;
  const double tick = p.limits.jerk * 1e-15 * profile.duration;
  for (int32_t i = 0; i < profile.count; ++i) {
    const Segment &segment = profile.segments[i];
    const double from = segment.start;
    const double to = i + 1 < profile.count ? profile.segments[i + 1].start : profile.duration;
    if (std::fabs(segment.jerk) > p.limits.jerk * slack)
      return "jerk";
    double times[3] = {from, to, from};
    if (segment.jerk != 0) {
      const double peak = segment.reference - segment.origin.acceleration / segment.jerk;
      if (peak > from && peak < to)
        times[2] = peak;
    }
    for (const double t : times) {
      const State now = at(segment, t);
      if (std::fabs(now.velocity) > fastest)
        return "velocity " + std::to_string(now.velocity);
    }
    // Each end of the piece: speeding up or slowing down.
    for (const double t : {from + 1e-9 * (to - from), to - 1e-9 * (to - from)}) {
      const State now = at(segment, t);
      const double limit =
          now.velocity * now.acceleration > 0 ? p.limits.acceleration : p.limits.deceleration;
      if (std::fabs(now.acceleration) <= std::max(limit, start) * slack + tick)
        continue;
      // At a velocity of 0 the one limit gives way to the other; what came with the start may
      // turn the velocity.
      const bool turning =
          std::fabs(now.velocity) <= 1e-9 * sizes.velocity + swing * slack &&
          std::fabs(now.acceleration) <=
              std::max({p.limits.acceleration, p.limits.deceleration, start}) * slack + tick;
      if (!turning)
        return "acceleration " + std::to_string(now.acceleration);
    }
  }
  return "";
}

/// A change of velocity to rest of the acceleration, with what it needs.
struct Change {
  double time = HUGE_VAL;
  double way = 0;
};

/// Through the acceleration `peak`, held for as long as needed.
Change through(double v, double a, double to, double peak, double jerk) {
  const double t1 = std::fabs(peak - a) / jerk;
  const double t3 = std::fabs(peak) / jerk;
  const double v1 = v + 0.5 * (a + peak) * t1;
  const double missing = to - v1 - 0.5 * peak * t3;
  double hold = 0;
  if (std::fabs(missing) > 1e-13 * (std::fabs(v) + std::fabs(to) + std::fabs(v1))) {
    hold = missing / peak;
    if (!(hold >= 0) || !std::isfinite(hold))
      return {};
  }
  const double j1 = peak > a ? jerk : -jerk;
  const double j3 = peak > 0 ? -jerk : jerk;
  double way = v * t1 + a * t1 * t1 / 2 + j1 * t1 * t1 * t1 / 6;
  const double v2 = v1 + peak * hold;
  way += (v1 + v2) / 2 * hold;
  way += v2 * t3 + peak * t3 * t3 / 2 + j3 * t3 * t3 * t3 / 6;
  return {t1 + hold + t3, way};
}

/// From rest of the acceleration: the textbook's formula.
Change smooth(double v, double to, double rate, double jerk) {
  const double size = std::fabs(to - v);
  const double time =
      size <= rate * rate / jerk ? 2 * std::sqrt(size / jerk) : size / rate + rate / jerk;
  return {time, 0.5 * (v + to) * time};
}

/// The shortest time over a grid of motions start -> v1 (held) -> v2 -> end for equal acceleration
/// and deceleration; it knows nothing of the planner's cases.
double search(const Problem &p, int grid) {
  const double distance = p.target - p.start.position;
  const double rate = p.limits.acceleration;
  const double jerk = p.limits.jerk;
  double best = HUGE_VAL;
  for (int i = -grid; i <= grid; ++i) {
    const double held = p.limits.velocity * i / grid;
    const Change last = smooth(held, p.endVelocity, rate, jerk);
    for (int k = -12; k <= 13; ++k) {
      double peak = rate * k / 12;
      if (k == 13) { // the one that is not held
        const double rest =
            p.start.velocity + p.start.acceleration * std::fabs(p.start.acceleration) / (2 * jerk);
        const double side = held > rest ? 1 : -1;
        const double square = side * jerk * (held - p.start.velocity) +
                              p.start.acceleration * p.start.acceleration / 2;
        if (square < 0 || square > rate * rate)
          continue;
        peak = side * std::sqrt(square);
      }
      const Change first = through(p.start.velocity, p.start.acceleration, held, peak, jerk);
      const double missing = distance - first.way - last.way;
      const double hold = held != 0 ? missing / held : missing == 0 ? 0 : -1;
      if (hold >= 0 && std::isfinite(first.time))
        best = std::min(best, first.time + hold + last.time);
    }
  }
  return best;
}

std::string wrong(const Profile &profile, const Problem &p) {
  if (profile.end.position != p.target || profile.end.velocity != p.endVelocity ||
      profile.end.acceleration != 0)
    return "end";
  if (profile.at(profile.duration).position != p.target)
    return "position at the end";
  const std::string jump = broken(profile, p);
  return jump.empty() ? beyond(profile, p) : jump;
}

TEST(ParabolicProperty, RandomMovesKeepTheirPromises) {
  Random random(20261122);
  for (int i = 0; i < 100000; ++i) {
    const Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None)
        << p;
    ASSERT_EQ(wrong(profile, p), "") << i << ": " << p;
  }
}

TEST(ParabolicProperty, NoSearchFindsAFasterMotion) {
  Random random(4711);
  int near = 0;
  const int cases = 3000;
  for (int i = 0; i < cases; ++i) {
    Problem p = random.problem();
    p.limits.deceleration = p.limits.acceleration;
    p.start.velocity = std::clamp(p.start.velocity, -p.limits.velocity, p.limits.velocity);
    p.start.acceleration =
        std::clamp(p.start.acceleration, -p.limits.acceleration, p.limits.acceleration);
    if (std::fabs(p.start.velocity + p.start.acceleration * std::fabs(p.start.acceleration) /
                                         (2 * p.limits.jerk)) > p.limits.velocity)
      p.start.acceleration = 0; // the search knows no way back from beyond the limit
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None);
    const double found = search(p, 200);
    ASSERT_LE(profile.duration, found * (1 + 1e-9)) << i << ": " << p;
    near += found <= profile.duration * 1.05 ? 1 : 0;
  }
  EXPECT_GT(near, cases * 7 / 10); // else the search would mean nothing
}

/// A problem whose acceleration and deceleration differ.
Problem unlikeProblem(Random &random) {
  Problem p = random.problem();
  while (p.limits.acceleration == p.limits.deceleration)
    p = random.problem();
  return p;
}

/// The duration with both rates equal to `rate`.
double durationWith(Problem p, double rate) {
  p.limits.acceleration = p.limits.deceleration = rate;
  Profile profile;
  EXPECT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None);
  return profile.duration;
}

// Where acceleration and deceleration differ, all motions within the weaker of both are allowed,
// and none beyond the stronger one: also where the velocity changes its sign.
TEST(ParabolicProperty, TurnsTakeNoLongerThanWithTheWeakerRate) {
  Random random(8);
  int turned = 0;
  for (int i = 0; i < casesOf(20000); ++i) {
    Problem p = unlikeProblem(random);
    p.endVelocity = 0;
    const double weaker = std::min(p.limits.acceleration, p.limits.deceleration);
    const double stronger = std::max(p.limits.acceleration, p.limits.deceleration);
    // States that can keep the limits: what is beyond goes back to them by ways of its own.
    p.start.acceleration = std::clamp(p.start.acceleration, -weaker, weaker);
    const double swing = p.start.acceleration * p.start.acceleration / (2 * p.limits.jerk);
    if (std::fabs(p.start.velocity) + swing > p.limits.velocity)
      continue;
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, 0, p.limits), PlanError::None) << p;
    ASSERT_EQ(wrong(profile, p), "") << p;
    // What the last digits of places make of the time.
    const double places = std::max(std::fabs(p.start.position), std::fabs(p.target)) +
                          profile.duration * (std::fabs(p.start.velocity) + swing);
    const double tick = 4 * std::cbrt(1e-14 * places / p.limits.jerk);
    ASSERT_LE(profile.duration, durationWith(p, weaker) * (1 + 1e-9) + tick) << p;
    ASSERT_GE(profile.duration, durationWith(p, stronger) * (1 - 1e-9) - tick) << p;
    turned += p.start.velocity * (p.target - p.start.position) < 0 ? 1 : 0;
  }
  EXPECT_GT(turned, casesOf(20000) / 20);
}

// The same of motions that end with a velocity. (These once rested first.)
TEST(ParabolicProperty, TurnsToAVelocityTakeNoLongerThanWithTheWeakerRate) {
  Random random(10);
  int turned = 0;
  for (int i = 0; i < casesOf(20000); ++i) {
    Problem p = unlikeProblem(random);
    p.endVelocity = random.uniform(-1, 1) * p.limits.velocity;
    const double weaker = std::min(p.limits.acceleration, p.limits.deceleration);
    p.start.acceleration = std::clamp(p.start.acceleration, -weaker, weaker);
    const double swing = p.start.acceleration * p.start.acceleration / (2 * p.limits.jerk);
    if (std::fabs(p.start.velocity) + swing > p.limits.velocity)
      continue;
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None)
        << p;
    ASSERT_EQ(wrong(profile, p), "") << p;
    const double places = std::max(std::fabs(p.start.position), std::fabs(p.target)) +
                          profile.duration * (std::fabs(p.start.velocity) + swing);
    const double tick = 4 * std::cbrt(1e-14 * places / p.limits.jerk);
    ASSERT_LE(profile.duration, durationWith(p, weaker) * (1 + 1e-9) + tick) << p;
    turned += p.start.velocity * p.endVelocity < 0 ? 1 : 0;
  }
  EXPECT_GT(turned, casesOf(20000) / 20);
}

// Hardly any difference of the rates makes hardly any difference of the time.
TEST(ParabolicProperty, TurnsAreThoseOfEqualRatesWhereTheyHardlyDiffer) {
  Random random(9);
  for (int i = 0; i < casesOf(20000); ++i) {
    Problem p = random.problem();
    p.endVelocity = 0;
    const double rate = p.limits.deceleration = p.limits.acceleration;
    const double equal = durationWith(p, rate);
    (random.chance(0.5) ? p.limits.acceleration : p.limits.deceleration) = rate * (1 - 1e-9);
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, 0, p.limits), PlanError::None) << p;
    // What the last digits of places make of the time, and the difference of a way that just
    // misses.
    const double places = std::max(std::fabs(p.start.position), std::fabs(p.target)) +
                          equal * (std::fabs(p.start.velocity) + rate * equal);
    const double tick = 4 * std::cbrt(1e-9 * places / p.limits.jerk);
    ASSERT_LE(std::fabs(profile.duration - equal), 1e-6 * equal + tick) << p;
  }
}

TEST(ParabolicProperty, PlanningAgainChangesNothing) {
  Random random(7);
  for (int i = 0; i < 30000; ++i) {
    Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None);
    const double t = random.uniform(0, 1) * profile.duration;
    const Problem rest = {profile.at(t), p.target, p.endVelocity, p.limits};
    Profile again;
    ASSERT_EQ(planParabolic(again, rest.start, rest.target, rest.endVelocity, rest.limits),
              PlanError::None);
    ASSERT_EQ(wrong(again, rest), "") << i << ": " << rest << " from " << p;
    if (p.limits.acceleration == p.limits.deceleration) {
      // The state on the way is rounded: what that takes at this jerk.
      const double size = std::max(std::fabs(p.start.position), std::fabs(p.target));
      const double slack = 1e-6 * profile.duration + 3 * std::cbrt(1e-15 * size / p.limits.jerk);
      ASSERT_NEAR(t + again.duration, profile.duration, slack) << i << ": " << p;
    }
  }
}

TEST(ParabolicProperty, OtherTargetsOnTheWay) {
  Random random(77);
  for (int i = 0; i < 30000; ++i) {
    Problem p = random.problem();
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None);
    for (int k = 0; k < 3; ++k) {
      Problem next = random.problem();
      next.start = profile.at(random.uniform(0, 1.05) * profile.duration);
      const double length = std::fabs(p.target - p.start.position) + 1e-9;
      next.target = next.start.position + random.uniform(-1, 1) * length;
      next.limits = p.limits;
      next.endVelocity = random.chance(0.3) ? p.limits.velocity * random.uniform(-1, 1) : 0.0;
      ASSERT_EQ(planParabolic(profile, next.start, next.target, next.endVelocity, next.limits),
                PlanError::None)
          << i << ": " << next;
      ASSERT_EQ(wrong(profile, next), "") << i << ": " << next;
      p = next;
    }
  }
}

TEST(ParabolicProperty, Velocities) {
  Random random(8);
  for (int i = 0; i < 100000; ++i) {
    Problem p = random.problem();
    p.endVelocity =
        random.chance(0.2) ? 0.0 : random.sign() * p.limits.velocity * random.uniform(0, 1);
    Profile profile;
    ASSERT_EQ(planParabolicVelocity(profile, p.start, p.endVelocity, p.limits), PlanError::None);
    p.target = profile.end.position;
    ASSERT_EQ(wrong(profile, p), "") << i << ": " << p;
    p.endVelocity = 0;
    ASSERT_EQ(planParabolicStop(profile, p.start, p.limits.deceleration, p.limits.jerk),
              PlanError::None);
    p.target = profile.end.position;
    p.limits.acceleration = p.limits.deceleration;
    ASSERT_EQ(wrong(profile, p), "") << i << ": " << p;
  }
}

/// Numbers of up to so many decades more or less than 1; the acceleration at the start may be
/// `beyond` decades greater than the limits.
Problem problemOfScales(Random &random, double decades, double beyond) {
  const auto any = [&] { return random.magnitude(-decades, decades); };
  Problem p{};
  p.start.position = random.chance(0.3) ? 0 : random.sign() * any();
  p.target = random.chance(0.1) ? p.start.position : random.sign() * any();
  p.start.velocity = random.chance(0.3) ? 0 : random.sign() * any();
  p.limits = {any(), any(), any(), any()};
  if (random.chance(0.7))
    p.start.acceleration = random.sign() * random.magnitude(-decades, beyond) *
                           std::max(p.limits.acceleration, p.limits.deceleration);
  return p;
}

TEST(ParabolicProperty, AllScales) {
  Random random(31);
  for (int i = 0; i < 50000; ++i) {
    const Problem p = problemOfScales(random, 15, 3);
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, 0.0, p.limits), PlanError::None) << p;
    ASSERT_EQ(profile.end.position, p.target) << p;
    ASSERT_EQ(broken(profile, p), "") << i << ": " << p;
  }
}

TEST(ParabolicProperty, ManyScalesToAVelocity) {
  Random random(37);
  for (int i = 0; i < 50000; ++i) {
    Problem p = problemOfScales(random, 4, 1);
    p.endVelocity = random.sign() * random.magnitude(-4, 0) * p.limits.velocity;
    Profile profile;
    ASSERT_EQ(planParabolic(profile, p.start, p.target, p.endVelocity, p.limits), PlanError::None)
        << p;
    ASSERT_EQ(profile.end.position, p.target) << p;
    ASSERT_EQ(broken(profile, p), "") << i << ": " << p;
  }
}

TEST(ParabolicProperty, AnyNumberIsPlannedOrRefused) {
  Random random(13);
  int planned = 0;
  const int cases = 50000;
  for (int i = 0; i < cases; ++i) {
    const auto any = [&] { return random.magnitude(-300, 300); };
    Problem p{};
    p.start = {random.sign() * any(), random.sign() * any(), random.sign() * any()};
    p.target = random.sign() * any();
    p.limits = {any(), any(), any(), any()};
    p.endVelocity = random.chance(0.5) ? 0.0 : random.uniform(-1, 1) * p.limits.velocity;
    Profile profile;
    const PlanError error = planParabolic(profile, p.start, p.target, p.endVelocity, p.limits);
    ASSERT_TRUE(error == PlanError::None || error == PlanError::Unrepresentable) << p;
    planned += error == PlanError::None ? 1 : 0;
    for (int k = 0; k <= 16; ++k) {
      const State state = profile.at(profile.duration * k / 16);
      ASSERT_FALSE(std::isnan(state.position) || std::isnan(state.velocity)) << i << ": " << p;
    }
  }
  EXPECT_GT(planned, cases / 20);
}

} // namespace
