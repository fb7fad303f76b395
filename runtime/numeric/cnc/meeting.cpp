#include "runtime/numeric/cnc/meeting.hpp"

#include "runtime/iec/math.h"

namespace stride::cnc {
namespace {

using exact::smaller;
using numeric::cross;
using numeric::dot;
using numeric::norm;

bool isSameNormal(const PathObject &a, const PathObject &b) noexcept {
  return a.normal.x == b.normal.x && a.normal.y == b.normal.y && a.normal.z == b.normal.z;
}

float smallerLimit(float a, float b) noexcept { return a > 0.0F && (b <= 0.0F || a < b) ? a : b; }

} // namespace

bool describeAtCorner(const PathObject &object, ObjectShape &shape) noexcept {
  const bool isCandidate = object.moveType != MoveType::Positioning &&
                           object.moveType != MoveType::Function &&
                           object.moveType != MoveType::Jump && object.probe == 0;
  return isCandidate && shapeOf(object, shape) == ShapeError::None &&
         (shape.measure == Measure::Space || shape.measure == Measure::Plane);
}

bool meet(const PathObject &before, const PathObject &after, Meeting &meeting) noexcept {
  ObjectShape first{};
  ObjectShape second{};
  return describeAtCorner(before, first) && describeAtCorner(after, second) &&
         meet(before, first, after, second, meeting);
}

bool meet(const PathObject &before, const ObjectShape &first, const PathObject &after,
          const ObjectShape &second, Meeting &meeting) noexcept {
  if (first.measure != second.measure)
    return false;
  meeting.before = first.shape;
  meeting.after = second.shape;
  meeting.lengthBefore = first.length;
  meeting.lengthAfter = second.length;
  meeting.measure = first.measure;
  const path::Derivatives end = path::overParameter(first.shape, 1.0);
  const path::Derivatives start = path::overParameter(second.shape, 0.0);
  meeting.place = end.p;
  meeting.lift = numeric::kZero;
  if (first.measure == Measure::Plane) {
    if (!isSameNormal(before, after))
      return false;
    const Vector3 off = meeting.place - start.p;
    meeting.lift = before.normal * dot(off, before.normal);
  }
  const Vector3 from = first.shape.length > 0.0 ? directionAtEnd(end) : numeric::kZero;
  const Vector3 to = second.shape.length > 0.0 ? directionAtStart(start) : numeric::kZero;
  meeting.sine = norm(cross(from, to));
  meeting.cosine = dot(from, to);
  meeting.feed = smaller(before.velocity, after.velocity);
  return true;
}

double turnOf(const Meeting &meeting) noexcept {
  return ::stride::atan2(meeting.sine, meeting.cosine);
}

bool isTurnAbove(double sine, double cosine, double angle) noexcept {
  if (angle < 1.0 && (cosine <= 0.0 || sine > 2.0 * angle * cosine)) // tan(1) < 2
    return sine > 0.0 || cosine < 0.0;
  if (angle > 1.7 && cosine > 0.0) // beyond a right angle
    return false;
  return ::stride::atan2(sine, cosine) > angle;
}

path::Derivatives derivativesAt(const path::Shape &shape, double way) noexcept {
  return derivativesOver(shape, path::parameterAt(shape, way));
}

path::Derivatives derivativesOver(const path::Shape &shape, double u) noexcept {
  if (shape.kind == path::ShapeKind::Line)
    return {shape.v[0] + shape.v[1] * u, shape.v[1] * (1.0 / norm(shape.v[1])), numeric::kZero,
            numeric::kZero};
  return path::overLength(path::overParameter(shape, u));
}

double slopeAt(const PathObject &object, int32_t angle, bool atEnd) noexcept {
  if ((object.slopes >> static_cast<unsigned>(angle) & 1U) != 0)
    return atEnd ? object.endSlope[angle] : object.startSlope[angle];
  const int32_t axis = kAxisA + angle;
  const double way = object.end.coordinate[axis] - object.start.coordinate[axis];
  return object.length > 0.0 ? way / object.length : 0.0;
}

void beginPiece(const PathObject &before, const PathObject &after, PathObject &piece) noexcept {
  copyObject(piece, before);
  piece.start = before.end;
  piece.end = after.start;
  piece.start.sProfile = 0;
  piece.end.sProfile = 0;
  piece.start.axes = before.end.axes | after.end.axes;
  piece.end.axes = piece.start.axes;
  piece.velocity = smaller(before.velocity, after.velocity);
  piece.velocityEnd = piece.velocity;
  piece.acceleration = smaller(before.acceleration, after.acceleration);
  piece.deceleration = smaller(before.deceleration, after.deceleration);
  piece.marks = 0;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    piece.switchId[i] = 0;
    piece.switchPosition[i] = 0.0;
  }
  for (int32_t i = 0; i < 9; ++i) {
    AxisLimits &limits = piece.limits[i];
    const AxisLimits &other = after.limits[i];
    limits.velocity = smallerLimit(limits.velocity, other.velocity);
    limits.acceleration = smallerLimit(limits.acceleration, other.acceleration);
    limits.deceleration = smallerLimit(limits.deceleration, other.deceleration);
  }
  // Where one of both goes by slopes, the piece leads from its slope to the other's.
  piece.slopes = static_cast<uint8_t>(before.slopes | after.slopes);
  for (int32_t i = 0; i < 3; ++i) {
    piece.startSlope[i] = slopeAt(before, i, true);
    piece.endSlope[i] = slopeAt(after, i, false);
  }
}

void describePiece(const path::Shape &curve, PathObject &piece) noexcept {
  piece.moveType = MoveType::Spline3d;
  for (int k = 0; k < 6; ++k) {
    const double axes[] = {curve.v[k].x, curve.v[k].y, curve.v[k].z};
    for (int axis = 0; axis < 3; ++axis) {
      const int at = axis * 6 + k;
      (at < 8 ? piece.shape[at] : piece.moreShape[at - 8]) = axes[axis];
    }
  }
  piece.parameterRange[0] = 0.0;
  piece.parameterRange[1] = 1.0;
  piece.length = curve.length;
}

} // namespace stride::cnc
