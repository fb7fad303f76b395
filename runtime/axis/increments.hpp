// Conversion between technical units and the drive's increments, exact over any number of turns.
#ifndef STRIDE_RUNTIME_AXIS_INCREMENTS_HPP
#define STRIDE_RUNTIME_AXIS_INCREMENTS_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/exact_math.hpp"

namespace stride::axis {

/// A linear axis leaves its range here. [inc]
inline constexpr double kLinearRange = 0x1p46;

/// Why an axis's scaling cannot be used.
enum class ScalingError : uint8_t {
  None = 0,
  ZeroRatio,      ///< dwRatioTechUnitsDenom is 0 or iRatioTechUnitsNum is not > 0.
  BadPeriod,      ///< Rotary: fPositionPeriod is not finite, not > 0, or below one increment.
  PeriodTooLarge, ///< Rotary: the period is more than 16#80000000 increments.
};

/// Computes the hidden scaling members of an axis from its ratio, movement type and period. The
/// length of a turn in increments is kept as whole number and remainder, so that no turn, however
/// many there have been, is off by more than the rounding of the position itself. (A period that
/// needs more than 46 binary places is rounded to 2^-40 increments.)
ScalingError configureScaling(AxisRef &axis) noexcept;

/// Makes actual and set position start at `counter`, the drive's position counter. Without turns.
void synchronizePosition(AxisRef &axis, uint32_t counter) noexcept;

/// Whether the axis counts turns: a rotary axis whose scaling has been configured as such. (A
/// program that writes iMovementType changes nothing until the group starts up again.)
inline bool countsTurns(const AxisRef &axis) noexcept {
  return axis.iMovementType == 0 && axis.liTurnIncrements > 0;
}

/// Technical units [u] as increments. [inc]
inline double incrementsPerUnit(const AxisRef &axis, double units) noexcept {
  return units * static_cast<double>(axis.dwRatioTechUnitsDenom) /
         static_cast<double>(axis.iRatioTechUnitsNum);
}

/// Increments [inc] as technical units. [u]
inline double unitsPerIncrement(const AxisRef &axis, double increments) noexcept {
  return increments * static_cast<double>(axis.iRatioTechUnitsNum) /
         static_cast<double>(axis.dwRatioTechUnitsDenom);
}

/// updateActual for an axis that counts turns, after its increments have been taken over.
void updateActualTurns(AxisRef &axis) noexcept;

/// Takes over the drive's position counter, which wraps at 2^32, into liActIncrements and
/// fActPosition. The drive may move by less than 2^31 increments between two calls.
inline void updateActual(AxisRef &axis, uint32_t counter) noexcept {
  axis.liActIncrements +=
      static_cast<int32_t>(counter - static_cast<uint32_t>(axis.liActIncrements));
  if (countsTurns(axis))
    updateActualTurns(axis);
  else
    axis.fActPosition =
        unitsPerIncrement(axis, static_cast<double>(axis.liActIncrements)) + axis.fOffsetPosition;
}

/// The position [u] that belongs to a position counter less than 2^31 away from the last one taken
/// over: where the axis was when the drive latched it.
[[nodiscard]] double positionOf(const AxisRef &axis, uint32_t counter) noexcept;

/// One turn of a rotary axis or encoder in increments, as an exact fraction.
struct TurnFraction {
  int64_t whole;
  int64_t rest; ///< 0 <= rest < denominator
  int64_t denominator;
};
[[nodiscard]] TurnFraction lengthOfTurn(double period, uint32_t denominator,
                                        uint32_t numerator) noexcept;

/// updateSet for an axis that counts turns.
void updateSetTurns(AxisRef &axis, double travel) noexcept;

/// Converts fSetPosition into liSetIncrements. On a rotary axis `travel` [u], the way that the axis
/// makes in this cycle (half a turn more or less), tells turns apart. False if a linear axis leaves
/// the range of 2^46 increments; liSetIncrements keeps its value then.
inline bool updateSet(AxisRef &axis, double travel) noexcept {
  if (countsTurns(axis)) {
    updateSetTurns(axis, travel);
    return true;
  }
  const double increments = incrementsPerUnit(axis, axis.fSetPosition - axis.fOffsetPosition);
  if (!(exact::fabs(increments) < kLinearRange))
    return false;
  axis.liSetIncrements = exact::nearest(increments);
  return true;
}

/// Lets the set position follow the actual one: an axis without power does not hold its place.
void followActual(AxisRef &axis) noexcept;

} // namespace stride::axis

#endif
