// The path of a tool's centre: the programmed contour at the distance of its radius.
//
// Between G41 or G42 and G40 each object is shifted to the left or the right in the plane of its
// arcs. Lines and arcs stay lines and arcs; ellipses and splines become cubics within a tolerance.
// Outside of a corner the tool goes around it on an arc; inside, both neighbours end where their
// shifted curves cross. Where they do not cross because one is too short, or where an arc is bent
// more than the tool, a line leads on, and the path crosses itself: AvoidLoop cuts that out. All
// that is left out lies in the reach of the tool: what remains is at its distance.
// Free of the C++ standard library: linked into every application.
// Source: SoftMotion V2.3 manual, section 6.2.3; ramps and planes are SoftMotion 3's.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TOOL_CORRECTION_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TOOL_CORRECTION_HPP

#include "runtime/numeric/cnc/processors/plane_track.hpp"
#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// How the path comes from the contour to the shifted one and back.
enum class ToolEntry : uint8_t {
  Positioning, ///< By a positioning (G0): one next to the contour is moved, else one is inserted.
  Ramp,        ///< The first object begins unshifted, the first one after the end ends so.
};

/// What the user sets.
struct ToolRules {
  double radius;    ///< Is added to the radius of the object. [u]
  double tolerance; ///< Of ellipses and splines; 0: kToolTolerance. [u]
  ToolEntry entry;
};

inline constexpr double kToolTolerance = 1e-3; ///< [u]

enum class ToolSide : uint8_t { None, Left, Right };

enum class ToolPhase : uint8_t {
  Off,      ///< Objects pass.
  Entering, ///< The ramp, or a positioning that is marked, is held.
  On,
  Leaving, ///< What follows leads back to the contour.
};

/// Objects that are ready and have had no place in the output yet; or wait for a corner.
inline constexpr int32_t kMostWaiting = 8;
struct Waiting {
  PathObject objects[kMostWaiting + 4];
  int32_t first, count;
};

/// A shifted object whose end may still be cut.
struct ToolPiece {
  PathObject object; ///< As it was programmed.
  Track track;       ///< Shifted.
  double from;       ///< Where it begins, after the corner before it.
  Vector3 begin;     ///< Direction at the start of the programmed object, in the plane.
  Vector3 end;       ///< At its end.
};

/// Arcs in a row that have vanished, without an outside corner between them. They turn by no more
/// than half a circle in all, or are one: then the line from their shifted start to their shifted
/// end, and any between the neighbours' ends, is nearer to them than the tool's radius.
struct ToolGap {
  PathObject object; ///< From the start of the first one to the end of the last one.
  Vector3 from, to;  ///< Shifted start and end.
  Vector3 begin;     ///< Direction at the start,
  Vector3 end;       ///< and at the end.
  double turn;       ///< How far they turn. [rad]
};

struct ToolCorrection {
  static constexpr Generator kGenerator = kByToolCorr;
  static constexpr bool kLooksAhead = false;

  ToolRules rules;
  ToolPhase phase;
  ToolSide side;
  ToolSide pending; ///< Off: a function was marked, and the next motion begins the contour.
  bool holds;       ///< `piece` has not been put out.
  bool follows;     ///< There is a piece before the next one.
  bool gap;         ///< Arcs have vanished after `piece`: `vanished`.
  bool approaches;  ///< `approach` is held.
  uint8_t carried;  ///< Marks of what has vanished, for the next object.
  double left;      ///< Distance to the left, negative to the right. [u]
  double curveFrom; ///< How far an ellipse or a spline has been shifted.
  double curveWay;  ///< The same as a part of its length.
  Plane plane;
  Track curve; ///< The ellipse or spline that is being shifted.
  ToolPiece piece;
  ToolGap vanished;
  Vector3 corner;      ///< Where the programmed object of `piece` ends, in the plane.
  PathObject approach; ///< The last positioning, or the ramp.
  Position leaveAt;    ///< Where the shifted path ends, and
  Position leaveTo;    ///< where the contour does.
  Position at;         ///< Where the path is.
  Waiting waiting; ///< Objects that do not move in the plane, for the corner that they stand at.
  Waiting ready;   ///< For the next step.
};

void start(ToolCorrection &tool) noexcept;
Step next(ToolCorrection &tool, const Source &source, Output &output) noexcept;
Step finish(ToolCorrection &tool, Ending ending, Output &output) noexcept;

/// To which side objects are being shifted.
ToolSide sideOf(const ToolCorrection &tool) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TOOL_CORRECTION_HPP
