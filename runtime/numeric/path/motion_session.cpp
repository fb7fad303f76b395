// How a motion is planned while it goes on: from where, and how the plan becomes the law.
#include "runtime/numeric/path/motion_session.hpp"

#include "runtime/numeric/path/motion_times.hpp"

namespace stride::path {
namespace {

using exact::larger;
using exact::smaller;

constexpr int32_t kStepsPerCell = 24; ///< Of a plan, or a few more.
constexpr int32_t kLeanStepsPerCell = 20;
constexpr int32_t kTrapezoidSteps = 128; ///< Of a plan without cells, about.
constexpr int32_t kFirstCells = 96;      ///< Of the first plan after rest: it is to begin soon.
constexpr int32_t kCellsToStop = 75;     ///< Of a plan that only stops, about.
constexpr int32_t kUrgentCells = 128;    ///< Of a plan that is to change the motion.
constexpr int32_t kLeastCells = 48;      ///< Of a plan that goes on with the motion.
constexpr int32_t kMostTries = 24;       ///< To find a place to stop at.
/// How much longer than on a straight line a stop is tried to be at first. (A plan has a little
/// more jerk to spare for each of its cells.)
constexpr double kStopFactor = 1.04;
constexpr double kStopCells = 1.6; ///< A plan to stop has larger cells, to be there soon.
constexpr int32_t kPause = 8;      ///< Calls after a plan that came to nothing.

/// Whether the law changes ahead to other settings.
bool isChangeAhead(const Motion &motion) noexcept { return motion.law.first < motion.changed; }

/// What is planned for while the motion goes on. Other settings wait for other wishes, which come
/// at once, and for each other.
void ask(Motion &motion, bool urgent) noexcept {
  motion.asked = motion.wish;
  motion.askedLate = motion.wish.stop && !motion.atOnce;
  motion.changing = urgent && !differs(motion.wish, motion.planned) && !isChangeAhead(motion) &&
                    differs(motion.wish.settings, motion.planned.settings);
  if (!motion.changing)
    motion.asked.settings = settingsAt(motion, motion.law.first);
}

/// Up to where the motion may go by what is known now. [u]
double reachable(const Motion &motion) noexcept {
  return smaller(endOf(motion.course), motion.wish.limit);
}

/// Time until the law ends. [s]
double timeLeft(Motion &motion) noexcept {
  const TimePiece &first = pieceAt(motion.law, motion.law.first);
  return untilAt(motion.law, lastPiece(motion)) - untilAt(motion.law, motion.law.first) +
         first.duration - timeInPiece(motion);
}

const Strip &stripAtWay(const Motion &motion, double way) noexcept {
  return stripAt(motion.course, stripOf(motion.course, way));
}

/// The jerk with which the acceleration of a state ends before the velocity is the greatest one, or
/// none. [u/s^3]
double leastJerk(const WayState &state, double greatest) noexcept {
  constexpr double kMargin = 1.1;
  const double a = state.acceleration;
  const double room = a > 0.0 ? greatest - state.velocity : state.velocity;
  return a != 0.0 && room > 0.0 ? kMargin * 0.5 * a * a / room : 0.0;
}

/// The jerk to plan with. Nobody can tell an acceleration that rises within half a millisecond from
/// one that jumps, but its plan would need many cells. Strips with jerks of their own may be
/// followed by others that allow more, and the present acceleration may be from a plan that had
/// more.
double jerkAt(const Motion &motion, const WayState &state) noexcept {
  constexpr double kLeastRise = 0.0005;
  constexpr double kMore = 1e3;
  const Strip &strip = stripAtWay(motion, state.way);
  const double acceleration =
      smaller(larger(strip.acceleration, strip.deceleration), 1.0 / strip.along);
  const double velocity = exact::sqrt(squareIn(strip, motion.asked.override));
  const double most = smaller(acceleration / kLeastRise, velocity / (kLeastRise * kLeastRise));
  const double allowed = larger(most, jerkIn(strip, exact::kInfinity, motion.asked.braking));
  const double enough = strip.jerk > 0.0F ? kMore * allowed : most;
  return smaller(motion.asked.settings.jerk, larger(enough, leastJerk(state, velocity)));
}

/// Cells are a part of the time to stop, so that a plan reaches several of these times ahead: also
/// from `present`, when the feed becomes less than that. [u/s] in
double cellTimeFor(const Motion &motion, double way, double present) noexcept {
  constexpr double kPart = 1.0 / 60.0;
  constexpr double kLeanPart = 1.0 / 26.0;
  if (!hasJerk(motion))
    return kLeastCellTime;
  const Strip &strip = stripAtWay(motion, way);
  const double velocity = larger(exact::sqrt(squareIn(strip, motion.asked.override)), present);
  const double deceleration =
      smaller(smaller(strip.acceleration, strip.deceleration), 1.0 / strip.along);
  const double jerk = jerkIn(strip, motion.asked.settings.jerk);
  const double part = motion.asked.settings.lean ? kLeanPart : kPart;
  const double time = part * rampTime(velocity, deceleration, jerk);
  return smaller(larger(time, kLeastCellTime), kMostCellTime);
}

/// See PlanTask::rampPart. Where curves leave little to brake with, passes stop sooner; where they
/// do not find how, a long ramp is better than none.
constexpr double kRampPart = 0.05;
double stopRampPart(const Motion &motion) noexcept {
  constexpr int32_t kTriesOfPasses = 3;
  if (motion.byRamp)
    return 0.5;
  return motion.tries == kTriesOfPasses ? kRampPart : 1.0;
}

void beginPlan(Motion &motion, const WayState &state, double hurry) noexcept {
  PlanTask task{};
  task.way = state.way;
  task.velocity = state.velocity;
  task.acceleration = state.acceleration;
  task.jerk = hasJerk(motion) ? jerkAt(motion, state) : exact::kInfinity;
  motion.cellTime = cellTimeFor(motion, state.way, state.velocity);
  task.cellTime = motion.asked.stop ? kStopCells * motion.cellTime : motion.cellTime;
  task.share = motion.asked.settings.share;
  task.override = motion.asked.override;
  task.before = motion.planned.override;
  task.braking = motion.asked.braking;
  task.cells = motion.cells;
  task.hurry = hurry;
  task.limit = motion.asked.limit;
  task.lean = motion.asked.settings.lean;
  task.rampPart = motion.asked.stop ? stopRampPart(motion) : kRampPart;
  task.end = exact::kInfinity;
  if (motion.asked.limit < endOf(motion.course))
    task.end = motion.asked.limit;
  task.whole = motion.asked.stop;
  if (motion.asked.stop)
    task.end = smaller(task.end, state.way + motion.stopLength);
  begin(motion.plan, motion.course, task);
  motion.session = Session::Planning;
}

/// What a plan of so many cells needs, in time. [s]
double planningTime(const Motion &motion, int32_t steps, int32_t budget) noexcept {
  return motion.cycle * (2.0 + static_cast<double>(steps) / budget);
}

/// From rest at a way, after all that the law has.
void beginFromRest(Motion &motion, double way, int32_t budget) noexcept {
  motion.asked = motion.wish;
  motion.askedLate = false;
  motion.changing = false;
  if (isChangeAhead(motion))
    motion.asked.settings = motion.planned.settings;
  motion.seek = motion.law.next;
  motion.cut = 0.0;
  motion.steps = 0;
  motion.tries = 0;
  motion.urgent = false;
  motion.byRamp = false;
  motion.cells = kFirstCells;
  const double free = isAtRest(motion) ? 0.0 : timeLeft(motion);
  const double needed = planningTime(motion, kStepsPerCell * kFirstCells, budget);
  beginPlan(motion, {way, 0.0, 0.0, 0.0}, larger(needed - free, 0.0));
}

void beginSeeking(Motion &motion, bool urgent) noexcept {
  motion.urgent = urgent;
  motion.seek = motion.law.first;
  motion.passed = -timeInPiece(motion);
  motion.steps = 0;
  motion.tries = 0;
  motion.session = Session::Seeking;
}

/// How many cells what is known of the path needs, at most `most`. If there were too few for the
/// last plan, its first idea was wrong, and so would be this one.
int32_t cellsFor(const Motion &motion, int32_t most) noexcept {
  constexpr double kRamps = 40.0; // which are finer
  const Strip &strip = stripAtWay(motion, motion.way);
  const double length = exact::sqrt(squareIn(strip, motion.wish.override)) * motion.cellTime;
  const double cells = kRamps + 1.2 * (reachable(motion) - motion.way) / length;
  return cells < most && motion.plan.cuts == 0 ? static_cast<int32_t>(cells) : most;
}

/// Whether more of the path has to be planned before the motion begins to brake for the end of its
/// law; chooses with how many cells, and from where on.
bool isTimeToExtend(Motion &motion, int32_t budget) noexcept {
  const double left = timeLeft(motion);
  const double free = left - motion.tail;
  const auto leadFor = [&motion, budget](int32_t cells) {
    const int32_t perCell = motion.asked.settings.lean ? kLeanStepsPerCell : kStepsPerCell;
    const int32_t steps = hasJerk(motion) ? perCell * cells : kTrapezoidSteps;
    return 1.1 * planningTime(motion, steps, budget);
  };
  int32_t cells = motion.cells < kCells / 2 ? 2 * motion.cells : kCells;
  cells = cellsFor(motion, cells);
  const double calm = left - motion.calm;
  const bool isCalm = motion.asked.settings.lean && calm > leadFor(kLeastCells) + motion.keep;
  if (isCalm ? calm > leadFor(cells) + motion.keep + 2.0 * motion.cycle
             : free > leadFor(cells) + motion.keep + 0.3 * motion.tail)
    return false;
  if (isCalm) { // as late as can be, with as much of the path as is known then
    while (cells > kLeastCells && leadFor(cells) + motion.keep > calm)
      cells -= kLeastCells / 4;
    motion.cells = cells;
    motion.lead = larger(calm, motion.promise);
    return true;
  }
  while (cells > kLeastCells && leadFor(cells) > 0.9 * free)
    cells -= kLeastCells / 4;
  motion.cells = cells;
  motion.lead = larger(leadFor(cells), smaller(leadFor(cells) + motion.keep, 0.9 * free));
  motion.lead = larger(motion.lead, motion.promise);
  return true;
}

/// What another wish does not change. [s]
double keptBy(const Motion &motion) noexcept {
  return motion.wish.stop && motion.atOnce ? 0.0 : larger(motion.keep, motion.promise);
}

/// How far ahead passes plan for another wish. [s]
double passesLead(const Motion &motion, int32_t budget) noexcept {
  const double least =
      hasJerk(motion) ? planningTime(motion, kStepsPerCell * kCellsToStop, budget) : 0.0;
  return larger(motion.urgentLead, least);
}

/// How far ahead a ramp is planned: not at all, if this call is enough for it. [s]
double rampLead(const Motion &motion, int32_t budget) noexcept {
  constexpr int32_t kSteps = 16;
  constexpr int32_t kStepsPerStrip = 2;
  const double end = smaller(stoppingWay(motion), endOf(motion.course));
  const auto strips =
      static_cast<int32_t>(stripOf(motion.course, end) - stripOf(motion.course, motion.way));
  const int32_t steps = kSteps + kStepsPerStrip * strips;
  return steps < budget ? 0.0 : planningTime(motion, steps, budget);
}

/// Whether there is something to plan; begins it.
bool beginSession(Motion &motion, int32_t budget) noexcept {
  const Wish &wish = motion.wish;
  forgetBefore(motion.course, motion.way); // a full course could not be extended otherwise
  if (isAtRest(motion)) {
    motion.planned = wish;
    motion.changed = 0;
    if (wish.stop || !(motion.way < reachable(motion)))
      return false;
    beginFromRest(motion, motion.way, budget);
    return true;
  }
  ask(motion, true);
  const bool stops = wish.stop && motion.planned.stop;
  const bool sooner = stops && motion.atOnce && motion.stopsLate;
  if (motion.pause == 0 &&
      (sooner || (!stops && (motion.changing || differs(wish, motion.planned))))) {
    motion.cells = hasJerk(motion) ? kUrgentCells : kCells;
    motion.byRamp = wish.stop && hasJerk(motion);
    motion.lead = motion.byRamp ? rampLead(motion, budget) : passesLead(motion, budget);
    motion.lead = larger(motion.lead, keptBy(motion));
    beginSeeking(motion, true);
    return true;
  }
  if (motion.changing) // else it is the same
    ask(motion, false);
  if (motion.planned.stop)
    return false;
  const double end = endAt(motion.law, lastPiece(motion));
  if (!(end < reachable(motion)))
    return false;
  if ((markAt(motion.law, lastPiece(motion)) & kFinal) != 0) {
    if (motion.law.next - motion.law.first > kPieces / 2)
      return false;
    beginFromRest(motion, end, budget);
    return true;
  }
  if (!isTimeToExtend(motion, budget))
    return false;
  motion.byRamp = false;
  beginSeeking(motion, false);
  return true;
}

/// In what length the motion could stop on a straight line. [u]
double stoppingLength(const Motion &motion, const WayState &state, const Strip &strip) noexcept {
  const double deceleration =
      smaller(motion.asked.settings.share * decelerationIn(strip, motion.asked.braking),
              larger(1.0 - strip.across * state.velocity * state.velocity, 0.05) / strip.along);
  const double v = state.velocity;
  if (!hasJerk(motion))
    return 0.5 * v * v / deceleration;
  const double jerk = jerkIn(strip, motion.asked.settings.jerk, motion.asked.braking);
  const double a = larger(state.acceleration, 0.0);
  const double peak = v + 0.5 * a * a / jerk;
  const double time = rampTime(peak, deceleration, jerk);
  return v * a / jerk + a * a * a / (3.0 * jerk * jerk) + 0.5 * peak * time;
}

/// The piece in which the motion is to be planned anew is found, and where in it.
void takeOver(Motion &motion, double cut) noexcept {
  const TimePiece &piece = pieceAt(motion.law, motion.seek);
  motion.cut = cut;
  WayState state = stateAt(piece, cut);
  if (cut >= piece.duration) {
    state.way = endAt(motion.law, motion.seek);
    if ((markAt(motion.law, motion.seek) & kRest) != 0) {
      state = {state.way, 0.0, 0.0, 0.0};
      restAtStop(motion, state);
    }
  }
  if (motion.changing)
    state.acceleration = 0.0;
  else
    motion.asked.settings = settingsAt(motion, motion.seek);
  if (motion.asked.stop) {
    motion.stopFactor = larger(motion.stopFactor, hasJerk(motion) ? kStopFactor : 1.0);
    motion.stopLength =
        motion.stopFactor * stoppingLength(motion, state, stripAtWay(motion, state.way));
  }
  beginPlan(motion, state, 0.0);
}

/// Cuts the law off after the piece that is looked at.
void endLawHere(Motion &motion) noexcept {
  motion.law.next = motion.seek + 1;
  markAt(motion.law, motion.seek) &= static_cast<uint8_t>(~kFinal); // a gate stays one
  motion.asked.settings = settingsAt(motion, motion.seek);
  goAsAsked(motion);
  motion.session = Session::None;
}

/// The motion accelerates or brakes up to where its law ends for now: other settings have to wait.
void putOffSettings(Motion &motion) noexcept {
  motion.changing = false;
  motion.session = Session::None;
  motion.pause = kPause;
}

/// Looks at one piece, for a place without acceleration.
void seekSteady(Motion &motion) noexcept {
  const TimePiece &piece = pieceAt(motion.law, motion.seek);
  const double needed = motion.lead - motion.passed;
  if (needed < piece.duration) {
    const double time = steadyTime(motion, larger(needed, 0.0));
    if (time < exact::kInfinity) {
      takeOver(motion, time);
      return;
    }
  }
  motion.passed += piece.duration;
  if (++motion.seek == motion.law.next)
    putOffSettings(motion);
}

/// Looks at one piece.
void seek(Motion &motion) noexcept {
  if (motion.changing) {
    seekSteady(motion);
    return;
  }
  const TimePiece &piece = pieceAt(motion.law, motion.seek);
  const double needed = motion.lead - motion.passed; // from the start of this piece on
  const bool rests = (markAt(motion.law, motion.seek) & kRest) != 0;
  const bool anywhere = piece.law == PieceLaw::LinearInWay || piece.law == PieceLaw::ConstantJerk;
  if (needed < piece.duration && anywhere) {
    takeOver(motion, larger(needed, 0.0));
    return;
  }
  if (needed < piece.duration && piece.law == PieceLaw::FromRest) {
    takeOver(motion, larger(needed, 0.1 * piece.duration));
    return;
  }
  // What has been promised beyond a rest stays.
  const bool passes = needed >= piece.duration && motion.promise > 0.0 && !motion.asked.stop &&
                      motion.seek + 1 < motion.law.next;
  if ((rests && !passes) || needed < piece.duration) { // not within these pieces, but at their ends
    if (rests && motion.asked.stop)
      endLawHere(motion);
    else
      takeOver(motion, piece.duration);
    return;
  }
  motion.passed += piece.duration;
  ++motion.seek;
}

/// Time until the motion comes to where the plan takes over; negative: it has been there. [s]
double timeToCut(Motion &motion) noexcept {
  Law &law = motion.law;
  if (motion.seek >= law.next) // after all that the law has
    return exact::kInfinity;
  if (law.first > motion.seek) // unless it has come to rest where the plan begins
    return isAtRest(motion) && motion.plan.from.way == motion.way ? exact::kInfinity : -1.0;
  const auto beginOfPiece = [&law](int64_t number) {
    return untilAt(law, number) - pieceAt(law, number).duration;
  };
  return beginOfPiece(motion.seek) - beginOfPiece(law.first) + motion.cut - timeInPiece(motion);
}

/// Whether the plan has been made in time: all that it has can be written before it is needed, with
/// the steps that are left in this call, or with `budget` in each that follows.
bool isInTime(Motion &motion, int32_t budget, int32_t left) noexcept {
  const Plan &plan = motion.plan;
  const int64_t steps = hasJerk(motion) ? pieceCount(plan) : plan.lastStrip - plan.firstStrip + 1;
  const double needed =
      steps < left ? 0.0 : motion.cycle * (2.0 + static_cast<double>(steps) / budget);
  return timeToCut(motion) >= needed;
}

/// No ramp stops the motion from where it was tried, or it was found too late: from further ahead,
/// or by passes.
void stopLater(Motion &motion, int32_t budget, bool inTime) noexcept {
  constexpr double kCycles = 4.0;
  motion.lead = inTime ? motion.lead + kCycles * motion.cycle
                       : larger(1.5 * motion.lead, planningTime(motion, motion.steps, budget));
  const double least = passesLead(motion, budget);
  motion.byRamp = motion.lead < least;
  motion.lead = larger(smaller(motion.lead, least), keptBy(motion));
  ask(motion, true);
  beginSeeking(motion, true);
}

void planned(Motion &motion, int32_t budget, int32_t left) noexcept {
  const bool inTime = isInTime(motion, budget, left);
  if (motion.byRamp && !(inTime && motion.plan.state == PlanState::Done)) {
    stopLater(motion, budget, inTime);
    return;
  }
  if (!inTime) {
    if (motion.urgent)
      motion.urgentLead = larger(1.5 * motion.lead, planningTime(motion, motion.steps, budget));
    motion.session = Session::None;
    return;
  }
  if (motion.plan.state == PlanState::Done) {
    cutLaw(motion);
    return;
  }
  const PlanTask &task = motion.plan.task;
  if (motion.asked.stop && ++motion.tries < kMostTries) { // further away
    motion.stopFactor *= 1.1;
    motion.stopLength *= 1.1;
    beginPlan(motion, {task.way, task.velocity, task.acceleration, 0.0}, 0.0);
    return;
  }
  motion.refused = motion.urgent;
  motion.pause = motion.urgent ? kPause : 0;
  motion.session = Session::None;
}

/// See think.
int32_t thinkFor(Motion &motion, int32_t budget) noexcept {
  int32_t used = 0;
  if (motion.pause > 0)
    --motion.pause;
  if (isStale(motion))
    motion.session = Session::None;
  while (used < budget) {
    const int32_t before = used;
    switch (motion.session) {
    case Session::None:
      if (!beginSession(motion, budget))
        return used;
      ++used;
      break;
    case Session::Seeking:
      seek(motion);
      ++used;
      break;
    case Session::Planning:
      used = budget - work(motion.plan, motion.course, budget - used);
      if (motion.plan.state != PlanState::Working)
        planned(motion, budget, budget - used);
      break;
    case Session::Writing:
      if (!write(motion))
        return used;
      ++used;
      break;
    }
    motion.steps += used - before;
  }
  return used;
}

} // namespace

double stoppingWay(const Motion &motion) noexcept {
  if (isAtRest(motion) || motion.resting)
    return motion.way;
  const WayState state = stateAt(pieceAt(motion.law, motion.law.first), timeInPiece(motion));
  const double length = stoppingLength(motion, state, stripAtWay(motion, state.way));
  return motion.way + 1.05 * length + state.velocity * motion.lead;
}

int32_t think(Motion &motion, int32_t budget) noexcept {
  const int32_t used = thinkFor(motion, budget);
  motion.promise = larger(motion.promise, promisable(motion));
  return used;
}

} // namespace stride::path
