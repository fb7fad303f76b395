#include "runtime/numeric/cnc/object_cut.hpp"

#include "runtime/numeric/path/bend.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;
using numeric::norm;

constexpr double kRadian = 57.29577951308232; ///< [degrees]
constexpr uint8_t kEndMarks = kEndToolCorrection | kEndSmoothing | kEndAvoidLoops;

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

/// How far a planar object has left the plane of its start.
Vector3 liftAt(const PathObject &object, double part) noexcept {
  if (object.planar == 0)
    return numeric::kZero;
  const Vector3 normal = normalOf(object);
  const Vector3 way = placeOf(object.end) - placeOf(object.start);
  return normal * (dot(way, normal) * part);
}

/// The coordinates of the cut; in space those of the shape.
void place(const PathObject &object, const Vector3 *inSpace, ObjectCut &cut) noexcept {
  for (int32_t i = 0; i < kAxes; ++i) {
    const double from = object.start.coordinate[i];
    cut.coordinate[i] = from + (object.end.coordinate[i] - from) * cut.part;
  }
  if (inSpace == nullptr)
    return;
  const Vector3 p = *inSpace + liftAt(object, cut.part);
  cut.coordinate[kAxisX] = p.x;
  cut.coordinate[kAxisY] = p.y;
  cut.coordinate[kAxisZ] = p.z;
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

void clearSwitch(PathObject &part, int32_t i) noexcept {
  part.switchId[i] = 0;
  part.switchPosition[i] = 0.0;
}

/// Leaves the switch points that are in the first part, or in the second one.
void keepSwitches(PathObject &object, double part, bool inFirst) noexcept {
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    const double at = object.switchPosition[i];
    if (object.switchId[i] == 0)
      continue;
    if ((at <= part) != inFirst)
      clearSwitch(object, i);
    else
      object.switchPosition[i] = inFirst ? at / part : (at - part) / (1.0 - part);
  }
}

// ---- an object that is cut

/// Moves the cut to where slopes lead.
void bend(const PathObject &object, double length, ObjectCut &cut) noexcept {
  for (unsigned i = kAxisA; i <= kAxisC; ++i) {
    if (!hasSlopes(object, i))
      continue;
    const unsigned n = i - kAxisA;
    const double even = (object.end.coordinate[i] - object.start.coordinate[i]) / length;
    const path::Progress more =
        path::bentBy(object.startSlope[n] - even, object.endSlope[n] - even, cut.part, length);
    cut.coordinate[i] += more.f;
    cut.slope[n] = even + more.d1;
  }
}

/// Leaves what is after the cut, but for marks.
void leaveSecond(const ObjectCut &cut, const ObjectShape &shape, PathObject &part) noexcept {
  completePlane(part);
  for (int32_t i = 0; i < kAxes; ++i)
    part.start.coordinate[i] = cut.coordinate[i];
  for (unsigned i = kAxisA; i <= kAxisC; ++i)
    if (hasSlopes(part, i))
      part.startSlope[i - kAxisA] = cut.slope[i - kAxisA];
  describe(shape.shape, cut.u, 1.0, part);
  part.length = shape.length - cut.way;
  keepSwitches(part, cut.part, false);
}

CutError mayBeCut(const PathObject &object, const ObjectShape &shape, double way) noexcept {
  if (!(shape.length > 0.0))
    return CutError::Shape;
  if (hasProfile(object))
    return CutError::Profile;
  return way > 0.0 && way < shape.length ? CutError::None : CutError::Way;
}

CutError finishPlan(const PathObject &object, double length, const Vector3 *inSpace,
                    ObjectCut &cut) noexcept {
  place(object, inSpace, cut);
  if (isAt(object.start, cut.coordinate) || isAt(object.end, cut.coordinate))
    return CutError::Way;
  bend(object, length, cut);
  return CutError::None;
}

} // namespace

CutError planCut(const PathObject &object, const ObjectShape &shape, double way,
                 ObjectCut &cut) noexcept {
  const CutError error = mayBeCut(object, shape, way);
  if (error != CutError::None)
    return error;
  cut.way = way;
  cut.part = way / shape.length;
  cut.u = cut.part;
  if (shape.measure != Measure::Space && shape.measure != Measure::Plane)
    return finishPlan(object, shape.length, nullptr, cut);
  cut.u = path::parameterAt(shape.shape, way);
  const Vector3 inSpace = path::overParameter(shape.shape, cut.u).p;
  return finishPlan(object, shape.length, &inSpace, cut);
}

CutError planCut(const PathObject &object, const ObjectShape &shape, double way, double u,
                 const Vector3 &place, ObjectCut &cut) noexcept {
  const CutError error = mayBeCut(object, shape, way);
  if (error != CutError::None)
    return error;
  cut.way = way;
  cut.part = way / shape.length;
  cut.u = u;
  return finishPlan(object, shape.length, &place, cut);
}

void takeFirst(const ObjectCut &cut, const ObjectShape &shape, PathObject &part) noexcept {
  completePlane(part);
  for (int32_t i = 0; i < kAxes; ++i)
    part.end.coordinate[i] = cut.coordinate[i];
  for (unsigned i = kAxisA; i <= kAxisC; ++i)
    if (hasSlopes(part, i))
      part.endSlope[i - kAxisA] = cut.slope[i - kAxisA];
  describe(shape.shape, 0.0, cut.u, part);
  part.length = cut.way;
  keepSwitches(part, cut.part, true);
}

bool takeSecond(const ObjectCut &cut, ObjectShape &shape, PathObject &object) noexcept {
  const Vector3 lift = liftAt(object, cut.part);
  leaveSecond(cut, shape, object);
  const bool known = path::cutStart(shape.shape, cut.u);
  shape.shape.v[0] = shape.shape.v[0] + lift;
  shape.length = shape.shape.length;
  return known;
}

CutError splitObject(const PathObject &object, double way, PathObject &first,
                     PathObject &second) noexcept {
  ObjectShape shape{};
  if (shapeOf(object, shape) != ShapeError::None)
    return CutError::Shape;
  ObjectCut cut;
  const CutError error = planCut(object, shape, way, cut);
  if (error != CutError::None)
    return error;
  const PathObject whole = object; // which may be one of both
  first = whole;
  second = whole;
  takeFirst(cut, shape, first);
  leaveSecond(cut, shape, second);
  first.velocityEnd = whole.velocity;
  first.marks = whole.marks & static_cast<uint8_t>(~kEndMarks);
  second.marks = whole.marks & kEndMarks;
  return CutError::None;
}

CutError cutStart(PathObject &object, double way) noexcept {
  ObjectShape shape{};
  if (shapeOf(object, shape) != ShapeError::None)
    return CutError::Shape;
  ObjectCut cut;
  const CutError error = planCut(object, shape, way, cut);
  if (error == CutError::None)
    leaveSecond(cut, shape, object);
  return error;
}

CutError cutEnd(PathObject &object, double way) noexcept {
  ObjectShape shape{};
  if (shapeOf(object, shape) != ShapeError::None)
    return CutError::Shape;
  if (!(way > 0.0))
    return CutError::Way;
  ObjectCut cut;
  const CutError error = planCut(object, shape, shape.length - way, cut);
  if (error == CutError::None)
    takeFirst(cut, shape, object);
  return error;
}

} // namespace stride::cnc
