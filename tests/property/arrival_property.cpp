// Motions that arrive at a given time: when there is one, beside a model, and whether it keeps its
// promises.
#include "runtime/numeric/profile/arrival.hpp"

#include "tests/property/jerk_model.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using stride::motion::ArrivalLimits;
using stride::motion::ArrivalTimes;
using stride::motion::commonArrival;
using stride::motion::findArrivalTimes;
using stride::motion::planArrival;
using stride::motion::PlanError;
using stride::motion::Profile;
using stride::motion::Segment;
using stride::motion::State;
using stride::test::Model;
using stride::test::Moment;
using stride::test::pushed;
using stride::test::Random;

struct Problem {
  State start;
  double target;
  double endVelocity;
  ArrivalLimits limits;

  [[nodiscard]] Model model() const {
    return {limits.lowest, limits.highest, limits.rising,          limits.falling,
            limits.jerk,   endVelocity,    target - start.position};
  }
  [[nodiscard]] Moment moment() const { return {0, 0, start.velocity, start.acceleration}; }
};

std::ostream &operator<<(std::ostream &out, const Problem &p) {
  out.precision(17);
  return out << "{{" << p.start.position << ", " << p.start.velocity << ", " << p.start.acceleration
             << "}, " << p.target << ", " << p.endVelocity << ", {" << p.limits.highest << ", "
             << p.limits.lowest << ", " << p.limits.rising << ", " << p.limits.falling << ", "
             << p.limits.jerk << "}}";
}

/// `turning`: the axis turns on its way to the end velocity, and the target is near the place where
/// it would have got it: where times are blocked.
Problem problemOf(Random &random, bool turning) {
  Problem p{};
  p.limits.highest = random.magnitude(-1, 2);
  p.limits.lowest = -p.limits.highest * random.magnitude(-0.5, 0.5);
  p.limits.rising = p.limits.highest * random.magnitude(-1, 2);
  p.limits.falling = p.limits.rising * random.magnitude(-0.7, 0.7);
  p.limits.jerk = p.limits.rising * random.magnitude(-1, 2);
  const double slower = std::min(p.limits.highest, -p.limits.lowest);
  const double most =
      std::min({p.limits.rising, p.limits.falling, std::sqrt(slower * p.limits.jerk)});
  p.start.position = random.uniform(-10, 10);
  p.start.acceleration = random.chance(0.2) ? 0.0 : random.uniform(-1, 1) * most;
  const double swing = p.start.acceleration * p.start.acceleration / (2 * p.limits.jerk);
  p.start.velocity = random.uniform(p.limits.lowest + swing, p.limits.highest - swing);
  p.endVelocity = random.chance(0.3) ? 0.0 : random.uniform(p.limits.lowest, p.limits.highest);
  if (turning) {
    const double side = p.start.acceleration < 0 ? 1.0 : -1.0;
    p.start.velocity = side * random.uniform(0, 1) * (slower - swing);
    p.endVelocity = -side * random.uniform(0, 1) * slower;
  }
  const Model model = p.model();
  const Moment direct = model.changed(p.moment(), p.endVelocity);
  const double length = static_cast<double>(direct.time) * slower;
  p.target = p.start.position + (turning ? static_cast<double>(direct.s) +
                                               random.sign() * length * random.magnitude(-4, 0)
                                         : random.sign() * length * random.magnitude(-3, 1));
  return p;
}

/// The farthest place that the model gets to in this time.
long double farthest(const Model &model, const Moment &start, long double time) {
  long double low = 0;
  long double high = 2;
  const Moment last = pushed(model, start, high);
  if (time >= last.time)
    return last.s + (time - last.time) * model.high;
  for (int i = 0; i < 100; ++i) {
    const long double middle = (low + high) / 2;
    (pushed(model, start, middle).time < time ? low : high) = middle;
  }
  return pushed(model, start, high).s;
}

/// How far inside of what can be reached in this time the target is, in lengths; negative: outside.
double inside(const Problem &p, double time) {
  const Model model = p.model();
  const Moment start = p.moment();
  const Moment mirrored = {0, 0, -start.v, -start.a};
  if (time < model.changed(start, p.endVelocity).time)
    return -HUGE_VAL;
  const long double most = farthest(model, start, time);
  const long double least = -farthest(model.mirrored(), mirrored, time);
  return static_cast<double>(std::min(most - model.distance, model.distance - least));
}

State at(const Segment &segment, double t) {
  return stride::test::movedOn(segment.origin, segment.jerk, t - segment.reference);
}

