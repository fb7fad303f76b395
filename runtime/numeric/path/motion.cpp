#include "runtime/numeric/path/motion.hpp"

#include "runtime/numeric/path/motion_session.hpp"

namespace stride::path {
namespace {

/// How much of a piece's duration may be missing at its end, which cycles reach but for rounding.
constexpr double kRounding = 1e-13;
/// Ways beyond this one are made smaller. [u]
constexpr double kFar = 65536.0;

/// Counts cycles of one length instead of adding them up: that rounds once only.
void addTime(Motion &motion, double time) noexcept {
  if (time != motion.cycle) {
    motion.since = timeInPiece(motion);
    motion.cycle = time;
    motion.cycles = 0;
  }
  ++motion.cycles;
}

/// Whether the motion waits at rest until the law of the next run has been written.
bool waitsForLaw(const Motion &motion) noexcept {
  return isAtRest(motion) ||
         (motion.session == Session::Writing && motion.law.first >= motion.fresh &&
          !(motion.plan.task.velocity > 0.0));
}

WayState restAt(double way) noexcept { return {way, 0.0, 0.0, 0.0}; }

/// Whether the motion is at a gate already, though its last piece has some time left in which it
/// goes no further but for rounding: who waits there finds it at the gate, and lets it go on.
bool isAtGate(Motion &motion, double way) noexcept {
  Law &law = motion.law;
  return (markAt(law, law.first) & kGate) != 0 && way >= endAt(law, law.first);
}

/// Leaves the first piece of the law, `left` of whose time is over.
void leavePiece(Motion &motion, double left) noexcept {
  Law &law = motion.law;
  motion.way = endAt(law, law.first);
  motion.since = left;
  motion.cycles = 0;
  ++law.first;
}

} // namespace

void reset(Motion &motion, const MotionSettings &settings) noexcept {
  motion = Motion{};
  motion.wish = {1.0, exact::kInfinity, {}, false, settings};
  motion.planned = motion.wish;
  motion.asked = motion.wish;
  motion.plan.state = PlanState::Idle;
  motion.cellTime = kLeastCellTime;
  motion.calm = exact::kInfinity;
}

bool extend(Motion &motion, const Strip &strip) noexcept {
  // A strip that is being planned with stays as it is, and one that the law goes over: it would be
  // too fast for what is added.
  const bool planned = motion.session == Session::Planning || motion.session == Session::Writing;
  const int64_t last = motion.course.next - 1;
  const bool driven = motion.course.first < motion.course.next && !isAtRest(motion) &&
                      endAt(motion.law, lastPiece(motion)) > beginOf(motion.course, last);
  const bool isFixed = driven || (planned && last <= motion.plan.lastStrip);
  // More, and cells take limits of places that they do not touch; less, and a course of dense
  // curves ends before the next plan is ready.
  constexpr double kPartOfCell = 0.75;
  return append(motion.course, strip, isFixed ? 0.0 : kPartOfCell * motion.cellTime);
}

WayState move(Motion &motion, double time, bool pass) noexcept {
  Law &law = motion.law;
  motion.promise = exact::larger(motion.promise - time, 0.0);
  if (motion.gate || waitsForLaw(motion) || (motion.resting && !pass)) {
    motion.promise = 0.0;
    return restAt(motion.way);
  }
  motion.resting = false;
  addTime(motion, time);
  for (;;) {
    const TimePiece &piece = pieceAt(law, law.first);
    const double t = timeInPiece(motion);
    const bool within = t < piece.duration * (1.0 - kRounding);
    WayState state = within ? stateAt(piece, t) : WayState{};
    state.way = exact::smaller(state.way, endAt(law, law.first)); // but for rounding
    state.way = exact::larger(state.way, motion.way);
    if (within && !isAtGate(motion, state.way)) {
      motion.way = state.way;
      motion.resting = motion.resting && !(t > 0.0); // it has gone on within this time
      return state;
    }
    const uint8_t mark = markAt(law, law.first);
    leavePiece(motion, exact::larger(t - piece.duration, 0.0));
    motion.resting = (mark & kFinal) != 0;
    motion.gate = (mark & kGate) != 0;
    if (motion.gate || waitsForLaw(motion) || (motion.resting && !pass)) {
      motion.since = 0.0;
      break;
    }
  }
  return restAt(motion.way);
}

void comeByRounding(Motion &motion) noexcept {
  if (!isAtRest(motion) || motion.wish.stop)
    return;
  const Strip *const strip = endedByRounding(motion.course, motion.way);
  if (strip == nullptr)
    return;
  motion.way = strip->end;
  motion.resting = strip->stop;
  motion.gate = strip->gate;
}

void freeze(Motion &motion) noexcept {
  motion.law.next = motion.law.first;
  motion.since = 0.0;
  motion.cycles = 0;
  motion.promise = 0.0;
  motion.session = Session::None;
}

double rebase(Motion &motion) noexcept {
  if (motion.way < kFar || motion.session != Session::None)
    return 0.0;
  const double by = exact::floor(motion.way / kFar) * kFar; // differences with it are exact
  forgetBefore(motion.course, motion.way);
  motion.course.begin -= by;
  for (int64_t k = motion.course.first; k < motion.course.next; ++k)
    stripAt(motion.course, k).end -= by;
  for (int64_t k = motion.law.first; k < motion.law.next; ++k) {
    pieceAt(motion.law, k).start -= by;
    endAt(motion.law, k) -= by;
  }
  motion.way -= by;
  motion.wish.limit -= by;
  motion.planned.limit -= by;
  return by;
}

} // namespace stride::path
