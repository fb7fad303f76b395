#include "runtime/numeric/profile/arrival.hpp"

#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/parabolic_push.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion {
namespace {

using parabolic::kEpsilon;
using parabolic::Task;

/// A piece of constant jerk.
struct Piece {
  double duration;
  double jerk;
  double acceleration; ///< At its end: exact where it is a limit or 0.
};

/// A motion that is pushed up first, of a given duration.
struct Course {
  double rate;   ///< The acceleration at which the push ends.
  double fall;   ///< The acceleration after the velocity has fallen, without its sign.
  double most;   ///< The greatest velocity, times the jerk.
  double cruise; ///< How long it is kept.
};

/// The motions of a task that are pushed up first: those that get farthest in their time. Times and
/// velocities are counted as in parabolic_push.cpp.
class Farthest {
public:
  explicit Farthest(const Task &task) noexcept : task_(task), jerk_(task.rates.jerk) {
    const double velocity = task.velocity * jerk_;
    const double square = task.acceleration * task.acceleration;
    start_ = velocity - 0.5 * square;
    end_ = task.endVelocity * jerk_;
    top_ = task.top * jerk_;
    offset_ = task.acceleration * (velocity - square * (1.0 / 3.0));
    const double settled = task.acceleration > 0.0 ? velocity + 0.5 * square : start_;
    least_ = exact::larger(settled, end_);
    first_ = task.acceleration;
    if (end_ > start_)
      first_ = exact::larger(first_, exact::sqrt(end_ - start_));
    first_ = exact::smaller(first_, task.rates.rising);
  }

  /// The duration of the direct change of velocity.
  [[nodiscard]] double shortest() const noexcept {
    const double most = first_ < 0.0 ? start_ + first_ * first_ : least_;
    return first_ < 0.0 ? (2.0 * first_ - task_.acceleration + side(most - end_, falling())) / jerk_
                        : lasting(most);
  }
  /// The duration from which on the top velocity is reached.
  [[nodiscard]] double toTop() const noexcept { return lasting(top_); }

  /// The one of this duration.
  [[nodiscard]] Course at(double duration) const noexcept {
    const double whole = jerk_ * duration + task_.acceleration; // from the virtual start
    const double gain = start_ - end_;
    Course course{};
    const double half = 0.5 * whole;
    double rate = (half * half - gain) / (2.0 * half);
    double fall = half - rate;
    if (fall > falling()) {
      fall = falling();
      rate = exact::sqrt(exact::larger(fall * whole - gain, 0.0)) - fall;
    }
    if (rate > rising()) {
      rate = rising();
      fall = exact::sqrt(exact::larger(rate * whole + gain, 0.0)) - rate;
    }
    rate = exact::larger(rate, first_);
    if (rate < rising())
      course.most = start_ + rate * rate;
    else if (fall < falling())
      course.most = end_ + (fall > 0.0 ? fall * fall : 0.0);
    else
      course.most = (whole - rising() - falling() + start_ / rising() + end_ / falling()) /
                    (1.0 / rising() + 1.0 / falling());
    if (rate >= 0.0)
      course.most = exact::larger(course.most, least_);
    if (course.most > top_) {
      course.most = top_;
      course.cruise = exact::larger(duration - toTop(), 0.0);
    }
    course.rate = rate < 0.0 ? rate : accelerationOf(course.most - start_, rising());
    course.fall = accelerationOf(course.most - end_, falling());
    return course;
  }

  /// How far it gets.
  [[nodiscard]] double way(const Course &course) const noexcept {
    const double up = course.rate < 0.0
                          ? (2.0 * start_ + course.rate * course.rate) * course.rate
                          : 0.5 * (course.most + start_) * side(course.most - start_, rising());
    const double down = 0.5 * (course.most + end_) * side(course.most - end_, falling());
    return (up + down - offset_) / (jerk_ * jerk_) + course.cruise * task_.top;
  }
  /// Whether it would get farther if it took longer: the sign of this.
  [[nodiscard]] double growth(const Course &course) const noexcept {
    return course.most + 0.5 * course.rate * course.fall;
  }

  /// Where the way grows, falls and grows again: the duration at which it begins to fall, or 0.
  [[nodiscard]] double summit() const noexcept {
    const double rate = summitOf(task_, {0.0, task_.velocity, task_.acceleration});
    if (!(rate < 0.0))
      return 0.0;
    const double most = start_ + rate * rate;
    return (2.0 * rate - task_.acceleration + side(most - end_, falling())) / jerk_;
  }

