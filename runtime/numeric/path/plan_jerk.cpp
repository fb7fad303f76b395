// Passes 3 and 4 of a plan: what the jerk allows.
#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

/// Comparisons of slopes that only differ by rounding.
constexpr double kAlmost = 1.0 + 1e-9;
/// How far a limit may be exceeded, which is nothing but rounding. More than that is made up for by
/// a slower motion, up to kMost.
constexpr double kRounding = 1.0 + 5e-7;
constexpr double kMost = 1.5;

bool isRestCell(const Plan &plan, int32_t i) noexcept {
  return i == plan.count - 1 || (i == 0 && startsAtRest(plan));
}

bool isValley(const Plan &plan, int32_t i) noexcept {
  if (isRestCell(plan, i))
    return false;
  const double rise = slopeAt(plan, i) - slopeBefore(plan, i);
  return rise > 0.0 && rise > changeIn(plan, i) * kAlmost; // which is dear to know
}

// ---- the heap of valleys, the lowest first

double heightOf(const Plan &plan, int32_t place) noexcept {
  return plan.cell[plan.stack[place]].square;
}

void swapPlaces(Plan &plan, int32_t a, int32_t b) noexcept {
  const int16_t cell = plan.stack[a];
  plan.stack[a] = plan.stack[b];
  plan.stack[b] = cell;
}

void push(Plan &plan, int32_t cell) noexcept {
  int32_t place = plan.stacked++;
  plan.stack[place] = static_cast<int16_t>(cell);
  for (; place > 0; place = (place - 1) / 2) {
    const int32_t parent = (place - 1) / 2;
    if (heightOf(plan, parent) <= heightOf(plan, place))
      break;
    swapPlaces(plan, parent, place);
  }
}

int32_t popLowest(Plan &plan) noexcept {
  const int32_t cell = plan.stack[0];
  plan.stack[0] = plan.stack[--plan.stacked];
  for (int32_t place = 0;;) {
    int32_t least = place;
    for (int32_t child = 2 * place + 1; child <= 2 * place + 2 && child < plan.stacked; ++child)
      if (heightOf(plan, child) < heightOf(plan, least))
        least = child;
    if (least == place)
      return cell;
    swapPlaces(plan, least, place);
    place = least;
  }
}

// ---- curves out of valleys

/// Chooses the slopes on both sides of a valley: at rest between both where b has its minimum
/// there, else the steeper side keeps its slope.
void beginCurves(Plan &plan, int32_t i) noexcept {
  const double before = slopeBefore(plan, i);
  const double after = slopeAt(plan, i);
  const double change = changeIn(plan, i);
  double left = before;
  double right = smaller(after, before + change);
  if (i > 0 || startsAtRest(plan)) {
    if (after <= 0.0) {
      right = after;
      left = larger(before, after - change);
    } else if (before < 0.0) {
      left = larger(before, -0.5 * change);
      right = smaller(after, left + change);
      left = larger(before, right - change);
    }
  }
  plan.valley = i;
  plan.index = i;
  plan.heading = 1;
  plan.curveSlope = right;
  plan.otherSlope = -left;
}

/// b at the knot by which a curve comes into cell `i`.
double squareEntering(const Plan &plan, int32_t i) noexcept {
  if (plan.heading < 0)
    return squareAtKnot(plan, i);
  return i > 0 ? squareAtKnot(plan, i - 1) : plan.task.velocity * plan.task.velocity;
}

/// How far the slope rises within cell `i`, which is left on the side of `heading`, if its end has
/// to be reached with the velocity at which the slope can change.
double slopeAfter(const Plan &plan, int32_t i, double slope) noexcept {
  const Cell &cell = plan.cell[i];
  const double knot = plan.heading > 0 ? cell.end : knotBefore(plan, i);
  const double reach = exact::fabs(knot - cell.middle);
  const double change = cell.jerk * lengthOf(plan, i);
  // A run that begins braking comes into the cell with more than it has in its middle.
  const double least = larger(cell.square, squareEntering(plan, i));
  double square = least;
  double next = slope;
  for (int k = 0; k < 4; ++k) { // from above and below by turns, ends where it is slow enough
    next = slope + change / exact::sqrt(square);
    const double then = larger(cell.square + 2.0 * next * reach, least);
    if (then == square)
      return next;
    square = then;
  }
  return slope + change / exact::sqrt(square);
}

/// Draws one span of the curve; false: it has met the rest.
bool drawCurve(Plan &plan) noexcept {
  const int32_t i = plan.index;
  const int32_t next = i + plan.heading;
  if (next < 0 || next >= plan.count)
    return false;
  const int32_t knot = plan.heading > 0 ? i : i - 1;
  const double square = plan.cell[i].square + 2.0 * plan.curveSlope * spanAt(plan, knot);
  Cell &cell = plan.cell[next];
  if (square >= cell.square || isRestCell(plan, next))
    return false;
  if (next == 0 || !(square > 0.0)) {
    plan.state = PlanState::Failed; // it would have to be slower before it begins
    return false;
  }
  cell.square = square;
  plan.index = next;
  const int32_t after = plan.heading > 0 ? next : next - 1;
  plan.curveSlope = slopeAfter(plan, next, plan.curveSlope);
  if (after >= 0) {
    const Cell &there = plan.cell[after];
    plan.curveSlope = smaller(plan.curveSlope, plan.heading > 0 ? there.up : there.down);
  }
  return true;
}

