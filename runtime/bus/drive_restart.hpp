// What a drive group asks about one of its axes while it starts anew, alone or with the others.
#ifndef STRIDE_RUNTIME_BUS_DRIVE_RESTART_HPP
#define STRIDE_RUNTIME_BUS_DRIVE_RESTART_HPP

#include "runtime/axis/axis_ref.hpp"

#include <cstdint>

namespace stride::bus {

/// A drive that does not switch off does not block a restart for longer. [cycles]
inline constexpr uint32_t kPowerOffCycles = 1000;

/// SMC_RESTART_STATE.byStep.
enum class RestartStep : uint8_t {
  None,
  Braking,  ///< The axis comes to rest.
  PowerOff, ///< The regulator goes off.
  StartUp,  ///< The drive starts up.
};

inline RestartStep restartStep(const axis::AxisRef &axis) noexcept {
  return static_cast<RestartStep>(axis.stRestart.byStep);
}
inline bool isRestarting(const axis::AxisRef &axis) noexcept {
  return restartStep(axis) != RestartStep::None;
}
/// Whether a restart goes on or begins.
inline bool asksForRestart(const axis::AxisRef &axis) noexcept {
  return isRestarting(axis) || axis.stRestart.udiBegun != axis.stRestart.udiAsked;
}
inline bool isSwitchedOff(const axis::AxisRef &axis) noexcept {
  return restartStep(axis) == RestartStep::PowerOff;
}

/// Set and actual values are exchanged with the drive. An axis in virtual mode has none; its
/// MC_Power serves it.
inline bool isServed(const axis::AxisRef &axis) noexcept {
  return axis.bRealDrive != 0 && axis.wCommunicationState == axis::kNormalOperation;
}

inline bool hasPower(const axis::AxisRef &axis) noexcept {
  return axis.bRealDrive != 0 && (axis.bRegulatorRealState != 0 || axis.bDriveStartRealState != 0);
}

/// Whoever moves the axis loses it; a moving axis brakes.
void brakeForRestart(axis::AxisRef &axis) noexcept;

} // namespace stride::bus

#endif
