// Objects of a path as curves in a plane, in which tools are corrected and loops are found: what an
// object does out of the plane and with other axes goes along. Free of the C++ standard library:
// linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_PLANE_TRACK_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_PLANE_TRACK_HPP

#include "runtime/numeric/cnc/path_object.hpp"
#include "runtime/numeric/path/shape.hpp"

namespace stride::cnc {

/// A plane: two directions in it and the normal, of length 1 and at right angles.
struct Plane {
  Vector3 x, y, normal;
};

/// The plane that an object's arcs lie in; that of X and Y where only zeros say it.
Plane planeOf(const PathObject &object) noexcept;

/// Whether both are the same, with the same directions.
bool isSamePlane(const Plane &a, const Plane &b) noexcept;

/// A curve in a plane over a parameter from 0 to 1: `shape` in the coordinates of the plane, z = 0.
struct Track {
  path::Shape shape;
};

enum class TrackError : uint8_t {
  None,
  Geometry, ///< The object has no shape (cnc::ShapeError), or one whose ends lie beside it.
  Plane,    ///< A curve that lies in another plane.
};

/// The curve of an object; with length 0 if it does not move in the plane.
TrackError trackOf(const PathObject &object, const Plane &plane, Track &track) noexcept;

Track lineTrack(const Vector3 &start, const Vector3 &end) noexcept;

/// Place in the plane. 0 <= u <= 1
Vector3 placeOn(const Track &track, double u) noexcept;

/// Direction of motion at the start or the end, of length 1; 0 without a way.
Vector3 directionAtStart(const Track &track) noexcept;
Vector3 directionAtEnd(const Track &track) noexcept;

/// Whether it is an arc of an ellipse or a polynomial.
bool isFreeForm(const Track &track) noexcept;

/// The place of a position in the plane, and the same position at another one.
Vector3 inPlane(const Position &position, const Plane &plane) noexcept;
void moveInPlane(Position &position, const Plane &plane, const Vector3 &place) noexcept;

/// Makes the object go along the track from one parameter to another: its kind, its parameters, its
/// ends in the plane, its length. The other axes keep the values of its ends.
void follow(PathObject &object, const Plane &plane, const Track &track, double from,
            double to) noexcept;

/// What follow() does with switch points if an object becomes the part from `from` to `to` of its
/// length: those that were beside it come to its ends.
void keepSwitches(PathObject &object, double from, double to) noexcept;

/// An object takes over the switch points of one that vanishes, at its end (1) or start (0). What
/// has no room is lost.
void takeSwitches(PathObject &object, const PathObject &vanishing, double at) noexcept;

/// A line in the plane from one place to another, with the velocities and numbers of `like`,
/// without marks and switch points. The other axes stay.
PathObject linkTo(const Position &from, const PathObject &like, const Plane &plane,
                  const Vector3 &place) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_PLANE_TRACK_HPP
