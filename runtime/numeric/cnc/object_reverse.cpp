#include "runtime/numeric/cnc/object_reverse.hpp"

#include "runtime/numeric/exact_math.hpp"

namespace stride::cnc {
namespace {

MoveType turned(MoveType type) noexcept {
  switch (type) {
  case MoveType::Clockwise:
    return MoveType::Counterclockwise;
  case MoveType::Counterclockwise:
    return MoveType::Clockwise;
  case MoveType::EllipseClockwise:
    return MoveType::EllipseCounterclockwise;
  case MoveType::EllipseCounterclockwise:
    return MoveType::EllipseClockwise;
  default:
    return type;
  }
}

bool isClockwise(MoveType type) noexcept {
  return type == MoveType::Clockwise || type == MoveType::EllipseClockwise;
}

template <class T> void swap(T &a, T &b) noexcept {
  const T c = a;
  a = b;
  b = c;
}

/// Angle and sweep of arcs and ellipses: by type, not by the sign of the sweep.
void turnAngles(const PathObject &object, PathObject &result) noexcept {
  const double sweep = exact::fabs(object.parameterRange[1]);
  const bool clockwise = isClockwise(object.moveType);
  result.parameterRange[0] = object.parameterRange[0] + (clockwise ? -sweep : sweep);
  result.parameterRange[1] = clockwise ? -sweep : sweep;
}

void turnRange(const PathObject &object, PathObject &result) noexcept {
  const bool whole = object.parameterRange[0] == 0.0 && object.parameterRange[1] == 0.0;
  result.parameterRange[0] = whole ? 1.0 : object.parameterRange[1];
  result.parameterRange[1] = whole ? 0.0 : object.parameterRange[0];
}

} // namespace

PathObject reversed(const PathObject &object, double velocityEnd) noexcept {
  PathObject result = object;
  result.moveType = turned(object.moveType);
  swap(result.start, result.end);
  swap(result.start.sProfile, result.end.sProfile); // of the start, whichever that is
  result.velocityEnd = velocityEnd;
  if (result.moveType != object.moveType)
    turnAngles(object, result);
  else if (object.moveType == MoveType::Spline || object.moveType == MoveType::Spline3d)
    turnRange(object, result);
  for (int32_t i = 0; i <= kMostSwitches; ++i)
    result.switchPosition[i] = 1.0 - object.switchPosition[i];
  for (int32_t i = 0; i < 3; ++i) {
    result.startSlope[i] = -object.endSlope[i];
    result.endSlope[i] = -object.startSlope[i];
  }
  return result;
}

} // namespace stride::cnc
