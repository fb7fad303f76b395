// One drive of a group starts anew, while the others go on: AXIS_REF.stRestart, SMC3_ReinitDrive.
#include "runtime/bus/drive_restart.hpp"

#include "runtime/axis/axis_cycle.hpp"
#include "runtime/bus/drive_group.hpp"

namespace stride::bus {
namespace {

void setStep(axis::AxisRef &axis, RestartStep step) {
  axis.stRestart.byStep = static_cast<uint8_t>(step);
}

} // namespace

void brakeForRestart(axis::AxisRef &axis) noexcept {
  if (axis.nAxisState != axis::state::kErrorStop && axis.nAxisState != axis::state::kPowerOff)
    axis::enterErrorStop(axis, axis::error::kNone);
}

/// One step of the restart that a block has asked for. A reset of the whole group goes before it.
void DriveGroup::serveRestart(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  auto &restart = axis.stRestart;
  if (resetting()) {
    if (isRestarting(axis))
      --restart.udiBegun; // it begins again after the reset
    setStep(axis, RestartStep::None);
    return;
  }
  if (restart.udiBegun != restart.udiAsked)
    beginRestart(index);
  switch (restartStep(axis)) {
  case RestartStep::None:
    break;
  case RestartStep::Braking:
    if (axis.fSetVelocity == 0.0)
      setStep(axis, RestartStep::PowerOff);
    break;
  case RestartStep::PowerOff:
    if (!hasPower(axis) || ++restart.uiCycles >= kPowerOffCycles)
      giveUpDrive(index);
    break;
  case RestartStep::StartUp:
    startAgain(index);
    break;
  }
}

void DriveGroup::beginRestart(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  axis.stRestart.udiBegun = axis.stRestart.udiAsked;
  axis.stRestart.uiCycles = 0;
  if (axis.wCommunicationState == axis::kNormalOperation)
    brakeForRestart(axis);
  setStep(axis, RestartStep::Braking);
}

/// The drive is as before its first start-up. In virtual mode it stays so.
void DriveGroup::giveUpDrive(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  const bool simulated = axis.stRestart.bVirtual != 0;
  restart(index, true);
  axis.bRealDrive = simulated ? 0 : 1;
  setStep(axis, simulated ? RestartStep::None : RestartStep::StartUp);
}

/// A step of its start-up. The group goes on with its own start-up where this drive has held it up.
void DriveGroup::startAgain(size_t index) {
  axis::AxisRef &axis = *axes_[index];
  uint16_t failure = 0;
  const StartUp result = startDrive(index, failure);
  if (result == StartUp::Busy)
    return;
  setStep(axis, RestartStep::None);
  if (result == StartUp::Failed)
    return;
  if (failedDrive_ == index) {
    failedDrive_ = kNoDrive;
    bootupError_.set();
  }
  if (group_->pErrorDrive == &axis) {
    group_->pErrorDrive = nullptr;
    group_->wState = 0;
  }
}

} // namespace stride::bus
