#include "runtime/numeric/path/motion_handover.hpp"

#include "runtime/numeric/path/motion_session.hpp"

namespace stride::path {
namespace {

/// Whether two pieces are the same but for how long they are.
bool beginAlike(const TimePiece &a, const TimePiece &b) noexcept {
  return a.law == b.law && a.start == b.start && a.velocity == b.velocity &&
         a.acceleration == b.acceleration && a.gradient == b.gradient;
}

bool isSame(const Law &a, const Law &b, int64_t piece) noexcept {
  return beginAlike(pieceAt(a, piece), pieceAt(b, piece)) &&
         pieceAt(a, piece).duration == pieceAt(b, piece).duration &&
         markAt(a, piece) == markAt(b, piece);
}

void copyStrips(const Course &from, int64_t first, Course &to) noexcept {
  for (int64_t k = first > from.first ? first : from.first; k < from.next; ++k)
    stripAt(to, k) = stripAt(from, k);
  to.first = from.first;
  to.next = from.next;
  to.begin = from.begin;
}

void copyPieces(const Law &from, int64_t first, Law &to) noexcept {
  for (int64_t k = first; k < from.next; ++k) {
    const auto at = static_cast<uint64_t>(k) % kPieces;
    to.piece[at] = from.piece[at];
    to.until[at] = from.until[at];
    to.end[at] = from.end[at];
    to.mark[at] = from.mark[at];
  }
  to.next = from.next;
}

} // namespace

LawPlace placeIn(const Motion &motion) noexcept {
  return {motion.law.first, isAtRest(motion) ? 0.0 : timeInPiece(motion)};
}

bool findChange(const PlannedPath &known, const Motion &motion, int64_t first,
                LawPlace &cut) noexcept {
  const Law &before = known.law;
  const Law &after = motion.law;
  const int64_t both = before.next < after.next ? before.next : after.next;
  int64_t piece = first;
  while (piece < both && isSame(before, after, piece))
    ++piece;
  if (piece >= both) {
    cut = {both, 0.0};
    return before.next != after.next;
  }
  const TimePiece &old = pieceAt(before, piece);
  const TimePiece &own = pieceAt(after, piece);
  cut = {piece, beginAlike(old, own) ? exact::smaller(old.duration, own.duration) : 0.0};
  return true;
}

void handOver(const Motion &motion, int64_t fromStrip, int64_t fromPiece,
              PlannedPath &path) noexcept {
  copyStrips(motion.course, fromStrip, path.course);
  copyPieces(motion.law, fromPiece, path.law);
  path.planned = motion.planned;
  path.tail = motion.tail;
  path.calm = motion.calm;
  path.cellTime = motion.cellTime;
  path.promise = motion.promise;
  path.cells = motion.cells;
  path.stopsLate = motion.stopsLate;
}

void takeOver(Motion &motion, const PlannedPath &path, int64_t fromStrip,
              int64_t fromPiece) noexcept {
  copyStrips(path.course, fromStrip, motion.course);
  copyPieces(path.law, fromPiece, motion.law);
  motion.planned = path.planned;
  motion.tail = path.tail;
  motion.calm = path.calm;
  motion.cellTime = path.cellTime;
  motion.cells = path.cells;
  motion.stopsLate = path.stopsLate;
}

} // namespace stride::path
