// SysTime: the time of the run, the system's clock, and dates.
#include "runtime/blocks/civil_date.hpp"
#include "runtime/blocks/host_side.hpp"

#include "st/SysTime/SYSTIMEDATE.h"
#include "st/SysTime/SysTimeGetMs.h"
#include "st/SysTime/SysTimeGetNs.h"
#include "st/SysTime/SysTimeGetUs.h"
#include "st/SysTime/SysTimeRtcConvertDateToHighRes.h"
#include "st/SysTime/SysTimeRtcConvertDateToUtc.h"
#include "st/SysTime/SysTimeRtcConvertHighResToDate.h"
#include "st/SysTime/SysTimeRtcConvertUtcToDate.h"
#include "st/SysTime/SysTimeRtcGet.h"
#include "st/SysTime/SysTimeRtcHighResGet.h"

namespace {

using st::SysTime::SYSTIMEDATE;
using stride::system::civilDateOf;
using stride::system::daysOf;
using stride::system::kDayMs;

// RTS_IEC_RESULT
constexpr stride::UDINT kOk = 0;
constexpr stride::UDINT kFailed = 1;

/// Milliseconds since 1970.
int64_t wallClockMs(const stride::Ctx &ctx) {
  const stride::SystemApi *const api = stride::system::apiOf(ctx);
  return (api == nullptr ? ctx.cycleStartNs : api->wallClock(api->self, &ctx)) / 1'000'000;
}

stride::UINT word(int64_t value) { return static_cast<stride::UINT>(value); }

/// False: the year is no UINT.
bool makeDate(uint64_t ms, SYSTIMEDATE &date) {
  constexpr uint64_t kEnd = 2'005'949'145'600'000; // 65536-01-01
  if (ms >= kEnd)
    return false;
  const int64_t days = static_cast<int64_t>(ms) / kDayMs;
  const int64_t ofDay = static_cast<int64_t>(ms) % kDayMs;
  const stride::system::CivilDate civil = civilDateOf(days);
  date.wYear = word(civil.year);
  date.wMonth = word(civil.month);
  date.wDay = word(civil.day);
  date.wHour = word(ofDay / 3'600'000);
  date.wMinute = word(ofDay / 60'000 % 60);
  date.wSecond = word(ofDay / 1000 % 60);
  date.wMilliseconds = word(ofDay % 1000);
  date.wDayOfWeek = word((days + 3) % 7 + 1); // 1970-01-01 was a Thursday
  date.wYday = word(days - daysOf({civil.year, 1, 1}) + 1);
  return true;
}

/// Milliseconds since 1970; false: there is no such date, or it lies before.
bool makeMs(const SYSTIMEDATE &date, int64_t &ms) {
  if (date.wYear < 1970 || date.wMonth < 1 || date.wMonth > 12 || date.wDay < 1 ||
      date.wHour > 23 || date.wMinute > 59 || date.wSecond > 59 || date.wMilliseconds > 999)
    return false;
  const int64_t days = daysOf({date.wYear, date.wMonth, date.wDay});
  const stride::system::CivilDate civil = civilDateOf(days);
  if (civil.month != date.wMonth || civil.day != date.wDay)
    return false;
  ms = days * kDayMs + ((date.wHour * 60 + date.wMinute) * 60 + date.wSecond) * int64_t{1000} +
       date.wMilliseconds;
  return true;
}

} // namespace

namespace st::SysTime {

::stride::UDINT SysTimeGetMs(::stride::Ctx &ctx__) {
  return static_cast<::stride::UDINT>(ctx__.cycleStartNs / 1'000'000);
}

::stride::UDINT SysTimeGetUs(::stride::Ctx &ctx__, ::stride::ULINT &pUsTime) {
  pUsTime = static_cast<::stride::ULINT>(ctx__.cycleStartNs / 1000);
  return kOk;
}

::stride::UDINT SysTimeGetNs(::stride::Ctx &ctx__, ::stride::ULINT &pUsTime) {
  pUsTime = static_cast<::stride::ULINT>(ctx__.cycleStartNs);
  return kOk;
}

::stride::DWORD SysTimeRtcGet(::stride::Ctx &ctx__, ::stride::UDINT &pResult) {
  pResult = kOk;
  return static_cast<::stride::DWORD>(wallClockMs(ctx__) / 1000);
}

::stride::UDINT SysTimeRtcHighResGet(::stride::Ctx &ctx__, ::stride::ULINT &pTimestamp) {
  pTimestamp = static_cast<::stride::ULINT>(wallClockMs(ctx__));
  return kOk;
}

::stride::UDINT SysTimeRtcConvertUtcToDate(::stride::Ctx & /*ctx__*/,
                                           ::stride::DWORD dwTimestampUtc, SYSTIMEDATE &pDate) {
  return makeDate(uint64_t{dwTimestampUtc} * 1000, pDate) ? kOk : kFailed;
}

::stride::UDINT SysTimeRtcConvertDateToUtc(::stride::Ctx & /*ctx__*/, SYSTIMEDATE &pDate,
                                           ::stride::DWORD &pdwTimestampUtc) {
  int64_t ms = 0;
  if (!makeMs(pDate, ms) || ms / 1000 > int64_t{UINT32_MAX})
    return kFailed;
  pdwTimestampUtc = static_cast<::stride::DWORD>(ms / 1000);
  return kOk;
}

::stride::UDINT SysTimeRtcConvertHighResToDate(::stride::Ctx & /*ctx__*/,
                                               ::stride::ULINT &pTimestamp, SYSTIMEDATE &pDate) {
  return makeDate(pTimestamp, pDate) ? kOk : kFailed;
}

::stride::UDINT SysTimeRtcConvertDateToHighRes(::stride::Ctx & /*ctx__*/, SYSTIMEDATE &pDate,
                                               ::stride::ULINT &pTimestamp) {
  int64_t ms = 0;
  if (!makeMs(pDate, ms))
    return kFailed;
  pTimestamp = static_cast<::stride::ULINT>(ms);
  return kOk;
}

} // namespace st::SysTime
