#include "runtime/numeric/profile/parabolic_turn.hpp"

#include "runtime/numeric/profile/bracketed_root.hpp"

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

/// How long the axis stays in `phase`, which it begins in `from` while it still slows down, to
/// reach farthest before longer ones reach less far; 0 if there is no such time. See
/// parabolic_push.cpp: the reach grows with the sign of s + a^2 + az/2.
double timeToSummit(const Task &task, const State &from, const Phase &phase) noexcept {
  const double jerk = phase.jerk;
  const double settled = jerk * from.velocity - 0.5 * from.acceleration * from.acceleration;
  const auto shrinks = [&](double duration) noexcept {
    const State state = after(from, partOf(phase, from, duration));
    const double rate = state.acceleration;
    return -(settled + rate * rate + 0.5 * rate * changeFrom(state, task).peak());
  };
  const double stronger = exact::larger(task.rates.rising, task.rates.falling);
  if (!(settled < stronger * stronger * (1.0 / 16.0)) || !(shrinks(0.0) < 0.0))
    return 0.0;
  const double last = exact::smaller(-from.acceleration / jerk, phase.duration);
  constexpr int kParts = 16; // it may grow again before the acceleration is 0
  for (int i = 1; i <= kParts; ++i)
    if (shrinks(last * i / kParts) >= 0.0)
      return bracketedRoot(shrinks, last * (i - 1) / kParts, last * i / kParts);
  return 0.0;
}

void add(TurningRoute &route, const Phase &phase, State &state) noexcept {
  route.head[route.headCount++] = phase;
  state = after(state, phase);
}

/// Goes on with a part of `phase`, and then changes to the end velocity.
void leave(TurningRoute &route, const Task &task, State state, const Phase &phase) noexcept {
  add(route, partOf(phase, state, durationWithin(task, state, phase)), state);
  route.tail = changeFrom(state, task);
}

/// Goes on with all of `phase`; or with a part that leads to the end, which is true.
bool push(TurningRoute &route, const Task &task, State &state, const Phase &phase) noexcept {
  if (!(phase.duration > 0.0))
    return false;
  if (phase.jerk > 0.0 && state.acceleration < 0.0) {
    const Phase rise = partOf(phase, state, timeToSummit(task, state, phase));
    if (rise.duration > 0.0 && reach(after(state, rise), task) >= task.distance) {
      leave(route, task, state, rise);
      return true;
    }
  }
  if (reach(after(state, phase), task) >= task.distance) {
    leave(route, task, state, phase);
    return true;
  }
  add(route, phase, state);
  return false;
}

/// The way to beyond where the direct change ends.
void goForward(TurningRoute &route, const Task &task) noexcept {
  const TurningChange upward(task.velocity, task.acceleration, task.top, task.rates);
  State state = {0.0, task.velocity, task.acceleration};
  if (upward.turns) {
    for (const Phase &phase : upward.lead)
      if (push(route, task, state, phase))
        return;
    state.velocity = 0.0;
  }
  for (const Phase &phase : upward.rest.phases)
    if (push(route, task, state, phase))
      return;
  state.velocity = task.top;
  state.acceleration = 0.0;
  route.tail = changeFrom(state, task);
  const double missing = task.distance - reach(state, task);
  if (missing > task.noise) {
    route.cruise = missing / task.top;
    route.cruiseVelocity = task.top;
  }
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

} // namespace

// Over the velocity, the acceleration first rises with the jerk to the rate of braking, and ends by
// falling with the jerk to what may go on beyond standstill. Whoever has a greater acceleration at
// each velocity is faster and farther at each time, so no other turn is sooner.
Turn::Turn(double velocity, double from, const Rates &rates, double top) noexcept {
  const double twice = 2.0 * rates.jerk;
  // All squares of accelerations: what the jerk alone leads to at standstill, and what is allowed.
  const double most = from * from - twice * velocity;
  const double weaker = exact::smaller(rates.falling, rates.rising);
  const double allowed = exact::smaller(weaker * weaker, twice * top * (1.0 - 8.0 * kEpsilon));
  if (most > allowed) {
    acceleration = brake(phases, 1.0, velocity, from, most, allowed, exact::sqrt(allowed), rates);
  } else {
    acceleration = exact::sqrt(most);
    const bool falls = acceleration < from;
    phases[0] = {exact::fabs(acceleration - from) / rates.jerk, falls ? -rates.jerk : rates.jerk,
                 acceleration};
    phases[1] = {0.0, 0.0, acceleration};
    phases[2] = {0.0, -rates.jerk, acceleration};
  }
  State state = {0.0, velocity, from};
  for (const Phase &phase : phases)
    state = after(state, phase);
  way = state.position;
}

TurningChange::TurningChange(double velocity, double from, double to, const Rates &rates) noexcept {
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

void findTurningRoute(TurningRoute &route, const Task &task) noexcept {
  const State start = {0.0, task.velocity, task.acceleration};
  route.headCount = 0;
  route.cruise = 0.0;
  route.sign = 1.0;
  route.tail = changeFrom(start, task);
  const double gap =
      task.distance - route.tail.distance(task.velocity, task.acceleration, task.endVelocity);
  const double swing = task.acceleration * (task.acceleration / task.rates.jerk);
  const double blur =
      16.0 * kEpsilon * route.tail.duration() * (exact::fabs(task.velocity) + swing);
  if (!(exact::fabs(gap) > task.noise + blur))
    return;
  if (gap > 0.0) {
    goForward(route, task);
    return;
  }
  route.sign = -1.0;
  goForward(route, fromBehind(task));
}

} // namespace stride::motion::parabolic
