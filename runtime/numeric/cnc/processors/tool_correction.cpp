#include "runtime/numeric/cnc/processors/tool_correction.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/processors/tool_correction_internal.hpp"
#include "runtime/numeric/cnc/processors/track_offset.hpp"

namespace stride::cnc {
namespace {

constexpr uint8_t kToolSides = kToolLeft | kToolRight;

/// Changes of the radius below this part of it are none.
constexpr double kSameRadius = 1e-12;

Step failed(Output &output, StreamError error) noexcept {
  output.error = error;
  return Step::Failed;
}

bool isLine(const PathObject &object) noexcept {
  return object.moveType == MoveType::Line || object.moveType == MoveType::Positioning;
}

bool isPositioning(const PathObject &object) noexcept {
  return object.moveType == MoveType::Positioning;
}

double toleranceOf(const ToolCorrection &tool) noexcept {
  return tool.rules.tolerance > 0.0 ? tool.rules.tolerance : kToolTolerance;
}

/// Moves the start of a line in the plane.
void beginAt(PathObject &object, const Plane &plane, const Vector3 &place) noexcept {
  follow(object, plane, lineTrack(place, inPlane(object.end, plane)), 0.0, 1.0);
}

/// Nothing more is cut: the piece and what stands at its end are put out. What has vanished before
/// any piece is a place: of a circle as large as the tool, its centre.
void settle(ToolCorrection &tool, Output &output) noexcept {
  if (tool.gap && !tool.follows) {
    const ToolGap &gap = tool.vanished;
    const Track place = lineTrack(gap.from, gap.to);
    addPiece(tool, {gap.object, place, gap.begin, gap.end}, inPlane(gap.object.end, tool.plane),
             false, output);
  }
  if (tool.holds)
    emitPiece(tool, 1.0, output);
  else
    emitWaiting(tool, output);
}

/// The shifted path ends; `object` is where the contour is left.
void leave(ToolCorrection &tool, const Position &contour, Output &output) noexcept {
  settle(tool, output);
  tool.leaveAt = tool.at;
  tool.leaveTo = contour;
  tool.phase = ToolPhase::Leaving;
  tool.follows = tool.gap = false;
  tool.side = ToolSide::None;
}

/// Without marks of a tool: they are carried out.
void keepWaiting(ToolCorrection &tool, const PathObject &object) noexcept {
  PathObject &kept = tool.waiting.objects[tool.waiting.count++];
  kept = object;
  kept.marks &= static_cast<uint8_t>(~kToolMarks);
}

/// Holds an object back that does not move in the plane. Without room for it, the corner is made as
/// if nothing followed.
void wait(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  if (tool.waiting.count == kMostWaiting)
    settle(tool, output);
  keepWaiting(tool, object);
}

// ---- pieces of objects

NewPiece pieceOf(const PathObject &object, const Track &shifted, const Track &own) noexcept {
  const Vector3 begin = directionAtStart(own);
  return {object, shifted, begin,
          own.shape.kind == path::ShapeKind::Line ? begin : directionAtEnd(own)};
}

/// Arcs that have vanished become a line after all: the tool goes around their end.
void fillGap(ToolCorrection &tool, Output &output) noexcept {
  const ToolGap &gap = tool.vanished;
  const Track line = lineTrack(gap.from, gap.to);
  if (!(line.shape.length > 0.0))
    return;
  tool.gap = false;
  addPiece(tool, {gap.object, line, gap.begin, gap.end}, inPlane(gap.object.end, tool.plane), false,
           output);
}

/// Before an object that begins in a direction.
void leaveGap(ToolCorrection &tool, const Vector3 &begin, Output &output) noexcept {
  if (tool.gap && bendOf(tool.vanished.end, begin, tool.left) == ToolBend::Outside)
    fillGap(tool, output);
}

double turnBetween(const Vector3 &a, const Vector3 &b) noexcept {
  return exact::fabs(::stride::atan2(a.x * b.y - a.y * b.x, numeric::dot(a, b)));
}

/// The arc joins those that have vanished before it, if there are any.
void joinGap(ToolCorrection &tool, const NewPiece &arc, double sweep, Output &output) noexcept {
  ToolGap &gap = tool.vanished;
  constexpr double kHalfTurn = 3.14159265358979323846;
  const double turn = gap.turn + turnBetween(gap.end, arc.begin) + sweep;
  if (tool.gap && turn > kHalfTurn)
    fillGap(tool, output);
  const bool joins = tool.gap;
  const Position start = gap.object.start;
  gap.object = arc.object;
  gap.object.marks = 0;
  for (int16_t &id : gap.object.switchId)
    id = 0;
  gap.to = placeOn(arc.track, 1.0);
  gap.end = arc.end;
  gap.turn = joins ? turn : sweep;
  tool.gap = true;
  if (joins) {
    gap.object.start = start;
    return;
  }
  gap.from = placeOn(arc.track, 0.0);
  gap.begin = arc.begin;
}

/// An arc that is bent more than the tool: the neighbours meet, or the tool goes around its ends.
void vanish(ToolCorrection &tool, const PathObject &object, const Track &own,
            Output &output) noexcept {
  const Track line =
      lineTrack(offsetPlace(own, tool.left, false), offsetPlace(own, tool.left, true));
  const NewPiece arc = pieceOf(object, line, own);
  if (tool.follows)
    leaveGap(tool, arc.begin, output);
  const Vector3 &before = tool.gap ? tool.vanished.end : tool.piece.end;
  const bool isCorner = !tool.follows || bendOf(before, arc.begin, tool.left) == ToolBend::Outside;
  if (isCorner && line.shape.length > 0.0) {
    addPiece(tool, arc, inPlane(object.end, tool.plane), false, output);
    return;
  }
  tool.carried |= object.marks & kBeginMarks;
  if (tool.holds) {
    takeSwitches(tool.piece.object, object, 1.0);
    tool.piece.object.marks |= object.marks & static_cast<uint8_t>(~kBeginMarks);
  }
  joinGap(tool, arc, exact::fabs(own.shape.sweep), output);
}

/// The part of a curve's object between two parts of its way.
PathObject partOf(const PathObject &object, double from, double to) noexcept {
  PathObject part = object;
  for (int32_t i = 0; i < kAxes; ++i) {
    const double way = object.end.coordinate[i] - object.start.coordinate[i];
    if (from > 0.0)
      part.start.coordinate[i] = object.start.coordinate[i] + way * from;
    if (to < 1.0)
      part.end.coordinate[i] = object.start.coordinate[i] + way * to;
  }
  if (from > 0.0)
    part.marks &= static_cast<uint8_t>(~kBeginMarks);
  if (to < 1.0)
    part.marks &= kBeginMarks;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double at = object.switchPosition[i];
    const bool isHere = at <= to && (at > from || from == 0.0);
    if (object.switchId[i] == 0 || isHere)
      continue;
    part.switchId[i] = 0;
  }
  keepSwitches(part, from, to);
  return part;
}

/// The next piece of an ellipse or a spline.
Step shiftCurve(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  constexpr double kFirstStep = 0.25;
  const double from = tool.curveFrom;
  Track piece;
  const double to = offsetPiece(tool.curve, tool.left, from, kFirstStep, toleranceOf(tool), piece);
  const double whole = path::lengthBetween(tool.curve.shape, 0.0, 1.0);
  const double way =
      to == 1.0 ? 1.0 : tool.curveWay + path::lengthBetween(tool.curve.shape, from, to) / whole;
  const PathObject part = partOf(object, tool.curveWay, way);
  addPiece(tool, pieceOf(part, piece, tool.curve), inPlane(object.end, tool.plane), from > 0.0,
           output);
  tool.curveFrom = to == 1.0 ? 0.0 : to;
  tool.curveWay = to == 1.0 ? 0.0 : way;
  return to == 1.0 ? Step::Took : Step::Again;
}

/// An object of the contour.
Step shift(ToolCorrection &tool, const PathObject &object, const Track &own,
           Output &output) noexcept {
  if (isFreeForm(own)) {
    if (tool.curveFrom == 0.0)
      leaveGap(tool, directionAtStart(own), output);
    tool.curve = own;
    return shiftCurve(tool, object, output);
  }
  Track shifted;
  if (!offsetTrack(own, tool.left, shifted)) {
    vanish(tool, object, own, output);
    return Step::Took;
  }
  const NewPiece piece = pieceOf(object, shifted, own);
  leaveGap(tool, piece.begin, output);
  addPiece(tool, piece, inPlane(object.end, tool.plane), false, output);
  return Step::Took;
}

// ---- phases

/// The radius of an object. False: there is none.
bool radiusOf(const ToolCorrection &tool, const PathObject &object, double &radius) noexcept {
  radius = object.toolRadius + tool.rules.radius;
  return exact::isfinite(radius) && radius >= 0.0;
}

Step off(ToolCorrection &tool, const PathObject &object, Output &output) noexcept;

Step stepOn(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  if (object.moveType == MoveType::Jump) {
    settle(tool, output);
    tool.follows = tool.gap = false;
    emitObject(tool, object, output);
    return Step::Took;
  }
  Track own;
  TrackError error = TrackError::None;
  if (tool.curveFrom == 0.0)
    error = trackOf(object, tool.plane, own);
  else
    own = tool.curve;
  if (error == TrackError::Plane)
    return failed(output, StreamError::PlaneChanged);
  if (error == TrackError::Geometry)
    return failed(output, StreamError::InvalidObject);
  double radius = 0.0;
  if (isMotion(object) && !radiusOf(tool, object, radius))
    return failed(output, StreamError::InvalidParameter);
  const double active = exact::fabs(tool.left);
  if (isMotion(object) && tool.curveFrom == 0.0 &&
      exact::fabs(radius - active) > kSameRadius * active) {
    leave(tool, object.start, output); // as if it had ended before
    return Step::Again;
  }
  Step step = Step::Took;
  if (!isMotion(object) || !(own.shape.length > 0.0))
    wait(tool, object, output);
  else
    step = shift(tool, object, own, output);
  if (step == Step::Took && (object.marks & kEndToolCorrection) != 0)
    leave(tool, object.end, output);
  return step;
}

/// The contour has ended without an object.
void stayOff(ToolCorrection &tool) noexcept {
  tool.phase = ToolPhase::Off;
  tool.side = ToolSide::None;
}

/// The first object of the contour, or what stands before it.
Step entering(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  Track own;
  tool.plane = planeOf(object);
  const TrackError error = isMotion(object) ? trackOf(object, tool.plane, own) : TrackError::None;
  if (error != TrackError::None)
    return failed(output, StreamError::InvalidObject);
  if (!isMotion(object) || !(own.shape.length > 0.0)) {
    if (object.moveType == MoveType::Jump || tool.waiting.count == kMostWaiting)
      releaseApproach(tool, output);
    keepWaiting(tool, object);
    if ((object.marks & kEndToolCorrection) != 0)
      stayOff(tool); // before anything was shifted
    return Step::Took;
  }
  double radius = 0.0;
  if (!radiusOf(tool, object, radius))
    return failed(output, StreamError::InvalidParameter);
  tool.left = tool.side == ToolSide::Left ? radius : -radius;
  tool.phase = ToolPhase::On;
  tool.follows = tool.holds = tool.gap = false;
  return stepOn(tool, object, output);
}

/// A start mark: what enters is held, or the contour begins at once.
Step begin(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  const bool isRamp = tool.rules.entry == ToolEntry::Ramp;
  if (isRamp && !isLine(object))
    return failed(output, StreamError::InvalidObject);
  tool.side = (object.marks & kToolSides) == 0  ? tool.pending
              : (object.marks & kToolLeft) != 0 ? ToolSide::Left
                                                : ToolSide::Right;
  tool.pending = ToolSide::None;
  tool.phase = ToolPhase::Entering;
  if (!isRamp && !isPositioning(object))
    return entering(tool, object, output);
  releaseApproach(tool, output);
  tool.approach = object;
  tool.approaches = true;
  if ((object.marks & kEndToolCorrection) != 0) // nothing was between
    stayOff(tool);
  return Step::Took;
}

/// What a function or a jump is marked with counts from the next motion on.
void markNext(ToolCorrection &tool, const PathObject &object) noexcept {
  if ((object.marks & kToolSides) != 0)
    tool.pending = (object.marks & kToolLeft) != 0 ? ToolSide::Left : ToolSide::Right;
  if ((object.marks & kEndToolCorrection) != 0)
    tool.pending = ToolSide::None;
}

Step off(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  double radius = 0.0;
  if (!isMotion(object)) {
    markNext(tool, object);
  } else if ((object.marks & kToolSides) != 0 || tool.pending != ToolSide::None) {
    if (!radiusOf(tool, object, radius))
      return failed(output, StreamError::InvalidParameter);
    if (radius > 0.0)
      return begin(tool, object, output);
    tool.pending = ToolSide::None;
  }
  const bool stands = object.moveType == MoveType::Function;
  if (tool.approaches && stands && tool.waiting.count < kMostWaiting) {
    keepWaiting(tool, object);
    return Step::Took;
  }
  releaseApproach(tool, output);
  if (isPositioning(object)) {
    tool.approach = object;
    tool.approaches = true;
  } else {
    emitObject(tool, object, output);
  }
  return Step::Took;
}

/// A positioning from the shifted path to the contour, to be held.
void holdReturn(ToolCorrection &tool, const PathObject &like) noexcept {
  tool.approach = linkTo(tool.leaveAt, like, tool.plane, inPlane(tool.leaveTo, tool.plane));
  tool.approach.moveType = MoveType::Positioning;
  tool.approaches = true;
}

Step leaving(ToolCorrection &tool, const PathObject &object, Output &output) noexcept {
  if (object.moveType == MoveType::Function) {
    markNext(tool, object);
    keepWaiting(tool, object);
    emitWaiting(tool, output);
    return Step::Took;
  }
  tool.phase = ToolPhase::Off;
  if (object.moveType == MoveType::Jump)
    return off(tool, object, output);
  const bool isRamp = tool.rules.entry == ToolEntry::Ramp;
  if (isRamp && !isLine(object))
    return failed(output, StreamError::InvalidObject);
  if (isRamp || isPositioning(object)) {
    PathObject moved = object;
    beginAt(moved, tool.plane, inPlane(tool.leaveAt, tool.plane));
    return off(tool, moved, output);
  }
  holdReturn(tool, object);
  return off(tool, object, output);
}

} // namespace

