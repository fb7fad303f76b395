#include "drivers/can/simulation/power_state.hpp"

#include <algorithm>
#include <iterator>

namespace stride::can::simulation {
namespace {

using State = PowerState;
using Command = PowerCommand;

struct Pattern {
  uint16_t mask;
  uint16_t value;
  Command command;
};

constexpr Pattern kPatterns[] = {{0x87, 0x06, Command::Shutdown},
                                 {0x8F, 0x07, Command::SwitchOn},
                                 {0x8F, 0x0F, Command::EnableOperation},
                                 {0x82, 0x00, Command::DisableVoltage},
                                 {0x86, 0x02, Command::QuickStop}};

struct Transition {
  State from;
  Command command;
  State to;
};

// Those that the master asks for; the others the drive does by itself.
constexpr Transition kTransitions[] = {
    {State::SwitchOnDisabled, Command::Shutdown, State::ReadyToSwitchOn},
    {State::ReadyToSwitchOn, Command::SwitchOn, State::SwitchedOn},
    {State::ReadyToSwitchOn, Command::EnableOperation, State::SwitchedOn},
    {State::ReadyToSwitchOn, Command::DisableVoltage, State::SwitchOnDisabled},
    {State::ReadyToSwitchOn, Command::QuickStop, State::SwitchOnDisabled},
    {State::SwitchedOn, Command::EnableOperation, State::OperationEnabled},
    {State::SwitchedOn, Command::Shutdown, State::ReadyToSwitchOn},
    {State::SwitchedOn, Command::DisableVoltage, State::SwitchOnDisabled},
    {State::SwitchedOn, Command::QuickStop, State::SwitchOnDisabled},
    {State::OperationEnabled, Command::SwitchOn, State::SwitchedOn},
    {State::OperationEnabled, Command::Shutdown, State::ReadyToSwitchOn},
    {State::OperationEnabled, Command::DisableVoltage, State::SwitchOnDisabled},
    {State::OperationEnabled, Command::QuickStop, State::QuickStopActive},
    {State::QuickStopActive, Command::DisableVoltage, State::SwitchOnDisabled},
    {State::QuickStopActive, Command::EnableOperation, State::OperationEnabled},
};

constexpr uint16_t kStatus[] = {0x00, 0x40, 0x21, 0x23, 0x27, 0x07, 0x0F, 0x08};

} // namespace

PowerCommand commandOf(uint16_t controlword) {
  for (const Pattern &pattern : kPatterns)
    if ((controlword & pattern.mask) == pattern.value)
      return pattern.command;
  return Command::None;
}

PowerState after(PowerState state, PowerCommand command) {
  const auto *const found =
      std::find_if(std::begin(kTransitions), std::end(kTransitions),
                   [&](const Transition &t) { return t.from == state && t.command == command; });
  return found == std::end(kTransitions) ? state : found->to;
}

uint16_t statusOf(PowerState state) { return kStatus[static_cast<unsigned>(state)]; }

} // namespace stride::can::simulation
