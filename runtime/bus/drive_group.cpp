#include "runtime/bus/drive_group.hpp"

#include "runtime/axis/increments.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/axis/shift_position.hpp"
#include "runtime/bus/capture.hpp"

#include "st/SM_DriveBasic/SMC_CONTROLLER_MODE.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stride::bus {
namespace {

// SMC_AXISGROUP_REF.wState while the group is being reset …
constexpr uint16_t kResetBraking = 200;  ///< Moving axes come to rest.
constexpr uint16_t kResetPowerOff = 201; ///< Regulators go off.
constexpr uint16_t kResetDrives = 202;   ///< Drives are given up; then the start-up begins.
constexpr uint16_t kResetLast = 210;
// … and when its start-up has failed.
constexpr uint16_t kDriveFailed = 1000;   ///< The driver says why.
constexpr uint16_t kScalingFailed = 1001; ///< Ratio or period cannot be used.

// AXIS_REF.byRealControllerMode
constexpr uint8_t kTorqueControl = ::st::SM_DriveBasic::SMC_CONTROLLER_MODE__SMC_torque;
constexpr uint8_t kCurrentControl = ::st::SM_DriveBasic::SMC_CONTROLLER_MODE__SMC_current;

constexpr uint32_t kPowerOffCycles =
    1000; ///< A drive that does not switch off does not block a reset.

constexpr uint8_t kCaptureInputs = (1U << DriveStatus::kCaptureInputs) - 1;

bool isMotion(int16_t axisState) {
  return axisState == axis::state::kDiscrete || axisState == axis::state::kContinuous ||
         axisState == axis::state::kSynchronized || axisState == axis::state::kHoming;
}

void haltAt(axis::AxisRef &axis) {
  axis::writeMotion(axis, 0.0, 0.0);
  axis.stPlanner.bActive = 0;
}

/// Power is gone, or not yet there: nobody owns the axis and its set position follows the drive.
void leaveUnpowered(axis::AxisRef &axis) {
  if (axis.iOwner != 0)
    axis.stPlanner.wStopReason = static_cast<uint16_t>(axis::error::kNotPowered);
  axis::releaseAxis(axis);
  axis.stQueue.uiCount = 0;
  axis::endSuperimposed(axis);
  haltAt(axis);
  axis::followActual(axis);
  if (axis.nAxisState != axis::state::kErrorStop)
    axis.nAxisState = axis::state::kPowerOff;
}

std::string_view describe(axis::ScalingError problem) {
  switch (problem) {
  case axis::ScalingError::ZeroRatio:
    return "dwRatioTechUnitsDenom and iRatioTechUnitsNum must be greater than 0";
  case axis::ScalingError::BadPeriod:
    return "fPositionPeriod must be at least one increment";
  case axis::ScalingError::PeriodTooLarge:
    return "fPositionPeriod is more than 16#80000000 increments";
  case axis::ScalingError::None:
    break;
  }
  return {};
}

} // namespace

void enterErrorStop(axis::AxisRef &axis, int16_t reason) noexcept {
  auto &plan = axis.stPlanner;
  const double commanded = plan.fDeceleration;
  axis.iOwner = 0;
  axis.stQueue.uiCount = 0;
  axis::endSuperimposed(axis);
  axis.nAxisState = axis::state::kErrorStop;
  axis.wFBErrorID = static_cast<uint16_t>(reason);
  axis::listError(axis, reason);
  plan.wStopReason = static_cast<uint16_t>(reason);
  plan.bActive = 0;
  const double deceleration =
      std::max(exact::isPositive(axis.fSWMaxDeceleration) ? axis.fSWMaxDeceleration : 0.0,
               exact::isPositive(commanded) ? commanded : 0.0);
  const double velocity = axis.fSetVelocity;
  if (!(deceleration > 0.0) || velocity == 0.0 || !std::isfinite(velocity)) {
    axis::writeMotion(axis, 0.0, 0.0);
    return;
  }
  const double duration = std::fabs(velocity) / deceleration;
  const double target = axis.fSetPosition + 0.5 * velocity * duration;
  axis::beginPlan(plan, axis.fTaskCycle, duration, target, 0.0);
  plan.fTarget = axis::shownPosition(axis, target);
  plan.fDeceleration = deceleration;
  axis::appendSegment(plan, 0.0, duration,
                      {target, 0.0, velocity > 0.0 ? -deceleration : deceleration}, 0.0, 0.0);
}

