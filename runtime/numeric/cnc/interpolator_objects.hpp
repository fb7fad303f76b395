// For the sources of the interpolator: the objects ahead, and how the motion gets to know them.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_INTERPOLATOR_OBJECTS_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_INTERPOLATOR_OBJECTS_HPP

#include "runtime/numeric/cnc/interpolator.hpp"
#include "runtime/numeric/cnc/object_shape.hpp"

namespace stride::cnc {

inline bool isFunction(const PathObject &object) noexcept {
  return object.moveType == MoveType::Function;
}
inline bool isJump(const PathObject &object) noexcept { return object.moveType == MoveType::Jump; }
inline bool waitsAt(const PathObject &object) noexcept {
  return isFunction(object) || isJump(object);
}

/// Ends the path with an SMC_ERROR, at once.
void fail(Interpolator &interpolator, int16_t error) noexcept;

/// What an object is to a motion; of length 0 if it goes nowhere. Ends beside the curve are no
/// error here.
ShapeError describeSegment(const PathObject &object, path::Segment &segment) noexcept;

/// The segment of an object. False: it goes nowhere. An object without a meaning ends the path.
bool segmentOf(Interpolator &interpolator, const PathObject &object,
               path::Segment &segment) noexcept;

/// The n-th object from the present one on; null: there is none. One that is gone back is put into
/// `room`; it ends with the velocity with which the one before it does.
const PathObject *ahead(const Interpolator &interpolator, const Command &command, int64_t n,
                        PathObject &room) noexcept;

/// How many there are from the present one on.
int64_t countAhead(const Interpolator &interpolator, const Command &command) noexcept;

/// How many of these have been checked, so that the velocity at the end of each but the last one is
/// known.
int64_t checkedAhead(const Interpolator &interpolator, const Command &command) noexcept;

/// Whether more objects may come after the last one. To be asked before the objects are counted.
bool isOpen(const Interpolator &interpolator, const Command &command) noexcept;

/// Greatest velocity of a dry run; infinite if there is none.
double dryRunVelocity(const Command &command) noexcept;

/// Makes as much of the path known to the motion as it has room for, and this call has time for.
void makeKnown(Interpolator &interpolator, const Command &command) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_INTERPOLATOR_OBJECTS_HPP
