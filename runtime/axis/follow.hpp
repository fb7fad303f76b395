// For blocks that are given set values, not a target: writing them, with what follows from them.
#ifndef STRIDE_RUNTIME_AXIS_FOLLOW_HPP
#define STRIDE_RUNTIME_AXIS_FOLLOW_HPP

#include "runtime/axis/motion_block.hpp"
#include "runtime/numeric/motion_state.hpp"

#include "st/SM_DriveBasic/SMC_FOLLOW_STATE.h"

namespace stride::motion {

using FollowState = ::st::SM_DriveBasic::SMC_FOLLOW_STATE;

/// Takes the axis for a block whose set values start from the present ones: state
/// synchronized_motion, no plan, nothing waiting.
void beginFollowing(FollowState &follow, BlockState &block, AxisRef &ref) noexcept;

/// The same for a block to which the axis has been given already.
void startFollowing(FollowState &follow, AxisRef &ref) noexcept;

/// First in every cycle: the last set position keeps its place when the zero point has been
/// shifted.
void alignFollowing(FollowState &follow, const AxisRef &ref) noexcept;

/// The way from the last set position to `position`; on a rotary axis the shorter one. [u]
double wayTo(const FollowState &follow, const AxisRef &ref, double position) noexcept;

/// Writes this cycle's set values: `position`, `way` [u] away from the last one, with `velocity`
/// [u/s]. The acceleration follows from the last velocity.
void followStep(FollowState &follow, AxisRef &ref, double position, double way,
                double velocity) noexcept;

/// Writes `state`, which is `way` [u] away from the last position.
void followState(FollowState &follow, AxisRef &ref, const numeric::MotionState &state,
                 double way) noexcept;

} // namespace stride::motion

#endif
