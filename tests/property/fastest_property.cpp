// No admissible motion is faster than the one that the jerk-limited planner finds: beside a model
// that tries all that can be the fastest.
#include "runtime/numeric/profile/parabolic.hpp"

#include "tests/property/jerk_model.hpp"
#include "tests/property/move_problem.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using stride::motion::JerkLimits;
using stride::motion::PlanError;
using stride::motion::planParabolic;
using stride::motion::Profile;
using stride::motion::State;
using Problem = stride::test::MoveProblem;
using stride::test::Model;
using stride::test::Moment;
using stride::test::pushed;
using stride::test::Random;

/// The shortest time of all that are pushed up first.
long double shortestPushed(const Model &model, const Moment &start, int grid) {
  long double best = HUGE_VALL;
  const auto beyond = [&](long double part) {
    return pushed(model, start, part).s - model.distance;
  };
  long double before = beyond(0);
  for (int i = 1; i <= grid && best == HUGE_VALL; ++i) {
    const long double part = 2.0L * i / grid;
    const long double now = beyond(part);
    if ((now < 0) != (before < 0)) {
      long double low = 2.0L * (i - 1) / grid;
      long double high = part;
      for (int k = 0; k < 80; ++k) {
        const long double middle = (low + high) / 2;
        ((beyond(middle) < 0) == (before < 0) ? low : high) = middle;
      }
      best = pushed(model, start, high).time;
    }
    before = now;
  }
  // Or it goes on at the highest velocity.
  const Moment fastest = model.changed(start, model.high);
  const Moment last = model.changed(fastest, model.endVelocity);
  const long double missing = model.distance - last.s;
  if (model.high != 0 && missing / model.high >= 0)
    best = std::min(best, last.time + missing / model.high);
  return best;
}

/// The shortest time of all motions: by Pontryagin's principle one that is pushed to one side, held
/// at the greatest velocity there, and pushed back.
long double shortest(const Model &model, const Moment &start, int grid) {
  const Moment mirrored = {0, 0, -start.v, -start.a};
  return std::min(shortestPushed(model, start, grid),
                  shortestPushed(model.mirrored(), mirrored, grid));
}

Model modelOf(const Problem &p) {
  const JerkLimits &limits = p.limits;
  return {-limits.velocity, limits.velocity, limits.acceleration,        limits.acceleration,
          limits.jerk,      p.endVelocity,   p.target - p.start.position};
}

/// States that can keep the limits. `turning`: the axis turns on its way to the end velocity, and
/// the target is near the place where it would have got it: there a longer push may reach less far.
Problem problemOf(Random &random, bool turning) {
  Problem p{};
  p.limits.velocity = random.magnitude(-1, 2);
  p.limits.acceleration = p.limits.velocity * random.magnitude(-1, 2);
  p.limits.deceleration = p.limits.acceleration;
  p.limits.jerk = p.limits.acceleration * random.magnitude(-1, 2);
  p.start.position = random.uniform(-10, 10);
  const double most = std::min(p.limits.acceleration, std::sqrt(p.limits.velocity * p.limits.jerk));
  p.start.acceleration = random.chance(0.2) ? 0.0 : random.uniform(-1, 1) * most;
  const double swing = p.start.acceleration * std::fabs(p.start.acceleration) / (2 * p.limits.jerk);
  const double room = p.limits.velocity - std::fabs(swing);
  p.start.velocity = random.chance(0.1) ? 0.0 : random.uniform(-1, 1) * room;
  p.endVelocity = random.uniform(-1, 1) * p.limits.velocity;
  if (turning) {
    const double side = p.start.acceleration < 0 ? 1.0 : -1.0;
    p.start.velocity = side * std::fabs(p.start.velocity) * random.uniform(0, 1);
    p.endVelocity = -side * std::fabs(p.endVelocity);
  }
  const Model model = modelOf(p);
  const Moment direct =
      model.changed({0, 0, p.start.velocity, p.start.acceleration}, p.endVelocity);
  const double length = static_cast<double>(direct.time) * p.limits.velocity;
  p.target = p.start.position + (turning ? static_cast<double>(direct.s) +
                                               random.sign() * length * random.magnitude(-4, 0)
                                         : random.sign() * length * random.magnitude(-3, 1));
  return p;
}

/// Empty when the planner's motion is as fast as the fastest; else what is wrong.
std::string slower(const Problem &p, int grid, double slack) {
  Profile profile{};
  if (planParabolic(profile, p.start, p.target, p.endVelocity, p.limits) != PlanError::None)
    return "refused";
  if (profile.end.position != p.target || profile.end.velocity != p.endVelocity)
    return "end";
  const auto best = static_cast<double>(
      shortest(modelOf(p), {0, 0, p.start.velocity, p.start.acceleration}, grid));
  if (!(profile.duration <= best * (1 + slack)))
    return std::to_string(profile.duration) + " s, but " + std::to_string(best) + " is enough";
  return "";
}

RC_GTEST_PROP(FastestProperty, AnyState, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  for (int i = 0; i < 20; ++i) {
    const Problem p = problemOf(random, false);
    RC_LOG() << p;
    RC_ASSERT(slower(p, 200, 1e-9) == "");
  }
}

RC_GTEST_PROP(FastestProperty, TurningToTheEndVelocity, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  for (int i = 0; i < 20; ++i) {
    const Problem p = problemOf(random, true);
    RC_LOG() << p;
    RC_ASSERT(slower(p, 400, 1e-9) == "");
  }
}

} // namespace
