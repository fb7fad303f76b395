// Passes 1 and 2 of a plan: what the accelerations allow.
#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

/// Limits of the axes at the knot after a cell: those of the cells on both sides.
double alongAt(const Cell *cell) noexcept { return larger(cell[0].along, cell[1].along); }
double acrossAt(const Cell *cell) noexcept { return larger(cell[0].across, cell[1].across); }

/// The greatest b at one side of the knot if there is `square` at the other one and the
/// acceleration is at most `limit`.
double squareBeyond(const Cell *cell, double square, double limit) noexcept {
  const double span = spanAt(cell);
  const double weight = alongAt(cell) / (2.0 * span);
  const double byAxes = (1.0 + weight * square) / (weight + acrossAt(cell));
  return smaller(square + 2.0 * limit * span, byAxes);
}

/// What the curve of the path leaves of the axes' acceleration at the knot.
double leftAt(const Cell *cell) noexcept {
  const double square = larger(cell[0].square, cell[1].square);
  const double left = larger(1.0 - acrossAt(cell) * square, 0.0);
  return left / alongAt(cell);
}

void setKnotLimits(Plan &plan, int32_t i) noexcept {
  Cell &cell = plan.cell[i];
  const Cell &next = plan.cell[i + 1];
  cell.up = smaller(cell.acceleration, next.acceleration);
  cell.down = smaller(cell.deceleration, next.deceleration);
  if (i == 0 && startsAtRest(plan))
    cell.up = smaller(cell.up, accelerationFromRest(cell.jerk, cell.end - plan.task.way));
  if (i == plan.count - 2)
    cell.down = smaller(cell.down, accelerationFromRest(next.jerk, next.end - cell.end));
}

/// The first control point of a run that does not begin at rest is given; if it is above the
/// ceilings, since there is another override, the ceilings are those of a motion that slows down.
void beginSlowing(Plan &plan, double ceiling) noexcept {
  const double velocity = plan.task.velocity;
  Cell &cell = plan.cell[0];
  cell.square =
      startsAtRest(plan) ? 0.0 : velocity * velocity + plan.task.acceleration * lengthOf(plan, 0);
  if (!(cell.square > 0.0) && !startsAtRest(plan))
    plan.state = PlanState::Failed;
  plan.slowing = cell.square > ceiling;
  if (plan.slowing)
    cell.ceiling = larger(cell.ceiling, velocity * velocity);
  plan.height = cell.square;
  plan.curveSlope = plan.task.acceleration;
}

/// The motion that slows down, by one cell: with a little less than jerk and deceleration allow,
/// which leaves something to the passes that follow. It brakes as hard as it can and still get rid
/// of the deceleration before it is below the ceiling: from there on no cell has slack to spare.
void goOnSlowing(Plan &plan, int32_t i, double ceiling) noexcept {
  constexpr double kLess = 0.95;
  constexpr double kThere = 1.0 + 1e-12;
  const double jerk = kLess * plan.cell[i - 1].jerk;
  const double velocity = exact::sqrt(plan.height);
  const double span = spanAt(plan, i - 1);
  const double change = jerk * lengthOf(plan, i - 1) / velocity;
  const double excess = larger(velocity - exact::sqrt(ceiling), 0.0);
  // The velocity falls by a * time in this span, and by a^2 / (2 * jerk) until the end.
  const double time = span / velocity;
  const double ideal = 2.0 * excess / (exact::sqrt(time * time + 2.0 * excess / jerk) + time);
  const double before = -plan.curveSlope;
  const double most = larger(before, kLess * plan.cell[i - 1].down);
  const double wanted = smaller(larger(ideal, before - change), before + change);
  plan.curveSlope = -smaller(wanted, most);
  plan.height = larger(plan.height + 2.0 * plan.curveSlope * span, 0.0);
  if (plan.height <= ceiling * kThere && -plan.curveSlope <= change)
    plan.slowing = false;
}

