// Triggers: places on movements whose time is asked for. Free of the C++ standard library: linked
// into every application.
//
// A place is a way along the movement's leg. What a corner cuts off is mapped onto it by length:
// the end of the first leg onto its first half, the start of the second leg onto its second half.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_TRIGGER_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_TRIGGER_HPP

#include "runtime/numeric/group/group_motion.hpp"

namespace stride::group {

/// The points whose product with `normal` is `distance`. [u]
struct Plane {
  Vector3 normal; ///< Of length 1.
  double distance;
};

/// Where a leg is in a plane for the first time [u]; negative: nowhere. Where the axes lead, and
/// where the tool's point stays, places are compared at 256 ways: a plane that the path only
/// touches, or passes twice between two of these, may be missed.
double wayInPlane(const Arm &arm, const Leg &leg, const Plane &plane) noexcept;

/// Where on the motion's way a place of a movement lies that has been appended; negative: that is
/// not decided yet. [u]
double wayOf(const GroupMotion &group, uint64_t movement, double along) noexcept;

/// The time until the group is at a way of its motion; kInfinity: not known. To be asked between
/// planning and going on in a cycle, for the time since its start. [s]
double timeTo(const GroupMotion &group, double way) noexcept;

/// How much of the time ahead is planned and stays so. [s]
double plannedTime(const GroupMotion &group) noexcept;

/// The next rest of the group: when [s] and which movement ends there. Time kInfinity: not known.
struct GroupRest {
  double time;
  uint64_t movement;
};
GroupRest nextRest(const GroupMotion &group) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_TRIGGER_HPP