DriveGroup::DriveGroup(std::unique_ptr<AxisDriver> driver, AxisGroupRef &group,
                       std::vector<axis::AxisRef *> axes, double cycleSeconds,
                       std::vector<axis::EncoderRef *> encoders)
    : driver_(std::move(driver)), group_(&group), axes_(std::move(axes)),
      encoders_(std::move(encoders)) {
  group_->wState = 0;
  group_->wDriveCount = static_cast<uint16_t>(axes_.size());
  group_->pFirstDrive = axes_.empty() ? nullptr : axes_.front();
  for (size_t i = 0; i < axes_.size(); ++i) {
    axis::AxisRef &axis = *axes_[i];
    axis.bRealDrive = 1;
    axis.fTaskCycle = cycleSeconds;
    axis.nAxisState = axis::state::kPowerOff;
    axis.wCommunicationState = 0;
    axis.pNextDrive = i + 1 < axes_.size() ? axes_[i + 1] : nullptr;
    configured_.push_back({axis.dwRatioTechUnitsDenom, axis.iRatioTechUnitsNum, axis.iMovementType,
                           axis.fPositionPeriod});
    driver_->bindData(i, axis.pMS);
  }
  for (axis::EncoderRef *encoder : encoders_) {
    encoder->fTaskCycle = cycleSeconds;
    encoder->bValid = 0;
  }
}

void DriveGroup::executeStart() {
  ++group_->udiCycleCount;
  driver_->executeStart();
  if (group_->udiResetsBegun != group_->udiResetsAsked)
    beginReset();
  else if (group_->wState >= kResetBraking && group_->wState <= kResetLast)
    stepReset();
  if (group_->wState < axis::kNormalOperation)
    startUp();
  for (size_t i = 0; i < axes_.size(); ++i) {
    readDrive(i);
    serveParameters(i);
  }
  if (group_->wState == axis::kNormalOperation)
    for (size_t i = 0; i < encoders_.size(); ++i)
      if (encoders_[i]->bFed == 0)
        axis::updateEncoder(*encoders_[i], driver_->encoder(i));
}

void DriveGroup::startUp() {
  uint16_t least = axis::kNormalOperation;
  for (size_t i = 0; i < axes_.size(); ++i) {
    axis::AxisRef &axis = *axes_[i];
    if (axis.bDisableDriveInAxisGroup != 0 || axis.wCommunicationState == axis::kNormalOperation)
      continue;
    Message message;
    uint16_t progress = 0;
    switch (driver_->init(i, progress, message)) {
    case StartUp::Busy:
      axis.wCommunicationState = std::min<uint16_t>(progress, axis::kNormalOperation - 1);
      break;
    case StartUp::Started:
      if (const axis::ScalingError problem = axis::configureScaling(axis);
          problem != axis::ScalingError::None) {
        startFailed(i, kScalingFailed, describe(problem));
        return;
      }
      axis.wCommunicationState = axis::kNormalOperation;
      axis.byControllerModes = driver_->controllerModes(i);
      axis.byCaptureInputs = driver_->captureInputs(i) & kCaptureInputs;
      axis::synchronizePosition(axis, driver_->status(i).position);
      break;
    case StartUp::Failed:
      startFailed(i, kDriveFailed, message.text());
      return;
    }
    least = std::min(least, axis.wCommunicationState);
  }
  group_->wState = least;
  if (least == axis::kNormalOperation)
    for (size_t i = 0; i < encoders_.size(); ++i)
      if (encoders_[i]->bFed == 0)
        axis::synchronizeEncoder(*encoders_[i], driver_->encoder(i));
}

void DriveGroup::startFailed(size_t index, uint16_t state, std::string_view message) {
  axis::AxisRef &axis = *axes_[index];
  axis.bErrorDuringStartup = 1;
  group_->pErrorDrive = &axis;
  group_->wState = state;
  bootupError_.set(std::string_view("drive "), uint32_t{axis.wDriveId}, std::string_view(": "),
                   message);
}

