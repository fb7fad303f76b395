// What the sources of the tool correction share.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TOOL_CORRECTION_INTERNAL_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TOOL_CORRECTION_INTERNAL_HPP

#include "runtime/numeric/cnc/processors/tool_correction.hpp"

namespace stride::cnc {

inline constexpr uint8_t kToolMarks = kToolLeft | kToolRight | kEndToolCorrection;
inline constexpr uint8_t kBeginMarks = kSmooth | kRound | kAvoidLoops;

/// Puts an object out, or into `ready`.
void emitObject(ToolCorrection &tool, const PathObject &object, Output &output) noexcept;

/// Puts out what is ready. False: not all of it.
bool emitReady(ToolCorrection &tool, Output &output) noexcept;

/// What waits at the corner, where the path is now.
void emitWaiting(ToolCorrection &tool, Output &output) noexcept;

/// Puts the piece out, up to a parameter of its track, and what waits at its end.
void emitPiece(ToolCorrection &tool, double to, Output &output) noexcept;

/// A shifted object that follows.
struct NewPiece {
  const PathObject &object; ///< As it was programmed.
  const Track &track;       ///< Shifted.
  Vector3 begin, end;       ///< Directions of the programmed one.
};

/// The piece becomes the last one; the corner before it is made. `smooth`: it goes on with the
/// curve of the one before.
void addPiece(ToolCorrection &tool, const NewPiece &piece, const Vector3 &corner, bool smooth,
              Output &output) noexcept;

/// How a path goes on at a corner, as the tool sees it.
enum class ToolBend : uint8_t { Straight, Inside, Outside };

/// By the directions in the plane before and after; `left` as ToolCorrection has it. Where the path
/// turns back, the tool goes around.
ToolBend bendOf(const Vector3 &before, const Vector3 &after, double left) noexcept;

/// A positioning or ramp that is held, as it is; and what waits after it.
void releaseApproach(ToolCorrection &tool, Output &output) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TOOL_CORRECTION_INTERNAL_HPP
