// SysLibTime.
#include "runtime/blocks/host_side.hpp"

#include "st/SysLibTime/CurTime.h"
#include "st/SysLibTime/CurTimeEx.h"
#include "st/SysLibTime/SysTime64.h"
#include "st/SysLibTime/SysTimeGetMs.h"
#include "st/SysLibTime/SysTimeGetUs.h"
#include "st/SysLibTime/SystemTimeDate.h"

namespace {

constexpr int64_t kDayMs = 86'400'000;

/// Microseconds since 1970.
int64_t wallClockUs(const stride::Ctx &ctx) {
  const stride::SystemApi *const api = stride::system::apiOf(ctx);
  return (api == nullptr ? ctx.cycleStartNs : api->wallClock(api->self, &ctx)) / 1000;
}

void setTime(st::SysLibTime::SysTime64 &time, int64_t us) {
  time.ulLow = static_cast<stride::DWORD>(us);
  time.ulHigh = static_cast<stride::DWORD>(us >> 32);
}

/// The calendar in eras of 400 years that begin on a 1st of March, so that a leap day is the last
/// day of its year.
void setDate(st::SysLibTime::SystemTimeDate &date, int64_t days) {
  const int64_t shifted = days + 719'468; // 0000-03-01
  const int64_t era = shifted / 146'097;
  const int64_t day = shifted - era * 146'097;
  const int64_t year = (day - day / 1'460 + day / 36'524 - day / 146'096) / 365;
  const int64_t ofYear = day - (365 * year + year / 4 - year / 100);
  const int64_t month = (5 * ofYear + 2) / 153; // from March on
  date.Day = static_cast<stride::UINT>(ofYear - (153 * month + 2) / 5 + 1);
  date.Month = static_cast<stride::UINT>(month < 10 ? month + 3 : month - 9);
  date.Year = static_cast<stride::UINT>(era * 400 + year + (month < 10 ? 0 : 1));
  date.DayOfWeek = static_cast<stride::UINT>((days + 4) % 7); // 1970-01-01 was a Thursday
}

} // namespace

namespace st::SysLibTime {

::stride::UDINT SysTimeGetMs(::stride::Ctx &ctx__) {
  return static_cast<::stride::UDINT>(ctx__.cycleStartNs / 1'000'000);
}

::stride::ULINT SysTimeGetUs(::stride::Ctx &ctx__) {
  return static_cast<::stride::ULINT>(ctx__.cycleStartNs / 1000);
}

void CurTime::body__(::stride::Ctx &ctx__) {
  if (SystemTime == nullptr)
    ::stride::raise(ctx__, ::stride::ExceptionCode::UnboundInOut, nullptr, 0, 0);
  setTime(*SystemTime, wallClockUs(ctx__));
}

void CurTimeEx::body__(::stride::Ctx &ctx__) {
  if (SystemTime == nullptr || TimeDate == nullptr)
    ::stride::raise(ctx__, ::stride::ExceptionCode::UnboundInOut, nullptr, 0, 0);
  const int64_t us = wallClockUs(ctx__);
  const int64_t ms = us / 1000;
  setTime(*SystemTime, us);
  SystemTimeDate &date = *TimeDate;
  date.dwLowMSecs = SystemTime->ulLow;
  date.dwHighMsec = SystemTime->ulHigh;
  setDate(date, ms / kDayMs);
  const int64_t ofDay = ms % kDayMs;
  date.Hour = static_cast<::stride::UINT>(ofDay / 3'600'000);
  date.Minute = static_cast<::stride::UINT>(ofDay / 60'000 % 60);
  date.Second = static_cast<::stride::UINT>(ofDay / 1000 % 60);
  date.Milliseconds = static_cast<::stride::UINT>(ofDay % 1000);
}

} // namespace st::SysLibTime
