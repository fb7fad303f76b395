// How far a group may be from its path in a coordinate system that moves.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TOLERANCE_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TOLERANCE_HPP

#include "runtime/blocks/SM3_Robotics/frames.hpp"

namespace stride::robotics {

/// Looks how far the group is behind the system that it follows. An SMC_ERROR if that is more than
/// allowed after the system had been reached.
int16_t lookAtLag(GroupRef &group, const GroupArm &arm);

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_TOLERANCE_HPP
