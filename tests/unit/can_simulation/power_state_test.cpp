// The power state machine, walked with all controlwords.
#include "drivers/can/simulation/power_state.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace stride::can::simulation {
namespace {

using State = PowerState;

/// Where a controlword may lead, as the profile's picture has it: bits 0 to 3 and 7.
State expected(State state, unsigned word) {
  const bool on = (word & 1U) != 0;
  const bool voltage = (word & 2U) != 0;
  const bool noQuickStop = (word & 4U) != 0;
  const bool operation = (word & 8U) != 0;
  if ((word & 0x80U) != 0) // a reset of faults is no command of the others
    return state;
  const bool disable = !voltage;
  const bool quick = voltage && !noQuickStop;
  const bool shutdown = voltage && noQuickStop && !on;
  const bool switchOn = voltage && noQuickStop && on;
  switch (state) {
  case State::SwitchOnDisabled:
    return shutdown ? State::ReadyToSwitchOn : state;
  case State::ReadyToSwitchOn:
    return disable || quick ? State::SwitchOnDisabled : switchOn ? State::SwitchedOn : state;
  case State::SwitchedOn:
    if (disable || quick)
      return State::SwitchOnDisabled;
    return shutdown ? State::ReadyToSwitchOn : operation ? State::OperationEnabled : state;
  case State::OperationEnabled:
    if (disable)
      return State::SwitchOnDisabled;
    if (quick)
      return State::QuickStopActive;
    return shutdown ? State::ReadyToSwitchOn : operation ? state : State::SwitchedOn;
  case State::QuickStopActive:
    return disable                 ? State::SwitchOnDisabled
           : switchOn && operation ? State::OperationEnabled
                                   : state;
  default: // only faults and the drive itself
    return state;
  }
}

TEST(PowerStates, AllControlwordsInAllStates) {
  size_t moves = 0;
  for (int s = 0; s <= static_cast<int>(State::Fault); ++s)
    for (unsigned word = 0; word <= 0xFFFF; ++word) {
      const auto state = static_cast<State>(s);
      const State next = after(state, commandOf(static_cast<uint16_t>(word)));
      ASSERT_EQ(next, expected(state, word)) << s << ' ' << std::hex << word;
      moves += next != state ? 1U : 0U;
    }
  EXPECT_GT(moves, 100'000U);
}

TEST(PowerStates, AreKnownByTheirBits) {
  // By 6Fh, and four of them by 4Fh.
  const std::map<State, std::pair<unsigned, unsigned>> masks = {
      {State::NotReady, {0x4F, 0x00}},         {State::SwitchOnDisabled, {0x4F, 0x40}},
      {State::ReadyToSwitchOn, {0x6F, 0x21}},  {State::SwitchedOn, {0x6F, 0x23}},
      {State::OperationEnabled, {0x6F, 0x27}}, {State::QuickStopActive, {0x6F, 0x07}},
      {State::FaultReaction, {0x4F, 0x0F}},    {State::Fault, {0x4F, 0x08}}};
  for (const auto &[state, word] : masks)
    for (const auto &[other, mask] : masks)
      EXPECT_EQ((statusOf(state) & mask.first) == mask.second, state == other);
}

} // namespace
} // namespace stride::can::simulation
