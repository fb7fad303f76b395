// The power state machine of drives. [CiA 402, state machine, controlword and statusword]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_POWER_STATE_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_POWER_STATE_HPP

#include <cstdint>

namespace stride::can::simulation {

enum class PowerState : uint8_t {
  NotReady,
  SwitchOnDisabled,
  ReadyToSwitchOn,
  SwitchedOn,
  OperationEnabled,
  QuickStopActive,
  FaultReaction,
  Fault,
};

/// What a controlword says.
enum class PowerCommand : uint8_t {
  None, ///< None of the patterns that mean something.
  Shutdown,
  SwitchOn, ///< In operation enabled: disable operation.
  EnableOperation,
  DisableVoltage,
  QuickStop,
};

// Bits of the controlword beyond those of the commands.
inline constexpr uint16_t kModeBit = 0x0010; ///< Start of homing, interpolation on.
inline constexpr uint16_t kFaultReset = 0x0080;
inline constexpr uint16_t kHalt = 0x0100;

// Bits of the statusword beyond those of the states.
inline constexpr uint16_t kVoltageEnabled = 0x0010;
inline constexpr uint16_t kRemote = 0x0200;
inline constexpr uint16_t kTargetReached = 0x0400;
inline constexpr uint16_t kInternalLimit = 0x0800;
inline constexpr uint16_t kModeStatus = 0x1000;
inline constexpr uint16_t kModeError = 0x2000;

PowerCommand commandOf(uint16_t controlword);

/// Where a command leads: one transition, and nowhere if there is none.
PowerState after(PowerState state, PowerCommand command);

/// The bits of the statusword by which a state is known.
uint16_t statusOf(PowerState state);

} // namespace stride::can::simulation

#endif
