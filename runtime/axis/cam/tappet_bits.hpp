// What passes of tappets do to tappet bits. Free of the C++ standard library.
#ifndef STRIDE_RUNTIME_AXIS_CAM_TAPPET_BITS_HPP
#define STRIDE_RUNTIME_AXIS_CAM_TAPPET_BITS_HPP

#include "runtime/axis/cam/tappets.hpp"

#include "st/SM_PLCopen/SMC_TAPPET_TIMER.h"

namespace stride::cam {

using TappetTimer = ::st::SM_PLCopen::SMC_TAPPET_TIMER;

/// The times of TAPPETACTION_time that run or wait, in a block's memory.
struct TappetTimers {
  TappetTimer *timers;
  int16_t capacity; ///< At least as many as there are bits.
  int16_t &count;
};

/// Does to `bit`, which is TRUE without the times of its group, what the tappet demands. A time is
/// added: from the pass on after dwDelay, for dwDuration. Off, and invert while the bit is TRUE,
/// end times that have begun. Where there is no room for a time, two of one group are joined.
void switchTappet(bool &bit, const TappetTimers &times, const TappetEvent &event) noexcept;

/// Whether a time makes the bit of `group` TRUE at `now`. [ns]
bool isTimed(const TappetTimers &times, int16_t group, int64_t now) noexcept;

/// Last in every call: forgets times that are over. One that is too short for any cycle lasts
/// through the first that sees it.
void forgetTimes(const TappetTimers &times, int64_t now) noexcept;

} // namespace stride::cam

#endif