/// Whoever moves an axis loses it; moving axes brake.
void DriveGroup::beginReset() {
  group_->udiResetsBegun = group_->udiResetsAsked;
  group_->wState = kResetBraking;
  resetCycles_ = 0;
  for (axis::AxisRef *axis : axes_)
    if (axis->wCommunicationState == axis::kNormalOperation &&
        axis->nAxisState != axis::state::kErrorStop && axis->nAxisState != axis::state::kPowerOff)
      enterErrorStop(*axis, axis::error::kNone);
}

void DriveGroup::stepReset() {
  switch (group_->wState) {
  case kResetBraking:
    if (axesAtRest())
      group_->wState = kResetPowerOff;
    break;
  case kResetPowerOff:
    if (!anyPower() || ++resetCycles_ >= kPowerOffCycles)
      group_->wState = kResetDrives;
    break;
  default:
    for (size_t i = 0; i < axes_.size(); ++i)
      restart(i);
    for (axis::EncoderRef *encoder : encoders_)
      if (encoder->bFed == 0)
        encoder->bValid = 0;
    group_->pErrorDrive = nullptr;
    bootupError_.set();
    group_->wState = 0;
    break;
  }
}

/// Back to where the axis was before its first start-up.
void DriveGroup::restart(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  dropParameters(index);
  driver_->reset(index);
  if (group_->bKeepRatioSettings == 0) {
    const Scaling &scaling = configured_[index];
    axis.dwRatioTechUnitsDenom = scaling.denominator;
    axis.iRatioTechUnitsNum = scaling.numerator;
    axis.iMovementType = scaling.movementType;
    axis.fPositionPeriod = scaling.period;
  }
  axis.iOwner = 0;
  haltAt(axis);
  axis.stPlanner.wStopReason = 0;
  axis.nAxisState = axis::state::kPowerOff;
  axis.wCommunicationState = 0;
  axis.bCommunication = 0;
  axis.bRegulatorRealState = 0;
  axis.bDriveStartRealState = 0;
  axis.bError = 0;
  axis.wErrorID = 0;
  axis.wFBErrorID = 0;
  axis.stFBErrors.uiCount = 0;
  axis.bErrorAckn = 0;
  axis.bErrorDuringStartup = 0;
  clearCaptures(axis);
  axis.fActVelocity = 0;
  axis.fActAcceleration = 0;
  axis.fActDeceleration = 0;
}

bool DriveGroup::anyPower() const {
  return std::any_of(axes_.begin(), axes_.end(), [](const axis::AxisRef *axis) {
    return axis->bRegulatorRealState != 0 || axis->bDriveStartRealState != 0;
  });
}

