// No plan is slower than motions found by sampling, which know nothing of the planners' cases.
#include "motion_problems.hpp"

#include <gtest/gtest.h>

namespace {

using stride::motion::Dynamics;
using stride::motion::PlanError;
using stride::motion::planMove;
using stride::motion::Profile;
using stride::motion::RampType;
using stride::motion::State;
using stride::test::casesOf;
using stride::test::hasAcceleration;
using stride::test::MotionProblem;
using stride::test::MotionRandom;

/// A part of a motion: what it takes.
struct Part {
  double time;
  double way;
};

/// How long a change of velocity by `size` > 0 lasts: the textbook's formula of each shape.
double timeOf(double size, double rate, const Dynamics &d) {
  switch (d.ramp) {
  case RampType::Trapezoid:
  case RampType::Sigmoid:
    return size / rate;
  case RampType::SigmoidLimited: {
    // v = size * sin^2(pi t / 2T): the acceleration peaks at pi size / 2T, the jerk at
    // pi^2 size / 2T^2.
    const double byRate = M_PI * size / (2 * rate);
    const double byJerk = std::sqrt(M_PI * M_PI * size / (2 * d.jerk));
    return std::max(byRate, byJerk);
  }
  case RampType::Parabolic:
    return size <= rate * rate / d.jerk ? 2 * std::sqrt(size / d.jerk)
                                        : size / rate + rate / d.jerk;
  }
  return HUGE_VAL;
}

/// A change of velocity, through standstill if need be. All shapes are symmetrical in time.
Part change(double from, double to, const Dynamics &d) {
  if (from * to < 0) {
    const Part down = change(from, 0, d);
    const Part up = change(0, to, d);
    return {down.time + up.time, down.way + up.way};
  }
  if (from == to)
    return {0, 0};
  const double rate = std::fabs(to) > std::fabs(from) ? d.acceleration : d.deceleration;
  const double time = timeOf(std::fabs(to - from), rate, d);
  return {time, 0.5 * (from + to) * time};
}

/// Motions start -> without acceleration -> held velocity -> end velocity.
class Alternatives {
public:
  explicit Alternatives(const MotionProblem &p) : p_(p), velocity_(p.start.velocity) {
    distance_ = p.target - p.start.position;
    if (!hasAcceleration(p.dynamics))
      return;
    const double a = p.start.acceleration;
    const double t = std::fabs(a) / p.dynamics.jerk;
    const double j = a > 0 ? -p.dynamics.jerk : p.dynamics.jerk;
    time_ = t;
    distance_ -= velocity_ * t + a * t * t / 2 + j * t * t * t / 6;
    velocity_ += a * t + j * t * t / 2;
  }

  /// The velocity when the acceleration of the start is gone.
  [[nodiscard]] double settled() const { return velocity_; }

  /// The time if the axis is taken to `held` directly, or through `first`.
  [[nodiscard]] double through(double held) const {
    return total(change(velocity_, held, p_.dynamics), held);
  }
  [[nodiscard]] double through(double first, double held) const {
    const Part one = change(velocity_, first, p_.dynamics);
    const Part two = change(first, held, p_.dynamics);
    return total({one.time + two.time, one.way + two.way}, held);
  }

private:
  [[nodiscard]] double total(const Part &before, double held) const {
    const Part last = change(held, p_.endVelocity, p_.dynamics);
    const double hold = held != 0 ? (distance_ - before.way - last.way) / held : -1;
    return hold >= 0 ? time_ + before.time + hold + last.time : HUGE_VAL;
  }

