// Tool correction: corners between shifted objects, and what comes out.
#include "runtime/numeric/cnc/processors/tool_correction_internal.hpp"
#include "runtime/numeric/cnc/processors/track_crossing.hpp"

#include "runtime/iec/math.h"

namespace stride::cnc {
namespace {

using numeric::dot;

/// Directions that differ less make no corner. [rad]
constexpr double kLeastTurn = 1e-7;

double crossOf(const Vector3 &a, const Vector3 &b) noexcept { return a.x * b.y - a.y * b.x; }

/// The start of what follows is exactly the end of what was before.
void joinTo(const ToolCorrection &tool, PathObject &object) noexcept {
  for (int32_t i = kAxisX; i <= kAxisZ; ++i)
    object.start.coordinate[i] = tool.at.coordinate[i];
}

/// The arc around the corner, from the end of the path to the start of the piece.
void emitArc(ToolCorrection &tool, const NewPiece &piece, Output &output) noexcept {
  const Vector3 from = inPlane(tool.at, tool.plane) - tool.corner;
  const Vector3 to = placeOn(piece.track, 0.0) - tool.corner;
  double sweep = ::stride::atan2(crossOf(from, to), dot(from, to));
  constexpr double kTurn = 6.283185307179586477;
  // Around the outside: against the side of the tool.
  if (tool.left > 0.0 && sweep > 0.0)
    sweep -= kTurn;
  else if (tool.left < 0.0 && sweep < 0.0)
    sweep += kTurn;
  const double radius = exact::fabs(tool.left);
  PathObject arc = linkTo(tool.at, piece.object, tool.plane, placeOn(piece.track, 0.0));
  arc.velocity = exact::smaller(arc.velocity, tool.piece.object.velocity);
  arc.velocityEnd = arc.velocity;
  const Track track{path::arcShape(tool.corner, {radius, 0.0, 0.0}, {0.0, radius, 0.0},
                                   ::stride::atan2(from.y, from.x), sweep, numeric::kZero)};
  if (arc.moveType == MoveType::Positioning)
    arc.moveType = MoveType::Line;
  follow(arc, tool.plane, track, 0.0, 1.0);
  joinTo(tool, arc);
  moveInPlane(arc.end, tool.plane, placeOn(piece.track, 0.0));
  emitObject(tool, arc, output);
}

/// Where both cross nearest to the corner; false: nowhere.
bool crossInside(const ToolCorrection &tool, const NewPiece &piece, Crossing &best) noexcept {
  const Track &before = tool.piece.track;
  Crossing crossings[kMostCrossings];
  const int32_t count = crossingsOf(before, piece.track, crossings);
  double least = exact::kInfinity;
  for (int32_t i = 0; i < count; ++i) {
    const Crossing &at = crossings[i];
    const double cut =
        (1.0 - at.first) * before.shape.length + at.second * piece.track.shape.length;
    if (at.first > tool.piece.from && at.second < 1.0 && cut < least) {
      least = cut;
      best = at;
    }
  }
  return least < exact::kInfinity;
}

void emitLink(ToolCorrection &tool, const NewPiece &piece, Output &output) noexcept {
  const Vector3 to = placeOn(piece.track, 0.0);
  const Vector3 way = to - inPlane(tool.at, tool.plane);
  if (dot(way, way) > 0.0)
    emitObject(tool, linkTo(tool.at, piece.object, tool.plane, to), output);
}

/// Makes the corner to the piece. Where the piece begins then.
double makeCorner(ToolCorrection &tool, const NewPiece &piece, bool smooth,
                  Output &output) noexcept {
  const ToolBend bend = bendOf(tool.piece.end, piece.begin, tool.left);
  if (!tool.gap && (smooth || bend != ToolBend::Inside)) {
    if (tool.holds)
      emitPiece(tool, 1.0, output);
    if (!smooth && bend == ToolBend::Outside)
      emitArc(tool, piece, output);
    return 0.0;
  }
  Crossing at{1.0, 0.0};
  const bool crosses = tool.holds && crossInside(tool, piece, at);
  if (tool.holds)
    emitPiece(tool, at.first, output);
  if (!crosses)
    emitLink(tool, piece, output);
  return at.second;
}

/// From the contour to the shifted path.
void enter(ToolCorrection &tool, const NewPiece &piece, Output &output) noexcept {
  const Vector3 to = placeOn(piece.track, 0.0);
  if (tool.approaches) {
    tool.approaches = false;
    tool.approach.marks &= static_cast<uint8_t>(~kToolMarks);
    moveInPlane(tool.approach.end, tool.plane, to);
    const PathObject from = tool.approach;
    follow(tool.approach, tool.plane, lineTrack(inPlane(from.start, tool.plane), to), 0.0, 1.0);
    emitObject(tool, tool.approach, output);
    emitWaiting(tool, output);
    return;
  }
  PathObject link = linkTo(piece.object.start, piece.object, tool.plane, to);
  link.moveType = MoveType::Positioning;
  emitObject(tool, link, output);
}

} // namespace

ToolBend bendOf(const Vector3 &before, const Vector3 &after, double left) noexcept {
  const double turn = crossOf(before, after);
  const bool isForward = dot(before, after) > 0.0;
  if (exact::fabs(turn) <= kLeastTurn)
    return isForward ? ToolBend::Straight : ToolBend::Outside;
  return turn * left < 0.0 ? ToolBend::Outside : ToolBend::Inside;
}

void emitObject(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  tool.at = object.end;
  if (tool.ready.count == tool.ready.first && put(output, object) != nullptr)
    return;
  if (tool.ready.count < kMostWaiting + 4)
    tool.ready.objects[tool.ready.count++] = object;
}

bool emitReady(ToolCorrection &tool, Output &output) noexcept {
  Waiting &ready = tool.ready;
  while (ready.first < ready.count && put(output, ready.objects[ready.first]) != nullptr)
    ++ready.first;
  if (ready.first < ready.count)
    return false;
  ready.first = ready.count = 0;
  return true;
}

void emitWaiting(ToolCorrection &tool, Output &output) noexcept {
  const Vector3 here = inPlane(tool.at, tool.plane);
  for (int32_t i = 0; i < tool.waiting.count; ++i) {
    PathObject &object = tool.waiting.objects[i];
    moveInPlane(object.start, tool.plane, here);
    moveInPlane(object.end, tool.plane, here);
    emitObject(tool, object, output);
  }
  tool.waiting.count = 0;
}

void emitPiece(ToolCorrection &tool, double to, Output &output) noexcept {
  PathObject &object = tool.piece.object;
  keepSwitches(object, tool.piece.from, to);
  follow(object, tool.plane, tool.piece.track, tool.piece.from, to);
  object.marks &= static_cast<uint8_t>(~kToolMarks);
  if (tool.follows)
    joinTo(tool, object);
  tool.holds = false;
  emitObject(tool, object, output);
  emitWaiting(tool, output);
}

void addPiece(ToolCorrection &tool, const NewPiece &piece, const Vector3 &corner, bool smooth,
              Output &output) noexcept {
  double from = 0.0;
  if (tool.follows)
    from = makeCorner(tool, piece, smooth, output);
  else
    enter(tool, piece, output);
  tool.piece.object = piece.object;
  tool.piece.track = piece.track;
  tool.piece.begin = piece.begin;
  tool.piece.end = piece.end;
  tool.piece.from = from;
  tool.piece.object.marks |= tool.carried;
  tool.carried = 0;
  tool.corner = corner;
  tool.holds = tool.follows = true;
  tool.gap = false;
}

void releaseApproach(ToolCorrection &tool, Output &output) noexcept {
  if (tool.approaches)
    emitObject(tool, tool.approach, output);
  tool.approaches = false;
  for (int32_t i = 0; i < tool.waiting.count; ++i)
    emitObject(tool, tool.waiting.objects[i], output);
  tool.waiting.count = 0;
}

} // namespace stride::cnc
