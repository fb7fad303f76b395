// The law: where it has no acceleration, and how a plan becomes it.
#include "runtime/numeric/path/motion_session.hpp"

namespace stride::path {
namespace {

constexpr int32_t kReservedPieces = 4; ///< Of the ring: what one step writes at most.

bool differs(const Braking &a, const Braking &b) noexcept {
  return a.deceleration != b.deceleration || a.jerk != b.jerk ||
         a.accelerationPart != b.accelerationPart || a.jerkPart != b.jerkPart;
}

/// Whether a plan that begins with a piece has room: the motion does not brake, nor does its
/// acceleration fall, so that it has not yet begun to heed what comes next.
bool isCalm(const TimePiece &piece) noexcept {
  return piece.law == PieceLaw::LinearInWay && piece.acceleration >= 0.0 && piece.gradient >= 0.0;
}

void push(Motion &motion, const TimePiece &piece) noexcept {
  Law &law = motion.law;
  const bool empty = law.first == law.next;
  if (empty) {
    motion.since = 0.0;
    motion.cycles = 0;
  }
  const double before = empty ? 0.0 : untilAt(law, law.next - 1);
  pieceAt(law, law.next) = piece;
  untilAt(law, law.next) = before + piece.duration;
  endAt(law, law.next) = piece.start + piece.length;
  markAt(law, law.next) = 0;
  ++law.next;
  const bool brakes = piece.acceleration < 0.0 || piece.law == PieceLaw::ToRest ||
                      (piece.law == PieceLaw::ConstantJerk && piece.gradient < 0.0);
  motion.tail = brakes ? motion.tail + piece.duration : 0.0;
  motion.calm = isCalm(piece) ? piece.duration : motion.calm + piece.duration;
}

/// Writes what has been put off.
void pushRamp(Motion &motion) noexcept {
  TimePiece &ramp = motion.ramp;
  if (!(ramp.length > 0.0))
    return;
  const bool sigmoid = motion.asked.settings.kind == LawKind::Sigmoid && ramp.acceleration != 0.0;
  push(motion, sigmoid ? sineSquaredPiece(ramp.start, ramp.length, ramp.velocity, ramp.acceleration)
                       : ramp);
  ramp.length = 0.0;
}

/// What is free above a ramp at the border before a strip. [u^2/s^2]
double roomAt(const Motion &motion, int64_t strip, double velocity) noexcept {
  const double override = motion.asked.override;
  const Strip &before = stripAt(motion.course, strip - 1);
  const double most = exact::smaller(squareAtEnd(before, override),
                                     squareIn(stripAt(motion.course, strip), override));
  return most - velocity * velocity;
}

/// Whether a ramp may go on with a piece of a strip. By a sine it is quicker on the way than by a
/// trapezoid: the square of the velocity is greater by up to a fifth of how much that changes.
bool goesOn(Motion &motion, const TimePiece &piece, int64_t strip) noexcept {
  constexpr double kMore = 0.21;
  const TimePiece &ramp = motion.ramp;
  if (!(ramp.length > 0.0) || piece.acceleration != ramp.acceleration)
    return false;
  if (motion.asked.settings.kind != LawKind::Sigmoid || strip == motion.plan.firstStrip)
    return true;
  motion.rampRoom = exact::smaller(motion.rampRoom, roomAt(motion, strip, piece.velocity));
  const double length = piece.start + piece.length - ramp.start;
  return kMore * 2.0 * exact::fabs(ramp.acceleration) * length <= motion.rampRoom;
}

/// A trapezoid's ramp may go on over several strips.
void pushStrip(Motion &motion, int64_t strip) noexcept {
  TimePiece pieces[3];
  const int32_t count = piecesOf(motion.plan, motion.course, strip, pieces);
  for (int32_t i = 0; i < count; ++i) {
    TimePiece &ramp = motion.ramp;
    const TimePiece &piece = pieces[i];
    if (goesOn(motion, piece, strip)) {
      ramp = linearPiece(ramp.start, piece.start + piece.length - ramp.start, ramp.velocity,
                         ramp.acceleration, 0.0);
      continue;
    }
    pushRamp(motion);
    ramp = piece;
    motion.rampRoom = exact::kInfinity;
  }
}

} // namespace

bool differs(const Wish &a, const Wish &b) noexcept {
  return a.override != b.override || a.limit != b.limit || differs(a.braking, b.braking) ||
         a.stop != b.stop;
}

bool differs(const MotionSettings &a, const MotionSettings &b) noexcept {
  return a.kind != b.kind || a.jerk != b.jerk || a.share != b.share || a.lean != b.lean;
}

bool isStale(const Motion &motion) noexcept {
  if (motion.session != Session::Seeking && motion.session != Session::Planning)
    return false;
  if (motion.changing || !(motion.urgent || motion.refused))
    return differs(motion.wish, motion.asked);
  Wish wish = motion.wish;
  wish.override = motion.asked.override;
  return differs(wish, motion.asked);
}

void goAsAsked(Motion &motion) noexcept {
  const int64_t last = lastPiece(motion);
  const MotionSettings before = settingsAt(motion, last);
  if (differs(motion.asked.settings, before)) {
    motion.former = before;
    motion.changed = motion.law.next;
  } else if (last < motion.changed) {
    motion.changed = 0; // the change is cut off
  }
  motion.planned = motion.asked;
  motion.stopsLate = motion.askedLate;
}

double steadyTime(const Motion &motion, double from) noexcept {
  const TimePiece &piece = pieceAt(motion.law, motion.seek);
  const double first = piece.acceleration;
  if (piece.law == PieceLaw::LinearInWay) {
    const double last = first + piece.gradient * piece.length;
    if (first == 0.0 && last == 0.0)
      return from;
    const double time =
        first * last < 0.0 ? timeAt(piece, piece.start - first / piece.gradient) : -1.0;
    if (time >= from)
      return time;
  }
  if (piece.law == PieceLaw::ConstantJerk && first * piece.gradient < 0.0) {
    const double time = -first / piece.gradient;
    if (time >= from && time < piece.duration)
      return time;
  }
  const uint8_t mark = markAt(motion.law, motion.seek);
  bool ends = (mark & kFinal) != 0;
  if ((mark & kRest) == 0) {
    const WayState before = stateAt(piece, piece.duration);
    const WayState after = stateAt(pieceAt(motion.law, motion.seek + 1), 0.0);
    ends = before.acceleration * after.acceleration <= 0.0;
  }
  if (ends)
    return piece.duration;
  return exact::kInfinity;
}

void restAtStop(Motion &motion, WayState &state) noexcept {
  constexpr uint8_t kAtStop = kFinal | kGate;
  const Strip *const strip = endedByRounding(motion.course, state.way);
  if (strip == nullptr || !strip->stop || (markAt(motion.law, motion.seek) & kAtStop) != 0)
    return;
  // A strip that is as short as rounding has not been gone over.
  if (!(beginOf(motion.course, stripOf(motion.course, state.way)) < state.way))
    return;
  state.way = endAt(motion.law, motion.seek) = strip->end;
  markAt(motion.law, motion.seek) |= static_cast<uint8_t>(kFinal | (strip->gate ? kGate : 0));
}

void cutLaw(Motion &motion) noexcept {
  Law &law = motion.law;
  if (motion.seek < law.next) {
    TimePiece &piece = pieceAt(law, motion.seek);
    if (motion.cut < piece.duration) {
      untilAt(law, motion.seek) -= piece.duration - motion.cut;
      piece.length = motion.plan.from.way - piece.start;
      endAt(law, motion.seek) = motion.plan.from.way;
      piece.duration = motion.cut;
    }
    const bool rests = !(motion.plan.from.velocity > 0.0);
    if (!rests)
      markAt(law, motion.seek) = 0;
    law.next = motion.seek + 1;
  }
  motion.fresh = motion.law.next;
  goAsAsked(motion);
  motion.urgentLead = 0.0;
  motion.stopFactor = 0.0;
  motion.refused = false;
  motion.tail = 0.0;
  motion.calm = exact::kInfinity;
  motion.ramp.length = 0.0;
  if (motion.asked.stop && !motion.askedLate)
    motion.promise = 0.0;
  motion.writing = hasJerk(motion) ? 0 : motion.plan.firstStrip;
  motion.session = Session::Writing;
}

bool write(Motion &motion) noexcept {
  const Plan &plan = motion.plan;
  if (motion.law.next - motion.law.first > kPieces - kReservedPieces)
    return false;
  bool done = false;
  if (hasJerk(motion)) {
    push(motion, pieceOf(plan, static_cast<int32_t>(motion.writing)));
    double &end = endAt(motion.law, lastPiece(motion));
    end = exact::smaller(end, plan.end); // ways of pieces are added up, and rounded
    done = ++motion.writing == pieceCount(plan);
  } else {
    pushStrip(motion, motion.writing);
    done = motion.writing++ == plan.lastStrip;
    if (done)
      pushRamp(motion);
  }
  if (done) {
    endAt(motion.law, lastPiece(motion)) = plan.end;
    const bool final = plan.stops && plan.task.end == exact::kInfinity;
    // A plan without a way has no piece, and ends where the law did: a gate stays one.
    const bool gate = plan.gate || (motion.law.next == motion.fresh &&
                                    (markAt(motion.law, lastPiece(motion)) & kGate) != 0);
    markAt(motion.law, lastPiece(motion)) =
        static_cast<uint8_t>(kRest | (final ? kFinal : 0) | (gate ? kGate : 0));
    motion.session = Session::None;
  }
  return true;
}

} // namespace stride::path
