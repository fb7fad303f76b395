// What an object of a CNC path looks like in space, and how long it is. Objects say the same thing
// twice, by their ends and by their parameters; shapes begin and end exactly at the ends, so that a
// path stays in one piece, and follow the parameters in between. Free of the C++ standard library:
// linked into every application.
// Source: SoftMotion V2.3 manual, sections 6.2.8 and 6.6.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_SHAPE_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_SHAPE_HPP

#include "runtime/numeric/cnc/path_object.hpp"
#include "runtime/numeric/path/shape.hpp"

namespace stride::cnc {

/// What is wrong with an object's geometry.
enum class ShapeError : uint8_t {
  None,
  Kind,      ///< No MoveType.
  NotFinite, ///< NaN or infinite, or too large to be measured.
  Radius,    ///< Of a circle: not positive.
  Axis,      ///< Of an ellipse: one half axis not positive, or no direction.
  Frame,     ///< The plane's vectors are not of length 1 or not at right angles.
  Ends,      ///< The ends lie beside the curve that the parameters describe.
};

/// What an object's length is.
enum class Measure : uint8_t {
  Space,     ///< Way in X, Y, Z.
  Plane,     ///< Way in the plane (PathObject::planar).
  Normal,    ///< Way out of the plane, of an object that is planar and does not move there.
  OtherAxes, ///< Way in A to W, of an object that does not move in X, Y, Z.
  Nothing,   ///< It has none, and length 0.
};

/// An object in space. Axes that the shape does not know go along evenly with its length.
struct ObjectShape {
  path::Shape shape; ///< Of length 0 where `measure` is Normal or OtherAxes.
  double length;     ///< [u]
  Measure measure;
};

/// Describes the object. With ShapeError::Ends, `result` is the curve of the parameters; with
/// another error it is nothing.
ShapeError shapeOf(const PathObject &object, ObjectShape &result) noexcept;

/// The same without measuring curves, which takes time: lengths are not right there, but 0 where
/// they should be. For directions.
ShapeError outlineOf(const PathObject &object, ObjectShape &result) noexcept;

/// Direction of the motion at the start and at the end, of length 1; 0 if it does not move in X, Y,
/// Z. Where a curve begins or ends at a standstill of its parameter, the direction next to it.
Vector3 tangentAtStart(const ObjectShape &shape) noexcept;
Vector3 tangentAtEnd(const ObjectShape &shape) noexcept;
/// The same of a shape that has a length, where overParameter() of 0 or 1 is known.
Vector3 directionAtStart(const path::Derivatives &start) noexcept;
Vector3 directionAtEnd(const path::Derivatives &end) noexcept;

/// The place in X, Y and Z.
Vector3 placeOf(const Position &position) noexcept;

/// Writes the plane of X and Y into an object whose plane says nothing but zeros.
void completePlane(PathObject &object) noexcept;

/// The normal of its plane.
Vector3 normalOf(const PathObject &object) noexcept;

/// Sets X, Y, Z of the end as the parameters say. What the parameters do not say stays: the end of
/// lines, and of flat curves the way out of their plane.
ShapeError calculateEnd(PathObject &object) noexcept;

/// The same for the start.
ShapeError calculateStart(PathObject &object) noexcept;

/// Sets PathObject::length; to 0 if there is an error. Ends beside the curve are none here.
ShapeError calculateLength(PathObject &object) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_SHAPE_HPP
