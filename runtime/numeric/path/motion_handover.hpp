// A motion that one task plans and another one goes along: what both of them know of it, and from
// where on a plan of the one changes what the other one goes along. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_MOTION_HANDOVER_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_MOTION_HANDOVER_HPP

#include "runtime/numeric/path/motion.hpp"

namespace stride::path {

/// A place of a law.
struct LawPlace {
  int64_t piece; ///< Number of a piece.
  double time;   ///< Since it began. [s]
};

/// The path and its law as they are handed over. Of the rings what is ahead is right, of the law
/// not where it begins. Trivially copyable.
struct PlannedPath {
  Course course;
  Law law;
  Wish planned;    ///< See Motion, as all of these.
  double tail;     ///< [s]
  double calm;     ///< [s]
  double cellTime; ///< [s]
  double promise;  ///< [s]
  int32_t cells;
  bool stopsLate;
};

/// Where the motion is in its law.
LawPlace placeIn(const Motion &motion) noexcept;

/// Whether a motion that is at `place` has not passed `cut`.
inline bool isBefore(const LawPlace &place, const LawPlace &cut) noexcept {
  return place.piece < cut.piece || (place.piece == cut.piece && place.time <= cut.time);
}

/// Whether the law of a motion is another one than what has been handed over, from the piece
/// `first` on, and from where on it is.
bool findChange(const PlannedPath &known, const Motion &motion, int64_t first,
                LawPlace &cut) noexcept;

/// Hands over a motion: its path from the last strip on that is known, its law from a piece on.
/// Nothing may be being written of that.
void handOver(const Motion &motion, int64_t fromStrip, int64_t fromPiece,
              PlannedPath &path) noexcept;

/// The motion goes on along what has been handed over, from a piece on that it has not left.
void takeOver(Motion &motion, const PlannedPath &path, int64_t fromStrip,
              int64_t fromPiece) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_MOTION_HANDOVER_HPP
