// Shifting the zero point of an axis.
// Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_SHIFT_POSITION_HPP
#define STRIDE_RUNTIME_AXIS_SHIFT_POSITION_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/modulo_wrap.hpp"

#include "st/SM_DriveBasic/SMC_MOTION_KIND.h"

namespace stride::axis {

/// The plan in progress leads `shift` [u] further on; what is left of it is the same.
inline void shiftPlan(AxisRef &axis, double shift) noexcept {
  auto &plan = axis.stPlanner;
  plan.fTarget = isRotary(axis) ? numeric::wrapPosition(plan.fTarget + shift, axis.fPositionPeriod)
                                : plan.fTarget + shift;
  plan.fGoal += shift;
  plan.fEnd += shift;
  for (uint16_t i = 0; i < plan.uiSegmentCount; ++i)
    plan.aSegment.v[i].fPosition += shift;
}

/// All positions of the axis become greater by `shift` [u], without any motion: the drive's
/// increments stay as they are, and so does what has been commanded so far, the commands that wait
/// included: their positions are shifted, too.
inline void shiftPosition(AxisRef &axis, double shift) noexcept {
  const bool rotary = isRotary(axis);
  const auto moved = [&](double position) {
    return rotary ? numeric::wrapPosition(position + shift, axis.fPositionPeriod)
                  : position + shift;
  };
  axis.fOffsetPosition = moved(axis.fOffsetPosition);
  axis.fSetPosition = moved(axis.fSetPosition);
  axis.fActPosition = moved(axis.fActPosition);
  axis.fSavePosition = moved(axis.fSavePosition);
  axis.fAimPosition = moved(axis.fAimPosition);
  axis.fMarkPosition = moved(axis.fMarkPosition);
  shiftPlan(axis, shift);
  axis.stSuperimposed.fBase += shift;
  const auto shiftTarget = [shift](auto &command) {
    if (command.eKind == ::st::SM_DriveBasic::SMC_MOTION_KIND__absolute_move ||
        command.eKind == ::st::SM_DriveBasic::SMC_MOTION_KIND__continuous_absolute)
      command.fPosition += shift;
  };
  shiftTarget(axis.stPlanner.stCommand);
  for (uint16_t i = 0; i < axis.stQueue.uiCount; ++i)
    shiftTarget(axis.stQueue.aCommand.v[i]);
}

} // namespace stride::axis

#endif