/// Empty when the profile keeps its promises; else what is wrong.
std::string wrong(const Profile &profile, const Problem &p, double duration) {
  if (profile.duration != duration || profile.end.position != p.target ||
      profile.end.velocity != p.endVelocity || profile.end.acceleration != 0)
    return "end";
  const ArrivalLimits &l = p.limits;
  const double fastest = std::max(l.highest, -l.lowest);
  const double hardest = std::max(l.rising, l.falling);
  const double place =
      1e-11 * (std::fabs(p.start.position) + std::fabs(p.target) + fastest * duration);
  const double velocity = 1e-11 * (fastest + hardest * duration);
  const double acceleration = 1e-11 * (hardest + l.jerk * duration);
  State last = p.start;
  for (int32_t i = 0; i < profile.count; ++i) {
    const Segment &segment = profile.segments[i];
    const double from = segment.start;
    const double to = i + 1 < profile.count ? profile.segments[i + 1].start : duration;
    const State now = at(segment, from);
    if (!(to >= from) || std::fabs(now.position - last.position) > place ||
        std::fabs(now.velocity - last.velocity) > velocity ||
        std::fabs(now.acceleration - last.acceleration) > acceleration)
      return "jump at " + std::to_string(from) + " by " +
             std::to_string((now.position - last.position) / place) + ", " +
             std::to_string((now.velocity - last.velocity) / velocity) + ", " +
             std::to_string((now.acceleration - last.acceleration) / acceleration) +
             " of what is rounding, duration " + std::to_string(duration) + " count " +
             std::to_string(profile.count) + " place " + std::to_string(i);
    if (std::fabs(segment.jerk) > l.jerk * (1 + 1e-9))
      return "jerk";
    for (int k = 0; k <= 8; ++k) {
      const State s = at(segment, from + (to - from) * k / 8);
      if (s.velocity > l.highest + velocity || s.velocity < l.lowest - velocity)
        return "velocity " + std::to_string(s.velocity);
      if (s.acceleration > l.rising + acceleration || s.acceleration < -l.falling - acceleration)
        return "acceleration " + std::to_string(s.acceleration);
    }
    last = at(segment, to);
  }
  const bool arrived = std::fabs(last.position - p.target) <= place &&
                       std::fabs(last.velocity - p.endVelocity) <= velocity &&
                       std::fabs(last.acceleration) <= acceleration;
  return arrived ? "" : "does not arrive";
}

bool isFree(const ArrivalTimes &times, double time) {
  bool free = time >= times.shortest;
  for (int32_t i = 0; i < times.blockedCount; ++i)
    free = free && !(time > times.blocked[i].from && time < times.blocked[i].to);
  return free;
}

/// Judges one duration: empty when all say the same of it.
std::string judged(const Problem &p, const ArrivalTimes &times, double time) {
  Profile profile{};
  const PlanError error = planArrival(profile, p.start, p.target, p.endVelocity, p.limits, time);
  if (error != PlanError::None && error != PlanError::Blocked)
    return "refused";
  const double room = inside(p, time);
  const double scale =
      std::fabs(p.target - p.start.position) + time * std::max(p.limits.highest, -p.limits.lowest);
  if (std::fabs(room) > 1e-9 * scale) {
    if (isFree(times, time) != (room > 0))
      return "at " + std::to_string(time) + " times say " + std::to_string(isFree(times, time));
    if ((error == PlanError::None) != (room > 0))
      return "at " + std::to_string(time) + " the plan says " +
             std::to_string(error == PlanError::None);
  }
  return error == PlanError::None ? wrong(profile, p, time) : "";
}

void judge(Random &random, const Problem &p, int &blocked) {
  ArrivalTimes times{};
  RC_LOG() << p << '\n';
  RC_ASSERT(findArrivalTimes(times, p.start, p.target, p.endVelocity, p.limits) == PlanError::None);
  blocked += times.blockedCount;
  std::vector<double> durations = {times.shortest, times.shortest * 0.99};
  for (int i = 0; i < 6; ++i)
    durations.push_back(times.shortest * (1 + random.magnitude(-6, 1)));
  double before = times.shortest;
  for (int32_t i = 0; i < times.blockedCount; ++i) {
    const auto &interval = times.blocked[i];
    RC_ASSERT(interval.from >= before);
    RC_ASSERT(interval.to > interval.from);
    const double width = interval.to - interval.from;
    for (const double place : {-0.01, 0.0, 0.01, 0.5, 0.99, 1.0, 1.01})
      durations.push_back(interval.from + place * width);
    before = interval.to;
  }
  for (const double duration : durations)
    RC_ASSERT(judged(p, times, duration) == "");
}

