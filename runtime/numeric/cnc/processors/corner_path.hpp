// Path processors that put pieces into the corners of a path: SMC_SmoothPath between G51 and G50,
// SMC_RoundPath between G52 and G50. Free of the C++ standard library: linked into every
// application.
// Source: SoftMotion V2.3 manual, sections 6.2.5 and 6.2.6.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_CORNER_PATH_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_CORNER_PATH_HPP

#include "runtime/numeric/cnc/processors/corner_piece.hpp"
#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// How many M functions and dwells at one corner can be led past it.
inline constexpr int32_t kMostAtCorner = 8;

/// What makes the distance from the corner.
enum class DistanceRule : uint8_t {
  ToolRadiusAdded,     ///< `distance` and the first object's toolRadius: SMC_SmoothPath of V2.3.
  ToolRadiusElse,      ///< `distance`, or if that is 0 the toolRadius: SMC_RoundPath of V2.3.
  CornerDistanceAdded, ///< `distance` and its cornerDistance: SoftMotion 3.
};

/// What both processors share. The user sets the first members.
struct CornerPath {
  double distance;  ///< [u] Finite.
  double leastTurn; ///< Of corners that change. [rad] Finite.
  PieceKind kind;
  DistanceRule rule;
  bool symmetrical;
  /// A corner with M functions or dwells is changed, too, and they come after its piece; else they
  /// stay at the corner, and it stays as it is.
  bool passesFunctions;
  // Its own:
  /// The last object, whose end may still be cut, and the next one, as it is after its corner.
  PathObject objects[2];
  PathObject piece;
  PathObject functions[kMostAtCorner];
  BeforeCorner knownHeld; ///< Of the last object.
  BeforeCorner knownNext; ///< Of the next one.
  int32_t last;           ///< Which of `objects` is the last one.
  int32_t count;          ///< Of `functions`.
  int32_t done;           ///< How many of them have been put out.
  bool active;            ///< Between the marks.
  bool heldActive;        ///< What is held has a corner that may change.
  bool holds;             ///< There is a last object.
  bool hasPiece;
  bool hasFollowing; ///< What comes before it is being put out.
};

struct SmoothPath : CornerPath {
  static constexpr Generator kGenerator = kBySmoothPath;
  static constexpr uint8_t kBegin = kSmooth;
  static constexpr bool kLooksAhead = false;
};

struct RoundPath : CornerPath {
  static constexpr Generator kGenerator = kByRoundPath;
  static constexpr uint8_t kBegin = kRound;
  static constexpr bool kLooksAhead = false;
};

void startCorners(CornerPath &path) noexcept;
Step nextCorner(CornerPath &path, uint8_t beginMark, const PathObject &object,
                Output &output) noexcept;
Step finishCorners(CornerPath &path, Output &output) noexcept;

inline void start(SmoothPath &path) noexcept { startCorners(path); }
inline void start(RoundPath &path) noexcept { startCorners(path); }
inline Step next(SmoothPath &path, const Source &source, Output &output) noexcept {
  return nextCorner(path, SmoothPath::kBegin, source.object, output);
}
inline Step next(RoundPath &path, const Source &source, Output &output) noexcept {
  return nextCorner(path, RoundPath::kBegin, source.object, output);
}
inline Step finish(SmoothPath &path, Ending /*ending*/, Output &output) noexcept {
  return finishCorners(path, output);
}
inline Step finish(RoundPath &path, Ending /*ending*/, Output &output) noexcept {
  return finishCorners(path, output);
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_CORNER_PATH_HPP
