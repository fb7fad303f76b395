#include "runtime/numeric/profile/parabolic_route.hpp"

#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/parabolic_push.hpp"
#include "runtime/numeric/profile/scale.hpp"

namespace stride::motion::parabolic {
namespace {

/// A first guess how long a phase must last to add `gap` to the distance.
double guessDuration(const Phase &phase, double acceleration, double gap) noexcept {
  const double jerk = exact::fabs(phase.jerk);
  if (jerk > 0.0) {
    const int exponent = exponentOf(6.0 * gap / jerk);
    // Rounded down, so that the guess is the same in all units.
    return exact::ldexp(1.0, (exponent < 0 ? exponent - 2 : exponent) / 3);
  }
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
  State state = {0.0, velocity, 0.0};
  route.add({time, jerk, rate}, state);
  route.add({time, -jerk, 0.0}, state);
  route.tail.phases[0] = {time, -jerk, -rate};
  route.tail.phases[1] = {0.0, 0.0, -rate};
  route.tail.phases[2] = {time, jerk, 0.0};
  return true;
}

/// The way by way of the top velocity; returns how far it stays short of the task's distance.
double goByTop(Route &route, const Task &task) noexcept {
  const VelocityChange push(task.velocity, task.acceleration, task.top, task.rates);
  State state = {0.0, task.velocity, task.acceleration};
  for (const Phase &phase : push.phases)
    if (phase.duration > 0.0)
      route.add(phase, state);
  state.velocity = task.top;
  state.acceleration = 0.0;
  route.tail = task.changeFrom(state);
  return task.distance - (state.position + route.tail.distance(task.top, 0.0, task.endVelocity));
}

/// Goes on at the top velocity. False if that leads no farther.
bool cruise(Route &route, const Task &task, double missing) noexcept {
  if (!(task.top > 0.0))
    return false;
  route.cruise = missing / task.top;
  route.cruiseVelocity = task.top;
  return true;
}

/// The way of a push and the change to the end velocity; returns how far beyond the task's distance
/// it ends.
double goByPush(Route &route, const Task &task, const Push &push) noexcept {
  State state = {0.0, task.velocity, task.acceleration};
  const double time = (push.rate - task.acceleration) / task.rates.jerk;
  route.headCount = 0;
  if (time > 0.0)
    route.add({time, task.rates.jerk, push.rate}, state);
  if (push.hold > 0.0)
    route.add({push.hold, 0.0, push.rate}, state);
  route.tail = task.changeFrom(state);
  return state.position +
         route.tail.distance(state.velocity, state.acceleration, task.endVelocity) - task.distance;
}

/// The same, without the rounding of the formulas where it is more than that of the way. False if
/// it remains.
bool goExactlyByPush(Route &route, const Task &task, Push push) noexcept {
  const double gap = goByPush(route, task, push);
  if (!(exact::fabs(gap) > 0.25 * task.noise))
    return true;
  // How the way grows with the push: see parabolic_push.cpp.
  const double jerk = task.rates.jerk;
  const double falling = -route.tail.phases[0].acceleration;
  const double velocity =
      route.headCount > 0 ? route.ends[route.headCount - 1].velocity : task.velocity;
  const double growth = (1.0 + push.rate / falling) *
                        (velocity * jerk + 0.5 * push.rate * (push.rate + falling)) / jerk;
  if (falling > 0.0 && growth > 0.0) {
    if (push.hold > 0.0)
      push.hold -= gap / growth;
    else
      push.rate = exact::smaller(push.rate - 0.5 * jerk * (gap / growth), task.rates.rising);
  }
  return exact::fabs(goByPush(route, task, push)) <= 4.0 * task.noise;
}

/// The fastest way by formulas, for a regular task: see findForward.
enum class Answer : uint8_t {
  Found,
  None,    ///< The top velocity leads no farther.
  Unknown, ///< Rounding would matter.
};

Answer findByFormulas(Route &route, const Task &task) noexcept {
  if (!isRegular(task))
    return Answer::Unknown;
  Push push;
  if (findPush(push, task))
    return goExactlyByPush(route, task, push) ? Answer::Found : Answer::Unknown;
  const double missing = goByTop(route, task);
  if (!(missing > task.noise))
    return missing >= -16.0 * task.noise ? Answer::Found : Answer::Unknown;
  return cruise(route, task, missing) ? Answer::Found : Answer::None;
}

/// Goes on with a part of `phase`, and then changes to the end velocity.
void leave(Route &route, const Task &task, State state, const Phase &phase) noexcept {
  route.add(partOf(phase, state, durationWithin(task, state, phase)), state);
  route.tail = task.changeFrom(state);
  const double gap = task.reach(state) - task.distance;
  const double rounding = roundingOf(task, state);
  if (exact::fabs(gap) > rounding && task.endVelocity != 0.0)
    (void)bend(route.tail, task, state, -gap, rounding);
}

/// Finds the fastest way for a task that must go beyond where the direct change of velocity ends
/// (distance > reach of the start): towards the top velocity until the change to the end velocity
/// is due. False when the top velocity leads no farther.
bool findForward(Route &route, const Task &task) noexcept {
  if (findBump(route, task))
    return true;
  const Answer answer = findByFormulas(route, task);
  if (answer != Answer::Unknown)
    return answer == Answer::Found;
  route.headCount = 0;
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
        leave(route, task, state, rise);
        return true;
      }
    }
    if (task.reach(next) >= task.distance) {
      leave(route, task, state, phase);
      return true;
    }
    route.add(phase, state);
  }
  state.velocity = task.top;
  state.acceleration = 0.0;
  route.tail = task.changeFrom(state);
  const double missing = task.distance - task.reach(state);
  return missing <= task.noise || cruise(route, task, missing);
}

} // namespace

