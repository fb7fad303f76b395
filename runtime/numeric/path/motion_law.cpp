// How a plan becomes the law.
#include "runtime/numeric/path/motion_session.hpp"

namespace stride::path {
namespace {

constexpr int32_t kReservedPieces = 4; ///< Of the ring: what one step writes at most.

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

/// A trapezoid's ramp may go on over several strips.
void pushStrip(Motion &motion, int64_t strip) noexcept {
  TimePiece pieces[3];
  const int32_t count = piecesOf(motion.plan, motion.course, strip, pieces);
  for (int32_t i = 0; i < count; ++i) {
    TimePiece &ramp = motion.ramp;
    const TimePiece &piece = pieces[i];
    if (ramp.length > 0.0 && piece.acceleration == ramp.acceleration) {
      ramp = linearPiece(ramp.start, piece.start + piece.length - ramp.start, ramp.velocity,
                         ramp.acceleration, 0.0);
      continue;
    }
    pushRamp(motion);
    ramp = piece;
  }
}

} // namespace

bool write(Motion &motion) noexcept {
  const Plan &plan = motion.plan;
  if (motion.law.next - motion.law.first > kPieces - kReservedPieces)
    return false;
  bool done = false;
  if (hasJerk(motion)) {
    push(motion, pieceOf(plan, static_cast<int32_t>(motion.writing)));
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
    markAt(motion.law, motion.law.next - 1) =
        static_cast<uint8_t>(kRest | (final ? kFinal : 0) | (final && plan.gate ? kGate : 0));
    motion.session = Session::None;
  }
  return true;
}

} // namespace stride::path
