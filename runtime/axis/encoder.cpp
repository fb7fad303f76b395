#include "runtime/axis/encoder.hpp"

#include "runtime/axis/increments.hpp"
#include "runtime/numeric/exact_math.hpp"
#include "runtime/numeric/modulo_wrap.hpp"

namespace stride::axis {
namespace {

__extension__ using Wide = __int128;

constexpr int kRotary = 0;

int64_t modulus(const EncoderRef &encoder) noexcept {
  return encoder.dwEncoderModulo == 0 ? int64_t{1} << 32 : int64_t{encoder.dwEncoderModulo};
}

} // namespace

void synchronizeEncoder(EncoderRef &encoder, uint32_t counter) noexcept {
  encoder.dwActPosition = counter;
  encoder.liActIncrements = int64_t{counter} % modulus(encoder);
  encoder.liStep = 0;
  encoder.bValid = 1;
}

void updateEncoder(EncoderRef &encoder, uint32_t counter) noexcept {
  const int64_t modulo = modulus(encoder);
  int64_t step = (int64_t{counter} - int64_t{encoder.dwActPosition}) % modulo;
  if (step < 0)
    step += modulo;
  if (2 * step >= modulo) // the shorter way round; half of it counts as backwards
    step -= modulo;
  encoder.liActIncrements += step;
  encoder.liStep = step;
  encoder.dwActPosition = counter;
}

bool usableEncoder(const EncoderRef &encoder) noexcept {
  if (encoder.dwRatioTechUnitsDenom == 0 || encoder.iRatioTechUnitsNum <= 0)
    return false;
  if (encoder.iMovementType != kRotary)
    return true;
  const double increments = encoder.fPositionPeriod *
                            static_cast<double>(encoder.dwRatioTechUnitsDenom) /
                            static_cast<double>(encoder.iRatioTechUnitsNum);
  return increments >= 1.0 && increments <= 0x1p31;
}

double encoderPosition(const EncoderRef &encoder) noexcept {
  if (!usableEncoder(encoder))
    return 0.0;
  const uint32_t denominator = encoder.dwRatioTechUnitsDenom;
  const auto units = [&](double increments) {
    return increments * static_cast<double>(encoder.iRatioTechUnitsNum) /
           static_cast<double>(denominator);
  };
  if (encoder.iMovementType != kRotary)
    return units(static_cast<double>(encoder.liActIncrements));
  const double period = encoder.fPositionPeriod;
  const TurnFraction turn =
      lengthOfTurn(period, denominator, static_cast<uint32_t>(encoder.iRatioTechUnitsNum));
  // increments modulo the turn, in units of 1/denominator of the turn's fraction: exact
  const Wide length = Wide{turn.whole} * turn.denominator + turn.rest;
  Wide place = (Wide{encoder.liActIncrements} * turn.denominator) % length;
  if (place < 0)
    place += length;
  const Wide whole = place / turn.denominator;
  const Wide rest = place % turn.denominator;
  return numeric::wrapPosition(units(static_cast<double>(static_cast<int64_t>(whole)) +
                                     static_cast<double>(static_cast<int64_t>(rest)) /
                                         static_cast<double>(turn.denominator)),
                               period);
}

} // namespace stride::axis
