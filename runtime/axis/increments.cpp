#include "runtime/axis/increments.hpp"

#include "runtime/numeric/modulo_wrap.hpp"

#include <math.h>

namespace stride::axis {
namespace {

__extension__ using Wide = __int128;

constexpr int kFractionBits = 46; // a numerator shifted by these fits 63 bits

uint64_t greatestCommonDivisor(uint64_t a, uint64_t b) noexcept {
  while (b != 0) {
    const uint64_t r = a % b;
    a = b;
    b = r;
  }
  return a;
}

/// A turn in increments, as a fraction.
struct Turn {
  Wide numerator;
  Wide denominator;
};

/// period * denominator / numerator, between 1 and 2^31. Exact, unless the period has more than
/// kFractionBits binary places: then to 2^-40 increments.
Turn exactTurn(double period, uint64_t denominator, uint64_t numerator) noexcept {
  int exponent = 0;
  Wide mantissa = static_cast<int64_t>(::ldexp(::frexp(period, &exponent), 53));
  int bits = 53 - exponent; // period = mantissa / 2^bits
  while (bits > 0 && mantissa % 2 == 0) {
    mantissa /= 2;
    --bits;
  }
  if (bits <= kFractionBits) {
    const uint64_t whole = static_cast<uint64_t>(bits < 0 ? mantissa << -bits : mantissa);
    uint64_t divisor = bits < 0 ? numerator : numerator << bits;
    const uint64_t common = greatestCommonDivisor(denominator, divisor);
    divisor /= common;
    const uint64_t shared = greatestCommonDivisor(whole, divisor);
    return {Wide{whole / shared} * Wide{denominator / common}, Wide{divisor / shared}};
  }
  constexpr int kPlaces = 40;
  const Wide product = mantissa * Wide{denominator};
  const int shift = bits - kPlaces; // > 0
  const Wide divisor = Wide{numerator} << shift;
  return {(product + divisor / 2) / divisor, Wide{1} << kPlaces};
}

double remainder(int64_t rest, int64_t denominator) noexcept {
  if (rest == 0) // a turn of whole increments
    return 0.0;
  return static_cast<double>(rest) / static_cast<double>(denominator);
}

/// Moves the start of a turn by `turns` whole turns, exactly.
void advanceTurns(const AxisRef &axis, int64_t &start, int64_t &rest, int64_t turns) noexcept {
  const Wide denominator = axis.liTurnDenominator;
  const Wide total = Wide{rest} + Wide{turns} * Wide{axis.liTurnRest};
  Wide carry = total / denominator;
  Wide left = total % denominator;
  if (left < 0) {
    left += denominator;
    --carry;
  }
  start += static_cast<int64_t>(Wide{turns} * Wide{axis.liTurnIncrements} + carry);
  rest = static_cast<int64_t>(left);
}

/// The manual's residual members (1230 ff.) mirror the exact ones, as far as they can hold them.
void mirrorResiduals(AxisRef &axis) noexcept {
  axis.dwPosOffsetForResiduals = static_cast<uint32_t>(axis.liSetTurnStart);
  axis.iRestNumerator =
      axis.liTurnDenominator <= INT16_MAX ? static_cast<int16_t>(axis.liSetTurnRest) : int16_t{0};
}

} // namespace

TurnFraction lengthOfTurn(double period, uint32_t denominator, uint32_t numerator) noexcept {
  const Turn turn = exactTurn(period, denominator, numerator);
  return {static_cast<int64_t>(turn.numerator / turn.denominator),
          static_cast<int64_t>(turn.numerator % turn.denominator),
          static_cast<int64_t>(turn.denominator)};
}

double positionOf(const AxisRef &axis, uint32_t counter) noexcept {
  const int64_t increments =
      axis.liActIncrements +
      static_cast<int32_t>(counter - static_cast<uint32_t>(axis.liActIncrements));
  if (!countsTurns(axis))
    return unitsPerIncrement(axis, static_cast<double>(increments)) + axis.fOffsetPosition;
  const double place = static_cast<double>(increments - axis.liActTurnStart) -
                       remainder(axis.liActTurnRest, axis.liTurnDenominator);
  return numeric::wrapPosition(unitsPerIncrement(axis, place) + axis.fOffsetPosition,
                               axis.fPositionPeriod);
}

ScalingError configureScaling(AxisRef &axis) noexcept {
  axis.liTurnIncrements = 0;
  axis.liTurnRest = 0;
  axis.liTurnDenominator = 1;
  axis.liSetTurnRest = 0;
  axis.liActTurnRest = 0;
  if (axis.dwRatioTechUnitsDenom == 0 || axis.iRatioTechUnitsNum <= 0)
    return ScalingError::ZeroRatio;
  axis.fScalefactor = unitsPerIncrement(axis, 1.0);
  axis.fFactorVel = axis.fScalefactor;
  axis.fFactorAcc = axis.fScalefactor;
  axis.fFactorJerk = axis.fScalefactor;
  if (axis.iMovementType != 0)
    return ScalingError::None;

  const double period = axis.fPositionPeriod;
  if (!::isfinite(period) || !(period > 0.0))
    return ScalingError::BadPeriod;
  if (incrementsPerUnit(axis, period) > 0x1p31)
    return ScalingError::PeriodTooLarge;
  if (incrementsPerUnit(axis, period) < 1.0)
    return ScalingError::BadPeriod;

  const TurnFraction turn = lengthOfTurn(period, axis.dwRatioTechUnitsDenom,
                                         static_cast<uint32_t>(axis.iRatioTechUnitsNum));
  axis.liTurnIncrements = turn.whole;
  axis.liTurnRest = turn.rest;
  axis.liTurnDenominator = turn.denominator;
  axis.dwOneTurn = static_cast<uint32_t>(axis.liTurnIncrements);
  return ScalingError::None;
}

void synchronizePosition(AxisRef &axis, uint32_t counter) noexcept {
  axis.liActIncrements = static_cast<int32_t>(counter);
  axis.liActTurnStart = 0;
  axis.liActTurnRest = 0;
  updateActual(axis, counter);
  followActual(axis);
}

void updateActualTurns(AxisRef &axis) noexcept {
  const auto inTurn = [&axis] {
    return static_cast<double>(axis.liActIncrements - axis.liActTurnStart) -
           remainder(axis.liActTurnRest, axis.liTurnDenominator);
  };
  const double turn = static_cast<double>(axis.liTurnIncrements) +
                      remainder(axis.liTurnRest, axis.liTurnDenominator);
  double place = inTurn();
  if (place < 0.0 || place >= turn) {
    advanceTurns(axis, axis.liActTurnStart, axis.liActTurnRest,
                 static_cast<int64_t>(::floor(place / turn)));
    place = inTurn();
  }
  axis.fActPosition = numeric::wrapPosition(unitsPerIncrement(axis, place) + axis.fOffsetPosition,
                                            axis.fPositionPeriod);
}

void updateSetTurns(AxisRef &axis, double travel) noexcept {
  const double period = axis.fPositionPeriod;
  const double place = numeric::wrapPosition(axis.fSetPosition - axis.fOffsetPosition, period);
  const double surplus = (travel - (place - axis.fLastPosition)) / period;
  if (::fabs(surplus) >= 0.5 && ::fabs(surplus) < 0x1p31) {
    const int64_t turns = exact::nearest(surplus);
    advanceTurns(axis, axis.liSetTurnStart, axis.liSetTurnRest, turns);
    axis.iTurn = static_cast<int16_t>(axis.iTurn + turns);
    mirrorResiduals(axis);
  }
  axis.fLastPosition = place;
  axis.liSetIncrements =
      axis.liSetTurnStart + exact::nearest(remainder(axis.liSetTurnRest, axis.liTurnDenominator) +
                                           incrementsPerUnit(axis, place));
}

void followActual(AxisRef &axis) noexcept {
  axis.fSetPosition = axis.fActPosition;
  axis.liSetIncrements = axis.liActIncrements;
  if (!countsTurns(axis))
    return;
  axis.liSetTurnStart = axis.liActTurnStart;
  axis.liSetTurnRest = axis.liActTurnRest;
  axis.fLastPosition =
      numeric::wrapPosition(axis.fActPosition - axis.fOffsetPosition, axis.fPositionPeriod);
  mirrorResiduals(axis);
}

} // namespace stride::axis
