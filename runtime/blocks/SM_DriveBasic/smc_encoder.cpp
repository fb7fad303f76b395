// SMC_Encoder: an encoder as an axis that only moves by itself.
#include "runtime/app/ctx.h"
#include "runtime/axis/encoder.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/numeric/modulo_wrap.hpp"

#include "st/SM_DriveBasic/SMC_Encoder.h"

namespace {

namespace axis = ::stride::axis;
using Block = ::st::SM_DriveBasic::SMC_Encoder;
using axis::AxisRef;
using axis::EncoderRef;

constexpr int16_t kZeroRatio = ::st::SM_Error::SMC_ERROR__SMC_ENC_DENOM_ZERO;
constexpr int16_t kAxisUsed = ::st::SM_Error::SMC_ERROR__SMC_ENC_AXISUSEDBYOTHERFB;

void report(Block &block, int16_t errorId) noexcept {
  block.bError = 1;
  block.nErrorID = errorId;
}

void feed(Block &block, EncoderRef &encoder) noexcept {
  encoder.bFed = block.bFeed;
  if (block.bFeed != 0) {
    if (block.bFedBefore == 0)
      axis::synchronizeEncoder(encoder, block.dwActPosition);
    else
      axis::updateEncoder(encoder, block.dwActPosition);
  }
  block.bFedBefore = block.bFeed;
}

void configure(AxisRef &ref, const EncoderRef &encoder, double cycle) noexcept {
  ref.wDriveId = encoder.wEncoderId;
  ref.dwRatioTechUnitsDenom = encoder.dwRatioTechUnitsDenom;
  ref.iRatioTechUnitsNum = encoder.iRatioTechUnitsNum;
  ref.iMovementType = encoder.iMovementType;
  ref.fPositionPeriod = encoder.fPositionPeriod;
  ref.bSWLimitEnable = encoder.bSWLimitEnable;
  ref.fSWLimitNegative = encoder.fSWLimitNegative;
  ref.fSWLimitPositive = encoder.fSWLimitPositive;
  ref.fTaskCycle = cycle;
  ref.liTurnDenominator = 1; // its increments count
  ref.bOwnService = 1;
}

/// Whoever wants to move the axis does not succeed.
void refuseOwners(Block &block) noexcept {
  AxisRef &ref = block.Axis;
  if (ref.iOwner == 0 && ref.bRegulatorOn == 0 && ref.bDriveStart == 0)
    return;
  axis::releaseAxis(ref);
  ref.bRegulatorOn = 0;
  ref.bDriveStart = 0;
  report(block, kAxisUsed);
}

void place(Block &block, const EncoderRef &encoder) noexcept {
  AxisRef &ref = block.Axis;
  const auto reduced = [&ref](double position) {
    return axis::isRotary(ref) ? stride::numeric::wrapPosition(position, ref.fPositionPeriod)
                               : position;
  };
  const double raw = axis::encoderPosition(encoder);
  double position = reduced(raw + ref.fOffsetPosition);
  if (block.bSet != 0 && stride::exact::isfinite(block.fSetValue)) {
    position = reduced(block.fSetValue);
    ref.fOffsetPosition = position - raw;
  }
  const double perIncrement = static_cast<double>(encoder.iRatioTechUnitsNum) /
                              static_cast<double>(encoder.dwRatioTechUnitsDenom);
  double velocity = 0.0;
  double acceleration = 0.0;
  if (block.bValidBefore != 0 && ref.fTaskCycle > 0.0) {
    velocity = static_cast<double>(encoder.liStep) * perIncrement / ref.fTaskCycle;
    acceleration = (velocity - ref.fActVelocity) / ref.fTaskCycle;
  }
  ref.fScalefactor = perIncrement;
  ref.fFactorVel = perIncrement;
  ref.fFactorAcc = perIncrement;
  ref.fSavePosition = ref.fSetPosition;
  ref.fSaveVelocity = ref.fSetVelocity;
  ref.fSaveAcceleration = ref.fSetAcceleration;
  ref.liActIncrements = encoder.liActIncrements;
  ref.liSetIncrements = encoder.liActIncrements;
  ref.fActPosition = position;
  ref.fSetPosition = position;
  axis::writeMotion(ref, velocity, acceleration);
  ref.fActVelocity = ref.fSetVelocity;
  ref.fActAcceleration = ref.fSetAcceleration;
  ref.fActDeceleration = ref.fSetDeceleration;
}

/// The position window of a linear encoder.
void supervise(Block &block) noexcept {
  AxisRef &ref = block.Axis;
  const bool outside =
      block.bValid != 0 && ref.bSWLimitEnable != 0 && !axis::isRotary(ref) &&
      (ref.fActPosition > ref.fSWLimitPositive || ref.fActPosition < ref.fSWLimitNegative);
  ref.bSWEndSwitchActive = outside;
  if (outside && ref.nAxisState != axis::state::kErrorStop) {
    axis::noteError(ref, axis::error::kSwLimits);
    ref.nAxisState = axis::state::kErrorStop;
  } else if (!outside && (ref.nAxisState != axis::state::kErrorStop || ref.bErrorAckn != 0)) {
    if (ref.nAxisState == axis::state::kErrorStop)
      ref.wFBErrorID = 0;
    ref.nAxisState = axis::state::kPowerOff;
  }
  ref.bErrorAckn = 0;
  if (ref.nAxisState == axis::state::kErrorStop && block.bError == 0)
    report(block, axis::error::kSwLimits);
}

} // namespace

void st::SM_DriveBasic::SMC_Encoder::body__(::stride::Ctx &ctx__) {
  bValid = 0;
  bError = 0;
  nErrorID = axis::error::kNone;
  if (Encoder == nullptr) {
    report(*this, axis::error::kNoAxis);
    return;
  }
  EncoderRef &encoder = *Encoder;
  feed(*this, encoder);
  const double cycle = encoder.fTaskCycle > 0.0 ? encoder.fTaskCycle
                                                : static_cast<double>(ctx__.taskIntervalNs) * 1e-9;
  configure(Axis, encoder, cycle);
  refuseOwners(*this);
  if (!axis::usableEncoder(encoder))
    report(*this, kZeroRatio);
  else if (encoder.bValid != 0)
    bValid = 1;
  if (bValid != 0)
    place(*this, encoder);
  bValidBefore = bValid;
  Axis.bCommunication = bValid;
  Axis.wCommunicationState = bValid != 0 ? axis::kNormalOperation : uint16_t{0};
  Axis.bMovedInThisCycle = 1;
  supervise(*this);
}
