// Two objects of a path at their corner, and the object that is put between them when both are cut
// there. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_MEETING_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_MEETING_HPP

#include "runtime/numeric/cnc/object_shape.hpp"
#include "runtime/numeric/cnc/path_object.hpp"

namespace stride::cnc {

/// Both objects at their corner.
struct Meeting {
  path::Shape before;
  path::Shape after;
  double lengthBefore; ///< ObjectShape::length of both, and
  double lengthAfter;  ///< [u]
  Measure measure;     ///< its measure.
  Vector3
      lift; ///< Of planar objects: what leads from the plane of the second to that of the first.
  Vector3 place; ///< The corner, in the plane of the first.
  double sine;   ///< Of the angle by which the path turns, and
  double cosine; ///< its cosine.
  double feed;   ///< The smaller velocity of both. [u/s]
};

/// Describes the corner where `before` ends and `after` begins. False: one of them is a rapid
/// motion, no motion in space, ends at a probe or has a shape that is wrong, or their lengths are
/// of different kinds.
bool meet(const PathObject &before, const PathObject &after, Meeting &meeting) noexcept;
/// The same with what describeAtCorner() says of both.
bool meet(const PathObject &before, const ObjectShape &first, const PathObject &after,
          const ObjectShape &second, Meeting &meeting) noexcept;

/// The angle by which the path turns, 0 to pi. [rad]
double turnOf(const Meeting &meeting) noexcept;

/// Whether an angle of 0 to pi is greater than another one, 0 to pi, without calculating it where
/// that is plain. [rad] in
bool isTurnAbove(double sine, double cosine, double angle) noexcept;

/// The shape of an object that may have a corner with others. False: it may not.
bool describeAtCorner(const PathObject &object, ObjectShape &shape) noexcept;

/// Place and derivatives over the arc length, at a way from the start. [u] in
path::Derivatives derivativesAt(const path::Shape &shape, double way) noexcept;
/// The same at a parameter.
path::Derivatives derivativesOver(const path::Shape &shape, double u) noexcept;

/// How far A (0), B (1) or C (2) goes over the way at an end of an object. [u/u]
double slopeAt(const PathObject &object, int32_t angle, bool atEnd) noexcept;

/// An object between the end of `before` and the start of `after`, without a shape. It has the
/// smaller velocities, accelerations and limits of both, and the numbers of the first. Axes besides
/// X, Y, Z go along evenly; A, B and C by the slopes of both, where one of them goes by slopes. It
/// has no marks and no switch points.
void beginPiece(const PathObject &before, const PathObject &after, PathObject &piece) noexcept;

/// Lets it go along a polynomial (MoveType::Spline3d).
void describePiece(const path::Shape &curve, PathObject &piece) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_MEETING_HPP
