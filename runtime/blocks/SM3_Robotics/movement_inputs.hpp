// What the blocks that move a group have in common: their inputs, as a request says them.
#ifndef STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_MOVEMENT_INPUTS_HPP
#define STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_MOVEMENT_INPUTS_HPP

#include "runtime/blocks/SM3_Robotics/group_block.hpp"

namespace stride::robotics {

/// Which limits count in a corner, by MC_BUFFER_MODE.
group::CornerSpeed cornerSpeedOf(int16_t bufferMode) noexcept;

/// By MC_BUFFER_MODE and MC_TRANSITION_MODE: only modes that blend make corners.
group::Transition transitionOf(int16_t bufferMode, int16_t transition) noexcept;

/// CoordSystem, BufferMode, transition, factors, and the axes that go along.
template <class Block> void fillModes(const Block &block, Request &request) noexcept {
  request.system = block.CoordSystem;
  request.bufferMode = block.BufferMode;
  request.transitionMode = block.TransitionMode;
  request.order.transition = transitionOf(block.BufferMode, block.TransitionMode);
  request.order.transitionValue = block.TransitionParameter.v[0];
  request.order.cornerSpeed = cornerSpeedOf(block.BufferMode);
  request.order.velocityFactor = block.VelFactor;
  request.order.accelerationFactor = block.AccFactor;
  request.order.jerkFactor = block.JerkFactor;
  request.torqueFactor = block.TorqueFactor;
  request.moreMode = block.AdditionalAxes.Mode;
  static_assert(sizeof request.more == sizeof block.AdditionalAxes.Values);
  __builtin_memcpy(request.more, &block.AdditionalAxes.Values, sizeof request.more);
}

/// How the tool turns on its way.
template <class Block> void fillOrientation(const Block &block, Request &request) noexcept {
  request.orientationMode = block.OrientationMode;
}

/// What limits the tool along its path.
template <class Block> void fillPath(const Block &block, Request &request) noexcept {
  request.order.path = {block.Velocity, block.Acceleration, block.Deceleration, block.Jerk};
}

inline void fillCoordinates(const ::st::SM3_Robotics::SMC_POS_REF &position,
                            double (&coordinates)[kArmAxes]) noexcept {
  static_assert(sizeof position == sizeof coordinates);
  __builtin_memcpy(coordinates, &position, sizeof coordinates);
}

} // namespace stride::robotics

#endif // STRIDE_RUNTIME_BLOCKS_SM3_ROBOTICS_MOVEMENT_INPUTS_HPP
