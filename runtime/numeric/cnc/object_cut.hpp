// Cuts objects of a path: the parts go where the whole went, in all axes. Free of the C++ standard
// library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_CUT_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_CUT_HPP

#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {

/// Why an object cannot be cut.
enum class CutError : uint8_t {
  None,
  Way,     ///< Not within the object: nothing would be left of one of its parts.
  Profile, ///< An axis goes by a law over the whole object: an S profile.
  Shape,   ///< It has no way, or its ends lie beside the curve that its parameters describe.
};

/// Cuts an object at a way from its start, 0 < way < length. The outer ends are those of the object
/// and the inner ones are the same, bit for bit. Where A, B or C goes by slopes, both parts go by
/// the slopes of the same cubic. Switch points stay where they are; one at the cut belongs to the
/// first part. Marks that begin something go with the first part, those that end something with the
/// second. The first part ends with the velocity of the object. With an error the parts are as they
/// were. Both may be the object itself. [u] in
CutError splitObject(const PathObject &object, double way, PathObject &first,
                     PathObject &second) noexcept;

/// Takes a way off the start or the end, with the switch points that are there. Marks and the end's
/// velocity stay. [u] in
CutError cutStart(PathObject &object, double way) noexcept;
CutError cutEnd(PathObject &object, double way) noexcept;

/// Where an object is to be cut.
struct ObjectCut {
  double way;               ///< From its start. [u]
  double part;              ///< The same as a part of the length.
  double u;                 ///< The same as the parameter of the shape.
  double coordinate[kAxes]; ///< There.
  double slope[3];          ///< Of A, B, C there, where they go by slopes.
};

/// The same in two steps, where it is known what shapeOf() says of the object: where the cut is,
/// and whether the object can be cut there. Then either take leaves what is before it or after it.
/// [u] in
CutError planCut(const PathObject &object, const ObjectShape &shape, double way,
                 ObjectCut &cut) noexcept;
/// The same of a shape in space or in a plane, whose parameter and place at this way are known.
CutError planCut(const PathObject &object, const ObjectShape &shape, double way, double u,
                 const Vector3 &place, ObjectCut &cut) noexcept;
void takeFirst(const ObjectCut &cut, const ObjectShape &shape, PathObject &object) noexcept;
/// Then shapeOf() of what is left is in `shape`, where that is quick to say (true).
bool takeSecond(const ObjectCut &cut, ObjectShape &shape, PathObject &object) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_OBJECT_CUT_HPP