namespace {

/// What the drive says of itself.
void readState(axis::AxisRef &axis, const DriveStatus &status) {
  axis.bCommunication = status.communication;
  axis.bRegulatorRealState = status.communication && status.regulatorOn;
  axis.bDriveStartRealState = status.communication && status.driveStarted;
  axis.byRealControllerMode = status.controllerMode;
  axis.bError = status.error;
  axis.wErrorID = status.error ? status.errorId : uint16_t{0};
  axis.bLimitSwitchPositive = status.limitPositive;
  axis.bLimitSwitchNegative = status.limitNegative;
  axis.bHomeSwitch = status.homeSwitch;
}

/// Actual values. Without a position from the drive the set position stands for it, without a
/// velocity its change.
void readActual(axis::AxisRef &axis, const DriveStatus &status) {
  const int64_t before = axis.liActIncrements;
  const bool hasPosition = (status.received & kPosition) != 0;
  axis::updateActual(axis,
                     hasPosition ? status.position : static_cast<uint32_t>(axis.liSetIncrements));
  double velocity = status.velocity * axis.fFactorVel;
  if ((status.received & kVelocity) == 0)
    velocity = axis.fTaskCycle > 0.0 ? static_cast<double>(axis.liActIncrements - before) *
                                           axis.fFactorVel / axis.fTaskCycle
                                     : 0.0;
  if (axis.fTaskCycle > 0.0) {
    axis.fActAcceleration = (velocity - axis.fActVelocity) / axis.fTaskCycle;
    axis.fActDeceleration =
        axis.fActAcceleration * velocity < 0.0 ? std::fabs(axis.fActAcceleration) : 0.0;
  }
  axis.fActVelocity = velocity;
  if ((status.received & kTorque) != 0)
    axis.fActTorque = status.torque * axis.fFactorTor;
  if ((status.received & kCurrent) != 0)
    axis.fActCurrent = status.current;
}

/// Errors of the drive and of the bus, and the way out of them.
void followErrors(axis::AxisRef &axis, const DriveStatus &status) {
  if (axis.nAxisState != axis::state::kErrorStop) {
    if (!status.communication)
      enterErrorStop(axis, axis::error::kCommunication);
    else if (status.error)
      enterErrorStop(axis, axis::error::kDrive);
  } else if (axis.bErrorAckn != 0 && status.communication && !status.error &&
             axis.fSetVelocity == 0.0) {
    axis.bErrorAckn = 0;
    axis.wFBErrorID = 0;
    axis.stPlanner.wStopReason = 0;
    axis.nAxisState = axis::state::kPowerOff;
  }
}

/// The set values with which the cycle begins; nobody has moved the axis in it.
void beginCycle(axis::AxisRef &axis) {
  axis.fSavePosition = axis.fSetPosition;
  axis.fSaveVelocity = axis.fSetVelocity;
  axis.fSaveAcceleration = axis.fSetAcceleration;
  axis.fSaveDeceleration = axis.fSetDeceleration;
  axis.bMovedInThisCycle = 0;
  axis.bTravelGiven = 0;
  axis.stSuperimposed.bMovedInThisCycle = 0;
  axis.bHWLimitIgnored = 0;
}

} // namespace

void DriveGroup::readDrive(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  if (axis.wCommunicationState != axis::kNormalOperation) {
    axis.bMovedInThisCycle = 0;
    return;
  }
  const DriveStatus status = driver_->status(index);
  readState(axis, status);
  readActual(axis, status);
  readCaptures(axis, status);
  followErrors(axis, status);
  if (!axis::isPowered(axis))
    leaveUnpowered(axis);
  else if (axis.nAxisState == axis::state::kPowerOff)
    axis.nAxisState = axis::state::kStandstill;
  readHoming(axis, status);
  if (followsDrive(axis))
    axis::followActual(axis);
  beginCycle(axis);
}

/// Whether the drive moves the axis by itself, so that the set position follows the actual one: a
/// regulated torque or current goes where it takes the axis, a reference run where the switch is.
bool DriveGroup::followsDrive(const axis::AxisRef &axis) const {
  return axis.byRealControllerMode == kTorqueControl ||
         axis.byRealControllerMode == kCurrentControl || axis::isDriveHoming(axis);
}

/// The drive's reference run, started by MC_Home: the position at the reference becomes fReference.
void DriveGroup::readHoming(axis::AxisRef &axis, const DriveStatus &status) {
  if (!axis::isDriveHoming(axis)) {
    axis.bStartReference = 0;
    axis.byHoming = static_cast<uint8_t>(axis::DriveHoming::None);
    return;
  }
  switch (status.homing) {
  case Homing::None:
    break;
  case Homing::Running:
    axis.byHoming = static_cast<uint8_t>(axis::DriveHoming::Running);
    break;
  case Homing::Found:
    if (axis.byHoming != static_cast<uint8_t>(axis::DriveHoming::Found))
      axis::shiftPosition(axis, axis.fReference - axis::positionOf(axis, status.homePosition));
    axis.byHoming = static_cast<uint8_t>(axis::DriveHoming::Found);
    break;
  case Homing::Failed:
    axis.byHoming = static_cast<uint8_t>(axis::DriveHoming::Failed);
    break;
  }
  axis::writeMotion(axis, axis.fActVelocity, 0.0);
}