  /// The pieces, up to 7 of them.
  int pieces(const Course &course, double sign, Piece (&pieces)[7]) const noexcept {
    int count = 0;
    const auto add = [&](double duration, double jerk, double acceleration) noexcept {
      if (duration > 0.0)
        pieces[count++] = {duration, sign * jerk, sign * acceleration};
    };
    add((course.rate - task_.acceleration) / jerk_, jerk_, course.rate);
    if (course.rate >= rising())
      add(holding(course.most - start_, rising()), 0.0, course.rate);
    if (course.cruise > 0.0) {
      add(course.rate / jerk_, -jerk_, 0.0);
      add(course.cruise, 0.0, 0.0);
      add(course.fall / jerk_, -jerk_, -course.fall);
    } else {
      add((course.rate + course.fall) / jerk_, -jerk_, -course.fall);
    }
    if (course.fall >= falling())
      add(holding(course.most - end_, falling()), 0.0, -course.fall);
    add(course.fall / jerk_, jerk_, 0.0);
    return count;
  }

private:
  [[nodiscard]] double rising() const noexcept { return task_.rates.rising; }
  [[nodiscard]] double falling() const noexcept { return task_.rates.falling; }

  /// The time, times the jerk, of a change of the velocity.
  static double side(double change, double limit) noexcept {
    if (change >= limit * limit)
      return change / limit + limit;
    return change > 0.0 ? 2.0 * exact::sqrt(change) : 0.0;
  }
  static double accelerationOf(double change, double limit) noexcept {
    if (change >= limit * limit)
      return limit;
    return change > 0.0 ? exact::sqrt(change) : 0.0;
  }
  [[nodiscard]] double holding(double change, double limit) const noexcept {
    return (change / limit - limit) / jerk_;
  }
  /// By way of the velocity `most`.
  [[nodiscard]] double lasting(double most) const noexcept {
    return (side(most - start_, rising()) + side(most - end_, falling()) - task_.acceleration) /
           jerk_;
  }

  Task task_;
  double jerk_;
  double start_; ///< Virtual velocity at which the acceleration was, or will be, 0.
  double end_;
  double top_;
  double least_;  ///< Of the greatest velocities.
  double first_;  ///< The acceleration at which the push ends in the direct change.
  double offset_; ///< Way from the virtual start to the start.
};

/// Adds the interval of durations in which the farthest ones do not get as far as `distance`,
/// after they have: the way grows, falls and grows again.
bool findBlocked(const Task &task, ArrivalTimes::Interval &blocked) noexcept {
  const Farthest farthest(task);
  const double last = farthest.toTop();
  const double first = exact::larger(farthest.summit(), farthest.shortest());
  const auto growth = [&](double time) noexcept { return farthest.growth(farthest.at(time)); };
  const auto beyond = [&](double time) noexcept {
    return farthest.way(farthest.at(time)) - task.distance;
  };
  const double begin = first + 0x1p-40 * (last - first); // after the rounding of the summit
  if (!(begin < last && growth(begin) < 0.0 && growth(last) >= 0.0))
    return false;
  const double valley = bracketedRoot(growth, begin, last);
  if (!(beyond(valley) < 0.0 && beyond(first) >= 0.0))
    return false;
  blocked.from = bracketedRoot([&](double time) noexcept { return -beyond(time); }, first, valley);
  const double missing = -beyond(last);
  blocked.to = missing > 0.0 ? last + missing / task.top : bracketedRoot(beyond, valley, last);
  return blocked.to > blocked.from;
}

/// A task in scaled units, with them.
struct Scaled {
  Scale scale;
  Task task;
};

bool areLimits(const ArrivalLimits &limits) noexcept {
  return exact::isPositive(limits.highest) && exact::isPositive(-limits.lowest) &&
         exact::isPositive(limits.rising) && exact::isPositive(limits.falling) &&
         exact::isPositive(limits.jerk);
}

PlanError scaledTask(Scaled &scaled, const State &start, double target, double endVelocity,
                     const ArrivalLimits &limits) noexcept {
  if (!isFinite(start) || !exact::isfinite(target) || !exact::isfinite(endVelocity))
    return PlanError::InvalidState;
  if (!areLimits(limits))
    return PlanError::InvalidLimit;
  const double distance = target - start.position;
  if (!exact::isfinite(distance))
    return PlanError::Unrepresentable;
  const double greatest = exact::larger(limits.highest, -limits.lowest);
  scaled.scale = Scale::of(distance, greatest, limits.rising, limits.falling);
  const PowerOfTwo velocity(-scaled.scale.velocity);
  const PowerOfTwo acceleration(-scaled.scale.acceleration);
  const PowerOfTwo length(-scaled.scale.length);
  const PowerOfTwo jerk(scaled.scale.time - scaled.scale.acceleration);
  const double places = exact::larger(exact::fabs(start.position), exact::fabs(target));
  scaled.task = {velocity(start.velocity),
                 acceleration(start.acceleration),
                 length(distance),
                 velocity(endVelocity),
                 velocity(limits.highest),
                 velocity(limits.lowest),
                 {acceleration(limits.rising), acceleration(limits.falling), jerk(limits.jerk)},
                 16.0 * kEpsilon * (length(places) + exact::fabs(length(distance)))};
  return isRegular(scaled.task) ? PlanError::None : PlanError::InvalidState;
}

double durationOf(const parabolic::Route &route) noexcept {
  double duration = 0.0;
  for (int i = 0; i < route.headCount; ++i)
    duration += route.head[i].duration;
  return duration + route.cruise + route.tail.duration();
}

/// One of two motions, from piece to piece.
struct Walk {
  const Piece *piece;
  const Piece *last;
  double end; ///< Of the piece.

