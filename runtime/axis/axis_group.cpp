#include "runtime/axis/axis_group.hpp"

#include "runtime/axis/increments.hpp"
#include "runtime/axis/set_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stride::axis {
namespace {

constexpr uint16_t kNormalOperation = 100;
constexpr uint16_t kStartUpFailed = 1000;

bool usable(double limit) { return std::isfinite(limit) && limit > 0.0; }

bool isMotion(int16_t axisState) {
  return axisState == state::kDiscrete || axisState == state::kContinuous ||
         axisState == state::kSynchronized || axisState == state::kHoming;
}

void haltAt(AxisRef &axis) {
  writeMotion(axis, 0.0, 0.0);
  axis.stPlanner.bActive = 0;
}

/// Power is gone, or not yet there: nobody owns the axis and its set position follows the drive.
void leaveUnpowered(AxisRef &axis) {
  if (axis.iOwner != 0)
    axis.stPlanner.wStopReason = static_cast<uint16_t>(error::kNotPowered);
  releaseAxis(axis);
  haltAt(axis);
  followActual(axis);
  if (axis.nAxisState != state::kErrorStop)
    axis.nAxisState = state::kPowerOff;
}

std::string describe(ScalingError problem) {
  switch (problem) {
  case ScalingError::ZeroRatio:
    return "dwRatioTechUnitsDenom and iRatioTechUnitsNum must be greater than 0";
  case ScalingError::BadPeriod:
    return "fPositionPeriod must be at least one increment";
  case ScalingError::PeriodTooLarge:
    return "fPositionPeriod is more than 16#80000000 increments";
  case ScalingError::None:
    break;
  }
  return {};
}

} // namespace

void enterErrorStop(AxisRef &axis, int16_t reason) noexcept {
  auto &plan = axis.stPlanner;
  const double commanded = plan.fDeceleration;
  axis.iOwner = 0;
  axis.nAxisState = state::kErrorStop;
  axis.wFBErrorID = static_cast<uint16_t>(reason);
  plan.wStopReason = static_cast<uint16_t>(reason);
  plan.bActive = 0;
  const double deceleration =
      std::max(usable(axis.fSWMaxDeceleration) ? axis.fSWMaxDeceleration : 0.0,
               usable(commanded) ? commanded : 0.0);
  const double velocity = axis.fSetVelocity;
  if (!(deceleration > 0.0) || velocity == 0.0 || !std::isfinite(velocity)) {
    writeMotion(axis, 0.0, 0.0);
    return;
  }
  const double duration = std::fabs(velocity) / deceleration;
  const double target = axis.fSetPosition + 0.5 * velocity * duration;
  beginPlan(axis, duration, target, deceleration);
  appendSegment(axis, 0.0, duration, {target, 0.0, velocity > 0.0 ? -deceleration : deceleration},
                0.0);
}

AxisGroup::AxisGroup(std::unique_ptr<AxisDriver> driver, AxisGroupRef &group,
                     std::vector<AxisRef *> axes, double cycleSeconds)
    : driver_(std::move(driver)), group_(&group), axes_(std::move(axes)) {
  group_->wState = 0;
  group_->wDriveCount = static_cast<uint16_t>(axes_.size());
  for (AxisRef *axis : axes_) {
    axis->bRealDrive = 1;
    axis->fTaskCycle = cycleSeconds;
    axis->nAxisState = state::kPowerOff;
    axis->wCommunicationState = 0;
  }
}

void AxisGroup::executeStart() {
  ++group_->udiCycleCount;
  driver_->executeStart();
  if (group_->wState < kNormalOperation)
    startUp();
  for (std::size_t i = 0; i < axes_.size(); ++i)
    readDrive(i);
}

void AxisGroup::startUp() {
  uint16_t least = kNormalOperation;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    AxisRef &axis = *axes_[i];
    if (axis.bDisableDriveInAxisGroup != 0 || axis.wCommunicationState == kNormalOperation)
      continue;
    std::string message;
    uint16_t progress = 0;
    switch (driver_->init(i, progress, message)) {
    case StartUp::Busy:
      axis.wCommunicationState = std::min<uint16_t>(progress, kNormalOperation - 1);
      break;
    case StartUp::Started:
      if (const ScalingError problem = configureScaling(axis); problem != ScalingError::None) {
        startFailed(i, describe(problem));
        return;
      }
      axis.wCommunicationState = kNormalOperation;
      synchronizePosition(axis, driver_->status(i).position);
      break;
    case StartUp::Failed:
      startFailed(i, message);
      return;
    }
    least = std::min(least, axis.wCommunicationState);
  }
  group_->wState = least;
}

void AxisGroup::startFailed(std::size_t index, const std::string &message) {
  AxisRef &axis = *axes_[index];
  axis.bErrorDuringStartup = 1;
  group_->pErrorDrive = &axis;
  group_->wState = kStartUpFailed;
  bootupError_ = "drive " + std::to_string(axis.wDriveId) + ": " + message;
}

