#include "runtime/numeric/cnc/processors/transform.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/quarter_turns.hpp"

namespace stride::cnc {
namespace {

using numeric::dot;
using numeric::Turn;
using numeric::turnOf;

void turn(const Turn &by, double &x, double &y) noexcept {
  const double before = x;
  x = by.c * before - by.s * y;
  y = by.s * before + by.c * y;
}

/// A coefficient of a curve in space.
double &coefficient(PathObject &object, int axis, int power) noexcept {
  const int at = axis * 6 + power;
  return at < 8 ? object.shape[at] : object.moreShape[at - 8];
}

/// Whether parameters are those of X and Y.
bool isPlain(const PathObject &object) noexcept {
  return object.planeX.x == 1.0 && object.planeY.y == 1.0 && object.normal.z == 1.0;
}

/// Turns what the parameters of a curve in the plane of X and Y say, as V2.3 reads them.
void rotateParameters(PathObject &object, const Turn &by, double degrees) noexcept {
  if (object.moveType == MoveType::Spline) {
    for (int k = 0; k < 4; ++k)
      turn(by, object.shape[k], object.shape[4 + k]);
    return;
  }
  turn(by, object.shape[0], object.shape[1]);
  if (isCircle(object.moveType)) {
    object.parameterRange[0] += degrees;
  } else {
    turn(by, object.shape[2], object.shape[3]);
    object.shape[6] += degrees;
  }
}

} // namespace

void rotateObject(PathObject &object, double degrees) noexcept {
  const Turn by = turnOf(degrees);
  completePlane(object);
  turn(by, object.start.coordinate[kAxisX], object.start.coordinate[kAxisY]);
  turn(by, object.end.coordinate[kAxisX], object.end.coordinate[kAxisY]);
  if (object.moveType == MoveType::Spline3d) {
    for (int k = 0; k < 6; ++k)
      turn(by, coefficient(object, 0, k), coefficient(object, 1, k));
  }
  if (!isPlain(object)) {
    turn(by, object.planeX.x, object.planeX.y);
    turn(by, object.planeY.x, object.planeY.y);
    turn(by, object.normal.x, object.normal.y);
  } else if (isCircle(object.moveType) || isEllipse(object.moveType) ||
             object.moveType == MoveType::Spline) {
    rotateParameters(object, by, degrees);
  }
}

void translateObject(PathObject &object, const Vector3 &way) noexcept {
  completePlane(object);
  const double ways[] = {way.x, way.y, way.z};
  for (int axis = 0; axis < 3; ++axis) {
    object.start.coordinate[axis] += ways[axis];
    object.end.coordinate[axis] += ways[axis];
    if (object.moveType == MoveType::Spline3d)
      coefficient(object, axis, 0) += ways[axis];
  }
  if (isCircle(object.moveType) || isEllipse(object.moveType) ||
      object.moveType == MoveType::Spline) {
    object.shape[0] += dot(way, object.planeX);
    object.shape[object.moveType == MoveType::Spline ? 4 : 1] += dot(way, object.planeY);
  }
  if (isCircle(object.moveType))
    object.shape[3] += dot(way, object.normal);
}

void scaleObject(PathObject &object, double factor) noexcept {
  const double size = exact::fabs(factor);
  bool moves = isCurve(object.moveType);
  for (int axis = 0; axis < 3; ++axis) {
    moves = moves || object.start.coordinate[axis] != object.end.coordinate[axis];
    object.start.coordinate[axis] *= factor;
    object.end.coordinate[axis] *= factor;
  }
  if (isCircle(object.moveType) || isEllipse(object.moveType)) {
    object.shape[0] *= factor;
    object.shape[1] *= factor;
    if (factor < 0.0)
      object.parameterRange[0] += 180.0;
  }
  if (isCircle(object.moveType)) {
    object.shape[2] *= size;
    object.shape[3] *= factor;
  } else if (isEllipse(object.moveType)) {
    object.shape[4] *= size;
    object.shape[5] *= size;
  } else if (isCurve(object.moveType)) {
    for (double &value : object.shape)
      value *= factor;
    for (double &value : object.moreShape)
      value *= factor;
  }
  if (!moves)
    return;
  object.length *= size;
  for (int axis = 0; axis < 3; ++axis) {
    object.startSlope[axis] /= size;
    object.endSlope[axis] /= size;
  }
}

bool isUsable(const Transform &transform) noexcept {
  const Vector3 &value = transform.value;
  return exact::isfinite(value.x) && exact::isfinite(value.y) && exact::isfinite(value.z) &&
         (transform.kind != TransformKind::Scale || value.x != 0.0);
}

void apply(const Transform &transform, PathObject &object) noexcept {
  switch (transform.kind) {
  case TransformKind::Rotate:
    rotateObject(object, transform.value.x);
    break;
  case TransformKind::Translate:
    translateObject(object, transform.value);
    break;
  case TransformKind::Scale:
    scaleObject(object, transform.value.x);
    break;
  }
}

void transformInPlace(Queue *queue, const Transform &transform, uint32_t &seen) noexcept {
  const uint32_t count = countOf(queue);
  for (uint32_t n = count - appendedSince(queue, seen); n < count; ++n)
    apply(transform, *objectAt(queue, n));
  seen = queue->writePosition;
}

Step next(TransformPath &path, const Source &source, Output &output) noexcept {
  if (!isUsable(path.used)) {
    output.error = StreamError::InvalidParameter;
    return Step::Failed;
  }
  PathObject *object = put(output, source.object);
  if (object == nullptr)
    return Step::Again;
  apply(path.used, *object);
  return Step::Took;
}

} // namespace stride::cnc
