// What happens to every axis around the blocks of a cycle, whoever serves it: power, error stop,
// supervision of owners and limits, and what becomes of a motion when the drive regulates something
// else. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_CYCLE_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_CYCLE_HPP

#include "runtime/axis/set_point.hpp"

namespace stride::axis {

/// Takes the axis from its owner and brakes it to rest in state errorstop, with the largest of the
/// command's deceleration, fSWMaxDeceleration, fSWLimitDeceleration and what keeps to
/// fSWLimitDistance. Ramp types that limit the jerk do so here, too,
/// except at the end of the way (limit switches, software limits). `reason` is an SMC_ERROR.
void enterErrorStop(AxisRef &axis, int16_t reason) noexcept;

/// The axis has no power: nobody owns it, and its set position follows the actual one.
void leaveUnpowered(AxisRef &axis) noexcept;

/// The axis stands still where its set position is; its plan is over.
void haltAt(AxisRef &axis) noexcept;

/// Leads out of error stop, to power_off, when the error has been acknowledged (bErrorAckn), is
/// gone and the axis is at rest.
void acknowledge(AxisRef &axis) noexcept;

/// Notes the set values with which a cycle begins; nobody has moved the axis in it.
inline void beginCycle(AxisRef &axis) noexcept {
  axis.fSavePosition = axis.fSetPosition;
  axis.fSaveVelocity = axis.fSetVelocity;
  axis.fSaveAcceleration = axis.fSetAcceleration;
  axis.fSaveDeceleration = axis.fSetDeceleration;
  axis.bMovedInThisCycle = 0;
  axis.bTravelGiven = 0;
  axis.stSuperimposed.bMovedInThisCycle = 0;
  axis.bHWLimitIgnored = 0;
}

/// The drive still moves the axis by itself, on its way to rest, though somebody has taken its
/// reference run away: set values follow it, and who brakes does so until it is there. In every
/// cycle, before beginCycle.
void brakeWithDrive(AxisRef &axis) noexcept;

/// The drive regulates something else than it did (`before`) when the last cycle ended. A velocity
/// command goes on where a velocity is still regulated; whoever else moved the axis loses it with
/// error 21. What moves then is braked: by the set values, or as soon as these count again. Before
/// beginCycle.
void changeRegulated(AxisRef &axis, Regulated before) noexcept;

/// Whether there is nothing to supervise but limits: the axis has power and stands, or its owner
/// has moved it.
inline bool isServedByOwner(const AxisRef &axis) noexcept {
  if (!isPowered(axis) || axis.nAxisState == state::kErrorStop || axis.stSuperimposed.ulOwner != 0)
    return false;
  return axis.iOwner != 0 ? axis.bMovedInThisCycle != 0 : axis.nAxisState == state::kStandstill;
}

/// Writes bSWEndSwitchActive of a linear axis. Whether it is outside of its software limits, or at
/// a limit switch that counts.
inline bool isAtLimit(AxisRef &axis) noexcept {
  const bool outside =
      axis.fSetPosition > axis.fSWLimitPositive || axis.fSetPosition < axis.fSWLimitNegative;
  axis.bSWEndSwitchActive = axis.bSWLimitEnable != 0 && outside;
  const bool watched = axis.bHWLimitEnable != 0 && axis.bHWLimitIgnored == 0;
  return axis.bSWEndSwitchActive != 0 ||
         (watched && (axis.bLimitSwitchPositive != 0 || axis.bLimitSwitchNegative != 0));
}

/// supervise, where there may be something to do.
void superviseThoroughly(AxisRef &axis) noexcept;

/// Before the set values of a cycle are sent: an axis without power is given up; error stops for
/// owners that did not move it and for limits; braking goes on.
inline void supervise(AxisRef &axis) noexcept {
  if (!isServedByOwner(axis) || (axis.iMovementType != 0 && isAtLimit(axis)))
    superviseThoroughly(axis);
}

/// The way of this cycle by the set velocities, or as the block that moved the axis gave it. [u]
inline double wayOfCycle(const AxisRef &axis) noexcept {
  return axis.bTravelGiven != 0 ? axis.fTravel
                                : 0.5 * (axis.fSaveVelocity + axis.fSetVelocity) * axis.fTaskCycle;
}

/// The way that the axis makes with the velocity while values are on their way to the drive and
/// back (fSetActTimeLagCycles). [u]
double wayOfLag(const AxisRef &axis, double velocity) noexcept;

/// A drive that regulates its velocity is where it is, not where the set values would have brought
/// it: the set position becomes the actual one at the start of the cycle and the way since then and
/// while values are on their way. Returns that way. [u]
double settleOnActual(AxisRef &axis) noexcept;

} // namespace stride::axis

#endif
