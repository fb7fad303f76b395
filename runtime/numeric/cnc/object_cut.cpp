#include "runtime/numeric/cnc/object_cut.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/path/bend.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;
using numeric::norm;

constexpr double kRadian = 57.29577951308232; ///< [degrees]
constexpr uint8_t kEndMarks = kEndToolCorrection | kEndSmoothing | kEndAvoidLoops;

/// Where an object is cut.
struct Cut {
  double way;  ///< [u]
  double part; ///< The same as a part of the length.
  double u;    ///< The same as the parameter of the shape.
};

bool hasSlopes(const PathObject &object, unsigned axis) noexcept {
  return axis >= kAxisA && axis <= kAxisC && (object.slopes >> (axis - kAxisA) & 1U) != 0;
}

/// Whether an axis that moves goes by an S profile.
bool hasProfile(const PathObject &object) noexcept {
  const unsigned axes = object.start.axes | object.end.axes;
  for (unsigned i = 0; i < kAxes; ++i) {
    const bool isProfile = (object.start.sProfile >> i & 1U) != 0 && !hasSlopes(object, i);
    const bool moves = object.start.coordinate[i] != object.end.coordinate[i];
    if ((axes >> i & 1U) != 0 && isProfile && moves)
      return true;
  }
  return false;
}

/// Gives both parts the slopes of the whole at the cut, and moves the cut to where they lead.
void bendParts(const PathObject &object, const Cut &cut, double length, PathObject &first,
               PathObject &second) noexcept {
  for (unsigned i = kAxisA; i <= kAxisC; ++i) {
    if (!hasSlopes(object, i))
      continue;
    const unsigned n = i - kAxisA;
    const double even = (object.end.coordinate[i] - object.start.coordinate[i]) / length;
    const path::Progress more =
        path::bentBy(object.startSlope[n] - even, object.endSlope[n] - even, cut.part, length);
    first.end.coordinate[i] += more.f;
    second.start.coordinate[i] = first.end.coordinate[i];
    first.endSlope[n] = second.startSlope[n] = even + more.d1;
  }
}

/// The coordinates of the cut.
void place(const PathObject &object, const ObjectShape &shape, const Cut &cut,
           double (&coordinate)[kAxes]) noexcept {
  for (int32_t i = 0; i < kAxes; ++i) {
    const double from = object.start.coordinate[i];
    coordinate[i] = from + (object.end.coordinate[i] - from) * cut.part;
  }
  if (shape.measure != Measure::Space && shape.measure != Measure::Plane)
    return;
  Vector3 p = path::overParameter(shape.shape, cut.u).p;
  if (object.planar != 0) {
    const Vector3 way = placeOf(object.end) - placeOf(object.start);
    p = p + object.normal * (dot(way, object.normal) * cut.part);
  }
  coordinate[kAxisX] = p.x;
  coordinate[kAxisY] = p.y;
  coordinate[kAxisZ] = p.z;
}

bool isAt(const Position &position, const double (&coordinate)[kAxes]) noexcept {
  for (int32_t i = 0; i < kAxes; ++i)
    if (position.coordinate[i] != coordinate[i])
      return false;
  return true;
}

// ---- parameters

bool isOfCircle(MoveType type) noexcept {
  return type == MoveType::Clockwise || type == MoveType::Counterclockwise;
}
bool isOfEllipse(MoveType type) noexcept {
  return type == MoveType::EllipseClockwise || type == MoveType::EllipseCounterclockwise;
}

/// The curve that the ends and the parameters agree on, as parameters of the part from u to v.
void describeRound(const path::Shape &shape, double u, double v, PathObject &part) noexcept {
  part.shape[0] = dot(shape.v[0], part.planeX);
  part.shape[1] = dot(shape.v[0], part.planeY);
  if (isOfCircle(part.moveType)) {
    part.shape[2] = norm(shape.v[1]);
    part.shape[3] = dot(placeOf(part.start), part.normal);
  } else {
    const double main = norm(shape.v[1]);
    part.shape[2] = dot(shape.v[1], part.planeX) / main;
    part.shape[3] = dot(shape.v[1], part.planeY) / main;
    part.shape[4] = main;
    part.shape[5] = norm(shape.v[2]);
  }
  const double sweep = exact::fabs(shape.sweep) * (v - u) * kRadian;
  part.parameterRange[0] = (shape.angle + shape.sweep * u) * kRadian;
  part.parameterRange[1] = part.parameterRange[1] < 0.0 ? -sweep : sweep;
}

