// The run of a plan and its cells.
#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

constexpr double kGrowth = 1.3; ///< Of cells, from one to the next.
constexpr double kCoarse = 3.0; ///< Cells where it only brakes for an open end, as a multiple.
constexpr double kCoarseGrowth = 1.6;  ///< Of these.
constexpr double kRampPart = 0.06;     ///< See cellLength.
constexpr double kLeanRampPart = 0.08; ///< Likewise.
constexpr double kSteadyPart = 0.3;    ///< See cellLength.
constexpr int kStripsLookedAt = 16;    ///< For the length of a rest cell.
/// A rest cell is at most this part of the run. Constant jerk out of rest is right for 1/12 of a
/// short one.
constexpr double kRestPart = 1.0 / 13.0;

/// b at the way x out of rest, with constant jerk. [u^2/s^2]
double squareFromRest(double jerk, double x) noexcept {
  const double acceleration = accelerationFromRest(jerk, x);
  const double velocity = 0.5 * acceleration * acceleration / jerk;
  return velocity * velocity;
}

double restLength(double jerk, double time) noexcept { return jerk * time * time * time / 6.0; }

/// `square`, if b at the way x next to rest is not less. That takes a cube root, so it is only
/// looked at where x is not clearly long enough.
double besideRest(double jerk, double square, double velocity, double x) noexcept {
  if (x > 1.01 * restLength(jerk, exact::sqrt(2.0 * velocity / jerk)))
    return square;
  return smaller(square, squareFromRest(jerk, x));
}

/// b as the first idea has it, with regard to rest at the ends. [u^2/s^2]
double expected(const Plan &plan, const Course &course, const Idea &idea, double way) noexcept {
  const auto jerkOf = [&plan, &course](int64_t strip) {
    return jerkIn(stripAt(course, strip), plan.task.jerk, plan.task.braking);
  };
  const double velocity = exact::sqrt(idea.square);
  const double square = besideRest(jerkOf(plan.lastStrip), idea.square, velocity, plan.end - way);
  if (!startsAtRest(plan))
    return square;
  return besideRest(jerkOf(plan.firstStrip), square, velocity, way - plan.task.way);
}

/// How long the velocity takes to come from rest, at least, where the acceleration can be `limit`
/// and the jerk `jerk`. [s]
double timeFromRest(double velocity, double limit, double jerk) noexcept {
  return larger(exact::sqrt(velocity / jerk), velocity / limit);
}

/// How long a cell should be where the velocity is `velocity`. Where that changes, the time may be
/// at most `part` of what is `needed` to come to it from rest. A run that has proved to need too
/// many cells gets coarser ones. [u]
double cellLength(const Plan &plan, double velocity, double needed, double part) noexcept {
  const double length = velocity * smaller((1.0 + 0.5 * plan.cuts) * plan.task.cellTime,
                                           part * (1.0 + plan.cuts) * needed);
  return plan.coarse ? kCoarse * length : length;
}

/// See cellLength.
double rampPartOf(const Plan &plan) noexcept { return plan.task.lean ? kLeanRampPart : kRampPart; }

double growthOf(const Plan &plan) noexcept { return plan.coarse ? kCoarseGrowth : kGrowth; }

/// Whether the run only brakes from the present knot on, for its end where no more of the path is
/// known. As a rule that end is gone, by another plan, before the motion comes there.
bool onlyBrakes(const Plan &plan, const Idea &idea) noexcept {
  const double braked = 2.0 * idea.deceleration * (plan.end - plan.knot);
  return !plan.stops && idea.square >= 0.9 * braked;
}

/// Whether the run is that short that the motion would wait longer for a better plan than it gains.
bool isHurried(const Plan &plan) noexcept {
  constexpr double kWorth = 2.0; // of the time for a plan
  return plan.stops && plan.time < kWorth * plan.task.hurry;
}

/// The same for one beside a cell of `rest` next to rest. [u]
double lengthBesideRest(const Plan &plan, double jerk, double rest) noexcept {
  const double velocity = exact::sqrt(squareFromRest(jerk, rest));
  return cellLength(plan, velocity, timeFromRest(velocity, exact::kInfinity, jerk),
                    rampPartOf(plan));
}

/// The length of a strip's part that belongs to the run. [u]
double lengthInRun(const Plan &plan, const Course &course, int64_t strip) noexcept {
  return smaller(stripAt(course, strip).end, plan.end) -
         larger(beginOf(course, strip), plan.task.way);
}

