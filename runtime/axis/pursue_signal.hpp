// An axis after a master or a signal of the program, within limits.
#ifndef STRIDE_RUNTIME_AXIS_PURSUE_SIGNAL_HPP
#define STRIDE_RUNTIME_AXIS_PURSUE_SIGNAL_HPP

#include "runtime/axis/follow.hpp"
#include "runtime/axis/gear.hpp"
#include "runtime/axis/master.hpp"
#include "runtime/axis/plan_axis.hpp"

#include "st/SM_PLCopen/SMC_PURSUIT_STATE.h"

namespace stride::motion {

using PursuitState = ::st::SM_PLCopen::SMC_PURSUIT_STATE;

/// kInvalidParameter if the axis cannot be moved within such limits, or kNone.
int16_t checkPursuit(const AxisRef &ref, const BlockLimits &limits) noexcept;

/// The first cycle of an axis that the block has just taken (FollowState); `signal` is the first
/// look. An axis that has been moved in this cycle stays where that has brought it.
void beginPursuit(PursuitState &pursuit, FollowState &follow, AxisRef &ref,
                  const MasterMotion &signal, const BlockLimits &limits) noexcept;

/// Another cycle: writes the set values.
void continuePursuit(PursuitState &pursuit, FollowState &follow, AxisRef &ref,
                     const MasterMotion &signal, const BlockLimits &limits) noexcept;

} // namespace stride::motion

#endif
