#include "runtime/bus/drive_group.hpp"

#include "runtime/axis/axis_cycle.hpp"
#include "runtime/axis/increments.hpp"
#include "runtime/axis/parameter_channel.hpp"
#include "runtime/axis/set_point.hpp"
#include "runtime/axis/shift_position.hpp"
#include "runtime/bus/capture.hpp"
#include "runtime/bus/drive_restart.hpp"

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

constexpr uint8_t kCaptureInputs = (1U << DriveStatus::kCaptureInputs) - 1;

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

DriveGroup::DriveGroup(std::unique_ptr<AxisDriver> driver, AxisGroupRef &group,
                       std::vector<axis::AxisRef *> axes, double cycleSeconds,
                       std::vector<axis::EncoderRef *> encoders)
    : driver_(std::move(driver)), group_(&group), axes_(std::move(axes)),
      encoders_(std::move(encoders)), acknowledged_(axes_.size()) {
  group_->wState = 0;
  group_->wDriveCount = static_cast<uint16_t>(axes_.size());
  group_->pFirstDrive = axes_.empty() ? nullptr : axes_.front();
  for (size_t i = 0; i < axes_.size(); ++i) {
    axis::AxisRef &axis = *axes_[i];
    axis.bRealDrive = 1;
    axis.stRestart.bDrive = 1;
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

/// What has not been heard of for a while may be anywhere: it begins where it is then.
void DriveGroup::readEncoders() {
  for (size_t i = 0; i < encoders_.size(); ++i) {
    axis::EncoderRef &encoder = *encoders_[i];
    if (encoder.bFed != 0)
      continue;
    if (!driver_->encoderWorks(i))
      encoder.bValid = 0;
    else if (encoder.bValid == 0)
      axis::synchronizeEncoder(encoder, driver_->encoder(i));
    else
      axis::updateEncoder(encoder, driver_->encoder(i));
  }
}

bool DriveGroup::resetting() const {
  return group_->wState >= kResetBraking && group_->wState <= kResetLast;
}

void DriveGroup::startUp() {
  uint16_t least = axis::kNormalOperation;
  for (size_t i = 0; i < axes_.size(); ++i) {
    axis::AxisRef &axis = *axes_[i];
    if (axis.bDisableDriveInAxisGroup != 0 || axis.bRealDrive == 0 || isRestarting(axis) ||
        axis.wCommunicationState == axis::kNormalOperation)
      continue;
    uint16_t failure = 0;
    if (startDrive(i, failure) == StartUp::Failed) {
      group_->pErrorDrive = &axis;
      group_->wState = failure;
      return;
    }
    least = std::min(least, axis.wCommunicationState);
  }
  group_->wState = least;
}

/// One step of the start-up of a drive. Failed: `failure` is what the state of the group becomes
/// when it is the group that starts.
StartUp DriveGroup::startDrive(size_t index, uint16_t &failure) {
  axis::AxisRef &axis = *axes_[index];
  Message message;
  uint16_t progress = 0;
  const StartUp result = driver_->init(index, progress, message);
  if (result == StartUp::Busy)
    axis.wCommunicationState = std::min<uint16_t>(progress, axis::kNormalOperation - 1);
  if (result == StartUp::Failed) {
    failure = kDriveFailed;
    startFailed(index, message.text());
  }
  if (result != StartUp::Started)
    return result;
  if (const axis::ScalingError problem = axis::configureScaling(axis);
      problem != axis::ScalingError::None) {
    failure = kScalingFailed;
    startFailed(index, describe(problem));
    return StartUp::Failed;
  }
  axis.wCommunicationState = axis::kNormalOperation;
  axis.byControllerModes = driver_->controllerModes(index);
  axis.byCaptureInputs = driver_->captureInputs(index) & kCaptureInputs;
  axis::synchronizePosition(axis, driver_->status(index).position);
  return StartUp::Started;
}

void DriveGroup::startFailed(size_t index, std::string_view message) {
  axis::AxisRef &axis = *axes_[index];
  axis.bErrorDuringStartup = 1;
  failedDrive_ = index;
  bootupError_.set(std::string_view("drive "), uint32_t{axis.wDriveId}, std::string_view(": "),
                   message);
}

/// Whoever moves an axis loses it; moving axes brake.
void DriveGroup::beginReset() {
  group_->udiResetsBegun = group_->udiResetsAsked;
  group_->wState = kResetBraking;
  resetCycles_ = 0;
  brakeAll();
}

void DriveGroup::brakeAll() {
  for (axis::AxisRef *axis : axes_)
    if (isServed(*axis))
      brakeForRestart(*axis);
}

void DriveGroup::stepReset() {
  switch (group_->wState) {
  case kResetBraking:
    brakeAll(); // a program that resets its axes goes on moving them
    if (axesAtRest())
      group_->wState = kResetPowerOff;
    break;
  case kResetPowerOff:
    if (!anyPower() || ++resetCycles_ >= kPowerOffCycles)
      group_->wState = kResetDrives;
    break;
  default:
    for (size_t i = 0; i < axes_.size(); ++i)
      if (axes_[i]->bRealDrive != 0)
        restart(i, group_->bKeepRatioSettings != 0);
    driver_->resetOthers();
    for (axis::EncoderRef *encoder : encoders_)
      if (encoder->bFed == 0)
        encoder->bValid = 0;
    group_->pErrorDrive = nullptr;
    bootupError_.set();
    failedDrive_ = kNoDrive;
    group_->wState = 0;
    break;
  }
}

/// Back to where the axis was before its first start-up.
void DriveGroup::restart(size_t index, bool keepRatio) {
  axis::AxisRef &axis = *axes_[index];
  dropParameters(index);
  driver_->reset(index);
  if (!keepRatio) {
    const Scaling &scaling = configured_[index];
    axis.dwRatioTechUnitsDenom = scaling.denominator;
    axis.iRatioTechUnitsNum = scaling.numerator;
    axis.iMovementType = scaling.movementType;
    axis.fPositionPeriod = scaling.period;
  }
  axis.iOwner = 0;
  axis::haltAt(axis);
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
  return std::any_of(axes_.begin(), axes_.end(),
                     [](const axis::AxisRef *axis) { return hasPower(*axis); });
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

/// Errors of the drive and of the bus, and the way out of them. TRUE: it has gone that way.
bool followErrors(axis::AxisRef &axis, const DriveStatus &status) {
  if (axis.nAxisState == axis::state::kErrorStop) {
    if (status.homing != Homing::Running) // it is not at rest yet
      axis::acknowledge(axis);
    return axis.nAxisState != axis::state::kErrorStop;
  }
  if (!status.communication)
    axis::enterErrorStop(axis, axis::error::kCommunication);
  else if (status.error)
    axis::enterErrorStop(axis, axis::error::kDrive);
  return false;
}

/// The drive's reference run, started by MC_Home: the position at the reference becomes fReference.
void readHoming(axis::AxisRef &axis, const DriveStatus &status) {
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

/// The set position follows the actual one where no position is regulated, and during a reference
/// run of the drive.
void followDrive(axis::AxisRef &axis, const DriveStatus &status) {
  if (axis::isDriveHoming(axis)) {
    readHoming(axis, status);
    axis::followActual(axis);
    return;
  }
  axis.bStartReference = 0;
  axis.byHoming = static_cast<uint8_t>(axis::DriveHoming::None);
  if (status.homing == Homing::Running && axis::isPowered(axis))
    axis::brakeWithDrive(axis);
  else if (axis::regulated(axis) != axis::Regulated::Position)
    axis::followActual(axis);
}

/// TRUE: its error has been acknowledged.
bool readDrive(const AxisDriver &driver, size_t index, axis::AxisRef &axis) {
  if (!isServed(axis)) {
    if (axis.bRealDrive != 0)
      axis.bMovedInThisCycle = 0;
    return false;
  }
  const DriveStatus status = driver.status(index);
  const uint8_t before = axis.byRealControllerMode;
  readState(axis, status);
  readActual(axis, status);
  readCaptures(axis, status);
  const bool acknowledged = followErrors(axis, status);
  if (!axis::isPowered(axis))
    axis::leaveUnpowered(axis);
  else if (axis.nAxisState == axis::state::kPowerOff)
    axis.nAxisState = axis::state::kStandstill;
  if (axis.byRealControllerMode != before)
    axis::changeRegulated(axis, axis::regulatedIn(axis, before));
  followDrive(axis, status);
  axis::beginCycle(axis);
  return acknowledged;
}

/// Where a torque takes the axis in this cycle: what the drive is told must lie there when it
/// regulates positions or velocities again. Returns that velocity. [u/s]
double leadOn(const AxisDriver &driver, size_t index, axis::AxisRef &axis) {
  // Set values that stand for actual ones say nothing.
  if ((driver.status(index).received & (kPosition | kVelocity)) == 0 || !axis::isPowered(axis))
    return 0.0;
  const double way = axis.fActVelocity * axis.fTaskCycle + axis::wayOfLag(axis, axis.fActVelocity);
  axis.fSetPosition = axis::shownPosition(axis, axis.fSetPosition + way);
  (void)axis::updateSet(axis, way);
  return axis.fActVelocity;
}

/// The set position as increments. Returns the velocity that the drive is told. [u/s]
double placeSet(const AxisDriver &driver, size_t index, axis::AxisRef &axis) {
  if (axis::isDriveHoming(axis))
    return axis.fSetVelocity;
  const axis::Regulated regulated = axis::regulated(axis);
  if (regulated == axis::Regulated::Force)
    return leadOn(driver, index, axis);
  if (axis.bMovedInThisCycle == 0)
    return axis.fSetVelocity;
  const double travel =
      regulated == axis::Regulated::Velocity ? axis::settleOnActual(axis) : axis::wayOfCycle(axis);
  if (!axis::updateSet(axis, travel)) {
    // Unlike the other error stops this one is abrupt: there is no range left to brake in.
    axis.fSetPosition = axis.fSavePosition;
    axis.fSetVelocity = 0.0;
    axis::enterErrorStop(axis, axis::error::kOutOfRange);
  }
  return axis.fSetVelocity;
}

/// `power`: the group lets its drives have it. `acknowledged`: the error of the axis has been, in
/// this cycle. What was asked before that may have been lost with the drive.
void writeDrive(AxisDriver &driver, size_t index, axis::AxisRef &axis, bool power,
                bool acknowledged) {
  axis::supervise(axis);
  const double velocity = placeSet(driver, index, axis);
  DriveCommand command;
  command.position = static_cast<uint32_t>(axis.liSetIncrements);
  command.velocity = velocity / axis.fFactorVel;
  command.acceleration = axis.fSetAcceleration / axis.fFactorAcc;
  command.torque = axis.fSetTorque / axis.fFactorTor;
  command.current = axis.fSetCurrent;
  const bool on = power && !isSwitchedOff(axis);
  command.regulatorOn = on && axis.bRegulatorOn != 0;
  command.driveStart = on && axis.bDriveStart != 0;
  command.errorAckn = axis.bErrorAckn != 0 || acknowledged;
  command.homing = axis::isDriveHoming(axis);
  writeCaptures(axis, driver, index, command);
  command.controllerMode = axis.byControllerMode;
  driver.command(index, command);
}

} // namespace

void DriveGroup::executeStart() {
  ++group_->udiCycleCount;
  driver_->executeStart();
  if (group_->udiResetsBegun != group_->udiResetsAsked)
    beginReset();
  else if (resetting())
    stepReset();
  if (group_->wState < axis::kNormalOperation)
    startUp();
  const bool begins = resetting();
  AxisDriver &driver = *driver_;
  axis::AxisRef *const *const axes = axes_.data();
  for (size_t i = 0, count = axes_.size(); i < count; ++i) {
    axis::AxisRef &axis = *axes[i];
    if (begins || asksForRestart(axis))
      serveRestart(i);
    acknowledged_[i] = readDrive(driver, i, axis) ? 1 : 0;
    if (axis::channelStep(axis.stChannel) != axis::ChannelStep::Idle)
      serveParameters(i);
  }
  if (group_->wState == axis::kNormalOperation)
    readEncoders();
}

void DriveGroup::executeEnd() {
  const bool power = group_->wState != kResetPowerOff;
  AxisDriver &driver = *driver_;
  axis::AxisRef *const *const axes = axes_.data();
  for (size_t i = 0, count = axes_.size(); i < count; ++i)
    if (axis::AxisRef &axis = *axes[i]; isServed(axis))
      writeDrive(driver, i, axis, power, acknowledged_[i] != 0);
  driver.executeEnd();
}

void DriveGroup::stopAll() {
  for (axis::AxisRef *axis : axes_) {
    if (isServed(*axis) && axis->nAxisState != axis::state::kErrorStop && axis->fSetVelocity != 0.0)
      axis::enterErrorStop(*axis, axis::error::kNotCalled);
  }
  driver_->applicationStopped();
}

bool DriveGroup::axesAtRest() const {
  return std::all_of(axes_.begin(), axes_.end(), [](const axis::AxisRef *axis) {
    return axis->bRealDrive == 0 || axis->fSetVelocity == 0.0;
  });
}

} // namespace stride::bus