/// The length of a cell next to rest that leads to no more than half of the velocity with which the
/// motion comes to the border of a strip. [u]
double restBefore(const Plan &plan, int64_t strip, double jerk, bool atEnd) noexcept {
  const double square = reachAtBorder(plan, atEnd ? strip : strip - 1);
  return restLength(jerk, exact::sqrt(exact::sqrt(square) / jerk));
}

/// The length that constant jerk has next to rest before it would lead beyond limits. [u]
double restWithin(double jerk, double square, double acceleration) noexcept {
  return restLength(
      jerk, smaller(1.9 * acceleration / jerk, 0.9 * exact::sqrt(exact::sqrt(square) / jerk)));
}

/// The length of the cell next to rest, from `strip` on to that side: constant jerk must not lead
/// beyond the limits there.
double restCell(const Plan &plan, const Course &course, bool atEnd) noexcept {
  double length = kRestPart * (plan.end - plan.task.way);
  double square = exact::kInfinity;
  double acceleration = exact::kInfinity;
  double jerk = plan.task.jerk;
  double covered = 0.0;
  int64_t number = atEnd ? plan.lastStrip : plan.firstStrip;
  for (int k = 0; k < kStripsLookedAt; ++k) {
    if (number < plan.firstStrip || number > plan.lastStrip || kRestPart * covered >= length)
      break;
    if (covered > 0.0) // up to a slow place it is like a short run of its own
      length = smaller(length, larger(kRestPart * covered, restBefore(plan, number, jerk, atEnd)));
    if (covered < length) {
      const Strip &strip = stripAt(course, number);
      square = smaller(square, squareIn(strip, plan.task.override));
      acceleration = smaller(acceleration, atEnd ? usableDeceleration(plan, strip)
                                                 : usableAcceleration(plan, strip));
      jerk = jerkIn(strip, jerk, plan.task.braking);
      length = smaller(length, restWithin(jerk, square, acceleration));
    }
    covered += lengthInRun(plan, course, number);
    number += atEnd ? -1 : 1;
  }
  return length;
}

/// The override that limits a motion while it slows down to its own.
double quickest(const Plan &plan) noexcept { return larger(plan.task.override, plan.task.before); }

void lowerAtEnd(const Plan &plan, Cell &cell, const Strip &strip) noexcept {
  cell.ceiling = smaller(cell.ceiling, squareAtEnd(strip, plan.task.override));
  cell.curve = smaller(cell.curve, squareAtEnd(strip, quickest(plan)));
}

/// The limits of the strips that a cell touches, from plan.strip on; moves on to the one in which
/// the next cell begins.
void takeLimits(Plan &plan, const Course &course, Cell &cell, double from) noexcept {
  cell.ceiling = exact::kInfinity;
  cell.curve = exact::kInfinity;
  cell.along = 0.0;
  cell.across = 0.0;
  cell.acceleration = exact::kInfinity;
  cell.deceleration = exact::kInfinity;
  cell.jerk = plan.task.jerk;
  if (plan.strip > plan.firstStrip && beginOf(course, plan.strip) >= from)
    lowerAtEnd(plan, cell, stripAt(course, plan.strip - 1));
  for (int64_t number = plan.strip; number <= plan.lastStrip; ++number) {
    if (number > plan.strip && beginOf(course, number) >= cell.end)
      break;
    const Strip &strip = stripAt(course, number);
    cell.ceiling = smaller(cell.ceiling, squareIn(strip, plan.task.override));
    cell.along = larger(cell.along, strip.along);
    cell.across = larger(cell.across, strip.across);
    cell.jerk = jerkIn(strip, cell.jerk, plan.task.braking);
    cell.acceleration = smaller(cell.acceleration, strip.acceleration);
    cell.deceleration = smaller(cell.deceleration, decelerationIn(strip, plan.task.braking));
    cell.curve = smaller(cell.curve, squareIn(strip, quickest(plan)));
    if (strip.end <= cell.end && strip.end < plan.end)
      lowerAtEnd(plan, cell, strip);
  }
  while (plan.strip < plan.lastStrip && stripAt(course, plan.strip).end <= cell.end)
    ++plan.strip;
}

void putCell(Plan &plan, const Course &course, double end, double middle) noexcept {
  Cell &cell = plan.cell[plan.count];
  cell.end = end;
  cell.middle = middle;
  takeLimits(plan, course, cell, plan.knot);
  plan.step = end - plan.knot;
  plan.knot = end;
  ++plan.count;
}

