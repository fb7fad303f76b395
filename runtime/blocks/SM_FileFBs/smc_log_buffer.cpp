// What lies between the two tasks of SMC_AxisDiagnosticLog: one puts records, one takes them,
// nobody waits.
#include "runtime/iec/text.h"

#include "st/SM_FileFBs/SMC_LOG_BUFFER.h"
#include "st/SM_FileFBs/SMC_LogClose.h"
#include "st/SM_FileFBs/SMC_LogEnd.h"
#include "st/SM_FileFBs/SMC_LogPut.h"
#include "st/SM_FileFBs/SMC_LogResult.h"
#include "st/SM_FileFBs/SMC_LogStart.h"
#include "st/SM_FileFBs/SMC_LogState.h"
#include "st/SM_FileFBs/SMC_LogText.h"

namespace {

using Buffer = ::st::SM_FileFBs::SMC_LOG_BUFFER;

constexpr uint32_t kPlaces = sizeof(Buffer::afValues) / sizeof(double);
/// Counts begin again at 0 there: twice around, so that full and empty differ.
constexpr uint32_t kRound = 2 * kPlaces;

uint32_t seen(const uint32_t &variable) noexcept {
  return __atomic_load_n(&variable, __ATOMIC_ACQUIRE);
}
void tell(uint32_t &variable, uint32_t value) noexcept {
  __atomic_store_n(&variable, value, __ATOMIC_RELEASE);
}

} // namespace

namespace st::SM_FileFBs {

::stride::BOOL SMC_LogStart(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer,
                            ::stride::INT iValues) {
  if (seen(Buffer.udiClosed) != Buffer.udiRun)
    return 0;
  Buffer.udiPut = 0;
  Buffer.udiTaken = 0;
  Buffer.iResult = 0;
  Buffer.iValues = iValues;
  tell(Buffer.udiRun, Buffer.udiRun + 1);
  return 1;
}

::stride::BOOL SMC_LogPut(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer,
                          ::stride::Array<::stride::LREAL, 0, 5> &Values) {
  const uint32_t put = Buffer.udiPut;
  const auto count = static_cast<uint32_t>(Buffer.iValues);
  if (kPlaces - (put + kRound - seen(Buffer.udiTaken)) % kRound < count)
    return 0;
  for (uint32_t i = 0; i < count; ++i)
    Buffer.afValues.v[(put + i) % kPlaces] = Values.v[i];
  tell(Buffer.udiPut, (put + count) % kRound);
  return 1;
}

::stride::BOOL SMC_LogEnd(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer) {
  tell(Buffer.udiEnded, Buffer.udiRun);
  return 1;
}

::stride::INT SMC_LogResult(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer) {
  return seen(Buffer.udiClosed) == Buffer.udiRun ? Buffer.iResult : int16_t{-1};
}

::stride::INT SMC_LogState(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer) {
  const uint32_t run = seen(Buffer.udiRun);
  if (run == Buffer.udiClosed)
    return 0;
  // In this order: what has been put before the end is seen with it.
  return seen(Buffer.udiEnded) == run && seen(Buffer.udiPut) == Buffer.udiTaken ? 2 : 1;
}

::stride::UDINT SMC_LogText(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer,
                            ::stride::BYTE *pText, ::stride::UDINT udiSize,
                            ::stride::BYTE bySeparator, ::stride::BYTE *pRecordSeparator) {
  constexpr uint32_t kRecordSeparator = 3;
  const uint32_t put = seen(Buffer.udiPut);
  const auto count = static_cast<uint32_t>(Buffer.iValues);
  const uint32_t room = count * (::stride::text::kBufferSize + 1) + kRecordSeparator;
  uint32_t taken = Buffer.udiTaken;
  uint32_t length = 0;
  while (taken != put && udiSize - length >= room) {
    for (uint32_t i = 0; i < count; ++i) {
      if (i > 0)
        pText[length++] = bySeparator;
      char number[::stride::text::kBufferSize];
      const uint32_t digits =
          ::stride::text::formatLreal(number, Buffer.afValues.v[(taken + i) % kPlaces]);
      __builtin_memcpy(pText + length, number, digits);
      length += digits;
    }
    for (uint32_t i = 0; i < kRecordSeparator && pRecordSeparator[i] != 0; ++i)
      pText[length++] = pRecordSeparator[i];
    taken = (taken + count) % kRound;
  }
  tell(Buffer.udiTaken, taken);
  return length;
}

::stride::BOOL SMC_LogClose(::stride::Ctx & /*ctx__*/, SMC_LOG_BUFFER &Buffer,
                            ::stride::INT iResult) {
  Buffer.iResult = iResult;
  tell(Buffer.udiClosed, Buffer.udiRun);
  return 1;
}

} // namespace st::SM_FileFBs
