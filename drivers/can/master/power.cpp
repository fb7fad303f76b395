#include "drivers/can/master/power.hpp"

#include <array>

namespace stride::can {
namespace {

struct StateRow {
  uint16_t mask;
  uint16_t value;
  PowerState state;
};
constexpr std::array<StateRow, 8> kStateRows = {{
    {0x4F, 0x00, PowerState::NotReady},
    {0x4F, 0x40, PowerState::SwitchOnDisabled},
    {0x6F, 0x21, PowerState::Ready},
    {0x6F, 0x23, PowerState::SwitchedOn},
    {0x6F, 0x27, PowerState::Enabled},
    {0x6F, 0x07, PowerState::QuickStop},
    {0x4F, 0x0F, PowerState::FaultReaction},
    {0x4F, 0x08, PowerState::Fault},
}};

constexpr std::array<std::string_view, kPowerStates> kNames = {
    "not ready to switch on", "switch on disabled", "ready to switch on",    "switched on",
    "operation enabled",      "quick stop active",  "fault reaction active", "fault",
    "an unknown state",
};

/// Cycles after which what a drive says knows what it was told: there and back, and one of its own.
constexpr uint32_t kSettles = 4;

constexpr uint16_t kDisableVoltage = 0x00;
constexpr uint16_t kQuickStop = 0x02;
constexpr uint16_t kShutdown = 0x06;
constexpr uint16_t kSwitchOn = 0x07; ///< In operation: disable operation.
constexpr uint16_t kEnable = 0x0F;

/// The controlword in a state for each target. Where it says Shutdown for Off, the drive goes on to
/// what PowerOff says.
struct WordRow {
  uint16_t off;
  uint16_t switchedOn;
  uint16_t enabled;
  uint16_t quickStop;
};
constexpr std::array<WordRow, kPowerStates> kWords = {{
    {kDisableVoltage, kDisableVoltage, kDisableVoltage, kDisableVoltage}, // NotReady
    {kDisableVoltage, kShutdown, kShutdown, kDisableVoltage},             // SwitchOnDisabled
    {kDisableVoltage, kSwitchOn, kSwitchOn, kDisableVoltage},             // Ready
    {kShutdown, kSwitchOn, kEnable, kShutdown},                           // SwitchedOn
    {kSwitchOn, kSwitchOn, kEnable, kQuickStop},                          // Enabled
    {kDisableVoltage, kDisableVoltage, kDisableVoltage, kQuickStop},      // QuickStop
    {kDisableVoltage, kDisableVoltage, kDisableVoltage, kDisableVoltage}, // FaultReaction
    {kDisableVoltage, kDisableVoltage, kDisableVoltage, kDisableVoltage}, // Fault
    {kDisableVoltage, kDisableVoltage, kDisableVoltage, kDisableVoltage}, // Unknown
}};

uint16_t wordFor(PowerState state, PowerTarget target, PowerOff off) {
  if (target == PowerTarget::Off && off == PowerOff::Shutdown &&
      (state == PowerState::SwitchOnDisabled || state == PowerState::Ready))
    return kShutdown;
  const WordRow &row = kWords[static_cast<size_t>(state)];
  switch (target) {
  case PowerTarget::SwitchedOn:
    return row.switchedOn;
  case PowerTarget::Enabled:
    return row.enabled;
  case PowerTarget::QuickStop:
    return row.quickStop;
  case PowerTarget::Off:
    break;
  }
  return row.off;
}

bool isThere(PowerState state, PowerTarget target) {
  switch (target) {
  case PowerTarget::SwitchedOn:
    return state == PowerState::SwitchedOn;
  case PowerTarget::Enabled:
    return state == PowerState::Enabled;
  case PowerTarget::QuickStop:
    return state != PowerState::Enabled;
  case PowerTarget::Off:
    break;
  }
  return state != PowerState::SwitchedOn && state != PowerState::Enabled &&
         state != PowerState::QuickStop;
}

} // namespace

PowerState powerStateOf(uint16_t statusword) {
  for (const StateRow &row : kStateRows)
    if ((statusword & row.mask) == row.value)
      return row.state;
  return PowerState::Unknown;
}

std::string_view nameOf(PowerState state) { return kNames[static_cast<size_t>(state)]; }

void PowerControl::clear() { *this = PowerControl(p_); }

void PowerControl::seen(uint16_t statusword) {
  const PowerState now = powerStateOf(statusword);
  if (now != state_)
    waited_ = 0;
  if (state_ == PowerState::Enabled && now != state_ && controlword_ == kEnable)
    left_ = kSettles;
  state_ = now;
  if ((statusword & kFaultBit) == 0)
    return;
  if (!fault_)
    acknowledged_ = false;
  fault_ = true;
}

void PowerControl::demand(PowerTarget target, bool acknowledge) {
  if (!acknowledge)
    tried_ = false;
  else if (reachable_)
    stuck_ = false;
  release(acknowledge);
  if (fault_) {
    demandInFault(acknowledge);
    if (fault_)
      return;
  }
  pulse_ = 0;
  tried_ = false;
  if ((stuck_ || blocked_) && target != PowerTarget::QuickStop)
    target = PowerTarget::Off;
  target = withoutOperation(target);
  controlword_ = wordFor(state_, target, p_.off);
  watch(target);
}

/// Who has left operation by itself, or has only said so, is told to leave it before it may go on:
/// set values are where it was when it said that, and would lead it back.
PowerTarget PowerControl::withoutOperation(PowerTarget target) {
  if (left_ == 0)
    return target;
  left_ = state_ == PowerState::Enabled ? kSettles : left_ - 1;
  return target == PowerTarget::Enabled && left_ > 0 ? PowerTarget::SwitchedOn : target;
}

/// While a drive that was lost brakes by itself it shows that it is in operation.
void PowerControl::release(bool acknowledge) {
  released_ = blocked_ && reachable_ && (released_ || acknowledge);
  if (released_ && state_ != PowerState::Enabled && state_ != PowerState::QuickStop)
    blocked_ = released_ = false;
}

/// An edge of the reset bit for each acknowledgement; the fault is over when the drive says so and
/// somebody has acknowledged it.
void PowerControl::demandInFault(bool acknowledge) {
  waited_ = 0;
  const bool present = state_ == PowerState::Fault || state_ == PowerState::FaultReaction ||
                       state_ == PowerState::Unknown;
  controlword_ = wordFor(state_, PowerTarget::Off, p_.off);
  if (!present) {
    pulse_ = 0;
    fault_ = !acknowledge && !acknowledged_;
    return;
  }
  if (state_ != PowerState::Fault) // its reaction first
    return;
  if (pulse_ == 0 && acknowledge && !tried_) {
    tried_ = true;
    acknowledged_ = true;
    pulse_ = 1;
  } else if (pulse_ > 0 && ++pulse_ > p_.resetTime) {
    pulse_ = 0;
    acknowledged_ = false;
  }
  if (pulse_ > 0)
    controlword_ = kFaultReset;
}

void PowerControl::watch(PowerTarget target) {
  if (isThere(state_, target)) {
    waited_ = 0;
    return;
  }
  if (++waited_ < p_.timeout)
    return;
  waited_ = 0;
  stuck_ = true;
}

} // namespace stride::can