  Walk(const Piece *pieces, int count, double duration) noexcept
      : piece(pieces), last(pieces + count - 1), end(count > 1 ? pieces[0].duration : duration) {}
  /// Goes on to the piece after `time`; the last one lasts until `duration`.
  void to(double time, double duration) noexcept {
    while (piece != last && end <= time) {
      ++piece;
      end = piece == last ? duration : end + piece->duration;
    }
  }
  [[nodiscard]] double accelerationAt(double time) const noexcept {
    return piece->acceleration - piece->jerk * (end - time);
  }
};

/// The mean of two motions of the same duration: pieces of constant jerk again, up to 13.
struct Mean {
  Piece pieces[14];
  int count = 0;

  Mean(Walk low, Walk high, double weight, double duration) noexcept {
    const auto mean = [weight](double a, double b) noexcept {
      return (1.0 - weight) * a + weight * b;
    };
    for (double time = 0.0; time < duration && count < 14;) {
      const double next = exact::smaller(low.end, high.end);
      if (next > time)
        pieces[count++] = {next - time, mean(low.piece->jerk, high.piece->jerk),
                           mean(low.accelerationAt(next), high.accelerationAt(next))};
      time = exact::larger(time, next);
      low.to(time, duration);
      high.to(time, duration);
    }
  }
};

/// Writes the pieces into a profile: the first half as it is seen from the start, the second one
/// from the end, where each is anchored at its own.
void write(Profile &profile, const Mean &mean, const Scaled &scaled, const State &start,
           double target, double endVelocity, double duration) noexcept {
  const PowerOfTwo length(scaled.scale.length);
  const PowerOfTwo time(scaled.scale.time);
  const PowerOfTwo velocity(scaled.scale.velocity);
  const PowerOfTwo acceleration(scaled.scale.acceleration);
  const PowerOfTwo jerk(scaled.scale.acceleration - scaled.scale.time);
  const int middle = mean.count / 2;
  const auto put = [&](int i, double begin, double reference, double place,
                       const State &state) noexcept {
    profile.segments[i] = {begin,
                           reference,
                           {place + length(state.position), velocity(state.velocity),
                            acceleration(state.acceleration)},
                           jerk(mean.pieces[i].jerk),
                           0.0};
  };
  State state = {0.0, scaled.task.velocity, scaled.task.acceleration};
  double now = 0.0;
  for (int i = 0; i < middle; ++i) {
    put(i, now, now, start.position, state);
    state = numeric::evaluateCubic(state, mean.pieces[i].jerk, mean.pieces[i].duration);
    state.acceleration = mean.pieces[i].acceleration;
    now += time(mean.pieces[i].duration);
  }
  state = {0.0, scaled.task.endVelocity, 0.0};
  double end = duration;
  for (int i = mean.count - 1; i >= middle; --i) {
    const double begin = i > middle ? end - time(mean.pieces[i].duration) : now;
    put(i, begin, end, target, state);
    state = numeric::evaluateCubic(state, mean.pieces[i].jerk, -mean.pieces[i].duration);
    state.acceleration = i > 0 ? mean.pieces[i - 1].acceleration : scaled.task.acceleration;
    end = begin;
  }
  profile.count = mean.count;
  profile.duration = duration;
  profile.end = {target, endVelocity, 0.0};
}

} // namespace

