#include "runtime/numeric/profile/parabolic_turn.hpp"

#include "runtime/numeric/profile/bracketed_root.hpp"
#include "runtime/numeric/profile/parabolic_push.hpp"

// While the velocity v is below 0, it may rise with the deceleration D, above with the acceleration
// A, and at standstill, which belongs to both, with the weaker one, m. Over the velocity, whoever
// has the greater acceleration at each is faster and farther at each time. The squares of what the
// jerk J allows are lines over v: from the start 2J(v - s), where s is the velocity at which the
// acceleration would be (or is) 0; to the end e 2J(e - v); around standstill m^2 + 2J|v|. So one of
// three squares decides at standstill: -2Js, 2Je and m^2. Where it is one of the first two, the
// other limit is not met, and the change is that of one side. So it is for falling velocities, with
// all signs changed.
//
// Of all motions of a duration T the one that goes farthest is known: v never lies above the
// fastest change U to the top velocity, nor above W, which ends as the fastest change from there to
// the end velocity does; and as v'' >= -J, v + Jt^2/2 never lies above the lower convex hull of
// min(U, W) + Jt^2/2. The hull itself is a motion: U, a falling parabola that touches both, W. It
// keeps the limits, since U falls with J to pass standstill, too. So the fastest motion to beyond
// the place of the direct change follows U, and then changes to the end velocity.

