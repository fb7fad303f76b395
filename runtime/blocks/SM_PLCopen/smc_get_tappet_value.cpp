// SMC_GetTappetValue: a tappet bit of MC_CamIn.
#include "runtime/axis/cam/tappet_bits.hpp"
#include "runtime/iec/ctx.h"

#include "st/SM_PLCopen/SMC_GetTappetValue.h"

void st::SM_PLCopen::SMC_GetTappetValue::body__(::stride::Ctx &ctx__) {
  if (Tappets == nullptr)
    return;
  const ::stride::cam::TappetTimers times{
      aTimers.v, static_cast<int16_t>(sizeof aTimers.v / sizeof aTimers.v[0]), iTimers};
  const bool restarted = bCalled != 0 && udiRestarts != Tappets->udiRestarts;
  if (bCalled == 0 || (restarted && bSetInitValueAtReset != 0)) {
    bBit = bInitValue;
    iTimers = 0;
  }
  bCalled = 1;
  udiRestarts = Tappets->udiRestarts;
  if (ulReports != Tappets->ulReports) {
    ulReports = Tappets->ulReports;
    for (int16_t i = 0; i < Tappets->iCount && i < 3; ++i)
      if (const auto &event = Tappets->aEvents.v[i]; event.iGroupID == iID) {
        bool bit = bBit != 0;
        ::stride::cam::switchTappet(bit, times, event);
        bBit = bit;
      }
  }
  bTappet = bBit != 0 || ::stride::cam::isTimed(times, iID, ctx__.cycleStartNs);
  ::stride::cam::forgetTimes(times, ctx__.cycleStartNs);
}