void start(ToolCorrection &tool) noexcept {
  const ToolRules rules = tool.rules;
  __builtin_memset(static_cast<void *>(&tool), 0, sizeof tool);
  tool.rules = rules;
}

Step next(ToolCorrection &tool, const Source &source, Output &output) noexcept {
  if (!emitReady(tool, output))
    return Step::Again;
  switch (tool.phase) {
  case ToolPhase::Off:
    return off(tool, source.object, output);
  case ToolPhase::Entering:
    return entering(tool, source.object, output);
  case ToolPhase::On:
    return stepOn(tool, source.object, output);
  case ToolPhase::Leaving:
    break;
  }
  return leaving(tool, source.object, output);
}

Step finish(ToolCorrection &tool, Ending ending, Output &output) noexcept {
  if (!emitReady(tool, output))
    return Step::Again;
  if (tool.phase == ToolPhase::On) {
    if (ending == Ending::Pause && tool.rules.entry == ToolEntry::Ramp)
      return failed(output, StreamError::PauseInCorrection);
    settle(tool, output);
  } else {
    if (tool.phase == ToolPhase::Leaving && tool.rules.entry == ToolEntry::Positioning) {
      holdReturn(tool, tool.piece.object);
      tool.phase = ToolPhase::Off;
    }
    releaseApproach(tool, output);
  }
  return tool.ready.count != 0 ? Step::Again : Step::Took;
}

ToolSide sideOf(const ToolCorrection &tool) noexcept {
  return tool.phase == ToolPhase::Off || tool.phase == ToolPhase::Leaving ? ToolSide::None
                                                                          : tool.side;
}

} // namespace stride::cnc