void putFirstCell(Plan &plan, const Course &course) noexcept {
  plan.knot = plan.task.way;
  plan.strip = plan.firstStrip;
  plan.coarse = !plan.stops || isHurried(plan);
  plan.endRest = restCell(plan, course, true);
  plan.endStep = lengthBesideRest(
      plan, jerkIn(stripAt(course, plan.lastStrip), plan.task.jerk, plan.task.braking),
      plan.endRest);
  plan.coarse = isHurried(plan);
  const double jerk = jerkIn(stripAt(course, plan.firstStrip), plan.task.jerk, plan.task.braking);
  if (startsAtRest(plan)) {
    const double length = restCell(plan, course, false);
    putCell(plan, course, plan.task.way + length, plan.task.way + 0.25 * length);
    plan.step = lengthBesideRest(plan, jerk, length) / kGrowth;
    return;
  }
  const double room = plan.end - plan.endRest - plan.knot;
  const double needed = timeFromRest(plan.task.velocity, exact::kInfinity, jerk);
  const double length =
      smaller(0.5 * cellLength(plan, plan.task.velocity, needed, rampPartOf(plan)), 0.25 * room);
  putCell(plan, course, plan.task.way + length, plan.task.way + 0.5 * length);
}

/// How far the velocity stays the greatest one, as the first idea has it. [u]
double steadyWay(const Plan &plan, const Course &course) noexcept {
  constexpr int64_t kMostStrips = 8; // that one step looks at
  int64_t number = plan.strip;
  while (number < plan.lastStrip && number < plan.strip + kMostStrips &&
         areAlike(stripAt(course, number), stripAt(course, number + 1), plan.task.override) &&
         steadyUntil(plan, course, number) >= stripAt(course, number).end)
    ++number;
  return larger(steadyUntil(plan, course, number) - plan.knot, 0.0);
}

/// The wish for the length of the next cell where the velocity is the greatest one: the longer, the
/// further it is to where it changes. [u]
double steadyLength(const Plan &plan, const Course &course, double velocity,
                    double needed) noexcept {
  const double atRamp = cellLength(plan, velocity, needed, rampPartOf(plan));
  const double growth = growthOf(plan);
  const double growing = (atRamp + (growth - 1.0) * steadyWay(plan, course)) / growth;
  return larger(cellLength(plan, velocity, needed, kSteadyPart), growing);
}

/// The length of the next cell, when `left` is there before the last one.
double nextLength(const Plan &plan, const Course &course, const Idea &idea, double left) noexcept {
  const double square = expected(plan, course, idea, plan.knot);
  const double velocity = exact::sqrt(square);
  const double needed =
      timeFromRest(velocity, 2.0 * smaller(idea.acceleration, idea.deceleration), idea.jerk);
  const double wish = square >= idea.most ? steadyLength(plan, course, velocity, needed)
                                          : cellLength(plan, velocity, needed, rampPartOf(plan));
  const double growth = growthOf(plan);
  double length = smaller(larger(wish, 0.1 * plan.step), growth * plan.step);
  length = smaller(length, (plan.endStep + (growth - 1.0) * left) / growth);
  if (left <= 1.3 * length)
    return left;
  if (left <= 2.0 * length)
    return 0.5 * left;
  // Where limits change, a knot: else the cell has those of both sides.
  const double toBorder = stripAt(course, plan.strip).end - plan.knot;
  if (plan.strip < plan.lastStrip && toBorder > 0.5 * length && toBorder < 1.4 * length)
    return toBorder;
  return length;
}

} // namespace

double accelerationFromRest(double jerk, double x) noexcept {
  const TimePiece piece = pieceFromRest(0.0, x, jerk);
  return jerk * piece.duration;
}

bool addCell(Plan &plan, const Course &course) noexcept {
  if (plan.count == 0) {
    putFirstCell(plan, course);
    return false;
  }
  if (plan.count == plan.task.cells) {
    plan.state = PlanState::Failed;
    return true;
  }
  const double left = plan.end - plan.endRest - plan.knot;
  if (left > 1e-9 * plan.endRest) {
    const Idea idea = ideaAt(plan, course, plan.strip, plan.knot);
    plan.coarse = onlyBrakes(plan, idea) || isHurried(plan);
    const double length = nextLength(plan, course, idea, left);
    const double end = length < left ? plan.knot + length : plan.end - plan.endRest;
    putCell(plan, course, end, plan.knot + 0.5 * (end - plan.knot));
    return false;
  }
  putCell(plan, course, plan.end, plan.end - 0.25 * plan.endRest);
  return true;
}

} // namespace stride::path