void describePolynomial(const path::Shape &shape, double u, double v, PathObject &part) noexcept {
  // The curve of a planar object is in the plane of its start.
  const Vector3 off = placeOf(part.start) - path::overParameter(shape, u).p;
  const Vector3 up = part.planar != 0 ? part.normal * dot(off, part.normal) : numeric::kZero;
  for (int k = 0; k < 6; ++k) {
    const Vector3 c = k == 0 ? shape.v[k] + up : shape.v[k];
    if (part.moveType == MoveType::Spline) {
      if (k < 4) {
        part.shape[k] = dot(c, part.planeX);
        part.shape[4 + k] = dot(c, part.planeY);
      }
      continue;
    }
    const double axes[] = {c.x, c.y, c.z};
    for (int axis = 0; axis < 3; ++axis) {
      const int at = axis * 6 + k;
      (at < 8 ? part.shape[at] : part.moreShape[at - 8]) = axes[axis];
    }
  }
  part.parameterRange[0] = u;
  part.parameterRange[1] = v;
}

void describe(const path::Shape &shape, double u, double v, PathObject &part) noexcept {
  if (isOfCircle(part.moveType) || isOfEllipse(part.moveType))
    describeRound(shape, u, v, part);
  else if (part.moveType == MoveType::Spline || part.moveType == MoveType::Spline3d)
    describePolynomial(shape, u, v, part);
}

// ---- what goes with the parts

void shareSwitches(const PathObject &object, double part, PathObject &first,
                   PathObject &second) noexcept {
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double at = object.switchPosition[i];
    if (object.switchId[i] == 0)
      continue;
    if (at <= part) {
      first.switchPosition[i] = at / part;
      second.switchId[i] = 0;
      second.switchPosition[i] = 0.0;
    } else {
      second.switchPosition[i] = (at - part) / (1.0 - part);
      first.switchId[i] = 0;
      first.switchPosition[i] = 0.0;
    }
  }
}

} // namespace

CutError splitObject(const PathObject &object, double way, PathObject &first,
                     PathObject &second) noexcept {
  ObjectShape shape{};
  if (shapeOf(object, shape) != ShapeError::None || !(shape.length > 0.0))
    return CutError::Shape;
  if (hasProfile(object))
    return CutError::Profile;
  if (!(way > 0.0 && way < shape.length))
    return CutError::Way;
  PathObject whole = object;
  completePlane(whole);
  const double part = way / shape.length;
  const bool isCurve = shape.measure == Measure::Space || shape.measure == Measure::Plane;
  const Cut cut{way, part, isCurve ? path::parameterAt(shape.shape, way) : part};
  double coordinate[kAxes];
  place(whole, shape, cut, coordinate);
  if (isAt(whole.start, coordinate) || isAt(whole.end, coordinate))
    return CutError::Way;
  first = whole;
  second = whole;
  for (int32_t i = 0; i < kAxes; ++i) {
    first.end.coordinate[i] = coordinate[i];
    second.start.coordinate[i] = coordinate[i];
  }
  bendParts(whole, cut, shape.length, first, second);
  describe(shape.shape, 0.0, cut.u, first);
  describe(shape.shape, cut.u, 1.0, second);
  first.length = way;
  second.length = shape.length - way;
  first.velocityEnd = whole.velocity;
  first.marks = whole.marks & static_cast<uint8_t>(~kEndMarks);
  second.marks = whole.marks & kEndMarks;
  shareSwitches(whole, part, first, second);
  return CutError::None;
}

CutError cutStart(PathObject &object, double way) noexcept {
  const uint8_t marks = object.marks;
  PathObject lost;
  const CutError error = splitObject(object, way, lost, object);
  object.marks = marks;
  return error;
}

CutError cutEnd(PathObject &object, double way) noexcept {
  ObjectShape shape{};
  if (shapeOf(object, shape) != ShapeError::None)
    return CutError::Shape;
  if (!(way > 0.0))
    return CutError::Way;
  const double velocityEnd = object.velocityEnd;
  const uint8_t marks = object.marks;
  PathObject lost;
  const CutError error = splitObject(object, shape.length - way, object, lost);
  object.velocityEnd = velocityEnd;
  object.marks = marks;
  return error;
}

} // namespace stride::cnc
