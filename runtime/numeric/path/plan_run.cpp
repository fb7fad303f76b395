// The run of a plan: how far it goes, and a first idea of its velocity; of a trapezoid, that is the
// plan.
#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

/// Of what limits a strip, the part that the first idea makes use of: less than all, since a
/// limited jerk needs its time.
constexpr double kShare = 0.5;

double &reachAt(Plan &plan, int64_t strip) noexcept {
  return plan.reach[static_cast<uint64_t>(strip) % kStrips];
}
double reachAt(const Plan &plan, int64_t strip) noexcept {
  return plan.reach[static_cast<uint64_t>(strip) % kStrips];
}

/// How many strips the run of a trapezoid has at most.
constexpr int64_t kMostStrips = kCells / 3 - 1;

bool isTrapezoid(const Plan &plan) noexcept { return plan.task.jerk == exact::kInfinity; }

/// What the axes leave of a strip's accelerations. [u/s^2]
double allowedBy(const Plan &plan, const Strip &strip) noexcept {
  if (!isTrapezoid(plan))
    return 1.0 / strip.along;
  const double left = 1.0 - strip.across * squareIn(strip, plan.task.override);
  return larger(left, 0.0) / strip.along;
}

double usableOf(const Plan &plan, double limit, double allowed) noexcept {
  return isTrapezoid(plan) ? smaller(plan.task.share * limit, allowed)
                           : kShare * smaller(limit, allowed);
}

double brakingOf(const Plan &plan, const Strip &strip) noexcept {
  return decelerationIn(strip, plan.task.braking);
}

/// The part of a strip that belongs to the run.
struct Part {
  double begin, end;   ///< Ways. [u]
  double before;       ///< b at its begin. [u^2/s^2]
  double most;         ///< Greatest b in it, unless it begins with more. [u^2/s^2]
  double acceleration; ///< [u/s^2]
  double deceleration; ///< [u/s^2]
};

Part partOf(const Plan &plan, const Course &course, int64_t number) noexcept {
  const Strip &strip = stripAt(course, number);
  Part part;
  part.begin = larger(beginOf(course, number), plan.task.way);
  part.end = smaller(strip.end, plan.end);
  part.before = number == plan.firstStrip ? plan.task.velocity * plan.task.velocity
                                          : reachAt(plan, number - 1);
  part.most = squareIn(strip, plan.task.override);
  const double allowed = allowedBy(plan, strip);
  part.acceleration = usableOf(plan, strip.acceleration, allowed);
  part.deceleration = usableOf(plan, brakingOf(plan, strip), allowed);
  return part;
}

/// b after a length in a part, if nothing that comes later matters: it rises to the greatest one,
/// or falls to it.
double squareAfter(const Part &part, double length) noexcept {
  return part.before <= part.most
             ? smaller(part.most, part.before + 2.0 * part.acceleration * length)
             : larger(part.most, part.before - 2.0 * part.deceleration * length);
}

/// The time for a length in a part. [u] in, [s] out
struct PartTime {
  double ramp;   ///< [s]
  double steady; ///< With constant velocity. [s]
};
PartTime timeFor(const Part &part, double length) noexcept {
  const double first = exact::sqrt(part.before);
  const double last = exact::sqrt(squareAfter(part, length));
  const double rate = part.before <= part.most ? part.acceleration : part.deceleration;
  const double ramp = exact::fabs(last - first) / rate;
  return {ramp, larger(length - 0.5 * (first + last) * ramp, 0.0) / last};
}

/// The time that counts for the number of cells: where the velocity is constant they grow, so that
/// there are only so many of them however long that lasts. [s]
double countedTime(Plan &plan, const Course &course, const PartTime &time) noexcept {
  constexpr double kSteadyCells = 30.0;
  const double most = kSteadyCells * plan.task.cellTime;
  const bool goesOn =
      plan.strip > plan.firstStrip && !(time.ramp > 0.0) &&
      areAlike(stripAt(course, plan.strip - 1), stripAt(course, plan.strip), plan.task.override);
  const double before = goesOn ? plan.steady : 0.0;
  plan.steady = smaller(before + time.steady, most);
  return time.ramp + plan.steady - before;
}