PlanError findArrivalTimes(ArrivalTimes &times, const State &start, double target,
                           double endVelocity, const ArrivalLimits &limits) noexcept {
  times = ArrivalTimes{};
  Scaled scaled{};
  const PlanError problem = scaledTask(scaled, start, target, endVelocity, limits);
  if (problem != PlanError::None)
    return problem;
  parabolic::Route route;
  (void)findRoute(route, scaled.task);
  const PowerOfTwo time(scaled.scale.time);
  times.shortest = time(durationOf(route));
  const Task tasks[2] = {scaled.task, scaled.task.mirrored()};
  for (const Task &task : tasks)
    times.blockedCount += findBlocked(task, times.blocked[times.blockedCount]) ? 1 : 0;
  for (int32_t i = 0; i < times.blockedCount; ++i)
    times.blocked[i] = {time(times.blocked[i].from), time(times.blocked[i].to)};
  if (times.blockedCount == 2 && times.blocked[1].from < times.blocked[0].from) {
    const ArrivalTimes::Interval first = times.blocked[1];
    times.blocked[1] = times.blocked[0];
    times.blocked[0] = first;
  }
  return exact::isfinite(times.shortest) ? PlanError::None : PlanError::Unrepresentable;
}

double commonArrival(const ArrivalTimes *axes, int32_t count) noexcept {
  double time = 0.0;
  for (int32_t i = 0; i < count; ++i)
    time = exact::larger(time, axes[i].shortest);
  // Each interval is left at most once.
  for (int32_t left = 0, i = 0; i < count && left <= 2 * count;) {
    bool blocked = false;
    for (int32_t k = 0; k < axes[i].blockedCount; ++k)
      if (time > axes[i].blocked[k].from && time < axes[i].blocked[k].to) {
        time = axes[i].blocked[k].to;
        blocked = true;
        ++left;
      }
    i = blocked ? 0 : i + 1;
  }
  return time;
}

PlanError planArrival(Profile &profile, const State &start, double target, double endVelocity,
                      const ArrivalLimits &limits, double duration) noexcept {
  profile.count = 0;
  profile.duration = 0.0;
  profile.end = {start.position, 0.0, 0.0};
  Scaled scaled{};
  const PlanError problem = scaledTask(scaled, start, target, endVelocity, limits);
  if (problem != PlanError::None)
    return problem;
  if (!exact::isfinite(duration))
    return PlanError::Unrepresentable;
  const Task &task = scaled.task;
  const double length = PowerOfTwo(-scaled.scale.time)(duration);
  const Farthest up(task);
  const Farthest down(task.mirrored());
  if (!(length >= up.shortest() * (1.0 - 64.0 * kEpsilon)))
    return PlanError::Blocked;
  const Course high = up.at(length);
  const Course low = down.at(length);
  const double most = up.way(high);
  const double least = -down.way(low);
  const double rounding = task.noise + 64.0 * kEpsilon * length * (task.top - task.bottom);
  if (task.distance > most + rounding || task.distance < least - rounding)
    return PlanError::Blocked;
  const double part = most > least ? (task.distance - least) / (most - least) : 0.0;
  Piece highs[7];
  Piece lows[7];
  const int highCount = up.pieces(high, 1.0, highs);
  const int lowCount = down.pieces(low, -1.0, lows);
  if (highCount == 0 || lowCount == 0) { // no time is needed to stay
    profile.end = {target, endVelocity, 0.0};
    return PlanError::None;
  }
  const Mean mean(Walk(lows, lowCount, length), Walk(highs, highCount, length),
                  part > 0.0 ? part < 1.0 ? part : 1.0 : 0.0, length);
  write(profile, mean, scaled, start, target, endVelocity, duration);
  return PlanError::None;
}

} // namespace stride::motion
