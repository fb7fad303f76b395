#include "runtime/axis/cam/tappet_bits.hpp"

#include "st/SM_DriveBasic/SMC_CAMTAPPETACTION.h"

namespace stride::cam {
namespace {

void removeAt(const TappetTimers &times, int16_t index) noexcept {
  for (auto i = index; i + 1 < times.count; ++i)
    times.timers[i] = times.timers[i + 1];
  --times.count;
}

/// Ends the group's times that have begun at `now`; whether there were any that made the bit TRUE.
bool endBegun(const TappetTimers &times, int16_t group, int64_t now) noexcept {
  bool were = false;
  for (auto i = static_cast<int16_t>(times.count - 1); i >= 0; --i) {
    const TappetTimer &timer = times.timers[i];
    if (timer.iGroupID != group || timer.liBegin > now)
      continue;
    were = were || now < timer.liEnd;
    removeAt(times, i);
  }
  return were;
}

/// Two times become one that lasts from the first to the end of the last.
void join(const TappetTimers &times, int16_t first, int16_t second) noexcept {
  TappetTimer &timer = times.timers[first];
  const TappetTimer &other = times.timers[second];
  if (other.liBegin < timer.liBegin)
    timer.liBegin = other.liBegin;
  if (other.liEnd > timer.liEnd)
    timer.liEnd = other.liEnd;
  timer.bShown = timer.bShown != 0 && other.bShown != 0;
  removeAt(times, second);
}

/// Makes room for one more: there are more times than groups, so one group has two. The latest are
/// joined.
void makeRoom(const TappetTimers &times) noexcept {
  for (auto second = static_cast<int16_t>(times.count - 1); second > 0; --second)
    for (auto first = static_cast<int16_t>(second - 1); first >= 0; --first)
      if (times.timers[first].iGroupID == times.timers[second].iGroupID) {
        join(times, first, second);
        return;
      }
}

/// Adds a time; when there is no room it is joined with one of its group, or two others are.
void add(const TappetTimers &times, const TappetTimer &timer) noexcept {
  if (times.count == times.capacity) {
    for (auto i = static_cast<int16_t>(times.count - 1); i >= 0; --i)
      if (times.timers[i].iGroupID == timer.iGroupID) {
        TappetTimer &own = times.timers[i];
        own.liBegin = timer.liBegin < own.liBegin ? timer.liBegin : own.liBegin;
        own.liEnd = timer.liEnd > own.liEnd ? timer.liEnd : own.liEnd;
        return;
      }
    makeRoom(times);
  }
  times.timers[times.count] = timer;
  ++times.count;
}

constexpr int64_t kNanoseconds = 1000; ///< In a microsecond.

} // namespace

void switchTappet(bool &bit, const TappetTimers &times, const TappetEvent &event) noexcept {
  switch (event.cta) {
  case ::st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_on:
    bit = true;
    break;
  case ::st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_off:
    endBegun(times, event.iGroupID, event.liTime);
    bit = false;
    break;
  case ::st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_inv: {
    const bool timed = endBegun(times, event.iGroupID, event.liTime);
    bit = !bit && !timed;
    break;
  }
  case ::st::SM_DriveBasic::SMC_CAMTAPPETACTION__TAPPETACTION_time: {
    const int64_t begin = event.liTime + event.dwDelay * kNanoseconds;
    add(times, {begin, begin + event.dwDuration * kNanoseconds, event.iGroupID, 0});
    break;
  }
  default:
    break;
  }
}

bool isTimed(const TappetTimers &times, int16_t group, int64_t now) noexcept {
  for (int16_t i = 0; i < times.count; ++i) {
    const TappetTimer &timer = times.timers[i];
    if (timer.iGroupID == group && timer.liBegin <= now && (now < timer.liEnd || timer.bShown == 0))
      return true;
  }
  return false;
}

void forgetTimes(const TappetTimers &times, int64_t now) noexcept {
  for (auto i = static_cast<int16_t>(times.count - 1); i >= 0; --i) {
    TappetTimer &timer = times.timers[i];
    if (timer.liBegin > now)
      continue;
    if (timer.bShown == 0) {
      timer.bShown = 1;
      if (timer.liEnd <= now)
        timer.liEnd = now + 1;
    } else if (timer.liEnd <= now) {
      removeAt(times, i);
    }
  }
}

} // namespace stride::cam
