#include "runtime/numeric/csy/modulated_move.hpp"

namespace stride::csy {

using exact::isPositive;
using exact::larger;
using exact::smaller;

namespace {

using Leg = ModulatedMove::Leg;

/// Speed after a way with a steady acceleration, which may be negative.
double speedAfter(double speed, double acceleration, double way) noexcept {
  return exact::sqrt(larger(0.0, speed * speed + 2.0 * acceleration * way));
}

double exitOf(const ModulatedMove &move, uint32_t index) noexcept {
  return index + 1 < move.legs ? move.leg[index + 1].enter : 0.0;
}

/// How a leg is gone over: up to a peak, steady, and down.
struct Course {
  double peak;
  double up, steady, down; ///< times [s]
};

Course courseOf(const ModulatedMove &move, uint32_t index) noexcept {
  const Leg &leg = move.leg[index];
  const double a = move.limits.acceleration;
  const double d = move.limits.deceleration;
  const double enter = leg.enter;
  const double leave = exitOf(move, index);
  const double meeting = (2.0 * a * d * leg.way + d * enter * enter + a * leave * leave) / (a + d);
  Course course{};
  course.peak = larger(smaller(leg.limit, exact::sqrt(meeting)), larger(enter, leave));
  course.up = (course.peak - enter) / a;
  course.down = (course.peak - leave) / d;
  const double ramps =
      0.5 * (enter + course.peak) * course.up + 0.5 * (leave + course.peak) * course.down;
  course.steady = larger(0.0, leg.way - ramps) / course.peak;
  return course;
}

/// Way and speed at a time in a leg.
struct Place {
  double way, speed;
};

/// A ramp of a speed from 0 to 1 in a time of 1, at a time in it: speed, and way. Its acceleration
/// rises linearly to `shape`, stays, and falls as it has risen.
Place ramp(double shape, double time) noexcept {
  const double rise = 1.0 - 1.0 / shape;
  if (time < rise)
    return {shape * time * time * time / (6.0 * rise), 0.5 * shape * time * time / rise};
  const double left = 1.0 - time;
  if (left < rise)
    return {0.5 - left + shape * left * left * left / (6.0 * rise),
            1.0 - 0.5 * shape * left * left / rise};
  const double steady = time - rise;
  return {shape * rise * rise / 6.0 + 0.5 * shape * (rise + steady) * steady,
          0.5 * shape * rise + shape * steady};
}

/// At a time in a ramp that leads from a speed to a higher one.
Place rampUp(double low, double high, double duration, double shape, double time) noexcept {
  const Place part = ramp(shape, time / duration);
  return {low * time + (high - low) * duration * part.way, low + (high - low) * part.speed};
}

Place placeIn(const ModulatedMove &move, const Course &course, double time) noexcept {
  const Leg &leg = move.leg[move.at];
  const MasterLimits &limits = move.limits;
  if (time < course.up) {
    if (limits.shape > 1.0)
      return rampUp(leg.enter, course.peak, course.up, limits.shape, time);
    return {(leg.enter + 0.5 * limits.acceleration * time) * time,
            leg.enter + limits.acceleration * time};
  }
  const double rising = 0.5 * (leg.enter + course.peak) * course.up;
  if (time < course.up + course.steady)
    return {rising + course.peak * (time - course.up), course.peak};
  const double left = larger(0.0, course.up + course.steady + course.down - time);
  const double leave = exitOf(move, move.at);
  if (limits.shape > 1.0 && left > 0.0) { // as it would rise from the end
    const Place place = rampUp(leave, course.peak, course.down, limits.shape, left);
    return {leg.way - place.way, place.speed};
  }
  return {leg.way - (leave + 0.5 * limits.deceleration * left) * left,
          leave + limits.deceleration * left};
}

/// Legs in the direction of the move, without their speeds at the ends.
void collectLegs(const Trajectory &trajectory, const double *speed, ModulatedMove &move) noexcept {
  const double low = smaller(move.from, move.to);
  const double high = larger(move.from, move.to);
  move.legs = 0;
  for (uint32_t i = 0; i < trajectory.pieces; ++i) {
    const uint32_t index = move.direction > 0.0 ? i : trajectory.pieces - 1 - i;
    const Piece &piece = trajectory.piece[index];
    const double way = smaller(high, piece.start + piece.length) - larger(low, piece.start);
    if (!(way > 0.0))
      continue;
    const double most = move.limits.velocity > 0.0 ? move.limits.velocity : exact::kInfinity;
    move.leg[move.legs++] = {way, smaller(speed[index], most), 0.0};
  }
}

/// The speeds where legs meet: what can be reached from the start and left for the end.
void meetLegs(ModulatedMove &move) noexcept {
  for (uint32_t i = 1; i < move.legs; ++i) {
    const double most = smaller(move.leg[i - 1].limit, move.leg[i].limit);
    move.leg[i].enter = smaller(
        most, speedAfter(move.leg[i - 1].enter, move.limits.acceleration, move.leg[i - 1].way));
  }
  double leave = 0.0;
  for (uint32_t i = move.legs; i-- > 0;) {
    Leg &leg = move.leg[i];
    leg.enter = smaller(leg.enter, speedAfter(leave, move.limits.deceleration, leg.way));
    leave = leg.enter;
  }
}

/// Speed of a ramp from a speed to a higher one where it has led over a way.
double rampSpeedAt(double low, double high, double duration, double shape, double way) noexcept {
  double before = 0.0;
  double after = duration;
  for (int i = 0; i < 32; ++i) {
    const double middle = 0.5 * (before + after);
    (rampUp(low, high, duration, shape, middle).way < way ? before : after) = middle;
  }
  return rampUp(low, high, duration, shape, after).speed;
}

/// Whether the ramp of a leg goes on in the next one, up or down.
bool goesOn(const Course &leg, const Course &next) noexcept {
  constexpr double kNothing = 1e-9; // of the leg's time
  const bool risesToItsEnd = leg.up > 0.0 && leg.steady + leg.down <= kNothing * leg.up;
  const bool fallsFromItsBegin = next.down > 0.0 && next.steady + next.up <= kNothing * next.down;
  return (risesToItsEnd && next.up > kNothing * next.steady) ||
         (leg.down > kNothing * leg.steady && fallsFromItsBegin);
}

/// Up to which leg a ramp may lead: `last`, or the first one after which it would be too fast.
uint32_t reachOf(const ModulatedMove &move, uint32_t first, uint32_t last, double peak) noexcept {
  double whole = 0.0;
  for (uint32_t i = first; i <= last; ++i)
    whole += move.leg[i].way;
  const double enter = move.leg[first].enter;
  const double leave = exitOf(move, last);
  const double up = (peak - enter) / move.limits.acceleration;
  const double down = (peak - leave) / move.limits.deceleration;
  const double rising = 0.5 * (enter + peak) * up;
  const double falling = 0.5 * (leave + peak) * down;
  const double shape = move.limits.shape;
  constexpr double kSlack = 1.0 + 1e-9;
  double way = 0.0;
  for (uint32_t i = first; i < last; ++i) {
    way += move.leg[i].way;
    const double left = whole - way;
    const double before = kSlack * move.leg[i].limit;
    const double after = kSlack * move.leg[i + 1].limit;
    if (way < rising && before < peak && rampSpeedAt(enter, peak, up, shape, way) > before)
      return i;
    if (left < falling && after < peak && rampSpeedAt(leave, peak, down, shape, left) > after)
      return i;
  }
  return last;
}

/// The last leg of a run of legs whose ramps go on from one to the next, and the greatest speed.
struct Run {
  uint32_t last;
  double peak;
};

Run runFrom(const ModulatedMove &move, uint32_t first, uint32_t last) noexcept {
  Course course = courseOf(move, first);
  Run run{first, course.peak};
  while (run.last < last) {
    const Course next = courseOf(move, run.last + 1);
    if (!goesOn(course, next))
      break;
    course = next;
    run.peak = larger(run.peak, next.peak);
    ++run.last;
  }
  return run;
}

/// Work that may still be done.
class Budget {
public:
  explicit Budget(uint32_t steps) noexcept : steps_(steps) {}
  /// False: nothing is left.
  bool take(uint32_t steps) noexcept {
    const bool enough = steps < steps_;
    steps_ = enough ? steps_ - steps : 0;
    return enough;
  }

private:
  uint32_t steps_;
};

/// The longest run of legs from one on that may become one.
Run mergedFrom(const ModulatedMove &move, uint32_t first, Budget &budget) noexcept {
  constexpr uint32_t kLookUps = 12; // a speed on a ramp takes as long as so many legs
  const Run alone{first, move.leg[first].limit};
  if (!budget.take(1))
    return alone;
  Run run = runFrom(move, first, move.legs - 1);
  while (run.last > first) {
    const uint32_t reach = reachOf(move, first, run.last, run.peak);
    const bool enough = budget.take(run.last - first + kLookUps * (reach - first + 1));
    if (reach == run.last)
      return run;
    if (!enough)
      break;
    run = runFrom(move, first, reach);
  }
  return alone;
}

/// Shaped ramps lead over several legs: these become one. It takes a bounded time, as it is done in
/// one cycle: when too much has been tried, legs stay what they are.
void mergeLegs(ModulatedMove &move) noexcept {
  uint32_t made = 0;
  Budget budget(32 * move.legs);
  for (uint32_t first = 0; first < move.legs;) {
    const Run run = mergedFrom(move, first, budget);
    Leg leg = move.leg[first];
    for (uint32_t i = first + 1; i <= run.last; ++i)
      leg.way += move.leg[i].way;
    leg.limit = run.peak;
    move.leg[made++] = leg;
    first = run.last + 1;
  }
  move.legs = made;
}

} // namespace

bool beginMove(const Trajectory &trajectory, const double *speed, const MasterLimits &limits,
               double from, double to, ModulatedMove &move) noexcept {
  const auto onPath = [&trajectory](double position) noexcept {
    return position >= 0.0 && position <= trajectory.length;
  };
  if (!onPath(from) || !onPath(to) || !isPositive(limits.acceleration) ||
      !isPositive(limits.deceleration))
    return false;
  move.from = from;
  move.to = to;
  move.direction = to < from ? -1.0 : 1.0;
  move.limits = limits;
  move.at = 0;
  move.since = 0.0;
  move.base = 0.0;
  move.position = from;
  move.velocity = 0.0;
  collectLegs(trajectory, speed, move);
  for (uint32_t i = 0; i < move.legs; ++i)
    if (!(move.leg[i].limit > 0.0))
      return false;
  meetLegs(move);
  if (limits.shape > 1.0)
    mergeLegs(move);
  return true;
}

namespace {

MasterState advanced(ModulatedMove &move, double time) noexcept {
  move.since += time;
  while (move.at < move.legs) {
    const Course course = courseOf(move, move.at);
    const double duration = course.up + course.steady + course.down;
    if (move.since < duration) {
      const Place place = placeIn(move, course, move.since);
      return {move.from + move.direction * (move.base + place.way), move.direction * place.speed,
              false};
    }
    move.since -= duration;
    move.base += move.leg[move.at].way;
    ++move.at;
  }
  return {move.to, 0.0, true};
}

MasterState keep(ModulatedMove &move, const MasterState &state) noexcept {
  move.position = state.position;
  move.velocity = state.velocity;
  return state;
}

} // namespace

MasterState advance(ModulatedMove &move, double time) noexcept {
  return keep(move, advanced(move, time));
}

MasterState brake(ModulatedMove &move, double deceleration, double time) noexcept {
  const double speed = move.direction * move.velocity;
  const double braking = smaller(time, speed / deceleration);
  const double left = larger(0.0, speed - deceleration * braking);
  const double way = 0.5 * (speed + left) * braking;
  const double room = move.direction * (move.to - move.position);
  const bool rests = braking < time || left == 0.0 || way >= room;
  return keep(move, {way >= room ? move.to : move.position + move.direction * way,
                     rests ? 0.0 : move.direction * left, rests});
}

} // namespace stride::csy
