// The run of a plan and its cells.
#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

constexpr double kGrowth = 1.3;     ///< Of cells, from one to the next.
constexpr double kRampPart = 0.06;  ///< See cellLength.
constexpr double kSteadyPart = 0.3; ///< See cellLength.
/// A rest cell is at most this part of the run. Constant jerk out of rest is right for 1/12 of a
/// short one.
constexpr double kRestPart = 1.0 / 13.0;

/// b at the way x out of rest, with constant jerk. [u^2/s^2]
double squareFromRest(double jerk, double x) noexcept {
  const double acceleration = accelerationFromRest(jerk, x);
  const double velocity = 0.5 * acceleration * acceleration / jerk;
  return velocity * velocity;
}

/// b as the first idea has it, with regard to rest at the ends. [u^2/s^2]
double expected(const Plan &plan, const Course &course, double way) noexcept {
  double square = firstIdea(plan, course, plan.strip, way);
  square = smaller(square, squareFromRest(plan.task.jerk, plan.end - way));
  if (startsAtRest(plan))
    square = smaller(square, squareFromRest(plan.task.jerk, way - plan.task.way));
  return square;
}

/// How long a cell should be where the velocity is `velocity` and the acceleration can be `limit`.
/// Where the velocity changes, the time may be at most `part` of what is needed to come to it from
/// rest. A run that has proved to need too many cells gets coarser ones. [u]
double cellLength(const Plan &plan, double velocity, double limit, double part) noexcept {
  const double needed = larger(exact::sqrt(velocity / plan.task.jerk), velocity / limit);
  return velocity *
         smaller((1.0 + 0.5 * plan.cuts) * plan.task.cellTime, part * (1.0 + plan.cuts) * needed);
}

/// The same for one beside a cell of `rest` next to rest. [u]
double lengthBesideRest(const Plan &plan, double rest) noexcept {
  return cellLength(plan, exact::sqrt(squareFromRest(plan.task.jerk, rest)), exact::kInfinity,
                    kRampPart);
}

double restLength(double jerk, double time) noexcept { return jerk * time * time * time / 6.0; }

/// The length of the cell next to rest, from `strip` on to that side: constant jerk must not lead
/// beyond the limits there.
double restCell(const Plan &plan, const Course &course, bool atEnd) noexcept {
  const double jerk = plan.task.jerk;
  double length = kRestPart * (plan.end - plan.task.way);
  double square = exact::kInfinity;
  double acceleration = exact::kInfinity;
  double covered = 0.0;
  int64_t number = atEnd ? plan.lastStrip : plan.firstStrip;
  while (number >= plan.firstStrip && number <= plan.lastStrip && covered < length) {
    const Strip &strip = stripAt(course, number);
    square = smaller(square, squareIn(strip, plan.task.override));
    acceleration = smaller(acceleration, atEnd ? usableDeceleration(plan, strip)
                                               : usableAcceleration(plan, strip));
    const double time =
        smaller(1.9 * acceleration / jerk, 0.9 * exact::sqrt(exact::sqrt(square) / jerk));
    length = smaller(length, restLength(jerk, time));
    covered += smaller(strip.end, plan.end) - larger(beginOf(course, number), plan.task.way);
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
  if (plan.strip > plan.firstStrip && beginOf(course, plan.strip) >= from)
    lowerAtEnd(plan, cell, stripAt(course, plan.strip - 1));
  for (int64_t number = plan.strip; number <= plan.lastStrip; ++number) {
    if (number > plan.strip && beginOf(course, number) >= cell.end)
      break;
    const Strip &strip = stripAt(course, number);
    cell.ceiling = smaller(cell.ceiling, squareIn(strip, plan.task.override));
    cell.along = larger(cell.along, strip.along);
    cell.across = larger(cell.across, strip.across);
    cell.acceleration = smaller(cell.acceleration, strip.acceleration);
    cell.deceleration =
        smaller(cell.deceleration, larger(strip.deceleration, plan.task.deceleration));
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
  plan.endRest = restCell(plan, course, true);
  plan.endStep = lengthBesideRest(plan, plan.endRest);
  if (startsAtRest(plan)) {
    const double length = restCell(plan, course, false);
    putCell(plan, course, plan.task.way + length, plan.task.way + 0.25 * length);
    plan.step = lengthBesideRest(plan, length) / kGrowth;
    return;
  }
  const double room = plan.end - plan.endRest - plan.knot;
  const double length =
      smaller(0.5 * cellLength(plan, plan.task.velocity, exact::kInfinity, kRampPart), 0.25 * room);
  putCell(plan, course, plan.task.way + length, plan.task.way + 0.5 * length);
}

/// The length of the next cell, when `left` is there before the last one.
double nextLength(const Plan &plan, const Course &course, double left) noexcept {
  const double idea = expected(plan, course, plan.knot);
  const Strip &here = stripAt(course, plan.strip);
  const bool steady = idea >= squareIn(here, plan.task.override);
  const double limit =
      2.0 * smaller(usableAcceleration(plan, here), usableDeceleration(plan, here));
  const double wish = cellLength(plan, exact::sqrt(idea), limit, steady ? kSteadyPart : kRampPart);
  double length = smaller(larger(wish, 0.1 * plan.step), kGrowth * plan.step);
  length = smaller(length, (plan.endStep + (kGrowth - 1.0) * left) / kGrowth);
  if (left <= 1.3 * length)
    return left;
  if (left <= 2.0 * length)
    return 0.5 * left;
  // Where limits change, a knot: else the cell has those of both sides.
  const double toBorder = here.end - plan.knot;
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
    const double length = nextLength(plan, course, left);
    const double end = length < left ? plan.knot + length : plan.end - plan.endRest;
    putCell(plan, course, end, plan.knot + 0.5 * (end - plan.knot));
    return false;
  }
  putCell(plan, course, plan.end, plan.end - 0.25 * plan.endRest);
  return true;
}

} // namespace stride::path
