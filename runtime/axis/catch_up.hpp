// How a slave gets to the velocity of its master within limits, while the master may change its
// own.
#ifndef STRIDE_RUNTIME_AXIS_CATCH_UP_HPP
#define STRIDE_RUNTIME_AXIS_CATCH_UP_HPP

#include "runtime/axis/gear.hpp"

#include "st/SM_PLCopen/SMC_CATCH_UP_STATE.h"

namespace stride::motion {

using CatchUpState = ::st::SM_PLCopen::SMC_CATCH_UP_STATE;

/// What the master demands of the slave in a cycle: its own motion times the ratio (demandOf).
struct Demand {
  double velocity; ///< At the end of the cycle. [u/s]
  double travel;   ///< In the cycle. [u]
  bool steady;     ///< The master has no acceleration.
  bool rough;      ///< Actual values: velocities jump by what the encoder resolves.
};

/// What is wrong with limits for the axis: nothing, or which of both.
enum class LimitError : uint8_t { None, Acceleration, Deceleration };

/// Deceleration > 0, Acceleration > 0; with ramp types that need a jerk, jerk > 0 here or at the
/// axis (else it is the acceleration's fault).
LimitError checkLimits(const AxisRef &ref, double acceleration, double deceleration,
                       double jerk) noexcept;

/// The demand of a master in gear.
Demand demandOf(const GearState &gear, const MasterState &state,
                const MasterMotion &master) noexcept;

/// How a master that is looked at for the first time was one cycle of the slave ago, if its
/// acceleration was the same all the time.
MasterMotion cycleBefore(const AxisRef &slave, const MasterMotion &master) noexcept;

/// The same look, with the way since cycleBefore.
MasterMotion sinceCycleBefore(const AxisRef &slave, const MasterMotion &master) noexcept;

/// Starts from the demand of the last cycle.
void beginCatchUp(CatchUpState &state, const Demand &last) noexcept;

/// One cycle of the way to the master's velocity: writes the set values. Acceleration and
/// deceleration never exceed the limits (with SMC_RAMPTYPE.sigmoid not more than such ramps do),
/// with jerk limited ramps nor does the jerk. True: the slave has the master's velocity at the end
/// of this cycle, with such ramps also its mean acceleration; then nothing has been written, and
/// the gear is engaged there. A master whose acceleration is more than the slave's limit gets away.
/// While the demanded velocity does not change, the ramp is the axis's own; otherwise sin^2 ramps
/// become parabolic ones.
bool catchUpToGear(CatchUpState &state, GearState &gear, FollowState &follow, AxisRef &slave,
                   const MasterState &masterState, const MasterMotion &master) noexcept;

} // namespace stride::motion

#endif