/// The length in a time in a part. [s] in, [u] out
double lengthIn(const Part &part, double time) noexcept {
  const double first = exact::sqrt(part.before);
  const double most = exact::sqrt(part.most);
  const double rate = first <= most ? part.acceleration : -part.deceleration;
  const double ramp = smaller(time, (most - first) / rate);
  return (first + 0.5 * rate * ramp) * ramp + most * (time - ramp);
}

/// The greatest b at the end of the present strip, by it and the next one. [u^2/s^2]
double ceilingAtBorder(const Plan &plan, const Course &course, double override) noexcept {
  const double ceiling = squareAtEnd(stripAt(course, plan.strip), override);
  if (plan.strip + 1 == course.next)
    return ceiling;
  return smaller(ceiling, squareIn(stripAt(course, plan.strip + 1), override));
}

/// b at the end of the present strip, after a length. A run that begins above the ceilings, since
/// there is another override, brakes until it is below. No override makes the other limits greater.
double squareAtBorder(Plan &plan, const Course &course, const Part &part, double length) noexcept {
  constexpr double kAlmost = 1.0 + 1e-12; // not by rounding
  const double ceiling = ceilingAtBorder(plan, course, plan.task.override);
  if (plan.strip == plan.firstStrip)
    plan.slowing = part.before > part.most * kAlmost;
  const double braked = part.before - 2.0 * part.deceleration * length;
  plan.slowing = plan.slowing && braked > ceiling;
  if (plan.slowing && isTrapezoid(plan) &&
      braked > ceilingAtBorder(plan, course, presentOverride(plan, course)) * kAlmost)
    plan.state = PlanState::Failed;
  return plan.slowing ? braked : smaller(squareAfter(part, length), ceiling);
}

/// Before this way the run must not be cut off: it could not come to rest.
double leastEnd(const Plan &plan, const Course &course) noexcept {
  constexpr double kMargin = 1.2;
  const double velocity = plan.task.velocity;
  const double deceleration = usableDeceleration(plan, stripAt(course, plan.firstStrip)) / kShare;
  const double time =
      velocity / deceleration +
      deceleration / jerkIn(stripAt(course, plan.firstStrip), plan.task.jerk, plan.task.braking);
  return plan.task.way + kMargin * 0.5 * velocity * time;
}

/// Where a strip's trapezoid has its greatest b: so that it can still brake.
double peakIn(const Part &part, double after) noexcept {
  const double a = part.acceleration;
  const double d = part.deceleration;
  const double peak =
      (d * part.before + a * after + 2.0 * a * d * (part.end - part.begin)) / (a + d);
  return larger(smaller(part.most, peak), larger(part.before, after));
}

} // namespace

bool areAlike(const Strip &a, const Strip &b, double override) noexcept {
  constexpr double kAlike = 1e-4;
  const auto near = [](double x, double y) {
    return x == y || exact::fabs(x - y) <= kAlike * larger(x, y);
  };
  return near(squareIn(a, override), squareIn(b, override)) &&
         near(squareAtEnd(a, override), squareIn(a, override)) && near(a.along, b.along) &&
         near(a.across, b.across) && near(a.acceleration, b.acceleration) &&
         near(a.deceleration, b.deceleration) && a.jerk == b.jerk;
}

double usableAcceleration(const Plan &plan, const Strip &strip) noexcept {
  return usableOf(plan, strip.acceleration, allowedBy(plan, strip));
}

double usableDeceleration(const Plan &plan, const Strip &strip) noexcept {
  return usableOf(plan, brakingOf(plan, strip), allowedBy(plan, strip));
}

