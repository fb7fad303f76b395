// No motion is faster than the one that the jerk-limited planner finds where acceleration and
// deceleration differ and the velocity passes 0: beside a model that works over the velocity, where
// squares of accelerations are bounded by lines, and tries all places to leave the way to the
// highest velocity.
#include "runtime/numeric/profile/parabolic.hpp"

#include "tests/property/jerk_model.hpp"
#include "tests/property/move_problem.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace {

using stride::motion::JerkLimits;
using stride::motion::PlanError;
using stride::motion::planParabolic;
using stride::motion::Profile;
using stride::motion::State;
using Problem = stride::test::MoveProblem;
using stride::test::Moment;
using stride::test::Random;

/// A line over the velocity that the square of the acceleration does not exceed.
struct Line {
  long double at; ///< At the velocity 0.
  long double slope;
  [[nodiscard]] long double operator()(long double v) const { return at + slope * v; }
};

/// A piece of constant jerk.
struct Piece {
  Moment begin;
  long double jerk;
  long double time;
};

struct Model {
  JerkLimits limits;

  /// The fastest change to a velocity without acceleration, towards greater velocities. Empty if
  /// the state at the start leads beyond the limits.
  [[nodiscard]] std::vector<Piece> rising(Moment now, long double to) const {
    const long double twice = 2 * static_cast<long double>(limits.jerk);
    std::vector<Piece> pieces;
    if (now.a < 0) {
      pieces.push_back({now, limits.jerk, -now.a / limits.jerk});
      now = now.on(limits.jerk, -now.a / limits.jerk);
      now.a = 0;
    }
    const long double weaker = std::min(limits.acceleration, limits.deceleration);
    const std::vector<Line> lines = {{now.a * now.a - twice * now.v, twice},
                                     {twice * to, -twice},
                                     {weaker * weaker, -twice},
                                     {weaker * weaker, twice}};
    const auto allowed = [&](long double v, bool below) {
      const long double rate = below ? limits.deceleration : limits.acceleration;
      return std::min({rate * rate, lines[below ? 2 : 3](v), lines[1](v)});
    };
    const auto most = [&](long double v, bool below) {
      return std::max(std::min(allowed(v, below), lines[0](v)), 0.0L);
    };
    if (allowed(now.v, now.v < 0) < now.a * now.a * (1 - 1e-12L) - 1e-18L * twice * limits.velocity)
      return {};
    pieces.push_back({now, 0, 0});
    const long double squares[] = {
        static_cast<long double>(limits.acceleration) * limits.acceleration,
        static_cast<long double>(limits.deceleration) * limits.deceleration};
    std::vector<long double> edges = {now.v, to, 0};
    for (const Line &line : lines) {
      for (const long double square : squares)
        edges.push_back((square - line.at) / line.slope);
      for (const Line &other : lines)
        if (other.slope != line.slope)
          edges.push_back((other.at - line.at) / (line.slope - other.slope));
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 1; i < edges.size(); ++i) {
      const long double from = std::max(edges[i - 1], now.v);
      if (!(edges[i] > from) || edges[i] > to)
        continue;
      const bool below = from < 0;
      const long double a = std::sqrt(most(from, below));
      const long double b = std::sqrt(most(edges[i], below));
      if (!(a + b > 0))
        continue;
      const long double time = 2 * (edges[i] - from) / (a + b);
      now.a = a;
      const long double jerk = (b - a) / time;
      pieces.push_back({now, jerk, time});
      now = now.on(jerk, time);
      now.v = edges[i];
      now.a = b;
    }
    return pieces;
  }

  /// The same in both directions.
  [[nodiscard]] std::pair<std::vector<Piece>, long double> change(const Moment &from,
                                                                  long double to) const {
    const long double settled = from.v + from.a * std::fabs(from.a) / (2 * limits.jerk);
    const long double side = to >= settled ? 1 : -1;
    return {rising({from.time, side * from.s, side * from.v, side * from.a}, side * to), side};
  }

  /// Where and when such a change ends; no numbers if there is none.
  [[nodiscard]] Moment changed(const Moment &from, long double to) const {
    const auto [pieces, side] = change(from, to);
    if (pieces.empty())
      return {NAN, NAN, to, 0};
    const Piece &last = pieces.back();
    const Moment end = last.begin.on(last.jerk, last.time);
    return {end.time, side * end.s, to, 0};
  }

  /// The shortest time of all that go to the highest velocity first.
  [[nodiscard]] long double shortestUp(const Moment &start, long double distance, long double end,
                                       int grid) const {
    long double best = HUGE_VALL;
    const std::vector<Piece> upward = rising(start, limits.velocity);
    if (upward.empty())
      return best;
    for (const Piece &piece : upward) {
      const auto beyond = [&](long double time) {
        return changed(piece.begin.on(piece.jerk, time), end).s - distance;
      };
      long double before = beyond(0);
      for (int i = 1; i <= grid && best == HUGE_VALL; ++i) {
        long double high = piece.time * i / grid;
        const long double now = beyond(high);
        if (!std::isnan(now - before) && (now < 0) != (before < 0)) {
          long double low = piece.time * (i - 1) / grid;
          for (int k = 0; k < 70; ++k) {
            const long double middle = (low + high) / 2;
            ((beyond(middle) < 0) == (before < 0) ? low : high) = middle;
          }
          best = changed(piece.begin.on(piece.jerk, high), end).time;
        }
        before = now;
      }
    }
    const Moment fastest = upward.back().begin.on(upward.back().jerk, upward.back().time);
    const Moment last = changed({fastest.time, fastest.s, limits.velocity, 0}, end);
    const long double missing = distance - last.s;
    return missing >= 0 ? std::min(best, last.time + missing / limits.velocity) : best;
  }

