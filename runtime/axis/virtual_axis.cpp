#include "runtime/axis/virtual_axis.hpp"

#include "runtime/axis/axis_cycle.hpp"
#include "runtime/axis/shift_position.hpp"

#include "st/SM_DriveBasic/SMC_CONTROLLER_MODE.h"

namespace stride::axis {
namespace {

constexpr uint8_t kPositionControl = ::st::SM_DriveBasic::SMC_CONTROLLER_MODE__SMC_position;

/// Where the axis has been set, there it is.
void arrive(AxisRef &axis) noexcept {
  axis.fActPosition = axis.fSetPosition;
  axis.fActVelocity = axis.fSetVelocity;
  axis.fActAcceleration = axis.fSetAcceleration;
  axis.fActDeceleration = axis.fSetDeceleration;
}

/// The end of a cycle: supervision, and what goes on without an owner.
void endCycle(AxisRef &axis) noexcept {
  arrive(axis); // without power it stays there
  supervise(axis);
  arrive(axis);
}

/// There is nothing to look for: the place where the axis is becomes the reference.
void home(AxisRef &axis) noexcept {
  if (!isDriveHoming(axis)) {
    axis.bStartReference = 0;
    axis.byHoming = static_cast<uint8_t>(DriveHoming::None);
  } else if (axis.byHoming != static_cast<uint8_t>(DriveHoming::Found)) {
    shiftPosition(axis, axis.fReference - axis.fActPosition);
    axis.byHoming = static_cast<uint8_t>(DriveHoming::Found);
  }
}

void switchPower(AxisRef &axis) noexcept {
  axis.bRegulatorRealState = axis.bRegulatorOn;
  axis.bDriveStartRealState = axis.bDriveStart;
  if (!isPowered(axis))
    leaveUnpowered(axis);
  else if (axis.nAxisState == state::kPowerOff)
    axis.nAxisState = state::kStandstill;
}

} // namespace

void serveVirtual(AxisRef &axis, uint64_t cycle) noexcept {
  const bool first = axis.bCommunication == 0;
  const bool anew = first || axis.ulServedCycle != cycle;
  axis.ulServedCycle = cycle;
  if (first) {
    axis.bCommunication = 1;
    axis.wCommunicationState = kNormalOperation;
    axis.byControllerMode = kPositionControl;
    axis.byRealControllerMode = kPositionControl;
    axis.byControllerModes = 1U << kPositionControl;
    axis.nAxisState = state::kPowerOff;
    axis.fActPosition = axis.fSetPosition;
  } else if (anew) {
    endCycle(axis);
    acknowledge(axis);
  }
  switchPower(axis);
  if (!anew)
    return;
  home(axis);
  beginCycle(axis);
}

} // namespace stride::axis