bool bend(VelocityChange &change, const Task &task, const State &from, double gap,
          double rounding) noexcept {
  const double jerk = task.rates.jerk;
  const double swing = from.acceleration * (from.acceleration / jerk);
  const double digits =
      16.0 * kEpsilon * (exact::fabs(from.velocity) + exact::fabs(task.endVelocity) + swing);
  const double end = task.endVelocity;
  const auto missing = [&]() noexcept {
    return (task.distance - from.position) - change.distance(from.velocity, from.acceleration, end);
  };
  Phase &hold = change.phases[1];
  if (hold.duration > 0.0) {
    const double before =
        end - hold.acceleration * (0.5 * change.phases[2].duration + hold.duration);
    const double more = gap / before;
    if (!(exact::fabs(more * hold.acceleration) <= digits && hold.duration + more >= 0.0))
      return false;
    hold.duration += more;
    return exact::fabs(missing()) <= rounding;
  }
  if (!(gap * gap * jerk <= 16.0 * end * end * digits))
    return false;
  const double sign = change.phases[0].jerk < 0.0 ? -1.0 : 1.0;
  const double before = sign * change.phases[0].acceleration;
  double peak = before;
  for (int i = 0; i < 3; ++i) {
    peak = exact::larger(peak + 0.5 * jerk * (gap / end), 0.0);
    const double time = (peak - sign * from.acceleration) / jerk;
    if (!(time >= 0.0 && exact::fabs(peak * peak - before * before) <= jerk * digits))
      return false;
    change.phases[0] = {time, sign * jerk, sign * peak};
    change.phases[1] = {0.0, 0.0, sign * peak};
    change.phases[2] = {peak / jerk, -sign * jerk, 0.0};
    gap = missing();
    if (exact::fabs(gap) <= rounding)
      return true;
  }
  return false;
}

bool findRoute(Route &route, const Task &task) noexcept {
  const State start = {0.0, task.velocity, task.acceleration};
  route.headCount = 0;
  route.cruise = 0.0;
  route.sign = 1.0;
  double gap = task.distance;
  double rounding = task.noise;
  if (task.velocity != 0.0 || task.acceleration != 0.0 || task.endVelocity != 0.0) {
    route.tail = task.changeFrom(start);
    gap -= route.tail.distance(task.velocity, task.acceleration, task.endVelocity);
    rounding += blurOf(route.tail, task.velocity, task.acceleration, task.rates.jerk);
  }
  if (!(exact::fabs(gap) > rounding)) {
    route.tail = task.changeFrom(start);
    return true;
  }
  if (task.endVelocity != 0.0 && bend(route.tail, task, start, gap, rounding))
    return true;
  if (gap > 0.0)
    return findForward(route, task);
  if (task.bottom == 0.0 && task.endVelocity == 0.0)
    return false; // no stop is shorter than the direct one
  route.sign = -1.0;
  return findForward(route, task.mirrored());
}

} // namespace stride::motion::parabolic
