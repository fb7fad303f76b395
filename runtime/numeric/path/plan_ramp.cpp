// The ramp of a plan for a lower feed, or to stop. A motion that is quicker than it may be now
// slows down by up to three pieces of constant jerk, in closed form; the cells begin where it has
// the new velocity and no acceleration. To stop, there are none. As with the passes, a step looks
// at one strip.
#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

/// Comparisons of velocities that only differ by rounding.
constexpr double kAlmost = 1.0 + 1e-9;

/// The greatest velocity of the ramp: an acceleration goes on for a while. [u/s]
double peakOf(const Plan &plan) noexcept {
  const WayState &from = plan.from;
  const double rising = larger(from.acceleration, 0.0);
  return from.velocity + 0.5 * rising * rising / plan.rampJerk;
}

/// Where the ramp has it. [u]
double peakWayOf(const Plan &plan) noexcept {
  const WayState &from = plan.from;
  const double time = larger(from.acceleration, 0.0) / plan.rampJerk;
  return from.way + (from.velocity + from.acceleration * time / 3.0) * time;
}

/// The greatest deceleration that a strip allows, without regard to the axes. [u/s^2]
double mostIn(const Plan &plan, const Strip &strip) noexcept {
  return decelerationIn(strip, plan.task.braking);
}

/// What a bend leaves of the part of the axes' acceleration that a stop may take: half of it at
/// least, since it must stop, too, where the bend itself takes more.
double partLeft(const Plan &plan, double bend) noexcept {
  const double part = plan.task.braking.accelerationPart;
  return part > 0.0 && part < 1.0 ? larger(part - bend, 0.5 * part) : 1.0;
}

/// Up to where the ramp may go. [u]
double limitOf(const Plan &plan) noexcept {
  return plan.task.whole ? plan.task.limit : plan.task.end;
}

/// Writes the ramp to the velocity of plan.rampSquare with at most plan.rampMost of deceleration.
void writeRamp(Plan &plan) noexcept {
  const double jerk = plan.rampJerk;
  const WayState &from = plan.from;
  const double first = -from.acceleration;
  const double lost = from.velocity - exact::sqrt(plan.rampSquare);
  const double most = larger(plan.rampMost, first);
  // Deceleration that rises to a peak and falls again: it loses (2 peak^2 - first^2) / (2 jerk).
  double peak = exact::sqrt(larger(jerk * lost + 0.5 * first * first, 0.0));
  double steady = 0.0;
  peak = larger(peak, first); // braking so hard that the feed is missed when that ends
  if (peak > most) {
    peak = most;
    steady = (lost - (most * most - 0.5 * first * first) / jerk) / most;
  }
  WayState state = from;
  plan.ramp = 0;
  const auto put = [&plan, &state](double change, double time) {
    if (!(time > 0.0))
      return;
    const TimePiece piece =
        constantJerkPiece(state.way, state.velocity, state.acceleration, change, time);
    state.way = piece.start + piece.length;
    state.velocity += (state.acceleration + 0.5 * change * time) * time;
    state.acceleration += change * time;
    plan.closed[plan.ramp++] = piece;
  };
  put(-jerk, (peak - first) / jerk);
  put(0.0, steady);
  const double time = peak / jerk;
  if (plan.task.whole) { // velocity and acceleration vanish together
    const double length = jerk * time * time * time / 6.0;
    plan.closed[plan.ramp++] = pieceToRest(state.way, length, jerk);
    state = {state.way + length, 0.0, 0.0, 0.0};
  } else {
    put(jerk, time);
  }
  plan.rampEnd = state.way;
  plan.rampVelocity = state.velocity;
  plan.rampPeak = peak;
}

/// Whether the motion brakes so hard that it would have to go back before that has ended.
bool brakesTooHard(const Plan &plan) noexcept {
  const WayState &from = plan.from;
  return plan.task.whole && from.acceleration < 0.0 &&
         from.acceleration * from.acceleration > 2.0 * plan.rampJerk * from.velocity;
}

/// The ramp is all of the plan.
void endWithRamp(Plan &plan) noexcept {
  plan.isAlone = true;
  plan.count = plan.ramp;
  plan.ramp = 0;
  plan.lastStrip = plan.strip;
  plan.end = plan.rampEnd;
  plan.stops = true;
  plan.gate = false;
}

/// No ramp: the cells begin where the plan does; a stop has none.
bool dropRamp(Plan &plan) noexcept {
  plan.ramp = 0;
  plan.rampRefused = true;
  if (plan.task.whole)
    plan.state = PlanState::Failed;
  return true;
}

/// The velocity of the ramp at a way in it, before `rampEnd`. [u/s]
double velocityOfRamp(const Plan &plan, double way) noexcept {
  for (int32_t i = 0; i < plan.ramp; ++i) {
    const TimePiece &piece = plan.closed[i];
    if (way <= piece.start + piece.length)
      return velocityAt(piece, larger(way, piece.start));
  }
  return plan.rampVelocity;
}