// ---- the hull

double slopeOfLine(const Plan &plan, int32_t from, int32_t to) noexcept {
  const Cell &a = *(plan.cell + from);
  const Cell &b = *(plan.cell + to);
  return (b.bound + b.lift - (a.bound + a.lift)) / (b.middle - a.middle);
}

/// Pushes a control point and takes away those that are not on the hull any more.
void pushOntoHull(Plan &plan, int32_t i) noexcept {
  const int16_t *const stack = plan.stack;
  double slope = 0.0;
  while (plan.stacked > 0) {
    const int16_t *const last = stack + plan.stacked - 1;
    slope = slopeOfLine(plan, *last, i);
    if (plan.stacked == 1 || plan.otherSlope < slope)
      break;
    --plan.stacked;
    if (plan.stacked >= 2)
      plan.otherSlope = slopeOfLine(plan, last[-2], last[-1]);
  }
  plan.otherSlope = slope;
  plan.stack[plan.stacked++] = static_cast<int16_t>(i);
}

/// Goes on from the hull's point at plan.valley to the next one. Heights above the line between
/// both are summed up from there on, not taken from the whole run's, in which they would cancel.
void beginEdge(Plan &plan) noexcept {
  plan.index = plan.stack[plan.valley];
  plan.curveSlope = 0.0;
  plan.height = 0.0;
}

/// The height of the next point, by one span.
void riseOverSpan(Plan &plan) noexcept {
  plan.height += plan.curveSlope * spanAt(plan, plan.index);
  ++plan.index;
  plan.curveSlope += plan.cell[plan.index].change;
}

/// Whether this round of pass 4 is the last one.
bool isLastRound(const Plan &plan) noexcept { return plan.round == (plan.task.lean ? 1 : 2); }

/// What slopes may fall within a cell, in units of changeIn.
double fallOf(const Plan &plan) noexcept { return plan.careful ? 2.0 * (1.0 - kCare) : 2.0; }

/// Lowers a cell to the hull. The next round takes from it how far slopes can fall: of a hull
/// that is too low, since its own velocities were too high, that would be too far.
void lower(const Plan &plan, Cell &cell, double square) noexcept {
  cell.square = plan.task.lean && !isLastRound(plan) ? 0.5 * (cell.square + square) : square;
}

// ---- the check

/// What a motion has of a limit. As a rule that is less, which needs no division.
void note(Plan &plan, double value, double limit) noexcept {
  constexpr double kLess = 0.999;
  if (value < kLess * limit)
    return;
  const double part = value / limit;
  if (part > plan.worst)
    plan.worst = part;
  else if (!(part <= plan.worst)) // NaN
    plan.worst = exact::kInfinity;
}

void checkKnot(Plan &plan, int32_t i) noexcept {
  const Cell *const cell = plan.cell + i;
  const Cell &a = cell[0];
  const Cell &b = cell[1];
  const double slope = slopeAt(cell);
  const double square = squareAtKnot(cell);
  note(plan, exact::fabs(slope),
       slope > 0.0 ? smaller(a.acceleration, b.acceleration)
                   : smaller(a.deceleration, b.deceleration));
  note(plan,
       exact::fabs(slope) * larger(a.along, b.along) +
           larger(a.across, b.across) * larger(a.square, b.square),
       1.0);
  note(plan, square, smaller(a.ceiling, b.ceiling));
  note(plan, square, smaller(a.curve, b.curve));
}

/// A run that begins with an acceleration which its strip allows may be cut there into a cell that
/// reaches into a strip which allows less. (One that is beyond its strip's already may go on.)
void checkStart(Plan &plan, const Course &course) noexcept {
  const Strip &strip = stripAt(course, plan.firstStrip);
  const Cell &cell = plan.cell[0];
  const double a = plan.task.acceleration;
  const double own = a > 0.0 ? strip.acceleration : decelerationIn(strip, plan.task.braking);
  if (!startsAtRest(plan) && exact::fabs(a) <= own * kRounding)
    note(plan, exact::fabs(a), a > 0.0 ? cell.acceleration : cell.deceleration);
}

