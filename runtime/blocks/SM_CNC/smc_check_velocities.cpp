// SMC_CheckVelocities.
#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"

#include "st/SM_CNC/SMC_CheckVelocities.h"
#include "st/SM_Error/SMC_ERROR.h"

namespace cnc = stride::cnc;

namespace {

using Block = st::SM_CNC::SMC_CheckVelocities;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// No position in a queue: none of it has been checked.
constexpr uint32_t kNothing = UINT32_MAX;

void end(Block &block, int16_t error) noexcept {
  block.bActive = 0;
  block.bBusy = 0;
  block.bError = static_cast<stride::BOOL>(error != ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  block.wErrorID = error;
}

cnc::CornerRules rulesOf(const Block &block) noexcept {
  return {block.dAngleTol * kDegree,
          block.bCheckAddAxVelJump != 0 ? block.dMaxAddAxVelDifference : -1.0};
}

/// The user wants no more checks: whoever drives the path does not wait for them.
void giveUp(Block &block) noexcept {
  cnc::Queue *queue = cnc::queueOf(block.poqDataIn);
  if (block.bActive != 0 && block.pQueue == block.poqDataIn &&
      cnc::checkQueue(queue) == cnc::QueueError::None)
    cnc::tellNobodyChecks(queue);
  end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
}

bool isLimit(double value) noexcept { return stride::exact::isfinite(value) && value >= 0.0; }

/// Whether the inputs that count in each call are usable.
bool areRules(const Block &block) noexcept {
  return isLimit(block.dAngleTol) &&
         (block.bCheckAddAxVelJump == 0 || isLimit(block.dMaxAddAxVelDifference));
}

void begin(Block &block) noexcept {
  end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR);
  cnc::Queue *queue = cnc::queueOf(block.poqDataIn);
  if (cnc::checkQueue(queue) != cnc::QueueError::None) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_OUTQUEUE_TYPE);
  } else if (!isLimit(block.dDryRunVelocity)) {
    end(block, ::st::SM_Error::SMC_ERROR__SMC_CV_ACC_DEC_VEL_NONPOSITIVE);
  } else {
    queue->dryRunVelocity = block.dDryRunVelocity;
    block.nChecked = kNothing;
    block.bActive = 1;
  }
}

/// Nobody shall drive what is in the queue.
void refuse(Block &block, cnc::Queue *queue, int16_t error) noexcept {
  queue->generator = cnc::kByNobody;
  cnc::tellNobodyChecks(queue);
  end(block, error);
}

void checkQueue(Block &block) noexcept {
  cnc::Queue *queue = cnc::queueOf(block.poqDataIn);
  const bool again =
      cnc::checkQueue(queue) == cnc::QueueError::None && queue->recheckVelocities != 0;
  if (again)
    queue->recheckVelocities = 0;
  if (again || block.pQueue != block.poqDataIn)
    block.nChecked = kNothing;
  block.pQueue = block.poqDataIn;
  if (!areRules(block) && cnc::checkQueue(queue) == cnc::QueueError::None) {
    refuse(block, queue, ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER);
    return;
  }
  switch (cnc::checkVelocities(queue, block.nChecked, rulesOf(block))) {
  case cnc::VelocityError::NoQueue:
    end(block, ::st::SM_Error::SMC_ERROR__SMC_NO_OUTQUEUE_TYPE);
    break;
  case cnc::VelocityError::NotPositive:
    refuse(block, queue, ::st::SM_Error::SMC_ERROR__SMC_CV_ACC_DEC_VEL_NONPOSITIVE);
    break;
  case cnc::VelocityError::None:
    __atomic_store_n(&queue->generator, cnc::kByCheckVelocities, __ATOMIC_RELEASE);
    block.bBusy = static_cast<stride::BOOL>(queue->endOfList == 0);
    break;
  }
}

} // namespace

void st::SM_CNC::SMC_CheckVelocities::body__(::stride::Ctx & /*ctx__*/) {
  const bool edge = bExecute != 0 && bOldExecute == 0;
  bOldExecute = bExecute;
  poqDataOut = poqDataIn;
  if (bExecute == 0 || bAbort != 0)
    giveUp(*this);
  else if (edge)
    begin(*this);
  if (bActive != 0)
    checkQueue(*this);
}
