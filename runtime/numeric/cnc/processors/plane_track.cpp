#include "runtime/numeric/cnc/processors/plane_track.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;
using numeric::norm;

constexpr double kRadian = 57.29577951308232; ///< [degrees]
/// How far planes may be off.
constexpr double kSlack = 1e-9;

bool areNear(const Vector3 &a, const Vector3 &b, double slack) noexcept {
  return exact::fabs(a.x - b.x) <= slack && exact::fabs(a.y - b.y) <= slack &&
         exact::fabs(a.z - b.z) <= slack;
}

Vector3 flat(const Vector3 &v, const Plane &plane) noexcept {
  return {dot(v, plane.x), dot(v, plane.y), 0.0};
}

Vector3 unit(const Vector3 &v) noexcept {
  const double length = exact::sqrt(dot(v, v));
  return length > 0.0 ? v * (1.0 / length) : numeric::kZero;
}

Vector3 directionAt(const Track &track, double u) noexcept {
  if (!(track.shape.length > 0.0))
    return numeric::kZero;
  if (track.shape.kind == path::ShapeKind::Line)
    return unit(track.shape.v[1]);
  const path::Derivatives d = path::overParameter(track.shape, u);
  // Where the parameter stands still: the direction next to there.
  const Vector3 choices[] = {d.d1, u > 0.5 ? -d.d2 : d.d2, d.d3};
  for (const Vector3 &choice : choices)
    if (norm(choice) > kSlack * track.shape.length)
      return unit(choice);
  return numeric::kZero;
}

void describeArc(PathObject &object, const Plane &plane, const path::Shape &shape, double from,
                 double to) noexcept {
  const bool clockwise = shape.sweep < 0.0;
  object.moveType = clockwise ? MoveType::Clockwise : MoveType::Counterclockwise;
  object.shape[0] = shape.v[0].x;
  object.shape[1] = shape.v[0].y;
  object.shape[2] = norm(shape.v[1]);
  object.shape[3] = dot(placeOf(object.start), plane.normal);
  const double sweep = exact::fabs(shape.sweep) * (to - from) * kRadian;
  object.parameterRange[0] = (shape.angle + shape.sweep * from) * kRadian;
  object.parameterRange[1] = clockwise ? sweep : -sweep;
}

void describeEllipse(PathObject &object, const path::Shape &shape, double from,
                     double to) noexcept {
  const double sweep = exact::fabs(shape.sweep) * (to - from) * kRadian;
  const double main = norm(shape.v[1]);
  object.moveType =
      shape.sweep < 0.0 ? MoveType::EllipseClockwise : MoveType::EllipseCounterclockwise;
  object.shape[0] = shape.v[0].x;
  object.shape[1] = shape.v[0].y;
  object.shape[2] = shape.v[1].x / main;
  object.shape[3] = shape.v[1].y / main;
  object.shape[4] = main;
  object.shape[5] = norm(shape.v[2]);
  object.parameterRange[0] = (shape.angle + shape.sweep * from) * kRadian;
  object.parameterRange[1] = shape.sweep < 0.0 ? sweep : -sweep;
}

/// A cubic; polynomials of higher degree stay SPLINE3D_5.
void describePolynomial(PathObject &object, const Plane &plane, const path::Shape &shape,
                        double from, double to) noexcept {
  const bool isCubic =
      shape.v[4].x == 0.0 && shape.v[4].y == 0.0 && shape.v[5].x == 0.0 && shape.v[5].y == 0.0;
  object.moveType = isCubic ? MoveType::Spline : MoveType::Spline3d;
  object.parameterRange[0] = from;
  object.parameterRange[1] = to;
  // Out of the plane evenly, from end to end.
  const double low = dot(placeOf(object.start), plane.normal);
  const double slope = (dot(placeOf(object.end), plane.normal) - low) / (to - from);
  const double heights[] = {low - slope * from, slope, 0.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < 6; ++k) {
    if (isCubic) {
      if (k < 4) {
        object.shape[k] = shape.v[k].x;
        object.shape[4 + k] = shape.v[k].y;
      }
      continue;
    }
    const Vector3 c = plane.x * shape.v[k].x + plane.y * shape.v[k].y + plane.normal * heights[k];
    const double axes[] = {c.x, c.y, c.z};
    for (int axis = 0; axis < 3; ++axis) {
      const int at = axis * 6 + k;
      (at < 8 ? object.shape[at] : object.moreShape[at - 8]) = axes[axis];
    }
  }
}

/// The length of an object in space, whose way in the plane is known.
double lengthWith(const PathObject &object, const Plane &plane, double way) noexcept {
  if (object.planar != 0)
    return way;
  const double climb = dot(placeOf(object.end) - placeOf(object.start), plane.normal);
  return climb == 0.0 ? way : norm({way, climb, 0.0});
}

} // namespace

Plane planeOf(const PathObject &object) noexcept {
  const bool isNone = object.planeX.x == 0.0 && object.planeX.y == 0.0 && object.planeX.z == 0.0 &&
                      object.normal.x == 0.0 && object.normal.y == 0.0 && object.normal.z == 0.0;
  if (isNone)
    return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  return {object.planeX, object.planeY, object.normal};
}

bool isSamePlane(const Plane &a, const Plane &b) noexcept {
  return areNear(a.x, b.x, kSlack) && areNear(a.y, b.y, kSlack) &&
         areNear(a.normal, b.normal, kSlack);
}