/// The greatest velocity of the ramp from a way in it on. [u/s]
double greatestFrom(const Plan &plan, double way) noexcept {
  return way < peakWayOf(plan) ? peakOf(plan) : velocityOfRamp(plan, way);
}

/// Whether the present strip, which comes after the first one, allows the ramp. While that still
/// accelerates, it is below the law that it takes over from, in velocity and acceleration.
bool allowsRamp(const Plan &plan, const Course &course) noexcept {
  const Strip &strip = stripAt(course, plan.strip);
  const double override = presentOverride(plan, course);
  const double velocity = greatestFrom(plan, beginOf(course, plan.strip));
  const double square = velocity * velocity;
  const double most =
      smaller(squareIn(strip, override), squareAtEnd(stripAt(course, plan.strip - 1), override));
  // A part of what the axes allow is for what is still to come.
  const double first =
      smaller(-plan.from.acceleration, larger(strip.deceleration, plan.task.braking.deceleration));
  return square <= most * kAlmost &&
         plan.rampPeak <= larger(mostIn(plan, strip), first) * kAlmost &&
         plan.rampPeak * strip.along + square * strip.across <= kAlmost;
}

} // namespace

double presentOverride(const Plan &plan, const Course &course) noexcept {
  const double feed = stripAt(course, plan.firstStrip).feed;
  return larger(larger(plan.task.override, plan.task.before), plan.from.velocity / feed);
}

bool findRamp(Plan &plan, const Course &course) noexcept {
  const PlanTask &task = plan.task;
  if (plan.rampRefused || plan.ramp > 0 || startsAtRest(plan) || task.rampPart >= 1.0 ||
      task.jerk == exact::kInfinity)
    return true;
  const Strip &strip = stripAt(course, plan.strip);
  if (plan.strip == plan.firstStrip) {
    plan.rampJerk = task.jerk;
    plan.rampSquare = task.whole ? 0.0 : exact::kInfinity;
    plan.rampMost = exact::kInfinity;
  }
  const double jerk = jerkIn(strip, plan.rampJerk, task.braking);
  // An acceleration that falls more slowly leads higher than the strips before allow.
  if (plan.strip > plan.firstStrip && jerk < plan.rampJerk && plan.from.acceleration > 0.0)
    return dropRamp(plan);
  plan.rampJerk = jerk;
  if (brakesTooHard(plan))
    return dropRamp(plan);
  const double peak = peakOf(plan);
  plan.rampSquare = smaller(plan.rampSquare, squareIn(strip, task.override));
  if (peak * peak <= plan.rampSquare * kAlmost) // not quicker than it may be
    return dropRamp(plan);
  const double most = squareIn(strip, presentOverride(plan, course));
  if (plan.strip == plan.firstStrip && peak * peak > most * kAlmost)
    return dropRamp(plan); // it would accelerate beyond what the law before it did
  const double here = plan.strip > plan.firstStrip ? plan.rampHere : peak;
  const double left = 1.0 - strip.across * here * here;
  if (!(left > task.rampPart))
    return dropRamp(plan);
  const double usable = smaller(left, partLeft(plan, 1.0 - left));
  plan.rampMost = smaller(plan.rampMost, smaller(mostIn(plan, strip), usable / strip.along));
  writeRamp(plan);
  if (!task.whole && !(plan.rampVelocity > 0.0))
    return dropRamp(plan);
  if (plan.rampEnd < smaller(strip.end, limitOf(plan))) {
    plan.strip = plan.firstStrip;
    return true;
  }
  plan.rampHere = greatestFrom(plan, strip.end);
  plan.ramp = 0;
  if (strip.stop || strip.end >= limitOf(plan) || plan.strip + 1 == course.next)
    return dropRamp(plan);
  plan.rampSquare = smaller(plan.rampSquare, squareAtEnd(strip, task.override));
  ++plan.strip;
  return false;
}

bool followRamp(Plan &plan, const Course &course) noexcept {
  if (plan.ramp == 0 || plan.task.way > plan.from.way) // none, or passed
    return true;
  const Strip &strip = stripAt(course, plan.strip);
  if (plan.strip > plan.firstStrip && !allowsRamp(plan, course))
    return dropRamp(plan);
  if (plan.rampEnd >= strip.end) {
    ++plan.strip;
    return false;
  }
  if (plan.task.whole) {
    endWithRamp(plan);
    return true;
  }
  plan.task.way = plan.rampEnd;
  plan.task.velocity = plan.rampVelocity;
  plan.task.acceleration = 0.0;
  plan.firstStrip = plan.strip;
  return true;
}

} // namespace stride::path
