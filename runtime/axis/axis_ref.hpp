// What the runtime and the native blocks share about AXIS_REF: names, power, ownership.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_REF_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_REF_HPP

#include "st/SM_DriveBasic/AXIS_REF.h"
#include "st/SM_DriveBasic/MC_Direction.h"
#include "st/SM_DriveBasic/SMC_AXIS_STATE.h"
#include "st/SM_Error/SMC_ERROR.h"

#include <stdint.h>

namespace stride::axis {

using AxisRef = ::st::SM_DriveBasic::AXIS_REF;

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
inline constexpr int16_t kNotCalled = ::st::SM_Error::SMC_ERROR__SMC_FB_WASNT_CALLED_DURING_MOTION;
inline constexpr int16_t kNoAxis = ::st::SM_Error::SMC_ERROR__SMC_AXIS_IS_NO_AXIS_REF;
inline constexpr int16_t kAxisChanged =
    ::st::SM_Error::SMC_ERROR__SMC_AXIS_REF_CHANGED_DURING_OPERATION;
inline constexpr int16_t kNotReady = ::st::SM_Error::SMC_ERROR__SMC_AXIS_NOT_READY_FOR_MOTION;
inline constexpr int16_t kTaskCycleEmpty = ::st::SM_Error::SMC_ERROR__SMC_P_FTASKCYCLE_EMPTY;
inline constexpr int16_t kStopUnknown = ::st::SM_Error::SMC_ERROR__SMC_MS_UNKNOWN_STOPPING_ERROR;
inline constexpr int16_t kStopValues = ::st::SM_Error::SMC_ERROR__SMC_MS_INVALID_ACCDEC_VALUES;
inline constexpr int16_t kStopInErrorStop = ::st::SM_Error::SMC_ERROR__SMC_MS_AXIS_IN_ERRORSTOP;
inline constexpr int16_t kStopBlocks = ::st::SM_Error::SMC_ERROR__SMC_BLOCKING_MC_STOP_WASNT_CALLED;
inline constexpr int16_t kMoveAbsoluteValues =
    ::st::SM_Error::SMC_ERROR__SMC_MA_INVALID_VELACC_VALUES;
inline constexpr int16_t kMoveAbsoluteDirection =
    ::st::SM_Error::SMC_ERROR__SMC_MA_INVALID_DIRECTION;
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

/// Whether positions are taken modulo the period.
inline bool isRotary(const AxisRef &axis) noexcept {
  return axis.iMovementType == 0 && axis.fPositionPeriod > 0.0;
}

/// Notes that a block met an error on the axis (chapter 9 of the manual: FB errors). What brought
/// the axis into error stop stays noted there until the error has been acknowledged.
inline void noteError(AxisRef &axis, int16_t errorId) noexcept {
  if (axis.nAxisState != state::kErrorStop || axis.wFBErrorID == 0)
    axis.wFBErrorID = static_cast<uint16_t>(errorId);
}

/// What a block instance remembers of its ownership. `iOwner` alone, which applications see, wraps.
struct Ownership {
  int16_t &owner;
  uint64_t &count;
};

/// Makes the calling instance the owner; whoever was it finds out at its next call.
inline void takeAxis(AxisRef &axis, Ownership own) noexcept {
  axis.iNoOwner = axis.iNoOwner >= 0 && axis.iNoOwner < INT16_MAX
                      ? static_cast<int16_t>(axis.iNoOwner + 1)
                      : int16_t{1};
  axis.iOwner = axis.iNoOwner;
  ++axis.ulOwnerCount;
  own.owner = axis.iOwner;
  own.count = axis.ulOwnerCount;
  axis.stPlanner.wStopReason = 0;
}

/// Whether the instance still owns the axis.
inline bool ownsAxis(const AxisRef &axis, Ownership own) noexcept {
  return axis.iOwner != 0 && axis.iOwner == own.owner && axis.ulOwnerCount == own.count;
}

/// Gives the axis up: nobody owns it.
inline void releaseAxis(AxisRef &axis) noexcept {
  axis.iOwner = 0;
  axis.stPlanner.bActive = 0;
}

/// Why an instance that lost the axis lost it: an SMC_ERROR if the runtime took it (error stop,
/// power gone), kNone if another command did.
inline int16_t lossReason(const AxisRef &axis, Ownership own) noexcept {
  if (axis.iOwner == 0 && axis.ulOwnerCount == own.count)
    return static_cast<int16_t>(axis.stPlanner.wStopReason);
  return error::kNone;
}

} // namespace stride::axis

#endif
