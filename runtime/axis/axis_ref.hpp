// What the runtime and the native blocks share about AXIS_REF: names, power, ownership.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_REF_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_REF_HPP

#include "st/SM_DriveBasic/AXIS_REF.h"
#include "st/SM_DriveBasic/MC_Direction.h"
#include "st/SM_DriveBasic/SMC_AXIS_STATE.h"
#include "st/SM_DriveBasic/SMC_CONTROLLER_MODE.h"
#include "st/SM_Error/SMC_ERROR.h"

#include <stdint.h>

namespace stride::axis {

using AxisRef = ::st::SM_DriveBasic::AXIS_REF;

/// AXIS_REF.wCommunicationState and SMC_AXISGROUP_REF.wState when the start-up has ended well.
inline constexpr uint16_t kNormalOperation = 100;

/// AXIS_REF.nAxisState.
namespace state {
inline constexpr int16_t kPowerOff = ::st::SM_DriveBasic::SMC_AXIS_STATE__power_off;
inline constexpr int16_t kErrorStop = ::st::SM_DriveBasic::SMC_AXIS_STATE__errorstop;
inline constexpr int16_t kStopping = ::st::SM_DriveBasic::SMC_AXIS_STATE__stopping;
inline constexpr int16_t kStandstill = ::st::SM_DriveBasic::SMC_AXIS_STATE__standstill;
inline constexpr int16_t kDiscrete = ::st::SM_DriveBasic::SMC_AXIS_STATE__discrete_motion;
inline constexpr int16_t kContinuous = ::st::SM_DriveBasic::SMC_AXIS_STATE__continuous_motion;
inline constexpr int16_t kSynchronized = ::st::SM_DriveBasic::SMC_AXIS_STATE__synchronized_motion;
inline constexpr int16_t kHoming = ::st::SM_DriveBasic::SMC_AXIS_STATE__homing;
} // namespace state

/// The numbers of SMC_ERROR that axes and single-axis blocks raise.
namespace error {
inline constexpr int16_t kNone = ::st::SM_Error::SMC_ERROR__SMC_NO_ERROR;
inline constexpr int16_t kCommunication =
    ::st::SM_Error::SMC_ERROR__SMC_DI_GENERAL_COMMUNICATION_ERROR;
inline constexpr int16_t kDrive = ::st::SM_Error::SMC_ERROR__SMC_DI_AXIS_ERROR;
inline constexpr int16_t kSwLimits = ::st::SM_Error::SMC_ERROR__SMC_DI_SWLIMITS_EXCEEDED;
inline constexpr int16_t kHwLimits = ::st::SM_Error::SMC_ERROR__SMC_DI_HWLIMITS_EXCEEDED;
inline constexpr int16_t kOutOfRange = ::st::SM_Error::SMC_ERROR__SMC_DI_LINEAR_AXIS_OUTOFRANGE;
inline constexpr int16_t kNotPowered = ::st::SM_Error::SMC_ERROR__SMC_REGULATOR_OR_START_NOT_SET;
inline constexpr int16_t kWrongMode = ::st::SM_Error::SMC_ERROR__SMC_WRONG_CONTROLLER_MODE;
inline constexpr int16_t kNotCalled = ::st::SM_Error::SMC_ERROR__SMC_FB_WASNT_CALLED_DURING_MOTION;
inline constexpr int16_t kNoAxis = ::st::SM_Error::SMC_ERROR__SMC_AXIS_IS_NO_AXIS_REF;
inline constexpr int16_t kAxisChanged =
    ::st::SM_Error::SMC_ERROR__SMC_AXIS_REF_CHANGED_DURING_OPERATION;
inline constexpr int16_t kNotReady = ::st::SM_Error::SMC_ERROR__SMC_AXIS_NOT_READY_FOR_MOTION;
inline constexpr int16_t kTaskCycleEmpty = ::st::SM_Error::SMC_ERROR__SMC_P_FTASKCYCLE_EMPTY;
inline constexpr int16_t kReadUnknown = ::st::SM_Error::SMC_ERROR__SMC_RP_PARAM_UNKNOWN;
inline constexpr int16_t kReadTransfer = ::st::SM_Error::SMC_ERROR__SMC_RP_REQUESTING_ERROR;
inline constexpr int16_t kWriteInvalid = ::st::SM_Error::SMC_ERROR__SMC_WP_PARAM_INVALID;
inline constexpr int16_t kWriteTransfer = ::st::SM_Error::SMC_ERROR__SMC_WP_SENDING_ERROR;
inline constexpr int16_t kHomeNotStandstill =
    ::st::SM_Error::SMC_ERROR__SMC_H_AXIS_WASNT_STANDSTILL;
inline constexpr int16_t kHomeNotStarted = ::st::SM_Error::SMC_ERROR__SMC_H_AXIS_DIDNT_START_HOMING;
inline constexpr int16_t kHomeFailed = ::st::SM_Error::SMC_ERROR__SMC_H_AXIS_DIDNT_ANSWER;
inline constexpr int16_t kHomeStop = ::st::SM_Error::SMC_ERROR__SMC_H_ERROR_WHEN_STOPPING;
inline constexpr int16_t kStopUnknown = ::st::SM_Error::SMC_ERROR__SMC_MS_UNKNOWN_STOPPING_ERROR;
inline constexpr int16_t kStopValues = ::st::SM_Error::SMC_ERROR__SMC_MS_INVALID_ACCDEC_VALUES;
inline constexpr int16_t kStopInErrorStop = ::st::SM_Error::SMC_ERROR__SMC_MS_AXIS_IN_ERRORSTOP;
inline constexpr int16_t kStopBlocks = ::st::SM_Error::SMC_ERROR__SMC_BLOCKING_MC_STOP_WASNT_CALLED;
inline constexpr int16_t kMoveAbsoluteValues =
    ::st::SM_Error::SMC_ERROR__SMC_MA_INVALID_VELACC_VALUES;
inline constexpr int16_t kMoveAbsoluteDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MA_INVALID_DIRECTION;
inline constexpr int16_t kMoveRelativeValues =
    ::st::SM_Error::SMC_ERROR__SMC_MR_INVALID_VELACC_VALUES;
inline constexpr int16_t kMoveRelativeDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MR_INVALID_DIRECTION;
inline constexpr int16_t kMoveAdditiveValues =
    ::st::SM_Error::SMC_ERROR__SMC_MAD_INVALID_VELACC_VALUES;
inline constexpr int16_t kMoveAdditiveDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MAD_INVALID_DIRECTION;
inline constexpr int16_t kOverride = ::st::SM_Error::SMC_ERROR__SMC_SO_INVALID_FACTOR;
inline constexpr int16_t kInvalidParameter = ::st::SM_Error::SMC_ERROR__SMC_INVALID_PARAMETER;
inline constexpr int16_t kHomingValues = ::st::SM_Error::SMC_ERROR__SMC_3SH_INVALID_VELACC_VALUES;
inline constexpr int16_t kHomingNeedsLimits = ::st::SM_Error::SMC_ERROR__SMC_3SH_MODE_NEEDS_HWLIMIT;
inline constexpr int16_t kSuperimposedValues =
    ::st::SM_Error::SMC_ERROR__SMC_MSI_INVALID_VELACC_VALUES;
inline constexpr int16_t kMoveVelocityValues =
    ::st::SM_Error::SMC_ERROR__SMC_MV_INVALID_ACCDEC_VALUES;
inline constexpr int16_t kMoveVelocityDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MV_DIRECTION_NOT_APPLICABLE;
inline constexpr int16_t kContinuousRelativeValues =
    ::st::SM_Error::SMC_ERROR__SMC_MCR_INVALID_VELACC_VALUES;
inline constexpr int16_t kContinuousRelativeDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MCR_INVALID_DIRECTION;
inline constexpr int16_t kContinuousAbsoluteValues =
    ::st::SM_Error::SMC_ERROR__SMC_MCA_INVALID_VELACC_VALUES;
inline constexpr int16_t kContinuousAbsoluteDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MCA_INVALID_DIRECTION;
inline constexpr int16_t kContinuousAbsoluteFastest =
    ::st::SM_Error::SMC_ERROR__SMC_MCA_DIRECTION_NOT_APPLICABLE;
} // namespace error

/// Whether the axis is in regulation with its brake released, by demand and in reality.
inline bool isPowered(const AxisRef &axis) noexcept {
  return axis.bRegulatorOn != 0 && axis.bDriveStart != 0 && axis.bRegulatorRealState != 0 &&
         axis.bDriveStartRealState != 0;
}

/// Whether the axis can execute any motion command; an SMC_ERROR.
inline int16_t readiness(const AxisRef &axis) noexcept {
  if (!isPowered(axis) || axis.nAxisState == state::kPowerOff)
    return error::kNotPowered;
  if (!(axis.fTaskCycle > 0.0))
    return error::kTaskCycleEmpty;
  return error::kNone;
}

/// What the set values of an axis can bring about.
enum class Regulated : uint8_t {
  Position, ///< Positions, and velocities.
  Velocity, ///< Velocities only; the axis has been switched to that (SMC_SetControllerMode).
  Force,    ///< Torque or current: the axis goes where that takes it.
};

/// What the drive regulates in a controller mode. A drive that has no position control counts as
/// one that has: it is positioned by the course of the set velocity.
inline Regulated regulatedIn(const AxisRef &axis, uint8_t controllerMode) noexcept {
  namespace mode = ::st::SM_DriveBasic;
  switch (controllerMode) {
  case mode::SMC_CONTROLLER_MODE__SMC_torque:
  case mode::SMC_CONTROLLER_MODE__SMC_current:
    return Regulated::Force;
  case mode::SMC_CONTROLLER_MODE__SMC_velocity:
    return ((axis.byControllerModes >> mode::SMC_CONTROLLER_MODE__SMC_position) & 1) != 0
               ? Regulated::Velocity
               : Regulated::Position;
  default:
    return Regulated::Position;
  }
}

/// What the drive regulates now.
inline Regulated regulated(const AxisRef &axis) noexcept {
  return regulatedIn(axis, axis.byRealControllerMode);
}

/// Whether positions are taken modulo the period.
inline bool isRotary(const AxisRef &axis) noexcept {
  return axis.iMovementType == 0 && axis.fPositionPeriod > 0.0;
}

/// AXIS_REF.byHoming: the drive's reference run.
enum class DriveHoming : uint8_t { None = 0, Asked = 1, Running = 2, Found = 3, Failed = 4 };

/// Whether the drive carries out its reference run, or shall.
inline bool isDriveHoming(const AxisRef &axis) noexcept {
  return axis.nAxisState == state::kHoming && axis.bStartReference != 0;
}

/// Enters an error into the axis's list, which SMC_ReadFBError reads; kNone is none.
inline void listError(AxisRef &axis, int16_t errorId) noexcept {
  auto &list = axis.stFBErrors;
  constexpr uint16_t kPlaces = sizeof list.aError.v / sizeof list.aError.v[0];
  if (errorId == error::kNone)
    return;
  list.aError.v[(list.uiFirst + list.uiCount) % kPlaces] = errorId;
  if (list.uiCount < kPlaces)
    ++list.uiCount;
  else
    list.uiFirst = static_cast<uint16_t>((list.uiFirst + 1) % kPlaces);
}

/// Whether the newest error of the axis's list is this one.
inline bool isNewestError(const AxisRef &axis, int16_t errorId) noexcept {
  const auto &list = axis.stFBErrors;
  constexpr uint16_t kPlaces = sizeof list.aError.v / sizeof list.aError.v[0];
  return list.uiCount > 0 && list.aError.v[(list.uiFirst + list.uiCount - 1U) % kPlaces] == errorId;
}

/// Notes that a block met an error on the axis (chapter 9 of the manual: FB errors), once for each
/// time that it does. What brought the axis into error stop stays the last error until it has been
/// acknowledged.
inline void noteError(AxisRef &axis, int16_t errorId) noexcept {
  listError(axis, errorId);
  if (axis.nAxisState != state::kErrorStop || axis.wFBErrorID == 0)
    axis.wFBErrorID = static_cast<uint16_t>(errorId);
}

/// Draws a number under which a block instance owns the axis or waits for it; never the same twice.
inline uint64_t drawOwner(AxisRef &axis) noexcept { return ++axis.ulLastOwner; }

/// Makes the instance with the number `owner` the axis's owner; whoever was it finds out at its
/// next call. The plan in progress is over. A superimposed motion ends; what it has added is part
/// of the set position from now on.
inline void giveAxis(AxisRef &axis, uint64_t owner) noexcept {
  axis.iNoOwner = axis.iNoOwner >= 0 && axis.iNoOwner < INT16_MAX
                      ? static_cast<int16_t>(axis.iNoOwner + 1)
                      : int16_t{1};
  axis.iOwner = axis.iNoOwner;
  axis.ulOwnerCount = owner;
  axis.stSuperimposed = {};
  axis.stPlanner.bActive = 0;
  axis.stPlanner.wStopReason = 0;
}

/// Makes the calling instance the owner; returns the number it owns the axis under.
inline uint64_t takeAxis(AxisRef &axis) noexcept {
  const uint64_t owner = drawOwner(axis);
  giveAxis(axis, owner);
  return owner;
}

/// Whether the instance still owns the axis.
inline bool ownsAxis(const AxisRef &axis, uint64_t owner) noexcept {
  return axis.iOwner != 0 && axis.ulOwnerCount == owner;
}

/// Gives the axis up: nobody owns it.
inline void releaseAxis(AxisRef &axis) noexcept {
  axis.iOwner = 0;
  axis.stPlanner.bActive = 0;
}

/// Why an instance that lost the axis lost it: an SMC_ERROR if the runtime took it (error stop,
/// power gone), kNone if another command did.
inline int16_t lossReason(const AxisRef &axis, uint64_t owner) noexcept {
  if (axis.iOwner == 0 && axis.ulOwnerCount == owner)
    return static_cast<int16_t>(axis.stPlanner.wStopReason);
  return error::kNone;
}

} // namespace stride::axis

#endif
