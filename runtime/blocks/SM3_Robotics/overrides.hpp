// What MC_GroupSetOverride and the ancillary limits leave of a group's limits.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_OVERRIDES_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_OVERRIDES_HPP

#include "runtime/blocks/SM3_Robotics/group.hpp"

namespace stride::robotics {

/// The factor of velocities that counts for what the group has of its path now: along the tool's
/// path also that of the path, and what an ancillary limit makes of the commands' velocities.
double overrideOf(const GroupRef &group) noexcept;

/// What counts for parts of the path that are made known.
group::Allowance allowanceOf(const GroupRef &group) noexcept;

/// The factors of axes' limits for movements that are commanded now.
group::AxisShares sharesOf(const GroupRef &group) noexcept;

/// An axis that comes into the group has no factors yet.
void resetShares(GroupRef &group, int32_t axis) noexcept;

/// The axes after number `axis`, which leaves, move up.
void removeShares(GroupRef &group, int32_t axis) noexcept;

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_OVERRIDES_HPP
