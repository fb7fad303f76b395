// A slave geared to its master: its position follows from the master's, nothing is summed up.
#ifndef STRIDE_RUNTIME_AXIS_GEAR_HPP
#define STRIDE_RUNTIME_AXIS_GEAR_HPP

#include "runtime/axis/follow.hpp"
#include "runtime/axis/master.hpp"

#include "st/SM_PLCopen/SMC_GEAR_STATE.h"

namespace stride::motion {

using GearState = ::st::SM_PLCopen::SMC_GEAR_STATE;

/// The slave's velocity in relation to the master's. [slave u/master u]
inline double gearFactor(const GearState &gear) noexcept {
  return gear.fNumerator / gear.fDenominator;
}

/// Couples the slave: at the master's position `master` it is at `slave`, as the axis shows
/// positions now, but over any number of turns. `last` is where it was when its set values were
/// written last, on the same scale. The ratio has been set.
void engageGear(GearState &gear, const AxisRef &ref, cam::Total master, cam::Total slave,
                cam::Total last) noexcept;

/// Writes this cycle's set values of a coupled slave, `added` on top of them.
void turnGear(GearState &gear, FollowState &follow, AxisRef &ref, const MasterMotion &master,
              const numeric::MotionState &added = {}) noexcept;

} // namespace stride::motion

#endif
