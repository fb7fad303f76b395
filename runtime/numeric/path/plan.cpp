#include "runtime/numeric/path/plan.hpp"

#include "runtime/numeric/path/plan_cells.hpp"

namespace stride::path {
namespace {

using Pass = bool (*)(Plan &, const Course &, int32_t &budget) noexcept;

// clang-format off
constexpr Pass kPasses[] = {
    findRamp, followRamp,                                   // to a lower feed
    chooseRun, reachBackwards, addCell,                     // the cells
    lowerBetweenCeilings, accelerate, brake,                // pass 1
    limitForwards, limitBackwards, accelerate, brake,       // pass 2
    findValleys, raiseSlowly, findValleys, raiseSlowly,     // pass 3
    stackHull, lowerToHull, stackHull, lowerToHull, stackHull, lowerToHull, // pass 4
    check, slowDown,
};
// clang-format on
constexpr uint8_t kPassCount = sizeof kPasses / sizeof kPasses[0];
constexpr uint8_t kCellPass = 4;    ///< addCell, which may find that there are too few.
constexpr uint8_t kThirdRound = 20; ///< Of pass 4, which lean plans do without.
constexpr uint8_t kFirstRound = 16; ///< Of pass 4.
constexpr uint8_t kCheckPass = 22;  ///< check
constexpr int kMostCuts = 12;       ///< Of the run, if so.
constexpr int kCoarserRuns = 8;     ///< So often the same run may be tried with coarser cells.
constexpr double kFirstCut = 0.75;  ///< See Plan::cut.
constexpr double kHardCut = 0.5;    ///< The same, when coarser cells have not been enough.

/// The first Plan::cut. A lean plan has few cells, of which those at its ends are finer.
double firstCut(const PlanTask &task) noexcept {
  constexpr double kLeanCut = 0.78;
  constexpr double kFineCells = 14.0;
  return task.lean ? kLeanCut * exact::larger(1.0 - kFineCells / task.cells, 0.5) : kFirstCut;
}

void beginPasses(Plan &plan, const Course &course, double cut) noexcept {
  plan.cut = cut;
  plan.time = 0.0;
  plan.steady = 0.0;
  plan.firstStrip = stripOf(course, plan.task.way);
  plan.strip = plan.firstStrip;
  plan.count = 0;
  plan.index = 0;
  plan.phase = 0;
  plan.round = 0;
  plan.worst = 1.0;
  plan.isAlone = false;
  plan.careful = false;
}

/// Once more without the ramp, from the state that was asked for.
void beginWithoutRamp(Plan &plan, const Course &course) noexcept {
  plan.task.way = plan.from.way;
  plan.task.velocity = plan.from.velocity;
  plan.task.acceleration = plan.from.acceleration;
  plan.ramp = 0;
  plan.rampRefused = true;
  plan.cuts = 0;
  plan.state = PlanState::Working;
  beginPasses(plan, course, firstCut(plan.task));
}

/// The next Plan::cut after a run that was too long. At last less of the path than the run had,
/// also where it was all that is known or went to a stop.
double nextCut(const Plan &plan) noexcept {
  if (plan.cuts < kCoarserRuns)
    return kFirstCut * plan.cut;
  return kHardCut * exact::smaller(plan.cut, plan.time / (plan.task.cellTime * plan.task.cells));
}

/// Pass 4 from its first round on, carefully.
void repeatWithCare(Plan &plan) noexcept {
  plan.careful = true;
  plan.state = PlanState::Working;
  plan.phase = kFirstRound;
  plan.round = 0;
  plan.index = 0;
  plan.worst = 1.0;
  for (int32_t i = 0; i < plan.count; ++i)
    plan.cell[i].square = plan.cell[i].bound;
}

/// After a failure: with a shorter run, if there were too few cells, with more care, or without a
/// ramp. From rest at last without cells, which always leads to the end of the strip.
void tryAgain(Plan &plan, const Course &course) noexcept {
  if (plan.phase == kCellPass && plan.cuts < kMostCuts && !plan.task.whole) {
    plan.state = PlanState::Working;
    const double cut = nextCut(plan);
    ++plan.cuts;
    beginPasses(plan, course, cut);
  } else if (plan.phase == kCheckPass && !plan.careful && plan.worst < 1.0 + kCare) {
    repeatWithCare(plan);
  } else if (plan.ramp > 0) {
    beginWithoutRamp(plan, course);
  } else {
    (void)planFirstStrip(plan, course);
  }
}

} // namespace

void begin(Plan &plan, const Course &course, const PlanTask &task) noexcept {
  plan.task = task;
  plan.cuts = 0;
  plan.from = {task.way, task.velocity, task.acceleration, 0.0};
  plan.ramp = 0;
  plan.rampRefused = false;
  plan.state = course.first < course.next && task.way < endOf(course) ? PlanState::Working
                                                                      : PlanState::Failed;
  beginPasses(plan, course, firstCut(plan.task));
  if (plan.state == PlanState::Working)
    (void)planAlone(plan, course);
}

int32_t work(Plan &plan, const Course &course, int32_t budget) noexcept {
  while (plan.state == PlanState::Working && budget > 0) {
    if (!kPasses[plan.phase](plan, course, budget))
      break;
    if (plan.state == PlanState::Failed) {
      tryAgain(plan, course);
      continue;
    }
    plan.index = 0;
    ++plan.phase;
    if (plan.phase == kThirdRound && plan.task.lean)
      plan.phase += 2;
    if (plan.phase == kPassCount || plan.isAlone ||
        (plan.phase == kCellPass && plan.task.jerk == exact::kInfinity))
      plan.state = PlanState::Done;
  }
  return budget;
}

TimePiece pieceOf(const Plan &plan, int32_t number) noexcept {
  if (plan.isAlone || number < plan.ramp)
    return plan.closed[number];
  const int32_t index = number - plan.ramp;
  const double start = knotBefore(plan, index);
  const double length = lengthOf(plan, index);
  const bool fromRest = index == 0 && startsAtRest(plan);
  if (fromRest || index == plan.count - 1) {
    const double slope = exact::fabs(slopeAt(plan, fromRest ? 0 : index - 1));
    const double jerk = exact::sqrt(slope * slope * slope / (6.0 * length));
    return fromRest ? pieceFromRest(start, length, jerk) : pieceToRest(start, length, jerk);
  }
  const double square =
      index > 0 ? squareAtKnot(plan, index - 1) : plan.task.velocity * plan.task.velocity;
  const double before = slopeBefore(plan, index);
  return linearPiece(start, length, exact::sqrt(square), before,
                     (slopeAt(plan, index) - before) / length);
}

} // namespace stride::path