RC_GTEST_PROP(ArrivalProperty, AnyState, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  int blocked = 0;
  for (int i = 0; i < 10; ++i)
    judge(random, problemOf(random, false), blocked);
}

RC_GTEST_PROP(ArrivalProperty, BlockedTimes, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  int blocked = 0;
  for (int i = 0; i < 10; ++i)
    judge(random, problemOf(random, true), blocked);
  RC_CLASSIFY(blocked > 0, "some blocked");
}

// The axes arrive at the least time that none of them blocks.
RC_GTEST_PROP(ArrivalProperty, SeveralAxes, ()) {
  Random random(*rc::gen::arbitrary<uint64_t>());
  std::vector<ArrivalTimes> axes(static_cast<size_t>(1 + random.below(6)));
  std::vector<double> candidates;
  for (ArrivalTimes &axis : axes) {
    axis.shortest = random.uniform(0, 3);
    axis.blockedCount = random.below(3);
    double time = axis.shortest;
    candidates.push_back(time);
    for (int32_t i = 0; i < axis.blockedCount; ++i) {
      axis.blocked[i].from = time + random.uniform(0, 1);
      time = axis.blocked[i].to = axis.blocked[i].from + random.uniform(0.1, 2);
      candidates.push_back(time);
    }
  }
  double best = HUGE_VAL;
  for (const double time : candidates)
    if (std::all_of(axes.begin(), axes.end(),
                    [&](const ArrivalTimes &axis) { return isFree(axis, time); }))
      best = std::min(best, time);
  RC_ASSERT(commonArrival(axes.data(), static_cast<int32_t>(axes.size())) == best);
}

TEST(Arrival, RefusesWhatCannotBe) {
  const ArrivalLimits limits = {3, -2, 5, 7, 40};
  const double nan = std::nan("");
  ArrivalTimes times{};
  Profile profile{};
  const auto errorOf = [&](const State &start, double target, double end, const ArrivalLimits &l) {
    const PlanError error = findArrivalTimes(times, start, target, end, l);
    EXPECT_EQ(planArrival(profile, start, target, end, l, 100), error);
    return error;
  };
  EXPECT_EQ(errorOf({0, 1, 2}, 4, -1, limits), PlanError::None);
  EXPECT_EQ(errorOf({nan, 1, 2}, 4, -1, limits), PlanError::InvalidState);
  EXPECT_EQ(errorOf({0, 3.01, 0}, 4, -1, limits), PlanError::InvalidState);
  EXPECT_EQ(errorOf({0, 1, 5.01}, 4, -1, limits), PlanError::InvalidState);
  EXPECT_EQ(errorOf({0, 1, -7.01}, 4, -1, limits), PlanError::InvalidState);
  EXPECT_EQ(errorOf({0, 1, 0}, 4, 3.01, limits), PlanError::InvalidState);
  EXPECT_EQ(errorOf({0, 1, 0}, 4, -2.01, limits), PlanError::InvalidState);
  EXPECT_EQ(errorOf({0, 1, 0}, 4, 0, {3, 2, 5, 7, 40}), PlanError::InvalidLimit);
  EXPECT_EQ(errorOf({0, 1, 0}, 4, 0, {3, -2, 5, 0, 40}), PlanError::InvalidLimit);
  EXPECT_EQ(planArrival(profile, {0, 1, 2}, 4, -1, limits, nan), PlanError::Unrepresentable);
  EXPECT_EQ(planArrival(profile, {0, 1, 2}, 4, -1, limits, 0.1), PlanError::Blocked);
  EXPECT_EQ(profile.count, 0);
}

// From rest to rest no time is blocked, and the mean of both ways stands still at last.
TEST(Arrival, FromRestToRestAtAnyTime) {
  const ArrivalLimits limits = {3, -2, 5, 7, 40};
  ArrivalTimes times{};
  ASSERT_EQ(findArrivalTimes(times, {1, 0, 0}, 4, 0, limits), PlanError::None);
  EXPECT_EQ(times.blockedCount, 0);
  Profile profile{};
  EXPECT_EQ(planArrival(profile, {1, 0, 0}, 4, 0, limits, times.shortest * (1 - 1e-9)),
            PlanError::Blocked);
  for (const double factor : {1.0, 1.0 + 1e-9, 1.5, 40.0}) {
    const double duration = factor * times.shortest;
    ASSERT_EQ(planArrival(profile, {1, 0, 0}, 4, 0, limits, duration), PlanError::None);
    EXPECT_EQ(wrong(profile, {{1, 0, 0}, 4, 0, limits}, duration), "");
  }
}

} // namespace
