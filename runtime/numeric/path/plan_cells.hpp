// For the sources of the planner: what they ask a plan's cells.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_PLAN_CELLS_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_PLAN_CELLS_HPP

#include "runtime/numeric/path/plan.hpp"

namespace stride::path {

/// Which part of the jerk a careful plan does without in pass 4.
inline constexpr double kCare = 0.002;

inline bool startsAtRest(const Plan &plan) noexcept { return !(plan.task.velocity > 0.0); }

// By the cell before a knot; the next one comes after it. Indices would be added up anew for each
// of their members.

/// Between the control points before and after a knot. [u]
inline double spanAt(const Cell *cell) noexcept { return cell[1].middle - cell[0].middle; }

/// The acceleration there. [u/s^2]
inline double slopeAt(const Cell *cell) noexcept {
  return (cell[1].square - cell[0].square) / (2.0 * spanAt(cell));
}

/// b there. [u^2/s^2]
inline double squareAtKnot(const Cell *cell) noexcept {
  const double part = (cell->end - cell->middle) / spanAt(cell);
  return cell->square + (cell[1].square - cell->square) * part;
}

// The same at knot `i`.
inline double spanAt(const Plan &plan, int32_t i) noexcept { return spanAt(plan.cell + i); }
inline double slopeAt(const Plan &plan, int32_t i) noexcept { return slopeAt(plan.cell + i); }
inline double squareAtKnot(const Plan &plan, int32_t i) noexcept {
  return squareAtKnot(plan.cell + i);
}

/// The acceleration at the start of cell `i`. [u/s^2]
inline double slopeBefore(const Plan &plan, int32_t i) noexcept {
  return i > 0 ? slopeAt(plan.cell + i - 1) : plan.task.acceleration;
}

inline double knotBefore(const Plan &plan, int32_t i) noexcept {
  return i > 0 ? (plan.cell + i - 1)->end : plan.task.way;
}
inline double lengthOf(const Plan &plan, int32_t i) noexcept {
  return (plan.cell + i)->end - knotBefore(plan, i);
}

/// The greatest velocity within a cell that is not next to rest, or a little more. [u/s]
inline double greatestIn(const Plan &plan, int32_t i) noexcept {
  const Cell *const cell = plan.cell + i;
  const double before = i > 0 ? squareAtKnot(cell - 1) : plan.task.velocity * plan.task.velocity;
  return exact::sqrt(exact::larger(cell->square, exact::larger(before, squareAtKnot(cell))));
}

/// How far the acceleration can change within a cell that is not next to rest. [u/s^2]
inline double changeIn(const Plan &plan, int32_t i) noexcept {
  return (plan.cell + i)->jerk * lengthOf(plan, i) / greatestIn(plan, i);
}

/// The acceleration at the end of the way x out of rest, with constant jerk. [u/s^2]
double accelerationFromRest(double jerk, double x) noexcept;

/// The override that the present velocity is of, in the strip where the plan begins.
double presentOverride(const Plan &plan, const Course &course) noexcept;

/// What of a strip's accelerations the first idea makes use of; of a trapezoid, the plan: what a
/// curve leaves where it is gone over with the greatest velocity. [u/s^2]
double usableAcceleration(const Plan &plan, const Strip &strip) noexcept;
double usableDeceleration(const Plan &plan, const Strip &strip) noexcept;

/// The first idea of a place.
struct Idea {
  double square;       ///< b there. [u^2/s^2]
  double most;         ///< The greatest b of its strip. [u^2/s^2]
  double acceleration; ///< Usable. [u/s^2]
  double deceleration; ///< Usable. [u/s^2]
  double jerk;         ///< Of its strip. [u/s^3]
};
Idea ideaAt(const Plan &plan, const Course &course, int64_t strip, double way) noexcept;

/// Whether the limits of a strip and of the next one differ by no more than what a cell over both
/// may give away.
bool areAlike(const Strip &a, const Strip &b, double override) noexcept;

/// b at the end of a strip as the first idea has it. [u^2/s^2]
double reachAtBorder(const Plan &plan, int64_t strip) noexcept;

/// Up to where in a strip the first idea has the greatest velocity of it, if it has it at all. [u]
double steadyUntil(const Plan &plan, const Course &course, int64_t strip) noexcept;

/// Whether the run is one strip from rest to rest without a curve; plans it then, in closed form.
bool planAlone(Plan &plan, const Course &course) noexcept;

/// From rest, up to the end of the first strip or the run's, in closed form, whatever the strip is;
/// half of what axes allow where it bends. False: from no rest, or without a limit of the jerk.
bool planFirstStrip(Plan &plan, const Course &course) noexcept;

/// Steps of a pass, for at most `budget` of them, which become less. A step says whether the pass
/// is done. True: it is, or the plan has failed.
template <bool (*kStep)(Plan &, const Course &) noexcept>
bool repeat(Plan &plan, const Course &course, int32_t &budget) noexcept {
  while (budget > 0) {
    --budget;
    if (kStep(plan, course) || plan.state == PlanState::Failed)
      return true;
  }
  return false;
}

// The passes.
bool findRamp(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool followRamp(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool chooseRun(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool reachBackwards(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool addCell(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool lowerBetweenCeilings(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool accelerate(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool brake(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool limitForwards(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool limitBackwards(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool findValleys(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool raiseSlowly(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool stackHull(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool lowerToHull(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool check(Plan &plan, const Course &course, int32_t &budget) noexcept;
bool slowDown(Plan &plan, const Course &course, int32_t &budget) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_PLAN_CELLS_HPP