void AxisGroup::readDrive(std::size_t index) {
  AxisRef &axis = *axes_[index];
  if (axis.wCommunicationState != kNormalOperation) {
    axis.bMovedInThisCycle = 0;
    return;
  }
  const DriveStatus status = driver_->status(index);
  axis.bCommunication = status.communication;
  axis.bRegulatorRealState = status.communication && status.regulatorOn;
  axis.bDriveStartRealState = status.communication && status.driveStarted;
  axis.byRealControllerMode = status.controllerMode;
  axis.bError = status.error;
  axis.wErrorID = status.error ? status.errorId : uint16_t{0};

  updateActual(axis, status.position);
  const double velocity = status.velocity * axis.fFactorVel;
  if (axis.fTaskCycle > 0.0) {
    axis.fActAcceleration = (velocity - axis.fActVelocity) / axis.fTaskCycle;
    axis.fActDeceleration =
        axis.fActAcceleration * velocity < 0.0 ? std::fabs(axis.fActAcceleration) : 0.0;
  }
  axis.fActVelocity = velocity;
  axis.fActTorque = status.torque * axis.fFactorTor;

  // Errors of the drive and of the bus.
  if (axis.nAxisState != state::kErrorStop) {
    if (!status.communication)
      enterErrorStop(axis, error::kCommunication);
    else if (status.error)
      enterErrorStop(axis, error::kDrive);
  } else if (axis.bErrorAckn != 0 && status.communication && !status.error &&
             axis.fSetVelocity == 0.0) {
    axis.bErrorAckn = 0;
    axis.wFBErrorID = 0;
    axis.stPlanner.wStopReason = 0;
    axis.nAxisState = state::kPowerOff;
  }

  if (!isPowered(axis))
    leaveUnpowered(axis);
  else if (axis.nAxisState == state::kPowerOff)
    axis.nAxisState = state::kStandstill;

  axis.fSavePosition = axis.fSetPosition;
  axis.fSaveVelocity = axis.fSetVelocity;
  axis.fSaveAcceleration = axis.fSetAcceleration;
  axis.fSaveDeceleration = axis.fSetDeceleration;
  axis.bMovedInThisCycle = 0;
}

void AxisGroup::supervise(AxisRef &axis) {
  if (!isPowered(axis)) {
    leaveUnpowered(axis);
    return;
  }
  // Whoever owns a moving axis moves it in every cycle.
  if (axis.bMovedInThisCycle == 0) {
    if (axis.iOwner != 0 && isMotion(axis.nAxisState))
      enterErrorStop(axis, error::kNotCalled);
    else if (axis.nAxisState == state::kStopping && axis.stPlanner.bActive != 0)
      enterErrorStop(axis, error::kStopBlocks);
  }
  if (axis.iMovementType != 0) {
    const bool above = axis.fSetPosition > axis.fSWLimitPositive;
    const bool below = axis.fSetPosition < axis.fSWLimitNegative;
    axis.bSWEndSwitchActive = axis.bSWLimitEnable != 0 && (above || below);
    const bool outward = (above && axis.fSetPosition > axis.fSavePosition) ||
                         (below && axis.fSetPosition < axis.fSavePosition);
    if (axis.bSWEndSwitchActive != 0 && outward && axis.nAxisState != state::kErrorStop)
      enterErrorStop(axis, error::kSwLimits);
  }
  if (axis.nAxisState == state::kErrorStop && axis.stPlanner.bActive != 0 &&
      axis.bMovedInThisCycle == 0)
    (void)stepPlan(axis);
}

void AxisGroup::writeDrive(std::size_t index) {
  AxisRef &axis = *axes_[index];
  if (axis.wCommunicationState != kNormalOperation)
    return;
  supervise(axis);
  if (axis.bMovedInThisCycle != 0) {
    const double travel = 0.5 * (axis.fSaveVelocity + axis.fSetVelocity) * axis.fTaskCycle;
    if (!updateSet(axis, travel)) {
      // Unlike the other error stops this one is abrupt: there is no range left to brake in.
      axis.fSetPosition = axis.fSavePosition;
      axis.fSetVelocity = 0.0;
      enterErrorStop(axis, error::kOutOfRange);
    }
  }
  DriveCommand command;
  command.position = static_cast<uint32_t>(axis.liSetIncrements);
  command.velocity = axis.fSetVelocity / axis.fFactorVel;
  command.acceleration = axis.fSetAcceleration / axis.fFactorAcc;
  command.torque = axis.fSetTorque / axis.fFactorTor;
  command.regulatorOn = axis.bRegulatorOn != 0;
  command.driveStart = axis.bDriveStart != 0;
  command.errorAckn = axis.bErrorAckn != 0;
  command.controllerMode = axis.byControllerMode;
  driver_->command(index, command);
}

void AxisGroup::executeEnd() {
  for (std::size_t i = 0; i < axes_.size(); ++i)
    writeDrive(i);
  driver_->executeEnd();
}

void AxisGroup::stopAll() {
  for (AxisRef *axis : axes_) {
    if (axis->wCommunicationState == kNormalOperation && axis->nAxisState != state::kErrorStop &&
        axis->fSetVelocity != 0.0)
      enterErrorStop(*axis, error::kNotCalled);
  }
}

bool AxisGroup::atRest() const {
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const AxisRef *axis) { return axis->fSetVelocity == 0.0; });
}

} // namespace stride::axis
