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

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_OVERRIDES_HPP