Idea ideaAt(const Plan &plan, const Course &course, int64_t number, double way) noexcept {
  const Part part = partOf(plan, course, number);
  const double reach = reachAt(plan, number);
  const double backwards = reach + 2.0 * part.deceleration * (part.end - way);
  const double square = smaller(squareAfter(part, way - part.begin), backwards);
  return {square, part.most, part.acceleration, part.deceleration,
          jerkIn(stripAt(course, number), plan.task.jerk, plan.task.braking)};
}

double reachAtBorder(const Plan &plan, int64_t strip) noexcept { return reachAt(plan, strip); }

double steadyUntil(const Plan &plan, const Course &course, int64_t number) noexcept {
  const Part part = partOf(plan, course, number);
  const double change = larger(part.most - reachAt(plan, number), 0.0);
  return part.end - change / (2.0 * part.deceleration);
}

bool chooseRun(Plan &plan, const Course &course) noexcept {
  const Strip &strip = stripAt(course, plan.strip);
  plan.end = plan.task.end;
  const Part part = partOf(plan, course, plan.strip);
  double length = part.end - part.begin;
  const double left = larger(plan.cut * plan.task.cellTime * plan.task.cells - plan.time, 0.0);
  const double time = countedTime(plan, course, timeFor(part, length));
  const double least = leastEnd(plan, course) - part.begin;
  const bool cut = !plan.task.whole && !isTrapezoid(plan) && time > left && length > least;
  plan.time += time;
  if (cut)
    length = smaller(larger(lengthIn(part, left), least), length);
  reachAt(plan, plan.strip) = squareAtBorder(plan, course, part, length);
  plan.lastStrip = plan.strip;
  const bool whole = !cut && part.end >= strip.end;
  plan.stops = (!cut && part.end >= plan.task.end) || (whole && strip.stop);
  plan.gate = whole && strip.stop && strip.gate;
  // Each strip of a trapezoid may have three pieces; they must have room.
  const bool full = isTrapezoid(plan) && plan.strip - plan.firstStrip >= kMostStrips;
  if (!cut && !plan.stops && !full && plan.strip + 1 < course.next) {
    ++plan.strip;
    return false;
  }
  plan.end = cut ? part.begin + length : part.end;
  reachAt(plan, plan.strip) = 0.0;
  return true;
}

bool reachBackwards(Plan &plan, const Course &course) noexcept {
  const Part part = partOf(plan, course, plan.strip);
  const double square =
      reachAt(plan, plan.strip) + 2.0 * part.deceleration * (part.end - part.begin);
  if (plan.strip == plan.firstStrip) {
    if (isTrapezoid(plan) && square < part.before * (1.0 - 1e-12))
      plan.state = PlanState::Failed;
    return true;
  }
  double &before = reachAt(plan, plan.strip - 1);
  before = smaller(before, square);
  --plan.strip;
  return false;
}

int32_t piecesOf(const Plan &plan, const Course &course, int64_t strip,
                 TimePiece (&pieces)[3]) noexcept {
  const Part part = partOf(plan, course, strip);
  const double after = reachAt(plan, strip);
  const double length = part.end - part.begin;
  const double peak = part.before <= part.most ? peakIn(part, after) : larger(part.most, after);
  const double rate = part.before <= part.most ? part.acceleration : -part.deceleration;
  const double up = smaller((peak - part.before) / (2.0 * rate), length);
  const double down = smaller((peak - after) / (2.0 * part.deceleration), length - up);
  const double least = 1e-12 * length;
  int32_t count = 0;
  if (up > least)
    pieces[count++] = linearPiece(part.begin, up, exact::sqrt(part.before), rate, 0.0);
  if (length - up - down > least)
    pieces[count++] = linearPiece(part.begin + up, length - up - down, exact::sqrt(peak), 0.0, 0.0);
  if (down > least)
    pieces[count++] =
        linearPiece(part.end - down, down, exact::sqrt(peak), -part.deceleration, 0.0);
  return count;
}

} // namespace stride::path
