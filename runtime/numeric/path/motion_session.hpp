// For the sources of motion.hpp: the ring of pieces, and how a plan becomes it.
#ifndef STRIDE_RUNTIME_NUMERIC_PATH_MOTION_SESSION_HPP
#define STRIDE_RUNTIME_NUMERIC_PATH_MOTION_SESSION_HPP

#include "runtime/numeric/path/motion.hpp"

namespace stride::path {

/// Limits of Motion::cellTime. [s]
inline constexpr double kLeastCellTime = 0.002;
inline constexpr double kMostCellTime = 0.05;

inline TimePiece &pieceAt(Law &law, int64_t number) noexcept {
  return law.piece[static_cast<uint64_t>(number) % kPieces];
}
inline const TimePiece &pieceAt(const Law &law, int64_t number) noexcept {
  return law.piece[static_cast<uint64_t>(number) % kPieces];
}
inline uint8_t &markAt(Law &law, int64_t number) noexcept {
  return law.mark[static_cast<uint64_t>(number) % kPieces];
}
inline uint8_t markAt(const Law &law, int64_t number) noexcept {
  return law.mark[static_cast<uint64_t>(number) % kPieces];
}

inline double &untilAt(Law &law, int64_t number) noexcept {
  return law.until[static_cast<uint64_t>(number) % kPieces];
}

inline double &endAt(Law &law, int64_t number) noexcept {
  return law.end[static_cast<uint64_t>(number) % kPieces];
}

inline int64_t lastPiece(const Motion &motion) noexcept { return motion.law.next - 1; }

/// Whether the session plans with limited jerk.
inline bool hasJerk(const Motion &motion) noexcept {
  return motion.asked.settings.kind == LawKind::Jerk;
}

/// How long the motion has been in the first piece of the law. [s]
inline double timeInPiece(const Motion &motion) noexcept {
  return motion.since + motion.cycle * static_cast<double>(motion.cycles);
}

/// But for the settings.
bool differs(const Wish &a, const Wish &b) noexcept;
bool differs(const MotionSettings &a, const MotionSettings &b) noexcept;

/// Whether the session plans for what is not wanted any more. Another override ends one that only
/// goes on with the path. It does not end one for another wish: an override that a program changes
/// in every cycle would never act. The newest one is planned for when the session is over.
bool isStale(const Motion &motion) noexcept;

/// The law goes as asked from its next piece on.
void goAsAsked(Motion &motion) noexcept;

/// When there is no acceleration in the piece that is looked at, after `from`; infinite: never.
/// Where it jumps from one side to the other, there is none in between. [s]
double steadyTime(const Motion &motion, double from) noexcept;

/// A rest at the end of the piece that is sought, just before a stop by rounding, is at the stop: a
/// plan from there would go past it.
void restAtStop(Motion &motion, WayState &state) noexcept;

/// The plan takes over: what the law has after that place goes.
void cutLaw(Motion &motion) noexcept;

/// Writes one cell or strip of the plan into the law; after the last one the session ends. False:
/// there is no room.
bool write(Motion &motion) noexcept;

} // namespace stride::path

#endif // STRIDE_RUNTIME_NUMERIC_PATH_MOTION_SESSION_HPP
