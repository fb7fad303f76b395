// SysLibTime.
#include "runtime/blocks/civil_date.hpp"
#include "runtime/blocks/host_side.hpp"

#include "st/SysLibTime/CurTime.h"
#include "st/SysLibTime/CurTimeEx.h"
#include "st/SysLibTime/SysTime64.h"
#include "st/SysLibTime/SystemTimeDate.h"

namespace {

using stride::system::kDayMs;

/// Microseconds since 1970.
int64_t wallClockUs(const stride::Ctx &ctx) {
  const stride::SystemApi *const api = stride::system::apiOf(ctx);
  return (api == nullptr ? ctx.cycleStartNs : api->wallClock(api->self, &ctx)) / 1000;
}

void setTime(st::SysLibTime::SysTime64 &time, int64_t us) {
  time.ulLow = static_cast<stride::DWORD>(us);
  time.ulHigh = static_cast<stride::DWORD>(us >> 32);
}

void setDate(st::SysLibTime::SystemTimeDate &date, int64_t days) {
  const stride::system::CivilDate civil = stride::system::civilDateOf(days);
  date.Day = static_cast<stride::UINT>(civil.day);
  date.Month = static_cast<stride::UINT>(civil.month);
  date.Year = static_cast<stride::UINT>(civil.year);
  date.DayOfWeek = static_cast<stride::UINT>((days + 4) % 7); // 1970-01-01 was a Thursday
}

} // namespace

namespace st::SysLibTime {

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
