// SMC_CheckForLimits.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/limit_check.hpp"
#include "runtime/numeric/exact_math.hpp"

#include "st/SM_CNC/SMC_CheckForLimits.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace cnc = stride::cnc;

namespace {

using Block = st::SM_CNC::SMC_CheckForLimits;

/// No position in a queue: none of it has been checked.
constexpr uint32_t kNothing = UINT32_MAX;

void end(Block &block, int16_t error) noexcept {
  block.bActive = 0;
  block.bBusy = 0;
  block.bError = static_cast<stride::BOOL>(error != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  block.wErrorID = error;
}

void begin(Block &block) noexcept {
  block.wAxisOutOfLimits = 0;
  block.iSourceLine_No = -1;
  block.nChecked = kNothing;
  const double distance = block.d3dCheckDistance;
  if (stride::exact::isfinite(distance) && distance >= 0.0) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
    block.bActive = 1;
  } else {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER);
  }
}

void check(Block &block) noexcept {
  const cnc::Queue *queue = cnc::queueOf(block.poqDataIn);
  if (block.pQueue != block.poqDataIn)
    block.nChecked = kNothing;
  block.pQueue = block.poqDataIn;
  const cnc::PlaceLimits box{reinterpret_cast<const cnc::Position *>(&block.piMin),
                             reinterpret_cast<const cnc::Position *>(&block.piMax),
                             block.wAddAxis,
                             block.d3dCheckDistance,
                             block.diMinNoPoints,
                             block.diMaxNoPoints};
  cnc::BoxFinding finding{block.wAxisOutOfLimits, block.iSourceLine_No};
  // Before the objects are looked at: the last one comes before it.
  const bool complete = cnc::checkQueue(queue) == cnc::QueueError::None &&
                        __atomic_load_n(&queue->endOfList, __ATOMIC_ACQUIRE) != 0;
  switch (cnc::checkBox(queue, block.nChecked, box, finding)) {
  case cnc::BoxError::NoQueue:
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_OUTQUEUE_TYPE);
    break;
  case cnc::BoxError::Object:
    end(block, ::st::SM_Error::SMC_ERROR__SMC_PATH_INVALID_OBJECT);
    break;
  case cnc::BoxError::None:
    block.bBusy = static_cast<stride::BOOL>(!complete);
    break;
  }
  block.wAxisOutOfLimits = finding.axes;
  block.iSourceLine_No = finding.line;
}

} // namespace

void st::SM_CNC::SMC_CheckForLimits::body__(::stride::Ctx & /*ctx__*/) {
  const bool edge = bExecute != 0 && bOldExecute == 0;
  bOldExecute = bExecute;
  poqDataOut = poqDataIn;
  if (bAbort != 0 || (bExecute == 0 && bActive != 0))
    end(*this, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  else if (edge)
    begin(*this);
  if (bActive != 0)
    check(*this);
}
