// The law of one run along a path, from a state to rest: as fast as the limits of its strips allow,
// with a limited tangential jerk. The plan is made in small steps, so that a cycle never has to
// wait for it.
//
// The run is cut into cells of about equal time. The square of the velocity over the way, b(s), is
// a quadratic spline: its control points are the values `square` at the cells' middles, so that b
// stays within the hull of its neighbours, and the acceleration, half of its slope, is linear over
// the way in each cell (a TimePiece). What limits velocity, acceleration and jerk become limits of
// the control polygon's values, slopes, and differences of slopes. Passes over the cells:
//  1. the greatest b that both kinds of acceleration allow, forwards and backwards;
//  2. the same with accelerations that never change more quickly than the jerk allows;
//  3. where the acceleration would jump up: a curve with the greatest jerk, from the lowest places
//  on;
//  4. where it would jump down: the greatest function below whose slope falls slowly enough, which
//     is a convex hull after a transformation. That is done several times, since what the jerk
//     allows depends on the velocities. Lean plans do it once less, from better velocities.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_PLAN_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_PLAN_HPP

#include "runtime/numeric/path/course.hpp"
#include "runtime/numeric/path/time_piece.hpp"

namespace stride::path {

inline constexpr int32_t kCells = 384;

/// What is asked for.
struct PlanTask {
  double way;          ///< Where the run begins. [u]
  double velocity;     ///< There; 0: from rest. [u/s]
  double acceleration; ///< There; 0 at rest. [u/s^2]
  double end;          ///< Where it rests; kInfinity: at the next stop, or where it is unknown. [u]
  double jerk;         ///< > 0; kInfinity: trapezoids, without cells. [u/s^3]
  double cellTime;     ///< [s]
  double share;        ///< Without a limit of the jerk: of strips' accelerations.
  double override;     ///< Factor of feeds.
  double before;       ///< That of the law it takes over from, which may begin above `override`.
  double hurry;        ///< How long the motion would stand still for a plan with many cells. [s]
  Braking braking;     ///< To stop: besides what strips say.
  double limit;        ///< It goes no further than this way, also to stop; kInfinity: none. [u]
  double rampPart;     ///< Which part of the axes' acceleration curves must leave for a ramp in
                       ///< closed form; 1: no ramp; less, and a stop is nothing but a ramp.
  int32_t cells;       ///< How many may be used, up to kCells.
  bool whole;          ///< The run must reach `end`, however many cells that takes.
  bool lean;           ///< See MotionSettings.
};

/// A part of the run. What belongs to a knot is that of the one at the cell's end.
struct Cell {
  double end;     ///< Way of the knot. [u]
  double middle;  ///< Way of the control point; of a cell next to rest, where b's tangent is 0. [u]
  double ceiling; ///< Of b. [u^2/s^2]
  double curve;   ///< Of b, while it slows down from another override. [u^2/s^2]
  double along;   ///< See Strip. [s^2/u]
  double across;  ///< See Strip. [s^2/u^2]
  double acceleration; ///< Tangential. [u/s^2]
  double deceleration; ///< Tangential. [u/s^2]
  double jerk;         ///< Tangential. [u/s^3]
  double square;       ///< b at `middle`. [u^2/s^2]
  double up;           ///< Greatest acceleration at the knot. [u/s^2]
  double down;         ///< Greatest deceleration at the knot. [u/s^2]
  double bound;        ///< Pass 4: what b stays below. [u^2/s^2]
  double change;       ///< Pass 4: how far b's slope can fall within the cell. [u/s^2]
  double lift;         ///< Pass 4: what is added before the hull is taken. [u^2/s^2]
};

enum class PlanState : uint8_t {
  Idle,
  Working,
  Done,
  Failed, ///< There is no such motion, from this state; or none was found.
};

/// A plan and all that is needed to make it. Trivially copyable.
struct Plan {
  PlanTask task;       ///< After a ramp: from its end on.
  WayState from;       ///< Where the plan begins.
  double rampSquare;   ///< The ramp: b at its end, as far as it is known. [u^2/s^2]
  double rampMost;     ///< How hard it may brake, likewise. [u/s^2]
  double rampJerk;     ///< The least one of the strips that it goes over, likewise. [u/s^3]
  double rampPeak;     ///< How hard it brakes. [u/s^2]
  double rampHere;     ///< Its velocity where the present strip begins, likewise. [u/s]
  double rampEnd;      ///< Way at its end. [u]
  double rampVelocity; ///< There. [u/s]
  Cell cell[kCells];
  TimePiece closed[7];   ///< In closed form: a run along one strip from rest to rest, which needs
                         ///< no cells; or the ramp before them.
  double reach[kStrips]; ///< A first idea of b at the ends of strips, by number. [u^2/s^2]
  int64_t firstStrip;    ///< Of the run.
  int64_t lastStrip;
  double end;        ///< Way where it comes to rest. [u]
  double cut;        ///< Part of what the cells can hold for which the run is chosen.
  double time;       ///< That counts for the cells of the run, by a first idea. [s]
  double steady;     ///< The part of it since the velocity has been constant. [s]
  double endRest;    ///< Length of the last cell. [u]
  double endStep;    ///< Length of the one before. [u]
  double knot;       ///< Way up to where there are cells. [u]
  double step;       ///< Length of the last one. [u]
  double curveSlope; ///< Pass 3: of the curve that is being drawn. [u/s^2]
  double otherSlope; ///< Pass 3: of its other half, which comes next; pass 4: of a line, while the
                     ///< hull is stacked of its last one. [u/s^2]
  double height;     ///< Pass 4: between the line and the curve. [u^2/s^2]
  double worst;      ///< By how much a limit is exceeded, at most; 1: by nothing.
  int64_t strip;     ///< Present one.
  int32_t count;     ///< Of cells.
  int32_t ramp;      ///< Of pieces before the cells.
  int32_t index;     ///< Present cell.
  int32_t valley;    ///< Pass 3: where the present curve began.
  int32_t stacked;   ///< Valleys that wait; control points of the hull.
  int16_t stack[kCells]; ///< Their cells: a heap, lowest first; a stack.
  uint8_t phase;
  uint8_t cuts;   ///< How often the run was too long for the cells.
  uint8_t round;  ///< Pass 4 is made several times.
  int8_t heading; ///< Pass 3: 1 forwards, -1 backwards, 0: the next valley.
  PlanState state;
  bool isAlone;     ///< It is all in closed form; `count` is the number of its pieces.
  bool rampRefused; ///< There is no ramp, or no plan with it.
  bool stops;       ///< At its end is a stop of the path, or the end that was asked for.
  bool coarse;      ///< The run only brakes for an open end: see kCoarse.
  bool slowing;     ///< What is reached at first is above the ceilings.
  bool gate;        ///< See Strip.
  bool careful;     ///< Pass 4 is made once more, with less than the jerk: it exceeded a limit by
                    ///< little, since it takes what the jerk allows from the velocities before it.
};

/// Begins a plan over the strips that `course` has now. Nothing of `course` that lies ahead may be
/// taken away until it is ready.
void begin(Plan &plan, const Course &course, const PlanTask &task) noexcept;

/// Goes on with it, for at most `budget` steps; what is left of them. A step looks at one cell, or
/// one strip, in one pass.
int32_t work(Plan &plan, const Course &course, int32_t budget) noexcept;

/// How many pieces a plan has that is done, if its jerk is limited.
inline int32_t pieceCount(const Plan &plan) noexcept { return plan.ramp + plan.count; }

/// Piece `index` of it, 0 <= index < pieceCount.
TimePiece pieceOf(const Plan &plan, int32_t index) noexcept;

/// The pieces of one strip of a plan that is done, if its jerk is not limited, firstStrip <= strip
/// <= lastStrip: up to three, accelerating, steady and braking. How many.
int32_t piecesOf(const Plan &plan, const Course &course, int64_t strip,
                 TimePiece (&pieces)[3]) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_PLAN_HPP