  [[nodiscard]] long double shortest(const Moment &start, long double distance, long double end,
                                     int grid) const {
    return std::min(shortestUp(start, distance, end, grid),
                    shortestUp({0, 0, -start.v, -start.a}, -distance, -end, grid));
  }
};

/// States that can keep the limits. `slowing`: the axis slows down towards an end velocity on the
/// other side of 0, and the target is near the place where it would have got it: there a later end
/// of the push may reach less far.
Problem problemOf(Random &random, bool slowing) {
  Problem p{};
  p.limits.velocity = random.magnitude(-1, 2);
  p.limits.acceleration = p.limits.velocity * random.magnitude(-1, 2);
  p.limits.deceleration = p.limits.acceleration * random.magnitude(-1, 1);
  const double weaker = std::min(p.limits.acceleration, p.limits.deceleration);
  p.limits.jerk = weaker * random.magnitude(-1, 2);
  const double most = std::min(weaker, std::sqrt(p.limits.velocity * p.limits.jerk));
  p.start.acceleration = random.chance(0.2) ? 0.0 : random.uniform(-1, 1) * most;
  const double swing = p.start.acceleration * p.start.acceleration / (2 * p.limits.jerk);
  const double room = p.limits.velocity - swing;
  p.start.velocity = random.chance(0.1) ? 0.0 : random.uniform(-1, 1) * room;
  p.endVelocity = random.chance(0.1) ? 0.0 : random.uniform(-1, 1) * p.limits.velocity;
  if (slowing) {
    const double side = p.start.acceleration < 0 ? 1.0 : -1.0;
    p.start.velocity = side * std::min(room, swing * random.uniform(0, 3));
    p.endVelocity = -side * std::fabs(p.endVelocity);
  }
  const Moment direct =
      Model{p.limits}.changed({0, 0, p.start.velocity, p.start.acceleration}, p.endVelocity);
  const double length = static_cast<double>(direct.time) * p.limits.velocity;
  const double near = slowing ? random.magnitude(-5, 0) : random.magnitude(-3, 1);
  p.target = static_cast<double>(direct.s) + random.sign() * length * near;
  return p;
}

/// Empty when the planner's motion is as fast as the fastest; else what is wrong.
std::string slower(const Problem &p, int grid) {
  Profile profile{};
  if (planParabolic(profile, p.start, p.target, p.endVelocity, p.limits) != PlanError::None)
    return "refused";
  if (profile.end.position != p.target || profile.end.velocity != p.endVelocity)
    return "end";
  const auto best = static_cast<double>(Model{p.limits}.shortest(
      {0, 0, p.start.velocity, p.start.acceleration}, p.target, p.endVelocity, grid));
  if (!(profile.duration <= best * (1 + 1e-9)))
    return std::to_string(profile.duration) + " s, but " + std::to_string(best) + " is enough";
  return "";
}

RC_GTEST_PROP(TurningProperty, AnyState, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  for (int i = 0; i < 10; ++i) {
    const Problem p = problemOf(random, false);
    RC_LOG() << p;
    RC_ASSERT(slower(p, 25) == "");
  }
}

RC_GTEST_PROP(TurningProperty, WhileTheAxisSlowsDown, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  for (int i = 0; i < 10; ++i) {
    const Problem p = problemOf(random, true);
    RC_LOG() << p;
    RC_ASSERT(slower(p, 40) == "");
  }
}

// Where a planner is much slower that forgets one reason why the reach grows again: the limit of
// the acceleration after the push (two), the weaker rate at standstill (one); or takes the wrong
// one of both equations (two), or forgets the fall itself (all).
TEST(TurningProperty, NarrowPlaces) {
  const Problem problems[] = {
      {{0, 0.0285740094, -0.629668422},
       -0.0316715449,
       -0.144159615,
       {0.153789425, 0.658399228, 3.87607148, 2.58778590}},
      {{0, 12.6085940627, -145.790169460},
       -11.8025654451,
       -49.2349488,
       {96.9885225, 152.154760, 257.596780, 795.091506}},
      {{0, 0.0699856791, -8.63782360},
       -0.0140846730,
       -0.395417856,
       {1.3222772, 76.000161, 8.85390332, 269.896063}},
      {{0, 0.0123446840, -0.0689428929},
       -0.0356387650,
       -0.0500371699,
       {0.0593971341, 0.628490583, 0.0724966164, 0.0828001447}},
      {{0, 4.81574243, -18.1598849},
       -13.2535280,
       -17.1677178,
       {21.0663377, 27.2905248, 21.4692585, 23.4154635}},
      {{0, 67.9213911, -867.887539},
       -0.0626252,
       -34.6179001,
       {178.678487, 2009.10570, 2043.74667, 4302.86007}},
  };
  for (const Problem &p : problems)
    EXPECT_EQ(slower(p, 400), "") << p;
}

} // namespace
