// Axes without a drive, which a program declares (bRealDrive = FALSE): MC_Power serves them. What a
// drive group does around the programs of a task happens at the first call of a cycle.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_VIRTUAL_AXIS_HPP
#define STRIDE_RUNTIME_AXIS_VIRTUAL_AXIS_HPP

#include "runtime/axis/axis_ref.hpp"

namespace stride::axis {

/// Whether MC_Power serves the axis: no drive of the PLC configuration, no axis of a block
/// (SMC_TimeAxisFB, SMC_Encoder), and a cycle time.
inline bool isVirtual(const AxisRef &axis) noexcept {
  return axis.bRealDrive == 0 && axis.bOwnService == 0 && axis.fTaskCycle > 0.0;
}

/// Serves the axis in the task's cycle with number `cycle`. At the first call of a cycle the one
/// before ends: owners and limits are supervised, and the actual values become the set ones. At
/// every call power follows its demand (bRegulatorOn, bDriveStart) at once.
void serveVirtual(AxisRef &axis, uint64_t cycle) noexcept;

} // namespace stride::axis

#endif
