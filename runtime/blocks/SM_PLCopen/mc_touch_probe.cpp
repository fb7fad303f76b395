// MC_TouchProbe and MC_AbortTrigger: positions latched by the drive or by the PLC.
#include "runtime/axis/capture_window.hpp"

#include "st/SM_PLCopen/MC_AbortTrigger.h"
#include "st/SM_PLCopen/MC_TouchProbe.h"

namespace {

namespace axis = ::stride::axis;
using Block = ::st::SM_PLCopen::MC_TouchProbe;
using axis::AxisRef;

constexpr int16_t kOccupied = ::st::SM_Error::SMC_ERROR__SMC_TP_TRIGGEROCCUPIED;
constexpr int16_t kNoWindow = ::st::SM_Error::SMC_ERROR__SMC_TP_COULDNT_SET_WINDOW;
constexpr int16_t kNoDrive = ::st::SM_Error::SMC_ERROR__SMC_TP_COMM_ERROR;
constexpr int16_t kNotOccupied = ::st::SM_Error::SMC_ERROR__SMC_AT_TRIGGERNOTOCCUPIED;

void clearOutputs(Block &block) noexcept {
  block.Done = 0;
  block.CommandAborted = 0;
  block.Error = 0;
  block.ErrorID = axis::error::kNone;
}

void end(Block &block) noexcept {
  block.bRunning = 0;
  block.Busy = 0;
  block.Active = 0;
}

void fail(Block &block, int16_t errorId) noexcept {
  end(block);
  block.Error = 1;
  block.ErrorID = errorId;
  if (block.Axis != nullptr)
    axis::noteError(*block.Axis, errorId);
}

/// Frees trigger and drive's input of a block that waits.
void release(Block &block) noexcept {
  block.TriggerInput->bActive = 0;
  if (block.bFast != 0)
    axis::freeCapture(*block.Axis, block.byInput);
}

bool ownsTrigger(const Block &block) noexcept {
  return block.TriggerInput->bActive != 0 && block.TriggerInput->udiUses == block.udiUse;
}

/// Whether the axis's actual position is one.
bool answers(const AxisRef &ref) noexcept {
  return ref.bCommunication != 0 && ref.wCommunicationState == axis::kNormalOperation;
}

/// Why the block cannot wait for the trigger; kNone if it can.
int16_t refusal(const Block &block) noexcept {
  const AxisRef &ref = *block.Axis;
  const auto &trigger = *block.TriggerInput;
  if (!answers(ref))
    return kNoDrive;
  const int16_t input = axis::captureInput(trigger.iTriggerNumber);
  if (trigger.bFastLatching != 0 && !axis::hasCaptureInput(ref, input))
    return kNoDrive;
  if (trigger.bActive != 0 || (trigger.bFastLatching != 0 && axis::isCaptureClaimed(ref, input)))
    return kOccupied;
  if (block.WindowOnly != 0 && !axis::isCaptureWindow(ref, block.FirstPosition, block.LastPosition))
    return kNoWindow;
  return axis::error::kNone;
}

void start(Block &block) noexcept {
  clearOutputs(block);
  AxisRef &ref = *block.Axis;
  auto &trigger = *block.TriggerInput;
  if (block.bRunning != 0) {
    if (block.pAxis != block.Axis || block.pTrigger != block.TriggerInput) {
      fail(block, axis::error::kAxisChanged);
      return;
    }
    if (ownsTrigger(block))
      release(block);
    end(block);
  }
  if (const int16_t error = refusal(block); error != axis::error::kNone) {
    fail(block, error);
    return;
  }
  block.pAxis = block.Axis;
  block.pTrigger = block.TriggerInput;
  block.bFast = trigger.bFastLatching;
  block.bWindow = block.WindowOnly;
  block.fFirst = block.FirstPosition;
  block.fLast = block.LastPosition;
  trigger.bActive = 1;
  block.udiUse = ++trigger.udiUses;
  block.bRunning = 1;
  block.Busy = 1;
  if (block.bFast == 0)
    return;
  block.byInput = static_cast<uint8_t>(axis::captureInput(trigger.iTriggerNumber));
  axis::claimCapture(ref, block.byInput);
  auto &capture = ref.aCapture.v[block.byInput];
  capture.bWindow = block.bWindow;
  capture.fFirstPosition = block.fFirst;
  capture.fLastPosition = block.fLast;
}

void finish(Block &block, double position) noexcept {
  release(block);
  end(block);
  block.RecordedPosition = position;
  block.Done = 1;
}

void proceed(Block &block) noexcept {
  if (block.pAxis != block.Axis || block.pTrigger != block.TriggerInput) {
    fail(block, axis::error::kAxisChanged);
    return;
  }
  if (!ownsTrigger(block)) {
    end(block);
    block.CommandAborted = 1;
    return;
  }
  const AxisRef &ref = *block.Axis;
  if (block.bFast != 0 && ref.aCapture.v[block.byInput].bOccurred != 0) {
    finish(block, ref.aCapture.v[block.byInput].fPosition);
    return;
  }
  if (!answers(ref) || (block.bFast != 0 && !axis::isCaptureClaimed(ref, block.byInput))) {
    release(block);
    fail(block, kNoDrive);
    return;
  }
  if (block.bFast != 0) {
    block.Active = ((ref.byCaptureArmed >> block.byInput) & 1) != 0;
    return;
  }
  block.Active = 1;
  if (block.TriggerInput->bInput != 0 &&
      (block.bWindow == 0 ||
       axis::inCaptureWindow(ref, block.fFirst, block.fLast, ref.fActPosition)))
    finish(block, ref.fActPosition);
}

} // namespace

void st::SM_PLCopen::MC_TouchProbe::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = Execute != 0 && bExecuteOld == 0;
  bExecuteOld = Execute;
  if (Axis == nullptr || TriggerInput == nullptr) {
    if (rising || bRunning != 0) {
      clearOutputs(*this);
      fail(*this, axis::error::kNoAxis);
    } else if (Execute == 0) {
      clearOutputs(*this);
    }
    return;
  }
  if (rising)
    start(*this);
  if (bRunning != 0)
    proceed(*this);
  else if (Execute == 0)
    clearOutputs(*this);
}

void st::SM_PLCopen::MC_AbortTrigger::body__(::stride::Ctx & /*ctx__*/) {
  const bool rising = Execute != 0 && bExecuteOld == 0;
  bExecuteOld = Execute;
  if (rising || Execute == 0) {
    Done = 0;
    Error = 0;
    ErrorID = axis::error::kNone;
  }
  if (!rising)
    return;
  if (Axis == nullptr || TriggerInput == nullptr) {
    Error = 1;
    ErrorID = axis::error::kNoAxis;
    return;
  }
  if (TriggerInput->bActive == 0) {
    Error = 1;
    ErrorID = kNotOccupied;
    axis::noteError(*Axis, ErrorID);
    return;
  }
  TriggerInput->bActive = 0;
  const int16_t input = axis::captureInput(TriggerInput->iTriggerNumber);
  if (TriggerInput->bFastLatching != 0 && axis::hasCaptureInput(*Axis, input))
    axis::freeCapture(*Axis, input);
  Done = 1;
}
