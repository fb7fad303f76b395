#include "runtime/numeric/path/motion_times.hpp"

#include "runtime/numeric/path/motion_session.hpp"

namespace stride::path {
namespace {

using exact::kInfinity;
using exact::larger;
using exact::smaller;

double untilAt(const Law &law, int64_t number) noexcept {
  return law.until[static_cast<uint64_t>(number) % kPieces];
}

double endAt(const Law &law, int64_t number) noexcept {
  return law.end[static_cast<uint64_t>(number) % kPieces];
}

/// From now until a piece begins. [s]
double timeToPiece(const Motion &motion, int64_t number) noexcept {
  const Law &law = motion.law;
  const double first = untilAt(law, law.first) - pieceAt(law, law.first).duration;
  return untilAt(law, number) - pieceAt(law, number).duration - first - timeInPiece(motion);
}

/// Whether pieces that are written go beyond those with which the law ended: they are not to be
/// relied on before all of them are there.
int64_t writtenEnd(const Motion &motion) noexcept {
  return motion.session == Session::Writing ? motion.fresh : motion.law.next;
}

} // namespace

double timeTo(const Motion &motion, double way) noexcept {
  const Law &law = motion.law;
  if (motion.gate)
    return kInfinity;
  if (way <= motion.way)
    return 0.0;
  int64_t low = law.first; // the first piece that ends at or beyond the way
  int64_t high = law.next;
  while (low < high) {
    const int64_t middle = low + (high - low) / 2;
    if (endAt(law, middle) < way)
      low = middle + 1;
    else
      high = middle;
  }
  constexpr double kRounding = 1e-12; // of ways that are added up in another order
  if (low == law.next && low > law.first &&
      way - endAt(law, low - 1) <= kRounding * larger(1.0, way))
    --low;
  if (low == law.next)
    return kInfinity;
  for (int64_t k = law.first; k < low; ++k)
    if ((markAt(law, k) & kGate) != 0)
      return kInfinity;
  const TimePiece &piece = pieceAt(law, low);
  const double inside = smaller(larger(way, piece.start), piece.start + piece.length);
  return larger(timeToPiece(motion, low) + timeAt(piece, inside), 0.0);
}

double promisable(const Motion &motion) noexcept {
  constexpr double kPart = 0.9; // see isTimeToExtend
  const Law &law = motion.law;
  const int64_t end = writtenEnd(motion);
  if (motion.gate || end <= law.first)
    return 0.0;
  const int64_t last = end - 1;
  const double left = timeToPiece(motion, last) + pieceAt(law, last).duration;
  if (motion.session == Session::Planning && motion.seek < law.next)
    return smaller(motion.keep, timeToPiece(motion, motion.seek) + motion.cut);
  if (motion.session == Session::Writing || (markAt(law, last) & kFinal) != 0)
    return smaller(motion.keep, left);
  return smaller(motion.keep, kPart * (left - motion.tail));
}

NextRest nextRest(const Motion &motion) noexcept {
  const Law &law = motion.law;
  for (int64_t k = law.first; k < writtenEnd(motion); ++k)
    if ((markAt(law, k) & (kFinal | kGate)) != 0)
      return {timeToPiece(motion, k) + pieceAt(law, k).duration, endAt(law, k)};
  return {kInfinity, motion.way};
}

} // namespace stride::path