void checkCell(Plan &plan, int32_t i) noexcept {
  const Cell &cell = plan.cell[i];
  note(plan, cell.square, cell.ceiling);
  note(plan, cell.square, cell.curve);
  if (i == 0 && !startsAtRest(plan))
    note(plan, plan.task.velocity * plan.task.velocity, cell.curve);
  if (isRestCell(plan, i)) {
    const double slope = exact::fabs(i == 0 ? slopeAt(plan, 0) : slopeAt(plan, i - 1));
    const double x = lengthOf(plan, i);
    note(plan, slope, accelerationFromRest(cell.jerk, x));
    return;
  }
  note(plan, exact::fabs(slopeAt(plan, i) - slopeBefore(plan, i)), changeIn(plan, i));
  if (!(cell.square > 0.0))
    plan.worst = exact::kInfinity;
}

bool findValleysOnce(Plan &plan, const Course & /*course*/) noexcept {
  if (plan.index == 0) {
    plan.stacked = 0;
    plan.heading = 0;
  }
  if (plan.index == plan.count - 1)
    return true;
  if (isValley(plan, plan.index))
    push(plan, plan.index);
  ++plan.index;
  return false;
}

bool raiseSlowlyOnce(Plan &plan, const Course & /*course*/) noexcept {
  if (plan.heading != 0) {
    if (drawCurve(plan))
      return false;
    plan.heading = static_cast<int8_t>(plan.heading > 0 ? -1 : 0);
    plan.index = plan.valley;
    plan.curveSlope = plan.otherSlope;
    return plan.state == PlanState::Failed;
  }
  if (plan.stacked == 0)
    return true;
  const int32_t i = popLowest(plan);
  if (isValley(plan, i))
    beginCurves(plan, i);
  return false;
}

bool stackHullOnce(Plan &plan, const Course & /*course*/) noexcept {
  const int32_t i = plan.index;
  Cell &cell = *(plan.cell + i);
  if (i == 0) {
    plan.stacked = 0;
    plan.curveSlope = 0.0;
  }
  if (plan.round == 0)
    cell.bound = cell.square;
  cell.change = isRestCell(plan, i) ? 0.0 : fallOf(plan) * changeIn(plan, i);
  const Cell *const before = &cell - 1;
  cell.lift = i > 0 ? before->lift + plan.curveSlope * spanAt(before) : 0.0;
  plan.curveSlope += cell.change;
  pushOntoHull(plan, i);
  ++plan.index;
  if (plan.index < plan.count)
    return false;
  // The first slope must not fall further than the first cell can follow.
  const double least = 2.0 * plan.task.acceleration;
  if ((isLastRound(plan) || !plan.task.lean) && !startsAtRest(plan) &&
      slopeOfLine(plan, plan.stack[0], plan.stack[1]) <
          least - 1e-9 * exact::fabs(plan.cell[0].change)) {
    plan.state = PlanState::Failed;
    return true;
  }
  plan.valley = 0;
  plan.heading = 1;
  beginEdge(plan);
  return true;
}

bool lowerToHullOnce(Plan &plan, const Course & /*course*/) noexcept {
  const int32_t from = plan.stack[plan.valley];
  const int32_t to = plan.stack[plan.valley + 1];
  riseOverSpan(plan);
  const Cell &a = plan.cell[from];
  Cell &cell = plan.cell[plan.index];
  if (plan.heading > 0) { // there, for the height at its end
    if (plan.index < to)
      return false;
    plan.otherSlope = (cell.bound - a.bound + plan.height) / (cell.middle - a.middle);
    plan.heading = -1;
    beginEdge(plan);
    return false;
  }
  if (plan.index < to) { // once more, with the line
    const double line = a.bound + plan.otherSlope * (cell.middle - a.middle);
    lower(plan, cell, smaller(cell.bound, line - plan.height));
    return false;
  }
  lower(plan, cell, cell.bound);
  ++plan.valley;
  plan.heading = 1;
  beginEdge(plan);
  if (plan.valley + 1 < plan.stacked)
    return false;
  ++plan.round;
  return true;
}

bool checkOnce(Plan &plan, const Course &course) noexcept {
  const int32_t i = plan.index;
  if (i == 0)
    checkStart(plan, course);
  checkCell(plan, i);
  if (i + 1 < plan.count) {
    checkKnot(plan, i);
    ++plan.index;
    return false;
  }
  if (plan.worst > kRounding && (!startsAtRest(plan) || !(plan.worst < kMost)))
    plan.state = PlanState::Failed;
  return true;
}

bool slowDownOnce(Plan &plan, const Course & /*course*/) noexcept {
  if (plan.worst <= kRounding || plan.index == plan.count)
    return true;
  // By that much all over: jerk and acceleration fall at least as far.
  plan.cell[plan.index].square /= plan.worst;
  ++plan.index;
  return false;
}

} // namespace

bool findValleys(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<findValleysOnce>(plan, course, budget);
}
bool raiseSlowly(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<raiseSlowlyOnce>(plan, course, budget);
}
bool stackHull(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<stackHullOnce>(plan, course, budget);
}
bool lowerToHull(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<lowerToHullOnce>(plan, course, budget);
}
bool check(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<checkOnce>(plan, course, budget);
}
bool slowDown(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<slowDownOnce>(plan, course, budget);
}

} // namespace stride::path
