// For the sources of group motions: what is made known of the movements to the planner.
#ifndef STRIDE_RUNTIME_NUMERIC_GROUP_PATH_MAKING_HPP
#define STRIDE_RUNTIME_NUMERIC_GROUP_PATH_MAKING_HPP

#include "runtime/numeric/group/group_motion.hpp"

namespace stride::group {

inline Movement &movementAt(GroupMotion &group, int64_t number) noexcept {
  return group.movement[static_cast<uint64_t>(number) % kMovements];
}
inline const Movement &movementAt(const GroupMotion &group, int64_t number) noexcept {
  return group.movement[static_cast<uint64_t>(number) % kMovements];
}

/// Way of the motion where the leg of a movement begins, after its corner. [u]
inline double legBegin(const Movement &movement) noexcept {
  return movement.begin + movement.corner.length;
}

/// Makes more of the path known, as far as there is room, and `samples` allow.
void makeKnown(GroupMotion &group, const Arm &arm, const Allowance &allowance,
               int32_t samples) noexcept;

} // namespace stride::group

#endif // STRIDE_RUNTIME_NUMERIC_GROUP_PATH_MAKING_HPP
