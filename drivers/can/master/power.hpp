// The power state machine of a drive, from the master's side. [CiA 402-2, 8.1]
#ifndef STRIDE_DRIVERS_CAN_MASTER_POWER_HPP
#define STRIDE_DRIVERS_CAN_MASTER_POWER_HPP

#include <cstdint>
#include <string_view>

namespace stride::can {

enum class PowerState : uint8_t {
  NotReady,
  SwitchOnDisabled,
  Ready, ///< To switch on.
  SwitchedOn,
  Enabled,
  QuickStop,
  FaultReaction,
  Fault,
  Unknown, ///< The statusword is none of CiA 402.
};
inline constexpr unsigned kPowerStates = 9;

/// By bits 0 to 3, 5 and 6 of the statusword.
PowerState powerStateOf(uint16_t statusword);

/// "operation enabled", for messages.
std::string_view nameOf(PowerState state);

/// Where the drive shall be.
enum class PowerTarget : uint8_t {
  Off,
  SwitchedOn, ///< The power stage is on, the brake applied.
  Enabled,
  QuickStop, ///< It brakes by itself and stays so.
};

/// What a drive is told that shall be off.
enum class PowerOff : uint8_t {
  DisableVoltage, ///< 0000h.
  Shutdown,       ///< 0006h: it stays ready.
};

// Bits of controlword and statusword beside the state machine.
inline constexpr uint16_t kModeBit = 0x0010; ///< Homing: start; interpolated positions: go.
inline constexpr uint16_t kFaultReset = 0x0080;
inline constexpr uint16_t kFaultBit = 0x0008;
inline constexpr uint16_t kTargetReached = 0x0400;
inline constexpr uint16_t kHomingAttained = 0x1000;
inline constexpr uint16_t kHomingError = 0x2000;

struct PowerParameters {
  PowerOff off = PowerOff::DisableVoltage;
  uint32_t timeout = 2000;   ///< For a transition. [cycles]
  uint32_t resetTime = 1000; ///< That a fault reset is held at most. [cycles]
};

/// Leads a drive through its states: one transition for each state that it shows, never a sequence
/// that nobody watches.
class PowerControl {
public:
  explicit PowerControl(const PowerParameters &parameters) : p_(parameters) {}

  /// The drive starts anew.
  void clear();
  /// The statusword of this cycle.
  void seen(uint16_t statusword);
  /// Whether the drive can be reached. When it cannot, it is switched off as soon as it hears that,
  /// and stays off until it can be reached again and somebody acknowledges it.
  void reach(bool reachable) {
    reachable_ = reachable;
    blocked_ = blocked_ || !reachable;
    released_ = released_ && reachable;
  }
  /// It has been lost, or has left operation by itself, and is switched off: perhaps it still
  /// brakes by itself, wherever its set values are.
  [[nodiscard]] bool blocked() const { return blocked_ || left_ > 0; }
  /// What is wanted in this cycle: makes the controlword of it. `acknowledge`: errors.
  void demand(PowerTarget target, bool acknowledge);

  /// Without bits of modes.
  [[nodiscard]] uint16_t controlword() const { return controlword_; }
  [[nodiscard]] PowerState state() const { return state_; }
  /// The drive has had a fault that nobody has acknowledged: it stays off.
  [[nodiscard]] bool fault() const { return fault_; }
  /// It does not go where it shall; until it is acknowledged it stays off.
  [[nodiscard]] bool stuck() const { return stuck_; }

private:
  void release(bool acknowledge);
  [[nodiscard]] PowerTarget withoutOperation(PowerTarget target);
  void demandInFault(bool acknowledge);
  void watch(PowerTarget target);

  PowerParameters p_;
  uint32_t waited_ = 0; ///< In a state that is not the target. [cycles]
  uint32_t pulse_ = 0;  ///< Cycles of the fault reset; 0: there is none.
  uint32_t left_ = 0;   ///< It has left operation by itself: until it may go on. [cycles]
  uint16_t controlword_ = 0;
  PowerState state_ = PowerState::NotReady;
  bool fault_ = false;
  bool stuck_ = false;
  bool blocked_ = false;
  bool released_ = false; ///< Somebody has acknowledged that: it may go on as soon as it is off.
  bool reachable_ = true;
  bool acknowledged_ = false; ///< The fault, since it came.
  bool tried_ = false;        ///< This acknowledgement has had its reset.
};

} // namespace stride::can

#endif