namespace stride::motion::parabolic {
namespace {

/// The task seen from the other side: the rates belong to magnitudes.
Task fromBehind(const Task &task) noexcept {
  Task other = task.mirrored();
  other.top = -other.bottom;
  other.bottom = -task.top;
  other.rates = task.rates;
  return other;
}

TurningChange changeFrom(const State &state, const Task &task) noexcept {
  return TurningChange(state.velocity, state.acceleration, task.endVelocity, task.rates);
}

/// Where the axis arrives when it changes to the end velocity in this state.
double reach(const State &state, const Task &task) noexcept {
  return state.position +
         changeFrom(state, task).distance(state.velocity, state.acceleration, task.endVelocity);
}

/// How long the axis stays in `phase`, which it begins in `from`, so that it then just reaches the
/// task's distance. It does when the whole phase is run.
double durationWithin(const Task &task, const State &from, const Phase &phase) noexcept {
  const auto missing = [&](double duration) noexcept {
    return reach(after(from, partOf(phase, from, duration)), task) - task.distance;
  };
  if (!(missing(0.0) < 0.0))
    return 0.0;
  return bracketedRoot(missing, 0.0, phase.duration);
}

void changeFrom(TurningRoute &route, const State &state, const Task &task) noexcept {
  route.tail.set(state.velocity, state.acceleration, task.endVelocity, task.rates);
}

/// The axis, in `state`, stands: without the rounding of the phases.
void stand(TurningRoute &route, State &state) noexcept {
  state.velocity = 0.0;
  if (route.headCount > 0)
    route.ends[route.headCount - 1].velocity = 0.0;
}

/// The change to the end velocity from `end`, where the head of the route ends, leads `gap` beyond
/// the task's distance: mends that if it comes from the last digits of velocities. False if more
/// than `rounding` remains.
bool mend(TurningRoute &route, const Task &task, const State &end, double gap,
          double rounding) noexcept {
  if (exact::fabs(gap) <= rounding)
    return true;
  State from = end;
  if (route.tail.turns) {
    for (const Phase &phase : route.tail.lead)
      from = after(from, phase);
    from.velocity = 0.0;
  }
  return task.endVelocity != 0.0 && bend(route.tail.rest, task, from, -gap, rounding);
}

/// Goes on with a part of `phase`, and then changes to the end velocity.
void leave(TurningRoute &route, const Task &task, State state, const Phase &phase) noexcept {
  route.add(partOf(phase, state, durationWithin(task, state, phase)), state);
  changeFrom(route, state, task);
  (void)mend(route, task, state, reach(state, task) - task.distance, roundingOf(task, state));
}

/// Goes on with all of `phase`; or with a part that leads to the end, which is true.
bool push(TurningRoute &route, const Task &task, State &state, const Phase &phase) noexcept {
  if (!(phase.duration > 0.0))
    return false;
  if (phase.jerk > 0.0 && state.acceleration < 0.0) {
    const double summit = turningSummit(task, state);
    const double time = (summit - state.acceleration) / phase.jerk;
    const Phase rise = partOf(phase, state, exact::smaller(time, phase.duration));
    if (summit < 0.0 && time > 0.0 && reach(after(state, rise), task) >= task.distance) {
      leave(route, task, state, rise);
      return true;
    }
  }
  if (reach(after(state, phase), task) >= task.distance) {
    leave(route, task, state, phase);
    return true;
  }
  route.add(phase, state);
  return false;
}

/// The phases that end at standstill: the acceleration rises with the jerk to the rate of braking,
/// and falls to `last`, what may go on there; the result is what it is then. Both towards rising
/// velocities; `sign` -1 gives the phases to the other side. Of the squares of accelerations at
/// standstill `most` is what the jerk alone leads to, more than last * last.
double brake(Phase (&phases)[3], double sign, double velocity, double from, double most,
             double allowed, double last, const Rates &rates) noexcept {
  const double jerk = rates.jerk;
  const double half = 0.5 * (most + allowed);
  const double highest = exact::larger(from, rates.falling); // it may begin beyond its limit
  double peak = exact::sqrt(half);
  double hold = 0.0;
  if (peak > highest) {
    peak = rates.falling;
    hold = (half - highest * highest) / (jerk * rates.falling);
  } else if (from > peak) { // what is too much at the start is not gone by then
    peak = last = exact::sqrt(from * from + 2.0 * jerk * velocity);
  }
  phases[0] = {exact::fabs(peak - from) / jerk, sign * (peak < from ? -jerk : jerk), sign * peak};
  phases[1] = {hold, 0.0, sign * peak};
  phases[2] = {(peak - last) / jerk, -sign * jerk, sign * last};
  return last;
}

/// The way of a push and the change to the end velocity; `end` is where the push ends. Returns how
/// far beyond the task's distance it leads.
double goByPush(TurningRoute &route, const Task &task, const TurningPush &push,
                State &end) noexcept {
  const Rates &rates = task.rates;
  State state = {0.0, task.velocity, task.acceleration};
  route.headCount = 0;
  if (push.passes) {
    const double weaker = exact::smaller(rates.rising, rates.falling);
    const double jerked =
        state.acceleration * state.acceleration - 2.0 * rates.jerk * state.velocity;
    Phase lead[3];
    (void)brake(lead, 1.0, state.velocity, state.acceleration, jerked, weaker * weaker, weaker,
                rates);
    for (const Phase &phase : lead)
      if (phase.duration > 0.0)
        route.add(phase, state);
    stand(route, state);
  }
  const double time = (push.rate - state.acceleration) / rates.jerk;
  if (time > 0.0)
    route.add({time, rates.jerk, push.rate}, state);
  if (push.hold > 0.0)
    route.add({push.hold, 0.0, push.rate}, state);
  changeFrom(route, state, task);
  end = state;
  return state.position +
         route.tail.distance(state.velocity, state.acceleration, task.endVelocity) - task.distance;
}

/// The same, without the rounding of the formulas where it is more than that of the way. False if
/// it remains.
bool goExactlyByPush(TurningRoute &route, const Task &task, TurningPush push) noexcept {
  State end;
  double gap = goByPush(route, task, push, end);
  for (int i = 0; i < 2 && exact::fabs(gap) > 0.25 * task.noise; ++i) {
    // How the way grows with the push: see parabolic_push.cpp.
    const double jerk = task.rates.jerk;
    const double falling = route.tail.peak();
    const double rate = end.acceleration;
    const double growth =
        (1.0 + rate / falling) * (end.velocity * jerk + 0.5 * rate * (rate + falling)) / jerk;
    if (!(falling > 0.0 && growth > 0.0))
      break;
    if (push.hold > 0.0)
      push.hold -= gap / growth;
    else
      push.rate -= 0.5 * jerk * (gap / growth);
    gap = goByPush(route, task, push, end);
  }
  return mend(route, task, end, gap, roundingOf(task, end));
}

/// Goes on from the top velocity; returns how far that is short of the task's distance.
double cruise(TurningRoute &route, const Task &task, double position) noexcept {
  const State state = {position, task.top, 0.0};
  changeFrom(route, state, task);
  const double missing =
      task.distance - (position + route.tail.distance(task.top, 0.0, task.endVelocity));
  if (missing > task.noise) {
    route.cruise = missing / task.top;
    route.cruiseVelocity = task.top;
  }
  return missing;
}

/// The way by way of the top velocity. False if it leads too far.
bool goByTop(TurningRoute &route, const Task &task) noexcept {
  const TurningChange upward(task.velocity, task.acceleration, task.top, task.rates);
  State state = {0.0, task.velocity, task.acceleration};
  const auto go = [&](const Phase(&phases)[3]) noexcept {
    for (const Phase &phase : phases)
      if (phase.duration > 0.0)
        route.add(phase, state);
  };
  if (upward.turns) {
    go(upward.lead);
    stand(route, state);
  }
  go(upward.rest.phases);
  return cruise(route, task, state.position) >= -16.0 * task.noise;
}

/// The way to beyond where the direct change ends, by search along the way to the top velocity: for
/// states beyond the limits. Of each phase the reach at its end decides, and at the summit, the
/// only place where it grows and then falls: see parabolic_push.cpp.
void search(TurningRoute &route, const Task &task) noexcept {
  const TurningChange upward(task.velocity, task.acceleration, task.top, task.rates);
  State state = {0.0, task.velocity, task.acceleration};
  route.headCount = 0;
  if (upward.turns) {
    for (const Phase &phase : upward.lead)
      if (push(route, task, state, phase))
        return;
    stand(route, state);
  }
  for (const Phase &phase : upward.rest.phases)
    if (push(route, task, state, phase))
      return;
  (void)cruise(route, task, state.position);
}

/// The way to beyond where the direct change ends.
void goForward(TurningRoute &route, const Task &task) noexcept {
  if (isRegularTurn(task)) {
    TurningPush push;
    if (findTurningPush(push, task) ? goExactlyByPush(route, task, push) : goByTop(route, task))
      return;
    route.cruise = 0.0;
  }
  search(route, task);
}

} // namespace

void TurningChange::set(double velocity, double from, double to, const Rates &rates) noexcept {
  acceleration = 0.0;
  turns = false;
  const double sign = to > settledVelocity(velocity, from, rates.jerk) ? 1.0 : -1.0;
  change(sign, sign * velocity, sign * from, sign * to, rates);
}

void TurningChange::change(double sign, double velocity, double from, double to,
                           const Rates &rates) noexcept {
  const double twice = 2.0 * rates.jerk;
  // Squares of the acceleration at standstill.
  const double jerked = from * from - twice * velocity;
  const double last = twice * to;
  const double weaker = exact::smaller(rates.rising, rates.falling);
  const double allowed = weaker * weaker;
  const bool below = from > 0.0 ? velocity < 0.0 : jerked > 0.0;
  if (!below || (jerked <= allowed && jerked <= last) || last <= allowed) {
    const bool above = !below || (jerked <= last && to > 0.0);
    // In the directions of the caller.
    const bool rising = above == (sign > 0.0);
    rest =
        VelocityChange(sign * velocity, sign * from, sign * to, rising ? rates : rates.mirrored());
    return;
  }
  acceleration = sign * brake(lead, sign, velocity, from, jerked, allowed, weaker, rates);
  turns = true;
  rest = VelocityChange(0.0, acceleration, sign * to, sign > 0.0 ? rates : rates.mirrored());
}

double TurningChange::distance(double velocity, double from, double to) const noexcept {
  if (!turns)
    return rest.distance(velocity, from, to);
  State state = {0.0, velocity, from};
  for (const Phase &phase : lead)
    state = after(state, phase);
  return state.position + rest.distance(0.0, acceleration, to);
}

void findTurningRoute(TurningRoute &route, const Task &task, Direct direct) noexcept {
  const auto goBack = [&] {
    route.sign = -1.0;
    goForward(route, fromBehind(task));
  };
  route.headCount = 0;
  route.cruise = 0.0;
  route.sign = 1.0;
  if (direct == Direct::Behind) {
    goBack();
    return;
  }
  const State start = {0.0, task.velocity, task.acceleration};
  changeFrom(route, start, task);
  const double gap =
      task.distance - route.tail.distance(task.velocity, task.acceleration, task.endVelocity);
  const double swing = task.acceleration * (task.acceleration / task.rates.jerk);
  const double blur =
      16.0 * kEpsilon * route.tail.duration() * (exact::fabs(task.velocity) + swing);
  if (mend(route, task, start, -gap, task.noise + blur))
    return;
  if (gap > 0.0)
    goForward(route, task);
  else
    goBack();
}

} // namespace stride::motion::parabolic