TrackError trackOf(const PathObject &object, const Plane &plane, Track &track) noexcept {
  ObjectShape shape{};
  if (outlineOf(object, shape) != ShapeError::None)
    return TrackError::Geometry;
  track.shape = shape.shape;
  path::Shape &own = track.shape;
  const bool isLine = own.kind == path::ShapeKind::Line;
  if (!isLine && !isSamePlane(planeOf(object), plane))
    return TrackError::Plane;
  if (own.kind == path::ShapeKind::Arc && shape.shape.kind == path::ShapeKind::Arc &&
      (object.moveType == MoveType::EllipseClockwise ||
       object.moveType == MoveType::EllipseCounterclockwise))
    own.kind = path::ShapeKind::Ellipse; // outlines of both are made alike
  const int vectors = isLine ? 2 : 6;
  for (int k = 0; k < vectors; ++k)
    own.v[k] = flat(own.v[k], plane);
  if (own.kind == path::ShapeKind::Arc || own.kind == path::ShapeKind::Ellipse)
    own.v[3] = numeric::kZero;
  if (isLine)
    own.length = exact::sqrt(dot(own.v[1], own.v[1]));
  return exact::isfinite(own.length) ? TrackError::None : TrackError::Geometry;
}

Track lineTrack(const Vector3 &start, const Vector3 &end) noexcept {
  return {path::lineShape(start, end)};
}

Vector3 placeOn(const Track &track, double u) noexcept {
  if (track.shape.kind == path::ShapeKind::Line)
    return track.shape.v[0] + track.shape.v[1] * u;
  return path::overParameter(track.shape, u).p;
}

Vector3 directionAtStart(const Track &track) noexcept { return directionAt(track, 0.0); }
Vector3 directionAtEnd(const Track &track) noexcept { return directionAt(track, 1.0); }

bool isFreeForm(const Track &track) noexcept {
  return track.shape.kind == path::ShapeKind::Ellipse ||
         track.shape.kind == path::ShapeKind::Polynomial;
}

Vector3 inPlane(const Position &position, const Plane &plane) noexcept {
  return flat(placeOf(position), plane);
}

void moveInPlane(Position &position, const Plane &plane, const Vector3 &place) noexcept {
  const double height = dot(placeOf(position), plane.normal);
  const Vector3 p = plane.x * place.x + plane.y * place.y + plane.normal * height;
  position.coordinate[kAxisX] = p.x;
  position.coordinate[kAxisY] = p.y;
  position.coordinate[kAxisZ] = p.z;
}

void follow(PathObject &object, const Plane &plane, const Track &track, double from,
            double to) noexcept {
  moveInPlane(object.start, plane, placeOn(track, from));
  moveInPlane(object.end, plane, placeOn(track, to));
  object.planeX = plane.x;
  object.planeY = plane.y;
  object.normal = plane.normal;
  const path::Shape &shape = track.shape;
  switch (shape.kind) {
  case path::ShapeKind::Line:
    if (object.moveType != MoveType::Positioning)
      object.moveType = MoveType::Line;
    object.length = lengthWith(object, plane, norm(shape.v[1]) * (to - from));
    return;
  case path::ShapeKind::Arc:
    describeArc(object, plane, shape, from, to);
    object.length =
        lengthWith(object, plane, object.shape[2] * exact::fabs(shape.sweep) * (to - from));
    return;
  case path::ShapeKind::Ellipse:
    describeEllipse(object, shape, from, to);
    break;
  case path::ShapeKind::Polynomial:
    describePolynomial(object, plane, shape, from, to);
    break;
  }
  (void)calculateLength(object);
}

void keepSwitches(PathObject &object, double from, double to) noexcept {
  if ((from == 0.0 && to == 1.0) || object.moveType == MoveType::Function || !(to > from))
    return;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    if (object.switchId[i] == 0)
      continue;
    const double at = (object.switchPosition[i] - from) / (to - from);
    object.switchPosition[i] = at < 0.0 ? 0.0 : at > 1.0 ? 1.0 : at;
  }
}

void takeSwitches(PathObject &object, const PathObject &vanishing, double at) noexcept {
  if (vanishing.moveType == MoveType::Function || object.moveType == MoveType::Function)
    return;
  for (int32_t i = 0; i <= kMostSwitches; ++i)
    for (int32_t free = 0; vanishing.switchId[i] != 0 && free <= kMostSwitches; ++free)
      if (object.switchId[free] == 0) {
        object.switchId[free] = vanishing.switchId[i];
        object.switchPosition[free] = at;
        break;
      }
}

PathObject linkTo(const Position &from, const PathObject &like, const Plane &plane,
                  const Vector3 &place) noexcept {
  PathObject link = like;
  link.moveType = MoveType::Line;
  link.start = from;
  link.end = from;
  link.marks = 0;
  link.probe = 0;
  link.slopes = 0;
  link.velocityEnd = like.velocity;
  for (int32_t i = 0; i <= kMostSwitches; ++i) {
    link.switchId[i] = 0;
    link.switchPosition[i] = 0.0;
  }
  follow(link, plane, lineTrack(inPlane(from, plane), place), 0.0, 1.0);
  return link;
}

} // namespace stride::cnc
