// I, J and K of curves.

#include "compiler/assets/cnc_edit/arc_words.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

namespace stc::gcode {

namespace {

using namespace stride::cnc;
using stride::numeric::dot;

/// Coefficient of t^k of X or Y.
double coefficient(const PathObject &object, int axis, int k) {
  if (object.moveType == MoveType::Spline)
    return object.shape[4 * axis + k];
  const int at = 6 * axis + k;
  return at < 8 ? object.shape[at] : object.moreShape[at - 8];
}

/// Of a polynomial of degree 2, where the tangents of the ends meet.
double meeting(const PathObject &object, int axis) {
  const double from = object.parameterRange[0];
  const double to = object.parameterRange[1];
  return coefficient(object, axis, 0) + coefficient(object, axis, 1) * (from + to) / 2 +
         coefficient(object, axis, 2) * from * to;
}

} // namespace

std::array<double, 3> centreWay(const PathObject &object) {
  const Vector3 start = placeOf(object.start);
  if (!isCircle(object.moveType) && !isEllipse(object.moveType))
    return {meeting(object, 0) - start.x, meeting(object, 1) - start.y, 0};
  const Vector3 way = object.planeX * (object.shape[0] - dot(start, object.planeX)) +
                      object.planeY * (object.shape[1] - dot(start, object.planeY));
  return {way.x, way.y, way.z};
}

} // namespace stc::gcode
