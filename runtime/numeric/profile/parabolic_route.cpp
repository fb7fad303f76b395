#include "runtime/numeric/profile/parabolic_route.hpp"

#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion::parabolic {
namespace {

/// A first guess how long a phase must last to add `gap` to the distance.
double guessDuration(const Phase &phase, double acceleration, double gap) noexcept {
  const double jerk = exact::fabs(phase.jerk);
  if (jerk > 0.0)
    return exact::ldexp(1.0, exponentOf(6.0 * gap / jerk) / 3);
  return exact::sqrt(2.0 * gap / exact::fabs(acceleration));
}

/// How long the axis stays in `phase`, which it begins in `from`, so that it then just reaches the
/// task's distance. It does when the whole phase is run.
double durationWithin(const Task &task, const State &from, const Phase &phase) noexcept {
  const auto missing = [&](double duration) noexcept {
    return task.reach(after(from, partOf(phase, from, duration))) - task.distance;
  };
  double low = 0.0;
  double atLow = missing(low);
  if (!(atLow < 0.0))
    return 0.0;
  double high = guessDuration(phase, from.acceleration, -atLow);
  if (!(high > 0.0))
    high = phase.duration;
  while (high < phase.duration && missing(high) < 0.0) {
    low = high;
    high *= 4.0;
  }
  if (!(high < phase.duration))
    high = phase.duration;
  return bracketedRoot(missing, low, high);
}

/// While the axis still slows down, the task's reach may rise, fall and rise again with the time
/// for which it is pushed on: the acceleration at which a push that begins in `from` must end to
/// reach farthest before the fall. Not below 0 if there is no fall.
///
/// After the push the acceleration falls to -z, where z^2 = a^2 + s - e (s: the velocity at which
/// the push would have ended the slowing down, e: the end velocity, both times the jerk) or the
/// falling limit. The reach then grows with the sign of s + a^2 + a z / 2, which is convex in a.
double summitOf(const Task &task, const State &from) noexcept {
  const double jerk = task.rates.jerk;
  const double limit = task.rates.falling;
  const double first = exact::larger(from.acceleration, -limit);
  const double settled = jerk * from.velocity - 0.5 * from.acceleration * from.acceleration;
  const double gain = settled - jerk * task.endVelocity;
  const double rest = limit * limit * (1.0 / 16.0) - settled;
  if (!(first < 0.0 && gain > 0.0 && rest > 0.0))
    return 0.0;
  double rate = first;
  if (rate * rate + gain > limit * limit) { // the falling limit is reached
    const double summit = -0.25 * limit - exact::sqrt(rest);
    const bool held = summit * summit + gain >= limit * limit;
    if (held)
      return summit >= first ? summit : 0.0;
    const double last = limit * limit - gain; // of these the limit is reached
    rate = exact::larger(first, last > 0.0 ? -exact::sqrt(last) : 0.0);
  }
  for (int i = 0; i < 30; ++i) { // Newton's tangents lie below a convex function
    const double z = exact::sqrt(rate * rate + gain);
    const double slope = 2.0 * rate + 0.5 * z + 0.5 * rate * (rate / z);
    const double growth = settled + rate * rate + 0.5 * rate * z;
    if (!(growth > 0.0))
      return i > 0 ? rate : 0.0;
    if (!(slope < 0.0))
      return 0.0;
    const double step = growth / slope;
    rate -= step;
    if (!(rate < 0.0))
      return 0.0;
    if (-step <= 4.0 * kEpsilon * -rate)
      break;
  }
  return rate;
}

/// Finds the fastest way when the axis has its end velocity already and departs from it so little
/// that the last digits of the velocities would decide on the durations: four equal phases. False
/// if it is no such task.
bool findBump(Route &route, const Task &task) noexcept {
  const double velocity = task.velocity;
  if (task.acceleration != 0.0 || velocity != task.endVelocity || !(velocity > 0.0))
    return false;
  const double jerk = velocity < task.top ? task.rates.jerk : -task.rates.jerk;
  double time = task.distance / (4.0 * velocity);
  if (!(exact::fabs(jerk) * time * time <= 0x1p-10 * velocity))
    return false;
  for (int i = 0; i < 4; ++i) {
    const double excess = jerk * time * time;
    time -=
        (2.0 * time * (2.0 * velocity + excess) - task.distance) / (4.0 * velocity + 6.0 * excess);
  }
  const double rate = jerk * time;
  const double weaker =
      task.rates.rising < task.rates.falling ? task.rates.rising : task.rates.falling;
  if (exact::fabs(rate) > weaker || exact::fabs(rate * time) > exact::fabs(task.top - velocity))
    return false;
  route.head[0] = {time, jerk, rate};
  route.head[1] = {time, -jerk, 0.0};
  route.headCount = 2;
  route.tail.phases[0] = {time, -jerk, -rate};
  route.tail.phases[1] = {0.0, 0.0, -rate};
  route.tail.phases[2] = {time, jerk, 0.0};
  return true;
}

/// Finds the fastest way for a task that must go beyond where the direct change of velocity ends
/// (distance > reach of the start): towards the top velocity until the change to the end velocity
/// is due. False when the top velocity leads no farther.
bool findForward(Route &route, const Task &task) noexcept {
  if (findBump(route, task))
    return true;
  State state = {0.0, task.velocity, task.acceleration};
  const VelocityChange push(task.velocity, task.acceleration, task.top, task.rates);
  for (const Phase &phase : push.phases) {
    if (!(phase.duration > 0.0))
      continue;
    const State next = after(state, phase);
    if (phase.jerk > 0.0 && state.acceleration < 0.0) {
      const double summit = summitOf(task, state);
      const double time = (summit - state.acceleration) / phase.jerk;
      const Phase rise = partOf(phase, state, time);
      if (summit < 0.0 && time > 0.0 && task.reach(after(state, rise)) >= task.distance) {
        const Phase part = partOf(phase, state, durationWithin(task, state, rise));
        route.head[route.headCount++] = part;
        route.tail = task.changeFrom(after(state, part));
        return true;
      }
    }
    if (task.reach(next) >= task.distance) {
      const Phase part = partOf(phase, state, durationWithin(task, state, phase));
      route.head[route.headCount++] = part;
      route.tail = task.changeFrom(after(state, part));
      return true;
    }
    route.head[route.headCount++] = phase;
    state = next;
  }
  state.velocity = task.top;
  state.acceleration = 0.0;
  route.tail = task.changeFrom(state);
  const double missing = task.distance - task.reach(state);
  if (missing <= task.noise)
    return true;
  if (!(task.top > 0.0))
    return false;
  route.cruise = missing / task.top;
  route.cruiseVelocity = task.top;
  return true;
}

} // namespace

bool findRoute(Route &route, const Task &task) noexcept {
  const State start = {0.0, task.velocity, task.acceleration};
  const double gap = task.distance - task.reach(start);
  route = Route{};
  route.tail = task.changeFrom(start);
  if (exact::fabs(gap) <=
      task.noise + blurOf(route.tail, task.velocity, task.acceleration, task.rates.jerk))
    return true;
  if (gap > 0.0)
    return findForward(route, task);
  const bool found = findForward(route, task.mirrored());
  route.mirror();
  return found;
}

} // namespace stride::motion::parabolic