void DriveGroup::supervise(axis::AxisRef &axis) {
  if (!axis::isPowered(axis)) {
    leaveUnpowered(axis);
    return;
  }
  // Whoever moves an axis does it in every cycle.
  if (axis.stSuperimposed.ulOwner != 0 && axis.stSuperimposed.bMovedInThisCycle == 0) {
    enterErrorStop(axis, axis::error::kNotCalled);
  } else if (axis.bMovedInThisCycle == 0) {
    // An owner that has failed said why.
    const auto reason = static_cast<int16_t>(axis.stPlanner.wStopReason);
    if (axis.iOwner != 0 && isMotion(axis.nAxisState))
      enterErrorStop(axis, reason != axis::error::kNone ? reason : axis::error::kNotCalled);
    else if (axis.nAxisState == axis::state::kStopping && axis.stPlanner.bActive != 0)
      enterErrorStop(axis, axis::error::kStopBlocks);
  }
  if (axis.iMovementType != 0) {
    const bool above = axis.fSetPosition > axis.fSWLimitPositive;
    const bool below = axis.fSetPosition < axis.fSWLimitNegative;
    axis.bSWEndSwitchActive = axis.bSWLimitEnable != 0 && (above || below);
    const bool outward = (above && axis.fSetPosition > axis.fSavePosition) ||
                         (below && axis.fSetPosition < axis.fSavePosition);
    if (axis.bHWLimitEnable != 0 && axis.bHWLimitIgnored == 0 &&
        axis.nAxisState != axis::state::kErrorStop &&
        (axis.bLimitSwitchPositive != 0 || axis.bLimitSwitchNegative != 0))
      enterErrorStop(axis, axis::error::kHwLimits);
    // Before homing is over the software limits mean nothing.
    if (axis.bSWEndSwitchActive != 0 && outward && axis.nAxisState != axis::state::kErrorStop &&
        axis.nAxisState != axis::state::kHoming)
      enterErrorStop(axis, axis::error::kSwLimits);
  }
  if (axis.nAxisState != axis::state::kErrorStop)
    return;
  if (axis.stPlanner.bActive != 0 && axis.bMovedInThisCycle == 0)
    (void)axis::stepPlan(axis);
  axis.fSetTorque = 0.0; // no set position brakes a drive that regulates a torque
  axis.fSetCurrent = 0.0;
}

void DriveGroup::writeDrive(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  if (axis.wCommunicationState != axis::kNormalOperation)
    return;
  supervise(axis);
  if (axis.bMovedInThisCycle != 0 && !axis::isDriveHoming(axis)) {
    const double travel = axis.bTravelGiven != 0
                              ? axis.fTravel
                              : 0.5 * (axis.fSaveVelocity + axis.fSetVelocity) * axis.fTaskCycle;
    if (!axis::updateSet(axis, travel)) {
      // Unlike the other error stops this one is abrupt: there is no range left to brake in.
      axis.fSetPosition = axis.fSavePosition;
      axis.fSetVelocity = 0.0;
      enterErrorStop(axis, axis::error::kOutOfRange);
    }
  }
  DriveCommand command;
  command.position = static_cast<uint32_t>(axis.liSetIncrements);
  command.velocity = axis.fSetVelocity / axis.fFactorVel;
  command.acceleration = axis.fSetAcceleration / axis.fFactorAcc;
  command.torque = axis.fSetTorque / axis.fFactorTor;
  command.current = axis.fSetCurrent;
  const bool power = group_->wState != kResetPowerOff;
  command.regulatorOn = power && axis.bRegulatorOn != 0;
  command.driveStart = power && axis.bDriveStart != 0;
  command.errorAckn = axis.bErrorAckn != 0;
  command.homing = axis::isDriveHoming(axis);
  writeCaptures(axis, *driver_, index, command);
  command.controllerMode = axis.byControllerMode;
  driver_->command(index, command);
}

void DriveGroup::executeEnd() {
  for (size_t i = 0; i < axes_.size(); ++i)
    writeDrive(i);
  driver_->executeEnd();
}

void DriveGroup::stopAll() {
  for (axis::AxisRef *axis : axes_) {
    if (axis->wCommunicationState == axis::kNormalOperation &&
        axis->nAxisState != axis::state::kErrorStop && axis->fSetVelocity != 0.0)
      enterErrorStop(*axis, axis::error::kNotCalled);
  }
  driver_->applicationStopped();
}

bool DriveGroup::axesAtRest() const {
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const axis::AxisRef *axis) { return axis->fSetVelocity == 0.0; });
}

} // namespace stride::bus
