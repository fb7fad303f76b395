// What happens to every axis around the blocks of a cycle, whoever serves it: power, error stop,
// supervision of owners and limits, and what becomes of a motion when the drive regulates something
// else. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_AXIS_AXIS_CYCLE_HPP
#define STRIDE_RUNTIME_AXIS_AXIS_CYCLE_HPP

#include "runtime/axis/axis_ref.hpp"

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
void beginCycle(AxisRef &axis) noexcept;

/// The drive regulates something else than it did (`before`) when the last cycle ended. A velocity
/// command goes on where a velocity is still regulated; whoever else moved the axis loses it with
/// error 21. What moves then is braked: by the set values, or as soon as these count again. Before
/// beginCycle.
void changeRegulated(AxisRef &axis, Regulated before) noexcept;

/// Before the set values of a cycle are sent: an axis without power is given up; error stops for
/// owners that did not move it and for limits; braking goes on.
void supervise(AxisRef &axis) noexcept;

/// The way of this cycle by the set velocities, or as the block that moved the axis gave it. [u]
double wayOfCycle(const AxisRef &axis) noexcept;

/// The way that the axis makes with the velocity while values are on their way to the drive and
/// back (fSetActTimeLagCycles). [u]
double wayOfLag(const AxisRef &axis, double velocity) noexcept;

/// A drive that regulates its velocity is where it is, not where the set values would have brought
/// it: the set position becomes the actual one at the start of the cycle and the way since then and
/// while values are on their way. Returns that way. [u]
double settleOnActual(AxisRef &axis) noexcept;

} // namespace stride::axis

#endif