bool lowerBetweenCeilingsOnce(Plan &plan, const Course & /*course*/) noexcept {
  // b stays within the hull of three control points: with the least of three ceilings it is
  // nowhere above that of its cell.
  const int32_t i = plan.index;
  const bool last = i == plan.count - 1;
  Cell &cell = plan.cell[i];
  const Cell &before = plan.cell[i > 0 ? i - 1 : 0];
  const Cell &after = plan.cell[last ? i : i + 1];
  if (last) {
    cell.square = 0.0;
    return true;
  }
  const double ceiling = smaller(cell.ceiling, smaller(before.ceiling, after.ceiling));
  const double curve = smaller(cell.curve, smaller(before.curve, after.curve));
  setKnotLimits(plan, i);
  if (i == 0)
    beginSlowing(plan, ceiling);
  else if (plan.slowing)
    goOnSlowing(plan, i, ceiling);
  if (i > 0)
    cell.square = plan.slowing ? smaller(curve, larger(ceiling, plan.height)) : ceiling;
  if (i > 0 && plan.slowing) // it counts as the ceiling, on both sides
    cell.ceiling = larger(cell.ceiling, larger(cell.square, before.square));
  ++plan.index;
  return false;
}

bool accelerateOnce(Plan &plan, const Course & /*course*/) noexcept {
  const int32_t i = plan.index;
  if (i + 1 >= plan.count)
    return true;
  Cell *const cell = plan.cell + i;
  cell[1].square = smaller(cell[1].square, squareBeyond(cell, cell->square, cell->up));
  ++plan.index;
  return false;
}

bool brakeOnce(Plan &plan, const Course & /*course*/) noexcept {
  const int32_t i = plan.count - 2 - plan.index;
  if (i < 0)
    return true;
  Cell *const cell = plan.cell + i;
  const double most = squareBeyond(cell, cell[1].square, cell->down);
  if (i == 0 && !startsAtRest(plan)) {
    if (most < cell->square)
      plan.state = PlanState::Failed;
    return true;
  }
  cell->square = smaller(cell->square, most);
  ++plan.index;
  return false;
}

bool limitForwardsOnce(Plan &plan, const Course & /*course*/) noexcept {
  const int32_t i = plan.index;
  if (i + 1 >= plan.count)
    return true;
  Cell *const cell = plan.cell + i;
  const double left = leftAt(cell);
  cell->up = smaller(cell->up, left);
  cell->down = smaller(cell->down, left);
  if (i > 0) {
    const double change = changeIn(plan, i);
    // The small acceleration with which a cell out of rest ends does not limit what comes after.
    if (i > 1 || !startsAtRest(plan))
      cell->up = smaller(cell->up, cell[-1].up + change);
    cell->down = smaller(cell->down, cell[-1].down + change);
  }
  ++plan.index;
  return false;
}

bool limitBackwardsOnce(Plan &plan, const Course & /*course*/) noexcept {
  const int32_t i = plan.count - 3 - plan.index;
  if (i < 0)
    return true;
  Cell *const cell = plan.cell + i;
  const double change = changeIn(plan, i + 1);
  cell->up = smaller(cell->up, cell[1].up + change);
  if (i + 2 < plan.count - 1) // nor that with which one into rest begins what comes before
    cell->down = smaller(cell->down, cell[1].down + change);
  ++plan.index;
  return false;
}

} // namespace

bool lowerBetweenCeilings(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<lowerBetweenCeilingsOnce>(plan, course, budget);
}
bool accelerate(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<accelerateOnce>(plan, course, budget);
}
bool brake(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<brakeOnce>(plan, course, budget);
}
bool limitForwards(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<limitForwardsOnce>(plan, course, budget);
}
bool limitBackwards(Plan &plan, const Course &course, int32_t &budget) noexcept {
  return repeat<limitBackwardsOnce>(plan, course, budget);
}

} // namespace stride::path