  const MotionProblem &p_;
  double velocity_;
  double distance_;
  double time_ = 0;
};

/// Whether the plan is promised to be the fastest.
bool isOptimal(const MotionProblem &p, double settled) {
  const Dynamics &d = p.dynamics;
  if (d.ramp != RampType::Parabolic)
    return true;
  // Staying beyond the limit for longer would be faster.
  if (std::fabs(p.start.velocity) > d.velocity || std::fabs(settled) > d.velocity)
    return false;
  if (d.acceleration == d.deceleration)
    return true;
  // What turns the velocity before it is gone makes the axis stop first.
  return p.start.velocity * settled >= 0;
}

class AlternativesProperty : public testing::TestWithParam<RampType> {};

TEST_P(AlternativesProperty, RandomOnesAreNotFaster) {
  MotionRandom random(600);
  int found = 0;
  int possible = 0;
  for (int i = 0; i < casesOf(100000); ++i) {
    const MotionProblem p = random.problem(GetParam());
    const Alternatives alternatives(p);
    if (!isOptimal(p, alternatives.settled()))
      continue;
    Profile profile;
    ASSERT_EQ(planMove(profile, p.start, p.target, p.endVelocity, p.dynamics), PlanError::None);
    const double limit = p.dynamics.velocity;
    double best = HUGE_VAL;
    const auto consider = [&](double held) {
      if (std::fabs(held) <= limit)
        best = std::min(best, alternatives.through(held));
    };
    for (int k = 0; k < 12; ++k)
      consider(random.uniform(-1, 1) * limit);
    for (const double held : {limit, -limit, p.endVelocity, alternatives.settled()})
      consider(held);
    ASSERT_LE(profile.duration, best * (1 + 1e-9)) << i << ": " << p;
    ++possible;
    found += best <= profile.duration * 1.1 ? 1 : 0;
  }
  EXPECT_GT(possible, casesOf(50000));
  EXPECT_GT(found, possible / 3); // else they would mean nothing
}

TEST_P(AlternativesProperty, NoSearchFindsAFasterMotion) {
  MotionRandom random(4711);
  int near = 0;
  int cases = 0;
  for (int i = 0; i < casesOf(3000); ++i) {
    const MotionProblem p = random.problem(GetParam());
    const Alternatives alternatives(p);
    if (!isOptimal(p, alternatives.settled()))
      continue;
    Profile profile;
    ASSERT_EQ(planMove(profile, p.start, p.target, p.endVelocity, p.dynamics), PlanError::None);
    const double limit = p.dynamics.velocity;
    double best = HUGE_VAL;
    constexpr int kGrid = 200;
    for (int k = -kGrid; k <= kGrid; ++k) {
      const double held = limit * k / kGrid;
      best = std::min(best, alternatives.through(held));
      for (int m = -8; m <= 8; ++m)
        best = std::min(best, alternatives.through(limit * m / 8, held));
    }
    ASSERT_LE(profile.duration, best * (1 + 1e-9)) << i << ": " << p;
    ++cases;
    near += best <= profile.duration * 1.05 ? 1 : 0;
  }
  EXPECT_GT(cases, casesOf(1500));
  EXPECT_GT(near, cases / 2);
  RecordProperty("near", near);
}

// The manual's flavour: from a state without acceleration it takes the trapezoid's time.
TEST(Sigmoid, LastsAsLongAsTheTrapezoid) {
  MotionRandom random(9);
  for (int i = 0; i < casesOf(100000); ++i) {
    MotionProblem p = random.problem(RampType::Sigmoid);
    p.start.acceleration = 0;
    Profile sigmoid;
    Profile trapezoid;
    ASSERT_EQ(planMove(sigmoid, p.start, p.target, p.endVelocity, p.dynamics), PlanError::None);
    p.dynamics.ramp = RampType::Trapezoid;
    ASSERT_EQ(planMove(trapezoid, p.start, p.target, p.endVelocity, p.dynamics), PlanError::None);
    ASSERT_NEAR(sigmoid.duration, trapezoid.duration, 1e-12 * trapezoid.duration) << i << ": " << p;
    ASSERT_EQ(sigmoid.count, trapezoid.count);
    for (int32_t k = 0; k < sigmoid.count; ++k) {
      // Where the pieces meet, both are at the same place with the same velocity.
      const double t = trapezoid.segments[k].start;
      const State a = sigmoid.at(t);
      const State b = trapezoid.at(t);
      ASSERT_NEAR(a.velocity, b.velocity, 1e-9 * (std::fabs(b.velocity) + p.dynamics.velocity));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, AlternativesProperty, testing::ValuesIn(stride::test::kRampTypes),
                         stride::test::rampName);

} // namespace
