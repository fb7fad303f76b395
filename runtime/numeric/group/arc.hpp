// The arcs that circular movements name: by a place on the way, by a centre, by a radius. Free of
// the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_ARC_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_ARC_HPP

#include "runtime/numeric/group/leg.hpp"

namespace stride::group {

/// Why there is no such arc.
enum class ArcFault : uint8_t {
  None,
  Collinear,   ///< The places lie in a line, or two of them are one: there is no plane.
  OffBisector, ///< The centre is not equally far from both ends, or the vector not at right angles.
  NoRadius,    ///< The radius is 0.
  ChordTooLong, ///< The ends are further apart than two radii.
  SameEnds      ///< Start and end are the same place.
};

/// Which of the two arcs of a circle between its ends, seen with a vector at right angles to its
/// plane that points to the viewer.
enum class ArcWay : uint8_t { Clockwise, CounterClockwise };

/// From `start` through `border` to `end`.
ArcFault arcThrough(const Vector3 &start, const Vector3 &border, const Vector3 &end,
                    Arc &arc) noexcept;

/// About `centre`. The vector is (start - centre) x (end - centre): counter-clockwise is the
/// shorter way.
ArcFault arcAbout(const Vector3 &start, const Vector3 &centre, const Vector3 &end, ArcWay way,
                  Arc &arc) noexcept;

/// `normal` stands at right angles to the plane and is as long as the radius. Seen against it, the
/// centre is on the left of the way from start to end, so that counter-clockwise (right-handed
/// about the vector) is the shorter way. The other arcs are those of the opposite vector.
ArcFault arcWithNormal(const Vector3 &start, const Vector3 &normal, const Vector3 &end, ArcWay way,
                       Arc &arc) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_ARC_HPP
