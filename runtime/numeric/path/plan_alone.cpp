// A run along one strip from rest to rest: its law has a closed form, up to seven pieces of
// constant jerk, which is the quickest there is where the strip is straight. It also is what is
// left where cells come to nothing: there is always one, so that no path rests for ever.
#include "runtime/numeric/path/plan_cells.hpp"

#include "runtime/numeric/cube_root.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

/// Below it, squares of what ramps are computed from may be 0. [u/s]
constexpr double kLeastVelocity = 1e-140;

/// The limits of a run.
struct Limits {
  double velocity, acceleration, deceleration, jerk;
};

/// The way of both ramps. [u]
double rampsWay(double velocity, const Limits &limits) noexcept {
  return 0.5 * velocity *
         (rampTime(velocity, limits.acceleration, limits.jerk) +
          rampTime(velocity, limits.deceleration, limits.jerk));
}

/// Whether a run is so short that cells of it would be shorter than what ways so far along tell
/// apart.
bool isTiny(const PlanTask &task, double length) noexcept { return length <= 1e-9 * task.way; }

/// The limits of a run along a strip; where it bends, half of what the axes allow for each of what
/// they share, which costs such a short run next to nothing.
Limits limitsOf(const PlanTask &task, const Strip &strip) noexcept {
  const bool bends = strip.across > 0.0;
  const double allowed = (bends ? 0.5 : 1.0) / strip.along;
  const double bent = bends ? 0.5 / strip.across : exact::kInfinity;
  return {exact::sqrt(smaller(squareIn(strip, task.override), bent)),
          smaller(strip.acceleration, allowed),
          smaller(decelerationIn(strip, task.braking), allowed),
          jerkIn(strip, task.jerk, task.braking)};
}

/// Above all velocities that ramps reach within a length: no ramp is shorter than one with the
/// greatest acceleration from the start on, nor than one with the greatest jerk. [u/s]
double velocityBound(double length, const Limits &limits) noexcept {
  constexpr double kMargin = 1.01; // for rounding
  const double acceleration = larger(limits.acceleration, limits.deceleration);
  const double byAcceleration = exact::sqrt(2.0 * acceleration * length);
  const double root = numeric::cubeRoot(length);
  const double byJerk = root * root * numeric::cubeRoot(limits.jerk);
  return smaller(limits.velocity, kMargin * smaller(byAcceleration, byJerk));
}

/// The greatest velocity that ramps reach within a length, at most that of the limits. [u/s]
double peakVelocity(double length, const Limits &limits) noexcept {
  double high = velocityBound(length, limits);
  if (rampsWay(high, limits) <= length)
    return high;
  double low = 0.0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + 0.5 * (high - low);
    if (middle == low || middle == high)
      break;
    (rampsWay(middle, limits) <= length ? low : high) = middle;
  }
  return low;
}

/// Writes pieces one after the other.
struct Writer {
  Plan &plan;
  double way; ///< At the end of the last one. [u]

  void put(const TimePiece &piece) noexcept {
    plan.closed[plan.count++] = piece;
    way = piece.start + piece.length;
  }
};

/// The three pieces of a ramp between rest and `velocity`; `rises` or falls.
void writeRamp(Writer &writer, double velocity, double acceleration, double jerk,
               bool rises) noexcept {
  const double most = smaller(acceleration, exact::sqrt(velocity * jerk)); // that is reached
  const double change = most / jerk;                                       // its time
  const double steady = larger(velocity / most - change, 0.0);
  const double low = 0.5 * most * change; // velocity beside rest
  const double rest = jerk * change * change * change / 6.0;
  if (rises)
    writer.put(pieceFromRest(writer.way, rest, jerk));
  else
    writer.put(constantJerkPiece(writer.way, velocity, 0.0, -jerk, change));
  if (steady > 1e-12 * change)
    writer.put(constantJerkPiece(writer.way, rises ? low : velocity - low, rises ? most : -most,
                                 0.0, steady));
  if (rises)
    writer.put(constantJerkPiece(writer.way, velocity - low, most, -jerk, change));
  else
    writer.put(pieceToRest(writer.way, rest, jerk));
}

/// Rest to rest over so short a way that no law of ramps can be computed: at once, in a time in
/// which nothing can be told from it. [u]
void writeCrumb(Writer &writer, double length) noexcept {
  constexpr double kTime = 0.0005; // [s]
  writer.put(linearPiece(writer.way, length, length / kTime, 0.0, 0.0));
}

/// Plans the run up to `end`, which is within the first strip or at its end. [u]
void writeRun(Plan &plan, const Strip &strip, double end) noexcept {
  const PlanTask &task = plan.task;
  const double length = end - task.way;
  const Limits limits = limitsOf(task, strip);
  const double velocity = peakVelocity(length, limits);
  const double steady = length - rampsWay(velocity, limits);
  plan.isAlone = true;
  plan.count = 0;
  plan.lastStrip = plan.firstStrip;
  plan.end = end;
  plan.stops = strip.stop || end < strip.end;
  plan.gate = strip.gate && end >= strip.end;
  plan.state = PlanState::Done;
  Writer writer{plan, task.way};
  if (!(velocity > kLeastVelocity)) {
    writeCrumb(writer, length);
    return;
  }
  writeRamp(writer, velocity, limits.acceleration, limits.jerk, true);
  if (steady > 1e-12 * length)
    writer.put(linearPiece(writer.way, steady, velocity, 0.0, 0.0));
  writeRamp(writer, velocity, limits.deceleration, limits.jerk, false);
}

} // namespace

bool planAlone(Plan &plan, const Course &course) noexcept {
  const PlanTask &task = plan.task;
  const Strip &strip = stripAt(course, plan.firstStrip);
  const double length = strip.end - task.way;
  const bool isFit = isTiny(task, length) ? strip.stop || plan.firstStrip + 1 == course.next
                                          : strip.stop && !(strip.across > 0.0);
  if (!isFit || !startsAtRest(plan) || task.jerk == exact::kInfinity || task.end < strip.end)
    return false;
  writeRun(plan, strip, strip.end);
  return true;
}

bool planFirstStrip(Plan &plan, const Course &course) noexcept {
  if (!startsAtRest(plan) || plan.task.jerk == exact::kInfinity)
    return false;
  const Strip &strip = stripAt(course, plan.firstStrip);
  const double end = smaller(strip.end, plan.task.end);
  if (!(end > plan.task.way))
    return false;
  writeRun(plan, strip, end);
  return true;
}

} // namespace stride::path
